# What continuous hazards are measured with, what is let go of over them, and the objectives about them.

mission-sensor-monoxide = CO
mission-sensor-methane = CH4
mission-sensor-dose-rate = dose rate

# Loads.
load-ball = balls
load-spray = spray
load-kit = kits
load-node = nodes
load-dropped = { $what }; { $left } left
load-nothing = it fell on nothing of account
load-empty = no { $load } left: land on a pad for 20 s
load-served = loads on board again
load-shut = its sprayer is shut
load-spray-left = { $left } s left
load-on-ground = it stands on the ground
load-too-high = { $height } m is too high: { $limit } m at most
load-sample = { $sensor } { $value } { $unit }
load-sample-speed = samples are taken at { $limit } m/s at most
