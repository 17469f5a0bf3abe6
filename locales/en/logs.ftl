# Logs of vehicles, joined to records.
log-is-none = not a DataFlash log: it has no format records
log-is-empty = the log contains no flight data
log-cut-off = the log is cut off: its last { $bytes } bytes are an incomplete record
log-damaged = the log is damaged: { $bytes } bytes belong to no record
log-left-out = { $count ->
    [one] { $count } event is left out: a log adds at most { $most } of each kind
   *[other] { $count } events are left out: a log adds at most { $most } of each kind
 }
log-unreadable = { $file }: { $error }
log-mode-why = mode { $mode } ({ $reason })
log-error = error { $part }: { $code }
log-event = event { $name }
log-parameter = { $name } = { $value } (was { $before })
log-vibration = vibration up to { $most } m/s²
log-clipping = { $count ->
    [one] accelerometers clipped once
   *[other] accelerometers clipped { $count } times
}
log-estimator = the EKF rejects the { $of }: test ratio up to { $most }
log-of-velocity = velocity
log-of-position = position
log-of-height = height
log-of-compass = compass
log-battery = battery { $number }: lowest { $volt } V at { $ampere } A
log-by-gps-time = GPS time and time since boot
log-by-boot-time = time since boot and arming
log-by-boot-time-only = time since boot only (log and record may belong to different flights)
log-by-arming = arming
log-no-vehicle = the log does not name its vehicle, and the record has { $count }: add `--vehicle`
log-not-in-record = the log is from vehicle { $vehicle }, which is not in the record
log-other-vehicle = the log is from vehicle { $named }, not from { $wanted }: leave out `--vehicle`
log-no-common-time = log and record have no time in common: the log belongs to another flight or boot
log-other-arming = where log and record overlap, only one of them shows the vehicle armed: the log belongs to another flight
log-other-mode = where log and record overlap, they show different modes: the log belongs to another flight
log-other-position = where log and record overlap, they show different positions: the log belongs to another flight
log-join-unreadable = the log data joined to the record cannot be read: { $error }
log-join-other = { $file } is left out: it belongs to vehicle { $vehicle }
log-join-later = the log data joined to the record was written by a newer version of sortie (format { $version }): update sortie
log-joined = { $count ->
    [one] { $count } event of vehicle { $vehicle } joined by { $by }: { $path }
   *[other] { $count } events of vehicle { $vehicle } joined by { $by }: { $path }
}
