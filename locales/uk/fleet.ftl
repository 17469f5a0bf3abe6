# Завдання з власними дронами: чому флот не може його виконувати і що потрібно від дрона.
fleet-many = завдання має { $seats ->
    [one] { $seats } місце
    [few] { $seats } місця
   *[many] { $seats } місць
}, а названо проєктів: { $designs }; приберіть зайві
fleet-fault = { $design }: { $fault }
fleet-dear = флот коштує { $cost } cr, на { $over } cr більше за бюджет завдання ({ $budget } cr): візьміть дешевші деталі

need-radius = радіус дії за вітру { $wind } m/s
need-time = час у повітрі, посадка з { $reserve } %
need-thrust = відношення тяги до ваги за вітру { $wind } m/s
need-link = дальність радіо на висоті { $height } m
need-cost = вартість дрона, cr
need-none = немає
workshop-fit-seats = місця { $seats }: є / потрібно
