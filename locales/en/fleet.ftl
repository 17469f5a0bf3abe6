# Missions flown with built drones: why a fleet cannot fly one, and the requirements for each drone.
fleet-many = the mission has { $seats ->
    [one] { $seats } seat
   *[other] { $seats } seats
}, but you named { $designs } designs: leave some out
fleet-fault = { $design }: { $fault }
fleet-dear = the fleet costs { $cost } cr, { $over } cr more than the mission's budget of { $budget } cr: use cheaper parts

need-radius = radius of action in { $wind } m/s of wind
need-time = time in the air, landing with { $reserve } %
need-thrust = thrust / weight in { $wind } m/s of wind
need-link = radio range, { $height } m high
need-cost = cost of a drone, cr
need-none = none
workshop-fit-seats = seats { $seats }: has / needed
