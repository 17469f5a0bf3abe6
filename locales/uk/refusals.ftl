# Чому команда зараз не має сенсу для апарата або чому він її відхилив. Сам апарат названо поруч.

refused-not-heard = ще не виходив на зв'язок
refused-not-guided = { $verb } потребує GUIDED, а зараз { $mode }; спершу дайте `{ $vehicle } guided`
refused-not-armed = { $verb } потребує активних двигунів: спершу дайте `{ $vehicle } arm`
refused-taking-off = через { $verb } перервався б зліт, який ще триває: зачекайте
refused-on-the-ground = { $verb } потребує польоту, а апарат на землі; спершу дайте `{ $vehicle } takeoff 10` і зачекайте, доки набереться висота
refused-too-low = { $metres } m над домом занизько для польоту; щоб сісти, дайте `{ $vehicle } land`
refused-plane = це літак: йому треба LAT LON або `by n .. e ..`, а не місцеві метри
refused-no-position = місце апарата невідоме
refused-no-heading = курс апарата невідомий
refused-no-height = висота апарата невідома
refused-no-mode = немає режиму { $mode }
refused-arm-in-the-air = апарат у повітрі: активуйте двигуни на землі
refused-reboot-armed = двигуни активні: деактивуйте їх перед перезапуском
refused-parameter-name = `{ $name }` не може бути параметром: назва має від 1 до 16 латинських літер
refused-no-place = { $lat }, { $lon } не є місцем на землі
refused-not-finite = { $value } не є числом, яке можна надіслати
refused-value = у { $name } лишилося { $value }, значення { $wanted } не прийнято
refused-encoding = { $command } не надсилають як { $message }

reason-no-orbit = цей автопілот не вміє літати колом; це вміє режим CIRCLE
reason-not-armed = двигуни не активовано
reason-armed = двигуни активні
reason-flying = апарат уже летить
reason-takeoff-mode = зараз режим { $mode }, а для зльоту треба GUIDED
reason-in-the-air = апарат у повітрі; посадіть його або дайте kill, щоб зупинити двигуни
reason-arm-mode = у { $mode } двигуни не активувати; спершу перейдіть у GUIDED
reason-mode = зараз не можна перейти в { $mode }
reason-not-now = зараз неможливо, спробуйте ще
reason-denied = апарат не приймає цих значень
reason-unsupported = цей автопілот не знає такої команди
reason-failed = апарат не назвав причини
reason-cancelled = її замінила інша команда
reason-long-only = апарат хоче її як COMMAND_LONG
reason-int-only = апарат хоче її як COMMAND_INT
reason-frame = апарат не знає такої системи координат
reason-other = результат { $number }
