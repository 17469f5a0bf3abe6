# Що стається з командами: стан у кількох словах і пояснення до нього.

state-queued = у черзі
state-sent = надіслано
state-sent-again = надіслано, спроба { $tries }
state-percent = виконується { $percent } %
state-in-progress = виконується
state-accepted = прийнято
state-done = виконано
state-over = ефект завершився
state-no-effect = без ефекту
state-rehearsal-failed = невдало
state-refused = відхилено
state-timed-out = без відповіді
state-superseded = замінено
state-overtaken = замінено
state-count = { $count } { $state }
state-of-all = { $vehicles }: { $states }
state-explained = { $count ->
    [1] апарат { $vehicles }: { $text }
   *[other] апарати { $vehicles }: { $text }
}

outcome-verb-accepted = { $verb } прийнято
outcome-verb-in-progress = { $verb } виконується
outcome-verb-cancelled = { $verb } скасовано: { $reason }
outcome-verb-refused = { $verb } відхилено: { $reason }
outcome-plan-covers = покриває { $percent } % площі: смуга датчика завширшки { $strip } m, лінії за { $spacing } m одна від одної
outcome-superseded = замінено на { $by }
outcome-the-reboot = перезапуск
outcome-answer-lost = видно в телеметрії, відповідь загубилася
outcome-fell-silent = виконання почалося, але далі звітів немає
outcome-no-answer = { $tries ->
    [one] немає відповіді на { $tries } спробу за { $seconds } s
    [few] немає відповіді на { $tries } спроби за { $seconds } s
   *[many] немає відповіді на { $tries } спроб за { $seconds } s
}
outcome-no-parameter = можливо, параметра { $name } немає
outcome-value-became = { $name } = { $value } (запит: { $wanted })
outcome-other-name = { $outcome } (так у цього апарата зветься { $name })
outcome-opposite-name = { $outcome } (так у цього апарата зветься { $name }, із протилежним значенням)
outcome-not-seen = не помічено: { $effect }
outcome-not-seen-within = за { $seconds } s не помічено: { $effect }
outcome-offboard-kept = за 5 s після команди зависнути режим не змінився з OFFBOARD; цілі більше не надсилаються, тож діє захист апарата
outcome-other-target = апарат і далі летить до попередньої цілі; чи не лежить нова за межами його геозони?
outcome-no-target = апарат стоїть на місці й не має цілі; чи не лежить вона за межами його геозони?
outcome-overtaken = режим { $mode }
outcome-crashed = аварія
outcome-disarmed = двигуни деактивовано
outcome-disarmed-idle = двигуни деактивовано: { $reason }
outcome-armed = двигуни активовано
outcome-ended = завершено: { $by }
outcome-not-sent = не надіслано: { $reason }
outcome-too-late = не надіслано: строк у черзі ({ $seconds } s) минув
outcome-queue-full = не надіслано: у черзі до апарата вже { $count ->
    [one] { $count } команда
    [few] { $count } команди
   *[many] { $count } команд
}
outcome-forgotten = апарат забуто
outcome-not-heard = не надіслано: такого апарата немає на зв'язку
outcome-task-busy = не надіслано: консоль не встигає за цим апаратом

# Список, збережений відтоді, як передавання обірвалося.
plan-broken-off = передавання { $verb ->
    [plan] плану
    [fence] геозони
   *[rally] точок збору
} на борт обірвалося; старий список збережено: `{ $verb } upload { $file }` поверне його
plan-broken-off-empty = передавання { $verb ->
    [plan] плану
    [fence] геозони
   *[rally] точок збору
} на борт обірвалося; раніше списку не було: `{ $verb } clear` прибере залишок

# Чого чекали в телеметрії; стоїть в outcome-not-seen і подібних.
effect-nothing = ефект
effect-armed = двигуни активовано
effect-disarmed = двигуни деактивовано
effect-mode = режим { $mode }
effect-still = зупинка на місці
effect-landed = на землі
effect-returned = повернувся додому або до точки збору
effect-altitude = { $metres } m над домом, ±{ $tolerance } m
effect-taken-off = зліт завершено на висоті { $metres } m або вище
effect-place = до цілі менше ніж { $metres } m
effect-heading = курс { $degrees }°
effect-velocity = політ із такою швидкістю
effect-plan-item = поточний пункт — { $item }
effect-plan-flown = політ за планом в AUTO з пункту { $item }
effect-home = дім перенесено
effect-servo = вихід { $output } на { $pulse } us
effect-control = керує ця консоль
effect-no-control = не керує жодна станція
effect-rebooted = перезапуск
outcome-unmeasured-speed = прийнято, але без датчика повітряної швидкості літак тримає тягу (TRIM_THROTTLE)
outcome-renumbered = тепер це апарат { $system }

# Журнали польотів апарата.
outcome-sticks-held = утримуються канали: { $channels }; `rc release` повертає їх
outcome-sticks-unsure = чи слухає апарат станцію { $own }, невідомо: прочитайте його SYSID_MYGCS (з ArduPilot 4.7 — MAV_GCS_SYSID)
outcome-sticks-released = усі канали повернено передавачу
outcome-logs-none = апарат не має журналів
outcome-logs-listed = { $count ->
    [one] { $count } журнал, { $size } kB: { $logs }
    [few] { $count } журнали, { $size } kB: { $logs }
   *[other] { $count } журналів, { $size } kB: { $logs }
}
outcome-log-listed = { $number } ({ $size } kB)
outcome-log-listed-at = { $number } ({ $size } kB, { $time })
outcome-logs-kept = збережено { $size } kB у { $files }
outcome-logs-kept-by = збережено { $size } kB { $ways }: { $files }
outcome-log-by-messages = через повідомлення журналу
outcome-log-by-file = через MAVFTP
outcome-log-sum-same = контрольну суму перевірено
outcome-log-sum-other = прочитано двічі: контрольна сума не така, як в апарата
outcome-log-sum-grown = без контрольної суми: апарат ще писав цей журнал (після деактивації двигунів це триває 15 s); завантажте його ще раз пізніше
outcome-log-sum-none = без контрольної суми: { $reason }
outcome-log-no-file = немає файлу вказаного розміру
outcome-folder-empty = тека порожня
outcome-folder = { $count ->
    [one] { $count } запис: { $names }
    [few] { $count } записи: { $names }
   *[many] { $count } записів: { $names }
}
outcome-folder-made = теку { $path } створено
outcome-file-removed = { $path } видалено
outcome-file-got = скопійовано у { $file }: { $bytes } B, контрольну суму не звірено
outcome-file-got-verified = скопійовано у { $file }: { $bytes } B, контрольну суму звірено
outcome-file-put = скопійовано на апарат: { $bytes } B, контрольну суму не звірено
outcome-file-put-verified = скопійовано на апарат: { $bytes } B, контрольну суму звірено
outcome-file-checksum = контрольна сума (CRC-32) { $sum }
outcome-file-differs = копія відрізняється від файлу: контрольні суми не збігаються; скопіюйте ще раз
outcome-files-stopped = зупинено
outcome-logs-stopped = зупинено; прочитане збережено; повторіть завантаження, щоб продовжити
outcome-plan-written = { $count ->
    [one] { $count } пункт
    [few] { $count } пункти
   *[many] { $count } пунктів
} ({ $mark }): зчитано з борту й порівняно
outcome-plan-warned = { $count ->
    [one] попередження: { $warnings }
   *[other] попередження: { $warnings }
 }
outcome-plan-warned-more = попередження: { $warnings }; ще { $more }
outcome-plan-same = { $count ->
    [one] { $count } пункт
    [few] { $count } пункти
   *[many] { $count } пунктів
} ({ $mark }) уже на борту
outcome-plan-read = { $count ->
    [one] { $count } пункт
    [few] { $count } пункти
   *[many] { $count } пунктів
} ({ $mark })
outcome-plan-saved = збережено { $count ->
    [one] { $count } пункт
    [few] { $count } пункти
   *[many] { $count } пунктів
}: { $file }
outcome-plan-kept = { $reason }; на борту й далі старий список
outcome-plan-restored = { $reason }; старий список повернуто
outcome-plan-unread = апарат не відповідав; нічого не змінено
outcome-plan-neither = на борту тепер немає ні нового списку, ні старого, а є { $count ->
    [one] { $count } пункт
    [few] { $count } пункти
   *[many] { $count } пунктів
} ({ $mark }): завантажте список на борт ще раз, перш ніж летіти
outcome-plan-unknown = невідомо, який список на борту: перевірте його через `{ $list } show`, перш ніж летіти
plan-stage-lost = зв'язок втрачено: передавання продовжиться, коли він відновиться
plan-stage-restoring = повертається старий список
outcome-logs-silent = апарат не відповідає на запит переліку журналів
outcome-log-stalled = апарат більше не надсилає журнал { $number }: збережено { $percent } %; повторіть завантаження, щоб продовжити
outcome-logs-armed = з активними двигунами апарат не надсилає журналів: журнал { $number } збережено на { $percent } %; деактивуйте двигуни й повторіть завантаження, щоб продовжити
outcome-log-length = розмір { $file } — { $bytes } B, а в переліку апарата — { $expected } B: повторіть завантаження

outcome-plan-left = { $vehicles }: тепер без частини роботи, але на борту ще попередній план; його прибере `{ $vehicles } plan clear`
outcome-plan-idle = для цього апарата немає частини роботи: { $reason }; його план на борту стирається
outcome-plan-share = частини мають { $count } з { $all }: { $why }
rehearse-in-air = у повітрі: випробування починається на землі
rehearse-kind = це { $kind }: випробувати можна лише політ коптера; перевірте план командою `sortie plan check`
rehearse-waits = { $vehicles }: плани ще передаються або зчитуються; випробування чекає
rehearse-unread = план на борту ще не зчитано: його читає `plan show`
rehearse-no-plan = на борту немає плану
rehearse-refused = симулятор відхиляє план, геозону або точки збору апарата { $vehicle }
rehearse-landed = сідає через { $time }; витрачає { $used } % заряду, лишається { $left } %
rehearse-ends-in-air = план закінчується в повітрі через { $time }; витрачає { $used } % заряду
rehearse-battery = витрачає { $used } % заряду: більше, ніж лишилося
rehearse-meets = надто зближується з іншим апаратом; час польоту { $time }
rehearse-fence = порушує геозону через { $time }
rehearse-left-plan = переходить із плану в { $mode }; час польоту { $time }
rehearse-grounded = не злітає
rehearse-crashed = зіткнення через { $time }
rehearse-replay = записано: `replay rehearsal` відтворює його на карті
rehearse-unwritten = випробування не записано: { $reason }
rehearse-hit-ground = врізається в землю через { $time }, на шляху до пункту { $number }
rehearse-time-up = через { $time } ще летить
rehearse-conflict = випробування: { $a } і { $b } надто зближуються на { $time }: { $horizontal } m по горизонталі, { $vertical } m по вертикалі
rehearse-late = випробування: { $a } і { $b } надто зближуються, якщо один із них запізниться на { $late } s
rehearse-more = випробування: ще { $count ->
    [one] { $count } пара надто зближується або зблизиться
    [few] { $count } пари надто зближуються або зблизяться
   *[other] { $count } пар надто зближуються або зблизяться
}, якщо один із апаратів запізниться
rehearse-conditions = випробування: { $conditions }
rehearse-parameters-unread = параметри не зчитано ({ $vehicles }), діють типові
rehearse-wind-given = вітер { $speed } m/s з напрямку { $from }° (заданий)
rehearse-wind-estimated = вітер { $speed } m/s з напрямку { $from }° (за оцінкою апарата { $vehicle })
rehearse-wind-estimated-at = вітер { $speed } m/s з напрямку { $from }° на висоті { $height } m (за оцінкою апарата { $vehicle })
rehearse-wind-mission = вітер { $speed } m/s з напрямку { $from }° (за завданням)
rehearse-wind-simulator = вітер { $speed } m/s з напрямку { $from }° (`SIM_WIND_SPD`)
rehearse-wind-unknown = штиль (вітер невідомий); вітер задає `plan rehearse wind 270 8`
rehearse-airframes-own = рами дронів цього сеансу
rehearse-airframes-standard = стандартна рама
rehearse-airframes-mixed = рами дронів цього сеансу, для { $vehicles } — стандартна
rehearse-closest = випробування: найбільше зближуються { $a } і { $b }, на { $time }: { $horizontal } m по горизонталі, { $vertical } m по вертикалі
