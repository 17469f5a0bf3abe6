# Файли, яких немає змоги прочитати чи записати.

file-unreadable = не вдається прочитати { $path }: { $error }
file-unwritable = не вдається записати { $path }: { $error }
file-exists = { $path } вже є
file-too-large = { $path } завеликий: { $kind } має не більше ніж { $most } байтів
file-unknown = не знайдено: { $kind } `{ $name }`. Вкажіть шлях або одне з: { $known }

file-mission = завдання
file-pilot = скрипт пілота
file-parameters = файл параметрів
file-frame = файл рами
file-theme = тема
file-keymap = розкладка клавіш
file-configuration = файл налаштувань
file-any = завдання, тема, розкладка клавіш, налаштування чи скрипт
