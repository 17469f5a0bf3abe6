# Помилки файлів апарата (MAVFTP).
ftp-fail = апарат відхиляє запит, не називаючи причини
ftp-system = помилка { $number } файлової системи апарата
ftp-invalid-size = апарат вважає розмір запиту неправильним
ftp-invalid-session = файл відкрила інша наземна станція
ftp-no-session = апарат не має вільного сеансу
ftp-end-of-file = файл закінчився передчасно
ftp-unknown-command = апарат не знає такого запиту
ftp-exists = файл уже існує
ftp-protected = файл захищено від запису
ftp-not-found = файл не знайдено
ftp-other = відмова з невідомим кодом { $code }
ftp-silent = відповіді немає
ftp-other-size = файл має інший розмір, байтів: { $bytes }
ftp-malformed = незрозуміла відповідь
ftp-too-many = у теці забагато елементів
ftp-bad-path = шлях порожній або задовгий
