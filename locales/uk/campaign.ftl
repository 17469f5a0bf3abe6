# Кампанія: навички, замки, деталі.
skill-arming = перевірки та озброєння моторів
skill-commands = режими та команди
skill-navigation = політ до точки
skill-energy = енергія
skill-links = зв'язок і аварійні дії
skill-coverage = покриття площі
skill-sensors = читання датчиків
skill-threats = відповідь на загрози
skill-separation = рознесення та повітряний простір
skill-swarm = керування роєм
skill-design = проєктування дронів
skill-judgement = оцінка самого себе
skill-prediction = передбачення балів

locked-pass = пройдіть «{ $mission }»
locked-medal = здобудьте медаль ({ $medal }) у «{ $mission }»
locked-skill = { $skill }: { $has } %, треба { $wanted } %
locked-licence = треба ліцензію на { $wanted } дронів, ваша на { $has }

buy-unknown = такої деталі немає; їх перелічує `sortie workshop parts`
buy-owned = вона вже ваша
buy-locked = спершу пройдіть { $mission }
buy-too-dear = вона коштує { $price } кредитів, у вас { $credits }

reward-heading = Кар'єра
reward-credits = кредити +{ $pay }, тепер { $now }
reward-credits-wear = кредити +{ $pay }, -{ $wear } за знос ваших дронів, тепер { $now }
reward-unpaid = без кредитів: { $why }; тепер { $now }
reward-unpaid-wear = без кредитів: { $why }; -{ $wear } за знос ваших дронів, тепер { $now }
reward-practice = за тренування їх немає
reward-not-passed = завдання не пройдено
reward-not-better = більше дає лише результат, вищий за { $best }
reward-daily-again = зерно дня зараховується раз на день
reward-no-pay = за цей політ їх немає
reward-experience = досвід +{ $gained }, рівень { $level }, до наступного { $left }
reward-level = досвід +{ $gained }, рівень { $before } -> { $after }, до наступного { $left }
reward-licence = ліцензія на кількість дронів { $before } -> { $after }
reward-mission = нове завдання: { $mission }
reward-parts = нові деталі в продажу: { $parts }
reward-skill = { $skill } { $before } % -> { $after } %: { $why }
reward-seen = { $what } { $percent } %

profiles-unusable = профілі не можна зберігати в { $path }: { $error }
profiles-newer = { $path } зробила новіша версія sortie (таблиці версії { $found }, ця знає { $known }); нічого не змінено. Візьміть ту версію або іншу теку з --data
profiles-database = { $path }: { $error }
profiles-unknown = профілю `{ $name }` немає; є: { $known }
profiles-unknown-first = немає ні профілю `{ $name }`, ні іншого; його зробить `sortie profile create { $name }`
profiles-exists = профіль `{ $name }` уже є
profiles-name = ім'я профілю — один рядок від 1 до { $most } літер
profiles-no-profile = це не профіль: { $fault }
profiles-rescued = профілі були пошкоджені ({ $fault }), їх відновлено з { $copy }; пошкоджений файл — { $damaged }
profiles-lost = профілі були пошкоджені ({ $fault }), а копії немає: вони починаються наново; пошкоджений файл — { $damaged }

mission-locked = «{ $mission }» ще закрито: { $why }
career-nowhere = профілі тут не зберігаються: тека даних недоступна
career-waits = політ ще не збережено: { $fault }; нова спроба - перед наступним польотом і наприкінці роботи
launch-practice = це тренувальний політ: завдання закрите або не з курсу, деталь не ваша, або обрано зерно, раму чи швидкість
flight-practice = { $mission }, тренування
flight-daily = { $mission }, зерно дня
flight-exam = { $mission }, іспит
