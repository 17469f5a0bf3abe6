# The link doctor: what ails a link, and what to try.

doctor-notice = { $link }: { $finding }. { $advice }

doctor-not-open = the link is not open
doctor-nothing = nothing arrives at all
doctor-text = readable text arrives, not MAVLink
doctor-no-frame = bytes arrive, but no MAVLink frame is in them
doctor-wrong-baud = garbage arrives, as at a wrong baud rate
doctor-unknown-dialect = every message is of an unknown dialect
doctor-foreign-messages = { $percent } % of the messages are of an unknown dialect
doctor-only-ground-stations = only ground stations are heard, no vehicle
doctor-own-echo = only our own frames come back
doctor-no-autopilot = components are heard, but no autopilot
doctor-duplicate-system = system id { $system } comes from two places
doctor-signed = vehicle { $system } signs its frames and does not answer ours, which are unsigned
doctor-signed-but-answers = vehicle { $system } signs its frames, but takes ours unsigned
doctor-one-way = vehicle { $system } is heard, but never answers: it does not hear us
doctor-one-way-vehicles = { $count } vehicles are heard and do not answer
doctor-noise = { $percent } % of the bytes that arrive are not MAVLink
doctor-version-1 = vehicle { $system } speaks MAVLink 1 only
doctor-other-station = another ground station is on this link: { $system }/{ $component }
doctor-damaged = { $percent } % of the frames arrive damaged (wrong checksum)
doctor-lossy = { $percent } % of the frames do not arrive
doctor-recording = a recording is played: commands have no effect
doctor-listening = listening ...
doctor-unanswered = { $count ->
    [one] { $count } vehicle is heard; waiting for its first answer
   *[other] { $count } vehicles are heard; waiting for their first answers
}
doctor-well = { $count ->
    [one] all is well: { $count } vehicle is heard and answers
   *[other] all is well: { $count } vehicles are heard and answer
}

doctor-try-not-open = Correct the fault that the link reports. The link is tried again automatically.
doctor-try-not-open-tcp = Is the vehicle or SITL running, and is the port right? SITL listens on 5760, 5762 and 5763, plus 10 for each further instance. The link is tried again automatically.
doctor-try-not-open-serial = Is the device plugged in and the name right, such as /dev/ttyUSB0, /dev/ttyACM0 or COM3? May you open it (on Linux the group dialout)? It is tried again by itself.
doctor-try-text = Is it a console, a boot loader or a GPS receiver? On the autopilot set the port's SERIALn_PROTOCOL to 2 (MAVLink 2), or take another port.
doctor-try-no-frame = Is it MAVLink? Behind a serial-to-network bridge the baud rate may be wrong; the stream may also be encrypted or compressed.
doctor-try-wrong-baud = Try another rate, such as 57600 (radios) or 115200: serial:DEVICE:57600. It has to be the port's SERIALn_BAUD. If none fits, it is not MAVLink.
doctor-try-dialect = The room "messages" shows the ids. The vehicle's own dialect is not known here; ids up to 255 point to an old or private firmware.
doctor-try-ground-stations = Is the vehicle on and connected? Does the router or ground station in between forward vehicles to this address?
doctor-try-echo = The line or the radio returns what is sent: is TX joined to RX, or is the other end another ground station with our ids (255/190)?
doctor-try-autopilot = A camera, gimbal or companion computer speaks. Does it forward the autopilot, and is the autopilot running?
doctor-try-duplicate = Give one vehicle another SYSID_THISMAV and reboot it. If it is one vehicle by two ways, close one of the links.
doctor-try-signed = This program does not sign. Switch signing off on the vehicle, or use a port without it (USB takes unsigned frames).
doctor-try-one-way = Are replies reaching the vehicle? Check firewall, NAT and router: the vehicle must accept UDP or TCP from this machine. It may obey another ground station only (SYSID_MYGCS, SYSID_ENFORCE).
doctor-try-one-way-serial = Is the TX wire connected, and is the radio's uplink up? The vehicle may obey another ground station only (SYSID_MYGCS, SYSID_ENFORCE).
doctor-try-one-way-vehicles = Are replies reaching the vehicles? Check firewall, NAT and router. A forged sender on this port can also cause this many silent ids.
doctor-try-noise = Another program sends to this port, or two share the serial line: find it and stop it. The vehicles' frames are still read.
doctor-try-version-1 = It works, but signing and newer messages do not. Set the port's SERIALn_PROTOCOL to 2.
doctor-try-other-station = It can command the same vehicles. Agree on who flies; to lock it out, set SYSID_MYGCS and SYSID_ENFORCE on the vehicle.
doctor-try-damaged = Look for an overloaded or weak radio on the way, or for two programs that share one serial port.
doctor-try-damaged-serial = Look at cable, ground and flow control, try a lower baud rate, and see that no other program reads the port.
doctor-try-silence = Is the vehicle on?
doctor-try-silence-tcp = The connection is open, but the other end is silent. Another client may have the vehicle; SITL waits on 5760, 5762 or 5763 for one client each.
doctor-try-silence-tcpin = No client has sent anything. Is the vehicle set to connect to this port of this machine? 127.0.0.1 is reached from this machine only.
doctor-try-silence-udp = Nothing comes back. Are host and port right, and is the vehicle on? Some vehicles send to a port here without being called: then listen with udpin:0.0.0.0:14550.
doctor-try-silence-udpin = No packets come to this port. Is the vehicle set to send here? 127.0.0.1 is reached from this machine only: listen on 0.0.0.0 for others. Firewall?
doctor-try-silence-serial = Is the device the right one and powered, are TX and RX crossed, and is the port's SERIALn_PROTOCOL 2 (MAVLink 2)?
