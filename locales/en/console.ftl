# Questions, notices and labels of the console itself.

ask-quit = QUIT
ask-leave = LEAVE the session
ask-start = START another flight
ask-replay = START a replay
ask-review = OPEN a review
ask-restart = RESTART the mission
ask-abandon = ABANDON the mission
ask-abandon-reason = giving up earns no points; the debrief shows what you have achieved
ask-mission-lost = the mission is not over; the flight would not count
ask-given-up = the mission is not over; leaving gives it up, and the flight counts as a try
ask-exam-ends = the exam is not over; leaving ends it, and the flight counts
ask-armed = { $count ->
    [one] 1 vehicle is armed
   *[other] { $count } vehicles are armed
}
ask-press = press { $answer }
ask-type = type { $answer }
ask-how-many = { $answer } (vehicle count)
ask-cancelled = cancelled, nothing was done: { $question }

select-missing = no vehicle { $vehicles }
select-missing-all = no vehicle { $vehicles }: the selection is unchanged

palette-title = command
palette-grammar = [targets] verb [arguments]: { $complete } completes, { $older } brings back older lines
palette-to = to { $vehicles }
palette-to-cursor = to { $vehicles } (under the cursor)
palette-to-selected = to { $vehicles } (selected)
palette-confirms = { $key } confirms
palette-sends = { $key } sends to { $vehicles }
palette-asks = { $key } sends to { $vehicles } once you confirm

prompt-connect = connect to

help-commands = commands: [targets] verb [arguments]
help-console = commands of the console

mission-none = no mission is being flown
debrief-none = No debrief yet: it opens when a mission is over; in a replay, `seek end` leads there.

ask-sure = are you sure
ask-taken-back = cancelled, nothing was done   { $submit } or { $escape }: back
ask-else = anything else: no

help-title = help   { $scroll } scroll   { $section } section   { $search } search   { $key } close
help-none = nothing found in the help
help-targets = targets: 3  1-4,7  @group  all; without targets: the selection

small-needs = sortie needs { $columns }x{ $rows }; this terminal is { $now_columns }x{ $now_rows }
small-keys = Enlarge the terminal, or press { $key } to leave the program.

prompt-connect-tcp = ArduPilot SITL, one vehicle per port
prompt-connect-udpin = listen; vehicles send here
prompt-connect-udp = send to a vehicle or a router
prompt-connect-serial = an autopilot or a radio connected by cable
prompt-connect-file = a recording
prompt-connect-several = several addresses: separate them with spaces.  { $submit } connects, { $escape } closes

session-free = free flight
class-copter = copter
class-plane = plane
class-rover = rover
class-boat = boat
class-sub = sub
class-vehicle = vehicle

ids-wrong = `{ $word }` is not a vehicle: write 3, 3-9 or 1,4-6
group-empty = no vehicle to put into the group: select some first, or name them, as in `group red 1-4`
group-is = @{ $name } is now { $members }
group-unknown = no group `{ $name }`
group-name = `{ $name }` is not a name: use letters, digits, - and _
order-hint-price = the next hint, level { $level }, costs { $percent } % of the score
order-question = { $count ->
    [1] { $verb } vehicle { $vehicles }
   *[other] { $verb } vehicles { $vehicles }
}
order-no-vehicle = no vehicle { $vehicle }
order-none = `{ $verb }` sends no command
order-wait = `wait` is for pilot scripts
order-wait-help = in the console, give the next command when you are ready
macro-line = line { $number } of the macro `{ $name }`, `{ $line }`: { $fault }
macro-endless = the macro was stopped after { $count } lines: does it call itself?

palette-reads-as = reads as `{ $line }`
palette-given-before = earlier line
palette-selects = select for the next commands

console-no-injects = this mission does not allow injects
console-no-mission = injects need a mission in progress
console-kind-theme = theme

setting-theme = colours
setting-lang = language: English, українська; a profile remembers it
setting-symbols = characters for curves and maps
setting-fps = maximum frames per second
setting-bell = terminal bell for serious alerts
setting-notify = desktop notifications for serious alerts
setting-lang-ascii = the screen shows only ASCII: first `set symbols block` or `set symbols braille`
