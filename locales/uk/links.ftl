# Екран «зв'язок».

links-none = каналів немає: під'єднайтеся до апаратів або почніть політ
links-ailing = діагностика зв'язку: { $finding } ({ $key } показує, що спробувати)
links-address = адреса
links-in = прийом B/s
links-out = перед. B/s
links-lost = втрат
links-state = стан
links-check = огляд
links-error = помилка
links-up = працює
links-silent = без даних
link-open-silent = відкрито, даних немає
links-down = обрив
links-fatal = ЗБІЙ
links-fault = збій
links-remark = примітка
links-fine = добре
links-doctor = діагностика зв'язку
links-doctor-of = діагностика зв'язку: канал { $link }
links-received = прийнято
links-sent = передано
links-rates = { $bytes } B/s, { $messages } повід./s
links-round-trip = відгук
links-dropped = відкинуто
links-dropped-figures = хибна CRC { $crc }, шум { $skipped } B, невідомі номери { $unknown }, не розібрано { $undecoded }
links-missing = не дійшло
links-autopilots = автопілоти
links-others = інше
links-other-figures = вузлів { $peers }, повторних з'єднань { $reconnects }, не надіслано { $unsent }
links-control = керує
links-control-free = вільно
links-signing = підписи
links-signing-figures = правильних { $right }, без підпису { $unsigned }, хибний ключ { $foreign }, стара позначка { $old }
links-history = { $way }, { $seconds } s, макс. { $most }

links-key-command = команда
links-key-help = довідка
links-key-choose = вибрати
links-key-messages = повідомлення
links-key-fly = політ

# Спільне користування каналами зв'язку

forwards-title = пересилання: інші наземні станції
forwards-title-mission = пересилання: інші наземні станції, під час завдання лише для читання
forwards-stations = станцій
forwards-received = прийнято
forwards-sent = передано
forwards-dropped = відкин.
forwards-left-out = відсіяно
forward-down = пересилання { $address }: { $reason }
link-loop = { $link }: звідти повертаються власні кадри sortie: пересилання утворюють петлю, і одне з них можна прибрати
forward-loop = пересилання { $address }: повертаються власні кадри sortie: пересилання утворюють петлю, і одне з них можна прибрати
forward-listens = пересилання { $address }: під час завдання інші станції лише слухають; їхні повідомлення до апаратів не доходять
forward-opened = відкрито пересилання { $forward }
forward-closed = закрито пересилання { $address }
forward-no-session = немає каналів зв'язку: під'єднайтеся до апаратів або почніть політ
forward-mission = під час завдання пересилання може бути лише для читання: додайте `read-only` після адреси
forward-open-already = пересилання { $address } вже відкрите: спершу закрийте його
forward-none-there = немає пересилання { $address }: усі пересилання показує `forward`
forward-empty = бракує адреси: напишіть `ADDR [read-only] [only NAMES] [except NAMES] [rate HZ]`
forward-no-value = після `{ $word }` бракує значення
forward-unknown-word = невідоме слово `{ $word }`: після адреси пишіть `read-only`, `only NAMES`, `except NAMES` або `rate HZ`
forward-wrong-rate = `{ $word }` не є частотою: напишіть від 0.1 до 1000 повідомлень за секунду
forward-no-message = невідоме повідомлення `{ $word }`: напишіть назви або номери через кому, наприклад `ATTITUDE,GPS_RAW_INT`
forward-file = { $address } є записом: для пересилання потрібен порт

# Команди інших наземних станцій

foreign-line = НСК { $station }: { $vehicle } { $what }
foreign-upload = { $list } upload, пунктів: { $count }
foreign-steering = керування рухом
foreign-further = інші команди
foreign-unanswered = відповіді ще немає
foreign-stays = залишається { $value }
foreign-repeated = { $outcome }, разів: { $count }
foreign-twin = інша наземна станція має ту саму адресу, що й консоль ({ $system }/{ $component }): апарат { $vehicle } відповів на { $command }, якої звідси не надсилали; задайте тій станції інший номер системи

# The name of a link to a simulator that the console runs.
link-simulator = симулятор
link-sitl = SITL { $vehicle }

# Випробування радіо

links-radio = радіо { $vehicle }
radio-figures = втрати { $loss } %, затримка { $delay } ms, розкид { $jitter } ms
radio-rate = { $rate } B/s
radio-measured = втрачено { $lost_in } % сюди, { $lost_out } % туди; відгук { $trip } ms; { $bytes_in } B/s сюди, { $bytes_out } B/s туди
radio-line = { $asked }; виміряно: { $measured }
radio-on = радіо для { $vehicles } погіршено: { $figures }; завершує це `radio { $vehicles } off`
radio-off = радіо для { $vehicles } більше не погіршено
radio-mission = у завданні радіо задає саме завдання: випробовуйте його у вільному польоті або після `connect`
radio-no-vehicles = там не чути жодного апарата
radio-no-link = каналу { $link } немає: каналів { $count }
radio-no-setting = невідомий параметр `{ $word }`
radio-wrong-value = `{ $word }`: напишіть від { $least } до { $most } { $unit }

sticks-title = стіки апарата { $vehicle }: { $key } відпускає їх
sticks-roll = крен
sticks-pitch = тангаж
sticks-throttle = газ
sticks-yaw = рискання
sticks-keys = стрілки: крен і тангаж; WASD: газ і рискання; відпущена клавіша повертає стік у центр
sticks-released = стіки { $vehicle } повернено передавачу
sticks-replay = запис пілотувати не можна
sticks-none = під курсором немає апарата
