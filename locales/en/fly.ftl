# The flight screen: table, telemetry, notices; also the header and footer of every screen.

prompt-filter = show only

fly-swarm = swarm
fly-notices = notices
traffic-title = traffic
traffic-none = no other aircraft is known
traffic-aircraft = { $name }: { $height } m above sea level, course { $course }, { $speed } m/s, climb { $climb } m/s, { $age } s old
traffic-approach = vehicle { $vehicle }: now { $distance } m, { $height } m vertical; closest in { $seconds } s: { $across } m, { $above } m vertical
traffic-leaves = vehicle { $vehicle }: now { $distance } m, { $height } m vertical; comes no closer
fly-no-flight = no flight is under way: `leave` goes to Home, where you choose one
fly-waiting = waiting for the first vehicle ...
fly-rows = { $first }-{ $last } of { $count }
fly-filtered = { $shown } of { $all } match "{ $filter }"
fly-none-fit = no vehicle matches "{ $filter }": { $key } clears the filter
fly-by = by { $column }
fly-selected = selected { $count }: { $vehicles }
fly-selected-hidden = selected { $count } ({ $hidden } hidden): { $vehicles }
fly-sorted = sorted by { $column }; { $key } reverses the order
fly-sorted-reversed = sorted by { $column }, largest first
fly-no-column = unknown column `{ $word }`
fly-columns-are = columns: { $columns }
fly-no-group = no group `{ $name }`
forget-done = forgotten: { $vehicles }
forget-heard = { $vehicles }: in contact; only vehicles whose link is lost can be forgotten
forget-none-lost = no vehicle has lost its link: nothing to forget
forget-not-here = simulated vehicles cannot be forgotten; `forget` works with `connect` only
fly-ungrouped = group @{ $name } removed
fly-place = { $at } of { $count }
fly-log-keys = { $scroll } scroll   { $key } close
fly-nothing-yet = nothing yet

fly-armed = ARMED
fly-ready = ready
fly-off = off
fly-ground = ground
fly-air = air
fly-moving = moving
fly-still = still
fly-takeoff = takeoff
fly-paused = paused
fly-landing = landing
fly-lost = LOST
fly-done = done
fly-over = ended
fly-own = you
fly-no-effect = no effect
fly-timed-out = timed out
fly-try = try { $count }

column-id = id
column-name = name
column-group = group
column-pilot = pilot
column-mode = mode
column-armed = armed
column-state = state
column-alt = alt m
column-speed = m/s
column-bat = bat
column-gps = GPS
column-link = link
column-home = home m
column-command = command
column-to-go = to go m
column-heading = hdg
column-climb = climb
column-volt = volt
column-amps = amps
column-used = mAh
column-hdop = HDOP
column-round-trip = ms
column-ekf = EKF
column-vibe = vibe
column-item = item
column-next = next
column-end = end
column-sea = sea m
column-lat = latitude
column-lon = longitude
column-alert = alert

severity-emergency = EMERG
severity-alert = ALERT
severity-critical = CRIT
severity-error = ERROR
severity-warning = WARN
severity-notice = note
severity-info = info
severity-debug = debug

telemetry-title = telemetry
telemetry-vehicle = vehicle { $vehicle }  { $name }
telemetry-mode = mode
telemetry-height = height
telemetry-speed = speed
telemetry-battery = battery
telemetry-return = return
telemetry-home = home
telemetry-target = target
telemetry-place = position
telemetry-gps = GPS
telemetry-ekf = EKF
telemetry-attitude = attitude
telemetry-link = link
telemetry-reboots = reboots
telemetry-wind = wind
telemetry-vibration = vibe
telemetry-ground = ground
telemetry-plan = plan
telemetry-rc = RC
telemetry-servos = servos
telemetry-load = CPU
telemetry-firmware = firmware
telemetry-no-heartbeat = no heartbeat yet
telemetry-armed = ARMED
telemetry-disarmed = disarmed
telemetry-altitudes = { $altitude } m  climb { $climb }  sea { $sea } m
telemetry-sea = sea { $sea } m
telemetry-speed-heading = { $speed } m/s  heading { $heading }°
telemetry-speed-alone = { $speed } m/s
telemetry-here = here
telemetry-way-home = { $needed } % ({ $time } of { $lasts })
telemetry-bearing = { $distance } m  bearing { $bearing }°
telemetry-away = { $distance } m away
telemetry-at = at { $altitude } m
telemetry-satellites = { $count ->
    [one] { $count } satellite
   *[other] { $count } satellites
}
telemetry-ekf-ok = ok
telemetry-ekf-lost = no position
telemetry-roll-pitch = roll { $roll }°  pitch { $pitch }°
telemetry-link-lost = LOST { $seconds } s ago
telemetry-round-trip = RTT { $ms } ms
telemetry-wind-from = { $speed } m/s from { $from }°
telemetry-vibrations = { $levels } m/s²  clipped { $clipped }
telemetry-below = { $metres } m below
telemetry-item = item { $item } of { $total }
telemetry-item-times = { $item }/{ $total }: { $way }, end { $end }
telemetry-item-paused = { $item }/{ $total }: paused, { $way }
telemetry-paused = paused

landed-unknown = unknown
landed-ground = on ground
landed-air = in air
landed-moving = moving
landed-still = standing still
landed-takeoff = taking off
landed-landing = landing

header-armed = { $vehicles }, { $armed } armed
header-armed-short = { $armed }/{ $all } armed
header-dropped = { $count ->
    [one] { $count } notice dropped
   *[other] { $count } notices dropped
}
header-dropped-short = { $count } dropped
header-no-link = no link
header-link-up = link up
header-link-silent = link open, no data
header-link-down = { $name } down
header-links = { $up }/{ $all } links up
header-links-short = links { $up }/{ $all }

footer-vehicles = vehicles
footer-list = { $submit } selects   { $commands } write a command   { $escape } clears
footer-deaf = keys are ignored for a moment
footer-paste-lines = nothing was pasted: the text has { $count } lines, and the command line accepts one
footer-paste-dropped = nothing was pasted: open the command line with { $key } first

hint-move = move
hint-take = choose
hint-command = command
hint-help = help
hint-commands = commands
hint-quit = quit
hint-select = select
hint-list = by number
hint-all = all
hint-none = none
hint-filter = filter
hint-sort = sort
hint-acknowledge = ack
hint-look-back = history
hint-rooms = rooms
hint-open = open
hint-outcome = outcome
hint-own = vehicle
hint-back = back
hint-scroll = scroll
hint-again = fly again
hint-home = home

commands-pane = ledger
commands-none = no command yet: press { $key } and type one
commands-none-replayed = no command so far
commands-none-fit = no command matches: { $key } shows all
commands-follows = follows the newest
commands-only-vehicles = { $count ->
    [1] only vehicle { $vehicles }: { $shown } of { $all }
   *[other] only vehicles { $vehicles }: { $shown } of { $all }
}
commands-only-failed = only failed commands
commands-only-under-way = only running commands
commands-only-done = only finished commands
commands-time = time
commands-line = command
commands-to = to
commands-answer = answer
commands-outcome = outcome
commands-tries = tries
commands-more = ... { $count } more: { $key } shows all
commands-sent-times = { $count ->
    [0] not sent
    [one] sent once
   *[other] sent { $count }x
}
hint-vehicle = vehicle
hint-window = window
hint-page = page
hint-cursor = cursor
hint-zoom = zoom
hint-fit = all
hint-follow = follow
hint-goto = goto
hint-ruler = ruler
hint-signs = legend
hint-trails = trails

header-paused = PAUSED
header-speedup = { $rate }x
window-over = finished
window-paused = paused
window-reading = brief
window-armed = { $armed } of { $all } armed
window-ground = on the ground
header-reading = clock not started
hint-predict = predict
hint-goal = goal
hint-hint = hint
hint-pause = pause
hint-abandon = give up
hint-section = section
hint-new-try = new try
hint-alike = practise
hint-next = next
hint-fly = fly it
hint-start = start
hint-drill = drill
hint-truth = truth
