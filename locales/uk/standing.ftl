# Профіль, поступ і що далі.

room-standing = поступ
action-standing = показати поступ: навички, бали, кредити
action-daily = виконати завдання з варіантом дня
action-exam = скласти іспит із завдання
action-practise = тренуватися на вибраному варіанті
action-profiles = вибрати профіль
action-aids = змінити кількість порад
keys-list = переліки для вибору
hint-trainee = профіль
hint-mission = завдання
hint-aids = поради

# Перший рядок початкового екрана.
home-no-profile = вибрати профіль: без нього результати не зберігаються
home-trainee = рівень { $level }   { $credits } cr   ліцензія { $licence }
home-next = далі: { $skill } { $percent } %, { $mission }
home-next-new = далі: { $skill } (не пробували), { $mission }
home-next-short = далі: { $mission }
home-career = для вашої кар'єри
# Щонайбільше 8 знаків кожне.
home-locked = закрито
home-is-next = далі
home-sign-passed = пройдено
home-sign-next = далі
home-sign-due = пройдено, час повторити
home-sign-locked = закрито
home-daily = варіант дня
home-exam = іспит
home-practise = тренування
home-seed-none = варіант — ціле число від 0
ask-exam = РОЗПОЧАТИ іспит
ask-exam-reason = власний варіант, реальний час, без підказок і пауз; результат враховується

# Що завдання означає для кар'єри: назви й відомості.
mission-career = для вашої кар'єри
fact-stage = стан
fact-locked = закрито: { $why }
fact-practice = лише тренування: { $why }
fact-new = відкрито, ще не виконувалося
fact-practised = відкрито, тренувальних польотів { $count }
fact-exam = іспит
fact-exam-passed = складено, балів: { $score }
fact-exam-failed = не складено, балів: { $score }
fact-no-points = відкрито, без балів, польотів { $count }
fact-open = відкрито, найбільше балів: { $score }, польотів { $count }
fact-passed = пройдено, балів: { $score }, { $medal }, польотів { $count }
fact-next = далі
fact-next-is = це завдання; тренує: { $skill }
fact-next-drill = «{ $drill }»; тренує: { $skill }
fact-review = час повторити
fact-trains = тренує, %
fact-skill = { $skill } { $percent }
fact-skills-new = { $skills } (не пробували)
fact-skill-mastered = { $skill } { $percent } (опановано)
fact-pays = винагорода
fact-pays-first = до { $credits } cr за перше проходження
fact-pays-nothing = без кредитів
fact-pays-paid = усе виплачено
fact-pays-left = ще до { $left } cr за кращі бали
fact-opens = відкриває
fact-drones = дрони
fact-drones-are = { $count }, ваша ліцензія на { $licence }
fact-daily = сьогодні
fact-daily-open = варіант дня ще не виконано
fact-daily-flown = варіант дня виконано; повтори — тренування

# Перелік профілів.
profiles-title = профілі
profiles-now = (поточний)
profiles-new = новий профіль ...
profiles-guest = Гість (результати не зберігаються)
profiles-keys = { $scroll } рух   { $submit } вибрати   { $escape } назад
profiles-in-flight = завдання триває: спершу завершіть його; результат належить поточному профілю
profiles-nameless = впишіть ім'я
prompt-profile = ваше ім'я
prompt-profile-advice = ваші польоти, кредити й проєкти зберігаються лише на цьому комп'ютері
prompt-seed = варіант для тренування
prompt-seed-advice = число; той самий варіант дає те саме розташування. Порожнє поле й { $submit } — варіант із `--seed` або 1. Тренування не дає кредитів

# Власний поступ.
standing-no-profile = У гостя немає поступу. Натисніть { $key }, щоб вибрати або створити профіль; тоді тут буде видно, як змінюються навички, бали, кредити й досвід.
standing-choose-first = спершу виберіть профіль: { $key }
standing-skill-locked = жодне відкрите завдання не тренує «{ $skill }»: { $why }
standing-skill-untrained = жодне завдання курсу не тренує «{ $skill }»
standing-level = рівень { $level }
standing-experience = досвід { $experience }/{ $needed }
standing-credits = { $credits } cr
standing-licence = ліцензія { $count }
standing-flights = польотів { $count }
standing-aids-key = змінює
standing-skills = навички: імовірність, що їх опановано
standing-next = далі
standing-review = повторити { $when }
standing-why = чому: { $skill }
standing-lacks = щоб опанувати, треба { $lacks }
standing-why-nothing = даних ще немає: виконайте завдання, що тренує цю навичку
standing-moved = { $mission }: { $what } { $percent } %, { $when }
standing-scores = бали за завданнями
standing-scores-nothing = польотів ще немає
standing-column-mission = завдання
standing-column-flights = польотів
standing-column-best = найкращий
standing-column-medal = медаль
standing-column-last = останній
standing-column-when = коли
standing-chart = бали за кожен політ: { $mission }   x не пройдено   p тренування
standing-wealth = кредити й досвід після кожного польоту й купівлі
standing-wealth-nothing = польотів ще немає
standing-curve = { $what }: зараз { $now }
standing-curve-credits = кредити
standing-curve-experience = досвід
days-today = сьогодні
days-ahead = { $count ->
    [one] через { $count } день
    [few] через { $count } дні
   *[many] через { $count } днів
}
days-ago = { $count ->
    [one] { $count } день тому
    [few] { $count } дні тому
   *[many] { $count } днів тому
}

# Скільки порад консоль дає без запиту.
aids-full-about = поради: усі підказки й зауваження
aids-fading-about = поради: що вищі навички, то менше підказок
aids-none-about = поради: лише підказки, про які ви просите

debrief-career = КАР'ЄРА
