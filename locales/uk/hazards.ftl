# Неперервні небезпеки: датчики, вантажі та цілі.

mission-sensor-monoxide = CO
mission-sensor-methane = CH4
mission-sensor-dose-rate = потужність дози

# Вантажі.
load-ball = кулі
load-spray = розчин
load-kit = набори
load-node = вузли
load-dropped = { $what }; лишилося { $left }
load-nothing = у ціль не влучено
load-empty = { $load }: нічого не лишилося, сядьте на майданчик на 20 s
load-served = вантаж поповнено
load-shut = розпилювач вимкнено
load-spray-left = лишилося { $left } s
load-on-ground = апарат стоїть на землі: спершу злетіть
load-too-high = { $height } m — це зависоко: щонайбільше { $limit } m
load-sample = { $sensor } { $value } { $unit }
load-sample-speed = проби беруть на швидкості не більш як { $limit } m/s

# Дія вантажів на вогонь.
fire-put-out = там вогонь погашено
fire-goes-on = там вогонь не згас
fire-wetted = там земля мокра
fire-none-there = там нічого не горить

# Пошук джерела.
locate-reports = { $count ->
    [0] не повідомлено
   *[other] оцінка потім: { $count }
}
locate-off = похибка { $distance } m
locate-missed = не знайдено
locate-wrong = хибних: { $count }
locate-blind = без вимірювання поблизу: { $count }
locate-quality = повідомляйте лише про те, у чому впевнені, і спершу повільно пролетіть над тим місцем
locate-target = { $count } з точністю { $within } m
locate-advice = Перетніть ділянку з двох боків, летіть повільно там, де покази найбільші, і повідомте про місце: `mark peak`. Враховуються лише місця, поблизу яких датчик щось виміряв; хибне повідомлення відкличте командою `unmark`.

# Край пожежі.
perimeter-none = карти ще немає
perimeter-next = карта через { $seconds } s
perimeter-target = { $fit } на { $times } s
perimeter-quality = огляньте весь край незадовго до того, як заберуть копію карти, а фронт за вітром — наостанок
perimeter-advice = Огляньте весь край незадовго до того, як заберуть копію карти; фронт за вітром лишіть наостанок.

# Захист ділянки від пожежі.
protect-safe = нічого не згоріло
protect-still = поки що нічого не згоріло
protect-burnt = згоріло клітинок: { $lost } з { $all }
protect-target = щоб нічого не згоріло
protect-advice = Змочіть землю на шляху фронту, від дороги до дороги, перш ніж дійде вогонь; потім гасіть те, що прорвалося.
contain-hits = корисних: { $good } з { $all }
contain-share = згоріло { $percent } % порівняно з пожежею без гасіння
contain-target = { $percent } %
contain-quality = скидайте й розпилюйте лише над полум'ям і сухим паливом, повільно й низько
contain-advice = Почніть із фронту, що йде за вітром: пожежа подвоюється щохвилини.

# Доза опромінення апаратів.
dose-most = найбільша доза { $dose } uSv
dose-target = { $limit } uSv
dose-advice = Тримайтеся вище й не зупиняйтеся: потужність дози падає з квадратом відстані, а доза росте з часом.
