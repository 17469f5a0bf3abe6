# The room with everything about one vehicle.

vehicle-none = No vehicle is in contact yet.
vehicle-place = { $row } of { $count }
vehicle-key-next = next vehicle
vehicle-key-window = { $seconds } s
vehicle-key-page = page { $page } of { $count }
vehicle-last-known = link lost { $seconds } s ago: last known values

vehicle-attitude = attitude
vehicle-angles = roll { $roll }°  pitch { $pitch }°

vehicle-state = state
vehicle-mode = mode
vehicle-mode-set = (set: { $mode })
vehicle-no-heartbeat = no heartbeat yet
vehicle-armed = ARMED
vehicle-disarmed = disarmed
vehicle-on-ground = on ground
vehicle-in-air = in air
vehicle-paused = paused
vehicle-taking-off = taking off
vehicle-landing = landing
vehicle-ready = condition
vehicle-fine = no problems
vehicle-ready-to-arm = ready to arm
vehicle-not-ready = readiness to arm unknown
vehicle-altitude = height
vehicle-heights = { $altitude } m  above sea { $sea } m
vehicle-speed = speed
vehicle-speeds = { $ground } m/s  air { $air } m/s
vehicle-battery = battery
vehicle-home = home
vehicle-here = here
vehicle-target = target
vehicle-target-height = at { $altitude } m
vehicle-target-velocity = n { $north } e { $east } up { $up } m/s
vehicle-flight = armed for
vehicle-flight-before = last armed
vehicle-flight-last = for { $time }
vehicle-link = link
vehicle-link-good = { $percent } %  round trip { $trip }
vehicle-link-lost = LOST { $seconds } s ago
vehicle-wind = wind
vehicle-wind-unknown = not estimated
vehicle-wind-from = { $speed } m/s from { $from }°
vehicle-ground = rangefinder
vehicle-place-of = position
vehicle-load = CPU load
vehicle-control = control
vehicle-control-free = no station
vehicle-control-here = this console
vehicle-control-station = station { $station }
vehicle-control-open = may be taken over
vehicle-held = RC override
vehicle-firmware = firmware
vehicle-board = board
vehicle-board-twin = (two vehicles have id { $system })

vehicle-curves = last { $seconds } s
vehicle-least = min
vehicle-most = max
vehicle-climb = climb
vehicle-voltage = voltage
vehicle-current = current
vehicle-log-vibration = vibration
vehicle-log-estimator = EKF ratio
vehicle-log-voltage = log voltage
vehicle-log-current = log current
vehicle-remaining = charge left
vehicle-throttle = throttle

vehicle-estimate = GPS, EKF, vibration
vehicle-gps = { $fix } { $satellites } sat HDOP { $hdop }
vehicle-gps-unfixed = { $fix } { $satellites } sat
vehicle-gps-error = GPS error
vehicle-ekf-position = position known
vehicle-ekf-lost = no position
vehicle-ekf-velocity = velocity
vehicle-ekf-horizontal = position
vehicle-ekf-vertical = height
vehicle-ekf-compass = compass
vehicle-vibration = vibration { $axis }
vehicle-clipping = clipping
vehicle-limits = limits EKF 0.6/0.8, vibration 30/60 m/s²
vehicle-grade-good = ok
vehicle-grade-poor = poor
vehicle-grade-bad = BAD
vehicle-grade-old = old

vehicle-plan = plan
vehicle-plan-at = plan: item { $item } of { $last }
vehicle-plan-paused = plan: paused at item { $item } of { $last }
vehicle-plan-empty = empty
vehicle-plan-coming = reading { $received } of { $total }
vehicle-plan-unsupported = not supported by the vehicle
vehicle-plan-failed = not read: no answer
vehicle-leg = next
vehicle-leg-times = { $way }, end { $end }
vehicle-fence = fence
vehicle-rally = rally
vehicle-fence-breached = BREACHED

vehicle-outputs = outputs
vehicle-rc-rssi = RC signal { $rssi }
vehicle-texts = status texts

vehicle-sensors = sensors and functions
sensor-good = ok
sensor-poor = poor
sensor-bad = BAD
sensor-off = off
sensor-gyro = gyroscope
sensor-accelerometer = accelerometer
sensor-compass = compass
sensor-barometer = barometer
sensor-airspeed = airspeed
sensor-gps = GPS
# At most 18 columns.
sensor-gps-fix = GPS ({ $fix })
sensor-flow = optical flow
sensor-vision = vision
sensor-laser = rangefinder
sensor-ground-truth = ground truth
sensor-rate-control = rate control
sensor-attitude-control = attitude control
sensor-yaw-control = yaw control
sensor-height-control = height control
sensor-position-control = position control
sensor-motors = motor outputs
sensor-rc = RC receiver
sensor-gyro-2 = gyroscope 2
sensor-accelerometer-2 = accelerometer 2
sensor-compass-2 = compass 2
sensor-fence = fence
sensor-ahrs = AHRS
sensor-terrain = terrain
sensor-reverse-motor = reversed motors
sensor-logging = logging
sensor-battery = battery
sensor-proximity = proximity
sensor-satellite-link = satellite link
sensor-prearm = arming checks
sensor-avoidance = avoidance
sensor-propulsion = propulsion

vehicle-fence-areas = { $count ->
    [0] none
    [one] { $count } area
   *[other] { $count } areas
}
vehicle-rally-points = { $count ->
    [0] none
    [one] { $count } point
   *[other] { $count } points
}

vehicle-severity-emergency = emergency
vehicle-severity-alert = alert
vehicle-severity-critical = critical
vehicle-severity-error = error
vehicle-severity-warning = warning
vehicle-severity-notice = notice
vehicle-severity-info = info
vehicle-severity-debug = debug
vehicle-unexpected = not expected here: `all` leaves it out (`connect.expect`)
mode-of-another = mode { $mode } was not set by this console; GCS { $system }/{ $component } is on this link
