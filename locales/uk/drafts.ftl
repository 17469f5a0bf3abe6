# Екран планів і рядки про чернетки.

room-plans = плани
action-plans = малювати плани, геозони й точки збору
action-next-item = перейти до наступного пункту
action-previous-item = перейти до попереднього пункту
action-mark-items = почати позначати пункти звідси або зняти позначки
action-plan-list = показати пункти плану
action-fence-list = показати пункти геозони
action-rally-list = показати точки збору
action-next-draft = перейти до наступної чернетки
action-previous-draft = перейти до попередньої чернетки
action-new-draft = почати нову чернетку
action-open-draft = відкрити файл
action-take-plan = відкрити те, що є на борту апаратів
action-save-draft = зберегти чернетку у файл
action-upload-draft = завантажити чернетку на борт апаратів
action-survey-draft = поділити намальовану ділянку між апаратами
action-try-drafts = випробувати чернетки разом у симуляції
action-show-figures = перейти до показників випробування або до пунктів
action-undo-edit = скасувати останню зміну
action-redo-edit = повторити скасовану зміну
action-write-height = вписати висоту позначених пунктів
action-set-field = задати параметр позначених пунктів
action-write-command = змінити команду пункту
action-write-jump = додати перехід після пункту
action-closer-draft = збільшити масштаб
action-wider-draft = зменшити масштаб
action-fit-drafts = показати всі чернетки
action-centre-draft = центрувати карту на курсорі
action-add-item = додати пункт під курсором, після вибраного
action-insert-item = додати пункт під курсором, перед вибраним
action-move-item = перенести позначені пункти до курсора
action-delete-item = видалити позначені пункти
action-split-leg = додати точку посередині відрізка
action-higher = підняти позначені пункти на 5 m; розширити коло
action-lower = опустити позначені пункти на 5 m; звузити коло
action-next-frame = змінити рівень відліку висоти
action-add-takeoff = додати зліт
action-add-land = додати посадку під курсором
action-add-return = додати повернення до місця зльоту
action-begin-polygon = почати під курсором ділянку геозони
action-add-circle = додати під курсором коло геозони

plans-hint-add = додати
plans-hint-move = перенести
plans-hint-item = пункт
plans-hint-delete = видалити
plans-hint-height = висота
plans-hint-undo = скасувати
plans-hint-save = зберегти
plans-hint-upload = на борт
plans-hint-set = задати
plans-hint-takeoff = зліт
plans-hint-return = повернення
plans-hint-land = посадка
plans-hint-draft = чернетка
plans-hint-zoom = масштаб
plans-hint-mark = позначити
plans-hint-insert = вставити
plans-hint-survey = покрити
plans-hint-rehearse = випробувати
plans-hint-split = поділити
plans-hint-jump = перехід
plans-hint-command = команда
plans-hint-frame = відлік
plans-hint-area = ділянка
plans-hint-corner = кут
plans-hint-circle = коло
plans-hint-reverse = змінити вид
plans-hint-radius = радіус
plans-hint-new = нова
plans-hint-open = відкрити
plans-hint-take = з апарата

plans-nothing = Чернеток немає. Натисніть { $new }, щоб почати порожню, { $open }, щоб відкрити файл, або { $take }, щоб відкрити те, що є на борту апаратів. Щоб покрити ділянку, натисніть { $new }, { $fence }, далі { $begin } і { $add } на її кутах, потім { $survey }.
plans-begin = пересувайте курсор стрілками й додавайте там пункти
plans-no-faults = помилок немає
plans-faults = { $count ->
    [one] { $count } помилка
    [few] { $count } помилки
   *[many] { $count } помилок
}
plans-column-command = команда
plans-column-place = від дому, m
plans-column-height = вис.
plans-column-leg = відрізок
plans-column-slope = нахил
plans-column-time = час
plans-column-parameters = параметри
plans-leg = відрізок { $length }, { $time }
plans-climb = набір { $height }, { $time }
plans-cursor = курсор
plans-from-item = від пункту
plans-heights = висоти: { $name }  { $length }, { $time } ({ $speed } m/s)
plans-heights-at = { $name }  { $length }, { $time } ({ $speed } m/s)
plans-heights-short = { $name }  { $length }, { $time }
plans-mark = план { $mark }
plans-upload = на борт: { $done } з { $count }
plans-upload-failed = на борт: невдач { $failed } з { $count }, причини в журналі команд
plans-upload-done = завантажено все: { $count }
plans-next-upload = далі: `{ $key }` завантажить план на борт
plans-next-mend = далі: виправте позначене `!` перед завантаженням
plans-next-figures = випробування не вдалося; далі: `{ $figures }` покаже його показники; змініть чернетки, потім `{ $again }`
plans-next-change = випробування не вдалося; далі: змініть чернетки, потім `{ $again }` випробує їх знову
plans-next-arm = на борту; далі: `guided`, `arm`, `plan start`
plans-next-start = двигуни активні, план на борту; далі: `plan start`
plans-next-aloft = у повітрі; далі: `plan resume` — летіти за планом, `rtl` — повернутися
plans-next-flying = летить за планом: `plan pause`, `plan skip`, `plan abort`
plans-next-paused = пауза: `plan resume`, `plan skip`, `plan abort`
plans-next-flown = план виконано; далі: `{ $key }` завантажить інший план, `plan clear` видалить цей, `guided`, `arm`, `plan start` повторять його
plans-repeats = , без повторів, заданих переходами
plans-figures-draft = чернетка
plans-figures-time = час
plans-figures-left = заряд
plans-figures-far = відст.
plans-figures-fence = зона
plans-figures-end = кінець
plans-figures-kept = норма
plans-figures-pair = зближення
plans-figures-at = час
plans-figures-apart = відст.
plans-figures-height = висота
plans-figures-none = показників ще немає: спершу випробуйте чернетки
plans-tried-further = { $text }: натисніть `{ $key }`
plans-figures-key = `{ $key }` відкриває показники випробування або пункти

draft-holds = { $name }: { $holds }
draft-restored = знову відкрито незбережені чернетки попереднього сеансу: { $names }
draft-none = чернетки немає: почніть її командою `draft new`, `draft open FILE` або `draft take`
draft-empty = чернетка порожня: спершу додайте пункти
draft-no-item = такого пункту немає; пунктів у списку: { $count }
draft-jump-target = пункт { $item } — перехід до пункту, який буде видалено: спершу видаліть перехід
draft-no-leg = до цього пункту не веде жоден відрізок, або висоти його кінців відлічено від різних рівнів
draft-unknown-height = висота дому чи рельєфу невідома: задайте висоту числом
draft-no-cursor = карта ще не показує місця: задайте його, наприклад `draft home LAT LON`
draft-no-home = дім невідомий: задайте його командою `draft home LAT LON`
draft-no-place = ці пункти не прив'язані до місця
draft-no-radius = радіус мають лише кола геозони
draft-no-fields = { $command } не має параметрів
draft-jump-never = якщо повторів 0, апарат ніколи не перейде: вкажіть 1 або більше чи -1 (без кінця)
draft-rally-frame = `f` змінює відлік висоти лише в плані: точки збору зберігають свій
draft-no-field = { $command } не має параметра `{ $name }`; є { $names }
draft-file-faulty = { $path }:{ $line }:{ $column }: { $fault }
draft-noted = { $path }: { $notes }
draft-nothing-on-board = ще нічого не зчитано з апаратів: { $vehicles }; `plan show` зчитує план
draft-none-for-vehicles = жодна чернетка не належить апарату: такі чернетки створюють `draft take` і плани для цілого рою
draft-no-vehicles = жодного апарата не вибрано: спершу виберіть апарати
draft-divided = чернетки для { $vehicles }: перегляньте їх, далі `draft upload each`
draft-divided-idle = чернетки для { $vehicles }; { $idle } — без частини роботи: попередній план прибере `{ $idle } plan clear`
draft-no-area = ділянки не намальовано: `draft fence polygon` починає її під курсором, `draft fence corner` додає кути, разом щонайменше три
draft-line-short = для лінії треба щонайменше два місця: запишіть їх або намалюйте точки в чернетці
draft-ask-close = ЗАКРИТИ чернетку { $name }
draft-ask-close-reason = її не збережено
draft-ask-quit-reason = чернетку плану не збережено

verb-draft = малювати план, геозону й точки збору: починати, відкривати, змінювати, зберігати чернетки й завантажувати їх на борт
argument-draft-new = почати порожню чернетку
argument-draft-name = назва чернетки
argument-draft-save = записати чернетку у файл
argument-draft-take = відкрити те, що є на борту апаратів
argument-draft-use = перейти до іншої чернетки
argument-draft-close = закрити чернетку
argument-draft-upload = завантажити чернетку на борт; після невдачі повертаються старі списки
argument-draft-each = завантажити кожну чернетку на борт апарата, якому вона належить
argument-draft-survey = покрити намальовану ділянку паралельними лініями, по чернетці для кожного апарата
argument-draft-search = скласти схему пошуку, по чернетці для кожного апарата
argument-draft-line = летіти смугами поруч уздовж лінії чи намальованих точок, по чернетці для кожного апарата
argument-draft-orbit = кружляти навколо місця, по чернетці для кожного апарата
argument-draft-drawn = інша ділянка, ніж намальована в чернетці
argument-draft-undo = скасувати останню зміну
argument-draft-redo = повторити скасовану зміну
argument-draft-speed = швидкість для розрахунку часу; без числа — швидкість апарата
argument-draft-add = додати пункт у кінці
argument-draft-insert = додати пункт перед іншим
argument-draft-delete = видалити пункти
argument-draft-move = перенести пункти на відстань, до місця або до курсора карти
argument-draft-order = перенести пункти на інше місце в списку
argument-draft-split = додати точку посередині відрізка, що веде до пункту
argument-draft-change-height = змінити висоту; для кіл — радіус
argument-draft-by = приріст у метрах
argument-draft-frame = рівень відліку висоти
argument-draft-change-command = дати пункту іншу команду
argument-draft-set = задати параметр за назвою
argument-draft-jump = додати перехід після пункту
argument-draft-times = кількість повторів; -1 — нескінченно
argument-draft-home = перенести дім чернетки
argument-draft-fence = змінити геозону
argument-draft-corner = додати кут до останнього многокутника
argument-draft-polygon = почати ділянку, яку не можна залишати
argument-draft-area = ділянка завдання
argument-draft-circle = додати коло, яке не можна залишати
argument-draft-radius = радіус
argument-draft-out = ділянка, до якої не можна входити
argument-draft-reverse = змінити вид ділянки: не залишати або не входити
argument-draft-rally = додати точку збору
argument-draft-items = пункти, наприклад `3` або `3-5`
argument-draft-item = номер пункту
argument-draft-list = список; типово план
argument-draft-command = команда
argument-draft-place = місце
argument-draft-north = метри на північ від дому; для `move` — на скільки метрів на північ
argument-draft-east = метри на схід від дому; для `move` — на скільки метрів на схід
argument-draft-height = висота
argument-draft-field = назва параметра
argument-draft-value = значення
draft-ground-level = висота рельєфу невідома: вважається, що він на рівні дому
draft-ground-read = висоти рельєфу з { $path }; відрізки, що проходять менш ніж за { $clearance } m над ним, — помилки
draft-ground-none = { $path }: немає файлу для цього місця; файли названо за південно-західними кутами, як-от `N50E030.hgt`
plans-above-ground = щонайменше { $height } m над рельєфом
argument-draft-ground = брати висоту рельєфу з файлів SRTM (`.hgt`) у теці; без теки рельєф вважається рівним
argument-draft-ground-folder = тека
draft-trial-flies = { $count ->
    [one] { $count } план випробовується в симуляції
    [few] { $count } плани випробовуються в симуляції
   *[other] { $count } планів випробовуються в симуляції
}
draft-trial-none = жодна чернетка не має плану
draft-trial-unplaced = { $vehicles }: позиція невідома
draft-trial-busy = чернетки ще випробовуються: зачекайте на результат
draft-trial-discarded = результат відкинуто: під час випробування чернетки змінилися; випробуйте їх ще раз
draft-trial-broken = симуляція чернеток не вдалася
draft-trial-refused = { $name }: апарат відхилив би список: { $list }
draft-trial-conflicts = { $count ->
    [one] { $count } конфлікт
    [few] { $count } конфлікти
   *[other] { $count } конфліктів
}: { $pairs }; `draft deconflict` розведе чернетки
draft-trial-more = { $pairs } та ще { $more }
draft-trial-meeting = { $a } і { $b } надто зближуються на { $time }
draft-trial-fence = { $name } порушує геозону на { $time }
draft-trial-unfinished = { $name }: політ не доходить до кінця плану
draft-trial-hit-ground = { $name }: апарат врізається в землю на шляху до пункту { $number }
draft-trial-in-air = { $name }: план закінчується в повітрі; додайте посадку або повернення
draft-trial-figures = { $count ->
    [one] { $count } план виконано
    [few] { $count } плани виконано
   *[other] { $count } планів виконано
} за { $time }, заряду лишається щонайменше { $left } %
draft-trial-further = { $count ->
    [one] ще { $count } чернетка не пройшла випробування
    [few] ще { $count } чернетки не пройшли випробування
   *[other] ще { $count } чернеток не пройшли випробування
}
draft-trial-unassigned = без польоту: { $names } (жодному апарату не призначено; `draft use { $first }`, потім `draft rehearse VEHICLES`)
draft-trial-unchosen = без польоту: { $names } (вибрані апарати виконують лише поточну чернетку)
draft-trial-idle = без польоту: { $vehicles } (чернетки немає; поточна належить іншому апарату)
draft-trial-delay = { $name } стартує на { $seconds } s пізніше
draft-trial-layer = { $name } летить на { $height } m вище
draft-trial-split = кожен апарат має власну чернетку: `draft upload each`
draft-trial-disarm = задайте DISARM_DELAY 0, інакше апарат деактивує двигуни, поки чекає
argument-draft-rehearse = випробувати чернетки всіх апаратів разом у симуляції; чернетку без апарата виконує кожен вибраний або названий апарат
argument-draft-deconflict = знайти пізніші старти чи різні висоти для чернеток, що надто зближуються
