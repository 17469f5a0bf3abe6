# What continuous hazards are measured with, what is let go of over them, and the objectives about them.

mission-sensor-monoxide = CO
mission-sensor-methane = CH4
mission-sensor-dose-rate = dose rate

# Loads.
load-ball = balls
load-spray = spray
load-kit = kits
load-node = nodes
load-dropped = { $what }; { $left } left
load-nothing = it hit nothing that counts
load-empty = no { $load } left: land on a pad for 20 s
load-served = loads on board again
load-shut = its sprayer is shut
load-spray-left = { $left } s left
load-on-ground = it stands on the ground
load-too-high = { $height } m is too high: { $limit } m at most
load-sample = { $sensor } { $value } { $unit }
load-sample-speed = samples are taken at { $limit } m/s at most

# What loads do to a fire.
fire-put-out = the fire is out there
fire-goes-on = the fire goes on there
fire-wetted = the ground is wet there
fire-none-there = nothing burns there

# Finding where something is.
locate-reports = reported: { $count }
locate-off = { $distance } m off
locate-missed = not found
locate-wrong = { $count ->
    [one] 1 wrong report
   *[other] { $count } wrong reports
}
locate-quality = report what you are sure of only, and fly over it slowly before you do
locate-target = { $count } within { $within } m
locate-advice = Cross it from two sides, fly slowly where the sensor shows the most, and report the place: mark peak.

# The edge of a fire.
perimeter-none = no map yet
perimeter-next = map in { $seconds } s
perimeter-target = { $fit } at { $times } s
perimeter-advice = see the whole edge shortly before the map is taken, the front with the wind last

# Fire and what it must not reach.
protect-safe = nothing of it burnt
protect-still = nothing of it burns, the fire goes on
protect-burnt = { $lost } of { $all } cells burnt
protect-target = nothing burns
protect-advice = Wet the ground in the way of the front from road to road before it comes, then put out what gets over.
contain-hits = { $good } of { $all } where they helped
contain-share = { $percent } % of what would have burnt
contain-target = { $percent } %
contain-quality = drop and spray over flames and dry fuel only, slowly and low
contain-advice = Begin with the side that runs with the wind: the fire doubles every minute.

# Radiation that vehicles gather.
dose-most = { $dose } uSv at most
dose-target = { $limit } uSv
dose-advice = Stay high and keep moving: the dose falls with the square of the distance and with the time.
