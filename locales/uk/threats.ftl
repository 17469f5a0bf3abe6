# Загрози: правила польотів, тривоги, введені події.

threat-collision = зіткнення з дроном { $other }
threat-separation = { $distance } m до дрона { $other }
threat-no-fly = у забороненій зоні { $zone }
threat-people = нижче ніж { $height } m над людьми ({ $zone })
threat-injury = зіткнення з людиною
threat-near-person = { $distance } m до людини
threat-aircraft-hit = зіткнення з літаком
threat-bubble = { $distance } m до літака
threat-intruder-hit = зіткнення з чужим дроном
threat-intruder-near = { $distance } m до чужого дрона
threat-answered = відповідь за { $seconds } s: { $alert }
threat-not-allowed = подію `{ $name }` не можна ввести в це завдання

threat-gust = сильні пориви вітру
threat-wind-shift = вітер змінює напрямок
threat-gnss-jam = супутникова навігація відмовила
threat-link-loss = зв'язок втрачено
threat-motor-fail = двигун відмовляє
threat-battery-cold = холодний акумулятор
threat-battery-cell = відмовив елемент акумулятора
threat-person = на ділянку заходить людина
threat-aircraft = ділянку перетинає літак

# Ціль: утримати зв'язок.
link-target = { $margin } dB протягом { $percent } % часу
link-kept = зв'язок протягом { $percent } % із { $seconds } s
link-none = на ділянці: 0 s
link-more = ще { $seconds } s
link-advice = Поставте ретранслятор над хребтом, у полі зору наземної станції й дрона, перш ніж дрон залетить за хребет.
