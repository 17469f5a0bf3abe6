# Missions flown with built drones: why a fleet cannot fly one, and the requirements for each drone.
fleet-many = the mission has { $seats ->
    [one] { $seats } seat
   *[other] { $seats } seats
} for { $kind ->
    [drone] drones
    [robot] ground robots
   *[boat] boats
}, but you named { $designs } designs: leave some out
fleet-kind = { $design } is a { $kind }, but the mission has seats only for these kinds of vehicles: { $kinds }. Name another design
fleet-fault = { $design }: { $fault }
fleet-dear = the fleet costs { $cost } cr, { $over } cr more than the mission's budget of { $budget } cr: use cheaper parts
fleet-misfit = { $design } cannot do the task of { $count ->
    [one] vehicle
   *[other] vehicles
} { $vehicles }: { $what }: { $has }, required { $required }

need-radius = radius of action in { $wind } m/s of wind
need-time = time in the air, landing with { $reserve } %
need-thrust = thrust / weight in { $wind } m/s of wind
need-link = radio range, { $height } m high
need-cost = cost of a drone, cr
need-vehicle-cost = cost of the vehicle, cr
need-kind = kind of vehicle
need-drive-radius = radius of action
need-drive-time = driving time, returning with { $reserve } %
need-ground-link = radio range on the ground or water
need-none = none
workshop-fit-seats = seats { $seats }: has / needed
