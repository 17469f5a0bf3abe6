# Faults in configuration files, keymaps and themes.

config-unknown = unknown setting `{ $name }`
config-wrong = `{ $name }` must be { $expected }
config-wrong-word = { $name } must be { $expected }, not `{ $word }`
config-section = `{ $name }` is a section: write [{ $name }] on a line of its own and its settings below
config-expected-word = one of { $choices }
config-expected-text = a text in quotes
config-expected-number = a whole number from { $least } to { $most }
config-expected-flag = true or false
config-expected-words = a list of words, such as ["one", "two"]
config-expected-lines = a line of the command language in quotes, or a list of them
