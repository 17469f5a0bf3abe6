# Links: their states, their faults, and faults of their addresses.

transport-connecting = connecting
transport-up = up
transport-waiting = down, next try in { $seconds } s
transport-ended = ended
transport-is-up = link { $link } is up
transport-is-down = link { $link }: { $reason }
transport-has-ended = { $link } has ended

transport-refused = connection refused: nothing listens on port { $port } of { $host }
transport-unreachable = cannot connect to port { $port } of { $host }: { $error }
transport-no-answer = { $host } did not answer within { $seconds } s
transport-not-found = cannot find { $host }: { $error }
transport-without-address = { $host } has no address
transport-no-udp-socket = cannot open a UDP socket: { $error }
transport-udp-failed = the UDP socket failed: { $error }
transport-cannot-send = cannot send to { $address }: { $error }
transport-port-in-use = port { $port } on { $host } is in use: end the program that uses it, or choose another port
transport-not-here = { $host } is not an address of this machine: listen on 127.0.0.1 or 0.0.0.0
transport-cannot-listen = cannot listen on port { $port } of { $host }: { $error }
transport-no-clients = cannot accept clients: { $error }
transport-no-serial = cannot open { $path } at { $baud } baud: { $error }
transport-without-serial = cannot open { $path }: this program was built without serial ports; build it with `--features serial`
transport-closed = closed by the other end
transport-takes-nothing = the other end accepts no more data
transport-silent = nothing was received for { $seconds } s
transport-pipe-gone = the other end is gone: { $reason }
transport-fleet-busy = requests are not accepted now: the session is ending or overloaded

transport-no-file = cannot open { $path }: { $error }
transport-damage = { $count ->
    [one] the recording is damaged at byte { $byte }: { $bytes } bytes were skipped
   *[other] the recording is damaged in { $count } places, first at byte { $byte }: { $bytes } bytes were skipped
}
transport-faults = { $first }; and { $second }
transport-no-tlog = { $faults }; no record was found in it: is it a tlog?
transport-tlog-cut-off = the recording is cut off: its last record, at byte { $byte }, is incomplete; the records before it are intact
transport-tlog-damaged = the recording is damaged: there is no MAVLink frame in the record at byte { $byte } (found { $found } where 0xFD or 0xFE belongs); is it a tlog?
transport-tlog-unreadable = the recording cannot be read at byte { $byte }: { $error }

transport-no-address = "{ $address }" is not a link address: { $problem }; write tcp:HOST:PORT (connect), tcpin:HOST:PORT (listen), udp:HOST:PORT (send to), udpin:HOST:PORT (listen), udpbcast:HOST:PORT, serial:PATH:BAUD or file:FILE.tlog
transport-address-empty = the address is empty
transport-file-missing = the file is missing
transport-no-kind = unknown kind of link "{ $kind }"
transport-no-kind-no-port = it names neither a kind of link nor a port
transport-port-zero = port 0 cannot be reached
transport-port-missing = the port is missing
transport-no-port = "{ $port }" is not a port (0 to 65535)
transport-no-bracket = "{ $host }" lacks its closing bracket
transport-brackets = an IPv6 address needs brackets: { $address }
transport-serial-missing = the serial port's path is missing
transport-baud-missing = the baud rate is missing after the colon
transport-no-baud = the baud rate "{ $baud }" is not a positive number such as 57600 or 115200
