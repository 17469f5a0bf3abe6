# Помилки у файлах налаштувань, клавіш і тем.

config-unknown = невідоме налаштування `{ $name }`
config-wrong = значенням `{ $name }` має бути { $expected }
config-wrong-word = значенням `{ $name }` має бути { $expected }, а не `{ $word }`
config-section = `{ $name }` — це розділ: напишіть `[{ $name }]` окремим рядком, а його налаштування нижче
config-log-level = невідомі рівні журналу: `{ $written }`; рівні — `error`, `warn`, `info`, `debug` і `trace`, також для одного модуля: `warn,sortie::link=debug`
config-expected-word = одне зі слів: { $choices }
config-expected-text = текст у лапках
config-expected-number = ціле число від { $least } до { $most }
config-expected-flag = `true` або `false`
config-expected-words = список слів, наприклад `["one", "two"]`
config-expected-lines = рядок мови команд у лапках або список таких рядків

config-faulty = пропущено: { $fault }

keymap-no-key = невідома клавіша `{ $key }`
keymap-same-key = термінали надсилають той самий код для `{ $key }` і `{ $other }`
keymap-no-context = невідомий контекст `{ $name }`
keymap-context = `{ $name }` — це контекст: напишіть `[{ $name }]` окремим рядком, а його клавіші нижче
keymap-twice = `{ $key }` уже зайнято в цьому контексті, у рядку { $line }
keymap-shadows = `{ $key }` зайнято в розділі `[anywhere]`, у рядку { $line }
keymap-shadows-advice = призначте одній із двох дій іншу клавішу
keymap-meaning = потрібна назва дії або рядок команд у лапках, або `false`
keymap-no-action = невідома дія чи команда `{ $name }`
keymap-only-actions = клавішам контексту `{ $name }` можна призначити лише дії
keymap-is-text = `{ $key }` у цьому контексті вписує літеру

history-unreadable = не вдалося прочитати історію команд із { $path }: { $error }
mission-twice = два завдання мають id `{ $id }`: використано { $flown }, пропущено { $other }

theme-unknown = невідома тема `{ $name }`
theme-none = невідома тема `{ $name }`: виберіть одну з { $known }
theme-none-near = невідома тема `{ $name }`: виберіть одну з { $known }; можливо, `{ $guess }`?
lang-withheld = локаль без UTF-8: замість мови { $language } вжито англійську (`export LC_ALL=C.UTF-8`)
lang-withheld-ascii = із symbols = "ascii" замість мови { $language } вжито англійську
log-unwritable = не вдається записати журнал { $path }: { $error }
theme-left-out = теми `{ $name }` немає: { $fault }
theme-inherits-itself = тема `{ $name }` успадковує саму себе
theme-circle = теми успадковують одна одну по колу: { $circle }
theme-faulty-parent = батьківська тема `{ $name }` має помилки
theme-unknown-role = невідома роль `{ $name }`
theme-roles-are = ролі: { $roles }
theme-role-table = `{ $name }` має бути таблицею кольорів
theme-role-table-advice = напишіть `{ $example }`
theme-no-style = для ролі `{ $name }` не задано вигляду
theme-no-style-advice = задайте його в розділі `[roles]` або успадкуйте: `inherits = "dark"`
theme-no-colour = `{ $word }` — не колір
theme-no-colour-advice = напишіть `"#rrggbb"`, назву на зразок `"light-red"` або число від 0 до 255 у лапках
