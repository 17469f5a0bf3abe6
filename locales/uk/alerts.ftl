# Що негаразд з апаратами і що робити з тривогами.

alert-motors-stopped = ЗУПИНКА ДВИГУНІВ у повітрі
alert-crashed = РОЗБИТО, двигуни деактивовано
alert-crashed-at = РОЗБИТО, удар на { $speed } m/s
alert-link-lost = БЕЗ ЗВ'ЯЗКУ
alert-other-sender = чути іншого відправника
alert-process = SITL НЕ ПРАЦЮЄ
alert-failsafe = FAILSAFE спрацював
alert-gps-lost = GPS втрачено
alert-gps-glitch = збій GPS
alert-position-jump = СТРИБОК ПОЗИЦІЇ на { $distance } km
alert-ekf-position = EKF без позиції
alert-ekf = EKF { $part } { $ratio }
alert-ekf-velocity = швидкість
alert-ekf-where = позиція
alert-ekf-height = висота
alert-ekf-compass = компас
alert-separation = ЗАБЛИЗЬКО до { $vehicle }: { $across } m, по висоті { $height } m
alert-traffic = ПОВІТРЯНЕ СУДНО { $name }: найближче { $across } m, по висоті { $height } m, через { $seconds } s
alert-battery-critical = АКУМ. { $percent } %
alert-battery-low = заряд низький { $percent } %
alert-turn-back = повертайтеся: { $left } %, треба { $needed } %
alert-out-of-reach = ДОДОМУ НЕ ДОЛЕТІТИ
alert-ceiling = вище за межу висоти { $ceiling } m
alert-fence = поза геозоною
alert-vibration = вібрація { $level }
alert-prearm = активація неможлива

alert-kind-crash = РОЗБИЛИСЯ
alert-kind-gps = GPS ненадійний
alert-kind-ekf = EKF ненадійний
alert-kind-separation = надто близько один до одного
alert-kind-traffic = повітряне судно поруч
alert-kind-battery = заряд низький
alert-kind-way-home = час повертатися
alert-kind-vibration = вібрація
alert-kind-message = серйозне повідомлення

alert-since = { $what }, з { $clock }
alert-of-one = { $vehicle }: { $what }
alert-of-many = { $count ->
    [one] { $count } апарат: { $what }
    [few] { $count } апарати: { $what }
   *[many] { $count } апаратів: { $what }
}
alert-with-vehicles = { $what }: { $vehicles }
alert-and-more = { $first } (+{ $count })
alert-acknowledge-hint = { $key } підтверджує
alert-header = { $count ->
    [one] ! { $count } тривога
    [few] ! { $count } тривоги
   *[many] ! { $count } тривог
}

alert-acknowledged = { $count ->
    [0] нема чого підтверджувати
    [1] { $count } тривогу підтверджено: вона лишається в таблиці, доки не мине
    [one] { $count } тривогу підтверджено: вони лишаються в таблиці, доки не минуть
    [few] { $count } тривоги підтверджено: вони лишаються в таблиці, доки не минуть
   *[many] { $count } тривог підтверджено: вони лишаються в таблиці, доки не минуть
}
alert-muted = тривоги без звуку: { $kind }
alert-unmuted = тривоги знову зі звуком: { $kind }
alert-muted-list = без звуку: { $kinds }
alert-muted-none = усі тривоги зі звуком
alert-no-kind = невідомий вид тривоги: `{ $word }`
alert-kinds-are = види: { $kinds }
