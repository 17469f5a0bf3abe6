# Спостереження за місцями і те, що пульт показує класу

# Клавіші в останньому рядку
class-key-tiles = плитки
class-key-replay = відтворити
class-key-unmark = зняти позначки
class-key-other-flight = політ
class-key-back = назад
class-key-state = стан
class-key-injects = події
class-key-select = вибрати
class-key-look-away = закрити
argument-beside = курсант, чий політ показати поруч

# За екраном місця
class-flight-title = стан: { $seat }
class-flight-waits = очікується стан польоту
class-flight-figures = { $clock }  бали { $score }  цілі { $met }/{ $objectives }  у повітрі { $airborne }/{ $vehicles }
class-flight-figures-short = { $clock }  бали { $score }  { $met }/{ $objectives }  злет. { $airborne }/{ $vehicles }
class-flight-alert = ! { $alert }
class-flight-open = ○ { $title }  { $detail }
class-flight-met = ✓ { $title }  { $detail }
class-flight-missed = ✗ { $title }  { $detail }
class-flight-more = { $count ->
        [one] ще { $count } ціль
        [few] ще { $count } цілі
       *[many] ще { $count } цілей
    }
class-flight-vehicle = { $vehicle } { $mode } { $height } m { $battery } %
class-flight-elsewhere = на екрані за { $metres } m звідси
class-alert-of = апарат { $vehicle }: { $cause }

# Розбір з усім класом
class-replay-title = бали { $score }  { $trainee }
class-replay-reading = Польоти зчитуються.
class-replay-none-beside = { $user } не має іншого зданого польоту завдання { $mission }
class-replay-before = цей політ ще не почався
class-replay-over = цей політ уже завершено
class-replay-figures = { $clock }  висота { $height } m  батарея { $battery } %
class-replay-met = ✓ { $title }
class-replay-open = ○ { $title }
class-replay-bookmark = ◆ { $clock }  { $text }
class-deed-look-on = показ відтворення
class-show-nothing = нічого не відтворюється: спершу відкрийте політ командою `class replay`
class-show-exam = триває іспит: до його кінця класові нічого не показують
class-show-none = класові нічого не показують
class-show-stopped = клас більше не бачить відтворення
class-show-over = клас більше не бачить відтворення: воно завершене або триває іспит
class-shown-title = { $instructor } показує
class-shown-over = пульт більше не показує відтворення
class-shown-closed = відтворення тут закрито; пульт і далі показує його класу

# Що роблять клавіші пульта, для довідки
desk-key-message = показати курсантові повідомлення
desk-key-hint = дати наступну підказку завдання, за її ціну
desk-key-freeze = зупинити час польоту
desk-key-resume = пустити час зупиненого польоту далі
desk-key-bookmark = поставити закладку в записі польоту
desk-key-inject = спричинити подію завдання
desk-key-injects = показати події, які дозволяє завдання
desk-key-tiles = показати чотири місця разом
desk-key-state = стан польоту замість екрана або назад
desk-key-replay = відтворити найновіший політ курсанта
desk-key-exam = провести іспит на місцях
desk-key-capture = зберегти ситуацію польоту
desk-key-recall = повернутися до ситуації польоту
desk-key-take = керувати апаратами курсанта
desk-key-give = віддати апарати курсантові
desk-key-end = закінчити завдання, після запитання
desk-key-results = показати результати класу
desk-key-next-page = показати наступну сторінку результатів
desk-key-page-before = показати попередню сторінку результатів
desk-key-grade = оцінити найновіший політ курсанта
desk-key-rate-1 = оцінка елемента: 1, дуже погано
desk-key-rate-2 = оцінка елемента: 2, погано
desk-key-rate-3 = оцінка елемента: 3, прийнятно
desk-key-rate-4 = оцінка елемента: 4, добре
desk-key-rate-5 = оцінка елемента: 5, відмінно
desk-key-rate-unobserved = елемента не було видно
desk-key-cite = послатися на закладку
desk-key-lesson = показати заняття місця або всі заняття
desk-key-next-step = почати крок заняття
desk-key-step-back = повернутися до попереднього кроку заняття
desk-key-watch = стежити за екраном місця
desk-key-remark = написати зауваження
desk-key-pan-left = посунути вид екрана ліворуч
desk-key-pan-right = посунути вид екрана праворуч
desk-key-tile-left = вибрати плитку ліворуч
desk-key-tile-right = вибрати плитку праворуч
desk-key-older = показати старіший політ курсанта
desk-key-newer = показати новіший політ курсанта
desk-key-unmark = показати події місця; зняти всі позначки
desk-key-board = назад до таблиці
desk-key-quit = закрити пульт
