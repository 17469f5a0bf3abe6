# The home screen.

home-missions = missions
home-others = without a mission
home-free = Free flight
home-ardupilot = Free flight on ArduPilot
home-ardupilot-about = Free flight with real ArduPilot autopilots (SITL), one process per drone. They can be armed after a few seconds.
home-connect = Connect to vehicles
home-quit = Quit
home-free-about = Simulated drones without a mission: learn the commands and try things safely.
home-free-first = A first flight: type `{ $key }` before each line
home-free-wait = Wait for `takeoff done`: a `goto` before that is refused. Then
home-connect-about = Command real drones or a simulator elsewhere: anything that speaks MAVLink over TCP, UDP or a serial port.
home-quit-about = Leave the program.
home-mission-deed = flies the mission
home-mission-rules = objectives and rules
home-free-deed = starts
home-connect-deed = asks for the address
home-quit-deed = leaves
home-over = { $session } is over: { $key } shows its debrief
home-replay = Replay of { $session }: { $key } returns to it
home-running = { $session } is still running: { $key } returns to it
home-connect-empty = write an address, such as `tcp:127.0.0.1:5760`
home-starting-mission = starting the mission ...
home-starting-simulator = starting the simulator ...

# Headings of the list of missions, by difficulty.
home-tier-0 = first steps
home-tier-1 = one skill each
home-tier-2 = several skills
home-tier-3 = everything together
home-drill = { $title }, { $seconds } s
home-no-drill = this mission has no drill
home-best = Best so far: { $score } points, { $medal }.
home-site = area and par
home-par = par
home-limit = limit
home-par-energy = energy
home-energy = par { $wh } Wh
home-wind = wind
home-drones = drones
home-best-so-far = best
home-best-is = { $score }, { $medal }
home-never-flown = not flown yet
