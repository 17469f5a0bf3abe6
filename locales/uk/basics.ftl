# Завдання для початківців: ворота, місця, зависання, стрій, активація двигунів, посадка.
mission-gates = { $count ->
    [one] { $count } ворота
   *[other] { $count } воріт
}
mission-gates-of = { $passed }/{ $count } воріт
mission-gates-advice = Наступні ворота — { $gate }: пролетіть не далі ніж за { $radius } m від їхньої середини; проходьте ворота по черзі.
mission-visit = { $count ->
    [one] { $count } місце
    [few] { $count } місця
   *[many] { $count } місць
}
mission-visit-of = { $count ->
    [one] { $passed }/{ $count } місця
   *[many] { $passed }/{ $count } місць
}
mission-visit-advice = Відвідайте ще { $place }: протримайтеся { $dwell } s не далі ніж за { $radius } m від нього.
mission-hover = { $time } s
mission-hover-of = { $held }/{ $time } s
mission-hover-advice-at = Зависніть нерухомо на { $time } s без перерви: не далі ніж за { $radius } m від { $place }, на висоті від { $low } до { $high } m.
mission-hover-advice = Зависніть нерухомо на { $time } s без перерви: не далі ніж за { $radius } m від однієї точки, на висоті від { $low } до { $high } m.
mission-formation = { $count ->
    [one] { $count } ворота, { $percent } %
   *[other] { $count } воріт, { $percent } %
}
mission-formation-of = { $passed }/{ $count } воріт, { $percent } %
mission-formation-advice = Проведіть середину рою крізь { $gate }; увесь час тримайте між кожним дроном і його найближчим сусідом відстань від { $low } до { $high } m.
mission-arm-within = { $time } s
mission-armed-after = активовано за { $time } s
mission-not-armed = не активовано
mission-arm-advice = Активуйте двигуни не пізніше ніж за { $time } s після готовності: `wait all ready`, потім `arm`.
mission-land-within = { $radius } m
mission-landed-of = сіло { $down }/{ $count }
mission-land-advice = Сядьте не далі ніж за { $radius } m від { $place } і дочекайтеся деактивації двигунів.
