# What the console itself says.

ask-quit = QUIT
ask-leave = LEAVE the session
ask-start = START another session
ask-restart = RESTART the mission
ask-abandon = ABANDON the mission
ask-abandon-reason = the debrief counts what has been reached so far
ask-mission-lost = the mission is not over; it would not count
ask-exam-ends = the exam is not over; it ends here, and what you have flown counts
ask-armed = { $count ->
    [one] 1 vehicle is armed
   *[other] { $count } vehicles are armed
}
ask-type = type
ask-how-many = { $answer } (how many vehicles)
ask-cancelled = cancelled, nothing was done: { $question }

select-missing = there is no vehicle { $vehicles }
select-missing-all = there is no vehicle { $vehicles }: the selection stays as it was

palette-title = command
palette-grammar = [targets] verb [arguments]: { $complete } completes, { $older } brings back older lines
palette-to = to { $vehicles }
palette-to-cursor = to { $vehicles } (under the cursor)
palette-to-selected = to { $vehicles } (selected)
palette-sends = { $key } sends to { $vehicles }
palette-asks = { $key } asks before it sends to { $vehicles }

prompt-connect = connect to


help-commands = commands: [targets] verb [arguments]
help-console = the console itself

mission-none = no mission is being flown
debrief-none = No debrief yet: it opens when a mission is over.

ask-sure = are you sure
ask-taken-back = cancelled, nothing was done   Enter or Esc goes on
ask-else = anything else: no

help-title = help   { $scroll } scroll   { $key } closes
help-targets = targets: 3  1-4,7  @group  all; none means the selection

small-needs = sortie needs { $columns }x{ $rows }, this terminal is { $now_columns }x{ $now_rows }
small-keys = Until it is larger only { $key } works: it leaves the program.

prompt-connect-tcp = ArduPilot SITL, one vehicle per port
prompt-connect-udpin = listen; vehicles send here
prompt-connect-udp = send to a vehicle or a router
prompt-connect-serial = an autopilot or a radio on a cable
prompt-connect-file = a recording
prompt-connect-several = several addresses: blanks between them.  { $submit } connects, { $escape } closes

session-free = free flight
class-copter = copter
class-plane = plane
class-rover = rover
class-sub = sub
class-vehicle = vehicle

ids-wrong = `{ $word }` is no vehicle: write 3, 3-9 or 1,4-6
group-empty = there is no vehicle to put into the group
group-is = @{ $name } is now { $members }
group-unknown = no group is named `{ $name }`
group-name = `{ $name }` is no name: use letters, digits, - and _
order-question = { $count ->
    [1] { $verb } vehicle { $vehicles }
   *[other] { $verb } vehicles { $vehicles }
}
order-no-vehicle = there is no vehicle { $vehicle }
order-wait = `wait` is for pilot scripts
order-wait-help = the console never waits: give the next command when you see fit
macro-line = line { $number } of the macro `{ $name }`, `{ $line }`: { $fault }
macro-endless = the macro was stopped after { $count } lines: does it call itself?

palette-given-before = given before
palette-selects = select for the next commands

console-too-much = nothing more is expected here
console-missing = something is missing here
console-usage = usage: { $usage }
console-unknown = `{ $word }` is not known here
console-known = there are: { $names }
console-none = there are none
console-no-injects = this mission allows no injects
console-no-mission = injects need a mission under way
console-kind-theme = theme

console-show = go to a room
console-select = select vehicles: 1-4,7  @red  all  none  filter  invert
console-group = call vehicles @NAME from now on
console-macro = give the lines of a macro, one after another
console-fly = start a mission; without a name, free flight
console-connect = connect to vehicles elsewhere
console-set = change a setting until the console ends
console-theme = change the colours
console-help = keys and verbs
console-links = what the links count
console-ledger = all commands of the session and what became of them
console-notices = all that was said in the session
console-brief = the mission's brief
console-abandon = end the mission and see the debrief
console-restart = fly the same mission again from its start
console-leave = end the session, back to the home screen
console-quit = leave the program

setting-theme = colours
setting-lang = language: English, українська; a profile remembers it
setting-symbols = what curves and maps are drawn with
setting-fps = frames per second at most
setting-fps-range = write a whole number from { $least } to { $most }
setting-bell = ring the bell for serious alerts
setting-notify = desktop notifications for serious alerts
console-params = the parameters: ask again, save, load, compare
console-hangar = the vehicles' processes: show, start again, end
console-ungroup = forget a group's name
console-sort = order the table; - puts the largest first
console-filter = show only: 1-4  @red  armed  air  alert  bat<30  !land
console-columns = the table's columns; none: as many as fit
console-ack = take note of the worst alerts, or of these
console-mute = alerts of a kind stay silent; none: which are
console-unmute = alerts of a kind ring again; none: all do
setting-lang-ascii = the screen shows only ASCII: set symbols block or braille first
console-pause = let the simulation and every clock stand still
console-continue = let them go on
console-inject = have something happen in the mission
