# Екран польоту: таблиця, телеметрія, сповіщення; і те, що стоїть по краях кожного екрана.

prompt-filter = показати лише

fly-swarm = рій
fly-notices = сповіщення
traffic-title = повітряний рух
traffic-none = про інші повітряні судна нічого не відомо
traffic-aircraft = { $name }: { $height } m над рівнем моря, курс { $course }, { $speed } m/s, вертикально { $climb } m/s, дані { $age } s тому
traffic-approach = апарат { $vehicle }: зараз { $distance } m, по висоті { $height } m; найближче через { $seconds } s: { $across } m, по висоті { $above } m
traffic-leaves = апарат { $vehicle }: зараз { $distance } m, по висоті { $height } m; ближче не підійде
fly-no-flight = політ не триває: `leave` веде на екран «початок», де його обирають
fly-waiting = очікування першого апарата ...
fly-rows = { $first }-{ $last } з { $count }
fly-filtered = показано { $shown } з { $all }: «{ $filter }»
fly-none-fit = жоден апарат не відповідає «{ $filter }»: { $key } прибирає фільтр
fly-by = за «{ $column }»
fly-selected = вибрано { $count }: { $vehicles }
fly-selected-hidden = вибрано { $count } (приховано { $hidden }): { $vehicles }
fly-sorted = порядок за «{ $column }»; { $key } змінює його на зворотний
fly-sorted-reversed = порядок за «{ $column }», спершу найбільші
fly-no-column = невідомий стовпець `{ $word }`
fly-columns-are = стовпці: { $columns }
fly-no-group = немає групи `{ $name }`
forget-done = забуто: { $vehicles }
forget-heard = { $vehicles }: на зв'язку; забути можна лише апарати, зв'язок з якими втрачено
forget-none-lost = жоден апарат не втратив зв'язку: забувати нема чого
forget-not-here = апарати симулятора забути не можна: `forget` діє лише з `connect`
fly-ungrouped = групу @{ $name } видалено
fly-place = { $at } з { $count }
fly-log-keys = { $scroll } гортати   { $key } закрити
fly-nothing-yet = поки що нічого

fly-armed = АКТИВ.
fly-ready = готов.
fly-off = вимк.
fly-ground = земля
fly-air = повітря
fly-moving = рух
fly-still = стоїть
fly-takeoff = зліт
fly-paused = пауза
fly-landing = посадка
fly-lost = НЕМАЄ
fly-done = виконано
fly-over = завершено
fly-own = ви
fly-no-effect = без ефекту
fly-timed-out = без відп.
fly-try = спроба { $count }

column-id = №
column-name = тип
column-group = група
column-pilot = пілот
column-mode = режим
column-armed = двиг.
column-state = стан
column-alt = вис. m
column-speed = m/s
column-bat = акум
column-gps = GPS
column-link = зв'яз
column-home = дім m
column-command = команда
column-to-go = ціль m
column-heading = курс
column-climb = набір
column-volt = V
column-amps = A
column-used = mAh
column-hdop = HDOP
column-round-trip = ms
column-ekf = EKF
column-vibe = вібр
column-item = пункт
column-next = до пункту
column-end = кінець
column-sea = море m
column-lat = широта
column-lon = довгота
column-alert = тривога

severity-emergency = АВАР.
severity-alert = ТРИВ.
severity-critical = КРИТ.
severity-error = ПОМИЛ
severity-warning = УВАГА
severity-notice = прим.
severity-info = інфо
severity-debug = налаг

telemetry-title = телеметрія
telemetry-vehicle = апарат { $vehicle }  { $name }
telemetry-mode = режим
telemetry-height = висота
telemetry-speed = швидк.
telemetry-battery = акумул.
telemetry-return = додому
telemetry-home = дім
telemetry-target = ціль
telemetry-place = позиція
telemetry-gps = GPS
telemetry-ekf = EKF
telemetry-attitude = нахил
telemetry-link = зв'язок
telemetry-reboots = перезап.
telemetry-wind = вітер
telemetry-vibration = вібрація
telemetry-ground = земля
telemetry-plan = план
telemetry-rc = RC
telemetry-servos = серво
telemetry-load = процесор
telemetry-firmware = прошивка
telemetry-no-heartbeat = ще немає HEARTBEAT
telemetry-armed = АКТИВНІ
telemetry-disarmed = неактивні
telemetry-altitudes = { $altitude } m  набір { $climb }  море { $sea } m
telemetry-sea = море { $sea } m
telemetry-speed-heading = { $speed } m/s  курс { $heading }°
telemetry-speed-alone = { $speed } m/s
telemetry-here = тут
telemetry-way-home = { $needed } % ({ $time } із { $lasts })
telemetry-bearing = { $distance } m  пеленг { $bearing }°
telemetry-away = за { $distance } m
telemetry-at = на { $altitude } m
telemetry-satellites = { $count ->
    [one] { $count } супутник
    [few] { $count } супутники
   *[many] { $count } супутників
}
telemetry-ekf-ok = ок
telemetry-ekf-lost = без позиції
telemetry-roll-pitch = крен { $roll }°  тангаж { $pitch }°
telemetry-link-lost = НЕМАЄ вже { $seconds } s
telemetry-round-trip = відгук { $ms } ms
telemetry-wind-from = { $speed } m/s з { $from }°
telemetry-vibrations = { $levels } m/s²  насичень { $clipped }
telemetry-below = { $metres } m під апаратом
telemetry-item = пункт { $item } з { $total }
telemetry-item-times = { $item }/{ $total }: { $way }, кінець { $end }
telemetry-item-paused = { $item }/{ $total }: пауза, { $way }
telemetry-paused = пауза

landed-unknown = невідомо
landed-ground = на землі
landed-air = у повітрі
landed-moving = рухається
landed-still = стоїть
landed-takeoff = злітає
landed-landing = сідає

header-armed = { $vehicles }, активних { $armed }
header-armed-short = активних { $armed }/{ $all }
header-dropped = пропущено сповіщень: { $count }
header-dropped-short = пропущено { $count }
header-no-link = немає зв'язку
header-link-up = зв'язок є
header-link-silent = канал відкрито, даних немає
header-link-down = { $name }: обрив
header-links = каналів працює { $up }/{ $all }
header-links-short = зв'язок { $up }/{ $all }

footer-vehicles = апарати
footer-list = { $submit } вибирає   { $commands } пишуть команду   { $escape } скасовує
footer-deaf = клавіші на мить не діють
footer-paste-lines = нічого не вставлено: у тексті рядків { $count }, а командний рядок приймає один
footer-paste-dropped = нічого не вставлено: спершу відкрийте командний рядок клавішею { $key }

hint-move = рух
hint-take = вибрати
hint-command = команда
hint-help = довідка
hint-commands = команди
hint-quit = вийти
hint-select = вибрати
hint-list = за номером
hint-all = усі
hint-none = жодного
hint-filter = фільтр
hint-sort = порядок
hint-acknowledge = підтвердити
hint-look-back = історія
hint-rooms = екрани
hint-open = відкрити
hint-outcome = результат
hint-own = апарат
hint-back = назад
hint-scroll = гортати
hint-again = ще раз
hint-home = початок

commands-pane = журнал команд
commands-none = команд ще немає, натисніть { $key }
commands-none-replayed = команд ще не було
commands-none-fit = жодна команда не відповідає фільтру: { $key } показує всі
commands-follows = стежить за найновішою
commands-only-vehicles = { $count ->
    [1] лише апарат { $vehicles }: { $shown } з { $all }
   *[other] лише апарати { $vehicles }: { $shown } з { $all }
}
commands-only-failed = лише невдалі
commands-only-under-way = лише незавершені
commands-only-done = лише виконані
commands-time = час
commands-line = команда
commands-to = кому
commands-answer = відгук
commands-outcome = результат
commands-tries = спроб
commands-more = ... ще { $count }: { $key } показує всі
commands-sent-times = { $count ->
    [0] 0 спроб
    [one] { $count } спроба
    [few] { $count } спроби
   *[many] { $count } спроб
}
hint-vehicle = апарат
hint-window = проміжок
hint-page = сторінка
hint-cursor = курсор
hint-zoom = масштаб
hint-fit = усе
hint-follow = стежити
hint-goto = goto
hint-ruler = лінійка
hint-signs = позначки
hint-trails = шляхи

header-paused = ПАУЗА
header-speedup = { $rate }x
window-over = завершено
window-paused = пауза
window-reading = інструктаж
window-armed = активних { $armed } з { $all }
window-ground = на землі
header-reading = відлік не почато
hint-predict = прогноз
hint-goal = мета
hint-hint = підказка
hint-pause = пауза
hint-abandon = припинити
hint-section = розділ
hint-new-try = ще раз
hint-alike = тренуватися
hint-next = далі
hint-fly = летіти
hint-start = почати
hint-drill = вправа
hint-truth = насправді
