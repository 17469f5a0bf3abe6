# Рядки мови команд: що в них не так і що може йти далі.

grammar-no-command = бракує команди
grammar-no-command-help = наприклад, `all arm` або `1-3 takeoff 20`
grammar-unknown-command = невідома команда `{ $word }`
grammar-did-you-mean = може, `{ $name }`?
grammar-did-you-mean-any = може, { $names }?
grammar-targets-twice = апарати названо двічі
grammar-needs = після { $verb } треба { $missing }
grammar-for-example = наприклад, `{ $line }`
grammar-too-much = зайве `{ $word }`: далі аргументів немає
grammar-say-it-as = пишіть { $usage }
grammar-does-not-fit = `{ $word }` тут не годиться: треба { $expected }
grammar-expected = треба { $expected }
grammar-nothing-more = більше нічого
grammar-or = { $others } або { $last }
grammar-is-missing = бракує { $argument }

grammar-a-number = число
grammar-in-unit = у { $unit }
grammar-range = від { $least } до { $most }
grammar-range-in-unit = від { $least } до { $most } { $unit }

grammar-none-selected = не вибрано жодного апарата: виберіть або назвіть їх, наприклад `all` чи `1-3`
grammar-no-vehicles-yet = апаратів ще немає
grammar-no-group = немає групи `@{ $group }`
grammar-group-empty = група `@{ $group }` порожня
grammar-no-groups = груп не визначено
grammar-there-are = відомі: { $names }
grammar-empty-part = біля коми бракує номера; приклад номерів і діапазонів: `1-4,7`
grammar-backwards = діапазон `{ $range }` у зворотному порядку: пишіть `{ $turned }`
grammar-no-targets = `{ $word }` не називає апаратів: пишіть номер, діапазон на зразок `1-4`, `@group` або `all`
grammar-no-vehicle-number = `{ $word }` — не номер апарата: номери від 1 до { $highest }
grammar-no-vehicle = немає апарата { $vehicle }, є лише { $known }

grammar-not-whole = `{ $word }` — не ціле число
grammar-none-of = `{ $word }` тут не годиться; допустимі: { $choices }
grammar-no-number = `{ $word }` — не число
grammar-out-of-range = `{ $word }` поза межами: { $limits }
grammar-too-large = `{ $word }` завелике
grammar-no-unit-here = `{ $word }`: це число пишуть без одиниці
grammar-wrong-unit = `{ $unit }` сюди не підходить; допустимі: { $known }
grammar-no-mode = невідомий режим `{ $mode }`
grammar-no-mode-copter = у коптера немає режиму `{ $mode }`
grammar-no-mode-plane = у літака немає режиму `{ $mode }`
grammar-no-mode-rover = у ровера немає режиму `{ $mode }`
grammar-no-mode-sub = у підводного апарата немає режиму `{ $mode }`
grammar-no-area = невідома ділянка `{ $area }`
grammar-area = ділянка
grammar-no-items = `{ $word }` не є номером пункту чи діапазоном, як-от `3-5`
grammar-no-longitude = після `{ $latitude }` бракує довготи: запишіть обидва числа, як-от `50.45 30.52`
grammar-no-plan-command = невідома команда плану `{ $word }`
grammar-plan-commands = доповнення показує всі команди, як-от { $words }
grammar-no-plan-field = невідомий параметр `{ $word }`
grammar-no-place = невідоме місце `{ $place }`
grammar-no-contact = контакту `{ $contact }` немає; відомі: { $known }
grammar-no-contact-yet = контакту `{ $contact }` немає: жодного контакту ще не знайдено
grammar-no-parameter = `{ $word }` — не назва параметра: пишіть від 1 до 16 літер, цифр і `_`
grammar-no-message = невідоме повідомлення `{ $word }`
grammar-no-message-id = `{ $word }` — не номер повідомлення: найбільший — { $highest }
grammar-secret-message = { $message } містить ключ або пароль, а цей рядок його показав би й записав
grammar-secret-message-signing = ключ апарату дає `signing setup`
grammar-no-field = у { $message } немає поля `{ $field }`
grammar-fields = його поля: { $names }
grammar-field-twice = поле `{ $field }` вказано двічі
grammar-field-value = бракує значення поля `{ $field }`
grammar-field-value-help = пишіть кожне поле як `НАЗВА=ЗНАЧЕННЯ`
grammar-field-open = бракує закривної `{ $sign }`
grammar-field-escape = невідома послідовність: пишіть `\\`, `\"` або `\x41`
grammar-field-number = поле { $field } приймає число, а не текст
grammar-field-long = у поле { $field } вміщується байтів: { $most }
grammar-field-list = поле { $field } — список, чисел щонайбільше { $most }
grammar-field-list-help = пишіть `{ $field }=[1,2]`
grammar-field-single = поле { $field } приймає одне значення, а не список
grammar-field-elements = елементів у полі { $field } лише { $most }
grammar-no-enum-name = у { $name } немає значення `{ $word }`
grammar-no-mav-cmd = невідома MAV_CMD `{ $word }`
grammar-no-mav-cmd-number = `{ $word }` — не номер MAV_CMD: найбільший — 65535

grammar-by-how-much = після `by` бракує відстані: пишіть `by n 10`, `by e -5` або `by up 2`
grammar-keep-or-face = збережіть курс або візьміть інший: те й інше разом не можна
grammar-heading-range = курс буває від 0° до 360°; щоб повернути ліворуч, пишіть `by`, як-от `yaw by -90`
grammar-which-way = бракує напрямку: пишіть `n`, `e`, `d` або `up` і швидкість
grammar-down-or-up = вкажіть `d` або `up`: те й інше разом не можна
grammar-small-circle = радіус кола має бути щонайменше 1 m
grammar-four-parameters = треба чотири параметри
grammar-unknown-word = невідоме слово

grammar-mode = режим
mode-guided = виконувати команди наземних станцій
mode-auto = летіти за планом на борту
mode-rtl = повернутися до місця зльоту й сісти
mode-smart-rtl = повернутися пройденим шляхом і сісти
mode-land = сісти на місці
mode-brake = зупинитися й тримати позицію
mode-circle = кружляти навколо точки
mode-follow = летіти за іншим апаратом
grammar-change-mode = змінити режим на { $mode }
grammar-stick-sinks = якщо важіль газу внизу, апарат знижується
grammar-stick-falls = якщо важіль газу внизу, апарат падає
grammar-message = повідомлення { $id }
grammar-mav-command = команда { $number }
grammar-every-vehicle = усі апарати
grammar-vehicle = апарат

grammar-none-there = таких немає
grammar-no-name = невідома назва `{ $word }`
grammar-no-vehicles = `{ $word }` не називає апаратів: пишіть номери, `@group`, `all`, `none`, `filter` або `invert`
grammar-largest-first = спершу найбільші
grammar-no-targets-here = `{ $verb }` — команда консолі: апаратів перед нею не пишуть
grammar-only-plain = `{ $verb }` діє лише в консолі без екрана; тут ті самі відомості показує окремий екран
grammar-only-console = `{ $verb }` діє лише в консолі: у скрипті цієї команди немає

grammar-script-selection = у скрипті немає вибраних апаратів
grammar-say-who = назвіть апарати, як-от `{ $line }`
grammar-wait-timed-out = рядок { $line }: `{ $wait }` — час очікування минув
grammar-if-then = після `if` потрібні `then` і команда, як-от `if 3 alerted then 3 rtl`
grammar-if-state = після `if` пишіть стан, як у `if 3 alerted then 3 rtl`
