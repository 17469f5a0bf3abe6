# Як іде завдання: поступ, сповіщення, події.

mission-passed = пройдено
mission-failed = не пройдено
mission-timed-out = час вийшов
mission-stopped = завершив інструктор
mission-abandoned = припинено
mission-not-finished = не завершено
mission-over = завдання: { $outcome }
mission-time-left = залишилося { $seconds } s
mission-objective-met = досягнуто цілі: { $objective } ({ $result })
mission-objective-open = цілі знову треба досягти: { $objective } ({ $result })

mission-sensor-gas = газ
mission-sensor-particles = PM2.5

# Клітинки обстеження.
mission-cell-sampled = клітинку { $cell } обстежено: { $count }/{ $all }
mission-cells = { $count ->
    [one] { $count } клітинка
    [few] { $count } клітинки
   *[many] { $count } клітинок
}
mission-cells-of = { $count ->
    [one] { $sampled }/{ $count } клітинки
   *[many] { $sampled }/{ $count } клітинок
}
mission-cells-more = { $cells } та ще { $more }
mission-cells-advice = Обстежте ще { $cells }: по { $dwell } s у кожній, не швидше за { $speed } m/s, на висоті від { $low } до { $high } m.

# Карта, складена з них.
mission-map-none = карти немає
mission-map-error = похибка { $error }
mission-map-quality = похибка карти { $error }
mission-map-slower = летіть повільніше на висоті { $height } m через середину кожної клітинки й довше в ній лишайтеся
mission-map-blank = обстежте ще { $cell }, бо порожня клітинка вважається чистим повітрям; { $how }
mission-map-advice = Наносьте на карту кожну клітинку на висоті { $height } m, коли покази вже усталилися: летіть повільніше, розвертайтеся за межами ділянки.

# Повернення. Порада на першому місці починає речення.
mission-recover-target = { $radius } m, { $percent } %
mission-recover-metres = { $distance } m
mission-recover-home = { $home }/{ $count } вдома
mission-recover-lost = дрон втрачено
mission-recover-not-flown = не злітав
mission-recover-in-air = у повітрі
mission-recover-away = { $distance } m від майданчика
mission-recover-charge = є { $percent } %, треба { $needed } %
mission-recover-landing = ще не сів
mission-recover-fly = Виконайте політ, сядьте не далі ніж за { $radius } m від майданчика із зарядом від { $percent } % і дочекайтеся деактивації двигунів: `rtl` сідає на майданчик.
mission-recover-earlier = { $place ->
    [first] Повертайтеся, доки заряд не впав нижче за { $least } %: у вас було { $percent } %
   *[later] повертайтеся, доки заряд не впав нижче за { $least } %: у вас було { $percent } %
}
mission-recover-closer = { $place ->
    [first] Сідайте не далі ніж за { $radius } m від майданчика: ви сіли за { $distance } m; `rtl` сідає на майданчик
   *[later] сідайте не далі ніж за { $radius } m від майданчика: ви сіли за { $distance } m; `rtl` сідає на майданчик
}
mission-recover-disarm = { $place ->
    [first] Сядьте й деактивуйте двигуни, доки не вийшов час: `rtl` робить і те, і те
   *[later] сядьте й деактивуйте двигуни, доки не вийшов час: `rtl` робить і те, і те
}

# Порушення правил.
mission-checks-bypassed = передпольотні перевірки обійдено
mission-motors-stopped = двигуни зупинено на висоті { $height } m
mission-hit-ground = удар об землю на швидкості { $speed } m/s
mission-too-high = вище за { $height } m
mission-outside-fence = поза геозоною «{ $fence }»
mission-off-pad = посадка за { $distance } m від майданчика
mission-low-reserve = посадка із зарядом { $percent } %: треба { $needed } %
mission-mine-cleared = трал підірвав міну: знешкоджено
mission-mine-set-off = наїхав на міну: втрачено
mission-not-stopped = двигуни активні наприкінці завдання
mission-not-landed = у повітрі наприкінці завдання
mission-end-reserve = заряд { $percent } % наприкінці завдання: треба { $needed } %
mission-battery-critical = критичний заряд акумулятора
mission-battery-low = низький заряд акумулятора

# Переклади у файлах завдань.
mission-untranslated = немає `{ $key }`: на українських екранах буде англійський текст
mission-english-only = лише англійською: додайте `title_uk`, `brief_uk` і `text_uk` поруч з англійськими текстами
mission-translation-empty = `{ $key }` порожній: приберіть його, щоб показати англійський текст

# Панель завдання.
mission-pane = завдання  { $elapsed } з { $limit }  бали { $score }
mission-hint = підказка: { $hint }
mission-landed = Посадку виконано. Політ завершиться, коли всі повідомлення надійдуть і стануть остаточними: повідомте про те, чого бракує, або зачекайте.
mission-landed-short = Посадка до виконання всіх цілей, і на ще один політ заряду не вистачить. О { $limit } політ закінчиться з набраними балами; `abandon` закінчує його зараз, без балів.
mission-landed-last = Посадку виконано: політ зараз завершиться.
mission-home-armed = Апарат { $vehicle } повернувся: `{ $vehicle } disarm` зупинить його двигуни.
mission-touchdown = Посадку виконано: двигуни зупиняться самі, тоді політ завершиться.
mission-returning = Усі дрони в повітрі повертаються або сідають. Політ завершиться після останньої посадки.
mission-returning-early = Усі дрони в повітрі повертаються або сідають, хоча є невиконані цілі: `guided` зупинить це, а `goto` продовжить завдання.
mission-returning-short = Усі дрони в повітрі повертаються або сідають, і в одного малий заряд: дайте їм сісти. Є невиконані цілі.
mission-returning-failsafe = { $count ->
    [1] FAILSAFE саджає апарат { $vehicles }: дайте йому сісти.
   *[other] FAILSAFE саджає апарати { $vehicles }: дайте їм сісти.
} Є невиконані цілі.
mission-grounded = FAILSAFE ({ $reason }) посадив апарат { $vehicle }: злітайте знову, якщо вистачить заряду; `abandon` завершує завдання без балів
mission-lesson = зараз: { $step }
mission-more-cells = решта клітинок на більшому екрані
# Щонайбільше 6 колонок.
mission-cell-done = є

# Екран завдання.
mission-begin = { $fly } — почати   { $back } — назад
mission-under-way = час { $elapsed } з { $limit }   бали поки що { $score }
mission-ended = завершено за { $elapsed }   бали { $score }   { $key } показує розбір
mission-objectives = цілі
mission-required = обов'язкова
mission-hints = отримані підказки
mission-rules = правила
mission-rule-time = час
mission-rule-time-is = щонайбільше { $limit }, норма { $par }
mission-rule-energy = енергія
mission-rule-energy-is = норма { $par } Wh
mission-rule-height = висота
mission-rule-height-is = щонайбільше { $height } m над майданчиками
mission-rule-battery = акумулятор
mission-rule-battery-is = сідати із зарядом від { $percent } %
mission-rule-wind = вітер
mission-rule-wind-is = { $speed } m/s, з { $direction }°
mission-rule-calm = штиль
mission-rule-drones = апарати
mission-rule-sensors = датчики
mission-scoring = оцінювання, 1000 балів
mission-weights = бали
mission-medals = медалі
mission-medals-are = золото від { $gold }, срібло від { $silver }, бронза від { $bronze }
mission-gold-needs = для золота
mission-rewards = нагорода
mission-reward-credits = кредитів { $credits }
mission-reward-mission = завдання «{ $title }»
mission-reward-part = деталь { $part }
mission-reward-threat = загрозу: { $threat }
mission-reward-vehicle = апарат: { $kind }
mission-lines = рядки { $first }-{ $last } з { $count }   { $key } гортають
mission-vehicle-gone = його симулятор завершив роботу: апарат втрачено

# Що завдання відповідає на дії.
deed-over = завдання завершено
deed-launched = можна лише до зльоту
deed-no-position = позиція невідома
deed-other-kind = у цьому завданні не повідомляють про `{ $kind }`; повідомляйте про { $kinds }
deed-no-contacts = про всі такі контакти вже повідомлено
deed-no-contacts-yet = контактів ще немає
deed-no-mark = у межах 15 m від того місця повідомлень немає
deed-marked-before = про це вже повідомлено
deed-marked = повідомлень: { $count }
deed-no-load = на борту немає відповідного вантажу
deed-exam-hint = на іспиті підказок немає
deed-workload-in-exam = під час іспиту про завантаженість не питають
deed-no-hint = у цьому завданні більше немає підказок
deed-no-mission = зараз немає завдання

mission-hint-given = { $percent ->
    [0] підказка рівня { $level } (безкоштовно): { $hint }
   *[other] підказка рівня { $level } (-{ $percent } %): { $hint }
}
mission-goal-time = виконати за { $seconds } s
mission-goal-time-result = { $seconds } s
mission-goal-battery = сісти із зарядом від { $percent } %
mission-goal-battery-result = найменший заряд { $percent } %
mission-goal-battery-unknown = заряд невідомий
mission-goal-safety = не порушити жодного правила
mission-goal-safety-result = { $count ->
    [one] порушено { $count } правило
    [few] порушено { $count } правила
   *[many] порушено { $count } правил
}
mission-goal-commands = жодної відхиленої команди
mission-goal-commands-result = відхилено { $count }
mission-goal-attention = вчасно відповісти на кожну тривогу
mission-goal-attention-result = запізно { $count } з { $all }
mission-goal-score = набрати від { $points ->
    [one] { $points } бала
   *[other] { $points } балів
}
mission-goal-score-result = балів: { $points }
# Пауза.
mission-recalled = повернення до збереженої ситуації: відтепер політ — тренування і не записується
mission-paused = пауза { $time }
# Усю програму було зупинено (Ctrl-Z), поки літав вбудований симулятор.
session-stopped = консоль було призупинено на { $time }; політ на цей час зупинився
session-stopped-rules = консоль було призупинено на { $time }: правила цього завдання не дозволяють пауз, тож `sortie verify` відхилить запис
pause-begins = ПАУЗА: `continue` або { $key } — далі
pause-ends = симуляцію продовжено
pause-is-one = пауза вже триває
pause-is-none = паузи немає
pause-not-begun = пауза не потрібна: відлік почнеться, коли ви закриєте інструктаж
pause-not-processes = пауза неможлива: ArduPilot має власний час
pause-not-real = для справжніх дронів пауза неможлива: у повітрі їх зупиняє `hold`
pause-recording = тут паузи немає: `sortie replay FILE` відтворює запис із паузами, перемотуванням і зміною темпу
pause-not-allowed = правила цього завдання не дозволяють пауз
pause-refuses = симуляція на паузі
pause-refuses-help = спершу зніміть паузу: `continue` або { $key }; тоді дайте команду
speedup-is = { $rate }x: прискорення, доки не закінчиться останній рух або не знадобиться ваше втручання; { $key } скасовує його
speedup-idle = { $rate }x: час іде швидше, але жодна команда не виконується; { $key } скасовує прискорення
speedup-usual = { $rate }x: час іде зі звичайною швидкістю
speedup-back = знову реальний час: { $reason }
speedup-back-to = знову { $rate }x: { $reason }
speedup-contact = новий контакт { $contact }
speedup-met = досягнуто цілі «{ $objective }»
speedup-missed = не досягнуто цілі «{ $objective }»
speedup-open = знову треба досягти цілі «{ $objective }»
speedup-done = { $verb } апарата { $vehicle }: виконано
speedup-row = { $verb } апарата { $vehicle }: { $state }
speedup-alert = тривога «{ $alert }», апарат { $vehicle }
speedup-same = уже { $rate }x
speedup-nothing-to-wait-for = жодна команда не виконується: дайте команду або напишіть `speedup 2`
speedup-limit = уже { $most }x: швидше тут не можна
speedup-nothing = нема чого прискорювати: польоту немає
speedup-not-processes = ArduPilot має власний час: прискорення задають під час запуску через `--speedup`
speedup-not-real = прискорення неможливе: справжні дрони літають у реальному часі
speedup-not-in-exams = іспит відбувається в реальному часі
speedup-not-allowed = правила цього завдання не дозволяють прискорення
speedup-too-much = надто швидко: щонайбільше { $most }x
speedup-too-little = надто повільно: щонайменше { $least }x

# Перед зльотом, на екрані завдання. Назви щонайбільше 14 колонок.
mission-launch = перед зльотом
mission-pledge = заявлено до зльоту
mission-prediction = ваші бали
mission-prediction-none = прогноз задає { $key }, наприклад `predict 800`; розбір порівняє його з результатом
mission-prediction-is = передбачено { $points }
mission-goal = ваша мета
mission-goal-none = мету задає { $key }: `score`, `time`, `battery`, `safety`, `commands` або `attention`, наприклад `goal time 200s`
mission-reading = годинник
mission-exam = іспит
mission-exam-is = { $exam }, спроба { $number } з { $tries }, лишилося { $time }
mission-reading-held = відлік почне інструктор
mission-reading-first = відлік почнеться, коли ви закриєте інструктаж
mission-brief-left = відлік часу завдання почався; { $key } — пауза
mission-reading-is = іде; { $key } — пауза, поки ви читаєте
mission-reading-paused = на паузі; { $key } — далі
mission-then = початок
mission-then-is = { $drones } показує дрони й запускає годинник, { $back } повертає назад, { $help } пояснює клавіші й команди
mission-contacts-count = контакти { $count }, повід. { $reported }
mission-contacts-confirmed = контакти { $count }, підтв. { $confirmed }, повід. { $reported }
mission-marks-count = повідомлень: { $count }
mission-pledge-line = заявлено: { $words }
mission-said-score = { $points ->
    [one] { $points } бал
    [few] { $points } бали
   *[many] { $points } балів
}

# Що невідкладне, на всю ширину екрана; коротко в заголовку.
mission-alert = ! { $seconds } s: { $text }
mission-alert-short = ! { $seconds } s
mission-urgent-more = і ще термінових: { $count }
mission-radio-weak = ! слабкий зв'язок з { $vehicle }: { $margin } dB
inject-done = введено: { $what }

# Спроби, підказки та спорядження на екрані завдання.
mission-tries = ваші спроби
mission-try = балів: { $score }, { $medal }
mission-try-best = балів: { $score }, { $medal }, найкраща
mission-try-practice = балів: { $score }, тренування
mission-try-unfinished = не завершено
mission-next-hint = підказка
mission-hint-price = { $percent ->
    [0] { $key } — наступна підказка, рівень { $level }: безкоштовно
   *[other] { $key } — наступна підказка, рівень { $level }: коштує { $percent } % балів
}
mission-hint-of = підказка { $level }: { $hint }
mission-rule-carries = { $count ->
    [1] апарат { $vehicles }
   *[other] апарати { $vehicles }
}
mission-rule-carries-nothing = без датчика й вантажу
mission-rule-load = { $name } x{ $count }
mission-rule-areas = зони
mission-rule-area = { $meaning }: { $names }
