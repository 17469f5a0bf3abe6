# Threats: rules of the air, alerts, injects.

threat-collision = зіткнення з апаратом { $other }
threat-separation = { $distance } м до апарата { $other }
threat-no-fly = у забороненій зоні { $zone }
threat-people = нижче { $height } м над людьми в { $zone }
threat-injury = удар по людині
threat-near-person = { $distance } м до людини
threat-aircraft-hit = зіткнення з літаком
threat-bubble = { $distance } м до літака
threat-intruder-hit = зіткнення з чужим дроном
threat-intruder-near = { $distance } м до чужого дрона
threat-answered = відповідь за { $seconds } с: { $alert }
threat-not-allowed = `{ $name }` не можна викликати в цій місії

threat-gust = сильні пориви вітру
threat-wind-shift = вітер змінює напрямок
threat-gnss-jam = супутникова навігація відмовила
threat-link-loss = зв'язок утрачено
threat-motor-fail = мотор відмовляє
threat-battery-cold = холодний акумулятор
threat-battery-cell = відмовила банка акумулятора
threat-person = на ділянку заходить людина
threat-aircraft = ділянку перетинає літак

# The objective of a link that must hold.
link-target = { $margin } дБ протягом { $percent } %
link-kept = { $percent } % із { $seconds } с
link-none = не були на завданні
link-more = ще { $seconds } с
link-advice = Тримайте ретранслятор у полі зору і наземної станції, і апарата за ним: над хребтом, перш ніж апарат зайде за нього.
