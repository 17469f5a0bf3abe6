# What continuous hazards are measured with, what is let go of over them, and the objectives about them.

mission-sensor-monoxide = CO
mission-sensor-methane = CH4
mission-sensor-dose-rate = потужність дози

# Loads.
load-ball = кулі
load-spray = розчин
load-kit = набори
load-node = вузли
load-dropped = { $what }; лишилося { $left }
load-nothing = впало там, де це нічого не дає
load-empty = { $load }: нічого не лишилося, сядьте на майданчик на 20 с
load-served = вантаж поповнено
load-shut = його розпилювач закрито
load-spray-left = лишилося { $left } с
load-on-ground = він стоїть на землі
load-too-high = { $height } м - це зависоко: щонайбільше { $limit } м
load-sample = { $sensor } { $value } { $unit }
load-sample-speed = проби беруть на швидкості щонайбільше { $limit } м/с
