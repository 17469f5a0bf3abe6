# The room of the workshop: the bench, designs, comparison, the seats of a fleet.
room-workshop = workshop
action-workshop = build drones
action-other-pane = go to the other list
action-take-out = remove the part, or clear the choice
action-buy-part = buy the right to use the part
action-undo = undo the last change
action-redo = redo the change
action-new-design = start a new design
action-save-design = save the design under a name
action-designs = switch between the bench and all designs
action-compare-design = compare with another design
action-copy-design = save a copy of the design
action-rename-design = rename the design
action-export-design = write the design to a file
action-import-design = read a design from a file
action-next-view = show figures, power, payload and mission in turn
action-mission-before = build for the previous mission
action-mission-after = build for the next mission
action-seats = switch between the bench and the fleet's seats
action-all-seats = choose the design for all seats
action-fly-fleet = fly the mission with these drones

bench-hint-lists = lists
bench-hint-put-in = install
bench-hint-take-out = remove
bench-hint-undo = undo
bench-hint-save = save
bench-hint-designs = designs
bench-hint-view = view
bench-hint-fleet = fleet
bench-hint-buy = buy
bench-hint-compare = compare
bench-hint-new = new
bench-hint-mission = mission
bench-hint-files = files
bench-hint-open = open
bench-hint-copy = copy
bench-hint-rename = rename
bench-hint-delete = delete
bench-hint-other = choose another
bench-hint-assign = assign to the seat
bench-hint-all = assign to all
bench-hint-lend = use lent drones
bench-hint-fly = fly

bench-not-saved = not saved
bench-new-name = New design
bench-none-yet = none yet
bench-missing = still missing: { $slots }
bench-add-payload = add ...
bench-locked = locked
bench-part = { $name }: { $mass } g, { $price } cr each
bench-begins = begins a { $kind }: removes the parts that fit only a { $before }
bench-misfit = does not fit: { $reason }
bench-for-sale = not yours yet: { $key } buys the right to use it for { $price } cr
bench-locked-by = on sale once "{ $mission }" is passed
bench-on-board = { $count ->
    [one] on board
   *[other] { $count } on board
}
bench-radio = range by link budget: 20 dB fade margin, 50 m height
bench-ground-radio = range by link budget: 20 dB fade margin, on the ground or water
bench-part-for-sale = { $part }: not yours yet, { $key } buys it for { $price } cr
bench-part-locked = { $part }: on sale once "{ $mission }" is passed
bench-figures-change = with this part (▲ better, ▼ worse)
bench-payload = hover time by payload
bench-drive-payload = driving time by payload
bench-drive-payload-about = at { $cruise } m/s; the curve ends at { $spare } kg, which the chassis or hull can still carry
bench-payload-about = the curve ends where thrust is { $least } times the weight; with { $spare } kg more, thrust is { $good } times the weight
bench-polar-about = best endurance at { $longest } m/s, best range at { $farthest } m/s
bench-drive-overloaded = at { $cruise } m/s; { $over } kg more than the chassis or hull can carry
bench-drive-polar-about = cruise speed { $cruise } m/s, top speed { $top } m/s
bench-curve-marked = with the marked part, { $marked }: { $about }
bench-curve-built = as built: { $about }
bench-curve-misfit = as built: { $about }; no curve with the marked part, { $marked }: { $reason }
bench-no-curve = no curve yet: needs frame, motors, propellers, speed controllers and a battery
bench-no-robot-curve = no curve yet: needs chassis, drive and a battery
bench-no-boat-curve = no curve yet: needs hull, drive and a battery

bench-no-mission = no mission chosen
bench-choose-mission = [ and ] choose a mission to build for.
bench-mission-is = built for mission: { $mission }
bench-mission-flown = the mission is in progress: choose another when it is over
bench-seats = { $count ->
    [one] { $count } drone
   *[other] { $count } drones
}
bench-seats-mixed = { $count ->
    [one] { $count } vehicle
   *[other] { $count } vehicles
}
bench-budget = the fleet costs { $cost } of { $budget } cr
bench-no-budget = the fleet costs { $cost } cr; no limit
bench-fleet = the fleet for "{ $mission }"
bench-fleet-none = the fleet: no mission chosen
bench-fleet-about = on the bench: { $name }
bench-lent = lent by the mission
bench-lent-kind = lent by the mission: { $kind }
bench-seat-taken = seat { $seat }: { $name }
bench-seats-taken = all seats: { $name }
bench-kind-seats-taken = all seats for { $kind ->
    [drone] drones
    [robot] ground robots
   *[boat] boats
}: { $name }
bench-seat-kind = seat { $seat } takes another kind of vehicle: { $taken }; the design on the bench is a { $kind }. Choose another seat, or open another design
bench-no-seat = the mission has no seat for this kind of vehicle: { $kind }. Open another design
bench-seats-lent = back to the vehicles lent by the mission
bench-does-not-fly = cannot fly: { $reason }
bench-lacks-licence = { $part } is not yours yet: buy the right to use it first
bench-over-budget = the fleet costs { $cost } cr, the budget is { $budget } cr: use cheaper parts

bench-designs = designs
bench-no-designs = no designs yet
bench-own = yours
bench-stock = shared
bench-not-own = a design for all users: copy it to change it
bench-comparison = changes from the other design to the one on the bench (▲ better, ▼ worse)
bench-compared = design
bench-differs = differs
bench-choose-compared = choose a design and press { $key } to compare

bench-no-more = cannot be added: it is already on board, or the slot is full
bench-not-on-board = the part is not on board
bench-nothing-to-undo = nothing to undo
bench-nothing-to-redo = nothing to redo
bench-guests-buy-nothing = guests can use every part without buying it
bench-no-profile = designs are saved in a profile, but none is chosen: { $key } writes the design to a file
bench-saved = saved: { $name }
bench-name-taken = a design named { $name } already exists: choose another name
bench-ask-buy = BUY the right to use { $part } for { $price } cr
bench-ask-buy-reason = you have { $credits } cr; { $left } cr will be left
bench-ask-replace = REPLACE { $name } on the bench
bench-ask-replace-reason = its changes are not saved ({ $key } restores them)
bench-ask-overwrite = REPLACE your design { $name }
bench-ask-overwrite-reason = a design with this name already exists
bench-ask-delete = DELETE your design { $name }
bench-ask-delete-reason = the copy on the bench stays
bench-ask-quit-reason = { $name } on the bench is not saved

prompt-save-design = save the design as
prompt-copy-design = save a copy of { $name } as
prompt-rename-design = new name for { $name }
prompt-export-design = write the design to the file
prompt-import-design = read a design from the file
prompt-design-advice = any name; it appears in the list of designs
prompt-import-advice = a path to a design file (TOML); `~/` is your home folder
