# Підпис MAVLink: ключі та наслідки `signing`.

signing-file-error = ключі підпису не використовуються: { $path }: { $error }
signing-file-readable = ключі підпису не використовуються: { $path } можуть читати інші (права { $mode }); виконайте `chmod 600 { $path }` і дайте апаратам нові ключі через `signing rotate`
signing-file-foreign = ключі підпису не використовуються: { $path } належить іншому користувачеві
signing-file-in-use = ключі підпису не використовуються: файл { $path } використовує інша консоль; закрийте її та запустіть цю знову
signing-file-content = ключі підпису не використовуються: { $path }: { $fault }
signing-file-fault = помилка в рядку { $line }
signing-no-folder = для ключів підпису потрібна тека даних: задайте HOME або вкажіть теку через `--data`
signing-no-random = система не дає випадкових чисел для ключа: { $error }

refused-signing-here = ключі бувають лише в апаратів на мережевих і послідовних портах, а не у вбудованому симуляторі чи записах
refused-signing-armed = двигуни активні: ключ змінюють лише на землі, з неактивними двигунами
refused-signing-busy = ключ апарата вже змінюється
refused-signing-foreign = апарат підписує ключем, якого sortie не має: скопіюйте його ключ у `signing.toml` або виконайте `signing setup` через USB
refused-signing-has-key = апарат уже підписує кадри: новий ключ дає `signing rotate`
refused-signing-without-key = апарат не підписує кадрів: ключ дає `signing setup`
refused-signing-required = з `--require-signing` (`connect.require_signing`) sortie не зважає на апарати без підпису, тож зв'язок із цим апаратом зникне: перезапустіть sortie без цього налаштування й тоді видаліть ключ

outcome-signing-set-up = тепер підписує; доведено підписаною відповіддю
outcome-signing-rotated = підписує новим ключем; доведено підписаною відповіддю; старий ключ видалено
outcome-signing-removed = більше не підписує; ключ лишається у файлі без ужитку
outcome-signing-refused = апарат не прийняв ключа: { $reason }
outcome-signing-not-taken = зміни не видно; спроб: { $tries }; стан лишається попереднім, обидва ключі збережено
outcome-signing-reverted = зміну видно, але доказу за { $seconds } s немає: попередній ключ надіслано знову, обидва ключі збережено

hazard-signing-setup = дає кожному апарату ключ; каналом зв'язку ключ передається відкритим текстом
hazard-signing-rotate = дає кожному апарату новий ключ і видаляє старий; каналом зв'язку ключ передається відкритим текстом
hazard-signing-remove = апарати знову прийматимуть кадри без підпису від будь-кого
