# Plan files: `sortie plan`, `sortie check`.

file-plan = plan file
plan-holds-plan = plan { $hash }: { $count ->
    [one] { $count } item
   *[other] { $count } items
}
plan-holds-fence = fence: { $count ->
    [one] { $count } item
   *[other] { $count } items
}
plan-holds-rally = rally points: { $count }
plan-holds-nothing = no items
plan-list-plan = plan
plan-list-fence = fence
plan-list-rally = rally points
plan-good = good
plan-warning = (warning)
plan-at-item = { $list }, item { $number }: { $what }
plan-at-items = { $list }, items { $numbers }: { $what }

plan-file-unknown = unknown format: expected QGC WPL, .plan, a fence or rally points of MAVProxy, KML, KMZ or GeoJSON
plan-file-not-text = the file is not UTF-8 text
plan-file-version = version { $found } is unknown: expected { $known }
plan-file-fields = { $found } fields, expected { $expected }
plan-file-number = `{ $text }` is not a number
plan-file-range = `{ $text }` is out of range
plan-file-order = this item has the number { $found }, expected { $expected }
plan-file-xml = invalid XML: { $error }
plan-file-missing = `{ $name }` is missing
plan-file-no-items = the complex item `{ $kind }` has no simple items: save the plan again in QGroundControl
plan-file-jump = this jump names the id { $id }, which no item has
plan-file-corners = a polygon needs at least 3 corners; this one has { $count }
plan-file-line = a line needs at least 2 points
plan-file-many = too many items for a list
plan-file-empty = no plan, fence or rally points in this file
plan-file-archive-damaged = the archive is damaged
plan-file-archive-no-kml = the archive contains no .kml file
plan-file-archive-method = the archive is compressed by an unknown method: use deflate
plan-file-archive-large = the content of the archive is too large
plan-file-syntax-end = the file ends too early
plan-file-syntax-unexpected = unexpected `{ $character }`
plan-file-syntax-text = invalid string
plan-file-syntax-trailing = the document ends here, but the file continues
plan-file-syntax-deep = too many levels
plan-file-expected-number = expected a number
plan-file-expected-number-or-null = expected a number or `null`
plan-file-expected-text = expected a string
plan-file-expected-flag = expected `true` or `false`
plan-file-expected-list = expected a list
plan-file-expected-object = expected an object
plan-file-expected-length = expected a list of { $count } values
plan-file-expected-position = expected a longitude and a latitude
plan-file-expected-word = expected { $words }

plan-note-height = no height in the file: { $height } m above home is used (`--height`)
plan-note-home-height = home has no height: 0 m above sea level is assumed
plan-note-fraction = a fraction of parameter 5 or 6 is rounded: MAVLink sends them as whole numbers
plan-note-lines = { $count } lines are joined into one plan

plan-refused-command = the vehicle refuses { $command } in this list
plan-refused-frame = the vehicle refuses the frame of { $command }: use sea level (0), home (3) or terrain (10)
plan-refused-latitude = the latitude of { $command } is not between -90 and 90
plan-refused-longitude = the longitude of { $command } is not between -180 and 180
plan-refused-height = the height of { $command } is not a number that the vehicle can store
plan-refused-parameter = parameter { $number } of { $command } is not a valid number
plan-unstorable = `{ $name }` of { $command } is { $written }; the vehicle would store { $stored }
plan-skipped = a { $vehicle } skips { $command } in flight
plan-vehicle-copter = copter
plan-vehicle-plane = plane
plan-vehicle-rover = rover
plan-too-many = { $count } items; the vehicle stores at most { $most }
plan-jump-nowhere = the jump leads to item { $target }; the items are 1 to { $last }
plan-jump-ring = the jumps form a loop without an item to fly: the plan ends here
plan-no-tag = no item has the tag { $tag }
plan-fence-count = a polygon needs at least 3 corners; this one has { $count }
plan-fence-other-count = this corner states { $got } corners for its polygon, the first corner states { $wanted }
plan-fence-other-type = an item of another kind inside a polygon: corners are missing before it
plan-fence-missing = the last polygon is incomplete
plan-fence-radius = the radius of the circle is not positive
plan-fence-returns = a second return point
plan-fence-place = not a valid latitude and longitude
plan-fence-large = the fence takes { $bytes } bytes; the vehicle has { $most }
plan-breaks-fence = outside the fence (area { $area })
plan-leg-breaks-fence = the leg to this item crosses the fence (area { $area })
plan-home-breaks-fence = home is outside the fence (area { $area })
plan-beyond-radius = { $distance } m from home; the limit is { $most } m
plan-above-ceiling = { $height } m above home; the limit is { $most } m
plan-rally-ignored = { $what }: the vehicle ignores this rally point
plan-no-takeoff = no takeoff before the first place: the vehicle stays on the ground
plan-no-end = the plan has no end: the vehicle hovers after the last item; add RTL or LAND
plan-unreached = this item is never reached
plan-never-ends = the plan never ends: it repeats items { $first } to { $last }
plan-no-terrain = height above terrain, but the vehicle has no terrain data
plan-below-ground = the leg to this item goes { $depth } m into the ground, { $along } m from its start
plan-low-over-ground = the leg to this item passes { $height } m above the ground, { $along } m from its start; at least { $least } m are needed (`--clearance`)
plan-no-ground = height above terrain, but no terrain file covers this leg
plan-uncovered = { $count ->
    [one] no terrain file covers { $count } leg
   *[other] no terrain file covers { $count } legs
}
plan-home-height = home is at { $home } m above sea level in the file; the ground there is at { $ground } m
plan-terrain-lowest = lowest height above ground: { $height } m, on the leg to item { $number }
plan-terrain-no-folder = { $path }: no such folder
plan-terrain-size = { $path }: { $bytes } bytes; a `.hgt` file has 2884802 (3 arc seconds) or 25934402 (1 arc second)
plan-mixed-frames = the height reference changes: { $before }, now { $here }
plan-mixed-frames-home = the height reference changes: { $before }, now { $here } ({ $first } m and { $second } m above home)
plan-height-sea = { $height } m above sea level
plan-height-home = { $height } m above home
plan-height-terrain = { $height } m above terrain
plan-height-other = { $height } m above an unknown reference
plan-low-height = { $height } m above home: the vehicle would fly into the ground
plan-low-slope = { $height } m above home: the vehicle flies into the ground unless the ground is lower there
plan-far-away = { $distance } km from home: check the coordinates

plan-would-lose = this format cannot hold the { $list }: write a .plan file, or choose one list with `--list`
plan-would-lose-frame = a .plan file cannot hold rally point { $number }: its height is not measured from home
plan-would-lose-fence = a .plan file cannot hold the fence: item { $number } belongs to no complete area
plan-would-lose-infinite = { $list }, item { $number }: this format cannot hold an infinite number
plan-written = { $path }: { $content }

plan-rehearse-no-plan = { $file }: no plan to fly
plan-rehearse-no-home = { $file }: no home in the file; give one with `--home LAT,LON,ALT,HDG`
plan-rehearse-refused = { $file }: the vehicle refuses the { $list }; `sortie plan check` shows why
plan-rehearse-no-parameter = unknown parameter or value: { $name }
plan-rehearse-vehicle = vehicle
plan-rehearse-file = file
plan-rehearse-time = time
plan-rehearse-energy = battery left
plan-rehearse-farthest = farthest
plan-rehearse-fence = fence
plan-rehearse-end = end
plan-rehearse-fence-kept = kept
plan-rehearse-fence-broken = breached at { $time }
plan-rehearse-fence-none = none
plan-rehearse-landed = landed
plan-rehearse-in-air = in the air
plan-rehearse-left-plan = left its plan for { $mode }
plan-rehearse-grounded = did not take off
plan-rehearse-crashed = collided
plan-rehearse-hit-ground = flew into the ground on the way to item { $number }
plan-rehearse-level = heights above terrain are flown over level ground; `--terrain DIR` compares them with the ground
plan-rehearse-tlog = { $path }: not written: { $reason }
plan-rehearse-time-up = still flying
plan-rehearse-moved = vehicle { $vehicle } starts { $distance } m east of its home: another vehicle has the same home
plan-rehearse-closest = closest: { $a } and { $b } at { $time }: { $horizontal } m horizontally, { $vertical } m vertically
plan-rehearse-conflict = too close: { $a } and { $b } at { $time }: { $horizontal } m horizontally, { $vertical } m vertically
plan-rehearse-late = too close if one is { $late } s late: { $a } and { $b }
plan-rehearse-waits = vehicle { $vehicle } waits on the ground with its motors running: set `DISARM_DELAY` to 0 on it before the flight
plan-rehearse-done = { $simulated } of flight simulated in { $wall } s

plan-deconflict-none = the plans are far enough apart; nothing to change
plan-deconflict-margin = they stay apart even if a vehicle is { $late } s late
plan-deconflict-tight = they come too close if a vehicle is up to { $late } s late: start on time
plan-deconflict-impossible = neither later starts nor different heights keep these plans apart
plan-deconflict-keep = { $vehicle } ({ $file }): unchanged
plan-deconflict-delay = { $vehicle } ({ $file }): starts { $time } later
plan-deconflict-layer = { $vehicle } ({ $file }): flies { $height } m higher
plan-deconflict-cost = total time lost by all vehicles: { $time }
plan-deconflict-disarm = the delay is written as NAV_DELAY before the takeoff: set DISARM_DELAY to 0, or the vehicle disarms while it waits

plan-generate-no-vehicle = no vehicle to plan for
plan-generate-empty = the area or line has no extent
plan-generate-too-many = more than { $most } lines: use a larger spacing
plan-generate-narrow = lanes this close together conflict: `--spacing` must be { $least } m or more
plan-generate-fence = the fence is not valid; `sortie plan check` shows why
plan-generate-outside = the pattern crosses the fence: move it, or make it smaller
plan-generate-no-way = vehicle { $vehicle }: no path inside the fence from its home to its part
plan-generate-no-shape = no shape: give a file, `--points` or `--datum`
plan-generate-which-area = the file has { $count } areas: choose one with `--area`
plan-generate-no-area = no such area: the file has { $count }
plan-generate-no-line = no line in this file
plan-generate-no-point = no point in this file: give one with `--datum`
plan-generate-homes = `--homes`: { $error }
plan-generate-no-homes = `--homes`: no places
plan-generate-no-home = no home: give `--home` and `--vehicles`, or `--homes`
plan-generate-no-fence = { $file }: no fence in this file
plan-generate-length = length
plan-generate-used = battery
plan-generate-share = share
plan-generate-layer = transit height
plan-generate-imbalance = the largest share is { $times } times the smallest
plan-generate-idle = vehicle { $vehicle } has no plan: { $reason }
plan-idle = no part for { $vehicles }: { $reason }
plan-idle-far = too far away to help
plan-idle-spare = more vehicles would hardly save energy
plan-generate-uncovered = { $share } % of the area is not covered: the fence is too close
