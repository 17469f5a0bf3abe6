# Датчики, що знаходять.
mission-sensor-camera = камера
mission-sensor-zoom = камера із зумом
mission-sensor-thermal = тепловізор
mission-sensor-magnetometer = магнітометр
mission-sensor-metal-detector = металошукач
mission-sensor-radar = георадар
