# Плани занять: помилки у файлах і те, що показує пульт

# Помилки
lesson-schema = невідома схема { $found }: ця версія читає схему { $known }
lesson-english-only = лише англійською: додайте поруч із кожним англійським текстом український, наприклад `title_uk` поруч із `title`
lesson-text-empty = текст порожній
lesson-steps = кроків: { $count }; у занятті щонайменше один і щонайбільше { $most }
lesson-id = `{ $name }` не годиться як назва кроку: потрібні літери, цифри, `-` і `_`, не більше ніж { $most }, і не `end`
lesson-id-twice = один із попередніх кроків теж зветься `{ $name }`
lesson-no-step = немає кроку `{ $name }`
lesson-known-steps = є такі кроки: { $known }
lesson-no-flight = жодне завдання ще не виконують, тож чекати нема на що
lesson-no-flight-help = додайте `fly ЗАВДАННЯ` до попереднього кроку або чекайте на інструктора: `when = "manual"`
lesson-condition-long = умова в занятті має щонайбільше { $most } знаків
lesson-when = `{ $word }` — це не `manual`, не `started`, не `over`, не `passed` і не умова
lesson-limit = `within` — від 1 до { $most } секунд, а не { $found }
lesson-limit-at-once = крок, що починається одразу, не потребує обмеження часу: додайте `when` або приберіть `within` і `otherwise`
lesson-within-alone = `within` потребує `otherwise`: назви кроку, який настане після цього часу, або `end`
lesson-otherwise-alone = `otherwise` потребує `within`: через скільки секунд він настане
lesson-message-alone = `message_uk` потребує `message`
lesson-message-long = повідомлення має щонайбільше { $most } знаків
lesson-order-none = це не вказівка місцю: є `message`, `hint`, `mark`, `freeze`, `resume`, `inject`, `disarm`, `fly`, `start` і `end`
lesson-order-seat = вказівку заняття отримують місця цього заняття: приберіть назву після `@`
lesson-exam = на іспиті це заборонено: дозволені лише `message`, `start` і `end`
lesson-exam-help = останнє `fly` перед цим має `exam`
lesson-no-mission = немає завдання `{ $name }`; є такі: { $known }
lesson-inject-no-flight = жодне завдання ще не виконують: додайте перед подією `fly ЗАВДАННЯ`
lesson-inject = завдання { $mission } не дозволяє події `{ $name }`; воно дозволяє: { $known }
lesson-inject-none = завдання { $mission } не дозволяє подій
lesson-unreached = до кроку `{ $name }` ніщо не веде: назвіть його в `then` чи `otherwise` іншого кроку або приберіть
lesson-endless = від кроку `{ $name }` ніщо не веде до кінця заняття: додайте `then = "end"` до одного з наступних кроків
lesson-circle = кроки ходять по колу від `{ $name }` до `{ $name }` і ні на що не чекають: додайте до одного з них `when`

# Пульт
class-lesson-begun = розпочато «{ $lesson }»: { $seats }
class-lesson-next = наступний крок заняття: { $seats }
class-lesson-skip = крок пропущено: { $seats }
class-lesson-back = на крок назад: { $seats }
class-lesson-stop = заняття закінчено: { $seats }
class-lesson-none = { $seats }: заняття не йде; розпочніть його командою `class lesson НАЗВА`
class-lesson-not-waiting = { $seats }: крок виконується, або заняття вже закінчилося
class-lesson-first = { $seats }: це перший крок
class-lesson-unread = заняття { $lesson } не вдалося прочитати: { $fault }
class-lesson-resumed = «{ $lesson }» триває з тих кроків, на яких є місця
class-lessons-title = заняття: розпочати можна командою `class lesson НАЗВА`
class-lesson-named = { $name }: { $title }. { $about }
class-lesson-faulty = { $name } має помилки, тож розпочати його не можна: їх покаже `sortie check { $file }`
class-lesson-has-faults = має помилки
class-lessons-none = занять немає
class-lessons-reading = Заняття читаються.
class-lesson-title = { $seat }: { $lesson }, крок { $number } із { $count }: { $step }
class-lesson-wait-seat = чекає на відповідь місця
class-lesson-wait-manual = чекає на вас: { $key } — далі
class-lesson-wait-back = ви повернулися до цього кроку: { $key } починає його
class-lesson-wait-not-flown = завдання на місці не розпочато: { $key } — ще раз і далі
class-lesson-wait-refused = місце не може стежити за умовою: { $key } — далі
class-lesson-wait-circles = заняття ходить по колу: { $key } — далі
class-lesson-wait-condition = чекає на: { $when }
class-lesson-wait-others = чекає на інші місця
class-lesson-wait-limit = { $wait }; якщо не дочекається за { $time }: { $step }
class-lesson-wait-ended = заняття закінчено
class-lesson-end = кінець
class-lesson-does = робить: { $deeds }
class-lesson-then = далі: { $step }
class-column-lesson = заняття
class-key-lesson = заняття
class-key-next-step = наступний крок
class-key-step-back = крок назад
argument-lesson = назва заняття або його файл
argument-exam = як іспит
lessons-title = Заняття, для `class lesson НАЗВА` на пульті:
