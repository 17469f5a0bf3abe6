# Запитання, сповіщення й написи самої консолі.

ask-quit = ВИЙТИ
ask-leave = ЗАВЕРШИТИ сеанс
ask-start = ПОЧАТИ інший політ
ask-replay = ПОЧАТИ перегляд запису
ask-review = ВІДКРИТИ аналіз
ask-restart = ПОЧАТИ завдання СПОЧАТКУ
ask-abandon = ПРИПИНИТИ завдання
ask-abandon-reason = дострокове завершення не дає балів; розбір покаже досягнуте
ask-mission-lost = завдання не завершено, його не буде зараховано
ask-given-up = завдання не завершено; вихід припиняє його, і політ зараховується як спроба
ask-exam-ends = іспит не завершено; вихід закінчує його, і політ зараховується
ask-armed = { $count ->
    [one] { $count } апарат з активними двигунами
    [few] { $count } апарати з активними двигунами
   *[many] { $count } апаратів з активними двигунами
}
ask-press = натисніть { $answer ->
    [y] y (н)
   *[other] { $answer }
}
ask-type = введіть { $answer }
ask-how-many = { $answer } (скільки апаратів)
ask-cancelled = скасовано, нічого не зроблено: { $question }

select-missing = немає таких апаратів: { $vehicles }
select-missing-all = немає таких апаратів: { $vehicles }; вибір не змінено

palette-title = команда
palette-grammar = [кому] дієслово [аргументи]: { $complete } доповнює, { $older } повертає давніші рядки
palette-to = кому: { $vehicles }
palette-to-cursor = кому: { $vehicles } (під курсором)
palette-to-selected = кому: { $vehicles } (вибраним)
palette-confirms = { $key } підтверджує
palette-sends = { $key } надсилає; кому: { $vehicles }
palette-asks = { $key } надсилає після підтвердження; кому: { $vehicles }

prompt-connect = під'єднатися до

help-commands = команди: [кому] дієслово [аргументи]
help-console = команди консолі

mission-none = зараз немає завдання
debrief-none = Розбору ще немає: він відкривається, коли завдання завершено; у перегляді запису до нього веде `seek end`.

ask-sure = ви певні?
ask-taken-back = скасовано, нічого не зроблено   { $submit } або { $escape }: назад
ask-else = будь-яка інша: ні

help-title = довідка   { $scroll } гортати   { $section } розділ   { $search } шукати   { $key } закрити
help-none = у довідці нічого не знайдено
help-targets = кому: 3  1-4,7  @group  all; без цього — вибраним апаратам

small-needs = sortie потребує { $columns }x{ $rows }, а термінал має { $now_columns }x{ $now_rows }
small-keys = Збільште термінал або вийдіть із програми: { $key }.

prompt-connect-tcp = ArduPilot SITL, окремий порт для кожного апарата
prompt-connect-udpin = слухати; апарати надсилають сюди
prompt-connect-udp = надсилати апарату або маршрутизатору
prompt-connect-serial = автопілот або радіомодем через кабель
prompt-connect-file = запис польоту
prompt-connect-several = кілька адрес: розділіть їх пробілами.  { $submit } під'єднує, { $escape } закриває

session-free = вільний політ
class-copter = коптер
class-plane = літак
class-rover = ровер
class-boat = човен
class-sub = підводний
class-vehicle = апарат

ids-wrong = `{ $word }` — не апарат: пишіть 3, 3-9 або 1,4-6
group-empty = немає апаратів для цієї групи: спершу виберіть їх або назвіть, як у `group red 1-4`
group-is = @{ $name } тепер { $members }
group-unknown = немає групи `{ $name }`
group-name = `{ $name }` не годиться як назва: лише літери, цифри, - та _
order-hint-price = наступна підказка, рівень { $level }, коштує { $percent } % балів
order-question = { $count ->
    [1] { $verb } апарат { $vehicles }
   *[other] { $verb } апарати { $vehicles }
}
order-no-vehicle = немає апарата { $vehicle }
order-none = `{ $verb }` не надсилає команд
order-wait = `wait` — лише для скриптів пілота
order-wait-help = у консолі дайте наступну команду, коли будете готові
macro-line = рядок { $number } макросу `{ $name }`, `{ $line }`: { $fault }
macro-endless = макрос зупинено після { $count } рядків: чи не викликає він сам себе?

palette-reads-as = буде прочитано як `{ $line }`
palette-given-before = попередній рядок
palette-selects = вибрати для наступних команд

console-no-injects = у цьому завданні вводити події не дозволено
console-no-mission = вводити події можна лише під час завдання
console-kind-theme = тема

setting-theme = кольори
setting-lang = мова: English, українська; профіль її запам'ятовує
setting-symbols = знаки для кривих і карт
setting-fps = найбільше кадрів за секунду
setting-bell = звуковий сигнал про серйозні тривоги
setting-notify = сповіщення на робочому столі про серйозні тривоги
setting-lang-ascii = екран показує лише ASCII: спершу `set symbols block` або `set symbols braille`
