# Консоль без екрана.

plain-greeting = консоль без екрана: одна команда на рядок, `help` перелічує команди, `quit` — вихід
plain-asks = { $question }: { $reason }; щоб виконати, введіть { $answer } і натисніть Enter; усе інше скасовує
plain-unconfirmed = не підтверджено й не виконано: у вхідних рядках наступним має бути { $answer } або `no`
plain-wait-in-vain = час очікування минув: { $line }
plain-no-room = для цього потрібна консоль з екраном
plain-critical = КРИТИЧНО
plain-error = ПОМИЛКА
plain-warning = попередження
plain-times = { $count ->
    [one] ({ $count } раз)
    [few] ({ $count } рази)
   *[other] ({ $count } разів)
}
plain-hint = підказка: { $hint }
plain-objective-open = цілі ще не досягнуто: { $objective }
plain-objective-met = досягнуто цілі: { $objective }
plain-objective-missed = цілі не досягнуто: { $objective }
plain-score = бали поки що: { $score } з 1000
plain-time-left = лишилося часу: { $seconds } s
plain-vehicle = апарат { $vehicle }: { $state }
plain-armed = двигуни активовано
plain-disarmed = двигуни деактивовано
plain-flight = висота { $height } m, швидкість { $speed } m/s
plain-home = { $distance } m від дому
plain-battery = акумулятор { $percent } %
plain-way-home = на повернення треба { $needed } %
plain-link = канал { $number }, { $name }: { $state }, повідомлень за секунду: прийнято { $received }, надіслано { $sent }; усього втрачено { $lost }
plain-forward = пересилання { $name }: { $state }, станцій { $stations }, прийнято повідомлень { $received } ({ $bytes_in } B), надіслано { $sent } ({ $bytes_out } B), відкинуто { $dropped }, відфільтровано { $filtered }, затримано { $held }, повторів { $repeated }
plain-before-launch = до зльоту: `1 predict 800` називає бали, яких ви чекаєте, `1 goal time 200s` ставить мету
plain-in-flight = у польоті діють { $lines }
plain-asked = ціль: { $title }, { $target }, балів { $points }
plain-asked-required = обов'язкова ціль: { $title }, { $target }, балів { $points }
plain-limits = щонайбільше { $seconds } s, норма { $par } s; золото від { $gold }, срібло від { $silver }, бронза від { $bronze }
plain-contact = контакт { $name }, { $kind }, місце { $place }: { $trust }
plain-garbled = цей рядок не є UTF-8, його пропущено: { $line }
