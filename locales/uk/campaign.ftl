# Кампанія: навички, замки, деталі.
skill-arming = перевірки та активація двигунів
skill-commands = режими та команди
skill-navigation = політ до точки
skill-energy = енергія
skill-links = зв'язок і аварійні дії
skill-coverage = покриття площі
skill-sensors = покази датчиків
skill-threats = реакція на загрози
skill-separation = розведення в повітрі
skill-swarm = керування роєм
skill-design = проєктування дронів
skill-judgement = самооцінка
skill-plans = складання й перевірка планів
skill-prediction = передбачення балів

locked-pass = пройдіть «{ $mission }»
locked-medal = здобудьте медаль у завданні «{ $mission }»: { $medal }
locked-skill = { $skill } { $has } %, треба { $wanted } %
locked-licence = треба ліцензію на { $wanted ->
    [one] { $wanted } дрон
    [few] { $wanted } дрони
   *[many] { $wanted } дронів
}, ваша на { $has }

buy-unknown = такої деталі немає; усі деталі показує `sortie workshop parts`
buy-owned = ця деталь уже ваша
buy-locked = спершу пройдіть «{ $mission }»
buy-too-dear = коштує { $price } cr, у вас { $credits }

reward-heading = Кар'єра
reward-exam-passed = ІСПИТ СКЛАДЕНО
reward-exam-failed = ІСПИТ НЕ СКЛАДЕНО
reward-credits = кредити +{ $pay }, тепер { $now }
reward-credits-wear = кредити +{ $pay }, -{ $wear } за знос і пошкодження ваших апаратів, тепер { $now }
reward-unpaid = без кредитів: { $why }; тепер { $now }
reward-unpaid-wear = без кредитів: { $why }; -{ $wear } за знос і пошкодження ваших апаратів, тепер { $now }
reward-practice = за тренування їх не дають
reward-not-passed = завдання не пройдено
reward-not-better = більше дає лише результат, вищий за { $best }
reward-all-points = ваш найкращий результат, { $best }, — найвищий можливий
reward-daily-again = варіант дня зараховується раз на день
reward-no-pay = за цей політ їх не дають
reward-experience = досвід +{ $gained }, рівень { $level }, до наступного { $left }
reward-level = досвід +{ $gained }, рівень { $before } -> { $after }, до наступного { $left }
reward-licence = дронів за ліцензією: { $before } -> { $after }
reward-mission = нове завдання: { $mission }
reward-parts = нові деталі в продажу: { $parts }
reward-vehicle = новий вид апарата: { $kind }; його деталі продаються в майстерні
vehicle-kinds = можна складати: { $kinds }
vehicle-after = { $kind } (після завдання { $mission })
reward-skill = { $skill } { $before } % -> { $after } %: { $why }
reward-skill-new = { $skill } { $after } %, перша перевірка: { $why }
reward-seen = { $what } { $percent } %

profiles-unusable = не вдається зберігати профілі в { $path }: { $error }
profiles-unreadable = не вдається прочитати профілі в { $path }: { $error }
profiles-forbidden = { $path } належить користувачеві { $owner }, і читати його може лише він: попросіть у нього доступ
profiles-unshared = { $path } належить користувачеві { $owner }, і читати його може лише він: тека { $folder } не має біта setgid, тож нові результати в ній не відкриваються для групи; попросіть користувача { $owner } виконати `sortie doctor`: там є потрібна команда
sharing-foreign = група не може читати { $path }: власник — { $owner }, змінити це може лише root; команду покаже `sortie doctor`
sharing-failed = група не може читати { $path }: { $error }; команду покаже `sortie doctor`
sharing-group-bit = нові результати в { $path } не відкриваються для групи: біт setgid цієї теки може поставити лише root; команду покаже `sortie doctor`
sharing-more = ще файлів і тек, яких група не може читати: { $count }; їх назве `sortie doctor`
profiles-read-only = { $path } можна лише читати: у його профілях нічого не зберігається; вкажіть власну теку через `--data`
profiles-newer = { $path } створила новіша версія sortie (схема { $found }, ця версія читає { $known }); нічого не змінено. Скористайтеся тією версією або іншою текою через `--data`
profiles-older = { $path } створено старішою версією sortie, тут його можна лише читати; власник має один раз запустити цю версію, щоб перетворити дані
profiles-log-alone = { $path } тут можна лише читати, а останні зміни лежать у { $log }, і в теці без права запису прочитати їх не можна: скопіюйте обидва файли у власну теку й укажіть її через `--data`
profiles-database = { $path }: { $error }
profiles-unknown = профілю `{ $name }` немає; профілі: { $known }
profiles-unknown-first = профілю `{ $name }` немає; його створить `sortie profile create { $name }`
profiles-exists = профіль `{ $name }` уже є: виберіть інше ім'я
profiles-name = ім'я профілю — один рядок від 1 до { $most } знаків
profiles-no-profile = це не профіль: { $fault }
profiles-mended = { $count ->
    [one] { $count } пошкоджений рядок профілів відновлено з резервної копії
    [few] { $count } пошкоджені рядки профілів відновлено з резервної копії
   *[many] { $count } пошкоджених рядків профілів відновлено з резервної копії
}
profiles-unmended = { $count ->
    [one] { $count } рядок профілів пошкоджено, і в резервних копіях його немає: дані, що від нього залежать, прочитати не вдасться
    [few] { $count } рядки профілів пошкоджено, і в резервних копіях їх немає: дані, що від них залежать, прочитати не вдасться
   *[many] { $count } рядків профілів пошкоджено, і в резервних копіях їх немає: дані, що від них залежать, прочитати не вдасться
}
profiles-rescued = профілі були пошкоджені ({ $fault }), їх відновлено з { $copy }; пошкоджений файл — { $damaged }
profiles-fault-empty = файл порожній
profiles-fault-database = SQLite: { $words }
profiles-lost = профілі були пошкоджені ({ $fault }), резервної копії немає, тож тепер вони порожні; пошкоджений файл — { $damaged }

mission-locked = завдання «{ $mission }» ще закрито: { $why }
career-nowhere = профілі тут не зберігаються: тека даних недоступна
career-waits = політ ще не збережено: { $fault }; sortie спробує знову перед наступним польотом і під час виходу
career-deferred = { $count ->
    [one] { $count } політ не вдалося зберегти у профілі: його запис повний, тож sortie збереже його під час наступного запуску
    [few] { $count } польоти не вдалося зберегти у профілях: їхні записи повні, тож sortie збереже їх під час наступного запуску
   *[many] { $count } польотів не вдалося зберегти у профілях: їхні записи повні, тож sortie збереже їх під час наступного запуску
}
career-ask-quit-reason = { $count ->
    [one] { $count } політ ще не збережено, його буде втрачено
    [few] { $count } польоти ще не збережено, їх буде втрачено
   *[many] { $count } польотів ще не збережено, їх буде втрачено
}
career-lost = { $count ->
    [one] { $count } політ не вдалося зберегти, його втрачено: звільніть місце на диску перед наступним польотом
    [few] { $count } польоти не вдалося зберегти, їх втрачено: звільніть місце на диску перед наступним польотом
   *[many] { $count } польотів не вдалося зберегти, їх втрачено: звільніть місце на диску перед наступним польотом
}
launch-practice = лише тренування: { $why }
practice-seed = ви вибрали варіант самі
practice-script = команди дає скрипт
practice-own-mission = завдання не належить до курсу, який містить лише завдання sortie й адміністратора
practice-altered-mission = файл завдання відрізняється від завдання курсу з цим id; щоб виконати завдання курсу, дайте своєму файлу інший id або приберіть його
practice-locked = завдання закрите ({ $why })
practice-parts = у { $design } є деталі, яких ви не маєте ({ $parts })
practice-airframes = рами взято з ваших файлів
practice-slow = час іде повільніше за реальний
practice-unconfirmed = запис не вдається підтвердити (причину називає `sortie verify`)
exam-real-time = іспит відбувається в реальному часі: запустіть sortie без `--speedup`
exam-alone = іспит складають поодинці: запустіть sortie без `--crew`
exam-by-hand = іспит складають власноруч, а не скриптом: почніть його з початкового екрана
daily-by-hand = завдання з варіантом дня виконують власноруч, бо скрипт наперед показав би, де що розміщено: вкажіть `--seed N`
flight-practice = { $mission }, тренування
flight-daily = { $mission }, варіант дня
flight-exam = { $mission }, іспит
