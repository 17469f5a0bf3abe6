# Alerts of vehicles, and commands about alerts.

alert-motors-stopped = MOTORS STOPPED in the air
alert-crashed = CRASHED, disarmed
alert-crashed-at = CRASHED at { $speed } m/s
alert-link-lost = LINK LOST
alert-other-sender = heard from another sender
alert-process = SITL DOWN
alert-failsafe = FAILSAFE active
alert-gps-lost = GPS lost
alert-gps-glitch = GPS glitch
alert-position-jump = POSITION JUMPED by { $distance } km
alert-ekf-position = EKF no position
alert-ekf = EKF { $part } { $ratio }
alert-ekf-velocity = velocity
alert-ekf-where = position
alert-ekf-height = height
alert-ekf-compass = compass
alert-separation = TOO CLOSE to { $vehicle }: { $across } m, vertical { $height } m
alert-traffic = TRAFFIC { $name }: closest { $across } m, { $height } m vertical, in { $seconds } s
alert-battery-critical = BATTERY { $percent } %
alert-battery-low = battery low { $percent } %
alert-turn-back = turn back: { $left } % left, { $needed } % needed
alert-out-of-reach = HOME OUT OF REACH
alert-ceiling = above the ceiling of { $ceiling } m
alert-fence = outside fence
alert-vibration = vibration { $level }
alert-prearm = not ready to arm

alert-kind-crash = CRASHED
alert-kind-gps = GPS unreliable
alert-kind-ekf = EKF unreliable
alert-kind-separation = too close to each other
alert-kind-traffic = traffic
alert-kind-battery = battery low
alert-kind-way-home = turn back
alert-kind-vibration = vibration
alert-kind-message = serious message

alert-since = { $what }, since { $clock }
alert-of-one = { $vehicle }: { $what }
alert-of-many = { $count ->
    [one] { $count } vehicle: { $what }
   *[other] { $count } vehicles: { $what }
}
alert-with-vehicles = { $what }: { $vehicles }
alert-and-more = { $first } (+{ $count })
alert-acknowledge-hint = { $key } acknowledges
alert-header = { $count ->
    [one] ! { $count } alert
   *[other] ! { $count } alerts
}

alert-acknowledged = { $count ->
    [0] nothing to acknowledge
    [one] { $count } alert acknowledged: it stays in the table until it is over
   *[other] { $count } alerts acknowledged: they stay in the table until they are over
}
alert-muted = alerts muted: { $kind }
alert-unmuted = alerts no longer muted: { $kind }
alert-muted-list = muted: { $kinds }
alert-muted-none = no alerts are muted
alert-no-kind = unknown kind of alert: `{ $word }`
alert-kinds-are = kinds: { $kinds }
