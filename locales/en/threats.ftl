# Threats: rules of the air, alerts, injects.

threat-collision = hit drone { $other }
threat-separation = { $distance } m from drone { $other }
threat-no-fly = inside the no-fly zone { $zone }
threat-people = below { $height } m over people in { $zone }
threat-injury = hit a person
threat-near-person = { $distance } m from a person
threat-aircraft-hit = hit an aircraft
threat-bubble = { $distance } m from an aircraft
threat-intruder-hit = hit an unknown drone
threat-intruder-near = { $distance } m from an unknown drone
threat-answered = answered after { $seconds } s: { $alert }
threat-not-allowed = `{ $name }` cannot be injected in this mission

threat-gust = strong gusts
threat-wind-shift = the wind shifts
threat-gnss-jam = satellite navigation fails
threat-link-loss = the link is lost
threat-motor-fail = a motor is failing
threat-battery-cold = a cold battery
threat-battery-cell = a battery cell fails
threat-person = a person enters the area
threat-aircraft = an aircraft crosses the area

# The objective to keep a link.
link-target = { $margin } dB for { $percent } %
link-kept = linked for { $percent } % of { $seconds } s
link-none = no time in the area
link-more = { $seconds } s more
link-advice = Place a relay above the ridge, in sight of both the ground station and the drone, before the drone flies behind the ridge.
