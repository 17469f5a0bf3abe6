# Розбір польоту, завширшки 80 колонок.

debrief-head = РОЗБІР  { $mission } r{ $revision }   { $title }   { $outcome }
debrief-score = Бали { $score } / 1000   оцінка { $grade }   { $medal }   зерно { $seed }   { $backend }
debrief-no-medal = без медалі
debrief-embedded = симулятор
debrief-time = Час { $used } (норма { $par }, межа { $limit })   Енергія { $energy }   Дрони { $count }
debrief-energy = { $used } Wh (норма { $par })
debrief-energy-unknown = невідома

# Заголовки стоять над колонками: щонайбільше 36 для цілей, 13 для результату, 11 для вимоги,
# 12 для складових, 6 для ваги та значення, 8 для балів.
debrief-objectives = ЦІЛІ
debrief-result = результат
debrief-target = треба
debrief-points = бали
debrief-components = СКЛАДОВІ
debrief-weight = вага
debrief-value = знач.
debrief-moved = що вплинуло
# Щонайбільше 8 колонок.
debrief-sum = разом
debrief-gold-needs = для золота треба: { $gates }

debrief-timeline = ПЕРЕБІГ   (> команда  o ціль  ! увага  x порушення  r відмова)
debrief-drone = дрон { $vehicle }: { $what }
debrief-vehicle = апарат { $vehicle }: { $what }

debrief-improve = ЩО ПОКРАЩИТИ   (спершу те, що дає найбільше)
debrief-nothing = Немає нічого, що дало б ще бал.
# Щонайбільше 5 колонок.
debrief-good = добре

debrief-last-mission = після цього завдань немає
