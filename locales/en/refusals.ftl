# Why a command is not possible for a vehicle now, or why the vehicle refused it. The vehicle is named next to it.

refused-not-heard = not in contact yet
refused-not-guided = { $verb } needs GUIDED: it is in { $mode }; use `{ $vehicle } guided` first
refused-guided-autopilot = { $verb } needs GUIDED, a mode of ArduPilot, which this vehicle does not run
refused-not-armed = { $verb } needs an armed vehicle: use `{ $vehicle } arm` first
refused-taking-off = still taking off: wait until `takeoff` shows `effect seen`, then { $verb }
refused-on-the-ground = { $verb } needs a flying vehicle: it is on the ground; use `{ $vehicle } takeoff 10` first, and wait until it has climbed
refused-too-low = { $metres } m above home is too low to fly to; use `{ $vehicle } land` to come down
refused-plane = it is a plane: use `LAT LON` or `by n .. e ..`, not metres from its origin
refused-no-position = no position received yet
refused-no-heading = no heading received yet
refused-no-height = no height received yet
refused-no-mode = it has no mode { $mode }
refused-mode-hidden = mode { $mode } is set by the vehicle itself only: it is marked as not selectable
refused-mode-autopilot = it does not run ArduPilot: its modes are not known by name; use `land` or `rtl`
refused-arm-in-the-air = it is in the air: arm it on the ground
refused-logs-armed = it is armed: disarm it before reading logs
refused-logs-nowhere = a downloaded log needs a data folder: start sortie with `--data DIR`
refused-no-log = it has no log { $number } (logs listed: { $count })
refused-plan-here = plans cannot be sent this way: use `plan upload`
refused-plan-autopilot = plans can be sent only to vehicles with ArduPilot
refused-plan-no-files = only the console reads plans from files
refused-plan-clear-auto = it is flying its plan: use `hold` and `guided` first
refused-plan-empty = the file has no items for: { $list }
refused-plan-file = { $file }:{ $line }:{ $column }: { $fault }; no vehicle was changed
refused-plan-extension = { $file }: unknown extension: use `.waypoints`, `.plan`, `.kml` or `.geojson`
refused-plan-blank = { $file }: the file is empty
refused-plan-format = { $file }: this format cannot hold the list; use `.waypoints` or `.plan`
refused-plan-exists = { $file } already exists: use another name, or `{ "{" }id{ "}" }` in the name for several vehicles
order-one-file = several vehicles cannot write one file: { $file }
order-one-file-help = `{ "{" }id{ "}" }` in the name stands for the number of the vehicle, as in `v{ "{" }id{ "}" }.plan`
refused-plan-item = item { $item }: { $reason }
refused-plan-no-list = the vehicle has no such list
refused-plan-faults = { $first }; { $more ->
    [one] { $more } more fault, which `sortie plan check` names
   *[other] { $more } more faults, which `sortie plan check` lists
}
refused-plan-unfamiliar = this console had not read the list on board: { $count ->
    [one] { $count } item
   *[other] { $count } items
} ({ $mark }); repeat the command to replace it
refused-plan-changed = another program has changed the list since this console first read or last wrote it: now { $count ->
    [one] { $count } item
   *[other] { $count } items
} ({ $mark }); repeat the command to replace it
refused-plan-none = no plan on board: use `plan upload` first
refused-plan-item-none = no item { $item }: the last is { $last }
refused-plan-unread = its plan has not been read: use `plan show` first
refused-plan-paused = it is already paused: `plan resume` continues
refused-plan-last = item { $item } is the last: `plan abort` returns, `plan goto` continues at another item
refused-plan-on-ground = it is on the ground: `plan start` begins the plan; to begin at a later item, take off first
refused-plan-over = it has flown its plan to the end: `plan resume from 1` flies it again
refused-plan-not-begun = it has not begun its plan: name an item, as in `plan resume from 1`
refused-plan-flown = it is already flying its plan, at item { $item }
refused-plan-mode = it is in { $mode }, not flying its plan: `plan resume` continues in AUTO, `rtl` returns
refused-plan-not-armed = it is not armed: `guided`, `arm`, then `plan start`
plan-result-command = the vehicle does not know command { $command } here
plan-result-frame = the vehicle does not know frame { $frame }
plan-result-parameter = parameter { $number } is not valid
plan-result-space = too many items for the vehicle
plan-result-denied = the vehicle is busy with another upload
plan-result-error = the vehicle refused it without giving a reason
plan-differs = the list read back differs from the list sent
hazard-message = sends { $message } as typed: { $fields }
hazard-message-empty = sends { $message } with all its fields 0
hazard-command = sends { $command }
hazard-plan-auto = a vehicle is flying its plan: it will follow the new one at once
hazard-plan-rehearsal = the rehearsal failed for { $vehicles }: { $reason }
hazard-plan-met = too close: { $pairs }
hazard-plan-rehearse-these = to rehearse only these plans: `{ $targets } plan rehearse`
hazard-plan-same = { $first } and { $second } carry the same plan: flown together, they would meet
hazard-plan-armed = a vehicle is armed
hazard-above-ceiling = leads above the ceiling of { $ceiling } m of the mission's fence ({ $fence }), which breaks a rule
hazard-outside-fence = leads out of the mission's fence ({ $fence }), which breaks a rule
hazard-outside-own-fence = leads { $vehicle } out of its own fence: ArduCopter drops such a target without an answer
hazard-fence-off = a vehicle is armed: without the fence, it can fly out of its area
refused-logs-here = logs cannot be read this way: use `logs list` or `logs download`
refused-logs-none-read = no list or download of logs is under way
refused-reboot-armed = it is armed: disarm it before a reboot
refused-parameter-name = `{ $name }` cannot be a parameter: names have 1 to 16 Latin letters, digits or `_`
refused-no-place = { $lat }, { $lon } is not a valid position
refused-not-finite = { $value } is not a number that can be sent
refused-parameter-type = the type of { $name } is not known yet: use `param get { $name }` first
refused-no-parameter = not sent: the vehicle has no parameter { $name }
refused-no-parameter-but = not sent: the vehicle has no parameter { $name }; did you mean { $nearest }?
refused-neither-parameter = not sent: the vehicle has neither { $name } nor { $other }
refused-neither-parameter-but = not sent: the vehicle has neither { $name } nor { $other }; did you mean { $nearest }?
refused-protected-parameter = { $parameter } is fixed by the mission: it can be set only in a practice flight
refused-protected-home = home is fixed by the mission: it can be moved only in a practice flight
refused-protected-limits = the fence and the rally points are fixed by the mission: they can be changed only in a practice flight
refused-protected-files = files on board may hold parameters, plans and scripts, which are fixed by the mission: they can be changed only in a practice flight
refused-files-none = the vehicle does not offer files (MAVFTP)
refused-files-nowhere = this session cannot read or write files of this machine
refused-files-here = files cannot be read or changed this way: use `ftp`
refused-files-idle = no command about files is under way
refused-file-large = the file has more than { $most } MiB
refused-protected-sticks = the sticks can be taken only in a practice flight
refused-sticks-here = channels cannot be held this way: use `rc`
refused-protected-raw = raw commands and messages are allowed only in a practice flight; use the verb for what you want to do
refused-protected-item = item { $item } ({ $command }) changes home or the fence, which are fixed by the mission: a plan with it can be uploaded only in a practice flight
refused-value = { $name } stayed { $value }: { $wanted } was not accepted

reason-no-orbit = this autopilot cannot orbit: use mode CIRCLE
reason-armed = it is armed
reason-flying = it is already flying
reason-takeoff-mode = it is in { $mode }: `guided`, then `takeoff`
reason-takeoff-arm = it is not armed: `arm`, then `takeoff`
reason-takeoff-mode-arm = it is in { $mode } and not armed: `guided`, `arm`, then `takeoff`
reason-in-the-air = it is in the air: use `land`, or `kill` to stop the motors
reason-speed-mode = it is in { $mode }, which takes no speed; change to GUIDED first
reason-px4-arm-mode = it cannot be armed in { $mode }; change to AUTO.LOITER first
reason-arm-mode = it cannot be armed in { $mode }; change to GUIDED first
reason-plan-pause = it can pause only on the way to a waypoint; `mode brake` stops it, then `plan resume` continues
reason-mode = it cannot enter { $mode } now
reason-not-now = not possible right now; try again
reason-not-in-control = station { $station } is in control of it: `{ $line }` asks for control
reason-other-station = another ground station is in control of it
reason-control-asked = station { $station } is in control and was asked: it can allow the takeover or release the vehicle; then request control again
refused-no-control = the vehicle announces no station in control (CONTROL_STATUS): every station may command it
refused-control-not-here = this console is not in control of it: `control request` comes first
reason-denied = the vehicle does not accept these values
reason-unsupported = this autopilot does not know the command
reason-failed = the vehicle gave no reason
reason-cancelled = superseded by another command
reason-long-only = the vehicle accepts this command only as COMMAND_LONG
reason-int-only = the vehicle accepts this command only as COMMAND_INT
reason-frame = the vehicle does not know the coordinate frame
reason-other = result { $number }

# Vehicles with PX4
refused-px4-guided = PX4 has no GUIDED and needs none: use `goto` or `takeoff` in any mode
refused-px4-velocity = PX4 flies at a velocity only in OFFBOARD, after a stream of setpoints that the console does not send: use `goto`
refused-px4-vertical-speed = PX4 takes no climb or descent speed by command: set its parameters MPC_Z_VEL_MAX_UP and MPC_Z_VEL_MAX_DN
refused-px4-turn-rate = PX4 takes no turn rate by command: leave it out, or set its parameter MPC_YAWRAUTO_MAX
refused-px4-servo = PX4 has no command for one servo output: `long DO_SET_ACTUATOR` sets actuators
refused-px4-relay = PX4 has no command for relays; only ArduPilot has one
refused-px4-fence = PX4 does not switch its fence by command: set its parameter GF_ACTION
refused-px4-resume = PX4 has no pause to continue from: use `plan resume`
refused-px4-plan-item = PX4 does not set the plan item by this command, which only ArduPilot takes
