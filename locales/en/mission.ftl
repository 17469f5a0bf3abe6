# The course of a mission: progress, notices, events.

mission-passed = passed
mission-failed = failed
mission-timed-out = timed out
mission-stopped = ended by the instructor
mission-abandoned = abandoned
mission-not-finished = not finished
mission-over = mission { $outcome }
mission-time-left = { $seconds } s left
mission-objective-met = objective met: { $objective }: { $result }
mission-objective-open = objective open again: { $objective } ({ $result })

mission-sensor-gas = gas
mission-sensor-particles = PM2.5

# Cells of a survey.
mission-cell-sampled = cell { $cell } sampled: { $count }/{ $all }
mission-cells = { $count ->
    [one] { $count } cell
   *[other] { $count } cells
}
mission-cells-of = { $sampled }/{ $count } cells
mission-cells-more = { $cells } and { $more } more
mission-cells-advice = Also sample { $cells }: { $dwell } s each, at most { $speed } m/s, { $low } to { $high } m high.

# The map made of them.
mission-map-none = no map
mission-map-error = error { $error }
mission-map-quality = map error { $error }
mission-map-slower = fly slower at { $height } m through the middle of each cell, and stay in it longer
mission-map-blank = also sample { $cell }, because a blank cell counts as clean air; { $how }
mission-map-advice = Map every cell at { $height } m with settled readings: fly slower, and turn outside the area.

# Coming home. Advice at the first place begins a sentence.
mission-recover-target = { $radius } m, { $percent } %
mission-recover-metres = { $distance } m
mission-recover-home = { $home }/{ $count } home
mission-recover-lost = drone lost
mission-recover-not-flown = not flown
mission-recover-in-air = in the air
mission-recover-away = { $distance } m from the pad
mission-recover-charge = { $percent } % left, { $needed } % needed
mission-recover-landing = not landed yet
mission-recover-fly = Take off, then land within { $radius } m of a pad, with at least { $percent } % battery left, and wait until the drone disarms: `rtl` lands there.
mission-recover-earlier = { $place ->
    [first] Come home before the battery is below { $least } %: you had { $percent } %
   *[later] come home before the battery is below { $least } %: you had { $percent } %
}
mission-recover-closer = { $place ->
    [first] Land within { $radius } m of a pad: you were { $distance } m away; `rtl` lands there
   *[later] land within { $radius } m of a pad: you were { $distance } m away; `rtl` lands there
}
mission-recover-disarm = { $place ->
    [first] Land and disarm before the time is up: `rtl` does both
   *[later] land and disarm before the time is up: `rtl` does both
}

# Rules broken.
mission-checks-bypassed = arming checks bypassed
mission-motors-stopped = motors stopped at { $height } m
mission-hit-ground = hit the ground at { $speed } m/s
mission-too-high = above { $height } m
mission-outside-fence = outside the fence "{ $fence }"
mission-off-pad = landed { $distance } m off the pad
mission-low-reserve = landed with { $percent } % battery: needs { $needed } %
mission-mine-cleared = the flail has set off a mine: cleared
mission-mine-set-off = drove onto a mine: lost
mission-not-stopped = not disarmed when the mission ended
mission-not-landed = in the air when the mission ended
mission-end-reserve = { $percent } % battery when the mission ended: needs { $needed } %
mission-battery-critical = battery critical
mission-battery-low = battery low

# Translations in mission files.
mission-untranslated = no `{ $key }`: the Ukrainian screens show the English text
mission-english-only = in English only: add `title_uk`, `brief_uk` and `text_uk` next to the English texts
mission-translation-empty = `{ $key }` is empty: remove it to show the English text

# The mission pane.
mission-pane = mission  { $elapsed } of { $limit }  score { $score }
mission-hint = hint: { $hint }
mission-landed = Landed. The flight ends when all reports are in and final: report what is missing, or wait.
mission-landed-short = Landed with objectives open, and no battery lasts for another flight. At { $limit }, the flight ends with the points reached; `abandon` ends it now without points.
mission-landed-last = Landed: the flight ends in a moment.
mission-home-armed = Vehicle { $vehicle } is back: `{ $vehicle } disarm` stops its motors.
mission-touchdown = Landed: the motors stop automatically, then the flight ends.
mission-returning = All drones in the air return or land. The flight ends after the last landing.
mission-returning-early = All drones in the air return or land, and objectives are still open: `guided` stops that, then `goto` continues the task.
mission-returning-short = All drones in the air return or land, and a battery is low: let them land. Objectives are still open.
mission-returning-failsafe = { $count ->
    [one] A failsafe brings down vehicle { $vehicles }: let it land.
   *[other] Failsafes bring down vehicles { $vehicles }: let them land.
} Objectives are still open.
mission-grounded = a failsafe has landed vehicle { $vehicle } ({ $reason }): take off again if the battery lasts; `abandon` ends the mission without points
mission-lesson = now: { $step }
mission-more-cells = more cells on a larger screen
# At most 6 columns.
mission-cell-done = done

# The room of the mission.
mission-begin = { $fly } flies it   { $back } goes back
mission-under-way = time { $elapsed } of { $limit }   score so far { $score }
mission-ended = ended after { $elapsed }   score { $score }   { $key } shows the debrief
mission-objectives = objectives
mission-required = mandatory
mission-hints = hints so far
mission-rules = rules
mission-rule-time = time
mission-rule-time-is = at most { $limit }, par { $par }
mission-rule-energy = energy
mission-rule-energy-is = par { $par } Wh
mission-rule-height = height
mission-rule-height-is = at most { $height } m above the pads
mission-rule-battery = battery
mission-rule-battery-is = land with { $percent } % or more
mission-rule-wind = wind
mission-rule-wind-is = { $speed } m/s from { $direction }°
mission-rule-calm = calm
mission-rule-drones = vehicles
mission-rule-sensors = sensors
mission-scoring = scoring, 1000 points
mission-weights = points
mission-medals = medals
mission-medals-are = gold from { $gold }, silver from { $silver }, bronze from { $bronze }
mission-gold-needs = gold needs
mission-rewards = for passing
mission-reward-credits = { $credits } credits
mission-reward-mission = mission "{ $title }"
mission-reward-part = part { $part }
mission-reward-threat = threat: { $threat }
mission-reward-vehicle = vehicle: { $kind }
mission-lines = lines { $first } to { $last } of { $count }   { $key } scroll
mission-vehicle-gone = its simulator has ended: the vehicle is lost

# A mission's answers to commands.
deed-over = the mission is over
deed-launched = only possible before takeoff
deed-no-position = its position is unknown
deed-other-kind = this mission needs no reports of `{ $kind }`; report { $kinds }
deed-no-contacts = all such contacts have been reported already
deed-no-contacts-yet = there are no contacts yet
deed-no-mark = no report within 15 m of that place
deed-marked-before = reported already
deed-marked = { $count } reported
deed-no-load = no suitable load on board
deed-exam-hint = exams give no hints
deed-workload-in-exam = exams do not ask for your workload
deed-no-hint = this mission has no further hint
deed-no-mission = no mission is being flown

mission-hint-given = { $percent ->
    [0] hint of level { $level } (free): { $hint }
   *[other] hint of level { $level } (-{ $percent } %): { $hint }
}
mission-goal-time = finish within { $seconds } s
mission-goal-time-result = { $seconds } s
mission-goal-battery = land with { $percent } % battery
mission-goal-battery-result = lowest charge { $percent } %
mission-goal-battery-unknown = battery not known
mission-goal-safety = break no rule
mission-goal-safety-result = { $count ->
    [one] { $count } rule broken
   *[other] { $count } rules broken
}
mission-goal-commands = no command refused
mission-goal-commands-result = { $count } refused
mission-goal-attention = answer every alert in time
mission-goal-attention-result = { $count } of { $all } late
mission-goal-score = { $points } points or more
mission-goal-score-result = { $points } points
# A pause.
mission-recalled = a situation was recalled: from here on, the flight is practice, and not recorded
mission-paused = paused for { $time }
# The whole program was stopped (Ctrl-Z) while the embedded simulator flew.
session-stopped = the console and the flight were suspended for { $time }
session-stopped-rules = the console was suspended for { $time }: the rules of this mission allow no pause, so `sortie verify` will reject its record
pause-begins = PAUSED: `continue` or { $key } resumes
pause-ends = resumed
pause-is-one = already paused
pause-is-none = not paused
pause-not-begun = nothing to pause: the clock starts when you leave the brief
pause-not-processes = no pause: ArduPilot keeps its own time
pause-not-real = no pause for real drones: `hold` stops them in the air
pause-recording = no pause here: `sortie replay FILE` plays a recording with pauses, jumps and other speeds
pause-not-allowed = the rules of this mission allow no pause
pause-refuses = the simulation is paused
pause-refuses-help = `continue` or { $key } resumes; then give the command
speedup-is = { $rate }x speed-up until the last movement ends or something needs you; { $key } ends it
speedup-idle = { $rate }x: time passes faster, but no command is in progress; { $key } ends it
speedup-usual = { $rate }x: time passes as usual
speedup-back = back to real time: { $reason }
speedup-back-to = back to { $rate }x: { $reason }
speedup-contact = new contact { $contact }
speedup-met = objective met: { $objective }
speedup-missed = objective missed: { $objective }
speedup-open = objective open again: { $objective }
speedup-done = { $verb } done, vehicle { $vehicle }
speedup-row = { $verb } { $state }, vehicle { $vehicle }
speedup-alert = alert { $alert }, vehicle { $vehicle }
speedup-same = already { $rate }x
speedup-nothing-to-wait-for = no command is in progress: give one first, or write `speedup 2`
speedup-limit = already { $most }x: faster is not allowed here
speedup-nothing = nothing to speed up: no flight is under way
speedup-not-processes = ArduPilot keeps its own time: choose the speed-up at the start with `--speedup`
speedup-not-real = no speed-up: real drones fly in real time
speedup-not-in-exams = an exam runs in real time
speedup-not-allowed = the rules of this mission do not allow a speed-up
speedup-too-much = too fast: at most { $most }x
speedup-too-little = too slow: at least { $least }x

# Before launch, in the room of the mission. Names at most 14 columns.
mission-launch = before takeoff
mission-pledge = stated before takeoff
mission-prediction = your score
mission-prediction-none = { $key } predicts it, as in `predict 800`; the debrief compares both
mission-prediction-is = { $points } predicted
mission-goal = your goal
mission-goal-none = { $key } sets one for `score`, `time`, `battery`, `safety`, `commands` or `attention`, as in `goal time 200s`
mission-reading = clock
mission-exam = exam
mission-exam-is = { $exam }, try { $number } of { $tries }, { $time } left
mission-reading-held = the instructor starts it
mission-reading-first = it starts when you leave the brief
mission-brief-left = the mission's clock runs now; { $key } pauses it
mission-reading-is = running; { $key } pauses it while you read
mission-reading-paused = paused; { $key } resumes
mission-then = to start
mission-then-is = { $drones } shows the drones and starts the clock, { $back } goes back, { $help } explains keys and commands
mission-contacts-count = contacts { $count }, reported { $reported }
mission-contacts-confirmed = contacts { $count }, confirmed { $confirmed }, reported { $reported }
mission-marks-count = reports { $count }
mission-pledge-line = stated: { $words }
mission-said-score = { $points } points

# Urgent alerts, over the full width of the screen; shorter in the header.
mission-alert = ! { $seconds } s: { $text }
mission-alert-short = ! { $seconds } s
mission-urgent-more = and { $count } more urgent
mission-radio-weak = ! weak radio link to { $vehicle }: { $margin } dB
inject-done = injected: { $what }

# Tries, hints and equipment, in the room of the mission.
mission-tries = your tries
mission-try = { $score } points, { $medal }
mission-try-best = { $score } points, { $medal }, best so far
mission-try-practice = { $score } points, practice
mission-try-unfinished = not finished
mission-next-hint = hint
mission-hint-price = { $percent ->
    [0] { $key } requests the next one, level { $level }: it is free
   *[other] { $key } requests the next one, level { $level }: it costs { $percent } % of the score
}
mission-hint-of = hint { $level }: { $hint }
mission-rule-carries = { $count ->
    [one] vehicle { $vehicles }
   *[other] vehicles { $vehicles }
}
mission-rule-carries-nothing = no sensor, no load
mission-rule-load = { $name } x{ $count }
mission-rule-areas = areas
mission-rule-area = { $meaning }: { $names }
