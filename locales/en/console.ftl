# What the console itself says.

ask-quit = QUIT
ask-leave = LEAVE the session
ask-start = START another session
ask-restart = RESTART the mission
ask-abandon = ABANDON the mission
ask-abandon-reason = the debrief counts what has been reached so far
ask-mission-lost = the mission is not over; it would not count
ask-armed = { $count ->
    [one] 1 vehicle is armed
   *[other] { $count } vehicles are armed
}
ask-type = type
ask-cancelled = cancelled, nothing was done: { $question }

select-missing = there is no vehicle { $vehicles }
select-missing-all = there is no vehicle { $vehicles }: the selection stays as it was

palette-title = command
palette-grammar = [targets] verb [arguments]: Tab completes, Up brings back older lines
palette-to = to { $vehicles }
palette-to-cursor = to { $vehicles } (under the cursor)
palette-to-selected = to { $vehicles } (selected)
palette-sends = Enter sends to { $vehicles }
palette-asks = Enter asks before it sends to { $vehicles }

prompt-connect = connect to


help-commands = commands: [targets] verb [arguments]
help-console = the console itself

session-free = free flight

mission-none = no mission is being flown
debrief-none = No debrief yet: it opens when a mission is over.
