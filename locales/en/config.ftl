# Faults in configuration files, keymaps and themes.

config-unknown = unknown setting `{ $name }`
config-wrong = `{ $name }` must be { $expected }
config-wrong-word = `{ $name }` must be { $expected }, not `{ $word }`
config-section = `{ $name }` is a section: write `[{ $name }]` on a line of its own and its settings below
config-log-level = unknown log levels: `{ $written }`; the levels are error, warn, info, debug and trace, also for one module: `warn,sortie::link=debug`
config-expected-word = one of { $choices }
config-expected-text = text in quotes
config-expected-number = a whole number from { $least } to { $most }
config-expected-flag = `true` or `false`
config-expected-words = a list of words, such as `["one", "two"]`
config-expected-lines = a line of the command language in quotes, or a list of them

config-faulty = ignored: { $fault }

keymap-no-key = unknown key `{ $key }`
keymap-same-key = terminals send the same code for `{ $key }` and `{ $other }`
keymap-no-context = unknown context `{ $name }`
keymap-context = `{ $name }` is a context: write `[{ $name }]` on a line of its own and its keys below
keymap-twice = `{ $key }` is already used in this context, on line { $line }
keymap-shadows = `{ $key }` is used under `[anywhere]`, on line { $line }
keymap-shadows-advice = give one of them another key
keymap-meaning = expected the name of an action or a command line in quotes, or `false`
keymap-no-action = unknown action or command `{ $name }`
keymap-only-actions = only actions can be given to the keys of `{ $name }`
keymap-is-text = `{ $key }` types a letter in this context

history-unreadable = the history of the command line cannot be read from { $path }: { $error }
mission-twice = two missions have the id `{ $id }`: { $flown } is used, { $other } is ignored

theme-unknown = unknown theme `{ $name }`
theme-none = unknown theme `{ $name }`: choose one of { $known }
theme-none-near = unknown theme `{ $name }`: choose one of { $known }; did you mean `{ $guess }`?
lang-withheld = the locale has no UTF-8: English is used instead of { $language } (`export LC_ALL=C.UTF-8`)
lang-withheld-ascii = with symbols = "ascii", English is used instead of { $language }
log-unwritable = cannot write the log { $path }: { $error }
theme-left-out = no theme `{ $name }`: { $fault }
theme-inherits-itself = the theme `{ $name }` inherits from itself
theme-circle = themes inherit from each other in a circle: { $circle }
theme-faulty-parent = the parent theme `{ $name }` has faults
theme-unknown-role = unknown role `{ $name }`
theme-roles-are = roles: { $roles }
theme-role-table = `{ $name }` must be a table with its colours
theme-role-table-advice = write `{ $example }`
theme-no-style = the role `{ $name }` has no style
theme-no-style-advice = give it one under `[roles]`, or inherit it: `inherits = "dark"`
theme-no-colour = `{ $word }` is not a colour
theme-no-colour-advice = write `"#rrggbb"`, a name such as `"light-red"`, or a number in quotes, `"0"` to `"255"`
