# Екран з усім про один апарат.

vehicle-none = Ще не чути жодного апарата.
vehicle-place = { $row } з { $count }
vehicle-key-next = наступний апарат
vehicle-key-window = { $seconds } s
vehicle-key-page = сторінка { $page } з { $count }
vehicle-last-known = зв'язок втрачено { $seconds } s тому: останні відомі значення

vehicle-attitude = просторове положення
vehicle-angles = крен { $roll }°  тангаж { $pitch }°

vehicle-state = стан
vehicle-mode = режим
vehicle-mode-set = (задано: { $mode })
vehicle-no-heartbeat = ще немає HEARTBEAT
vehicle-armed = АКТИВНІ
vehicle-disarmed = неактивні
vehicle-on-ground = на землі
vehicle-in-air = у повітрі
vehicle-paused = пауза
vehicle-taking-off = злітає
vehicle-landing = сідає
vehicle-ready = готовність
vehicle-fine = усе гаразд
vehicle-ready-to-arm = готовий до активації двигунів
vehicle-not-ready = готовність ще невідома
vehicle-altitude = висота
vehicle-heights = { $altitude } m  над морем { $sea } m
vehicle-speed = швидкість
vehicle-speeds = { $ground } m/s  повітряна { $air } m/s
vehicle-battery = акумулятор
vehicle-home = дім
vehicle-here = тут
vehicle-target = ціль
vehicle-target-height = на { $altitude } m
vehicle-target-velocity = n { $north } e { $east } up { $up } m/s
vehicle-flight = активні
vehicle-flight-before = востаннє
vehicle-flight-last = активні { $time }
vehicle-link = зв'язок
vehicle-link-good = { $percent } %  відгук { $trip }
vehicle-link-lost = ВТРАЧЕНО { $seconds } s тому
vehicle-wind = вітер
vehicle-wind-unknown = немає оцінки
vehicle-wind-from = { $speed } m/s з { $from }°
vehicle-ground = далекомір
vehicle-place-of = координати
vehicle-load = процесор
vehicle-control = керує
vehicle-control-free = жодна станція
vehicle-control-here = ця консоль
vehicle-control-station = станція { $station }
vehicle-control-open = можна перейняти
vehicle-held = канали RC
vehicle-firmware = прошивка
vehicle-board = плата
vehicle-board-twin = (номер { $system } мають два апарати)

vehicle-curves = останні { $seconds } s
vehicle-least = мін.
vehicle-most = макс.
vehicle-climb = набір
vehicle-voltage = напруга
vehicle-current = струм
vehicle-log-vibration = вібрація
vehicle-log-estimator = тест EKF
vehicle-log-voltage = напруга (журнал)
vehicle-log-current = струм (журнал)
vehicle-remaining = заряд
vehicle-throttle = газ

vehicle-estimate = GPS, EKF, вібрація
vehicle-gps = { $fix } { $satellites }  HDOP { $hdop }
vehicle-gps-unfixed = { $fix }, видно { $satellites }
vehicle-gps-error = похибка GPS
vehicle-ekf-position = позиція відома
vehicle-ekf-lost = позиція невідома
vehicle-ekf-velocity = швидкість
vehicle-ekf-horizontal = позиція
vehicle-ekf-vertical = висота
vehicle-ekf-compass = компас
vehicle-vibration = вібрація { $axis }
vehicle-clipping = насичення
vehicle-limits = межі EKF 0.6/0.8, вібрація 30/60 m/s²
vehicle-grade-good = норма
vehicle-grade-poor = слабко
vehicle-grade-bad = ПОГАНО
vehicle-grade-old = давнє

vehicle-plan = план
vehicle-plan-at = план: пункт { $item } з { $last }
vehicle-plan-paused = план: пауза на пункті { $item } з { $last }
vehicle-plan-empty = порожньо
vehicle-plan-coming = читання { $received } з { $total }
vehicle-plan-unsupported = апарат не підтримує
vehicle-plan-failed = не прочитано: немає відповіді
vehicle-leg = до пункту
vehicle-leg-times = { $way }, кінець { $end }
vehicle-fence = геозона
vehicle-rally = точки збору
vehicle-fence-breached = ПОРУШЕНО

vehicle-outputs = виходи
vehicle-rc-rssi = сигнал RC { $rssi }
vehicle-texts = повідомлення апарата

vehicle-sensors = датчики та функції
sensor-good = норма
sensor-poor = слаб.
sensor-bad = ЗБІЙ
sensor-off = вимк.
sensor-gyro = гіроскоп
sensor-accelerometer = акселерометр
sensor-compass = компас
sensor-barometer = барометр
sensor-airspeed = датчик повітряної швидкості
sensor-gps = GPS
# Щонайбільше 18 колонок.
sensor-gps-fix = GPS (фікс: { $fix })
sensor-flow = оптичний потік
sensor-vision = візуальна навігація
sensor-laser = далекомір
sensor-ground-truth = еталонна позиція
sensor-rate-control = кутові швидкості
sensor-attitude-control = стабілізація
sensor-yaw-control = утримання курсу
sensor-height-control = утримання висоти
sensor-position-control = утримання позиції
sensor-motors = виходи на двигуни
sensor-rc = приймач RC
sensor-gyro-2 = гіроскоп 2
sensor-accelerometer-2 = акселерометр 2
sensor-compass-2 = компас 2
sensor-fence = геозона
sensor-ahrs = AHRS
sensor-terrain = рельєф
sensor-reverse-motor = реверс двигунів
sensor-logging = запис журналу
sensor-battery = акумулятор
sensor-proximity = датчики перешкод
sensor-satellite-link = супутниковий зв'язок
sensor-prearm = передпольотні перевірки
sensor-avoidance = обхід перешкод
sensor-propulsion = силова установка

vehicle-fence-areas = { $count ->
    [0] немає
    [one] { $count } ділянка
    [few] { $count } ділянки
   *[many] { $count } ділянок
}
vehicle-rally-points = { $count ->
    [0] немає
    [one] { $count } точка
    [few] { $count } точки
   *[many] { $count } точок
}

vehicle-severity-emergency = аварія
vehicle-severity-alert = тривога
vehicle-severity-critical = критично
vehicle-severity-error = помилка
vehicle-severity-warning = попередження
vehicle-severity-notice = примітка
vehicle-severity-info = інформація
vehicle-severity-debug = налагодження
vehicle-unexpected = тут не очікується: `all` його не стосується (`connect.expect`)
mode-of-another = режим { $mode } задано не з цієї консолі; на цьому каналі зв'язку є ще й GCS { $system }/{ $component }
