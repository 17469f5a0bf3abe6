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
