# Sensors that find things.
mission-sensor-camera = camera
mission-sensor-zoom = zoom camera
mission-sensor-thermal = thermal camera
mission-sensor-magnetometer = magnetometer
mission-sensor-metal-detector = metal detector
mission-sensor-radar = ground radar

# What detectors find. A contact is called c1, c2 and so on.
contact-mine = mine
contact-person = person
contact-fire = fire
contact-defect = defect
contact-leak = leak
contact-source = source
contact-found = { $contact }: { $kind }?  n { $north } e { $east }  { $sensor }
contact-confirmed = { $contact }: { $kind }, the { $sensor } sees it too
contact-harmless = { $contact }: harmless
