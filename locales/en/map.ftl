# The map.

map-title = map
map-all = everything in view
map-task-in-view = task and vehicles in view
map-vehicles-in-view = vehicles in view
map-follows = follows { $vehicle }
map-outside = { $count ->
    [one] 1 vehicle out of view
   *[other] { $count } vehicles out of view
}
map-nowhere = No position is known yet.
map-objective = next: { $title } ({ $detail })
map-from-home = from home
map-from-vehicle = from
map-ruler = ruler
map-no-vehicle = no vehicle with a known position under the cursor
map-no-samples = no sensor has samples yet
map-shows-sensor = samples of { $sensor }

map-legend = legend
map-legend-armed = armed, its heading
map-legend-disarmed = disarmed
map-legend-lost = link lost
map-legend-cursor = vehicle under the cursor
map-legend-hidden = and 2 more in its place
map-legend-selected = selected
map-legend-alert = warning
map-legend-critical = critical alert, crashed
map-legend-several = several in one place
map-legend-home = home
map-legend-pointer = map cursor
map-legend-place = named place
map-legend-next = next place
map-legend-trail = trail
map-legend-target = to its target (x)
map-legend-ghost = other flight (g1)
map-legend-task = task area
map-legend-fence = fence
map-legend-keep-out = keep out
map-legend-plan = plan, waypoint w3
map-legend-leg = to item 3 of 12 (w3/12)
map-legend-paused = paused in its plan
map-legend-rally = rally point (R1)
map-legend-course = manoeuvre, place (p3)
map-legend-meeting = too close (!1/2)
map-legend-ruler = ruler

action-left = move left
action-right = move right
action-zoom-in = zoom in
action-zoom-out = zoom out
action-fit = show everything
action-follow = follow the vehicle under the cursor, or stop
action-centre = centre the map on the cursor
action-ruler = measure from here, or stop measuring
action-goto-here = write `goto` with the place under the cursor
action-trails = show or hide the trails
action-legend = show or hide the legend
action-next-sensor = show the samples from the next sensor
# Meanings of the signs: at most 24 columns.
map-legend-harmless = contact, harmless
map-legend-seen = contact, one sensor
map-legend-confirmed = contact, two sensors
map-legend-reported = reported
map-legend-no-fly = no-fly area (x)
map-legend-jamming = GNSS jammed (~)
map-legend-people = people below (&)
map-legend-radio = weak radio (%)
map-legend-wire = power line, pylons (T)
map-legend-movers = person, unknown drone
map-legend-traffic = other aircraft, course
map-legend-swept = searched or sampled
map-legend-fire = fire: burnt, flames
map-fire = fire
map-fire-scorched = partly burnt
map-fire-burnt = burnt
map-fire-flames = flames, one sensor
map-fire-sure = flames, confirmed
