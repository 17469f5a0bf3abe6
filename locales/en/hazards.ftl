# Continuous hazards: sensors that measure them, loads dropped on them, and their objectives.

mission-sensor-monoxide = CO
mission-sensor-methane = CH4
mission-sensor-dose-rate = dose rate

# Loads.
load-ball = balls
load-spray = spray
load-kit = kits
load-node = nodes
load-dropped = { $what }; { $left } left
load-nothing = no target was hit
load-empty = no { $load } left: land on a pad for 20 s
load-served = loads refilled
load-shut = the sprayer is closed
load-spray-left = { $left } s left
load-on-ground = it is on the ground: take off first
load-too-high = { $height } m is too high: at most { $limit } m
load-sample = { $sensor } { $value } { $unit }
load-sample-speed = samples need a speed of { $limit } m/s or less

# Effects of loads on a fire.
fire-put-out = the fire there is out
fire-goes-on = the fire there is still burning
fire-wetted = the ground there is wet
fire-none-there = nothing is burning there

# Locating a source.
locate-reports = { $count ->
    [0] no report yet
   *[other] judged later: { $count }
}
locate-off = { $distance } m off
locate-missed = not found
locate-wrong = { $count ->
    [one] 1 false report
   *[other] { $count } false reports
}
locate-blind = { $count ->
    [one] 1 report without a measurement near it
   *[other] { $count } reports without a measurement near them
}
locate-quality = report only when you are sure, and fly over the place slowly first
locate-target = { $count } within { $within } m
locate-advice = Cross the area from two sides, fly slowly where the reading is highest, and report the place: `mark peak`. Only places near which a sensor has measured something count; withdraw a wrong report with `unmark`.

# The edge of a fire.
perimeter-none = no map yet
perimeter-next = map in { $seconds } s
perimeter-target = { $fit } at { $times } s
perimeter-quality = scan the whole edge shortly before the map is taken, and the downwind front last
perimeter-advice = Scan the whole edge shortly before the map is taken; leave the downwind front for last.

# Protecting an area from a fire.
protect-safe = nothing burnt
protect-still = nothing burnt so far
protect-burnt = { $lost } of { $all } cells burnt
protect-target = nothing burns
protect-advice = Wet the ground ahead of the front, from road to road, before the fire arrives; then put out what crosses the line.
contain-hits = { $good } of { $all } useful
contain-share = burnt: { $percent } % of an unfought fire
contain-target = { $percent } %
contain-quality = drop and spray over flames and dry fuel only, slowly and low
contain-advice = Start with the front that runs downwind: the fire doubles every minute.

# The radiation dose of vehicles.
dose-most = highest dose { $dose } uSv
dose-target = { $limit } uSv
dose-advice = Stay high and keep moving: the dose rate falls with the square of the distance, and the dose grows with time.
