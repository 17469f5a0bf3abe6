# Кімната «зв'язок».

links-none = каналів немає: під'єднайтеся до апаратів або почніть політ
links-ailing = лікар зв'язку: { $finding } ({ $key } показує, що спробувати)
links-address = адреса
links-in = прийом B/s
links-out = перед. B/s
links-lost = втрат
links-state = стан
links-error = помилка
links-up = працює
links-down = немає
links-fatal = ЗБІЙ
links-fault = вада
links-remark = увага
links-fine = добре
links-doctor = лікар зв'язку
links-received = прийнято
links-sent = передано
links-rates = { $bytes } B/s, { $messages } повід./s
links-round-trip = туди й назад
links-dropped = пропущено
links-dropped-figures = хибна CRC { $crc }, шум { $skipped } B, невідомі номери { $unknown }, не розібрано { $undecoded }
links-missing = не дійшло
links-others = інше
links-other-figures = вузлів { $peers }, перез'єднань { $reconnects }, не надіслано { $unsent }
links-history = { $way }, { $seconds } s, макс. { $most }

links-key-command = команда
links-key-help = довідка
links-key-choose = вибір
links-key-messages = повідомлення
links-key-fly = політ
