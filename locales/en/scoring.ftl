# Points, the reasons for them, and how to earn more.

scoring-objective = objective
scoring-quality = quality
scoring-time = time
scoring-energy = energy
scoring-safety = safety
scoring-command = command
scoring-attention = attention
scoring-utilisation = utilisation
scoring-crashes = crashes

# Conditions of gold.
gate-no-crash = no vehicle lost
gate-at-least = { $what }: at least { $number }
gate-at-most = { $what }: at most { $number }
gate-equal = { $what }: exactly { $number }

scoring-gold = gold
scoring-silver = silver
scoring-bronze = bronze

# The reasons for the value of a component.
scoring-all-met = { $count ->
    [one] the objective is met
   *[other] all { $count } objectives met
}
scoring-missed = missed: { $objectives }
scoring-missed-capped = missed: { $objectives }; a mandatory objective is missed, so capped at { $most }
scoring-needs-mandatory = needs all mandatory objectives
scoring-needs-objectives = needs { $percent } % of the objectives
scoring-seconds = s
scoring-watt-hours = Wh
scoring-at-par = at par
scoring-inside-par = { $by } { $unit } under par
scoring-over-par = { $by } { $unit } over par
scoring-no-rule-broken = no rule broken
scoring-rules-broken = { $worst }; other rules broken: { $more }
scoring-no-commands = no commands
scoring-commands-clean = { $count ->
    [one] { $count } command, not refused
   *[other] { $count } commands, none refused
}{ $vehicles ->
    [one] {""}
   *[other] ; counted per vehicle
}
scoring-commands-forgiven = { $count ->
    [one] 1 command
   *[other] { $count } commands
}, { $forgiven ->
    [one] 1 refusal
   *[other] { $forgiven } refusals
} forgiven
scoring-commands-faulty = { $faults }; { $count ->
    [one] 1 command
   *[other] { $count } commands
}{ $vehicles ->
    [one] {""}
   *[other] , counted per vehicle
}
scoring-rejected = { $count } refused
scoring-unsafe = { $count } unsafe
scoring-twice = { $count } given twice

# Advice for more points.
scoring-improve-quality = Raise the quality from { $from } to { $to } ({ $now }).
scoring-improve-quality-how = Raise the quality from { $from } to { $to } ({ $now }): { $how }.
scoring-be-faster = Save { $seconds } s to reach par.
scoring-use-less = Save { $energy } Wh to reach par.
scoring-advice-commands = Avoid refused commands: read the reason before you repeat one.
scoring-advice-unsafe = Avoid unsafe commands: never stop motors in the air, and let the arming checks pass.
scoring-advice-twice = Give each command once: wait for its effect before you repeat it.
scoring-advice-mandatory = Meet every mandatory objective, or the score is capped. Missed: { $objectives }.
scoring-advice-geofence = Stay inside the fence: check the numbers of a `goto` against the map before you send it.
scoring-advice-height = Stay below the height limit; the brief states it.
scoring-advice-crash = Lose no vehicle: bring a drone down with `rtl` or `land` until it disarms, and drive a robot no faster than the brief says.
scoring-advice-motors = Never stop motors in the air: use `rtl` or `land` to end a flight.
scoring-advice-force = Arm without force: wait until the arming checks pass.
scoring-advice-reserve = Return earlier: land above the battery reserve.
scoring-advice-land = Land every drone before the mission ends.
scoring-advice-pad = Land on the pad: `rtl` flies there automatically.
scoring-advice-battery = Return before the battery failsafe takes over.
scoring-advice-failsafe = Watch the vehicle's alerts: a failsafe took over.

# Attention.
scoring-alerts-answered = { $count ->
    [one] { $count } alert, answered in time
   *[other] all { $count } alerts answered in time
}
scoring-alerts-late = { $worst }; { $more } more late
scoring-alert-unanswered = { $alert }: not answered
scoring-alert-took = { $alert }: { $seconds } s (limit { $limit } s)
scoring-advice-alerts = Answer alerts in time: hold first, then read. "{ $alert }" was due within { $limit } s.

# Utilisation.
scoring-none-flown = no vehicle was used
scoring-never-flown = vehicles never used: { $vehicles }
scoring-idle = vehicle { $vehicle } idle for { $time }
scoring-never-idle = none of the { $count } vehicles was idle
scoring-advice-unused = Also use vehicle { $vehicle }: give it a part of the task.
scoring-advice-idle = Give vehicle { $vehicle } its next task before it finishes the current one: it waited { $time }.
scoring-advice-slack = Keep all vehicles busy for about the same time: give each its next task before it finishes the current one.

# Hints.
scoring-advice-hints = { $count ->
    [one] Fly it again without the hint.
   *[other] Fly it again without the { $count } hints.
}

# Rules of the air.
scoring-advice-no-fly = Plan around no-fly zones. If one appears around a drone, stop first, then leave the zone by the shortest way.
scoring-advice-separation = Keep drones apart: give each its own height or its own area before they cross.
scoring-advice-aircraft = Keep clear of aircraft: descend or land at once, and wait until they have passed.
scoring-advice-people = Stop when people come near, and fly high over those who stay.
