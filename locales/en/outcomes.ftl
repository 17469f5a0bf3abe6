# Outcomes of commands: states in a few words, and explanations.

state-queued = queued
state-sent = sent
state-sent-again = sent, try { $tries }
state-percent = in progress { $percent } %
state-in-progress = in progress
state-accepted = accepted
state-done = effect seen
state-over = effect ended
state-no-effect = no effect
state-rehearsal-failed = failed
state-refused = refused
state-timed-out = timed out
state-superseded = superseded
state-overtaken = superseded
state-count = { $count } { $state }
state-of-all = { $vehicles }: { $states }
state-explained = { $count ->
    [one] vehicle { $vehicles }: { $text }
   *[other] vehicles { $vehicles }: { $text }
}

outcome-verb-accepted = { $verb } accepted
outcome-verb-in-progress = { $verb } in progress
outcome-verb-cancelled = { $verb } cancelled: { $reason }
outcome-verb-refused = { $verb } refused: { $reason }
outcome-plan-covers = covers { $percent } % of the area: the sensor's strip is { $strip } m wide, the lines are { $spacing } m apart
outcome-superseded = by { $by }
outcome-the-reboot = the reboot
outcome-answer-lost = seen in telemetry; the answer was lost
outcome-fell-silent = it reported progress, then nothing more
outcome-no-answer = { $tries ->
    [one] no answer to { $tries } try in { $seconds } s
   *[other] no answer to { $tries } tries in { $seconds } s
}
outcome-no-parameter = the vehicle may not have the parameter { $name }
outcome-value-became = { $name } = { $value } (requested: { $wanted })
outcome-other-name = { $outcome } (this vehicle's name for { $name })
outcome-opposite-name = { $outcome } (this vehicle's name for { $name }, with the opposite meaning)
outcome-not-seen = not seen: { $effect }
outcome-not-seen-within = not seen within { $seconds } s: { $effect }
outcome-offboard-kept = still in OFFBOARD 5 s after the command to hold; setpoints are no longer sent, so its failsafe decides
outcome-other-target = the vehicle keeps its earlier target; is the new one outside its fence?
outcome-no-target = the vehicle stands still and reports no target; is the place outside its fence?
outcome-overtaken = by { $mode }
outcome-crashed = by a crash
outcome-disarmed = by disarming
outcome-disarmed-idle = by disarming: { $reason }
outcome-armed = by arming
outcome-ended = ended { $by }
outcome-not-sent = not sent: { $reason }
outcome-too-late = not sent: expired after { $seconds } s in the queue
outcome-queue-full = not sent: { $count } commands are already waiting for this vehicle
outcome-forgotten = the vehicle was forgotten
outcome-not-heard = not sent: no contact with this vehicle
outcome-task-busy = not sent: the console cannot keep up with this vehicle

# A list that has been kept since a transfer was interrupted.
plan-broken-off = an upload of its { $verb ->
    [plan] plan
    [fence] fence
   *[rally] rally points
} was interrupted; the old list is kept: `{ $verb } upload { $file }` restores it
plan-broken-off-empty = an upload of its { $verb ->
    [plan] plan
    [fence] fence
   *[rally] rally points
} was interrupted; there was no list before: `{ $verb } clear` removes what is left

# Expected effects, inserted into outcome-not-seen and similar messages.
effect-nothing = an effect
effect-armed = armed
effect-disarmed = disarmed
effect-mode = mode { $mode }
effect-still = standing still
effect-landed = on the ground
effect-returned = back at home or its rally point
effect-altitude = { $metres } m above home, within { $tolerance } m
effect-taken-off = takeoff ended at { $metres } m or higher
effect-place = within { $metres } m of the target
effect-heading = heading { $degrees }°
effect-velocity = flying at this velocity
effect-plan-item = item { $item } is current
effect-plan-flown = flying the plan in AUTO at item { $item }
effect-home = home moved
effect-servo = output { $output } at { $pulse } us
effect-control = this console in control
effect-no-control = no station in control
effect-rebooted = rebooted
outcome-unmeasured-speed = accepted, but without an airspeed sensor the plane flies by its throttle (TRIM_THROTTLE)
outcome-renumbered = it is heard as vehicle { $system } now

# The logs of a vehicle.
outcome-sticks-held = channels held: { $channels }; `rc release` gives them back
outcome-sticks-unsure = whether the vehicle obeys station { $own } is unknown: read its SYSID_MYGCS (MAV_GCS_SYSID from ArduPilot 4.7)
outcome-sticks-released = all channels given back to the transmitter
outcome-logs-none = the vehicle has no logs
outcome-logs-listed = { $count ->
    [one] 1 log, { $size } kB: { $logs }
   *[other] { $count } logs, { $size } kB: { $logs }
}
outcome-log-listed = { $number } ({ $size } kB)
outcome-log-listed-at = { $number } ({ $size } kB, { $time })
outcome-logs-kept = { $size } kB saved in { $files }
outcome-logs-kept-by = { $size } kB saved { $ways }: { $files }
outcome-log-by-messages = by log messages
outcome-log-by-file = by MAVFTP
outcome-log-sum-same = checksum verified
outcome-log-sum-other = read twice: the checksum differs from the vehicle's
outcome-log-sum-grown = no checksum: the vehicle was still writing this log (it does so for 15 s after disarming); repeat the download later
outcome-log-sum-none = no checksum: { $reason }
outcome-log-no-file = no file of the listed size
outcome-folder-empty = the folder is empty
outcome-folder = { $count ->
    [one] { $count } entry: { $names }
   *[other] { $count } entries: { $names }
}
outcome-folder-made = folder { $path } made
outcome-file-removed = { $path } removed
outcome-file-got = copied to { $file }: { $bytes } B, checksum not verified
outcome-file-got-verified = copied to { $file }: { $bytes } B, checksum verified
outcome-file-put = copied to the vehicle: { $bytes } B, checksum not verified
outcome-file-put-verified = copied to the vehicle: { $bytes } B, checksum verified
outcome-file-checksum = checksum (CRC-32) { $sum }
outcome-file-differs = the copy differs from the file: their checksums are not equal; copy it again
outcome-files-stopped = stopped
outcome-logs-stopped = stopped; the part already read is kept; repeat the download to continue
outcome-plan-written = { $count ->
    [one] { $count } item
   *[other] { $count } items
} ({ $mark }), read back and compared
outcome-plan-warned = { $count ->
    [one] warning: { $warnings }
   *[other] warnings: { $warnings }
 }
outcome-plan-warned-more = warnings: { $warnings }; { $more } more
outcome-plan-same = { $count ->
    [one] { $count } item ({ $mark }) was
   *[other] { $count } items ({ $mark }) were
} already on board
outcome-plan-read = { $count ->
    [one] { $count } item
   *[other] { $count } items
} ({ $mark })
outcome-plan-saved = { $count ->
    [one] { $count } item
   *[other] { $count } items
} saved: { $file }
outcome-plan-kept = { $reason }; the old list is still on board
outcome-plan-restored = { $reason }; the old list was restored
outcome-plan-unread = no answer from the vehicle; nothing was changed
outcome-plan-neither = the vehicle now holds neither the new list nor the old one, but { $count ->
    [one] { $count } item
   *[other] { $count } items
} ({ $mark }): upload the list again before you fly
outcome-plan-unknown = the list on board is unknown: check it with `{ $list } show` before you fly
plan-stage-lost = the link is lost: the transfer continues when it is back
plan-stage-restoring = the old list is being restored
outcome-logs-silent = the vehicle does not answer the request for its logs
outcome-log-stalled = the vehicle stopped sending log { $number }: { $percent } % of it saved; repeat the download to continue
outcome-logs-armed = the vehicle sends no logs while armed: { $percent } % of log { $number } saved; disarm it and repeat the download to continue
outcome-log-length = { $file } has { $bytes } bytes, but the vehicle lists { $expected }: repeat the download

outcome-plan-left = no part for { $vehicles } now, but an earlier plan is still on board: `{ $vehicles } plan clear` removes it
outcome-plan-share = parts for { $count } of { $all }: { $why }
outcome-plan-idle = no part for this vehicle: { $reason }; its plan on board is cleared
rehearse-in-air = in the air: a rehearsal begins on the ground
rehearse-kind = it is a { $kind }: a rehearsal can fly copters only; check the plan with `sortie plan check`
rehearse-waits = waiting for the plans of { $vehicles }, which are being sent or read
rehearse-unread = the plan on board has not been read yet: `plan show` reads it
rehearse-no-plan = no plan on board
rehearse-refused = the simulator refuses the plan, fence or rally points of vehicle { $vehicle }
rehearse-landed = lands after { $time }; uses { $used } % of the battery, { $left } % left
rehearse-ends-in-air = the plan ends in the air after { $time }; uses { $used } % of the battery
rehearse-battery = uses { $used } % of the battery: more than is left
rehearse-meets = comes too close to another vehicle; flight time { $time }
rehearse-fence = breaches its fence after { $time }
rehearse-left-plan = leaves its plan for { $mode }; flight time { $time }
rehearse-grounded = does not take off
rehearse-crashed = collides after { $time }
rehearse-replay = recorded: `replay rehearsal` plays it on the map
rehearse-unwritten = the rehearsal was not recorded: { $reason }
rehearse-hit-ground = flies into the ground after { $time }, on the way to item { $number }
rehearse-time-up = still flying after { $time }
rehearse-conflict = rehearsal: { $a } and { $b } come too close at { $time }: { $horizontal } m horizontally, { $vertical } m vertically
rehearse-late = rehearsal: { $a } and { $b } come too close if one of them is { $late } s late
rehearse-more = rehearsal: { $count ->
    [one] { $count } more pair comes
   *[other] { $count } more pairs come
} too close, on time or with one vehicle late
rehearse-conditions = rehearsal: { $conditions }
rehearse-parameters-unread = parameters of { $vehicles } not read, so the defaults apply
rehearse-wind-given = wind { $speed } m/s from { $from }° (given)
rehearse-wind-estimated = wind { $speed } m/s from { $from }° (estimated by { $vehicle })
rehearse-wind-estimated-at = wind { $speed } m/s from { $from }° at { $height } m (estimated by { $vehicle })
rehearse-wind-mission = wind { $speed } m/s from { $from }° (set by the mission)
rehearse-wind-simulator = wind { $speed } m/s from { $from }° (`SIM_WIND_SPD`)
rehearse-wind-unknown = calm air (wind unknown); `plan rehearse wind 270 8` sets a wind
rehearse-airframes-own = airframes of the session's drones
rehearse-airframes-standard = standard airframe
rehearse-airframes-mixed = airframes of the session's drones; the standard airframe for { $vehicles }
rehearse-closest = rehearsal: { $a } and { $b } come closest, at { $time }: { $horizontal } m horizontally, { $vertical } m vertically
