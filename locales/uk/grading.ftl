# Оцінювання польотів за рубрикою.

rubric-schema = невідома схема { $found }: ця версія читає схему { $known }
rubric-categories = категорій: { $found }, а в рубриці їх має бути від чотирьох до шести
rubric-elements = елементів: { $found }, а в категорії їх має бути від 1 до { $most }
rubric-id = ідентифікатор складається з 1–24 малих латинських літер, цифр і `-`
rubric-id-twice = `{ $id }` ужито двічі
rubric-evidence = невідоме свідчення `{ $name }`
rubric-markers = перелічіть, що можна спостерегти: принаймні один текст
rubric-translations = перекладів: { $found }, а текстів: { $count }
file-rubric = рубрика

evidence-objectives-all = { $count ->
    [one] досягнуто { $count } ціль із { $count }
   *[many] досягнуто всіх { $count } цілей
}
evidence-objectives = досягнуто цілей: { $met } з { $count }; не досягнуто: { $missed }
evidence-alerts = вчасних відповідей на тривоги: { $in_time } з { $count }; найповільніша — через { $slowest } s
evidence-alerts-unanswered = { $count ->
    [one] { $count } тривога без відповіді
    [few] { $count } тривоги без відповіді
   *[many] { $count } тривог без відповіді
}
evidence-refusals = невдалих або відхилених команд: { $failed } з { $count }
evidence-commands = команд: { $count }, за хвилину: { $rate }; для кількох апаратів: { $percent } %
evidence-idle = апарати в повітрі не мали завдання { $percent } % часу
evidence-workload = на команди пішло { $mean } % часу, у найнапруженішу хвилину { $most } %
evidence-hints = { $count ->
    [0] без підказок
    [one] узято { $count } підказку
    [few] узято { $count } підказки
   *[many] узято { $count } підказок
}
evidence-prediction = передбачено балів: { $predicted }, здобуто: { $score }
evidence-no-crash = жоден апарат не розбився
evidence-crashes = розбилися апарати: { $vehicles }
evidence-component = { $component } { $percent } %: { $cause }

grading-no-record = від { $user } ще не надійшло жодного польоту
grading-unreadable = не вдалося прочитати оцінки в { $path }: { $fault }
grading-no-trainee = невідомо, кого оцінювати: поставте курсор на місце або напишіть `class grade ІМ'Я`
grading-none = політ для оцінювання не відкрито: введіть `class grade`
grading-rate-first = спершу оцініть елемент (`class rate`)
grading-no-bookmark = { $count ->
    [0] у польоті немає закладок
   *[other] виберіть закладку від 1 до { $count }
}
grading-reading = інший політ ще читається: зачекайте, доки він з'явиться
grading-oldest = давнішого польоту немає
grading-newest = новішого польоту немає
grading-foreign = вони належать іншому інструкторові або іншій рубриці
grading-waits = оцінки { $count ->
    [one] { $count } польоту
   *[other] { $count } польотів
} ще не записано; пульт тримає їх і пробує знову щохвилини: { $fault }
grading-written = усі оцінки записано
grading-ask-quit-reason = оцінки { $count ->
    [one] { $count } польоту
   *[other] { $count } польотів
} не вдалося записати, і вони пропадуть
grading-title = { $user }: { $mission }, балів: { $score }, { $when }  ({ $number }/{ $flights })
grading-rubric = { $rubric }; оцінює { $grader }
grading-open = { $count ->
    [0] усе оцінено
    [one] не оцінено { $count } елемент
    [few] не оцінено { $count } елементи
   *[many] не оцінено { $count } елементів
}
grading-scale = 1 дуже погано  2 погано  3 прийнятно  4 добре  5 відмінно  0 не видно
grading-needs-reason = оцінки 1 і 5 потребують примітки (`class remark`) або закладки (`class cite`)
grading-good = + { $marker }
grading-poor = - { $marker }
grading-evidence = запис: { $evidence }
grading-remark = примітка: { $text }
grading-cited = закладки: { $numbers }
grading-bookmark = ◆{ $number } { $time } { $text }
class-key-grade = оцінити
class-key-rate = оцінка 1–5, 0
class-key-remark = примітка
class-key-cite = закладка
argument-trainee = ім'я користувача курсанта
argument-rubric = назва рубрики
argument-rating = від 1 до 5, `unobserved` або `clear`
argument-bookmark = номер закладки

grades-none = Жодного польоту класу ще не оцінено: щоб почати, введіть `class grade` на пульті.
grades-grader = хто оцінив
grades-open = без оцінки
grades-rubric = рубрика
grades-element = елемент
grades-title = назва
grades-rating = оцінка
grades-state = стан
grades-counts = враховано
grades-unobserved = не спостерігали
grades-no-reason = без обґрунтування
grades-remark = примітка
grades-bookmarks = закладки, s
grades-agreement = { $first } і { $second }: оцінок обох { $marks }, однакових { $equal }, з різницею не більше одного бала: { $within }; середня різниця { $difference }, зважена каппа { $kappa }; спостерігав лише один: { $single }
grades-apart = { $user }, { $record }, { $element }: { $one } і { $other }
