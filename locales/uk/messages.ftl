# Екран «повідомлення»: інспектор.


messages-fields = поля
messages-hint = Виберіть повідомлення в дереві. { $open } розгортає гілку, { $fields } переходить до полів, { $graph } малює графік поля, { $bytes } показує байти, { $send } переносить останній кадр у командний рядок, щоб змінити й надіслати, { $filter } фільтрує, { $sort } упорядковує, { $pause } ставить на паузу, { $fold } згортає чи розгортає всі системи.
messages-none = жодним каналом ще нічого не надійшло
messages-none-found = жодне повідомлення не відповідає фільтру
messages-paused = ПАУЗА
messages-by-number = повідомлення за номером
messages-by-name = повідомлення за назвою
messages-by-rate = повідомлення за частотою
messages-by-age = повідомлення за віком
messages-count = разом
messages-age = вік
messages-system = система { $system }
messages-component = компонент { $component }
messages-received = прийнято
messages-sent = надіслано
messages-to = { $system } до { $peer }
messages-signed = з підписом
messages-unsigned = без підпису
messages-figures = { $hz } Hz  { $bytes } B/s  разом { $count }  вік { $age }
messages-dress = v{ $version } { $signed }, { $length } B, № { $sequence }, { $way }
messages-unknown = невідомо ({ $value })
messages-more = ще { $count }
messages-unknown-id = Такого номера немає в жодному діалекті, відомому sortie; контрольну суму перевірити не можна.
messages-other-layout = Контрольна сума не збігається з будовою повідомлення, відомою sortie: будова інша, або кадр пошкоджено.
messages-extent = зараз { $now }  { $seconds } s: від { $low } до { $high }
messages-not-drawn = не намальовано: { $count }
messages-uncounted = кадри інших видів, тут не показані (часто це шум): { $count }
messages-choose-field = спершу виберіть поле: { $key } переходить до полів
messages-choose-message = спершу виберіть повідомлення
messages-not-sendable = { $message } не можна надіслати знову: його поля невідомі, або в ньому є ключ чи пароль
messages-no-number = { $field } — текст, графіка немає

messages-key-help = довідка
messages-key-open = розгорнути
messages-key-fields = поля
messages-key-graph = графік
messages-key-bytes = байти
messages-key-send = надіслати знову
messages-key-filter = фільтр
messages-key-sort = порядок
messages-key-pause = пауза
messages-key-fold = згорнути всі
