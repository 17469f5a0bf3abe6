# Notices about the terminal.

terminal-slow = slow line { $rate } kB/s
terminal-no-shell = not suspended: there is no shell to resume the console from
terminal-no-pause = not suspended: the rules of this mission allow no pause
terminal-unnamed = TERM is not set, so the console does not know the kind of terminal: set it (such as `TERM=xterm`), or use `sortie fly --plain`, which needs no terminal
terminal-dumb = the console needs a terminal that can move its cursor, which this one cannot (TERM=dumb): use `sortie fly --plain`
terminal-missing = the console needs a terminal on standard input and output: use `sortie fly --plain`, which reads and prints lines, or `sortie run`
