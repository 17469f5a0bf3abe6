# Завдання з власними дронами: чому флот не може його виконувати і що потрібно від дрона.
fleet-many = завдання має { $seats ->
    [one] { $seats } місце
    [few] { $seats } місця
   *[many] { $seats } місць
} для { $kind ->
    [drone] дронів
    [robot] наземних роботів
   *[boat] човнів
}, а названо проєктів: { $designs }; приберіть зайві
fleet-kind = { $design } — це { $kind }, а завдання має місця лише для таких видів апаратів: { $kinds }. Назвіть інший проєкт
fleet-fault = { $design }: { $fault }
fleet-dear = флот коштує { $cost } cr, на { $over } cr більше за бюджет завдання ({ $budget } cr): візьміть дешевші деталі
fleet-misfit = { $design } не впорається із завданням { $count ->
    [1] апарата
   *[many] апаратів
} { $vehicles }: { $what }: { $has }, потрібно { $required }

need-radius = радіус дії за вітру { $wind } m/s
need-time = час у повітрі, посадка з { $reserve } %
need-thrust = відношення тяги до ваги за вітру { $wind } m/s
need-link = дальність радіо на висоті { $height } m
need-cost = вартість дрона, cr
need-vehicle-cost = вартість апарата, cr
need-kind = вид апарата
need-drive-radius = радіус дії
need-drive-time = час ходу, повернення з { $reserve } %
need-ground-link = дальність радіо на землі чи воді
need-none = немає
workshop-fit-seats = місця { $seats }: є / потрібно
