# Профілі та поступ у командному рядку.
mastery-unknown = не пробували
mastery-learning = опановується
mastery-mastered = опановано
mastery-due = час повторити
lack-chance = ймовірність { $percent } %
lack-flights = { $count ->
    [one] ще { $count } політ
    [few] ще { $count } польоти
   *[other] ще { $count } польотів
}
lack-missions = { $count ->
    [1] ще одне завдання
   *[other] ще завдань: { $count }
}
lack-days = { $count ->
    [1] політ в інший день
   *[other] польоти в інші дні: ще { $count }
}

mission-state-locked = закрито
mission-state-open = відкрито
mission-state-passed = пройдено

part-for-sale = { $part }: { $price } cr, `sortie profile buy { $id }`
part-locked = { $part }: продається після завдання «{ $mission }»
parts-missing = { $design } має деталі, якими { $profile } ще не може користуватися

profile-created = профіль { $name } створено; літайте з `--profile { $name }`
profile-none = профілів ще немає; `sortie profile create NAME` створить профіль
profile-choose = профіль не вибрано; профілі: { $known }. Додайте `--profile NAME` або задайте `profile` у налаштуваннях
profile-delete = у профілі { $name } польотів: { $flights }. Щоб видалити все, додайте `--yes`; копію зробить `sortie profile export { $name }`
profile-deleted = профіль { $name } видалено
profile-imported = профіль { $name } імпортовано, польотів: { $flights }, жодного не перевірено
import-left-out = { $id } пропущено: { $why }
import-practice = { $id }: { $why }
import-twice = трапляється у файлі двічі
import-no-report = немає звіту
import-unfit = звіт суперечить сам собі: { $fault }
import-fleet = з його проєктами це завдання не виконати
profile-bought = { $part }: придбано за { $price } cr; лишилося { $left }
profile-not-stored = політ не збережено: { $fault }
profile-record = із профілем польоти записуються в теку його даних, а спроби рахуються: приберіть `--record` і `--try`
profiles-damaged = { $path } містить те, чого sortie не писала: { $fault }
profiles-recovered = завершений політ ({ $profile }) не було збережено; тепер його збережено: { $mission }, балів: { $score }
profiles-left-attempt = { $profile }: завдання { $mission } перервано достроково: його запис обривається, і решта польоту невідома; зараховано як припинене, балів: { $score }
profiles-left-exam = { $profile }: іспит { $mission } залишено достроково; зараховано балів: { $score }

progress-title = Поступ: { $name }
progress-standing = { $credits ->
    [one] { $credits } кредит
    [few] { $credits } кредити
   *[many] { $credits } кредитів
}, рівень { $level } (досвід { $experience } з { $next }), ліцензія на { $licence ->
    [one] { $licence } дрон
    [few] { $licence } дрони
   *[many] { $licence } дронів
}, { $flights ->
    [one] { $flights } політ
    [few] { $flights } польоти
   *[many] { $flights } польотів
}
progress-next = далі: { $skill } у завданні «{ $mission }»
progress-aids = поради: { $aids }
progress-lang = мова: { $lang }
progress-since = з { $day }
progress-missions = Завдання
progress-skills = Навички
progress-flown-by = пілот
flown-by-hand = людина
flown-by-script = скрипт
flown-by-bundled-pilot = скрипт із комплекту
progress-runs = Польоти
progress-trainee = курсант
progress-mission = завдання
progress-state = стан
progress-medal = медаль
progress-best = найкращий
progress-tries = спроби
progress-first = перший
progress-last = останній
progress-trend = зміна за спробу
progress-why = чому закрито
progress-skill = навичка
progress-chance = імовірність
progress-mastery = опанування
progress-shown = перевірок
progress-due = повторити
progress-ended = завершено (UTC)
progress-score = бали
progress-passed = пройдено
progress-stake = рахується як
progress-seed = варіант
progress-recording = запис
progress-is-imported = імпортовано
progress-imported = імпортовано, не перевірено польотів: { $count }
aids-full = усі
aids-fading = щораз менше
aids-none = немає
stake-graded = залік
stake-practice = тренування
stake-exam = іспит
stake-daily = варіант дня
answer-yes = так
answer-no = ні
profile-member = { $name }: { $credits ->
    [one] { $credits } кредит
    [few] { $credits } кредити
   *[many] { $credits } кредитів
}, рівень { $level }, ліцензія на { $licence ->
    [one] { $licence } дрон
    [few] { $licence } дрони
   *[many] { $licence } дронів
}, { $flights ->
    [one] { $flights } політ
    [few] { $flights } польоти
   *[many] { $flights } польотів
}
