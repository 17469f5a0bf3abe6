# Карта.

map-title = карта
map-all = видно все
map-task-in-view = видно завдання й апарати
map-vehicles-in-view = видно апарати
map-follows = стежить за { $vehicle }
map-outside = { $count ->
    [one] { $count } апарат поза картою
    [few] { $count } апарати поза картою
   *[many] { $count } апаратів поза картою
}
map-nowhere = Жодна позиція ще не відома.
map-objective = далі: { $title } ({ $detail })
map-from-home = від дому
map-from-vehicle = від
map-ruler = лінійка
map-no-vehicle = під курсором немає апарата з відомою позицією
map-no-samples = показів датчиків ще немає
map-shows-sensor = покази датчика: { $sensor }

map-legend = позначки
map-legend-armed = двигуни активні, курс
map-legend-disarmed = двигуни неактивні
map-legend-lost = зв'язок втрачено
map-legend-cursor = апарат під курсором
map-legend-hidden = і ще 2 на його місці
map-legend-selected = вибрано
map-legend-alert = попередження
map-legend-critical = тривога або аварія
map-legend-several = кілька в одному місці
map-legend-home = дім
map-legend-pointer = курсор карти
map-legend-place = названа точка
map-legend-next = наступна точка
map-legend-trail = пройдений шлях
map-legend-target = до цілі (x)
map-legend-ghost = інший політ (g1)
map-legend-task = ділянка завдання
map-legend-fence = геозона
map-legend-keep-out = геозона: не входити
map-legend-plan = план, точка w3
map-legend-leg = до пункту 3 з 12 (w3/12)
map-legend-paused = план на паузі
map-legend-rally = точка збору (R1)
map-legend-course = маневр, місце (p3)
map-legend-meeting = надто близько (!1/2)
map-legend-ruler = лінійка

action-left = перейти ліворуч
action-right = перейти праворуч
action-zoom-in = збільшити масштаб
action-zoom-out = зменшити масштаб
action-fit = показати все
action-follow = стежити за апаратом під курсором або перестати
action-centre = центрувати карту на курсорі
action-ruler = міряти звідси або перестати
action-goto-here = написати `goto` з місцем під курсором
action-trails = показати або сховати пройдені шляхи
action-legend = показати або сховати пояснення позначок
action-next-sensor = перейти до показів наступного датчика
# Пояснення позначок: щонайбільше 24 колонки.
map-legend-harmless = контакт, безпечний
map-legend-seen = контакт, один датчик
map-legend-confirmed = контакт, два датчики
map-legend-reported = повідомлено
map-legend-no-fly = заборонена зона (x)
map-legend-jamming = зона завад (~)
map-legend-people = унизу люди (&)
map-legend-radio = слабкий зв'язок (%)
map-legend-wire = провід ЛЕП, опори (T)
map-legend-movers = людина, чужий дрон
map-legend-traffic = повітряні судна, курс
map-legend-swept = обстежено або виміряно
map-legend-fire = пожежа: згарище, вогонь
map-fire = пожежа
map-fire-scorched = частково вигоріло
map-fire-burnt = вигоріло
map-fire-flames = вогонь, один датчик
map-fire-sure = вогонь, підтверджено
