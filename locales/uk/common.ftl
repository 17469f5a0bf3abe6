# Слова, спільні для кількох файлів.
#
# Словник, якого тримаються всі розділи:
#   vehicle - апарат; swarm - рій; fleet - флот; copter, plane, rover, sub - коптер, літак, ровер, підводний апарат
#   arm, armed - активувати двигуни, двигуни активні; disarm - деактивувати двигуни; kill - негайно зупинити двигуни
#   takeoff - зліт, злетіти; land - посадка, сісти; return to launch - повернення до місця зльоту
#   home - дім; altitude - висота; heading - курс; nose - ніс; climb - набір висоти
#   mode - режим; parameter - параметр; reboot - перезапуск; failsafe - FAILSAFE
#   command - команда; verb - дієслово; refused - відхилено; accepted - прийнято; effect seen - виконано;
#   no effect - без ефекту; timed out - без відповіді; superseded - замінено; queued - у черзі; sent - надіслано
#   link - канал зв'язку, зв'язок; message - повідомлення; notice - сповіщення; alert - тривога; ledger - журнал команд
#   mission - завдання; objective, target - ціль; brief - інструктаж; debrief - розбір; hint - підказка; score - бали
#   plan, item - план, пункт; fence - геозона; hazard - небезпека; sensor - датчик; sample - проба; battery - акумулятор
#   GPS fix - фікс; EKF, GPS, назви режимів, параметрів, дієслів, повідомлень і одиниці (m, s, V, A, deg) лишаються латиницею
# Апарат чи команду кличуть на ім'я або номер, тому дієслова безособові: "відхилено", а не "апарат відхилив".

count-vehicles = { $count ->
    [one] { $count } апарат
    [few] { $count } апарати
   *[many] { $count } апаратів
}
common-more = ... ще { $count }
