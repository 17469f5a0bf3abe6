# The room "links".

links-none = no link: connect to vehicles, or start a flight
links-ailing = link doctor: { $finding } ({ $key } shows what to try)
links-address = address
links-in = in B/s
links-out = out B/s
links-lost = lost
links-state = state
links-check = check
links-error = error
links-up = up
links-silent = no data
link-open-silent = open, no data
links-down = down
links-fatal = FAULT
links-fault = fault
links-remark = note
links-fine = ok
links-doctor = link doctor
links-doctor-of = link doctor: link { $link }
links-received = received
links-sent = sent
links-rates = { $bytes } B/s, { $messages } msg/s
links-round-trip = round trip
links-dropped = dropped
links-dropped-figures = bad CRC { $crc }, noise { $skipped } B, unknown ids { $unknown }, undecoded { $undecoded }
links-missing = never arrived
links-autopilots = autopilots
links-others = other
links-other-figures = peers { $peers }, reconnected { $reconnects }, not sent { $unsent }
links-control = in control
links-control-free = free
links-signing = signatures
links-signing-figures = valid { $right }, unsigned { $unsigned }, wrong key { $foreign }, old stamp { $old }
links-history = { $way }, last { $seconds } s, peak { $most }

links-key-command = command
links-key-help = help
links-key-choose = choose
links-key-messages = messages
links-key-fly = fly

# Sharing the links with other ground stations

forwards-title = forwards: other ground stations
forwards-title-mission = forwards: other ground stations, read-only in a mission
forwards-stations = stations
forwards-received = received
forwards-sent = sent
forwards-dropped = dropped
forwards-left-out = left out
forward-down = forward { $address }: { $reason }
link-loop = { $link }: sortie's own frames come back from there: forwards form a loop, and one of them can be removed
forward-loop = forward { $address }: sortie's own frames come back: forwards form a loop, and one of them can be removed
forward-listens = forward { $address }: in a mission, other stations can only listen; their messages do not reach the vehicles
forward-opened = links shared with { $forward }
forward-closed = links no longer shared with { $address }
forward-no-session = no links to share: connect to vehicles, or start a flight
forward-mission = in a mission, forwards must be read-only: add `read-only` after the address
forward-open-already = links already shared with { $address }: remove that forward first
forward-none-there = no forward to { $address }: `forward` lists all forwards
forward-empty = the address is missing: write `ADDR [read-only] [only NAMES] [except NAMES] [rate HZ]`
forward-no-value = a value is missing after `{ $word }`
forward-unknown-word = unknown word `{ $word }`: after the address, write `read-only`, `only NAMES`, `except NAMES` or `rate HZ`
forward-wrong-rate = `{ $word }` is not a rate: write 0.1 to 1000 messages per second
forward-no-message = unknown message `{ $word }`: write names or ids with commas between them, such as `ATTITUDE,GPS_RAW_INT`
forward-file = { $address } is a recording: a forward needs a port

# Commands of other ground stations

foreign-line = GCS { $station }: { $vehicle } { $what }
foreign-upload = { $list } upload, items: { $count }
foreign-steering = steering
foreign-further = further commands
foreign-unanswered = no answer yet
foreign-stays = it stays { $value }
foreign-repeated = { $outcome }, { $count } times
foreign-twin = another ground station uses the address of this console ({ $system }/{ $component }): vehicle { $vehicle } answers { $command }, which this console did not send; give that station another system id

# The name of a link to a simulator that the console runs.
link-simulator = simulator
link-sitl = SITL { $vehicle }

# Radios under test

links-radio = radio of { $vehicle }
radio-figures = loss { $loss } %, delay { $delay } ms, jitter { $jitter } ms
radio-rate = { $rate } B/s
radio-measured = lost { $lost_in } % in, { $lost_out } % out; round trip { $trip } ms; { $bytes_in } B/s in, { $bytes_out } B/s out
radio-line = { $asked }; measured: { $measured }
radio-on = the radio of { $vehicles } is impaired: { $figures }; `radio { $vehicles } off` ends it
radio-off = the radio of { $vehicles } is no longer impaired
radio-mission = a mission decides about the radio itself: test it in free flight or after `connect`
radio-no-vehicles = no vehicle is heard there
radio-no-link = no link { $link }: there are { $count }
radio-no-setting = unknown setting `{ $word }`
radio-wrong-value = `{ $word }`: write { $least } to { $most } { $unit }

sticks-title = sticks of vehicle { $vehicle }: { $key } releases them
sticks-roll = roll
sticks-pitch = pitch
sticks-throttle = throttle
sticks-yaw = yaw
sticks-keys = arrows: roll and pitch; WASD: throttle and yaw; a released key centres its stick
sticks-released = sticks of { $vehicle } given back to the transmitter
sticks-replay = a replay cannot be flown
sticks-none = no vehicle under the cursor
