# Записані польоти, перегляд.
replay-badge = ПЕРЕГЛЯД
replay-stopped = зупинено
replay-gap = протягом { $time } нічого не записано
replay-going-to = перехід до { $time }
replay-moments = Моменти
replay-moments-mission = Моменти: час, час завдання
replay-mission-time = завдання { $time }
replay-none = перегляду немає: введіть `replay FILE`
replay-refuses = під час перегляду команди не надсилаються: цей політ завершено
replay-refuses-help = щоб літати, вийдіть із перегляду
replay-rate = перегляд x{ $rate }
replay-rate-limit = перегляд x{ $rate }: запис відтворюється зі швидкістю від x{ $slowest } до x{ $fastest }
replay-no-file = немає файлу { $file }
replay-no-frames = { $file } не належить до жодного запису: бракує його .tlog
replay-no-tlog = { $file } не містить кадрів MAVLink: це не tlog
replay-without-journal = команд і закладок немає, бо журнал цього польоту непридатний: { $fault }
replay-without-run = завдання немає, бо його запис не вдалося прочитати: { $fault }
replay-run-damaged = запис завдання пошкоджено, тому завдання показано лише частково: { $fault }
bookmark-nothing = закладку ставити ніде: польоту немає
bookmark-not-recorded = цей політ не записується, тож закладку поставити не можна
bookmark-set = закладку поставлено
bookmark-renamed = закладку перейменовано
seek-unreadable = потрібен час, наприклад 12:30, +30, -10, `end`, `mission 4:10` або `next refusal`
loop-unreadable = потрібні два моменти часу, раніший — перший: 1:10 1:40, або вид моменту: `bookmark`
loop-none = нема чого повторювати: до показаного моменту або після нього немає моменту цього виду
argument-seek = 12:30, +30, -10, `end`, `mission 4:10`, `next refusal`
argument-loop = початок і кінець відрізка; або вид моменту, щоб повторювати від попереднього до наступного
hint-play = пуск
hint-stop = стоп
hint-ten-seconds = 10 s
hint-moments = моменти
hint-moment-list = список
keys-replay = Під час перегляду
moment-armed = двигуни активовано
moment-disarmed = двигуни деактивовано
moment-mode = режим { $mode }
moment-refused = { $line }: { $outcome }
moment-refused-why = { $line }: { $outcome }: { $why }
moment-objective = ціль досягнуто: { $objective }
moment-near = зблизилися до { $metres } m
moment-nearest = найменша відстань за політ: { $metres } m
moment-kind-bookmark = закладка
moment-kind-refusal = відмова
moment-kind-alert = тривога
moment-kind-mode = режим
moment-kind-arming = двигуни
moment-kind-objective = ціль
moment-kind-separation = відстань
verb-replay = переглянути записаний політ: запис або tlog
verb-seek = перейти до часу в записі
verb-loop = повторювати відрізок запису
verb-stopat = зупиняти перегляд на моментах цих видів
verb-bookmark = поставити закладку на цей момент
action-play-replay = запустити або зупинити перегляд
action-replay-back = перейти на 10 s назад
action-replay-forward = перейти на 10 s уперед
action-replay-faster = прискорити перегляд
action-replay-slower = сповільнити перегляд
action-frame-back = показати попередній кадр
action-frame-forward = показати наступний кадр
action-previous-moment = перейти до попереднього моменту
action-next-moment = перейти до наступного моменту
action-show-moments = показати список моментів запису
export-exists = { $path } уже існує: вкажіть інший шлях
export-unwritable = не вдалося записати { $path }: { $error }
export-no-positions = у записі немає позицій (`GLOBAL_POSITION_INT` або `LOCAL_POSITION_NED` з початком координат): у файлі немає треків
export-done = записано: { $path }
records-total = { $count ->
    [one] { $count } запис
    [few] { $count } записи
   *[other] { $count } записів
}, { $size } MiB; зберігаються найновіші { $most }, разом щонайбільше { $space } MiB
records-not-numbers = `{ $word }` — не запис: пишіть 3, 3-9 або 1,4-6
records-not-a-file = { $file } — не файл: вкажіть файл запису або tlog
records-unknown = немає ні запису, ні файлу { $name }: записи показує `sortie records list`
records-no-number = немає запису { $number }: номери показує `sortie records list`
records-number = №
records-began = початок (UTC)
records-subject = політ
records-length = тривалість
records-size = розмір
records-profile = профіль
records-now = записується
records-at = час
records-mission-time = час завдання
records-kind = вид
records-vehicles = апарати
records-what = подія
records-in-use = { $name } ще записується
records-confirm = { $count ->
    [one] буде видалено { $count } запис: додайте --yes
    [few] буде видалено { $count } записи: додайте --yes
   *[other] буде видалено { $count } записів: додайте --yes
}:
  { $names }
records-reversed = діапазон { $range } записано навпаки: спершу вкажіть менший номер
records-result = результат
records-seed = варіант
records-passed = виконано { $score }
records-not-passed = не виконано { $score }
records-cut-off = перервано
records-deleted = видалено: { $name }
action-replay-newest = переглянути останній записаний політ
hint-replay = перегляд
records-none = ще нічого не записано: спершу політайте або вкажіть файл
verb-rewind = відтворювати запис у зворотному напрямку
action-rewind = відтворювати запис у зворотному напрямку
