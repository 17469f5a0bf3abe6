# Бали, що на них вплинуло і як здобути більше.

scoring-objective = цілі
scoring-quality = якість
scoring-time = час
scoring-energy = енергія
scoring-safety = безпека
scoring-command = команди
scoring-attention = увага
scoring-utilisation = використання
scoring-crashes = аварії

# Умови золота.
gate-no-crash = жодного втраченого апарата
gate-at-least = { $what } — від { $number }
gate-at-most = { $what } — до { $number }
gate-equal = { $what } — рівно { $number }

scoring-gold = золото
scoring-silver = срібло
scoring-bronze = бронза

# Що вплинуло на складову.
scoring-all-met = { $count ->
    [one] досягнуто { $count } цілі з { $count }
   *[many] досягнуто всіх цілей: { $count }
}
scoring-missed = не досягнуто: { $objectives }
scoring-missed-capped = не досягнуто: { $objectives }; не більше ніж { $most } (обов'язкова ціль)
scoring-needs-mandatory = зараховується, коли досягнуто всіх обов'язкових цілей
scoring-needs-objectives = зараховується, коли досягнуто { $percent } % цілей
scoring-seconds = s
scoring-watt-hours = Wh
scoring-at-par = на рівні норми
scoring-inside-par = краще за норму на { $by } { $unit }
scoring-over-par = гірше за норму на { $by } { $unit }
scoring-no-rule-broken = правил не порушено
scoring-rules-broken = { $worst }; порушено ще правил: { $more }
scoring-no-commands = команд не було
scoring-commands-clean = { $count ->
    [one] { $count } команда, без відмов
    [few] { $count } команди, без відмов
   *[many] { $count } команд, без відмов
}{ $vehicles ->
    [1] {""}
   *[other] ; кожен апарат рахується окремо
}
scoring-commands-forgiven = команд: { $count }, пробачено відмов: { $forgiven }
scoring-commands-faulty = { $count ->
    [one] { $faults }; { $count } команда
    [few] { $faults }; { $count } команди
   *[many] { $faults }; { $count } команд
}{ $vehicles ->
    [1] {""}
   *[other] , кожен апарат рахується окремо
}
scoring-rejected = відхилено { $count }
scoring-unsafe = небезпечних { $count }
scoring-twice = повторних { $count }

# Що дало б більше.
scoring-improve-quality = Підвищте якість з { $from } до { $to } ({ $now }).
scoring-improve-quality-how = Підвищте якість з { $from } до { $to } ({ $now }): { $how }.
scoring-be-faster = Зекономте { $seconds } s, щоб укластися в норму.
scoring-use-less = Зекономте { $energy } Wh, щоб укластися в норму.
scoring-advice-commands = Уникайте відмов: прочитайте причину, перш ніж повторити команду.
scoring-advice-unsafe = Уникайте небезпечних команд: не зупиняйте двигунів у повітрі й чекайте, доки пройдуть передпольотні перевірки.
scoring-advice-twice = Давайте кожну команду один раз: дочекайтеся її результату, перш ніж повторювати.
scoring-advice-mandatory = Досягніть усіх обов'язкових цілей ({ $objectives }): без цього бали обмежено.
scoring-advice-geofence = Не вилітайте за межі геозони: перш ніж надіслати, звірте числа в `goto` з картою.
scoring-advice-height = Тримайтеся нижче від межі висоти; її вказано в інструктажі.
scoring-advice-crash = Не втрачайте апаратів: дрон садіть командою `rtl` або `land`, доки двигуни не деактивуються, а робота ведіть не швидше, ніж каже інструктаж.
scoring-advice-motors = Ніколи не зупиняйте двигунів у повітрі; політ завершують `rtl` або `land`.
scoring-advice-force = Не активуйте двигунів примусово: зачекайте, доки пройдуть передпольотні перевірки.
scoring-advice-reserve = Повертайтеся раніше: сідайте, поки заряд не нижчий за резерв.
scoring-advice-land = Посадіть усі дрони до завершення завдання.
scoring-advice-pad = Сідайте на майданчик: `rtl` летить туди сам.
scoring-advice-battery = Повертайтеся, перш ніж спрацює аварійна реакція на низький заряд.
scoring-advice-failsafe = Стежте за тривогами апарата: спрацювала аварійна реакція (FAILSAFE).

# Увага.
scoring-alerts-answered = { $count ->
    [one] на { $count } тривогу відповіли вчасно
   *[many] на всі тривоги ({ $count }) відповіли вчасно
}
scoring-alerts-late = { $worst }; ще тривог із запізненням: { $more }
scoring-alert-unanswered = { $alert }: без відповіді
scoring-alert-took = { $alert }: { $seconds } s (межа { $limit } s)
scoring-advice-alerts = Відповідайте на тривоги вчасно: спершу зупиніть дрон, потім читайте. На «{ $alert }» відводилося { $limit } s.

# Завантаження.
scoring-none-flown = жоден апарат не працював
scoring-never-flown = апарати, що не працювали: { $vehicles }
scoring-idle = апарат { $vehicle } простояв { $time }
scoring-never-idle = жоден з апаратів ({ $count }) не простоював
scoring-advice-unused = Залучіть і апарат { $vehicle }: дайте йому частину роботи.
scoring-advice-idle = Давайте апарату { $vehicle } наступну роботу, доки він не скінчив попередньої: він чекав { $time }.
scoring-advice-slack = Нехай усі апарати будуть зайняті однаково довго: давайте кожному наступну роботу, доки він не скінчив попередньої.

# Підказки.
scoring-advice-hints = { $count ->
    [1] Виконайте завдання ще раз без підказки.
   *[many] Виконайте завдання ще раз без підказок ({ $count }).
}

# Правила польотів.
scoring-advice-no-fly = Оминайте заборонені зони. Якщо така з'явилася навколо дрона, спершу зупиніться, потім вийдіть із зони найкоротшим шляхом.
scoring-advice-separation = Тримайте дрони на відстані один від одного: дайте кожному свою висоту або свою ділянку, перш ніж їхні шляхи перетнуться.
scoring-advice-aircraft = Пропускайте літаки: одразу знижуйтеся або сідайте й чекайте, доки вони пролетять.
scoring-advice-people = Зупиняйтеся, коли наближаються люди, і пролітайте високо над тими, хто залишається.
