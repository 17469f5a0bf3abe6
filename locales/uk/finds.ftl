# Датчики, що знаходять.
mission-sensor-camera = камера
mission-sensor-zoom = камера із зумом
mission-sensor-thermal = тепловізор
mission-sensor-magnetometer = магнітометр
mission-sensor-metal-detector = металошукач
mission-sensor-radar = георадар

# Що знаходять датчики. Знахідки звуться c1, c2 і так далі.
contact-mine = міна
contact-person = людина
contact-fire = вогонь
contact-defect = дефект
contact-leak = витік
contact-source = джерело
contact-found = { $contact }: { $kind }?  n { $north } e { $east }  { $sensor }
contact-confirmed = { $contact }: { $kind }, видно й на іншому датчику: { $sensor }
contact-harmless = { $contact }: небезпеки немає
