# A crew: several people on one swarm

verb-crew = show the crew, or hand vehicles over
words-crew = team together hand-over pilot member
argument-crew-vehicles = vehicles such as 1-4,7
argument-crew-name = a person on the crew
crew-role-host = host
crew-role-pilot = pilot
crew-role-sensors = sensors
crew-role-safety = safety
crew-role-observer = observer
crew-list-role = { $name }: { $role }
crew-list-vehicles = { $name }: { $role }, { $vehicles }

# On screen
header-crew = CREW
header-crew-awaited = CREW, WAITING
header-crew-ended = CREW, HOST LEFT
header-crew-lost = CREW, NO LINK
header-crew-silent = CREW, NO WORD FOR { $seconds } s
hint-leave-crew = leave the crew
header-own = you fly { $vehicles }
header-own-none = you fly no vehicle

# What happens
crew-joined = { $who } joins the crew: { $role }
crew-joined-vehicles = { $who } joins the crew: { $role } of { $vehicles }
crew-left = { $who } has left the crew
crew-left-lost = the connection to { $who } is lost
crew-left-silent = { $who } does not answer any more
crew-you-fly = you fly { $vehicles }
crew-host-flies = { $host } flies { $vehicles }
crew-handed-over = { $from } hands { $vehicles } over to { $to }
crew-offers = { $who } offers you { $vehicles }: `crew accept { $vehicles }` or `crew decline { $vehicles }`
crew-asks = { $who } asks for { $vehicles }: `crew accept { $vehicles }` or `crew decline { $vehicles }`
crew-open-offers = { $who } offers { $vehicles } to { $to }
crew-open-asks = { $who } asks { $from } for { $vehicles }
crew-listed-offers = { $who } offers { $vehicles }
crew-listed-asks = { $who } asks for { $vehicles }
crew-waits = waiting for { $who } to accept or decline: { $vehicles }
crew-declined = { $who } declines the hand-over of { $vehicles }
crew-unanswered = no answer from { $who } within a minute: { $vehicles }
crew-lapsed = the proposal of { $who } has ended without your answer: { $vehicles }
crew-welcome = crew { $crew } of { $host }: you are { $name }, { $role }
crew-waiting = waiting for the crew { $crew }
crew-waiting-flight = waiting for the flight of { $host }
crew-host-left = { $host } has ended the crew: this console looks for it again, `quit` leaves
crew-host-left-end = { $host } has ended the crew: this console ends
crew-confirmed = { $who } has confirmed `{ $line }`: { $danger }
# A safety pilot commands vehicles of the reader; the verb is as it is typed.
crew-made-safe = { $who } commands `{ $verb }` to what you fly: { $vehicles }
crew-flight-ended = the flight of { $host } has ended
crew-lost = the connection to the host is lost; the console tries again
crew-refused = { $line }: { $reason }
crew-line-waits = waiting for the host: { $lines }
crew-copy = your record of the flight: { $file }

# Why something is not possible
crew-none = this console is in no crew: start it with `sortie fly --crew NAME`, or join one with `sortie crew join NAME`
crew-alone = you are the only one on the crew
crew-full = the crew is full
crew-full-user = your user has four consoles on the crew already: end one of them
crew-nobody = { $name } is not on the crew: `crew` shows the names
crew-oneself = these vehicles are yours already
crew-no-pilot = { $name } is no pilot: only pilots fly vehicles
crew-not-yours = you do not fly { $vehicles }
crew-yours = you fly { $vehicles } already
crew-several = these vehicles have several pilots: ask for those of one pilot
crew-no-vehicle = no such vehicle in this flight
crew-many-proposals = you have made eight proposals that wait for an answer: wait for one of them
crew-several-proposals = several proposals wait: { $proposals }: say which, as in `crew accept { $vehicles }` or `crew accept { $vehicles } from NAME`
crew-other-proposals = no such proposal; these wait: { $proposals }
crew-nothing = no proposal waits for your answer
crew-overtaken = too late: the proposal has ended
crew-not-connected = no connection to the host
crew-own-files = not possible for a member: this uses files of the host's machine
crew-observer = observers give no commands
crew-not-open = this command is not part of your role: { $role }
crew-unconfirmed = `{ $verb }` needs a confirmation
crew-not-flying = the host is not flying
crew-not-begun = the mission has not begun: the host reads the brief
crew-late = the host was busy for { $seconds } s: give it again
crew-exam = an exam is flown alone
crew-line-long = the command is too long
crew-host-decides = only the host can do this: it concerns the whole flight
crew-stay = this console shows the flight of the host: `quit` leaves the crew
crew-live = the host is flying this: it cannot be paused or moved in time
crew-denied-version = the host speaks version { $host } of the protocol: use the same version of sortie
crew-denied-hello = the host did not understand this console
crew-many-records = the host begins too many records: join the crew again
crew-unrecorded = a crew needs the record of the flight: allow records (`records.enabled`)
crew-not-opened = the crew cannot be opened: { $fault }
crew-no-socket = { $socket } exists and is not a socket: choose another name
crew-in-use = another console hosts a crew at { $socket }: choose another name, or end it
crew-no-access = { $socket } cannot be opened: { $error }
crew-folder = { $folder } belongs to another user, or others may change it: choose another name
crew-stranger = the crew at { $socket } is open by { $user }, not by { $host }
crew-not-joined = the crew cannot be joined: { $fault }
crew-not-there = there is no crew { $name }: its host opens it with `sortie fly MISSION --crew { $name }`
crew-no-data = a member needs a data folder for the record of the flight
practice-crew = the mission is not made for a crew

# Questions before leaving
crew-ask-quit-vehicles = { $host } then flies { $vehicles }, which you fly now
crew-ask-quit-role = you give up your role: { $role }
