# Missions flown with built drones: why a fleet may not fly one.
fleet-many = the mission has { $seats ->
    [one] { $seats } seat
   *[other] { $seats } seats
}, and { $designs } designs are named: leave some out
fleet-fault = { $design }: { $fault }
fleet-dear = the fleet costs { $cost } cr, { $over } cr more than the mission's budget of { $budget } cr: build it from cheaper parts
