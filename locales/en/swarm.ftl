### Manoeuvres of several vehicles.

swarm-usual-spacing = line spacing { $metres } m (default)
swarm-gaps = { $metres } m of the lines cross gaps in the area
swarm-swath-spacing = line spacing { $metres } m: the width of the sensor's strip
swarm-staggered = every second vehicle flies { $metres } m higher, because the lines are close together: check that its sensor works at that height
swarm-no-line = no line left for it: { $lines ->
    [one] { $lines } line
   *[other] { $lines } lines
} for { $vehicles } vehicles
swarm-one-place = { $vehicles } fly to one place at one height and would meet there: use `formation`, or give each a height of its own (`up`)
swarm-one-place-planes = { $vehicles } fly to one place at one height and would meet there: give each a place or a height of its own (`up`)
swarm-no-area = no area to fly over
swarm-too-many-lines = this needs more than { $most } lines: choose a smaller area or a wider spacing
swarm-too-near = { $spacing } m is too close: use at least { $least } m ({ $separation } m of separation and a margin)
swarm-no-way = no safe path: some vehicles are above others; use `spread` first
swarm-no-home = home is not known yet
swarm-not-there = the position of vehicle { $vehicle } is not known yet
swarm-its-own-goal = it cannot follow itself
swarm-no-formation = not in a formation
swarm-goes-along = moves with the formation of { $leader }
swarm-leads = leads the formation
swarm-falls-out = leaves { $verb }: { $reason }
swarm-waits = pauses its { $verb } until { $other } has cleared the way
swarm-lost = link lost
swarm-does-not-fly = no longer flying
