# Recorded flights, replayed.
replay-badge = REPLAY
replay-stopped = stopped
replay-gap = nothing recorded for { $time }
replay-moments = Moments
replay-none = nothing is replayed: give `replay FILE`
replay-refuses = a replay takes no commands: this flight is over
replay-refuses-help = leave the replay to fly
replay-rate = replay at x{ $rate }
replay-no-file = there is no file { $file }
replay-no-frames = { $file } belongs to no recording: its .tlog is missing
replay-no-tlog = { $file } holds no MAVLink frame: it is no tlog
bookmark-nothing = there is nothing to bookmark: nothing is flown
bookmark-not-recorded = this flight is not recorded, so it cannot be bookmarked
bookmark-set = bookmark set
seek-unreadable = expected a time such as 12:30, +30, -10 or end
loop-unreadable = expected two times, the earlier one first: 1:10 1:40
argument-seek = 12:30, +30, -10, start or end
argument-loop = from when to when
hint-play = play
hint-ten-seconds = 10 s
hint-moments = moments
hint-moment-list = list
keys-replay = In a replay
moment-armed = armed
moment-disarmed = disarmed
moment-mode = mode { $mode }
moment-refused = { $line }: { $outcome }
moment-refused-why = { $line }: { $outcome }: { $why }
moment-objective = objective reached: { $objective }
moment-near = as close as { $metres } m
moment-kind-bookmark = bookmark
moment-kind-refusal = refusal
moment-kind-alert = alert
moment-kind-mode = mode
moment-kind-arming = arming
moment-kind-objective = objective
moment-kind-separation = separation
verb-replay = replays a recorded flight: a record or any tlog
verb-seek = goes to a time of the recording
verb-loop = plays a stretch over and over
verb-stopat = stops the replay at moments of some kinds
verb-bookmark = bookmarks this moment of the flight
action-play-replay = play or stop the replay
action-replay-back = go 10 s back
action-replay-forward = go 10 s on
action-frame-back = show the frame before
action-frame-forward = show the next frame
action-previous-moment = go to the moment before
action-next-moment = go to the next moment
action-show-moments = list the moments of the recording
export-exists = { $path } exists already: give another path
export-unwritable = { $path } cannot be written: { $error }
export-done = written: { $path }
records-total = { $count ->
    [one] 1 record
   *[other] { $count } records
}, { $size } MiB; the newest { $most } are kept, and { $space } MiB at most
records-no-number = there is no record { $number }: `sortie records list` numbers them
records-number = no.
records-began = began (UTC)
records-subject = flight
records-length = length
records-size = size
records-profile = profile
records-now = being recorded
records-at = at
records-kind = kind
records-vehicles = vehicles
records-what = what
records-in-use = { $name } is still being recorded
records-confirm = { $count ->
    [one] 1 record would be deleted: add --yes
   *[other] { $count } records would be deleted: add --yes
}
records-deleted = deleted: { $name }
