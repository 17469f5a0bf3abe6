# Watching seats, and what the desk shows to the class

# Keys on the last line
class-key-tiles = tiles
class-key-replay = replay
class-key-unmark = remove marks
class-key-other-flight = flight
class-key-back = back
class-key-state = state
class-key-injects = injects
class-key-select = select
class-key-look-away = close
argument-beside = the trainee whose flight is shown beside it

# Behind the screen of a seat
class-flight-title = state of { $seat }
class-flight-waits = waiting for the state of the flight
class-flight-figures = { $clock }  score { $score }  obj. { $met }/{ $objectives }  air { $airborne }/{ $vehicles }
class-flight-figures-short = { $clock }  sc. { $score }  { $met }/{ $objectives }  air { $airborne }/{ $vehicles }
class-flight-alert = ! { $alert }
class-flight-open = ○ { $title }  { $detail }
class-flight-met = ✓ { $title }  { $detail }
class-flight-missed = ✗ { $title }  { $detail }
class-flight-more = { $count ->
        [one] { $count } more objective
       *[other] { $count } more objectives
    }
class-flight-vehicle = { $vehicle } { $mode } { $height } m { $battery } %
class-flight-elsewhere = seen { $metres } m away
class-alert-of = vehicle { $vehicle }: { $cause }

# The class debrief
class-replay-title = score { $score }  { $trainee }
class-replay-reading = The flights are being read.
class-replay-none-beside = { $user } has handed in no other flight of { $mission }
class-replay-before = this flight has not begun yet
class-replay-over = this flight is over
class-replay-figures = { $clock }  height { $height } m  battery { $battery } %
class-replay-met = ✓ { $title }
class-replay-open = ○ { $title }
class-replay-bookmark = ◆ { $clock }  { $text }
class-deed-look-on = look on at the replay
class-show-nothing = nothing is being replayed: open a flight first, with `class replay`
class-show-exam = an exam is under way: nothing is shown to the class before it has ended
class-show-none = nothing is being shown to the class
class-show-stopped = the class no longer sees the replay
class-show-over = the class no longer sees the replay: it has ended, or an exam is under way
class-shown-title = { $instructor } shows
class-shown-over = the desk no longer shows the replay
class-shown-closed = the replay is closed here; the desk still shows it to the class

# What the keys of the desk do, in its help
desk-key-message = show a message to the trainee
desk-key-hint = give the mission's next hint, at its price
desk-key-freeze = stop the time of the flight
desk-key-resume = let the time of a frozen flight pass
desk-key-bookmark = set a bookmark in the record of the flight
desk-key-inject = trigger an inject of the mission
desk-key-injects = show the injects that the mission permits
desk-key-tiles = show four seats at once
desk-key-state = show the state of the flight, or the screen again
desk-key-replay = replay the trainee's newest flight
desk-key-exam = let seats take part in an exam
desk-key-capture = keep the situation of the flight
desk-key-recall = return to a situation of the flight
desk-key-take = fly vehicles of the trainee
desk-key-give = hand vehicles back to the trainee
desk-key-end = end the mission, after a question
desk-key-results = show the results of the class
desk-key-next-page = show the next page of the results
desk-key-page-before = show the page of the results before
desk-key-grade = grade the trainee's newest flight
desk-key-rate-1 = rate the element: 1, very poor
desk-key-rate-2 = rate the element: 2, poor
desk-key-rate-3 = rate the element: 3, acceptable
desk-key-rate-4 = rate the element: 4, good
desk-key-rate-5 = rate the element: 5, very good
desk-key-rate-unobserved = the element was not observed
desk-key-cite = cite a bookmark as the reason
desk-key-lesson = show the lesson of the seat, or all lessons
desk-key-next-step = let the step of the lesson begin
desk-key-step-back = return to the step of the lesson before
desk-key-watch = watch the seat's screen
desk-key-remark = write the remark
desk-key-pan-left = move the view of the screen to the left
desk-key-pan-right = move the view of the screen to the right
desk-key-tile-left = select the tile to the left
desk-key-tile-right = select the tile to the right
desk-key-older = show an older flight of the trainee
desk-key-newer = show a newer flight of the trainee
desk-key-unmark = show what happened; remove all marks
desk-key-board = go back to the board
desk-key-quit = close the desk
