### What several vehicles do together.

swarm-usual-spacing = line spacing { $metres } m (default)
swarm-gaps = { $metres } m of the lines lie outside of the area, over its gaps
swarm-swath-spacing = { $metres } m between lines, as wide as the sensor sees
swarm-staggered = every second vehicle flies { $metres } m higher, because the lines are so near to each other
swarm-no-line = no line left for it: { $lines ->
    [one] { $lines } line
   *[other] { $lines } lines
} for { $vehicles } vehicles
swarm-no-area = no area to fly over
swarm-too-many-lines = that takes more than { $most } lines: take a smaller area or a wider spacing
swarm-too-near = { $spacing } m is too close: { $least } m at least, for { $separation } m of separation and a margin
swarm-no-way = no safe way: some are above one another; give `spread` first
swarm-no-home = home is not known yet
swarm-not-there = no position of vehicle { $vehicle } yet
swarm-its-own-goal = it cannot follow itself
swarm-no-formation = not in a formation
swarm-goes-along = with the formation of { $leader }
swarm-falls-out = leaves { $verb }: { $reason }
swarm-waits = waits in its { $verb } for { $other } to clear the way
swarm-lost = no longer heard
swarm-does-not-fly = no longer flying
