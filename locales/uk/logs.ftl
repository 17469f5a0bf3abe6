# Журнали апаратів і те, що вони додають до запису.
log-is-none = це не журнал DataFlash: у ньому немає описів форматів
log-is-empty = у журналі немає даних про політ
log-cut-off = журнал обірваний: останній запис неповний, байтів: { $bytes }
log-damaged = журнал пошкоджений, байтів поза записами: { $bytes }
log-left-out = пропущено подій: { $count }; з журналу додається щонайбільше { $most } кожного виду
log-unreadable = { $file }: { $error }
log-mode-why = режим { $mode } ({ $reason })
log-error = помилка { $part }: { $code }
log-event = подія { $name }
log-parameter = { $name } = { $value } (було { $before })
log-vibration = вібрація до { $most } m/s²
log-clipping = { $count ->
    [one] акселерометри сягнули межі { $count } раз
    [few] акселерометри сягнули межі { $count } рази
   *[other] акселерометри сягнули межі { $count } разів
}
log-estimator = EKF відкидає { $of }: тестове відношення до { $most }
log-of-velocity = швидкість
log-of-position = позицію
log-of-height = висоту
log-of-compass = компас
log-battery = найнижча напруга акумулятора { $number }: { $volt } V за струму { $ampere } A
log-by-gps-time = часом GPS і часом від запуску
log-by-boot-time = часом від запуску й активацією двигунів
log-by-boot-time-only = самим лише часом від запуску (журнал і запис можуть бути з різних польотів)
log-by-arming = активацією двигунів
log-no-vehicle = у журналі не вказано апарата, а в записі їх { $count }: додайте `--vehicle`
log-not-in-record = це журнал апарата { $vehicle }, якого немає в записі
log-other-vehicle = це журнал апарата { $named }, а не { $wanted }: не вказуйте `--vehicle`
log-no-common-time = журнал і запис не мають спільного часу: журнал іншого польоту або іншого запуску
log-other-arming = журнал і запис збігаються в часі, але двигуни активні лише в одному з них: це журнал іншого польоту
log-other-mode = журнал і запис збігаються в часі, але показують різні режими: це журнал іншого польоту
log-other-position = журнал і запис збігаються в часі, але показують різні позиції: це журнал іншого польоту
log-join-unreadable = приєднані до запису дані журналу не читаються: { $error }
log-join-other = { $file } пропущено: він від апарата { $vehicle }
log-join-later = приєднані до запису дані журналу записала новіша версія sortie (формат { $version }): оновіть sortie
log-joined = { $count ->
    [one] { $count } подію апарата { $vehicle } приєднано за { $by }: { $path }
    [few] { $count } події апарата { $vehicle } приєднано за { $by }: { $path }
   *[other] { $count } подій апарата { $vehicle } приєднано за { $by }: { $path }
}
