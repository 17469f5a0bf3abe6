# Екіпаж: кілька людей керують одним роєм

verb-crew = показати екіпаж або передати апарати
words-crew = команда разом передати пілот учасник
argument-crew-vehicles = апарати, наприклад 1-4,7
argument-crew-name = людина з екіпажу
crew-role-host = ведучий
crew-role-pilot = пілот
crew-role-sensors = датчики
crew-role-safety = безпека
crew-role-observer = спостерігач
crew-list-role = { $name }: { $role }
crew-list-vehicles = { $name }: { $role }, { $vehicles }

# На екрані
header-crew = ЕКІПАЖ
header-crew-lost = ЕКІПАЖ, БЕЗ ЗВ’ЯЗКУ
header-own = ви керуєте { $vehicles }
header-own-none = ви не керуєте апаратами

# Що відбувається
crew-joined = { $who } приєднується до екіпажу: { $role }
crew-left = { $who } більше не в екіпажі
crew-left-with = { $who } більше не в екіпажі: апаратами { $vehicles } керує ведучий
crew-handed-over = { $from } передає { $vehicles }: тепер керує { $to }
crew-offers = { $who } пропонує вам { $vehicles }: `crew accept` або `crew decline`
crew-asks = { $who } просить { $vehicles }: `crew accept` або `crew decline`
crew-waits = очікування згоди, відповідає { $who }: { $vehicles }
crew-declined = { $who } відхиляє передачу { $vehicles }
crew-unanswered = { $who } не відповідає протягом хвилини: { $vehicles }
crew-welcome = екіпаж { $crew }, ведучий { $host }: ви { $name }, { $role }
crew-waiting = очікування екіпажу { $crew }
crew-waiting-flight = очікування польоту, який веде { $host }
crew-lost = зв’язок із ведучим утрачено; консоль пробує ще раз
crew-refused = { $line }: { $reason }
crew-copy = ваш запис польоту: { $file }

# Чому щось неможливо
crew-none = ця консоль не в екіпажі: запустіть її командою `sortie fly --crew НАЗВА` або приєднайтеся командою `sortie crew join НАЗВА`
crew-alone = в екіпажі поки що лише ви
crew-full = в екіпажі немає місця
crew-joined-twice = ця консоль уже в екіпажі
crew-nobody = в екіпажі немає { $name }: імена показує `crew`
crew-oneself = ці апарати вже ваші
crew-no-pilot = { $name } — не пілот: апаратами керують лише пілоти
crew-not-yours = { $vehicles } керуєте не ви
crew-yours = { $vehicles } уже керуєте ви
crew-several = ці апарати мають кількох пілотів: просіть апарати одного пілота
crew-no-vehicle = у цьому польоті немає такого апарата
crew-nothing = жодна пропозиція не чекає на вашу відповідь
crew-overtaken = запізно: пропозиція вже не діє
crew-not-connected = немає зв’язку з ведучим
crew-own-files = учасникові недоступно: команда використовує файли на машині ведучого
crew-observer = спостерігачі не дають команд
crew-not-open = ця команда не належить до вашої ролі: { $role }
crew-unconfirmed = `{ $verb }` потребує підтвердження
crew-not-flying = ведучий зараз не виконує польоту
crew-not-begun = завдання ще не почалося: ведучий читає опис
crew-exam = іспит складають поодинці
crew-line-long = команда задовга
crew-stay = ця консоль показує політ ведучого: `quit` — вийти з екіпажу
crew-live = політ ще триває у ведучого: його не можна зупинити чи перемотати
crew-denied-version = ведучий використовує версію { $host } протоколу: потрібна та сама версія sortie
crew-denied-hello = ведучий не зрозумів цієї консолі
crew-unrecorded = екіпажу потрібен запис польоту: дозвольте записи (`records.enabled`)
crew-not-opened = екіпаж не відкрито: { $fault }
crew-not-there = екіпажу { $name } немає: ведучий відкриває його командою `sortie fly ЗАВДАННЯ --crew { $name }`
crew-no-data = учасникові потрібна папка даних для запису польоту
practice-crew = завдання не призначене для екіпажу
