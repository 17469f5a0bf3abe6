# Lines of the command language: faults and completions.

grammar-no-command = a command is missing
grammar-no-command-help = such as `all arm` or `1-3 takeoff 20`
grammar-unknown-command = unknown command `{ $word }`
grammar-did-you-mean = did you mean `{ $name }`?
grammar-did-you-mean-any = did you mean { $names }?
grammar-targets-twice = the targets are named twice
grammar-needs = { $verb } needs { $missing }
grammar-for-example = for example `{ $line }`
grammar-too-much = unexpected `{ $word }`: no argument can follow here
grammar-say-it-as = write it as { $usage }
grammar-does-not-fit = `{ $word }` does not fit here: expected { $expected }
grammar-expected = expected { $expected }
grammar-nothing-more = nothing more
grammar-or = { $others } or { $last }
grammar-is-missing = { $argument } is missing

grammar-a-number = a number
grammar-in-unit = in { $unit }
grammar-range = { $least } to { $most }
grammar-range-in-unit = { $least } to { $most } { $unit }

grammar-none-selected = no vehicle is selected: select some, or name targets such as `all` or `1-3`
grammar-no-vehicles-yet = no vehicles yet
grammar-no-group = no group `@{ $group }`
grammar-group-empty = the group `@{ $group }` is empty
grammar-no-groups = no groups are defined
grammar-there-are = known: { $names }
grammar-empty-part = a number is missing next to the comma: write numbers and ranges as in `1-4,7`
grammar-backwards = `{ $range }` is reversed: use `{ $turned }`
grammar-no-targets = `{ $word }` names no vehicles: write a number, a range such as `1-4`, `@group` or `all`
grammar-no-vehicle-number = `{ $word }` is not the number of a vehicle: vehicles are numbered from 1 to { $highest }
grammar-no-vehicle = no vehicle { $vehicle }, only { $known }

grammar-not-whole = `{ $word }` is not a whole number
grammar-none-of = `{ $word }` is not one of { $choices }
grammar-no-number = `{ $word }` is not a number
grammar-out-of-range = `{ $word }` is out of range: { $limits }
grammar-too-large = `{ $word }` is too large
grammar-no-unit-here = `{ $word }`: this number takes no unit
grammar-wrong-unit = `{ $unit }` is not a unit for this: use { $known }
grammar-no-mode = unknown mode `{ $mode }`
grammar-no-mode-copter = a copter has no mode `{ $mode }`
grammar-no-mode-plane = a plane has no mode `{ $mode }`
grammar-no-mode-rover = a rover has no mode `{ $mode }`
grammar-no-mode-sub = a sub has no mode `{ $mode }`
grammar-no-area = unknown area `{ $area }`
grammar-area = area
grammar-no-items = `{ $word }` is not an item number or a range such as `3-5`
grammar-no-longitude = the longitude is missing after `{ $latitude }`: write both, as in `50.45 30.52`
grammar-no-plan-command = unknown plan command `{ $word }`
grammar-plan-commands = completion lists all commands, such as { $words }
grammar-no-plan-field = unknown parameter `{ $word }`
grammar-no-place = unknown place `{ $place }`
grammar-no-contact = no contact `{ $contact }`; known: { $known }
grammar-no-contact-yet = no contact `{ $contact }`: no contact has been found yet
grammar-no-parameter = `{ $word }` is not a parameter name: use 1 to 16 letters, digits and `_`
grammar-no-message = unknown message `{ $word }`
grammar-no-message-id = `{ $word }` is not a message id: the highest is { $highest }
grammar-secret-message = { $message } contains a key or a password, which this line would show and record
grammar-secret-message-signing = `signing setup` gives a vehicle its key
grammar-no-field = { $message } has no field `{ $field }`
grammar-fields = its fields: { $names }
grammar-field-twice = the field `{ $field }` is given twice
grammar-field-value = the value of `{ $field }` is missing
grammar-field-value-help = write each field as `NAME=VALUE`
grammar-field-open = the closing `{ $sign }` is missing
grammar-field-escape = unknown escape: write `\\`, `\"` or `\x41`
grammar-field-number = { $field } takes a number, not text
grammar-field-long = { $field } has room for { $most } bytes
grammar-field-list = { $field } is a list of up to { $most } numbers
grammar-field-list-help = write it as `{ $field }=[1,2]`
grammar-field-single = { $field } takes one value, not a list
grammar-field-elements = { $field } has only { $most } elements
grammar-no-enum-name = { $name } has no value `{ $word }`
grammar-no-mav-cmd = unknown MAV_CMD `{ $word }`
grammar-no-mav-cmd-number = `{ $word }` is not the number of a MAV_CMD: the highest is 65535

grammar-by-how-much = the distance is missing after `by`: write `by n 10`, `by e -5` or `by up 2`
grammar-keep-or-face = keep the heading or face another one, not both
grammar-heading-range = a heading is 0° to 360°; to turn left, use `by`, as in `yaw by -90`
grammar-which-way = the direction is missing: write `n`, `e`, `d` or `up` and a speed
grammar-down-or-up = use `d` or `up`, not both
grammar-small-circle = the radius must be at least 1 m
grammar-four-parameters = four parameters are required
grammar-unknown-word = unknown word

grammar-mode = mode
mode-guided = follow the commands of ground stations
mode-auto = fly the plan on board
mode-rtl = return to launch and land there
mode-smart-rtl = return along the path flown and land
mode-land = land where it is
mode-brake = stop and hold the position
mode-circle = circle a point
mode-follow = follow another vehicle
grammar-change-mode = change the mode to { $mode }
grammar-stick-sinks = the vehicle sinks while the throttle stick is down
grammar-stick-falls = the vehicle falls while the throttle stick is down
grammar-message = message { $id }
grammar-mav-command = command { $number }
grammar-every-vehicle = every vehicle
grammar-vehicle = vehicle

grammar-none-there = none
grammar-no-name = unknown name `{ $word }`
grammar-no-vehicles = `{ $word }` names no vehicles: write numbers, `@group`, `all`, `none`, `filter` or `invert`
grammar-largest-first = largest first
grammar-no-targets-here = `{ $verb }` is a console command: it takes no vehicles
grammar-only-plain = `{ $verb }` works in the plain console only; here, a room shows the same
grammar-only-console = `{ $verb }` works in the console only: a script cannot use it

grammar-script-selection = a script has no selection
grammar-say-who = name the vehicles, as in `{ $line }`
grammar-wait-timed-out = line { $line }: `{ $wait }` timed out
grammar-if-then = `if` needs `then` and a command, as in `if 3 alerted then 3 rtl`
grammar-if-state = write a state as the condition, as in `if 3 alerted then 3 rtl`
