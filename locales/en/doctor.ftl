# The link doctor: faults of a link, and remedies.

doctor-notice = { $link }: { $finding }. { $advice }

doctor-not-open = the link is not open
doctor-nothing = no data arrives
doctor-text = readable text arrives, not MAVLink
doctor-no-frame = bytes arrive, but they contain no MAVLink frame
doctor-wrong-baud = garbage arrives; the baud rate may be wrong
doctor-unknown-dialect = all messages are from an unknown dialect
doctor-foreign-messages = { $percent } % of the messages are from an unknown dialect
doctor-only-ground-stations = only ground stations send messages, no vehicle does
doctor-own-echo = only sortie's own frames arrive, as an echo
doctor-no-autopilot = components send messages, but no autopilot does
doctor-system-zero = a vehicle uses system id 0, which stands for all vehicles: it is not listed
doctor-duplicate-system = two senders use system id { $system }
doctor-heard-twice = vehicle { $system } is heard twice
doctor-missing = expected, but never heard: { $never }
doctor-missing-but = expected, but never heard: { $never }; heard, but not expected: { $others }
doctor-board-link = link { $link }
doctor-signed = vehicle { $system } signs with a key that sortie does not have, and ignores sortie's unsigned frames
doctor-signed-but-answers = vehicle { $system } signs with a key that sortie does not have, but accepts sortie's unsigned frames
doctor-unsigned = unsigned frames arrive in the name of vehicle { $system }
doctor-wrong-key = frames in the name of vehicle { $system } are signed with a wrong key
doctor-old-stamps = frames from vehicle { $system } have old timestamps, { $seconds } s behind: they may be replayed
doctor-one-way = vehicle { $system } sends messages but never answers: it does not receive sortie's messages, or ignores them
doctor-one-way-vehicles = { $count } vehicles send messages, but do not answer
doctor-noise = { $percent } % of the bytes that arrive are not MAVLink
doctor-version-1 = vehicle { $system } uses only MAVLink 1
doctor-other-station = another ground station is on this link: { $system }/{ $component }
doctor-damaged = { $percent } % of the frames arrive damaged (wrong checksum)
doctor-lossy = { $percent } % of the frames do not arrive
doctor-recording = this link plays a recording: commands have no effect
doctor-listening = listening ...
doctor-unanswered = { $count ->
    [one] { $count } vehicle is in contact; waiting for its first answer
   *[other] { $count } vehicles are in contact; waiting for their first answers
}
doctor-well = { $count ->
    [one] all is well: { $count } vehicle is in contact and answers
   *[other] all is well: { $count } vehicles are in contact and answer
}

doctor-try-not-open = Correct the fault that the link reports; the console reconnects automatically.
doctor-try-not-open-tcp = Is the vehicle or SITL running, and is the port right? SITL listens on 5760, 5762 and 5763, plus 10 for each further instance. The console reconnects automatically.
doctor-try-not-open-serial = Is the device plugged in and the name right, such as `/dev/ttyUSB0`, `/dev/ttyACM0` or `COM3`? Does another program hold it (busy; on Linux, `fuser DEVICE` names the program)? Do you have permission to open it (on Linux, the group `dialout`)? The console reconnects automatically.
doctor-try-text = The sender may be a system console, a boot loader or a GPS receiver. On the autopilot set the port's SERIALn_PROTOCOL to 2 (MAVLink 2), or use another port.
doctor-try-no-frame = Is the data MAVLink? Behind a serial-to-network bridge the baud rate may be wrong; the stream may also be encrypted or compressed.
doctor-try-wrong-baud = Try another rate, such as 57600 (radios) or 115200: `serial:DEVICE:57600`. It must match the port's SERIALn_BAUD. If no rate works, the data is not MAVLink.
doctor-try-dialect = The room "messages" shows the ids. sortie does not know the vehicle's dialect; ids up to 255 suggest old or private firmware.
doctor-try-ground-stations = Is the vehicle on and connected? Does the router or ground station in between forward the vehicles' messages to this address?
doctor-try-echo = The line or the radio returns what is sent: is TX wired to RX, or is the other end another ground station with the same ids (255/190)?
doctor-try-autopilot = A camera, gimbal or companion computer sends messages. Does it forward those of the autopilot, and is the autopilot running?
doctor-try-system-zero = Give it an id from 1 to 255 with another program (`MAV_SYSID`; SYSID_THISMAV up to ArduPilot 4.6), and restart it.
doctor-try-duplicate = Connect to one of them alone, give it another id (`param set MAV_SYSID 2`; SYSID_THISMAV up to ArduPilot 4.6), and `reboot` it. If it is one vehicle on two links, close one of them.
doctor-try-heard-twice = It is one vehicle: close one of the links.
doctor-try-missing = Is the vehicle on, and does it send to this console? `all` means only expected vehicles; if others are yours, correct `--expect` (`connect.expect`).
doctor-try-signed = Copy its key into `signing.toml`, or switch signing off on the vehicle; USB ports also accept unsigned frames.
doctor-try-unsigned = If valid frames of the vehicle arrive too, another program sends in its name. Otherwise it has no key, or has lost it: start sortie without `--require-signing`, which ignores such frames, and run `signing setup` over a safe link.
doctor-try-wrong-key = Another ground station has changed the key, or another program sends in the vehicle's name. The vehicle's own key is needed in `signing.toml`.
doctor-try-old-stamps = Another program repeats recorded frames, two programs share one link id, or the vehicle's clock has gone back. With `--require-signing`, sortie ignores such frames.
doctor-try-one-way = Do sortie's messages reach the vehicle? Check firewall, NAT and router: the vehicle must accept UDP or TCP from this machine. It may accept only another ground station (SYSID_MYGCS, SYSID_ENFORCE).
doctor-try-one-way-serial = Is the TX wire connected, and is the radio's uplink up? The vehicle may accept only another ground station (SYSID_MYGCS, SYSID_ENFORCE).
doctor-try-one-way-vehicles = Do sortie's messages reach the vehicles? Check firewall, NAT and router. Forged packets to this port can also create many silent ids.
doctor-try-noise = Another program sends to this port, or two programs share the serial line: find the other program and stop it. The vehicles' frames are still read.
doctor-try-version-1 = Commands work, but signing and newer messages do not. Set the port's SERIALn_PROTOCOL to 2.
doctor-try-other-station = It can command the same vehicles. Agree on who flies; to lock it out, set SYSID_MYGCS and SYSID_ENFORCE on the vehicle.
doctor-try-damaged = Look for an overloaded or weak radio on the way, or for two programs that share one serial port.
doctor-try-damaged-serial = Check cable, ground and flow control, try a lower baud rate, and make sure that no other program reads the port.
doctor-try-silence = Is the vehicle switched on?
doctor-try-silence-tcp = The connection is open, but the other end is silent. Another client may use the vehicle; SITL accepts one client on each of the ports 5760, 5762 and 5763.
doctor-try-silence-tcpin = No client has sent anything. Is the vehicle set to connect to this port of this machine? 127.0.0.1 can be reached from this machine only.
doctor-try-silence-udp = Nothing comes back. Are host and port right, and is the vehicle on? Some vehicles send to a ground station on their own: listen for those with `udpin:0.0.0.0:14550`.
doctor-try-silence-udpin = No packets arrive on this port. Is the vehicle set to send here? 127.0.0.1 can be reached from this machine only: listen on 0.0.0.0 for others. Also check the firewall.
doctor-try-silence-serial = Is the device the right one and powered, are TX and RX crossed, and is the port's SERIALn_PROTOCOL 2 (MAVLink 2)?
