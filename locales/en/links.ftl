# The room "links".

links-none = no link: connect to vehicles, or start a flight
links-ailing = link doctor: { $finding } ({ $key } shows what to try)
links-address = address
links-in = in B/s
links-out = out B/s
links-lost = lost
links-state = state
links-error = error
links-up = up
links-down = down
links-fatal = FAULT
links-fault = fault
links-remark = note
links-fine = ok
links-doctor = link doctor
links-received = received
links-sent = sent
links-rates = { $bytes } B/s, { $messages } msg/s
links-round-trip = round trip
links-dropped = dropped
links-dropped-figures = bad CRC { $crc }, noise { $skipped } B, unknown ids { $unknown }, undecoded { $undecoded }
links-missing = never arrived
links-others = others
links-other-figures = peers { $peers }, reconnected { $reconnects }, not sent { $unsent }
links-history = { $way }, last { $seconds } s, peak { $most }

links-key-command = command
links-key-help = help
links-key-choose = choose
links-key-messages = messages
links-key-fly = fly
