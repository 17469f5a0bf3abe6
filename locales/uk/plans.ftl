# Файли планів: `sortie plan`, `sortie check`.

file-plan = файл плану
plan-holds-plan = план { $hash }: { $count ->
    [one] { $count } пункт
    [few] { $count } пункти
   *[many] { $count } пунктів
}
plan-holds-fence = геозона: { $count ->
    [one] { $count } пункт
    [few] { $count } пункти
   *[many] { $count } пунктів
}
plan-holds-rally = точки збору: { $count }
plan-holds-nothing = пунктів немає
plan-list-plan = план
plan-list-fence = геозона
plan-list-rally = точки збору
plan-good = помилок немає
plan-warning = (попередження)
plan-at-item = { $list }, пункт { $number }: { $what }
plan-at-items = { $list }, пункти { $numbers }: { $what }

plan-file-unknown = невідомий формат: потрібен QGC WPL, .plan, геозона чи точки збору MAVProxy, KML, KMZ або GeoJSON
plan-file-not-text = файл не є текстом UTF-8
plan-file-version = версія { $found } невідома: потрібна { $known }
plan-file-fields = полів { $found }, має бути { $expected }
plan-file-number = `{ $text }` не є числом
plan-file-range = `{ $text }` поза допустимими межами
plan-file-order = цей пункт має номер { $found }, а має бути { $expected }
plan-file-xml = хибний XML: { $error }
plan-file-missing = бракує `{ $name }`
plan-file-no-items = складений пункт `{ $kind }` не містить простих пунктів: збережіть план у QGroundControl ще раз
plan-file-jump = перехід веде до ідентифікатора { $id }, якого не має жоден пункт
plan-file-corners = многокутник має мати щонайменше 3 кути, а цей має { $count }
plan-file-line = лінія має мати щонайменше 2 точки
plan-file-many = забагато пунктів для списку
plan-file-empty = у файлі немає ні плану, ні геозони, ні точок збору
plan-file-archive-damaged = архів пошкоджено
plan-file-archive-no-kml = в архіві немає файлу .kml
plan-file-archive-method = архів стиснено невідомим способом: скористайтеся deflate
plan-file-archive-large = вміст архіву завеликий
plan-file-syntax-end = файл закінчується зарано
plan-file-syntax-unexpected = несподіваний символ `{ $character }`
plan-file-syntax-text = хибний рядок
plan-file-syntax-trailing = тут документ закінчується, але далі у файлі є ще текст
plan-file-syntax-deep = забагато рівнів
plan-file-expected-number = тут має бути число
plan-file-expected-number-or-null = тут має бути число або `null`
plan-file-expected-text = тут має бути рядок
plan-file-expected-flag = тут має бути `true` або `false`
plan-file-expected-list = тут має бути список
plan-file-expected-object = тут має бути об'єкт
plan-file-expected-length = тут має бути список, кількість значень: { $count }
plan-file-expected-position = тут мають бути довгота й широта
plan-file-expected-word = тут має бути { $words }

plan-note-height = у файлі немає висоти: взято { $height } m над домом (`--height`)
plan-note-home-height = дім не має висоти: взято 0 m над рівнем моря
plan-note-fraction = дробову частину параметра 5 або 6 округлено: MAVLink передає їх цілими числами
plan-note-lines = ліній { $count }: їх об'єднано в один план

plan-refused-command = апарат відхиляє { $command } у цьому списку
plan-refused-frame = апарат відхиляє систему висот { $command }: потрібен рівень моря (0), дім (3) або рельєф (10)
plan-refused-latitude = широта { $command } не в межах від -90 до 90
plan-refused-longitude = довгота { $command } не в межах від -180 до 180
plan-refused-height = висота { $command } — не число, яке апарат може зберегти
plan-refused-parameter = параметр { $number } команди { $command } — неприпустиме число
plan-unstorable = `{ $name }` у { $command } — { $written }; апарат зберіг би { $stored }
plan-skipped = { $vehicle } пропускає { $command } під час польоту
plan-vehicle-copter = коптер
plan-vehicle-plane = літак
plan-vehicle-rover = ровер
plan-too-many = пунктів { $count }; апарат зберігає щонайбільше { $most }
plan-jump-nowhere = перехід веде до пункту { $target }; є пункти від 1 до { $last }
plan-jump-ring = переходи утворюють цикл без жодного пункту для польоту: план тут закінчується
plan-no-tag = жоден пункт не має мітки { $tag }
plan-fence-count = многокутник має мати щонайменше 3 кути, а цей має { $count }
plan-fence-other-count = цей кут указує { $got } як кількість кутів свого многокутника, а перший кут — { $wanted }
plan-fence-other-type = пункт іншого виду всередині многокутника: перед ним бракує кутів
plan-fence-missing = останній многокутник неповний
plan-fence-radius = радіус кола не є додатним
plan-fence-returns = друга точка повернення
plan-fence-place = хибна широта або довгота
plan-fence-large = геозона займає байтів: { $bytes }; апарат має { $most }
plan-breaks-fence = поза геозоною (ділянка { $area })
plan-leg-breaks-fence = відрізок до цього пункту перетинає геозону (ділянка { $area })
plan-home-breaks-fence = дім поза геозоною (ділянка { $area })
plan-beyond-radius = { $distance } m від дому; межа { $most } m
plan-above-ceiling = { $height } m над домом; межа { $most } m
plan-no-takeoff = немає зльоту перед першою точкою: апарат лишається на землі
plan-no-end = план не має завершення: після останнього пункту апарат зависає; додайте RTL або LAND
plan-unreached = до цього пункту апарат не дійде
plan-no-terrain = висота над рельєфом, а апарат не має даних про рельєф
plan-below-ground = відрізок до цього пункту проходить на { $depth } m нижче за поверхню землі, за { $along } m від початку
plan-low-over-ground = відрізок до цього пункту проходить на висоті { $height } m над землею, за { $along } m від початку; треба щонайменше { $least } m (`--clearance`)
plan-no-ground = висота над рельєфом, але файли рельєфу не охоплюють цього відрізка
plan-uncovered = відрізків, яких не охоплює жоден файл рельєфу: { $count }
plan-home-height = у файлі дім на { $home } m над рівнем моря; земля там на { $ground } m
plan-terrain-lowest = найнижче над землею: { $height } m, на відрізку до пункту { $number }
plan-terrain-no-folder = { $path }: такої теки немає
plan-terrain-size = { $path }: байтів: { $bytes }; файл `.hgt` має 2884802 (3 кутові секунди) або 25934402 (1 кутова секунда)
plan-mixed-frames = рівень відліку висоти змінюється: { $before }, тепер { $here }
plan-mixed-frames-home = рівень відліку висоти змінюється: { $before }, тепер { $here } ({ $first } m і { $second } m над домом)
plan-height-sea = { $height } m над рівнем моря
plan-height-home = { $height } m над домом
plan-height-terrain = { $height } m над рельєфом
plan-height-other = { $height } m від невідомого рівня
plan-low-height = { $height } m над домом: апарат врізався б у землю
plan-far-away = { $distance } km від дому: перевірте координати

plan-would-lose = цей формат не вміщує: { $list }; запишіть файл .plan або виберіть один список через `--list`
plan-would-lose-frame = файл .plan не вміщує точку збору { $number }: її висоту відлічено не від дому
plan-would-lose-fence = файл .plan не вміщує геозону: пункт { $number } не належить жодній повній ділянці
plan-would-lose-infinite = { $list }, пункт { $number }: цей формат не вміщує нескінченного числа
plan-written = { $path }: { $content }

plan-rehearse-no-plan = { $file }: немає плану для польоту
plan-rehearse-no-home = { $file }: у файлі немає дому; задайте його через `--home LAT,LON,ALT,HDG`
plan-rehearse-refused = { $file }: апарат відхиляє список: { $list }; причину показує `sortie plan check`
plan-rehearse-no-parameter = невідомий параметр або значення: { $name }
plan-rehearse-vehicle = апарат
plan-rehearse-file = файл
plan-rehearse-time = час
plan-rehearse-energy = лишок заряду
plan-rehearse-farthest = найдалі
plan-rehearse-fence = геозона
plan-rehearse-end = кінець
plan-rehearse-fence-kept = дотримано
plan-rehearse-fence-broken = порушено на { $time }
plan-rehearse-fence-none = немає
plan-rehearse-landed = сів
plan-rehearse-in-air = у повітрі
plan-rehearse-left-plan = перейшов із плану в { $mode }
plan-rehearse-grounded = не злетів
plan-rehearse-crashed = зіткнувся
plan-rehearse-time-up = ще летить
plan-rehearse-moved = апарат { $vehicle } стартує на { $distance } m східніше від свого дому: той самий дім має інший апарат
plan-rehearse-closest = найближче: { $a } і { $b } на { $time }: { $horizontal } m по горизонталі, { $vertical } m по вертикалі
plan-rehearse-conflict = заблизько: { $a } і { $b } на { $time }: { $horizontal } m по горизонталі, { $vertical } m по вертикалі
plan-rehearse-late = заблизько, якщо один запізниться на { $late } s: { $a } і { $b }
plan-rehearse-waits = апарат { $vehicle } чекає на землі з активними двигунами: перед польотом встановіть на ньому `DISARM_DELAY` 0
plan-rehearse-done = { $simulated } польоту змодельовано за { $wall } s

plan-deconflict-none = плани досить далеко один від одного; нічого змінювати не треба
plan-deconflict-margin = вони не зближуються, навіть якщо апарат запізниться на { $late } s
plan-deconflict-tight = вони надто зближуються, якщо апарат запізнюється (до { $late } s): стартуйте вчасно
plan-deconflict-impossible = ні пізніші старти, ні різні висоти не розведуть цих планів
plan-deconflict-keep = { $vehicle } ({ $file }): без змін
plan-deconflict-delay = { $vehicle } ({ $file }): стартує на { $time } пізніше
plan-deconflict-layer = { $vehicle } ({ $file }): летить на { $height } m вище
plan-deconflict-cost = втрата часу всіх апаратів разом: { $time }
plan-deconflict-disarm = затримку записано як NAV_DELAY перед зльотом: задайте DISARM_DELAY 0, інакше апарат деактивує двигуни, поки чекає

plan-generate-no-vehicle = немає апаратів для планування
plan-generate-empty = ділянка або лінія не має розміру
plan-generate-too-many = більш ніж { $most } ліній: збільште відстань між лініями
plan-generate-narrow = надто близькі смуги конфліктують: `--spacing` має бути щонайменше { $least } m
plan-generate-fence = геозона має помилки; їх показує `sortie plan check`
plan-generate-outside = схема порушує геозону: перемістіть її або зменште
plan-generate-no-way = апарат { $vehicle }: від його дому до його частини немає шляху в межах геозони
plan-generate-no-shape = немає фігури: задайте файл, `--points` або `--datum`
plan-generate-which-area = ділянок у файлі: { $count }; виберіть одну через `--area`
plan-generate-no-area = такої ділянки немає; ділянок у файлі: { $count }
plan-generate-no-line = у цьому файлі немає лінії
plan-generate-no-point = у цьому файлі немає точки: задайте її через `--datum`
plan-generate-homes = `--homes`: { $error }
plan-generate-no-homes = `--homes`: немає місць
plan-generate-no-home = немає дому: задайте `--home` і `--vehicles` або `--homes`
plan-generate-no-fence = { $file }: у цьому файлі немає геозони
plan-generate-length = довжина
plan-generate-used = акумулятор
plan-generate-share = частка
plan-generate-layer = висота перельоту
plan-generate-imbalance = найбільша частка в { $times } раза більша за найменшу
plan-generate-idle = апарат { $vehicle } не має плану: він надто далеко, щоб заощадити енергію інших
plan-generate-uncovered = не охоплено { $share } % ділянки: геозона надто близько
