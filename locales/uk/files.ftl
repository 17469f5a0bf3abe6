# Файли, яких немає змоги прочитати чи записати.

file-more-faults = { $count ->
    [one] і ще { $count } помилка
    [few] і ще { $count } помилки
   *[many] і ще { $count } помилок
}
file-unreadable = не вдається прочитати { $path }: { $error }
file-unwritable = не вдається записати { $path }: { $error }
file-exists = { $path } вже є
file-too-large = { $path } завеликий: { $kind } має не більше ніж { $most } байтів
file-unknown = невідомо: { $kind } `{ $name }`; вкажіть шлях або одне з: { $known }

file-mission = завдання
file-pilot = скрипт пілота
file-design = проєкт
file-parameters = файл параметрів
file-frame = файл рами
file-theme = тема
file-keymap = розкладка клавіш
file-configuration = файл налаштувань
file-any = завдання, тема, розкладка клавіш, налаштування чи скрипт

record-under-way = цей політ ще триває: розбір буде після нього
record-none = це не запис польоту: консоль записує кожне завдання, а `sortie run --record DIR` записує політ у теку
record-version = це запис польоту у форматі версії { $version }; ця програма читає версію { $known }: скористайтеся тією, що його записала
record-head = перший рядок пошкоджено: { $error }
record-damaged = рядок { $line } пошкоджено: політ оцінено до цього місця
record-no-end = запис обривається ще до завершення польоту: політ оцінено до цього місця
record-mission = ця програма не може прочитати завдання із запису: { $fault }
record-unwritable = Запис зупинено; політ триває: { $fault }
record-differs = Під час польоту було балів: { $before }; тепер програма дає { $now }.
record-no-runs = у теці { $folder } немає записів польотів; виконайте завдання через `sortie fly` або вкажіть запис
journal-none = це не журнал польоту: перший рядок іншого виду
record-not-begun = цей політ не записується, його не можна буде переглянути: { $fault }
record-broken-off = запис цього польоту закінчується тут: { $fault }
record-full = запис цього польоту закінчується тут: він сягнув { $mib } MiB (налаштування `records.space` дає вдвічі більше на всі записи)
journal-damaged = рядок { $line } журналу пошкоджено: команди й закладки відомі до цього місця
record-frames-dropped = диск заповільний для цього польоту: у записі бракує кадрів

# `sortie check`
check-good = { $file }: помилок немає
check-note = { $line } (примітка, не помилка)

# `sortie verify`
verify-other-start = журнал вхідних даних починається з іншого варіанта або інших початкових місць
verify-unfit-input = неможливі вхідні дані
verify-other-state = стан апарата інший
verify-no-vehicle = такого апарата немає
verify-other-position = записана позиція інша
verify-other-mode = записаний режим або активність двигунів інші
verify-other-condition = записаний стан (на землі, готовність) інший
verify-other-battery = записаний стан акумулятора інший
verify-other-text = апарат не надсилав записаного повідомлення
verify-refusals = апарат відхилив команд: { $refused }, у записі: { $admitted }
verify-other-score = записано балів: { $recorded }, із запису випливає: { $score }
verify-no-inputs = цей політ не можна повторити: вхідні дані апаратів не записано
verify-verified = підтверджено: повторний політ { $mission } з варіантом { $seed } збігається із записом; балів: { $score } (tlog і журнал не порівнюються)
verify-verified-flight = підтверджено: повторний політ збігається із записом, тривалість { $length } (tlog і журнал не порівнюються)
verify-differs = розходиться в момент { $seconds } s ({ $what })
verify-of-vehicle = апарат { $vehicle }: { $what }
verify-other-program = інша програма: політ виконала { $program }, тут він розходиться в момент { $seconds } s ({ $what })
verify-other-mission = інше завдання: текст { $mission } у записі (хеш { $hash }) не такий, як у цій програмі
verify-rescored = оцінено знову лише за телеметрією, балів: { $score }, і в записі стільки ж
verify-rescored-other = оцінено знову лише за телеметрією, балів: { $score }, а записано інше
verify-inputs-missing = оцінено знову лише за телеметрією, балів: { $score }; вхідні дані апаратів не записано
verify-damaged = рядок { $line } журналу вхідних даних пошкоджено
verify-no-end = журнал вхідних даних неповний: бракує його кінця
verify-other-clock = годинники завдання й симулятора не збігаються
verify-other-end = медаль, результат або час у кінці не випливають із запису
verify-exam-paused = політ зараховано як іспит, де пауз не буває, але в записі пауза є
verify-own-airframes = політ заліковий, але рами не ті, що дає завдання
verify-beyond-inputs = запис триває далі, ніж журнал вхідних даних
verify-too-many = у журналі вхідних даних дронів: { $count }; більше ніж 255 апаратів у польоті не буває
verify-other-parameter = значення { $name } не те, якого вимагає завдання
verify-altered = запис змінено після польоту: контрольна сума не збігається
verify-programs = файли запису називають різні програми: { $one } і { $other }
verify-other-profile = журнал і політ завдання називають різні профілі
verify-no-state = у журналі вхідних даних бракує стану апаратів, який записують кожні 10 s
verify-no-states = журнал вхідних даних закінчується до першого стану апаратів, який записують кожні 10 s: порівнювати нема чого
verify-verified-part = підтверджено до кінця журналу вхідних даних, { $length }: закінчення в ньому немає (tlog і журнал польоту не порівнюються)
verify-other-journal = журнал належить іншому польоту
verify-own-mission = це завдання не належить до курсу
verify-other-backend = за записом літав ArduPilot, але поруч лежить журнал вхідних даних вбудованого симулятора
verify-no-checksum = запис не має контрольної суми, тож пізніших змін у ньому не помітити
verify-stated = лише зазначено в записі, не доведено: програма { $program }, профіль { $profile }, дата { $when }, хто керував (людина чи скрипт), номер спроби й те, як зараховано
verify-stated-guest = лише зазначено в записі, не доведено: програма { $program }, без профілю, дата { $when }, хто керував (людина чи скрипт), номер спроби й те, як зараховано
verify-stated-free = лише зазначено в записі, не доведено: програма { $program }

# `sortie records key` і `sign`, підписи в `sortie verify`
sign-file = { $path }: { $error }
sign-key = { $path } не є придатним ключем `minisign`: { $why }
sign-password = пароль не прочитано ({ $why }): потрібен термінал або ключ, створений командою `sortie records key --no-password`
sign-key-exists = { $path } уже існує: видаліть його або виберіть іншу теку через `--output`
sign-being-written = запис ще триває: підпишіть його після польоту
sign-no-key = ключа { $path } немає: створіть його командою `sortie records key` або вкажіть через `--key`
sign-key-made = ключ { $key }: { $secret } тримайте при собі, { $public } дайте тим, хто перевіряє ваші записи
sign-signed = { $count ->
    [one] підписано ключем { $key }: { $count } файл
    [few] підписано ключем { $key }: { $count } файли
   *[other] підписано ключем { $key }: { $count } файлів
}
sign-none = не підписано
sign-unchecked = вказано підпис ключем { $key }; його перевіряє `--public-key`
sign-valid = підписано ключем { $key } ({ $comment })
sign-invalid = підпис файлу { $file } недійсний: { $why }
sign-unreadable = його не вдається прочитати: { $error }
sign-damaged = його пошкоджено
sign-other-key = його зроблено іншим ключем, { $key }
sign-changed = файл або підпис потім змінено
sign-other-file = у ньому не вказано цього файлу; приймаються лише підписи `sortie records sign`
sign-mixed = інші файли підписано в інший час або іншим ключем
sign-missing = файлу немає
sign-partial = файл { $file } не підписано, а інші файли запису підписано
