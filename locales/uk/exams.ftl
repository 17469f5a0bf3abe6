## Exams: files, the desk, the seat, seals.

# The file of an exam.
exam-schema = невідома схема { $found }: ця версія читає схему { $known }
exam-layout = `layout` — це `own` або `same`, а не «{ $word }»
exam-time = потрібні дата, час і зсув від UTC: 2026-12-01T09:00:00+02:00
exam-window = іспит закінчився б раніше, ніж почався
exam-missions = { $count ->
    [one] { $count } завдання: в іспиті їх від 1 до { $most }
    [few] { $count } завдання: в іспиті їх від 1 до { $most }
    [many] { $count } завдань: в іспиті їх від 1 до { $most }
   *[other] { $count } завдання: в іспиті їх від 1 до { $most }
}
exam-no-mission = у курсі немає завдання «{ $name }»
exam-no-mission-help = іспитом може бути лише завдання курсу: власне завдання на місцях є тренуванням
exam-mission-twice = «{ $name }» уже є в іспиті: натомість збільште кількість спроб
exam-number = `{ $key }` — число від 1 до { $most }, а не { $found }

exams-title = Іспити
argument-exam-name = назва іспиту або його файл

# The desk.
class-exam-begun = розпочато іспит «{ $exam }»: { $seats }
class-exam-unread = іспит «{ $exam }»: { $fault }
class-exam-other = триває іспит «{ $exam }»; спершу закінчіть його: class exam stop
class-exam-none = зараз немає іспиту
class-exam-found = іспит «{ $exam }» триває далі
class-exam-found-ended = іспит «{ $exam }» закінчено, нових спроб не буде; за тими, що тривають, пульт стежить далі: { $seats }
class-exam-ask-begin = РОЗПОЧАТИ іспит «{ $exam }» на { $count } з { $here ->
    [one] { $here } місця
   *[other] { $here } місць
} на зв'язку: { $seats }
class-exam-ask-begin-reason = їхні перші спроби відкриються, щойно відкриється іспит; відкрита спроба вважається використаною
class-exam-ask-end = Завершити іспит «{ $exam }» від { $began } UTC?
class-exam-ask-end-reason = іспит ще відкритий; він триватиме, якщо його не завершити
class-exam-ask-quit-reason = іспит «{ $exam }» завершиться: нових спроб не буде; ті, що тривають, триватимуть, і відкритий знову пульт за ними стежитиме
class-exam-found-other = раніше розпочатий іспит «{ $exam }» не закінчено, але триває «{ $held }»; щоб продовжити «{ $exam }», закінчіть «{ $held }» і відкрийте пульт знову
class-exam-stopped = іспит «{ $exam }» закінчено: нових спроб не буде, польоти тривають
class-exam-failed = не вдається записати нотатки або результати іспиту; пульт пробує знову щохвилини: { $fault }
class-exam-no-folder = для нотаток і записів іспиту потрібна тека даних: задайте HOME або вкажіть теку через `--data`
class-exam-no-random = система не дала випадкових чисел для варіантів
class-column-exam = іспит
class-exam-cell-waits = чекає
class-exam-cell-opens = відкривається
class-exam-cell-done = готово
class-exam-cell-closed = закрито
class-key-exam = провести іспит
class-deed-try = іспит { $mission }, спроба { $number } з { $tries }
class-refusal-flown = цю спробу вже використано
class-exam-unrecorded = спробу іспиту не відкрито: ця консоль не веде повних записів (`--no-record`, `records.enabled` або ArduPilot як симулятор)
class-refusal-practice = політ був би лише тренуванням: власні файли завдань чи апаратів, інша швидкість, або його не вдалося почати

# The seat.
class-exam-no-restart = спробу іспиту не можна почати спочатку
class-exam-no-leave = під час спроби іспиту не можна вийти з класу: спершу закінчіть політ
class-exam-ask-leave = спробу іспиту буде використано: пульт не відкриє її знову
class-exam-ask-end-try = спроба іспиту на цьому закінчиться: її не зарахують, результату не буде, і її буде використано
class-exam-time-up = час на цю спробу вичерпано

# Seals.
seal-none = печатки ще немає
seal-unreadable = її не вдається прочитати: { $error }
seal-damaged = це не печатка
seal-unsigned = на ній немає підпису
seal-signature = підпис їй не відповідає: печатку змінено або підписано іншим ключем
seal-other-key = її зроблено не тим ключем, якого очікували
seal-other-record = це печатка запису { $record }
seal-other-user = це печатка користувача { $user }
seal-other-class = це печатка класу { $class }
seal-other-result = результат повторного польоту інший
seal-not-sealed = { $file } у печатці немає: файл додано згодом
seal-changed = { $file } — не той файл, який запечатано
seal-missing = немає файлу { $file }
seal-bad = Печатка недійсна: { $fault }.
seal-of = Печатка класу { $class }, іспит { $exam }: { $user }, { $mission }, спроба { $number } з { $tries }, { $score } { $score ->
    [one] бал
    [few] бали
    [many] балів
   *[other] бала
}.
seal-counts = Спробу зараховано.
seal-key-not-compared = Підписано, ключ не звірено: спробу зараховано, якщо це ключ пульта.
seal-counts-not = Спробу не зараховано: { $reasons }.
seal-reason-no-exam = політ не був іспитом
seal-reason-script = команди давав скрипт
seal-reason-mission = завдання не з курсу
seal-reason-fleet = літали апарати, які сконструював курсант
seal-reason-paused = політ призупиняли або консоль зупиняли
seal-reason-no-inputs = у записі немає вхідних даних, тож політ не можна відтворити
seal-reason-late = політ тривав після відведеного часу
seal-reason-unseen = під час польоту пульт не бачив запису
seal-reason-rewritten = запис не той, який пульт бачив під час польоту
witness-whole = Засвідчено: пульт бачив, як ріс запис, { $heads ->
    [one] { $heads } раз
    [few] { $heads } рази
    [many] { $heads } разів
   *[other] { $heads } раза
}, без прогалин.
witness-part = Засвідчено частково: пульт бачив, як ріс запис, { $heads ->
    [one] { $heads } раз
    [few] { $heads } рази
    [many] { $heads } разів
   *[other] { $heads } раза
}; найдовша прогалина { $gap }.
witness-stopped = Засвідчено, але час завдання стояв { $stopped }: пульт бачив, як ріс запис, { $heads ->
    [one] { $heads } раз
    [few] { $heads } рази
    [many] { $heads } разів
   *[other] { $heads } раза
}.
witness-unseen = Не засвідчено.
witness-other = Пульт бачив інший запис: { $record }.
witness-rewritten = Переписано: { $bytes ->
    [one] перший { $bytes } байт запису не той, який бачив пульт.
    [few] перші { $bytes } байти запису не ті, які бачив пульт.
    [many] перші { $bytes } байтів запису не ті, які бачив пульт.
   *[other] перші { $bytes } байта запису не ті, які бачив пульт.
}
seal-key-known = Ключ цього пульта: { $key }
seal-key-other = Інший ключ: { $key }
seal-key-unknown = Ключ: { $key } (не звірено: вкажіть ключ пульта в `--public-key`)

# Reports.
class-report-exams = Іспити
class-report-exam = іспит
class-report-try = спроба
class-report-seal = печатка
class-report-no-record = запису не здано
class-report-try-left = залишено: запис не здано
class-report-try-open = ще триває
class-report-witness = засвідчення
class-report-score = бали
class-key-public = Відкритий ключ цього пульта: { $key }
class-key-fingerprint = Відбиток: { $fingerprint }
class-key-none = цей пульт ще не має ключа: його буде створено, коли запечатають першу спробу

# Кінці записів і пошкоджені нотатки.
seal-reason-left = політ залишили, або його консоль завершила роботу раніше, ніж скінчилося завдання
seal-reason-end-unseen = пульт не побачив кінця запису
seal-reason-no-checksum = кінець запису не має контрольної суми
exam-notes-unreadable = { $file }: нотатки цього іспиту не вдалося прочитати, тож його не продовжено: { $why }
exam-notes-damaged = { $file }, рядок { $line }: цю нотатку пошкоджено, тож іспит не продовжено: { $why }
exam-notes-no-begin = іспит починається не з неї
exam-notes-plan = файл іспиту в ній не відповідає цій версії курсу
exam-notes-time = час у ній неможливий
