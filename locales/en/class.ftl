# A class: the instructor's desk and the trainees' seats

room-class = class
action-class = show the class
action-mark-seat = mark the seat, or remove its mark
action-mark-all-seats = mark all seats
verb-class = show the class, or give orders to its seats
words-class = instructor desk seats trainees lesson
argument-seat = @seat or @all, here or at the end; by default the watched seat, the marked ones, or the one under the cursor
argument-hold = the trainee waits in the brief until `class start`
argument-class-vehicles = vehicles of the seat, such as 1-4,7; all by default
argument-situation = the name of a situation, or its number
argument-condition = a condition as in mission files

# Keys on the last line
class-key-watch = watch
class-key-board = board
class-key-mark = mark seat
class-key-message = message
class-key-hint = hint
class-key-freeze = freeze
class-key-resume = resume
class-key-bookmark = bookmark
class-key-inject = inject
class-key-take = take over
class-key-give = hand back
class-key-end = end mission
class-key-results = results
class-key-next-page = next page

# The board
class-listens = { $class } at { $address }
class-title = class { $class }: { $here } of { $count } { $count ->
        [one] seat
       *[other] seats
    } connected{ $consoles ->
        [0] {""}
       *[other] , { $consoles } consoles
    }{ $marked ->
        [0] {""}
       *[other] , { $marked } marked
    }
class-empty = No trainee has joined yet. On one host they join with `sortie --class { $class }`; on several machines, with `sortie join` and their join lines.
class-column-seat = seat
class-column-state = state
class-column-mission = mission
class-column-clock = time
class-column-score = score
class-column-objectives = obj.
class-column-air = air
class-column-alerts = alerts
class-column-separation = sep.
class-column-failures = fail.
class-column-workload = load
class-column-command = last command
class-home = not flying
class-reading = reading
class-held = brief held
class-flying = flying
class-exam = exam
class-paused = paused
class-frozen-short = frozen
class-over = over
class-free = free flight
class-gone = left { $time } ago
class-silent = silent { $time }
class-need-collision = collision in { $time }
class-need-collision-now = too close
class-need-fence = fence in { $time }
class-need-fence-now = outside the fence
class-need-alert = alert { $time }
class-need-stuck = no command { $time }

# The seat under the cursor
class-order = { $deed }: { $state }
class-waiting = waiting for the seat
class-unanswered = not answered
class-missing = { $count ->
        [one] { $count } earlier entry is no longer available
       *[other] { $count } earlier entries are no longer available
    }
class-started = mission { $mission } started
class-started-free = flight started
class-failed = { $line }: vehicle { $vehicle } did not carry it out
class-objective = objective met: { $title }
class-passed = mission passed, score { $score }
class-not-passed = mission not passed, score { $score }
class-situations = situations: { $all }
class-situation-at = { $seat }: “{ $name }” at { $at }
class-taken = you fly { $vehicles }
class-armed-inject = armed: { $name } when { $when }
class-inject-hit = { $count ->
        [one] vehicle
       *[other] vehicles
    } { $vehicles }
class-injects-title = { $seat }: injects
class-inject = { $name }: { $title }
class-no-injects = the mission permits no injects
class-no-mission = no mission is being flown: injects belong to missions

class-watch-title = screen of { $seat }
class-watch-none = waiting for the first picture
class-watch-cut = cut: columns { $left }–{ $right } of { $columns }, rows { $top }–{ $bottom } of { $rows } (arrows move)
class-watch-stale = old: nothing has come for { $time }
class-watch-gone = old: the seat has left

# Orders
class-deed-message = message “{ $text }”
class-deed-hint = hint
class-deed-mark = bookmark
class-deed-mark-text = bookmark “{ $text }”
class-deed-freeze = freeze
class-deed-resume = resume
class-deed-inject = inject { $name }
class-deed-inject-when = inject { $name } when { $when }
class-deed-disarm = disarm { $name }
class-deed-disarm-all = disarm all injects
class-deed-end = end mission
class-deed-capture = capture the situation
class-deed-capture-name = capture the situation “{ $name }”
class-deed-recall = recall the situation “{ $situation }”
class-deed-take = take over { $vehicles }
class-deed-give = hand back { $vehicles }
class-deed-command = { $line }
class-deed-fly = fly { $mission }
class-deed-exam = fly { $mission } as an exam
class-deed-hold = { $deed }, held until the start
class-deed-start = start the mission
class-deed-step = lesson { $lesson }, step { $step }
class-deed-step-when = lesson { $lesson }, step { $step } when { $when }
class-deed-lesson-end = lesson { $lesson } ended
class-done = done
class-no-effect = no effect seen
class-armed = armed
class-step-watched = the condition is watched
class-under-way = under way
class-disarmed = disarmed
class-refused = refused: { $reason }
class-refusal-exam = not permitted in exams
class-refusal-no-mission = no mission is being flown
class-refusal-not-flying = the flight has not begun, or is over
class-refusal-cannot-freeze = the vehicles are not simulated by the console
class-refusal-not-frozen = the flight is not frozen
class-refusal-no-hint = the mission has no hint for this moment
class-refusal-not-recorded = the flight is not recorded
class-refusal-paused = the flight is paused
class-refusal-no-inject = the mission does not permit this inject
class-refusal-condition = the condition names something that the mission does not have
class-refusal-not-armed = no such inject is armed
class-refusal-flying = another flight is under way
class-refusal-locked = the mission is locked in the profile of the seat, so it cannot be an exam
class-refusal-too-many-situations = 10 situations of the flight are kept already: replace one by its name
class-refusal-no-situation = no such situation was captured in this flight
class-refusal-no-vehicle = the flight has no such vehicle
class-refusal-real-vehicle = the vehicles may be real, and the configuration of the seat (class.take_over) does not permit it
class-refusal-not-taken = the trainee flies: take the vehicle over first (class take)
class-refusal-line = the seat cannot read the line, or it is no command to vehicles
class-refusal-vehicle = a vehicle does not carry it out
class-line-long = the line is longer than 200 characters
class-which-vehicles = give numbers, such as 1-4,7, or all
class-say-vehicles = only commands to vehicles are sent to a seat
class-ask-command = { $line } for { $seats }
class-did-hint = { $instructor } has given you a hint
class-did-freeze = { $instructor } has frozen the flight
class-did-resume = { $instructor } lets the flight go on
class-did-end = { $instructor } has ended the mission
class-did-start = { $instructor } has started the mission
class-did-capture = { $instructor } keeps this situation
class-did-show = { $instructor } shows a replay
class-did-fly = { $instructor } has opened { $mission }
class-did-exam = { $instructor } has opened the exam “{ $exam }”: try { $number } of { $tries }
class-did-recall = { $instructor } has returned to the situation “{ $situation }”
class-did-take = { $instructor } now flies { $vehicles }
class-did-give = { $instructor } has handed back { $vehicles }
class-desk-line = { $instructor }: { $deed }: { $outcome }
class-given = { $deed }: sent to { $seats }
class-seats = { $count ->
        [one] { $count } seat
       *[other] { $count } seats
    }
class-call-done = { $count ->
        [one] { $count } seat done
       *[other] { $count } seats done
    }
class-call-refused = { $count } refused ({ $which }: { $reason })
class-call-other = { $count } { $state } ({ $which })
class-all-seats = all seats
class-no-desk = this console is not the desk of a class: open one with `sortie class open`
class-unknown-seat = no seat of the class is called { $word }
class-unknown-seat-help = if the text begins or ends with such a word, name its seats first: @anna or @all
class-no-seat = no connected seat is meant: move the cursor to one, mark some, or name one, such as @anna
class-ask-end = END MISSION for { $seats }
class-ask-end-reason = the flights of these trainees end now and are scored; a brief is left without a score

class-quit-taken = the vehicles that you fly go back to their trainees ({ $seats })
class-quit-frozen = trainees can resume their frozen flights themselves ({ $seats })
class-quit-held = trainees can start their held missions themselves ({ $seats })
class-quit-lesson = lessons wait until the desk is open again ({ $seats })

class-ask-recall = RECALL “{ $situation }” for { $seats }
class-ask-recall-seat = { $seat } goes back to { $at }: the last { $lost } of the flight will be lost
class-ask-recall-practice = what follows is practice, and not recorded

# At a seat
header-watched = desk: { $instructor }
header-screen-watched = { $instructor } watches this screen
header-screen-watched-short = { $instructor } watches
header-pilot = { $pilot } flies { $vehicles }
header-try = try { $number } of { $tries }, { $time } left
header-try-short = { $time } left
header-frozen = FROZEN
class-none = no class is configured: start the console with `--class` and the name of the class
class-waits = waiting for the desk of the class { $place }
class-no-answer-yet = no desk answers yet for the class { $place }; the console keeps trying
class-ask = Join the class of { $instructor }?
class-ask-reason = the instructor sees your flight and your screen, can freeze and end the flight, and gets its record
class-joining = joining the class
class-joined = in class { $class }: { $instructor } sees your flight
class-left = not in the class: join with `class join`
class-lost-frozen = the desk is gone: `continue` lets your flight go on
class-lost = the desk is gone; your flight continues
class-lost-home = the desk is gone
pilot-other = { $pilot } flies { $vehicle }
pilot-user = vehicle { $vehicle } is not taken over
pilot-keeps = { $pilot } flies { $vehicles }: wait until they are handed back
pilot-desk-gone = the desk is gone: { $pilot } no longer flies { $vehicles }; you do
ledger-by = { $person }: { $line }
class-message = { $instructor }: { $text }
class-frozen = { $instructor } has frozen the flight: wait until it is resumed
class-brief-held = { $instructor } starts the mission: wait here
class-brief-freed = the desk is gone: you start the mission
class-denied = not admitted to the class: { $reason }
class-denial-version = the desk needs version { $desk } of the protocol; update sortie
class-denial-full = the class is full
class-denial-hello = the desk did not understand this console

# Records that are handed in
class-handed-in = the record of the flight is handed in
class-handed-in-later = the record of the flight is not handed in yet: { $reason }; it stays here and is offered again
class-not-handed-in = the record of the flight is not handed in: { $reason }; it stays here
class-kept = { $user } has handed in { $mission }: score { $score }
class-not-kept = the record { $record } of { $user } is not kept: { $reason }
class-unscored = a record is kept, but cannot be scored: { $fault }
class-submission-unwritable = the disk of the desk is full, or not available
class-submission-damaged = it was damaged on the way
class-submission-share = your records at the desk would exceed 1 GiB
class-submission-impossible = the record of the mission is missing, or larger than 64 MiB
class-submission-different = the desk keeps another record under this name

# The results of a class
class-no-records = no record was handed in to the class { $class } yet
class-no-records-known = no record was handed in to the class { $class } yet; there are records of: { $known }
class-report-title = Class { $class }: { $count } { $count ->
        [one] trainee
       *[other] trainees
    }
class-report-none = No flight counts yet: practice and flights by script are no results.
class-report-missions = Best score and tries per mission (✓ passed)
class-report-skills = Probability that a skill is mastered
class-report-spread = Best scores of the class
class-report-objectives = Objectives, the least known first (each trainee's best flight)
class-report-skill-spread = Skills, the least known first
class-report-practice = practice
class-report-as-practice = flown for practice
class-report-script = a script gave the commands
class-report-uncounted = Flights that do not count: no result and no skill follows from them
class-report-why-not = why
class-report-trainees = trainees
class-report-least = lowest
class-report-median = median
class-report-most = highest
class-report-objective = objective
class-report-objective-title = title
class-report-met = met
class-report-share = points
class-report-mastered = mastered
class-report-profile = profile
class-report-revision = revision
class-report-mandatory = mandatory
class-report-points = points
class-report-points-max = of points
class-report-result = result
class-report-began = began (UTC)
class-report-record = record
class-report-trainee = Class { $class }: { $count } { $count ->
        [one] flight
       *[other] flights
    } handed in.
class-report-of-profiles = Profile: { $profiles }.
class-report-best = { $mission }: best flight, score { $score } ({ $when })

# What an instructor did in a flight
class-all-vehicles = all vehicles
instructor-flew = { $by } flew { $vehicles } from { $from } to { $until }
instructor-flies = { $by } flew { $vehicles } from { $from } to the end
instructor-injected = { $by } triggered the inject { $inject } at { $at }
instructor-recalled = { $by } returned to the situation “{ $situation }” at { $at }
instructor-continued = { $by } returned to the situation “{ $situation }”: the flight continued from { $from }
class-report-instructed = Flights in which the instructor took part
class-report-instructor = instructor

# The page with the results
class-results-title = class { $class }, { $number } of { $count }: { $page }
class-results-by-mission = Best score and tries per mission
class-results-none = No trainee has handed in a record yet: a console does so when a flight of a mission ends.
class-results-no-tries = Records were handed in, but none of them counts: practice, flights by script and invalid exam tries are no results. Let the trainees fly missions of the course, but not as practice.
class-results-no-skills = No flight that counts has trained a skill yet. Skills are estimated from objectives of the course's missions: let the trainees fly them.
class-results-reading = The records of the class are being read.
class-results-met = met by
class-results-spread = lowest ─ middle half █ ─ highest
class-results-left-out = { $count ->
        [one] { $count } more column
       *[other] { $count } more columns
    }: widen the terminal, or use `sortie class report`

# The socket
class-no-socket = { $socket } exists and is not a socket: choose another name
class-in-use = a desk is already open at { $socket }: choose another name, or close it
class-not-open = cannot open { $socket }: { $error }
class-folder = { $folder } belongs to another user, or others may change it: choose another name
class-stranger = not joined: the desk at { $socket } belongs to { $user }, not to { $instructor }

# Several machines
class-not-built = this build of sortie has classes on one host only; ask your administrator for one that was built with `cargo build --release --features zenoh`
class-file = cannot use { $file }: { $error }
class-exposed = other users can read { $file }, which contains a secret key: run `chmod 600 { $file }`; if anybody may have read it, take the seat out with `sortie class remove` and use another one, or make a new class if it is the file of the desk
class-join-file = { $file } is not a join line: { $reason }
class-join-line = this is not a join line: { $reason }
class-join-prefix = it does not begin with `sortie-join/1/`; a class on one host is joined with `--class`
class-join-incomplete = a part of it is missing; copy all of it, or use the file
class-join-damaged = a part of it is damaged; copy it again, or use the file
class-no-keys = { $file } is not the file of a desk, or is damaged ({ $reason }): make a new class with `sortie class new`
class-no-class = there is no class for several machines in { $folder }: make one with `sortie class new`
class-has-keys = { $class } is a class on several machines: open its desk with `--listen`, or give the class on this host another name
class-exists = { $folder } exists: choose another name, or delete the folder if the class is over
class-name = `{ $name }` cannot be the name of a class on several machines: use up to 64 letters without accents, digits, `-` and `_`
class-address = `{ $address }` is not an address: write HOST:PORT, such as 192.168.1.5:7447
class-desk-alone = `--desk` needs a class: name its join file, for example `--class seat-07.join`
class-setting-join-help = correct the path, or get the file of your seat from the instructor again
class-setting-folder = there is no folder { $folder }, where the class should be
class-setting-folder-help = correct the path, or make the folder as its instructor: `sortie class open PATH`
class-setting-user = this machine has no user { $user }, so no desk can belong to that instructor
class-setting-user-help = write the name with which the instructor logs in
class-join-unusable = the console is in no class, as `class.join` in the configuration cannot be used: { $fault }
class-unknown-file = the class in { $folder } has no seat { $seat }: its seats are named like their files, for example `seat-07`
class-removed = Class { $class } has no { $seat } any more. A desk that is open still lets it in: close it, and open it again.
class-records-exist = { $folder } has records of an earlier class { $class }, and those of the new one would be mixed with them: choose another name, for example { $class }-2, or move the folder away
class-on-host = `--desk` is only for join files: the class at { $socket } is on this host
class-no-address = cannot tell which address of this machine to use: give it, for example `--address 192.168.1.5:7447`
class-port-in-use = another desk or another program already listens at { $address }: close it, or use another port, to which seats then go with `--desk`
class-not-of-machine = this machine does not have the address { $address }: use one that it has, or 0.0.0.0 for all
class-not-listening = cannot listen at { $address }: { $reason }
class-not-started = cannot open the desk at { $address }: { $reason }
class-start-certificates = Zenoh does not accept the keys in `desk.json`: restore the file as it was made, or make a new class
class-start-timeout = Zenoh did not start within 10 s: try again
class-start-ended = Zenoh ended at once: try again
class-not-the-desk = not joined: { $address } answers, but not as the desk of this class: ask your instructor whether the address and the join line are still right
class-unknown = not joined: the desk of { $class } does not answer { $seat }: the join line was withdrawn, belongs to another class of that name, or is in use by four consoles
class-crypto = cannot make or use keys: { $reason }
class-made = Class { $class }, { $seats } { $seats ->
        [one] seat
       *[other] seats
    }, in { $folder }.
class-made-lines = The files in { $folder } are for the trainees, one for each. They are secret: whoever has a file can take its seat.
class-made-desk = The desk: `sortie class open { $class } --listen { $listen }`
class-made-seat = A trainee: `sortie join { $file }`, which looks for the desk at { $addresses }
