# Параметри: екран, файли та вади значень.

action-changed-parameters = показати лише змінені або лише з файлу
action-save-parameters = зберегти параметри у файл
action-load-parameters = завантажити файл і показати відмінності
action-compare-parameters = порівняти з файлом або іншим апаратом
action-apply-parameters = встановити позначені параметри
action-fetch-parameters = запитати в апарата всі параметри ще раз
action-read-documents = прочитати з апарата опис його параметрів

parameters-not-finite = не надіслано: { $name } приймає лише скінченні числа
parameters-not-whole = не надіслано: { $name } приймає лише цілі числа ({ $kind })
parameters-out-of-range = не надіслано: { $name } приймає лише від { $least } до { $greatest } ({ $kind })
parameters-inexact = не надіслано: { $name } не може набути точно такого значення; MAVLink передав би { $nearest }
parameters-no-number = `{ $value }` — не число

parameters-file-twice = { $name } уже має значення { $value } у рядку { $line }
parameters-file-no-value = { $name } не має значення
parameters-file-more = зайвий текст після значення
parameters-file-name = `{ $name }` — не параметр: назва має від 1 до 16 літер, цифр і `_`
parameters-file-too-large = { $value } — завелике число для апарата
parameters-file-help = пишіть `НАЗВА,ЗНАЧЕННЯ` в рядку, а коментарі — після `#`
parameters-file-faulty = { $path }:{ $line }:{ $column }: { $fault } { $count ->
    [1] (нічого не завантажено)
    [one] (усього { $count } помилка; нічого не завантажено)
    [few] (усього { $count } помилки; нічого не завантажено)
   *[many] (усього { $count } помилок; нічого не завантажено)
}

parameters-title = апарат { $vehicle }
parameters-title-compared = апарат { $vehicle } порівняно з: { $other }
parameters-of-vehicle = апарат { $vehicle }
parameters-on = { $count ->
    [1] апарат { $vehicles }
   *[other] апарати { $vehicles }
}
parameters-no-vehicle = Апаратів ще немає: тут з'являться параметри тих, що вийдуть на зв'язок.
parameters-asking = запит параметрів в апарата ...
parameters-recorded = до цього моменту записано { $received } з { $count }
parameters-coming = { $received } з { $count }
parameters-repeating = { $received } з { $count }; відповіді немає, запит повторено ({ $tries })
parameters-link-lost = { $received } з { $count }; зв'язок втрачено: після відновлення читання продовжиться
parameters-stalled = отримано { $received } з { $count }, далі відповіді немає: { $key } запитує ще раз
parameters-complete = { $count ->
    [one] { $count } параметр
    [few] { $count } параметри
   *[many] { $count } параметрів
}
parameters-marked = відмінностей: { $count }, позначено: { $marked }
parameters-hidden = лише на цьому апараті: { $count } (o)
parameters-filter = /{ $filter }: { $count }
parameters-only-changed = лише змінені
parameters-other-than-default = лише не типові
parameters-setting = встановлення: лишилося { $count }
parameters-sets-on = кому: { $vehicles }
parameters-none-yet = ще нічого не надійшло
parameters-none-fit = жоден параметр не відповідає фільтру: { $key } показує всі
parameters-none-differ-yet = поки що відмінностей немає
parameters-none-differ = відмінностей немає: { $key } показує всі параметри
parameters-none-changed = нічого не змінено: { $key } показує всі
parameters-all-default = усі параметри мають типові значення: { $key } показує всі

parameters-column-name = НАЗВА
parameters-column-value = ЗНАЧЕННЯ
parameters-column-type = ТИП
parameters-column-before = БУЛО
parameters-column-other = ІНШЕ
parameters-column-state = СТАН

parameters-asked = { $value } { $state }
parameters-state-waiting = чекає
parameters-state-sent = надіслано
parameters-state-confirmed = підтверджено
parameters-state-refused = відхилено
parameters-state-unanswered = без відповіді
parameters-state-replaced = замінено
parameters-differs = відрізняється
parameters-own = свій у кожного апарата
parameters-missing = немає на цьому апараті
parameters-extra = лише на цьому апараті
parameters-changed = змінено
parameters-default = типове { $value }
parameters-before = було { $value }

parameters-set-done = { $failed ->
    [0] параметри встановлено: підтверджено { $confirmed }
   *[other] параметри: підтверджено { $confirmed }, не встановлено { $failed }; причини — у списку
}
parameters-stopped = зупинено: не встановлено { $count }
parameters-nothing-compared = нема чого встановлювати: спершу завантажте файл (l) або порівняйте (d)
parameters-nothing-marked = жоден позначений параметр встановити не можна
parameters-ask-apply = ВСТАНОВИТИ { $count ->
    [one] { $count } параметр
    [few] { $count } параметри
   *[many] { $count } параметрів
} (кому: { $vehicles })
parameters-ask-apply-reason = кожен надсилається окремою командою; результати видно у списку
parameters-nothing-to-save = параметри ще не надійшли
parameters-not-complete = апарат { $vehicle } надіслав { $received } з { $count } параметрів: дочекайтеся решти
parameters-no-path = впишіть назву файлу
parameters-same-vehicle = апарат { $vehicle } уже показано: назвіть інший
parameters-no-such-vehicle = апарата { $vehicle } немає
parameters-saved = збережено у { $path }
parameters-ask-replace = ЗАМІНИТИ { $path }
parameters-ask-replace-reason = файл із такою назвою вже є

prompt-filter-advice = мають збігатися всі слова; { $submit } або { $escape } повертає до списку
prompt-parameter = { $name }, кому: { $vehicles }
prompt-parameter-advice = { $submit } встановлює, { $escape } лишає без змін
prompt-save-parameters = зберегти параметри у файл
prompt-save-advice = шлях (`~/` — домашня тека); перед заміною файлу sortie запитає
prompt-load-parameters = завантажити параметри з файлу
prompt-load-advice = перш ніж щось установити, ви побачите відмінності
prompt-compare-parameters = порівняти з
prompt-compare-advice = файл або номер іншого апарата

parameters-hint-set = встановити
parameters-hint-search = шукати
parameters-hint-changed = змінені
parameters-hint-save = зберегти
parameters-hint-load = завантажити
parameters-hint-compare = порівняти
parameters-hint-vehicle = апарат
parameters-hint-help = довідка
parameters-hint-mark = позначити
parameters-hint-mark-all = усі, решту
parameters-hint-extra = лише тут
parameters-hint-apply = встановити позначене
parameters-hint-close = назад

documentation-unknown = це не файл з описом параметрів
documentation-unknown-help = читаються `apm.pdef.xml` і `apm.pdef.json` від ArduPilot та `parameters.json` від PX4
documentation-nothing = у файлі не описано жодного параметра
documentation-cut-off = файл обірвано: не всі елементи закрито
documentation-xml = помилка в XML: { $fault }
documentation-json = помилка в JSON: { $fault }
documentation-no-range = `{ $written }` не є діапазоном: потрібні нижня й верхня межі
documentation-no-bit = `{ $written }` не є номером біта (від 0 до 31)
documentation-range = від { $least } до { $most }
documentation-least = щонайменше { $least }
documentation-most = щонайбільше { $most }
documentation-step = крок { $step }
documentation-reboot = діє після перезавантаження
documentation-values = значення: { $values }
documentation-bits = біти: { $bits }
documentation-outside = { $name } = { $value } поза описаним діапазоном: { $range }
documentation-not-listed = { $name } = { $value }: такого значення в описі немає
documentation-unknown-bits = { $name } = { $value } має біти, яких в описі немає
documentation-still = { $doubt }; { $submit } все одно встановлює значення
parameters-column-meaning = ОДИНИЦЯ, ЗМІСТ

# Що апарат описує сам про себе (`param docs`).
metadata-parameters = { $count ->
    [one] описано { $count } параметр
    [few] описано { $count } параметри
   *[many] описано { $count } параметрів
}
metadata-events = { $count ->
    [one] текст { $count } події
   *[other] тексти { $count } подій
}
metadata-no-parameters = опису параметрів немає: { $fault }
metadata-no-events = текстів подій немає: { $fault }
metadata-elsewhere = файл не на автопілоті; отримайте { $address } і вкажіть через --parameter-docs або --event-docs
metadata-nothing = у ньому немає файлів про параметри чи події
metadata-damaged = стиснений файл пошкоджено ({ $fault })
metadata-too-large = файл більший за { $most } MB
metadata-not-text = файл не є текстом
events-version = версія формату { $version }; прочитати можна версію 2
events-nothing = у файлі немає жодної події
events-fault = подія { $event }: { $fault }
events-no-number = { $written } не є номером події
outcome-metadata-none = апарат не має власного опису (COMPONENT_METADATA); файл можна вказати через --parameter-docs
refused-metadata-busy = опис апарата вже читається
