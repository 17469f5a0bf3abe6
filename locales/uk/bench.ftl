# Кімната майстерні: верстак, проєкти, порівняння, місця флоту.
room-workshop = майстерня
action-workshop = складати дрони
action-other-pane = перейти до іншого списку
action-take-out = вийняти деталь або скасувати вибір
action-buy-part = купити право на деталь
action-undo = скасувати останню зміну
action-redo = повторити скасовану зміну
action-new-design = почати новий проєкт
action-save-design = зберегти проєкт під назвою
action-designs = показати всі проєкти або знову верстак
action-compare-design = порівняти з іншим проєктом
action-copy-design = зберегти копію проєкту
action-rename-design = дати проєкту іншу назву
action-export-design = записати проєкт у файл
action-import-design = прочитати проєкт із файлу
action-next-view = гортати показники, потужність, вантаж, завдання
action-mission-before = складати дрони для попереднього завдання
action-mission-after = складати дрони для наступного завдання
action-seats = показати місця флоту або знову верстак
action-all-seats = вибрати проєкт для всіх місць
action-fly-fleet = виконати завдання цими дронами

bench-hint-lists = списки
bench-hint-put-in = вставити
bench-hint-take-out = вийняти
bench-hint-undo = скасувати
bench-hint-save = зберегти
bench-hint-designs = проєкти
bench-hint-view = вигляд
bench-hint-fleet = флот
bench-hint-buy = купити
bench-hint-compare = порівняти
bench-hint-new = новий
bench-hint-mission = завдання
bench-hint-files = файли
bench-hint-open = відкрити
bench-hint-copy = копіювати
bench-hint-rename = назвати
bench-hint-delete = видалити
bench-hint-other = вибрати інший
bench-hint-assign = вибрати для місця
bench-hint-all = вибрати для всіх
bench-hint-lend = взяти позичені
bench-hint-fly = летіти

bench-not-saved = не збережено
bench-new-name = Новий проєкт
bench-none-yet = ще немає
bench-missing = ще бракує: { $slots }
bench-add-payload = додати ...
bench-locked = закрито
bench-part = { $name }: { $mass } g, { $price } cr за штуку
bench-begins = починає новий апарат ({ $kind }): знімає деталі, що їх приймає лише { $before }
bench-misfit = не підходить: { $reason }
bench-for-sale = ще не ваша: { $key } купує право на деталь за { $price } cr
bench-locked-by = продається після завдання «{ $mission }»
bench-on-board = { $count ->
    [1] на борту
   *[other] на борту { $count }
}
bench-radio = дальність за бюджетом радіолінії: запас на завмирання 20 dB, висота 50 m
bench-ground-radio = дальність за бюджетом радіолінії: запас на завмирання 20 dB, на землі чи воді
bench-part-for-sale = { $part }: деталь ще не ваша, { $key } купує право на неї за { $price } cr
bench-part-locked = { $part }: продається після завдання «{ $mission }»
bench-figures-change = із цією деталлю (▲ краще, ▼ гірше)
bench-payload = час зависання залежно від вантажу
bench-drive-payload = час ходу залежно від вантажу
bench-drive-payload-about = на швидкості { $cruise } m/s; крива закінчується на { $spare } kg, які ще витримає шасі чи корпус
bench-payload-about = крива закінчується там, де тяга становить { $least } ваги; якщо додати ще { $spare } kg, тяга становитиме { $good } ваги
bench-polar-about = найдовший політ — на швидкості { $longest } m/s, найдальший — на { $farthest } m/s
bench-drive-overloaded = на швидкості { $cruise } m/s; на { $over } kg більше, ніж витримає шасі чи корпус
bench-drive-polar-about = крейсерська швидкість { $cruise } m/s, найбільша { $top } m/s
bench-curve-marked = із деталлю під курсором, { $marked }: { $about }
bench-curve-built = як зібрано: { $about }
bench-curve-misfit = як зібрано: { $about }; з деталлю під курсором, { $marked }, кривої немає: { $reason }
bench-no-curve = кривої ще немає: потрібні рама, двигуни, пропелери, регулятори й акумулятор
bench-no-robot-curve = кривої ще немає: потрібні шасі, привід і акумулятор
bench-no-boat-curve = кривої ще немає: потрібні корпус, привід і акумулятор

bench-no-mission = завдання не вибрано
bench-choose-mission = [ і ] вибирають завдання, для якого ви складаєте дрон.
bench-mission-is = дрон для завдання: { $mission }
bench-mission-flown = завдання вже виконується: інше можна вибрати, коли воно скінчиться
bench-seats = { $count ->
    [one] { $count } дрон
    [few] { $count } дрони
   *[many] { $count } дронів
}
bench-seats-mixed = { $count ->
    [one] { $count } апарат
    [few] { $count } апарати
   *[many] { $count } апаратів
}
bench-budget = флот коштує { $cost } з { $budget } cr
bench-no-budget = флот коштує { $cost } cr; обмеження немає
bench-fleet = флот для «{ $mission }»
bench-fleet-none = флот: завдання не вибрано
bench-fleet-about = на верстаку: { $name }
bench-lent = позичено завданням
bench-lent-kind = позичено завданням: { $kind }
bench-seat-taken = місце { $seat }: { $name }
bench-seats-taken = усі місця: { $name }
bench-kind-seats-taken = усі місця для { $kind ->
    [drone] дронів
    [robot] наземних роботів
   *[boat] човнів
}: { $name }
bench-seat-kind = місце { $seat } — для іншого виду апарата: { $taken }; на верстаку { $kind }. Виберіть інше місце або відкрийте інший проєкт
bench-no-seat = завдання не має місця для такого виду апарата: { $kind }. Відкрийте інший проєкт
bench-seats-lent = завдання знову позичає свої апарати
bench-does-not-fly = не полетить: { $reason }
bench-lacks-licence = деталь «{ $part }» ще не ваша: спершу купіть право на неї
bench-over-budget = флот коштує { $cost } cr, бюджет { $budget } cr: візьміть дешевші деталі

bench-designs = проєкти
bench-no-designs = проєктів ще немає
bench-own = ваш
bench-stock = спільний
bench-not-own = це спільний проєкт: скопіюйте його, щоб змінити
bench-comparison = зміни від іншого проєкту до того, що на верстаку (▲ краще, ▼ гірше)
bench-compared = проєкт
bench-differs = інакше
bench-choose-compared = виберіть проєкт і натисніть { $key }, щоб порівняти

bench-no-more = додати не можна: деталь уже на борту, або місце заповнено
bench-not-on-board = цієї деталі немає на борту
bench-nothing-to-undo = нема чого скасовувати
bench-nothing-to-redo = нема чого повторювати
bench-guests-buy-nothing = гість може використовувати кожну деталь без купівлі
bench-no-profile = проєкти зберігаються у профілі, а його не вибрано: { $key } записує проєкт у файл
bench-saved = збережено: { $name }
bench-name-taken = проєкт { $name } уже є: виберіть іншу назву
bench-ask-buy = КУПИТИ право на деталь «{ $part }» за { $price } cr
bench-ask-buy-reason = у вас { $credits } cr, лишиться { $left } cr
bench-ask-replace = ЗАМІНИТИ на верстаку проєкт { $name }
bench-ask-replace-reason = зміни не збережено ({ $key } повертає їх)
bench-ask-overwrite = ЗАМІНИТИ ваш проєкт { $name }
bench-ask-overwrite-reason = проєкт із такою назвою вже є
bench-ask-delete = ВИДАЛИТИ ваш проєкт { $name }
bench-ask-delete-reason = копія на верстаку лишається
bench-ask-quit-reason = { $name } на верстаку не збережено

prompt-save-design = зберегти проєкт як
prompt-copy-design = зберегти копію { $name } як
prompt-rename-design = нова назва для { $name }
prompt-export-design = записати проєкт у файл
prompt-import-design = прочитати проєкт із файлу
prompt-design-advice = будь-яка назва; вона з'явиться у списку проєктів
prompt-import-advice = шлях до файлу проєкту (TOML); `~/` — домашня тека
