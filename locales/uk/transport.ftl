# Канали зв'язку: їхній стан, що з ними не так і що не так з їхніми адресами.

transport-connecting = з'єднується
transport-up = працює
transport-waiting = не працює, наступна спроба через { $seconds } s
transport-ended = завершено
transport-is-up = канал { $link } працює
transport-is-down = канал { $link }: { $reason }
transport-has-ended = канал { $link } завершив роботу

transport-refused = у з'єднанні відмовлено: жодна програма не слухає порт { $port } вузла { $host }
transport-unreachable = не вдається з'єднатися з портом { $port } вузла { $host }: { $error }
transport-no-answer = { $host } не відповів за { $seconds } s
transport-not-found = { $host } не знайдено: { $error }
transport-without-address = { $host } не має адреси
transport-no-udp-socket = не вдається відкрити сокет UDP: { $error }
transport-udp-failed = збій сокета UDP: { $error }
transport-cannot-send = не вдається надіслати до { $address }: { $error }
transport-port-in-use = порт { $port } на { $host } зайнято: завершіть програму, що його використовує, або виберіть інший порт
transport-not-here = { $host } не є адресою цієї машини: слухайте на 127.0.0.1 або 0.0.0.0
transport-cannot-listen = не вдається слухати на порту { $port } вузла { $host }: { $error }
transport-no-clients = не вдається приймати клієнтів: { $error }
transport-no-serial = не вдається відкрити { $path } на швидкості { $baud }: { $error }
transport-without-serial = не вдається відкрити { $path }: програму зібрано без послідовних портів; зберіть її з `--features serial`
transport-closed = закрито з іншого боку
transport-takes-nothing = інший кінець більше не приймає даних
transport-silent = нічого не надходить уже { $seconds } s
transport-pipe-gone = іншого кінця каналу вже немає: { $reason }
transport-fleet-busy = запити зараз не приймаються: сеанс завершується або перевантажений

transport-no-file = не вдається відкрити { $path }: { $error }
transport-damage = { $count ->
    [1] запис пошкоджено на байті { $byte }, пропущено байтів: { $bytes }
   *[other] запис пошкоджено, місць: { $count }, перше на байті { $byte }, пропущено байтів: { $bytes }
}
transport-faults = { $first }; і { $second }
transport-no-tlog = { $faults }; жодного повідомлення в ньому не знайдено: чи це tlog?
transport-tlog-cut-off = запис обірвано: останнє повідомлення, на байті { $byte }, неповне; усі попередні справні
transport-tlog-damaged = запис пошкоджено: на байті { $byte } немає кадру MAVLink (знайдено { $found } там, де має бути 0xFD або 0xFE); чи це tlog?
transport-tlog-unreadable = запис не читається на байті { $byte }: { $error }

transport-no-address = «{ $address }» не є адресою каналу: { $problem }; пишіть tcp:HOST:PORT (з'єднатися), tcpin:HOST:PORT (слухати), udp:HOST:PORT (надсилати), udpin:HOST:PORT (слухати), udpbcast:HOST:PORT, serial:PATH:BAUD або file:FILE.tlog
transport-address-empty = адреса порожня
transport-file-missing = бракує файлу
transport-no-kind = невідомий вид каналу: «{ $kind }»
transport-no-kind-no-port = у ній немає ні виду каналу, ні порту
transport-port-zero = порт 0 недосяжний
transport-port-missing = бракує порту
transport-no-port = «{ $port }» не є портом (від 0 до 65535)
transport-no-bracket = «{ $host }» не має закривної дужки
transport-brackets = адреса IPv6 має бути в дужках: { $address }
transport-serial-missing = бракує шляху до послідовного порту
transport-baud-missing = після двокрапки бракує швидкості
transport-no-baud = швидкість «{ $baud }» не є додатним числом на зразок 57600 чи 115200
