# Чому команда зараз не має сенсу для апарата або чому він її відхилив. Сам апарат названо поруч.

refused-not-heard = апарат ще не виходив на зв'язок
refused-not-guided = { $verb } потребує GUIDED, а зараз { $mode }; спершу дайте `{ $vehicle } guided`
refused-guided-autopilot = { $verb } потребує режиму GUIDED, який є лише в ArduPilot, а на цьому апараті інший автопілот
refused-not-armed = { $verb } потребує активних двигунів: спершу дайте `{ $vehicle } arm`
refused-taking-off = зліт ще триває: дочекайтеся «takeoff виконано», потім дайте { $verb }
refused-on-the-ground = { $verb } потребує польоту, а апарат на землі; спершу дайте `{ $vehicle } takeoff 10` і зачекайте, доки він набере висоту
refused-too-low = { $metres } m над домом занизько для польоту; щоб сісти, дайте `{ $vehicle } land`
refused-plane-heading = це літак, і ніс у нього завжди за напрямком польоту: приберіть `face` чи `keep`
refused-plane-on-ground = { $verb } потребує польоту, а літак на землі: спершу дайте `{ $vehicle } mode takeoff` або `{ $vehicle } plan start`
refused-plane-vertical-speed = це літак: набір висоти і зниження задають параметри, `param set TECS_CLMB_MAX` і `TECS_SINK_MAX`
refused-surface-vertical = це { $kind }: він не змінює висоти
unsuited-takeoff-surface = це { $kind }, і він не злітає: дайте `{ $vehicle } guided`, `{ $vehicle } arm`, а потім `{ $vehicle } goto ..`
unsuited-takeoff-plane = літак злітає в окремому режимі або за планом: дайте `{ $vehicle } mode takeoff` чи `{ $vehicle } plan start` із планом, що починається зі зльоту; якщо літак уміє зависати, консоль дізнається про це з `{ $vehicle } param get Q_ENABLE`
unsuited-land-surface = це { $kind }, і він не сідає: `{ $vehicle } hold` зупинить його, `{ $vehicle } rtl` поверне
unsuited-land-plane = літак сідає за планом: дайте `{ $vehicle } plan start` із планом, що закінчується посадкою, або `{ $vehicle } mode qland`, якщо літак уміє зависати
unsuited-altitude-surface = це { $kind }: висоту він не змінює
unsuited-resume = { $kind } не призупиняється, а змінює режим: `{ $vehicle } plan resume` продовжить план, після `{ $vehicle } guided` можна дати новий `goto`
unsuited-yaw = { $kind } повертає лише в русі: дайте `{ $vehicle } goto ..`
unsuited-velocity-plane = літак не зважає на задану швидкість за напрямками: дайте `{ $vehicle } goto ..` і `{ $vehicle } speed`
unsuited-orbit-surface = { $kind } кружляє лише в режимі CIRCLE: дайте `{ $vehicle } mode circle`; апарат кружлятиме навколо місця, де він є, а коло задають CIRC_RADIUS і CIRC_SPEED
unsuited-orbit-plane = літак кружляє навколо кожного місця, до якого його послали: дайте `{ $vehicle } goto ..`; радіус задає WP_LOITER_RAD
unsuited-joint = { $verb } — для апаратів, що вміють зависати, а це { $kind }: скористайтеся планом, як-от `plan survey`, або `{ $vehicle } goto ..`
refused-no-position = позиція ще невідома
refused-no-heading = курс ще невідомий
refused-no-height = висота ще невідома
refused-no-mode = апарат не має режиму { $mode }
refused-mode-hidden = режим { $mode } вмикає лише сам апарат: він позначений як недоступний для вибору
refused-mode-autopilot = на апараті не ArduPilot: назви його режимів невідомі; скористайтеся `land` або `rtl`
refused-arm-in-the-air = апарат у повітрі: активуйте двигуни на землі
refused-logs-armed = двигуни активні: деактивуйте їх перед читанням журналів
refused-logs-nowhere = щоб завантажити журнал, потрібна тека даних: запустіть sortie з `--data DIR`
refused-no-log = апарат не має журналу { $number } (журналів у переліку: { $count })
refused-plan-here = так план не надіслати: скористайтеся `plan upload`
refused-plan-autopilot = плани можна надсилати лише апаратам з ArduPilot
refused-plan-no-files = плани з файлів читає лише консоль
refused-plan-clear-auto = апарат летить за планом: спершу дайте `hold` і `guided`
refused-plan-empty = у файлі немає пунктів для списку «{ $list }»
refused-plan-file = { $file }:{ $line }:{ $column }: { $fault }; жодного апарата не змінено
refused-plan-extension = { $file }: невідоме розширення: візьміть `.waypoints`, `.plan`, `.kml` або `.geojson`
refused-plan-blank = { $file }: файл порожній
refused-plan-format = { $file }: цей формат не вміщує списку; візьміть `.waypoints` або `.plan`
refused-plan-exists = { $file } уже існує: візьміть іншу назву, а для кількох апаратів — `{ "{" }id{ "}" }` у назві
order-one-file = кілька апаратів не можуть писати в один файл: { $file }
order-one-file-help = `{ "{" }id{ "}" }` у назві означає номер апарата, як-от `v{ "{" }id{ "}" }.plan`
refused-plan-item = пункт { $item }: { $reason }
refused-plan-no-list = в апарата немає такого списку
refused-plan-faults = { $first }; { $more ->
    [one] ще { $more } помилку
    [few] ще { $more } помилки
   *[many] ще { $more } помилок
} покаже `sortie plan check`
refused-plan-unfamiliar = ця консоль ще не читала списку на борту: { $count ->
    [one] { $count } пункт
    [few] { $count } пункти
   *[many] { $count } пунктів
} ({ $mark }); щоб замінити його, повторіть команду
refused-plan-changed = інша програма змінила список, відколи ця консоль його вперше прочитала чи востаннє записала: тепер { $count ->
    [one] { $count } пункт
    [few] { $count } пункти
   *[many] { $count } пунктів
} ({ $mark }); щоб замінити його, повторіть команду
refused-plan-none = на борту немає плану: спершу дайте `plan upload`
refused-plan-item-none = пункту { $item } немає: останній — { $last }
refused-plan-unread = план апарата не прочитано: спершу дайте `plan show`
refused-plan-paused = політ за планом уже на паузі: `plan resume` продовжить політ
refused-plan-last = пункт { $item } останній: `plan abort` поверне апарат, `plan goto` продовжить з іншого пункту
refused-plan-on-ground = апарат на землі: `plan start` почне план; щоб почати з пізнішого пункту, спершу злетіть
refused-plan-over = апарат завершив політ за планом: `plan resume from 1` почне його знову
refused-plan-not-begun = апарат ще не почав плану: назвіть пункт, наприклад `plan resume from 1`
refused-plan-flown = апарат уже летить за планом, пункт { $item }
refused-plan-mode = апарат у { $mode } і за планом не летить: `plan resume` продовжить в AUTO, `rtl` поверне апарат
refused-plan-not-armed = двигуни не активовано: спершу дайте `guided` і `arm`, потім `plan start`
plan-result-command = апарат не знає тут команди { $command }
plan-result-frame = апарат не знає системи координат { $frame }
plan-result-parameter = параметр { $number } недійсний
plan-result-space = забагато пунктів для апарата
plan-result-denied = апарат зайнятий іншим завантаженням
plan-result-error = апарат відхилив список, не назвавши причини
plan-differs = зчитаний з борту список відрізняється від надісланого
hazard-message = надсилає { $message } так, як написано: { $fields }
hazard-message-empty = надсилає { $message }, у якому всі поля дорівнюють 0
hazard-command = надсилає { $command }
hazard-plan-auto = апарат летить за планом і відразу перейде на новий
hazard-plan-rehearsal = випробування невдале для { $vehicles }: { $reason }
hazard-plan-met = надто близько: { $pairs }
hazard-plan-rehearse-these = `{ $targets } plan rehearse` випробує лише ці плани
hazard-plan-same = { $first } і { $second } мають той самий план: у спільному польоті вони зіткнуться
hazard-plan-armed = двигуни апарата активні
hazard-above-ceiling = веде вище за межу висоти геозони завдання ({ $fence }: { $ceiling } m), а це порушує правило
hazard-outside-fence = веде за межі геозони завдання ({ $fence }), а це порушує правило
hazard-outside-own-fence = веде { $vehicle } за межі власної геозони: ArduCopter мовчки відкидає таку ціль
hazard-fence-off = двигуни апарата активні: без геозони він може вилетіти за межі ділянки
refused-logs-here = так журнали прочитати не можна: скористайтеся `logs list` або `logs download`
refused-logs-none-read = зараз не триває ні читання переліку журналів, ні завантаження журналів
refused-reboot-armed = двигуни активні: деактивуйте їх перед перезапуском
refused-parameter-name = `{ $name }` не може бути параметром: назва має від 1 до 16 латинських літер, цифр або `_`
refused-no-place = { $lat }, { $lon } — неправильні координати
refused-not-finite = { $value } не є числом, яке можна надіслати
refused-parameter-type = тип { $name } ще невідомий: спершу дайте `param get { $name }`
refused-no-parameter = не надіслано: апарат не має параметра { $name }
refused-no-parameter-but = не надіслано: апарат не має параметра { $name }; може, { $nearest }?
refused-neither-parameter = не надіслано: апарат не має ні { $name }, ні { $other }
refused-neither-parameter-but = не надіслано: апарат не має ні { $name }, ні { $other }; може, { $nearest }?
refused-protected-parameter = { $parameter } задано завданням: змінювати цей параметр можна лише в тренуванні
refused-protected-home = дім задано завданням: переносити його можна лише в тренуванні
refused-protected-limits = геозону й точки збору задано завданням: змінювати їх можна лише в тренуванні
refused-protected-files = файли на борту можуть містити параметри, плани й сценарії, які задає завдання: змінювати їх дозволено лише в тренуванні
refused-files-none = апарат не дає доступу до файлів (MAVFTP)
refused-files-nowhere = цей сеанс не може читати чи записувати файли цього комп'ютера
refused-files-here = так файли прочитати чи змінити не можна: скористайтеся `ftp`
refused-files-idle = зараз не виконується жодна команда з файлами
refused-file-large = файл більший за { $most } MiB
refused-protected-sticks = брати керування стіками можна лише в тренуванні
refused-sticks-here = утримувати канали так не можна: скористайтеся `rc`
refused-sticks-station = апарат не зважає на канали станції { $own }: він слухає лише станцію { $station } ({ $parameter }). Встановіть { $parameter } = { $own } або запустіть консоль без `--station`
refused-protected-raw = довільні MAV_CMD і повідомлення дозволено лише в тренуванні; скористайтеся дієсловом для цієї дії
refused-protected-item = пункт { $item } ({ $command }) змінює дім або геозону, які задано завданням: план із цим пунктом можна завантажити на борт лише в тренуванні
refused-value = значення { $name } лишилося { $value }: { $wanted } не прийнято

reason-no-orbit = цей автопілот не підтримує orbit: скористайтеся режимом CIRCLE
reason-armed = двигуни активні
reason-flying = апарат уже летить
reason-takeoff-mode = режим { $mode }: спершу `guided`, потім `takeoff`
reason-takeoff-arm = двигуни не активовано: спершу `arm`, потім `takeoff`
reason-takeoff-disarmed = двигуни, мабуть, щойно деактивувалися самі: `arm`, потім `takeoff`
reason-takeoff-mode-arm = режим { $mode }, двигуни не активовано: `guided`, `arm`, потім `takeoff`
reason-in-the-air = апарат у повітрі: посадіть його (`land`) або зупиніть двигуни (`kill`)
reason-in-the-air-plane = літак у повітрі: посадіть його за планом, що закінчується посадкою, або зупиніть двигун (`kill`)
reason-speed-mode = у { $mode } швидкість не задають; спершу перейдіть у GUIDED
reason-speed-rover = швидкість він приймає лише дорогою до місця: спершу `goto`, потім `speed`; звичайну швидкість задає WP_SPEED
reason-speed-plane = швидкість поза межами повітряної швидкості, AIRSPEED_MIN і AIRSPEED_MAX
reason-px4-arm-mode = двигуни не активуються в режимі { $mode }; спершу перейдіть в AUTO.LOITER
reason-arm-mode = у { $mode } активувати двигуни не можна; спершу перейдіть у GUIDED
reason-landing-sequence = план ще на посадці: `mode manual` припинить її, тоді дайте `arm`
reason-plan-pause = пауза можлива лише на шляху до точки плану; `mode brake` зупинить апарат, а `plan resume` продовжить план
reason-mode = зараз не можна перейти в { $mode }
reason-not-now = зараз неможливо, спробуйте ще раз
reason-not-in-control = апаратом керує станція { $station }: `{ $line }` просить керування
reason-other-station = апаратом керує інша наземна станція
reason-control-asked = апаратом керує станція { $station }, їй надіслано запит: вона може дозволити перейняти керування або звільнити апарат; тоді попросіть керування ще раз
refused-no-control = апарат не оголошує, яка станція ним керує (CONTROL_STATUS): командувати може кожна
refused-control-not-here = ця консоль не керує апаратом: спершу `control request`
reason-denied = апарат не приймає цих значень
reason-unsupported = цей автопілот не знає такої команди
reason-failed = апарат не назвав причини
reason-cancelled = замінено іншою командою
reason-long-only = апарат приймає цю команду лише як COMMAND_LONG
reason-int-only = апарат приймає цю команду лише як COMMAND_INT
reason-frame = апарат не знає такої системи координат
reason-other = результат { $number }

# Апарати з PX4
refused-px4-guided = PX4 не має GUIDED і не потребує його: `goto` і `takeoff` працюють у будь-якому режимі
refused-px4-vertical-speed = PX4 не приймає вертикальної швидкості командою: задайте його параметри MPC_Z_VEL_MAX_UP і MPC_Z_VEL_MAX_DN
refused-px4-turn-rate = PX4 не приймає швидкості повороту командою: не вказуйте її або задайте параметр MPC_YAWRAUTO_MAX
refused-px4-servo = PX4 не має команди для одного виходу: приводи задає `long DO_SET_ACTUATOR`
refused-px4-relay = PX4 не має команди для реле: вона є лише в ArduPilot
refused-px4-fence = PX4 не вмикає геозони командою: задайте його параметр GF_ACTION
refused-px4-resume = PX4 не має паузи, яку можна завершити: скористайтеся `plan resume`
refused-px4-plan-item = PX4 не задає пункту плану цією командою: вона лише для ArduPilot
