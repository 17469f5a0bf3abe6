# Що негаразд з апаратами і що робити з тривогами.

alert-motors-stopped = ДВИГУНИ СТАЛИ в повітрі
alert-crashed = РОЗБИВСЯ, двигуни деактивовано
alert-crashed-at = РОЗБИВСЯ { $speed } m/s
alert-link-lost = БЕЗ ЗВ'ЯЗКУ
alert-process = SITL НЕ ПРАЦЮЄ
alert-failsafe = FAILSAFE спрацював
alert-gps-lost = GPS втрачено
alert-gps-glitch = збій GPS
alert-ekf-position = EKF без позиції
alert-ekf = EKF { $part } { $ratio }
alert-ekf-velocity = швидкість
alert-ekf-where = позиція
alert-ekf-height = висота
alert-ekf-compass = компас
alert-battery-critical = АКУМ. { $percent } %
alert-battery-low = заряд низький { $percent } %
alert-turn-back = час додому: { $needed } із { $left } %
alert-out-of-reach = ДОДОМУ НЕ ДОЛЕТИТЬ
alert-fence = за межами зони
alert-vibration = вібрація { $level }
alert-prearm = не готовий до зльоту

alert-kind-crash = РОЗБИЛИСЯ
alert-kind-gps = GPS ненадійний
alert-kind-ekf = EKF ненадійний
alert-kind-battery = заряд низький
alert-kind-way-home = час повертатися
alert-kind-vibration = вібрація
alert-kind-message = серйозне повідомлення

alert-since = { $what } з { $clock }
alert-of-one = { $vehicle }: { $what }
alert-of-many = { $count ->
    [one] { $count } апарат: { $what }
    [few] { $count } апарати: { $what }
   *[many] { $count } апаратів: { $what }
}
alert-with-vehicles = { $what }: { $vehicles }
alert-and-more = { $first } (+{ $count })
alert-acknowledge-hint = { $key } бере до відома
alert-header = { $count ->
    [one] { $count } тривога
    [few] { $count } тривоги
   *[many] { $count } тривог
}

alert-acknowledged = { $count ->
    [0] немає чого брати до відома
    [one] { $count } тривогу взято до відома: вона лишається в таблиці, доки не мине
    [few] { $count } тривоги взято до відома: вони лишаються в таблиці, доки не минуть
   *[many] { $count } тривог взято до відома: вони лишаються в таблиці, доки не минуть
}
alert-muted = тривоги без звуку: { $kind }
alert-unmuted = тривоги виду { $kind } знову подають сигнал
alert-muted-list = без звуку: { $kinds }
alert-muted-none = усі тривоги подають сигнал
alert-no-kind = немає виду тривог `{ $word }`
alert-kinds-are = види: { $kinds }
