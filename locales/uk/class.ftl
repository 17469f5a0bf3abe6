# Клас: пульт інструктора і місця курсантів

room-class = клас
action-class = показати клас
action-mark-seat = позначити місце або зняти позначку
action-mark-all-seats = позначити всі місця
verb-class = показати клас або дати вказівки його місцям
words-class = інструктор пульт місця курсанти урок
argument-seat = @місце або @all, тут або в кінці; без нього — те, за яким спостерігають, позначені або під курсором
argument-hold = курсант чекає в інструктажі до `class start`
argument-class-vehicles = апарати місця, наприклад 1-4,7; без них — усі
argument-situation = назва ситуації або її номер
argument-condition = умова, як у файлах завдань

# Клавіші в останньому рядку
class-key-watch = екран
class-key-board = таблиця
class-key-mark = позначити
class-key-message = повідомлення
class-key-hint = підказка
class-key-freeze = зупинити час
class-key-resume = продовжити
class-key-bookmark = закладка
class-key-inject = подія
class-key-take = керувати
class-key-give = повернути
class-key-end = завершити
class-key-results = результати
class-key-next-page = наступна сторінка

# Таблиця
class-listens = { $class } за адресою { $address }
class-title = клас { $class }: на зв'язку { $here } із { $count } { $count ->
        [one] місця
       *[other] місць
    }{ $consoles ->
        [0] {""}
        [one] , { $consoles } консоль
        [few] , { $consoles } консолі
       *[other] , { $consoles } консолей
    }{ $marked ->
        [0] {""}
       *[other] , позначено { $marked }
    }
class-empty = Ще ніхто не приєднався. На одній машині для цього є `sortie --class { $class }`, на кількох — `sortie join` з рядком запрошення.
class-column-seat = місце
class-column-state = стан
class-column-mission = завдання
class-column-clock = час
class-column-score = бали
class-column-objectives = цілі
class-column-air = літ.
class-column-alerts = тривоги
class-column-separation = відст
class-column-failures = відм.
class-column-workload = нав.
class-column-command = ост. команда
class-home = не літає
class-reading = читає
class-held = чекає старту
class-flying = політ
class-exam = іспит
class-paused = пауза
class-frozen-short = час зупинено
class-over = завершено
class-free = вільний політ
class-gone = без зв'язку { $time }
class-silent = мовчить { $time }
class-need-collision = зіткнення за { $time }
class-need-collision-now = надто близько
class-need-fence = межа за { $time }
class-need-fence-now = за межею
class-need-alert = тривога { $time }
class-need-stuck = без команд { $time }

# Місце під курсором
class-order = { $deed }: { $state }
class-waiting = очікується відповідь
class-unanswered = без відповіді
class-missing = { $count ->
        [one] { $count } давній запис уже недоступний
        [few] { $count } давні записи вже недоступні
       *[many] { $count } давніх записів уже недоступні
    }
class-started = розпочато завдання { $mission }
class-started-free = розпочато політ
class-failed = { $line }: апарат { $vehicle } не виконав
class-objective = досягнуто мету: { $title }
class-passed = завдання виконано, бали: { $score }
class-not-passed = завдання не виконано, бали: { $score }
class-situations = ситуації: { $all }
class-situation-at = { $seat }: «{ $name }», { $at }
class-taken = ви керуєте: { $vehicles }
class-armed-inject = підготовлено: { $name } за умови { $when }
class-inject-hit = { $count ->
        [one] апарат
       *[other] апарати
    } { $vehicles }
class-injects-title = { $seat }: події
class-inject = { $name }: { $title }
class-no-injects = завдання не дозволяє вводити події
class-no-mission = завдання не виконують: події бувають лише в завданнях

class-watch-title = екран: { $seat }
class-watch-none = очікується перше зображення
class-watch-cut = обрізано: стовпці { $left }–{ $right } із { $columns }, рядки { $top }–{ $bottom } із { $rows } (рухати стрілками)
class-watch-stale = застаріло: нічого не надходить { $time }
class-watch-gone = застаріло: курсант від'єднався

# Вказівки
class-deed-message = повідомлення «{ $text }»
class-deed-hint = підказка
class-deed-mark = закладка
class-deed-mark-text = закладка «{ $text }»
class-deed-freeze = зупинка часу
class-deed-resume = продовження
class-deed-inject = подія { $name }
class-deed-inject-when = подія { $name } за умови { $when }
class-deed-disarm = скасування події { $name }
class-deed-disarm-all = скасування всіх підготовлених подій
class-deed-end = завершення завдання
class-deed-capture = збереження ситуації
class-deed-capture-name = збереження ситуації «{ $name }»
class-deed-recall = повернення до ситуації «{ $situation }»
class-deed-take = перейняття керування { $vehicles }
class-deed-give = повернення керування { $vehicles }
class-deed-command = { $line }
class-deed-fly = політ { $mission }
class-deed-exam = іспит { $mission }
class-deed-hold = { $deed }, з очікуванням початку
class-deed-start = початок завдання
class-deed-step = заняття { $lesson }, крок { $step }
class-deed-step-when = заняття { $lesson }, крок { $step } за умови { $when }
class-deed-lesson-end = заняття { $lesson } закінчено
class-done = виконано
class-no-effect = результату не видно
class-armed = чекає на умову
class-step-watched = умова під наглядом
class-under-way = виконується
class-disarmed = скасовано
class-refused = відхилено: { $reason }
class-refusal-exam = на іспиті це заборонено
class-refusal-no-mission = завдання не виконується
class-refusal-not-flying = політ ще не почався або вже завершений
class-refusal-cannot-freeze = апарати симулює не ця консоль
class-refusal-not-frozen = час польоту не зупинено
class-refusal-no-hint = для цього моменту завдання не має підказки
class-refusal-not-recorded = політ не записується
class-refusal-paused = політ на паузі
class-refusal-no-inject = завдання не дозволяє цієї події
class-refusal-condition = умова називає те, чого в завданні немає
class-refusal-not-armed = такої підготовленої події немає
class-refusal-flying = триває інший політ
class-refusal-locked = у профілі цього місця завдання ще закрите, тож іспиту не буде
class-refusal-too-many-situations = для польоту вже збережено 10 ситуацій: замініть одну за її назвою
class-refusal-no-situation = такої ситуації в цьому польоті не збережено
class-refusal-no-vehicle = у польоті немає такого апарата
class-refusal-real-vehicle = апарати можуть бути справжні, а налаштування місця (class.take_over) цього не дозволяють
class-refusal-not-taken = керує курсант: спершу перейміть керування (class take)
class-refusal-line = місце не може прочитати рядок, або це не команда апаратам
class-refusal-vehicle = апарат цього не виконує
class-line-long = рядок довший за 200 символів
class-which-vehicles = вкажіть номери, наприклад 1-4,7, або all
class-say-vehicles = місцю надсилаються лише команди апаратам
class-ask-command = { $line }: { $seats }
class-did-hint = { $instructor }: надано підказку
class-did-freeze = { $instructor }: час польоту зупинено
class-did-resume = { $instructor }: політ продовжено
class-did-end = { $instructor }: завдання завершено
class-did-start = { $instructor }: завдання розпочато
class-did-capture = { $instructor }: ситуацію збережено
class-did-show = { $instructor } показує відтворення
class-did-fly = { $instructor }: відкрито { $mission }
class-did-exam = { $instructor }: відкрито іспит «{ $exam }»: спроба { $number } з { $tries }
class-did-recall = { $instructor }: повернення до ситуації «{ $situation }»
class-did-take = тепер { $instructor } керує { $vehicles }
class-did-give = { $instructor } більше не керує { $vehicles }
class-desk-line = { $instructor }: { $deed }: { $outcome }
class-given = { $deed }: надіслано { $seats }
class-seats = { $count ->
        [one] { $count } місцю
       *[other] { $count } місцям
    }
class-call-done = виконано на { $count } { $count ->
        [one] місці
       *[other] місцях
    }
class-call-refused = відхилено на { $count } ({ $which }: { $reason })
class-call-other = { $state } на { $count } ({ $which })
class-all-seats = усі місця
class-no-desk = ця консоль не є пультом класу: відкрийте його командою `sortie class open`
class-unknown-seat = у класі немає місця { $word }
class-unknown-seat-help = якщо текст починається чи закінчується таким словом, спершу назвіть місця: @anna або @all
class-no-seat = немає місця на зв'язку: перейдіть до нього курсором, позначте кілька або назвіть одне, наприклад @anna
class-ask-end = ЗАВЕРШИТИ ЗАВДАННЯ: { $seats }
class-ask-end-reason = польоти цих курсантів завершаться зараз і будуть оцінені; інструктаж закриється без оцінки

class-quit-taken = апаратами, якими ви керуєте, знову керуватимуть курсанти ({ $seats })
class-quit-frozen = зупинені польоти курсанти зможуть продовжити самі ({ $seats })
class-quit-held = завдання, що чекають старту, курсанти зможуть розпочати самі ({ $seats })
class-quit-lesson = заняття чекатимуть, доки пульт не відкриють знову ({ $seats })

class-ask-recall = ПОВЕРНУТИ ДО «{ $situation }»: { $seats }
class-ask-recall-seat = { $seat }: назад до { $at }, { $lost } польоту буде втрачено
class-ask-recall-practice = далі політ тренувальний і не записується

# На місці курсанта
header-watched = пульт: { $instructor }
header-screen-watched = { $instructor } бачить цей екран
header-screen-watched-short = { $instructor } дивиться
header-pilot = { $pilot } керує { $vehicles }
header-try = спроба { $number } з { $tries }, лишилося { $time }
header-try-short = ще { $time }
header-frozen = ЧАС ЗУПИНЕНО
class-none = клас не налаштовано: запустіть консоль із `--class` та назвою класу
class-waits = очікується пульт класу { $place }
class-no-answer-yet = пульт класу { $place } поки не відповідає; консоль пробує далі
class-ask = Приєднатися до класу, який веде { $instructor }?
class-ask-reason = інструктор бачитиме ваш політ і ваш екран, зможе зупинити час польоту або завершити його й отримає його запис
class-joining = приєднання до класу
class-joined = у класі { $class }: { $instructor } бачить ваш політ
class-left = не в класі: приєднатися можна командою `class join`
class-lost-frozen = пульт зник; `continue` продовжить ваш політ
class-lost = пульт зник; ваш політ триває
class-lost-home = пульт зник
pilot-other = апаратом { $vehicle } керує { $pilot }
pilot-user = керування апаратом { $vehicle } не перебрано
pilot-keeps = { $pilot } керує { $vehicles }: зачекайте, доки керування повернуть
pilot-desk-gone = пульт зник: { $pilot } більше не керує { $vehicles }; керуєте ви
ledger-by = { $person }: { $line }
class-message = { $instructor }: { $text }
class-frozen = { $instructor } зупиняє час польоту: зачекайте, доки його буде продовжено
class-brief-held = завдання розпочне { $instructor }: зачекайте тут
class-brief-freed = пульт зник: завдання розпочинаєте ви
class-denied = до класу не прийнято: { $reason }
class-denial-version = пульт потребує версії { $desk } протоколу; оновіть sortie
class-denial-full = у класі немає вільних місць
class-denial-hello = пульт не зрозумів цю консоль

# Записи, що здаються
class-handed-in = запис польоту здано
class-handed-in-later = запис польоту ще не здано: { $reason }; він лишається тут і буде поданий знову
class-not-handed-in = запис польоту не здано: { $reason }; він лишається тут
class-kept = { $user }: запис { $mission } здано, бали { $score }
class-not-kept = запис { $record } від { $user } не збережено: { $reason }
class-unscored = запис збережено, але оцінити його не можна: { $fault }
class-submission-unwritable = диск пульта переповнений або недоступний
class-submission-damaged = його пошкоджено дорогою
class-submission-share = ваші записи на пульті перевищили б 1 GiB
class-submission-impossible = запису завдання немає, або він більший за 64 MiB
class-submission-different = пульт зберігає під цією назвою інший запис

# Результати класу
class-no-records = до класу { $class } ще не здано жодного запису
class-no-records-known = до класу { $class } ще не здано жодного запису; є записи класів: { $known }
class-report-title = Клас { $class }: { $count } { $count ->
        [one] курсант
        [few] курсанти
       *[other] курсантів
    }
class-report-none = Ще жоден політ не зараховано: тренування і польоти скрипту не є результатами.
class-report-missions = Найкращі бали і спроби за завданнями (✓ пройдено)
class-report-skills = Імовірність, що навичку засвоєно
class-report-spread = Найкращі бали класу
class-report-objectives = Цілі, спершу найменш засвоєні (найкращий політ кожного)
class-report-skill-spread = Навички, спершу найменш засвоєні
class-report-practice = тренувань
class-report-as-practice = політ був тренувальний
class-report-script = команди давав сценарій
class-report-uncounted = Польоти, яких не зараховано: з них не випливають ні результат, ні вміння
class-report-why-not = чому
class-report-trainees = курсантів
class-report-least = найнижчий
class-report-median = медіана
class-report-most = найвищий
class-report-objective = ціль
class-report-objective-title = назва
class-report-met = досягнуто
class-report-share = бали
class-report-mastered = засвоїли
class-report-profile = профіль
class-report-revision = редакція
class-report-mandatory = обов’язкова
class-report-points = бали
class-report-points-max = із балів
class-report-result = результат
class-report-began = початок (UTC)
class-report-record = запис
class-report-trainee = Клас { $class }: здано { $count } { $count ->
        [one] політ
        [few] польоти
       *[other] польотів
    }.
class-report-of-profiles = Профіль: { $profiles }.
class-report-best = { $mission }: найкращий політ, бали { $score } ({ $when })

# Що інструктор робив у польоті
class-all-vehicles = усіма апаратами
instructor-flew = { $by }: керування { $vehicles } з { $from } до { $until }
instructor-flies = { $by }: керування { $vehicles } з { $from } до кінця
instructor-injected = { $by }: подія { $inject } о { $at }
instructor-recalled = { $by }: повернення до ситуації «{ $situation }» о { $at }
instructor-continued = { $by }: повернення до ситуації «{ $situation }», політ продовжено з { $from }
class-report-instructed = Польоти за участю інструктора
class-report-instructor = інструктор

# Сторінка результатів
class-results-title = клас { $class }, { $number } з { $count }: { $page }
class-results-by-mission = Найкращі бали і спроби за завданнями
class-results-none = Жоден курсант ще не здав запису: консоль здає його, коли закінчується політ завдання.
class-results-no-tries = Записи здано, але жоден не зараховано: тренування, польоти скрипту й недійсні спроби іспиту не є результатами. Нехай курсанти виконують завдання курсу, але не як тренування.
class-results-no-skills = Жоден зарахований політ ще не тренував навичок. Навички оцінюють за цілями завдань курсу: нехай курсанти їх виконують.
class-results-reading = Записи класу читаються.
class-results-met = хто досяг
class-results-spread = найнижчий ─ середина █ ─ найвищий
class-results-left-out = { $count ->
        [one] ще { $count } стовпець
        [few] ще { $count } стовпці
       *[other] ще { $count } стовпців
    }: розширте термінал або запустіть `sortie class report`

# Сокет
class-no-socket = { $socket } уже існує і не є сокетом: виберіть іншу назву
class-in-use = на { $socket } вже відкрито пульт: виберіть іншу назву або закрийте його
class-not-open = не вдалося відкрити { $socket }: { $error }
class-folder = { $folder } належить іншому користувачеві або може бути змінена іншими: виберіть іншу назву
class-stranger = не приєднано: пульт на { $socket } належить користувачеві { $user }, а не { $instructor }

# Кілька машин
class-not-built = у цій збірці sortie є лише класи на одній машині; попросіть в адміністратора ту, яку зібрано командою `cargo build --release --features zenoh`
class-file = не вдалося скористатися { $file }: { $error }
class-exposed = { $file } містить таємний ключ, а його можуть читати інші користувачі: виконайте `chmod 600 { $file }`; якщо хтось міг його прочитати, вилучіть це місце командою `sortie class remove` і візьміть інше, а якщо це файл пульта, створіть новий клас
class-join-file = у { $file } немає рядка запрошення: { $reason }
class-join-line = це не рядок запрошення: { $reason }
class-join-prefix = він не починається з `sortie-join/1/`; до класу на одній машині приєднуються з `--class`
class-join-incomplete = бракує його частини; скопіюйте рядок повністю або візьміть файл
class-join-damaged = його частину пошкоджено; скопіюйте рядок ще раз або візьміть файл
class-no-keys = { $file } не є файлом пульта або пошкоджений ({ $reason }): створіть новий клас командою `sortie class new`
class-no-class = у { $folder } немає класу для кількох машин: створіть його командою `sortie class new`
class-has-keys = { $class } — клас на кількох машинах: відкрийте пульт із `--listen` або дайте класу на цій машині іншу назву
class-exists = { $folder } уже існує: виберіть іншу назву або видаліть теку, якщо клас завершено
class-name = `{ $name }` не може бути назвою класу на кількох машинах: візьміть до 64 латинських літер, цифр, `-` і `_`
class-address = `{ $address }` не є адресою: напишіть ХОСТ:ПОРТ, наприклад 192.168.1.5:7447
class-desk-alone = для `--desk` потрібен клас: вкажіть його файл запрошення, наприклад `--class seat-07.join`
class-setting-join-help = виправте шлях або попросіть у інструктора файл свого місця ще раз
class-setting-folder = немає теки { $folder }, у якій має бути клас
class-setting-folder-help = виправте шлях або хай інструктор створить теку: `sortie class open ШЛЯХ`
class-setting-user = на цій машині немає користувача { $user }, тож пульт не може належати такому інструкторові
class-setting-user-help = напишіть ім'я, під яким інструктор входить у систему
class-join-unusable = консоль не в класі, бо `class.join` з налаштувань не вдалося використати: { $fault }
class-unknown-file = у класі в { $folder } немає місця { $seat }: місця називаються як їхні файли, наприклад `seat-07`
class-removed = У класі { $class } більше немає місця { $seat }. Відкритий пульт його ще приймає: закрийте пульт і відкрийте знову.
class-records-exist = у { $folder } вже є записи попереднього класу { $class }, і записи нового змішалися б із ними: виберіть іншу назву, наприклад { $class }-2, або перенесіть цю теку
class-on-host = `--desk` діє лише з файлами запрошень, а клас { $socket } — на цій машині
class-no-address = не вдалося визначити, яку адресу цієї машини взяти: вкажіть її, наприклад `--address 192.168.1.5:7447`
class-port-in-use = за адресою { $address } уже працює інший пульт або інша програма: закрийте її або виберіть інший порт, який курсанти вкажуть у `--desk`
class-not-of-machine = ця машина не має адреси { $address }: виберіть одну з її адрес або 0.0.0.0 для всіх
class-not-listening = не вдалося відкрити пульт за адресою { $address }: { $reason }
class-not-started = не вдалося відкрити пульт за адресою { $address }: { $reason }
class-start-certificates = Zenoh не приймає ключів із `desk.json`: поверніть файл таким, яким його було створено, або створіть новий клас
class-start-timeout = Zenoh не запустився за 10 с: спробуйте ще раз
class-start-ended = Zenoh одразу завершив роботу: спробуйте ще раз
class-not-the-desk = не приєднано: { $address } відповідає, але не як пульт цього класу: запитайте інструктора, чи правильні ще адреса й рядок запрошення
class-unknown = не приєднано: пульт класу { $class } не відповідає місцю { $seat }: рядок запрошення відкликано, він від іншого класу з такою назвою або ним уже користуються чотири консолі
class-crypto = не вдалося створити або використати ключі: { $reason }
class-made = Клас { $class }, { $seats } { $seats ->
        [one] місце
        [few] місця
       *[other] місць
    }, у теці { $folder }.
class-made-lines = Файли в { $folder } — для курсантів, кожному по одному. Вони таємні: хто має файл, той може зайняти його місце.
class-made-desk = Пульт: `sortie class open { $class } --listen { $listen }`
class-made-seat = Курсант: `sortie join { $file }`; консоль шукатиме пульт за адресою { $addresses }
