# Files that cannot be read or written.

file-more-faults = { $count ->
    [one] and 1 more fault
   *[other] and { $count } more faults
}
file-unreadable = cannot read { $path }: { $error }
file-unwritable = cannot write { $path }: { $error }
file-exists = { $path } exists already
file-too-large = { $path } is too large: a { $kind } is at most { $most } bytes long
file-unknown = no { $kind } `{ $name }`: give a path, or one of { $known }

file-mission = mission
file-pilot = pilot script
file-design = design
file-parameters = parameter file
file-frame = airframe
file-theme = theme
file-keymap = keymap
file-configuration = configuration
file-any = mission, theme, keymap, configuration or script

record-none = not a recorded run: the console records one for each flight, and `sortie run --record DIR` writes one
record-version = this run was recorded in format version { $version }; this program reads version { $known }: use the program that recorded it
record-head = the first line is damaged: { $error }
record-damaged = line { $line } is damaged: the run is scored up to there
record-no-end = the recording stops before the end of the run: the run is scored up to there
record-mission = this program cannot read the mission of the run: { $fault }
record-unwritable = Recording has stopped; the flight continues: { $fault }
record-differs = It was scored { $before } when it was flown; this program scores it { $now }.
record-no-runs = no run is recorded in { $folder }; fly a mission with `sortie fly`, or name a recorded run
journal-none = not the journal of a flight: the first line is of another kind
record-not-begun = this flight is not recorded and cannot be replayed: { $fault }
record-broken-off = the record of this flight ends here: { $fault }
record-full = the record of this flight ends here: it has reached { $mib } MiB (`records.space` allows twice that for all records)
journal-damaged = line { $line } of the journal is damaged: commands and bookmarks are known up to there
record-frames-dropped = the disk is too slow for this flight: frames are missing from its record
