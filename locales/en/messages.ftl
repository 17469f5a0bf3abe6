# The room "messages": the inspector.


messages-fields = fields
messages-hint = Choose a message in the tree. { $open } opens a branch, { $fields } goes to the fields, { $graph } draws a field as a graph, { $bytes } shows bytes, { $send } puts the last frame on the command line to edit and send it, { $filter } filters, { $sort } sorts, { $pause } pauses, { $fold } closes or opens all systems.
messages-none = no link has received a message yet
messages-none-found = no message matches
messages-paused = PAUSED
messages-by-number = messages by number
messages-by-name = messages by name
messages-by-rate = messages by rate
messages-by-age = messages by age
messages-count = count
messages-age = age
messages-system = system { $system }
messages-component = component { $component }
messages-received = received
messages-sent = sent
messages-to = { $system } to { $peer }
messages-signed = signed
messages-unsigned = unsigned
messages-figures = { $hz } Hz  { $bytes } B/s  count { $count }  age { $age }
messages-dress = v{ $version } { $signed }, { $length } B, no. { $sequence }, { $way }
messages-unknown = unknown ({ $value })
messages-more = { $count } more
messages-unknown-id = This id is in no dialect that sortie knows; its checksum cannot be verified.
messages-other-layout = The checksum does not match this message as sortie knows it: another layout, or a damaged frame.
messages-extent = now { $now }  { $seconds } s: { $low } to { $high }
messages-not-drawn = { $count } not drawn
messages-uncounted = frames of other kinds, not listed (often noise): { $count }
messages-choose-field = choose a field first: { $key } goes to the fields
messages-choose-message = choose a message first
messages-not-sendable = { $message } cannot be sent again: its fields are unknown, or it contains a key or a password
messages-no-number = { $field } is text and has no graph

messages-key-help = help
messages-key-open = open
messages-key-fields = fields
messages-key-graph = graph
messages-key-bytes = bytes
messages-key-send = send again
messages-key-filter = filter
messages-key-sort = sort
messages-key-pause = pause
messages-key-fold = fold all
