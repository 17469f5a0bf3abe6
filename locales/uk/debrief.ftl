# Розбір польоту, завширшки 80 колонок.

debrief-head = РОЗБІР  { $mission } r{ $revision }   { $title }   { $outcome }
debrief-score = Бали { $score } / 1000   { $medal }   варіант { $seed }   { $backend }
debrief-source = { $mission } r{ $revision }   варіант { $seed }   { $backend }
debrief-no-medal = без медалі
debrief-embedded = симулятор
debrief-time = Час { $used } (норма { $par }, межа { $limit })   Енергія { $energy }   Дрони { $count }
debrief-energy = { $used } Wh (норма { $par })
debrief-energy-unknown = невідома

# Заголовки стоять над колонками: щонайбільше 36 для цілей, 13 для результату, 11 для вимоги,
# 12 для складових, 6 для ваги та значення, 8 для балів.
debrief-instructor = ІНСТРУКТОР
debrief-objectives = ЦІЛІ
debrief-result = результат
debrief-target = треба
debrief-objective-result = { $result }; треба: { $target }
debrief-points = бали
debrief-components = СКЛАДОВІ
debrief-weight = вага
debrief-value = знач.
debrief-moved = що вплинуло
# Щонайбільше 8 колонок.
debrief-sum = разом
gold-without-commands = політ без підказки з готовими командами
gold-points = від { $points } балів
gold-mandatory = усі обов'язкові цілі
debrief-gold-needs = для золота треба: { $gates }

debrief-timeline = ПЕРЕБІГ   (> 2-9 команди  o ціль  ! тривога  x порушення  r відмова  . інше)
# Один рядок про кілька команд поспіль; ніколи не про одну.
debrief-commands = { $count ->
    [one] { $count } команда до { $until }
    [few] { $count } команди до { $until }
   *[many] { $count } команд до { $until }
}
# Кілька команд поспіль і скільки з них дали інші.
debrief-shares = { $commands } ({ $shares })
debrief-share = { $person } — { $count }
# Один рядок про відмову кількох дронів.
debrief-to-many = { $what } (апаратів: { $count })
debrief-drone = апарат { $vehicle }: { $what }
debrief-vehicle = апарат { $vehicle }: { $what }

debrief-improve = ЩО ПОЛІПШИТИ   (спершу те, що дає найбільше)
debrief-nothing = Більше балів здобути не можна.
debrief-only-gold = Більше балів здобути не можна; для золота треба: { $gates }.
# Щонайбільше 5 колонок.
debrief-good = добре

# Прогноз і мета, заявлені до зльоту.
debrief-crew = команди давали: { $names }
debrief-crew-also = команди давали також: { $names }
debrief-by-hand = Політ виконано власноруч
debrief-by-script = Політ виконав скрипт: тренування
debrief-by-bundled-pilot = Політ виконав скрипт із комплекту sortie: тренування
debrief-other-revision = У цьому польоті інша редакція завдання, ніж у курсі (r{ $revision } завдання { $mission }): бали порівнювати не можна.
debrief-own-mission = { $mission } не належить до курсу, тож його польоти — лише тренування.
debrief-altered-mission = Файл завдання відрізняється від { $mission } r{ $revision } з курсу: бали порівнювати не можна.
debrief-try = Спроба { $attempt }, підказок: { $count } (x{ $factor })
debrief-predicted-right = Ви передбачили { $predicted }: саме стільки й вийшло.
debrief-predicted-less = Ви передбачили { $predicted }: на { $by } менше, ніж вийшло.
debrief-predicted-more = Ви передбачили { $predicted }: на { $by } більше, ніж вийшло.
debrief-goal-reached = Вашої мети «{ $goal }» досягнуто ({ $result }).
debrief-goal-missed = Вашої мети «{ $goal }» не досягнуто ({ $result }).
debrief-given-up = припинено: без балів
debrief-times-hints = x{ $factor } за підказки

debrief-alert-good = { $alert } -> відповідь за { $after } s   добре
debrief-alert-late = { $alert } -> відповідь за { $after } s (межа { $limit } s)   запізно
debrief-alert-none = { $alert } -> без відповіді (межа { $limit } s)   запізно

debrief-swarm = РІЙ   (не оцінюється)
debrief-fan-out = За такого темпу { $who ->
        [crew] екіпаж завантажує
       *[you] ви завантажуєте
    } роботою { $handled } апарата; працювало: { $flown }.
debrief-swarm-times = без команд апарат зайнятий { $neglect } s; команда забирає { $who ->
        [crew] в екіпажу
       *[you] у вас
    } { $interaction } s; апарат чекає { $wait } s
debrief-swarm-habits = { $who ->
        [crew] переходів екіпажу
       *[you] переходів
    } до інших апаратів за хвилину: { $switches }; команд кільком апаратам одразу: { $group } %
debrief-use = у роботі { $airborne } s, із завданням { $percent } %, простій { $idle } s
debrief-use-none = не працював

debrief-truth = ЩО БУЛО НАСПРАВДІ   (північ угорі)
debrief-sign = { $sign } { $meaning }
debrief-sign-gap = не обстежено
debrief-sign-track = шлях
debrief-sign-pad = майданчик
debrief-sign-wire = провід ЛЕП
debrief-sign-decoy = безпечне
debrief-sign-there = було, але поза завданням
debrief-sign-false = хибне повідомлення
debrief-sign-mark = повідомлення
debrief-sign-found = знайдено
debrief-sign-missed = пропущено
debrief-sign-shades = { $shades } від слабкого до сильного
debrief-scale = стовпець — { $metres } m
debrief-height = { $metres } m
debrief-found = знайдено { $found } з { $all }, хибних повідомлень { $wrong }
debrief-gaps = не обстежено: { $area } m², найбільше біля n { $north } e { $east }
debrief-missed = пропущено: { $kind }, n { $north } e { $east }

debrief-tries = ВАШІ СПРОБИ
debrief-practice = тренування

debrief-next = ДАЛІ
debrief-next-drill = Виконайте вправу { $drill }, тоді це завдання ще раз. { $what }
debrief-next-again = Спробуйте ще раз. { $what }
debrief-next-on = Переходьте до наступного завдання.
debrief-next-gold = У наступній спробі для золота треба: { $gates }.
debrief-next-mission = Далі — «{ $mission }».
debrief-next-count = Виконайте це завдання на кредити: тренування не відкриває інших завдань.
debrief-last-mission = це було останнє завдання

# Карта розбору.
truth-title = що було насправді
truth-none = У цьому завданні нема чого показувати.
truth-found = знайдено
truth-missed = пропущено
truth-over = ліквідовано
truth-unasked = було, але поза завданням
truth-decoy = безпечне
truth-false = хибне повідомлення
truth-burning = горить
truth-strength = % від найсильнішого
truth-gate = ворота
truth-gaps = не обстежено
debrief-not-flown = До першого зльоту нічого не зараховується.
debrief-next-same = Виконайте це завдання ще раз.

debrief-workload = ЗАВАНТАЖЕНІСТЬ   (не оцінюється)
workload-title = завантаженість
workload-busy = зайнято
workload-alone = без нагляду
workload-waiting = чекають
workload-answers = ваші оцінки
workload-how = частка останньої хвилини, зайнята командами, у десятих частках; скільки апаратів тоді працювало без нагляду; скільки апаратів чекає; ваші оцінки від 1 до 5
workload-figures = команд: { $commands } (команда кільком апаратам рахується один раз); { $who ->
        [crew] екіпаж був зайнятий
       *[you] ви були зайняті
    } { $interaction } s; апарати сумарно працювали самостійно { $neglect } s і чекали { $wait } s
workload-overloaded = зайнятість понад 70 % протягом хвилини чи довше: { $stretches }
workload-answered = ви відповіли на запитання про завантаженість: { $answers } з { $questions }
workload-question = Завантаженість від 1 (майже нічого) до 5 (забагато)? Відповідь: { $key }, на бали не впливає
