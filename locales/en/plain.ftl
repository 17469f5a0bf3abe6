# The console without a screen.

plain-greeting = plain console: one command per line, `help` lists them, `quit` leaves
plain-asks = { $question }: { $reason }; type { $answer } and Enter to do it, anything else takes it back
plain-wait-in-vain = waited in vain: { $line }
plain-no-room = that is for the console with a screen
plain-critical = CRITICAL
plain-error = ERROR
plain-warning = warning
plain-times = { $count } times
plain-hint = hint: { $hint }
plain-objective-open = objective open: { $objective }
plain-objective-met = objective met: { $objective }
plain-objective-missed = objective missed: { $objective }
plain-score = score so far: { $score } of 1000
plain-time-left = time left: { $seconds } s
plain-vehicle = vehicle { $vehicle }: { $state }
plain-armed = armed
plain-disarmed = disarmed
plain-flight = height { $height } m, speed { $speed } m/s
plain-home = { $distance } m from home
plain-battery = battery { $percent } %
plain-help-status = status [TARGETS]: how vehicles are: 1-4,7  @red  all
plain-help-objectives = objectives: how the mission stands
plain-help-wait = wait TARGETS ... timeout 30s: holds the lines that follow, as in a pilot script
plain-link = { $name }: { $state }, { $received } messages a second in, { $sent } out, { $lost } lost
