# Екіпаж: кілька людей керують одним роєм

verb-crew = показати екіпаж або передати апарати
words-crew = команда разом передати пілот учасник
argument-crew-vehicles = апарати, наприклад 1-4,7
argument-crew-name = людина з екіпажу
crew-role-host = господар польоту
crew-role-pilot = пілот
crew-role-sensors = датчики
crew-role-safety = безпека
crew-role-observer = спостерігач
crew-list-role = { $name }: { $role }
crew-list-vehicles = { $name }: { $role }, { $vehicles }

# На екрані
header-crew = ЕКІПАЖ
header-crew-awaited = ЕКІПАЖ, ОЧІКУВАННЯ
header-crew-ended = ЕКІПАЖ, ГОСПОДАР ВИЙШОВ
header-crew-lost = ЕКІПАЖ, БЕЗ ЗВ’ЯЗКУ
header-crew-silent = ЕКІПАЖ, { $seconds } с БЕЗ ВІДПОВІДІ
hint-leave-crew = вийти з екіпажу
header-own = ви керуєте { $vehicles }
header-own-none = ви не керуєте апаратами

# Що відбувається
crew-joined = { $who } приєднується до екіпажу: { $role }
crew-joined-vehicles = { $who } приєднується до екіпажу: { $role }, апарати { $vehicles }
crew-left = { $who } виходить з екіпажу
crew-left-lost = зʼєднання втрачено: { $who }
crew-left-silent = { $who } більше не відповідає
crew-you-fly = ви керуєте { $vehicles }
crew-host-flies = { $vehicles } тепер керує { $host }
crew-handed-over = { $from } передає { $vehicles }: тепер керує { $to }
crew-offers = { $who } пропонує вам { $vehicles }: `crew accept { $vehicles }` або `crew decline { $vehicles }`
crew-asks = { $who } просить { $vehicles }: `crew accept { $vehicles }` або `crew decline { $vehicles }`
crew-open-offers = { $who } пропонує { $vehicles }, має відповісти { $to }
crew-open-asks = { $who } просить { $vehicles }, має відповісти { $from }
crew-listed-offers = { $who } пропонує { $vehicles }
crew-listed-asks = { $who } просить { $vehicles }
crew-waits = чекаємо на відповідь, має відповісти { $who }: { $vehicles }
crew-declined = { $who } відхиляє передачу { $vehicles }
crew-unanswered = { $who } не відповідає протягом хвилини: { $vehicles }
crew-lapsed = ви не відповіли, пропозиція вже не діє: { $who }, { $vehicles }
crew-welcome = екіпаж { $crew }, господар польоту { $host }: ви { $name }, { $role }
crew-waiting = очікування екіпажу { $crew }
crew-waiting-flight = очікування польоту, який проводить { $host }
crew-host-left = { $host } завершує роботу екіпажу: консоль шукатиме його знову, `quit` — вийти
crew-host-left-end = { $host } завершує роботу екіпажу: консоль завершує роботу
crew-confirmed = { $who } підтверджує `{ $line }`: { $danger }
# Команда пілота безпеки апаратам того, хто читає; дієслово таке, як його вводять.
crew-made-safe = { $who } дає команду `{ $verb }` вашим апаратам: { $vehicles }
crew-flight-ended = політ, який проводить { $host }, завершено
crew-lost = зв’язок із господарем польоту втрачено; консоль пробує ще раз
crew-refused = { $line }: { $reason }
crew-line-waits = очікування господаря польоту: { $lines }
crew-copy = ваш запис польоту: { $file }

# Чому щось неможливо
crew-none = ця консоль не в екіпажі: запустіть її командою `sortie fly --crew НАЗВА` або приєднайтеся командою `sortie crew join НАЗВА`
crew-alone = в екіпажі поки що лише ви
crew-full = в екіпажі немає місця
crew-full-user = в екіпажі вже є чотири ваші консолі: завершіть одну з них
crew-nobody = в екіпажі немає { $name }: імена показує `crew`
crew-oneself = ці апарати вже ваші
crew-no-pilot = { $name } — не пілот: апаратами керують лише пілоти
crew-not-yours = { $vehicles } керуєте не ви
crew-yours = { $vehicles } уже керуєте ви
crew-several = ці апарати мають кількох пілотів: просіть апарати одного пілота
crew-no-vehicle = у цьому польоті немає такого апарата
crew-many-proposals = вісім ваших пропозицій чекають на відповідь: дочекайтеся однієї з них
crew-several-proposals = чекають кілька пропозицій: { $proposals }: вкажіть, яку саме, наприклад `crew accept { $vehicles }` або `crew accept { $vehicles } from ІМ’Я`
crew-other-proposals = такої пропозиції немає; чекають: { $proposals }
crew-nothing = жодна пропозиція не чекає на вашу відповідь
crew-overtaken = запізно: пропозиція вже не діє
crew-not-connected = немає зв’язку з господарем польоту
crew-own-files = учасникові недоступно: команда використовує файли на машині господаря польоту
crew-observer = спостерігачі не дають команд
crew-not-open = ця команда не належить до вашої ролі: { $role }
crew-unconfirmed = `{ $verb }` потребує підтвердження
crew-not-flying = господар зараз не виконує польоту
crew-not-begun = завдання ще не почалося: господар польоту читає опис
crew-late = господар польоту був зайнятий { $seconds } с: дайте команду ще раз
crew-exam = іспит складають поодинці
crew-line-long = команда задовга
crew-host-decides = це може лише господар польоту: команда стосується всього польоту
crew-stay = ця консоль показує політ господаря: `quit` — вийти з екіпажу
crew-live = політ у господаря ще триває: його не можна зупинити чи перемотати
crew-denied-version = господар польоту використовує версію { $host } протоколу: потрібна та сама версія sortie
crew-denied-hello = господар польоту не зрозумів цієї консолі
crew-many-records = господар польоту починає забагато записів: приєднайтеся до екіпажу ще раз
crew-unrecorded = екіпажу потрібен запис польоту: дозвольте записи (`records.enabled`)
crew-not-opened = екіпаж не відкрито: { $fault }
crew-no-socket = { $socket } уже існує і не є сокетом: виберіть іншу назву
crew-in-use = на { $socket } вже є екіпаж іншої консолі: виберіть іншу назву або завершіть її
crew-no-access = не вдалося відкрити { $socket }: { $error }
crew-folder = { $folder } належить іншому користувачеві або може бути змінена іншими: виберіть іншу назву
crew-stranger = екіпаж на { $socket } належить користувачеві { $user }, а не { $host }
crew-not-joined = до екіпажу не приєднатися: { $fault }
crew-not-there = екіпажу { $name } немає: господар польоту відкриває його командою `sortie fly ЗАВДАННЯ --crew { $name }`
crew-no-data = учасникові потрібна папка даних для запису польоту
practice-crew = завдання не призначене для екіпажу

# Запитання перед виходом
crew-ask-quit-vehicles = далі апаратами { $vehicles }, якими керуєте ви, керуватиме { $host }
crew-ask-quit-role = ви втратите роль: { $role }
