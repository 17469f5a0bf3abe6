# Sensors that find things.
mission-sensor-camera = camera
mission-sensor-zoom = zoom camera
mission-sensor-thermal = thermal camera
mission-sensor-magnetometer = magnetometer
mission-sensor-metal-detector = metal detector
mission-sensor-radar = ground-penetrating radar

# What detectors find. A contact is called c1, c2 and so on.
contact-mine = mine
contact-person = person
contact-fire = fire
contact-defect = defect
contact-leak = leak
contact-source = source
contact-peak = peak
contact-found = { $contact }: { $kind }?  n { $north } e { $east }  { $sensor }
contact-confirmed = { $contact }: { $kind }, confirmed by the { $sensor }
contact-harmless = { $contact }: harmless

# Reports of finds.
detect-result = F{ $beta } { $score }: { $found }/{ $there } found, { $wrong } false, { $repeated } repeated
detect-result-cost = F{ $beta } { $score } ({ $measure } less { $cost } for false reports): { $found }/{ $there } found, { $wrong } false, { $repeated } repeated
detect-outlook = { $count ->
    [0] no report yet
   *[other] judged later: { $count }
}
detect-quality = recall { $recall }, precision { $precision }
detect-target = F{ $beta } { $target }, within { $radius } m
detect-target-cost = F{ $beta } { $target }, within { $radius } m; a false report costs { $cost } finds
detect-quality-none = report what you find before the flight ends
detect-quality-advice = confirm each contact with another sensor, or from a shorter distance, before you report it
detect-advice-none = Report what you find before the flight ends: `mark contacts` reports every open contact.
detect-advice-blind = { $count ->
    [one] Report only what a sensor has found: 1 report was of a place where none had found anything.
   *[other] Report only what a sensor has found: { $count } reports were of places where none had found anything.
}
detect-advice-missed = Look again, lower and slower, and confirm each contact before you report it (missed: { $missed }, false reports: { $wrong }).
detect-advice-wrong = Confirm each contact with another sensor, or from a shorter distance, before you report it (false reports: { $wrong }).

# Looking at a place closely before it is reported.
checked-result = { $all ->
    [0] no report
   *[other] { $count }/{ $all } reports
}
checked-target = all reports
checked-advice = Before you report a place, stay within { $radius } m of it for { $dwell } s, at { $speed } m/s at most.
checked-advice-cross = { $count ->
    [1] Before you report a place, fly straight across it, within { $radius } m of it, at { $speed } m/s at most.
   *[other] Before you report a place, fly straight across it from { $count } sides, within { $radius } m of it, at { $speed } m/s at most.
}
checked-advice-heights = Only heights of { $low } to { $high } m count.

# Covering a zone.
coverage-result = { $swept } % covered; a random search would cover { $random } %
coverage-outlook = { $swept } % covered
coverage-target = { $target } % covered
coverage-advice = Fly lines no further apart than the width of the sensor's strip: { $left } % was not covered, although your path was long enough to cover the zone { $coverage } times.
coverage-advice-lines = Fly lines over the whole zone, no further apart than the width of the sensor's strip.

# Keeping a distance from a structure.
standoff-result = { $close ->
    [0] { $share } % of { $near } s
   *[other] { $share } % of { $near } s, too close for { $close } s
}
standoff-target = { $share } % of the time { $nearest } to { $farthest } m away
standoff-advice = { $close ->
    [0] Fly alongside the structure, { $nearest } to { $farthest } m away, for at least { $least } s.
   *[other] Fly alongside the structure, { $nearest } to { $farthest } m away: you were too close for { $close } s.
}

# Clearing mines.
clear-result = { $count } cleared
clear-target = { $count ->
    [one] 1 mine
   *[other] { $count } mines
}
clear-advice = Let the drones find the mines first, then send the robot to each find, at 1 m/s: its flail clears up to 1.2 m/s, and a mine under its wheels destroys it.

# Delivering loads.
deliver-kits = { $lost ->
    [0] { $done } helped
   *[other] { $done } helped, { $lost } late
}
deliver-nodes = { $done } placed
deliver-kits-target = { $target ->
    [one] { $target } person
   *[other] { $target } people
}
deliver-nodes-target = { $target ->
    [one] { $target } node
   *[other] { $target } nodes
}
deliver-kits-advice = { $lost ->
    [0] Drop a kit within 8 m of each person.
   *[other] Find people sooner and drop a kit within 8 m of each: help came too late for { $lost } of them.
}
deliver-nodes-advice = Drop the nodes within 6 m of their places.
people-kit-reached = delivered to a person { $distance } m away
people-kit-lost = no one within { $distance } m
people-node-placed = the node is in its place
people-node-lost = no place marked for a node within { $distance } m

# Plans on board and what is done with them before they are flown.
plan-fault-of = { $vehicle }: { $fault }
plan-fault-sea-level = a height above sea level
plan-fault-outside = a place outside the fence
plan-fault-endless = a jump without end
plan-fault-stay = a hold that drains the battery
plan-fault-copied = the plan of another drone
plan-fault-gap = two places left out
plan-fault-no-return = no return
plan-rehearsed-of = rehearsed before the flight: { $good }
plan-unrehearsed = flown without a successful rehearsal: { $vehicles }
plan-rehearsed-target = all { $count } rehearsed
plan-rehearsed-advice = Before the first takeoff, send `all plan rehearse`: every row has to end with a landing. After each change of a plan, rehearse again.
plan-mended-of = faulty plans replaced: { $good }
plan-unmended = flown with a faulty plan: { $vehicles }
plan-mended-target = no faulty plan flown
plan-mended-advice = Find the faulty plans on the ground: `all plan rehearse`, `all plan status`, and the places on the map. Put a new plan on board, and rehearse again.
plan-kept-of = sound plans flown unchanged: { $good }
plan-unkept = sound plans replaced: { $vehicles }
plan-kept-target = sound plans unchanged
plan-kept-advice = Replace only the plans in which you have found a fault: a new plan can have faults of its own.
plan-flown-of = flown: { $good }
plan-outlook-rehearsed = rehearsed: { $ready }/{ $count }
plan-outlook-unrehearsed = unrehearsed: { $vehicles }
plan-outlook-unmended = faulty: { $vehicles }
plan-outlook-unkept = replaced: { $vehicles }
