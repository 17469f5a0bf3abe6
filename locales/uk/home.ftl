# Початковий екран.

home-missions = завдання
home-others = без завдання
home-free = Вільний політ
home-ardupilot = Вільний політ на ArduPilot
home-ardupilot-about = Вільний політ зі справжніми автопілотами ArduPilot (SITL), окремий процес на кожен дрон. Двигуни можна активувати за кілька секунд.
home-connect = Під'єднатися до апаратів
home-quit = Вийти
home-free-about = Дрони симулятора, без завдання: вивчайте команди й пробуйте без ризику.
home-free-first = Перший політ: перед кожним рядком — `{ $key }`
home-free-wait = Дочекайтеся `takeoff виконано`: доти `goto` відхиляється. Потім
home-connect-about = Керуйте справжніми дронами або симулятором деінде: усім, що підтримує MAVLink через TCP, UDP чи послідовний порт.
home-quit-about = Вийти з програми.
home-mission-deed = почати завдання
home-mission-rules = цілі та правила
home-free-deed = почати
home-connect-deed = ввести адресу
home-quit-deed = вийти
home-over = { $session }: завершено; { $key } показує розбір
home-replay = Перегляд: { $session }; { $key } повертає до нього
home-running = { $session }: ще триває; { $key } повертає туди
home-connect-empty = впишіть адресу, наприклад `tcp:127.0.0.1:5760`
home-starting-mission = завдання починається ...
home-starting-simulator = симулятор запускається ...

# Заголовки переліку завдань за складністю.
home-tier-0 = перші кроки
home-tier-1 = по одній навичці
home-tier-2 = кілька навичок
home-tier-3 = усе разом
home-drill = { $title }, { $seconds } s
home-no-drill = до цього завдання немає вправи
home-best = Найкращий результат: балів { $score }, { $medal }.
home-site = місце і норма
home-par = норма
home-limit = межа
home-par-energy = енергія
home-energy = норма { $wh } Wh
home-wind = вітер
home-drones = дрони
home-best-so-far = найкращий
home-best-is = { $score }, { $medal }
home-never-flown = ще не літали
