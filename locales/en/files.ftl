# Files that cannot be read or written.

file-more-faults = { $count ->
    [one] and 1 more fault
   *[other] and { $count } more faults
}
file-unreadable = cannot read { $path }: { $error }
file-missing = { $path }: not found
file-missing-near = { $path }: not found; did you mean `{ $name }`?
file-missing-in = { $path }: not found in { $folder }
file-missing-folder = { $path }: no folder { $folder }
file-missing-folder-near = { $path }: no folder { $folder }; did you mean `{ $name }`?
file-is-folder = { $path } is a folder, not a file
file-no-data = no data folder { $path }: check the path, or create a profile or fly first
file-dangling = { $path } is a link to { $target }, which does not exist
file-forbidden = no permission to read { $path }
file-unwritable = cannot write { $path }: { $error }
file-undeletable = cannot delete { $path }: { $error }
file-not-regular = it is not a regular file
system-not-found = no such file or folder
system-forbidden = permission denied
system-full = no space left on the disk
system-read-only = the file system is read-only
file-exists = { $path } already exists: choose another path
file-too-large = { $path } is too large: a { $kind } is at most { $most } bytes long
file-unknown = no { $kind } `{ $name }`: give a path, or one of { $known }

file-mission = mission
file-pilot = pilot script
file-design = design
file-lesson = lesson plan
file-exam = exam
file-statistics = statistics of messages
file-parameters = parameter file
file-frame = airframe
file-theme = theme
file-keymap = keymap
file-documentation = documentation of parameters
file-events = event texts
file-configuration = configuration
file-any = mission, lesson plan, theme, keymap, configuration or script

record-under-way = this flight is not over: its debrief is available once it has ended
record-none = not a recorded run: the console records every mission, and `sortie run --record DIR` writes a run to a folder
record-version = this run was recorded in format version { $version }; this program reads version { $known }: use the program that recorded it
record-head = the first line is damaged: { $error }
record-damaged = line { $line } is damaged: the run is scored up to there
record-torn = the record ends in the middle of line { $line }: the run is scored up to there
record-no-end = the record stops before the end of the run: the run is scored up to there
record-mission = this program cannot read the mission of the run: { $fault }
record-unwritable = recording has stopped; the flight continues: { $fault }
record-differs = The run scored { $before } when it was flown; this program scores it { $now }.
record-no-runs = no run is recorded in { $folder }; fly a mission with `sortie fly`, or name a recorded run
journal-none = not the journal of a flight: the first line is of another kind
record-not-begun = this flight is not recorded and cannot be replayed: { $fault }
record-broken-off = the record of this flight ends here: { $fault }
record-full = the record of this flight ends here: it has reached { $mib } MiB (`records.space` allows twice that for all records)
journal-damaged = line { $line } of the journal is damaged at column { $column }: commands and bookmarks are known up to there
journal-other-time = the journal begins at { $began }, which does not fit the first frame of { $first }: it is damaged or belongs to another flight
journal-unknown = { $count ->
    [one] line { $line } of the journal is left out: this program does not know its contents
   *[other] { $count } lines of the journal are left out, the first of them line { $line }: this program does not know their contents
}
journal-time = line { $line } of the journal has an impossible time (`us`): commands and bookmarks are known up to there
journal-cut = the journal ends in the middle of line { $line }: commands and bookmarks are known up to there
record-frames-dropped = the disk is too slow for this flight: frames are missing from its record

# `sortie check`
check-good = { $file }: good
check-kind = unknown kind of file: neither a mission nor a lesson plan, a design, a theme, a keymap or a configuration
check-kind-help = a mission has sections such as `objectives`, a lesson plan `steps`, a design `name` and `frame`, a theme `roles`, a keymap rooms such as `fly`, a configuration settings such as `lang`
check-same-id = the mission { $file } has the id `{ $id }` already
check-same-id-help = give it an id of its own: of several missions with one id, only the first is found
check-known-id = the mission { $file } has the id `{ $id }`, too
check-known-id-help = this id finds only one of them, the first by file name; fly this file by its path
check-ending = cannot tell the kind of { $file }: expected a name ending in .toml, .pilot or that of a plan (.plan, .waypoints, .kml ..)
check-note = { $line } (a note, not a fault)

# `sortie verify`
verify-other-start = the input log begins with another seed or with other start positions
verify-unfit-input = the input log contains an invalid input
verify-other-state = the state of the vehicle does not match
verify-no-vehicle = unknown vehicle
verify-other-position = the recorded position does not match
verify-other-mode = the recorded mode or arming does not match
verify-other-condition = the recorded condition (landed, ready) does not match
verify-other-battery = the recorded battery does not match
verify-other-text = the vehicle did not send the recorded text
verify-refusals = refused commands: { $refused } by the vehicle, { $admitted } in the record
verify-other-score = { $recorded } points are recorded, but { $score } follow from the record
verify-no-inputs = this record cannot be flown again: its vehicles' inputs were not recorded
verify-verified = verified: { $mission } with seed { $seed }, flown again, matches the record; { $score } points (tlog and journal are not compared)
verify-verified-flight = verified: the flight, flown again, matches the record for { $length } (tlog and journal are not compared)
verify-differs = differs at { $seconds } s ({ $what })
verify-of-vehicle = vehicle { $vehicle }: { $what }
verify-other-program = other program: { $program } made the record; flown again here, it differs at { $seconds } s ({ $what })
verify-other-mission = other mission: { $mission } in the record (hash { $hash }) differs from the one in this program
verify-rescored = re-scored from telemetry only: { $score } points, as recorded
verify-rescored-other = re-scored from telemetry only: { $score } points; the record states a different score
verify-inputs-missing = re-scored from telemetry only: { $score } points; the vehicles' inputs were not recorded
verify-damaged = line { $line } of the input log is damaged
verify-torn = the input log ends in the middle of line { $line }
verify-no-end = the input log is incomplete: its end is missing
verify-other-clock = the clocks of the mission and of the simulator do not match
verify-other-end = the medal, result or time at the end does not follow from the record
verify-exam-paused = the flight counts as an exam, which allows no pauses, but the record contains one
verify-own-airframes = the record says that the flight counts, but its airframes are not those of the mission
verify-beyond-inputs = the record continues beyond the end of the input log
verify-too-many = the input log names { $count } vehicles; a flight has at most 255
verify-other-parameter = { $name } does not have the value that the mission requires
verify-altered = the record was changed after the flight: its checksum does not match
verify-programs = the files of the record name different programs, { $one } and { $other }
verify-other-profile = the journal and the run name different profiles
verify-no-state = the input log lacks the state of the vehicles, which is recorded every 10 s
verify-no-states = the input log ends before the first state of the vehicles, which is recorded every 10 s: there is nothing to compare
verify-verified-part = verified as far as the input log goes, { $length }: its end is missing (tlog and journal are not compared)
verify-left = verified up to { $at } of mission time: { $mission } with seed { $seed }, flown again, matches the record, which has no end and no score; the flight was left there, as the journal says (tlog and journal are not compared)
verify-cut = verified up to { $at } of mission time: { $mission } with seed { $seed }, flown again, matches the record, which has no end and no score; the rest is missing, because the console was killed or the record was cut off (tlog and journal are not compared)
verify-end-removed = the mission was over, but the end of its record with the score is missing
verify-other-journal = the journal belongs to another flight ({ $flight })
verify-own-mission = the mission is not part of the course
verify-other-backend = the record says that ArduPilot flew the mission, but it has an input log of the embedded simulator
verify-no-checksum = the record has no checksum, so later changes to it cannot be detected
verify-stated = only stated in the record, not proved: program { $program }, profile { $profile }, date { $when }, source of the commands, number of the try, and what it counted as
verify-stated-guest = only stated in the record, not proved: program { $program }, no profile, date { $when }, source of the commands, number of the try, and what it counted as
verify-stated-free = only stated in the record, not proved: program { $program }

# `sortie records key` and `sign`, and signatures in `sortie verify`
sign-file = { $path }: { $error }
sign-key = { $path } is not a usable minisign key: { $why }
sign-password = no password was read ({ $why }): use a terminal, or a key made with `sortie records key --no-password`
sign-key-exists = { $path } already exists: delete it, or choose another folder with `--output`
sign-being-written = the record is still being written: sign it once the flight is over
sign-no-key = no key { $path }: create one with `sortie records key`, or name one with `--key`
sign-key-made = key { $key }: keep { $secret } to yourself, give { $public } to anyone who checks your records
sign-signed = { $count ->
    [one] signed with key { $key }: 1 file
   *[other] signed with key { $key }: { $count } files
}
sign-none = not signed
sign-unchecked = claims to be signed with key { $key }; `--public-key` checks the signature
sign-valid = signed with key { $key } ({ $comment })
sign-invalid = the signature of { $file } is not valid: { $why }
sign-unreadable = it cannot be read: { $error }
sign-damaged = it is damaged
sign-other-key = it was made with another key, { $key }
sign-changed = the file or the signature was changed afterwards
sign-other-file = it does not name this file; only signatures made by `sortie records sign` are accepted
sign-mixed = the other files were signed at another time, or with another key
sign-missing = the file is missing
sign-partial = { $file } is not signed, but other files of the record are
