# Записані польоти, перегляд.
replay-badge = ПЕРЕГЛЯД
replay-stopped = зупинено
replay-gap = { $time } нічого не записано
replay-moments = Моменти
replay-none = нічого не переглядається: введіть `replay ФАЙЛ`
replay-refuses = під час перегляду команди не надсилаються: цей політ завершено
replay-refuses-help = щоб літати, вийдіть із перегляду
replay-rate = перегляд x{ $rate }
replay-no-file = немає файлу { $file }
replay-no-frames = { $file } не належить до жодного запису: бракує його .tlog
replay-no-tlog = { $file } не містить кадрів MAVLink: це не tlog
bookmark-nothing = нема чого позначати закладкою: польоту немає
bookmark-not-recorded = цей політ не записується, тож закладку поставити не можна
bookmark-set = закладку поставлено
seek-unreadable = потрібен час, наприклад 12:30, +30, -10 або `end`
loop-unreadable = потрібні два моменти, ранніший перший: 1:10 1:40
argument-seek = 12:30, +30, -10 або `end`
argument-loop = від якого часу до якого
hint-play = пуск
hint-ten-seconds = 10 с
hint-moments = моменти
hint-moment-list = список
keys-replay = Під час перегляду
moment-armed = увімкнено мотори
moment-disarmed = вимкнено мотори
moment-mode = режим { $mode }
moment-refused = { $line }: { $outcome }
moment-refused-why = { $line }: { $outcome }: { $why }
moment-objective = мету досягнуто: { $objective }
moment-near = зблизилися до { $metres } м
moment-kind-bookmark = закладка
moment-kind-refusal = відмова
moment-kind-alert = тривога
moment-kind-mode = режим
moment-kind-arming = мотори
moment-kind-objective = мета
moment-kind-separation = відстань
verb-replay = переглянути записаний політ: запис або tlog
verb-seek = перейти до часу запису
verb-loop = повторювати відрізок запису
verb-stopat = зупиняти перегляд на таких моментах
verb-bookmark = поставити закладку на цей момент
action-play-replay = запустити або зупинити перегляд
action-replay-back = на 10 с назад
action-replay-forward = на 10 с уперед
action-frame-back = попередній кадр
action-frame-forward = наступний кадр
action-previous-moment = попередній момент
action-next-moment = наступний момент
action-show-moments = список моментів запису
export-exists = { $path } уже існує: вкажіть інший шлях
export-unwritable = не вдалося записати { $path }: { $error }
export-done = записано: { $path }
records-total = { $count ->
    [one] { $count } запис
    [few] { $count } записи
   *[other] { $count } записів
}, { $size } МіБ; зберігаються найновіші { $most }, щонайбільше { $space } МіБ
records-no-number = немає запису { $number }: номери показує `sortie records list`
records-number = №
records-began = початок (UTC)
records-subject = політ
records-length = тривалість
records-size = розмір
records-profile = профіль
records-now = записується
records-at = час
records-kind = вид
records-vehicles = апарати
records-what = що
records-in-use = { $name } ще записується
records-confirm = { $count ->
    [one] Буде вилучено { $count } запис: додайте --yes
    [few] Буде вилучено { $count } записи: додайте --yes
   *[other] Буде вилучено { $count } записів: додайте --yes
}
records-deleted = вилучено: { $name }
action-replay-newest = переглянути останній записаний політ
hint-replay = перегляд
records-none = ще нічого не записано: спершу політайте або вкажіть файл
