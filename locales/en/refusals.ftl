# Why a command makes no sense for a vehicle now, or why the vehicle refused it. The vehicle is named beside it.

refused-not-heard = it has not been heard yet
refused-not-guided = { $verb } needs GUIDED: it is in { $mode }; say `{ $vehicle } guided` first
refused-not-armed = { $verb } needs an armed vehicle: say `{ $vehicle } arm` first
refused-taking-off = { $verb } would break off a takeoff: it is still taking off: wait
refused-on-the-ground = { $verb } needs a flying vehicle: it is on the ground; say `{ $vehicle } takeoff 10` first, and wait until it has climbed
refused-too-low = { $metres } m above home is too low to fly to; say `{ $vehicle } land` to come down
refused-plane = it is a plane: it goes to LAT LON or `by n .. e ..`, not to local metres
refused-no-position = it has not said where it is
refused-no-heading = it has not said where its nose points
refused-no-height = it has not said how high it is
refused-no-mode = it has no mode { $mode }
refused-arm-in-the-air = it is in the air: arm it on the ground
refused-reboot-armed = it is armed: disarm it before a reboot
refused-parameter-name = `{ $name }` cannot be a parameter: names have 1 to 16 plain letters
refused-no-place = { $lat }, { $lon } is no place on the earth
refused-not-finite = { $value } is not a number that can be sent
refused-value = { $name } stayed { $value }, it did not take { $wanted }
refused-encoding = { $command } is not sent as { $message }

reason-no-orbit = this autopilot cannot orbit; mode CIRCLE can
reason-not-armed = it is not armed
reason-armed = it is armed
reason-flying = it is flying already
reason-takeoff-mode = it is in { $mode }, takeoff needs GUIDED
reason-in-the-air = it is in the air; land it, or say kill to stop the motors
reason-arm-mode = { $mode } is not armable; change to GUIDED first
reason-mode = it cannot enter { $mode } now
reason-not-now = not possible just now, try again
reason-denied = the vehicle does not take these values
reason-unsupported = this autopilot does not know the command
reason-failed = the vehicle gave no reason
reason-cancelled = another command took its place
reason-long-only = the vehicle wants it as COMMAND_LONG
reason-int-only = the vehicle wants it as COMMAND_INT
reason-frame = the vehicle does not know the coordinate frame
reason-other = result { $number }
