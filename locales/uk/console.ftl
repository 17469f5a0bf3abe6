# Що каже сама консоль.

ask-quit = ВИЙТИ
ask-leave = ЗАВЕРШИТИ сеанс
ask-start = ПОЧАТИ інший сеанс
ask-restart = ПОЧАТИ завдання СПОЧАТКУ
ask-abandon = ПРИПИНИТИ завдання
ask-abandon-reason = у розборі буде враховано досягнуте досі
ask-mission-lost = завдання не завершено, його не буде зараховано
ask-armed = { $count ->
    [one] { $count } апарат із запущеними двигунами
    [few] { $count } апарати із запущеними двигунами
   *[many] { $count } апаратів із запущеними двигунами
}
ask-type = введіть
ask-cancelled = скасовано, нічого не зроблено: { $question }

select-missing = немає апарата { $vehicles }
select-missing-all = немає апарата { $vehicles }: вибір не змінено

palette-title = команда
palette-grammar = [цілі] дієслово [аргументи]: Tab доповнює, стрілка вгору повертає давніші рядки
palette-to = для { $vehicles }
palette-to-cursor = для { $vehicles } (під курсором)
palette-to-selected = для { $vehicles } (вибрані)
palette-sends = Enter надсилає для { $vehicles }
palette-asks = Enter перепитує, перш ніж надіслати для { $vehicles }

prompt-connect = під'єднатися до


help-commands = команди: [цілі] дієслово [аргументи]
help-console = сама консоль

session-free = вільний політ

mission-none = зараз немає завдання
debrief-none = Розбору ще немає: він відкриється після завдання.
