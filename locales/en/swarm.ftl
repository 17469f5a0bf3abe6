### What several vehicles do together.

swarm-usual-spacing = line spacing { $metres } m (default)
swarm-gaps = { $metres } m of the lines lie outside of the area, over its gaps
swarm-swath-spacing = { $metres } m between lines, as wide as the sensor sees
swarm-staggered = every second vehicle flies { $metres } m higher, because the lines are so near to each other
swarm-no-line = no line left for it: { $lines ->
    [one] { $lines } line
   *[other] { $lines } lines
} for { $vehicles } vehicles
swarm-no-area = there is no area to fly over
swarm-too-many-lines = that takes more than { $most } lines: take a smaller area or a wider spacing
swarm-too-near = { $spacing } m is too near: { $least } m at least, for { $separation } m of separation and a margin
swarm-no-way = there is no safe way: some are above one another; say `spread` first
swarm-no-home = nobody has said where home is
swarm-not-there = vehicle { $vehicle } has not said where it is
swarm-its-own-goal = it cannot follow itself
swarm-no-formation = it is in no formation
swarm-goes-along = with the formation of { $leader }
swarm-falls-out = falls out of { $verb }: { $reason }
swarm-waits = waits in its { $verb }: { $other } is in its way
swarm-lost = it is not heard any more
swarm-does-not-fly = it does not fly any more
