# Оцінювання польотів за рубрикою.

rubric-schema = невідома схема { $found }: ця версія читає схему { $known }
rubric-categories = категорій: { $found }, а в рубриці їх має бути від чотирьох до шести
rubric-elements = елементів: { $found }, а в категорії їх має бути від 1 до { $most }
rubric-id = ідентифікатор має від 1 до 24 малих латинських літер, цифр і `-`
rubric-id-twice = `{ $id }` ужито двічі
rubric-evidence = невідоме свідчення `{ $name }`
rubric-markers = перелічіть, що можна спостерегти: принаймні один текст
rubric-translations = перекладів: { $found }, а текстів: { $count }
file-rubric = рубрика

evidence-objectives-all = { $count ->
    [one] виконано { $count } ціль із { $count }
    [few] виконано всі { $count } цілі
   *[many] виконано всі { $count } цілей
}
evidence-objectives = виконано цілей: { $met } з { $count }; не виконано: { $missed }
evidence-alerts = вчасно відповіли на { $in_time } з { $count } сигналів, найповільніше — через { $slowest } s
evidence-alerts-unanswered = { $count ->
    [one] { $count } сигнал без відповіді
    [few] { $count } сигнали без відповіді
   *[many] { $count } сигналів без відповіді
}
evidence-refusals = невдалих або відхилених команд: { $failed } з { $count }
evidence-commands = команд: { $count }, за хвилину: { $rate }; для кількох апаратів: { $percent } %
evidence-idle = апарати чекали { $percent } % свого часу в повітрі
evidence-workload = зайнятість командами { $mean } % часу, найбільше { $most } % хвилини
evidence-hints = { $count ->
    [0] без підказок
    [one] узято { $count } підказку
    [few] узято { $count } підказки
   *[many] узято { $count } підказок
}
evidence-prediction = передбачено { $predicted } балів, здобуто { $score }
evidence-no-crash = жоден апарат не розбився
evidence-crashes = розбилися: { $vehicles }
evidence-component = { $component } { $percent } %: { $cause }

grading-no-record = { $user } ще не здав жодного польоту
grading-unreadable = не вдалося прочитати оцінки в { $path }: { $fault }
grading-no-trainee = невідомо, кого оцінювати: поставте курсор на місце або напишіть `class grade ІМ'Я`
grading-none = жоден політ не оцінюється: `class grade` показує політ
grading-rate-first = спершу поставте оцінку (`class rate`)
grading-no-bookmark = { $count ->
    [0] у польоті немає закладок
   *[other] виберіть закладку від 1 до { $count }
}
grading-lost = оцінки не збережено: { $fault }
grading-title = { $user }: { $mission }, балів: { $score }, { $when }  ({ $number }/{ $flights })
grading-rubric = { $rubric }; оцінює { $grader }
grading-open = { $count ->
    [0] усе оцінено
    [one] не оцінено { $count } елемент
    [few] не оцінено { $count } елементи
   *[many] не оцінено { $count } елементів
}
grading-scale = 1 дуже погано  2 погано  3 прийнятно  4 добре  5 дуже добре  0 не спостерігали
grading-needs-reason = оцінки 1 і 5 потребують зауваги (`class remark`) або закладки (`class cite`)
grading-good = + { $marker }
grading-poor = - { $marker }
grading-evidence = запис: { $evidence }
grading-remark = заувага: { $text }
grading-cited = закладки: { $numbers }
grading-bookmark = ◆{ $number } { $time } { $text }
class-key-grade = оцінити
class-key-rate = поставити 3
class-key-remark = заувага
class-key-cite = закладка
class-key-older = давніший політ
argument-trainee = ім'я користувача
argument-rubric = назва рубрики або її файл
argument-mark = від 1 до 5, `unobserved` або `clear`
argument-bookmark = номер закладки

grades-none = Жодного польоту класу ще не оцінено: на пульті починає `class grade`.
grades-grader = хто оцінив
grades-open = без оцінки
grades-rubric = рубрика
grades-element = елемент
grades-title = назва
grades-mark = оцінка
grades-remark = заувага
grades-bookmarks = закладки, s
grades-agreement = { $first } і { $second }: оцінок обох { $marks }, однакових { $equal }, різниця щонайбільше один бал: { $within }; середня різниця { $difference }, зважена каппа { $kappa }; спостерігав лише один: { $single }
grades-apart = { $user }, { $record }, { $element }: { $one } і { $other }
