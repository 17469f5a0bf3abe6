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

record-none = це не запис польоту
record-version = це запис польоту версії { $version }; програма читає версію { $known }
record-head = перший рядок пошкоджено: { $error }
record-damaged = рядок { $line } пошкоджено: політ оцінено до цього місця
record-no-end = запис не має кінця: політ оцінено доти, доки він сягає
record-mission = програма не може прочитати завдання з запису: { $fault }
record-unwritable = Політ більше не записується: { $error }
record-differs = Під час польоту було { $before } балів; тепер програма дає { $now }.
record-no-runs = у теці { $folder } немає записів польотів
