# Telemetry of vehicles: notices, and words for reported values.

heard-mode = mode { $mode }
heard-armed = armed
heard-disarmed = disarmed
heard-disarmed-idle = disarmed: { $reason }
idle-no-takeoff = no takeoff within { $seconds } s
idle-on-ground = on the ground for { $seconds } s
carried-most = { $count ->
    [one] 1 of { $all } carries
   *[other] { $count } of { $all } carry
} { $list ->
    [plan] plan
    [fence] fence
   *[rally] rally points
} { $mark } ({ $items ->
    [one] 1 item
   *[other] { $items } items
})
carried-most-none = { $count ->
    [one] 1 of { $all } carries
   *[other] { $count } of { $all } carry
} no { $list ->
    [plan] plan
    [fence] fence
   *[rally] rally points
}
carried-differ = { $count ->
    [one] { $vehicles } differs
   *[other] { $vehicles } differ
}: { $details }
carried-other = { $vehicles } with { $items ->
    [one] 1 item
   *[other] { $items } items
} ({ $mark })
carried-none = { $vehicles } with none
carried-unread = not read yet: { $vehicles }
carried-unsupported = no such list: { $vehicles }

heard-event = event { $id } ({ $level })
heard-events-lost = { $count ->
    [one] { $count } event was lost: the vehicle no longer has it
   *[other] { $count } events were lost: the vehicle no longer has them
}
event-emergency = emergency
event-alert = alert
event-critical = critical
event-error = error
event-warning = warning
event-notice = notice
event-info = info
event-debug = debug
heard-plan-complete = plan flown to its end
heard-plan-back = plan went back from item { $before } to { $item }
heard-plan-skipped = plan went on from item { $before } to { $item }; not reported as reached: { $items }
heard-plan-unknown = item { $item } skipped: the vehicle does not know command { $command } in a plan
heard-plan-unknown-somewhere = an item was skipped: the vehicle does not know command { $command } in a plan
heard-control-free = no ground station is in control
heard-control-ours = this console is in control
heard-control-theirs = ground station { $station } has taken control
heard-control-request = ground station { $station } asks for control: `{ $allow }` lets it take over within 10 s, `{ $release }` gives control up
heard-control-closed = control can no longer be taken over without asking
heard-rebooted = rebooted
heard-renumbered = this vehicle is heard as vehicle { $system } now; `forget { $before }` removes the old number
heard-link-lost = link lost
heard-link-back = link back after { $seconds } s
heard-ekf-lost = EKF position lost
heard-ekf-good = EKF position good
heard-fix = GPS fix { $fix }
heard-fix-lost = GPS fix lost ({ $fix })
heard-fence = fence breached
heard-fence-low = fence breached (too low)
heard-fence-high = fence breached (too high)
heard-fence-boundary = fence breached (boundary)
heard-fence-back = back inside the fence
heard-two-vehicles = two vehicles answer as system id { $system }: change SYSID_THISMAV of one
heard-board = { $place }, board { $board }
heard-twice = vehicle { $system } is heard twice: { $used } (used), { $ignored } (ignored). It is one vehicle: close one of the links
heard-two-places = two senders use system id { $system }: { $used } (used), { $ignored } (ignored). If they are two vehicles, connect to one alone, give it another MAV_SYSID (SYSID_THISMAV up to ArduPilot 4.6) and reboot it
heard-flood = too many texts at once: the room "messages" shows those not listed here
heard-from-peer = { $link } (from { $peer })
heard-by-another-link = now received over { $link }, no longer over { $before }

fix-no-gps = no GPS
fix-none = no fix
fix-float = float
fix-other = other
