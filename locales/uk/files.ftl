# Файли, яких немає змоги прочитати чи записати.

file-more-faults = { $count ->
    [one] і ще { $count } помилка
    [few] і ще { $count } помилки
   *[many] і ще { $count } помилок
}
file-unreadable = не вдається прочитати { $path }: { $error }
file-unwritable = не вдається записати { $path }: { $error }
file-exists = { $path } вже є
file-too-large = { $path } завеликий: { $kind } має не більше ніж { $most } байтів
file-unknown = невідомо: { $kind } `{ $name }`; вкажіть шлях або одне з: { $known }

file-mission = завдання
file-pilot = скрипт пілота
file-design = проєкт
file-parameters = файл параметрів
file-frame = файл рами
file-theme = тема
file-keymap = розкладка клавіш
file-configuration = файл налаштувань
file-any = завдання, тема, розкладка клавіш, налаштування чи скрипт

record-none = це не запис польоту: консоль записує кожен політ, `sortie run --record DIR` — теж
record-version = це запис польоту у форматі версії { $version }; ця програма читає версію { $known }: скористайтеся тією, що його записала
record-head = перший рядок пошкоджено: { $error }
record-damaged = рядок { $line } пошкоджено: політ оцінено до цього місця
record-no-end = запис обривається до кінця польоту: політ оцінено до цього місця
record-mission = програма не може прочитати завдання з запису: { $fault }
record-unwritable = Запис зупинено; політ триває: { $fault }
record-differs = Під час польоту було { $before } балів; тепер програма дає { $now }.
record-no-runs = у теці { $folder } немає записів польотів; виконайте завдання через `sortie fly` або вкажіть запис
journal-none = це не журнал польоту: перший рядок іншого виду
record-not-begun = цей політ не записується, його не можна буде переглянути: { $fault }
record-broken-off = запис цього польоту закінчується тут: { $fault }
record-full = запис цього польоту закінчується тут: він сягнув { $mib } MiB (налаштування `records.space` дає вдвічі більше на всі записи)
journal-damaged = рядок { $line } журналу пошкоджено: команди й закладки відомі до цього місця
record-frames-dropped = диск заповільний для цього польоту: у записі бракує кадрів
