# Files that cannot be had or written.

file-unreadable = cannot read { $path }: { $error }
file-unwritable = cannot write { $path }: { $error }
file-exists = { $path } exists already
file-too-large = { $path } is too large: a { $kind } is at most { $most } bytes long
file-unknown = there is no { $kind } `{ $name }`: give a path, or one of { $known }

file-mission = mission
file-pilot = pilot script
file-parameters = parameter file
file-frame = airframe
file-theme = theme
file-keymap = keymap
file-configuration = configuration
file-any = mission, theme, keymap, configuration or script
