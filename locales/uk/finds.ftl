# Датчики, що виявляють об'єкти.
mission-sensor-camera = камера
mission-sensor-zoom = камера із зумом
mission-sensor-thermal = тепловізор
mission-sensor-magnetometer = магнітометр
mission-sensor-metal-detector = металошукач
mission-sensor-radar = георадар

# Що знаходять датчики. Знахідки звуться c1, c2 і так далі.
contact-mine = міна
contact-person = людина
contact-fire = вогонь
contact-defect = дефект
contact-leak = витік
contact-source = джерело
contact-peak = пік
contact-found = { $contact }: { $kind }?  n { $north } e { $east }  { $sensor }
contact-confirmed = { $contact }: { $kind }, підтверджує { $sensor }
contact-harmless = { $contact }: безпечне

# Повідомлення про знахідки.
detect-result = F{ $beta } { $score }: знайдено { $found }/{ $there }, хибних { $wrong }, повторних { $repeated }
detect-result-cost = F{ $beta } { $score } ({ $measure } мінус { $cost } за хибні повідомлення): знайдено { $found }/{ $there }, хибних { $wrong }, повторних { $repeated }
detect-outlook = { $count ->
    [0] не повідомлено
   *[other] оцінка потім: { $count }
}
detect-quality = повнота { $recall }, точність { $precision }
detect-target = F{ $beta } { $target }, у межах { $radius } m
detect-target-cost = F{ $beta } { $target }, у межах { $radius } m; хибне повідомлення коштує { $cost } знахідки
detect-quality-none = повідомляйте про знайдене до кінця польоту
detect-quality-advice = перш ніж повідомляти, підтверджуйте кожен контакт іншим датчиком або зблизька
detect-advice-none = Повідомляйте про знайдене до кінця польоту: `mark contacts` повідомляє про всі відкриті контакти.
detect-advice-blind = Повідомляйте лише про те, що знайшов датчик (повідомлень про місця, де датчик нічого не знайшов: { $count }).
detect-advice-missed = Огляньте ділянку ще раз, нижче й повільніше, і підтверджуйте кожен контакт, перш ніж повідомляти (пропущено: { $missed }, хибних повідомлень: { $wrong }).
detect-advice-wrong = Перш ніж повідомляти, підтверджуйте кожен контакт іншим датчиком або зблизька (хибних повідомлень: { $wrong }).

# Огляд зблизька перед повідомленням.
checked-result = { $all ->
    [0] немає
   *[other] { $count } із { $all }
}
checked-target = усі повідомлення
checked-advice = Перш ніж повідомити про місце, протримайтеся { $dwell } s не далі як за { $radius } m від нього на швидкості до { $speed } m/s.
checked-advice-cross = { $count ->
    [1] Перш ніж повідомити про місце, перетніть його по прямій, не далі як за { $radius } m від нього, не швидше за { $speed } m/s.
   *[other] Перш ніж повідомити про місце, перетніть його по прямій з { $count } боків, не далі як за { $radius } m від нього, не швидше за { $speed } m/s.
}
checked-advice-heights = Зараховуються лише висоти від { $low } до { $high } m.

# Прохід над зоною.
coverage-result = обстежено { $swept } %; випадковий пошук: { $random } %
coverage-outlook = обстежено { $swept } %
coverage-target = обстежити { $target } %
coverage-advice = Відстань між лініями не має перевищувати ширини смуги датчика: не обстежено { $left } %, хоча пройденого шляху вистачило б, щоб покрити ділянку { $coverage } раза.
coverage-advice-lines = Обстежте всю ділянку лініями, відстань між якими не перевищує ширини смуги датчика.

# Дотримання відстані.
standoff-result = { $close ->
    [0] { $share } % із { $near } s
   *[other] { $share } % із { $near } s, заблизько { $close } s
}
standoff-target = { $share } % часу на відстані від { $nearest } до { $farthest } m
standoff-advice = { $close ->
    [0] Летіть уздовж споруди на відстані від { $nearest } до { $farthest } m, щонайменше { $least } s.
   *[other] Летіть уздовж споруди на відстані від { $nearest } до { $farthest } m (заблизько: { $close } s).
}

# Розмінування.
clear-result = знешкоджено: { $count }
clear-target = мін: { $count }
clear-advice = Спершу хай дрони знайдуть міни, тоді ведіть робота до кожної знахідки зі швидкістю 1 m/s: трал діє до 1.2 m/s, а міна під колесами знищує робота.

# Доставлення.
deliver-kits = { $lost ->
    [0] вчасно: { $done }
   *[other] вчасно: { $done }, ні: { $lost }
}
deliver-nodes = установлено: { $done }
deliver-kits-target = { $target ->
    [one] допомогти { $target } людині
   *[other] допомогти { $target } людям
}
deliver-nodes-target = { $target ->
    [one] установити { $target } вузол
    [few] установити { $target } вузли
   *[many] установити { $target } вузлів
}
deliver-kits-advice = { $lost ->
    [0] Скиньте набір не далі як за 8 m від кожної людини.
   *[other] Знаходьте людей швидше й скидайте набір кожній людині, не далі як за 8 m від неї; не дочекалися допомоги: { $lost }.
}
deliver-nodes-advice = Скидайте вузли не далі як за 6 m від їхніх місць.
people-kit-reached = доставлено людині на відстані { $distance } m
people-kit-lost = у межах { $distance } m нікого немає
people-node-placed = вузол на своєму місці
people-node-lost = у межах { $distance } m немає позначеного місця для вузла

# Плани на борту та дії з ними до польоту.
plan-fault-of = { $vehicle }: { $fault }
plan-fault-sea-level = висота над рівнем моря
plan-fault-outside = точка поза геозоною
plan-fault-endless = нескінченний перехід
plan-fault-stay = зупинка, на яку не стане заряду
plan-fault-copied = план іншого дрона
plan-fault-gap = бракує двох точок
plan-fault-no-return = немає повернення
plan-rehearsed-of = випробувано до польоту: { $good }
plan-unrehearsed = політ без вдалого випробування: { $vehicles }
plan-rehearsed-target = випробувати всі { $count }
plan-rehearsed-advice = Перед першим зльотом — `all plan rehearse`: кожен рядок має закінчитися посадкою. Після кожної зміни плану випробуйте його знову.
plan-mended-of = хибних планів замінено: { $good }
plan-unmended = політ за хибним планом: { $vehicles }
plan-mended-target = жодного польоту за хибним планом
plan-mended-advice = Шукайте хибні плани на землі: `all plan rehearse`, `all plan status` і точки на карті. Завантажте новий план на борт і повторіть випробування.
plan-kept-of = правильних планів без змін: { $good }
plan-unkept = замінено правильні плани: { $vehicles }
plan-kept-target = правильні плани без змін
plan-kept-advice = Замінюйте лише плани, у яких знайшли помилку: новий план може мати свої помилки.
plan-flown-of = вилетіли: { $good }
plan-outlook-rehearsed = випробувано: { $ready }/{ $count }
plan-outlook-unrehearsed = не випробувано: { $vehicles }
plan-outlook-unmended = хибні: { $vehicles }
plan-outlook-unkept = замінено: { $vehicles }
