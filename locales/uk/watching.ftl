# Спостереження за місцями і те, що пульт показує класу

# Клавіші в останньому рядку
class-key-tiles = плитки
class-key-replay = відтворити
class-key-unmark = зняти позначки
class-key-other-flight = політ
class-key-back = назад
class-key-state = стан
class-key-injects = події
class-key-select = вибрати
class-key-look-away = закрити
argument-beside = курсант, чий політ показати поруч

# За екраном місця
class-flight-title = стан: { $seat }
class-flight-waits = очікується стан польоту
class-flight-figures = { $clock }  бали { $score }  цілі { $met }/{ $objectives }  у повітрі { $airborne }/{ $vehicles }
class-flight-figures-short = { $clock }  бали { $score }  { $met }/{ $objectives }  злет. { $airborne }/{ $vehicles }
class-flight-alert = ! { $alert }
class-flight-open = ○ { $title }  { $detail }
class-flight-met = ✓ { $title }  { $detail }
class-flight-missed = ✗ { $title }  { $detail }
class-flight-more = { $count ->
        [one] ще { $count } ціль
        [few] ще { $count } цілі
       *[many] ще { $count } цілей
    }
class-flight-vehicle = { $vehicle } { $mode } { $height } m { $battery } %
class-flight-elsewhere = на екрані за { $metres } m звідси
class-alert-of = апарат { $vehicle }: { $cause }

# Розбір з усім класом
class-replay-title = бали { $score }  { $trainee }
class-replay-reading = Польоти зчитуються.
class-replay-none-beside = { $user } не має іншого зданого польоту завдання { $mission }
class-replay-before = цей політ ще не почався
class-replay-over = цей політ уже завершено
class-replay-figures = { $clock }  висота { $height } m  батарея { $battery } %
class-replay-met = ✓ { $title }
class-replay-open = ○ { $title }
class-replay-bookmark = ◆ { $clock }  { $text }
class-deed-look-on = показ відтворення
class-show-nothing = нічого не відтворюється: спершу відкрийте політ командою `class replay`
class-show-exam = триває іспит: до його кінця класові нічого не показують
class-show-none = класові нічого не показують
class-show-stopped = клас більше не бачить відтворення
class-show-over = клас більше не бачить відтворення: воно завершене або триває іспит
class-shown-title = { $instructor } показує
class-shown-over = пульт більше не показує відтворення
class-shown-closed = відтворення тут закрито; пульт і далі показує його класу
