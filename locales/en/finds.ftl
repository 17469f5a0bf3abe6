# Sensors that find things.
mission-sensor-camera = camera
mission-sensor-zoom = zoom camera
mission-sensor-thermal = thermal camera
mission-sensor-magnetometer = magnetometer
mission-sensor-metal-detector = metal detector
mission-sensor-radar = ground radar
