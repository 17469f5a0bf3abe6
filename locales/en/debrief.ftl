# The debrief, 80 columns wide.

debrief-head = DEBRIEF  { $mission } r{ $revision }   { $title }   { $outcome }
debrief-score = Score { $score } / 1000   { $medal }   seed { $seed }   { $backend }
debrief-source = { $mission } r{ $revision }   seed { $seed }   { $backend }
debrief-no-medal = no medal
debrief-embedded = embedded
debrief-time = Time { $used } (par { $par }, limit { $limit })   Energy { $energy }   Drones { $count }
debrief-energy = { $used } Wh (par { $par })
debrief-energy-unknown = not reported

# Headings stand over columns: at most 36 for the objectives, 13 for the result, 11 for the target,
# 12 for the components, 6 for weight and value, 8 for points.
debrief-instructor = INSTRUCTOR
debrief-objectives = OBJECTIVES
debrief-result = result
debrief-target = target
debrief-objective-result = { $result }; target: { $target }
debrief-points = points
debrief-components = COMPONENTS
debrief-weight = weight
debrief-value = value
debrief-moved = why
# At most 8 columns.
debrief-sum = score
gold-without-commands = no hint that gives the commands
gold-points = { $points } points
gold-mandatory = all mandatory objectives
debrief-gold-needs = gold needs { $gates }

debrief-timeline = TIMELINE   (> 2-9 commands  o objective  ! alert  x rule  r refused  . other)
# One row for several commands in succession; never for one.
debrief-commands = { $count ->
    [one] { $count } command until { $until }
   *[other] { $count } commands until { $until }
}
# Commands in succession, and how many of them others gave.
debrief-shares = { $commands } ({ $shares })
debrief-share = { $count } by { $person }
# One row for a refusal by several drones.
debrief-to-many = { $what } ({ $count } vehicles)
debrief-drone = vehicle { $vehicle }: { $what }
debrief-vehicle = vehicle { $vehicle }: { $what }

debrief-improve = WHAT TO IMPROVE   (biggest gain first)
debrief-nothing = Nothing left to gain.
debrief-only-gold = No more points to gain; gold needs { $gates }.
# At most 5 columns.
debrief-good = good

# Prediction and goal, stated before launch.
debrief-crew = commands by { $names }
debrief-crew-also = commands also by { $names }
debrief-by-hand = Flown by hand
debrief-by-script = Flown by a script: practice
debrief-by-bundled-pilot = Flown by a pilot script that comes with sortie: practice
debrief-other-revision = This flight used another revision of the mission (the course has r{ $revision } of { $mission }): the scores cannot be compared.
debrief-own-mission = { $mission } is not part of the course, so its flights count as practice only.
debrief-altered-mission = The mission file differs from { $mission } r{ $revision } of the course: the scores cannot be compared.
debrief-try = Try { $attempt }, hints: { $count } (x{ $factor })
debrief-predicted-right = You predicted { $predicted }: exactly right.
debrief-predicted-less = You predicted { $predicted }: { $by } less than you got.
debrief-predicted-more = You predicted { $predicted }: { $by } more than you got.
debrief-goal-reached = Your goal, { $goal }: reached ({ $result }).
debrief-goal-missed = Your goal, { $goal }: missed ({ $result }).
debrief-given-up = given up: no points
debrief-times-hints = x{ $factor } for hints

debrief-alert-good = { $alert } -> answered after { $after } s   good
debrief-alert-late = { $alert } -> answered after { $after } s (limit { $limit } s)   late
debrief-alert-none = { $alert } -> not answered (limit { $limit } s)   late

debrief-swarm = SWARM   (shown, not scored)
debrief-fan-out = { $who ->
    [crew] At this pace the crew keeps { $handled } vehicles busy; it used { $flown }.
   *[you] At this pace you keep { $handled } vehicles busy; you used { $flown }.
}
debrief-swarm-times = without commands, a vehicle stays busy for { $neglect } s; a command takes { $who ->
        [crew] the crew
       *[you] you
    } { $interaction } s; a vehicle waits { $wait } s
debrief-swarm-habits = { $who ->
        [crew] the crew
       *[you] you
    } switched vehicles { $switches } times a minute and sent { $group } % of commands to several at once
debrief-use = in use { $airborne } s, with a task { $percent } %, idle { $idle } s
debrief-use-none = not used

debrief-truth = THE TRUTH   (north is up)
debrief-sign = { $sign } { $meaning }
debrief-sign-gap = not covered
debrief-sign-track = flown
debrief-sign-pad = pad
debrief-sign-wire = power line
debrief-sign-decoy = harmless
debrief-sign-there = present, not an objective
debrief-sign-false = false report
debrief-sign-mark = report
debrief-sign-found = found
debrief-sign-missed = missed
debrief-sign-shades = { $shades } weak to strong
debrief-scale = a column is { $metres } m
debrief-height = { $metres } m
debrief-found = found { $found } of { $all }, false reports { $wrong }
debrief-gaps = not covered: { $area } m², most of it around n { $north } e { $east }
debrief-missed = missed: { $kind } at n { $north } e { $east }

debrief-tries = YOUR TRIES
debrief-practice = practice

debrief-next = NEXT
debrief-next-drill = Fly the drill { $drill }, then this mission again: { $what }
debrief-next-again = Next try: { $what }
debrief-next-on = Go on to the next mission.
debrief-next-gold = Next try: gold needs { $gates }.
debrief-next-mission = Go on with "{ $mission }".
debrief-next-count = Fly this mission for credits: practice opens no other.
debrief-last-mission = this was the last mission

# The map of the debrief.
truth-title = the truth
truth-none = This mission has nothing to reveal.
truth-found = found
truth-missed = missed
truth-over = dealt with
truth-unasked = present, not an objective
truth-decoy = harmless
truth-false = false report
truth-burning = burning
truth-strength = % of the strongest
truth-gate = gates
truth-gaps = not covered
debrief-not-flown = Nothing counts before the first takeoff.
debrief-next-same = Fly this mission again.

debrief-workload = WORKLOAD   (shown, not scored)
workload-title = workload
workload-busy = busy
workload-alone = alone
workload-waiting = waiting
workload-answers = your rating
workload-how = share of the last minute spent on commands, in tenths; vehicles working on their own in that minute; vehicles waiting; your ratings from 1 to 5
workload-figures = from { $commands ->
        [one] { $commands } command
       *[other] { $commands } commands
    }, counted once for all vehicles: { $who ->
        [crew] the crew was
       *[you] you were
    } busy for { $interaction } s; the vehicles worked on their own for { $neglect } s and waited for { $wait } s, in total
workload-overloaded = more than 70 % busy for a minute or longer: { $stretches }
workload-answered = you answered { $answers } of { $questions } questions about your workload
workload-question = Your workload, from 1 (almost nothing) to 5 (too much)? { $key } answers (not scored)
