#!/usr/bin/env python3
"""Finds the source of a gas plume: sortie fly 03 --api /tmp/sortie.sock, then plume_bot.py /tmp/sortie.sock

The clock starts when Enter is pressed in the brief.

The bot crosses the wind downwind of the plant until it has met the gas. Then it goes up the plume in steps: to the peak,
which is the place of the highest reading so far, a little against the wind, and once across. When three steps in a row
find nothing higher, the source is near the peak.
"""

import sys

from console import Console

STEPS = 10
FRUITLESS = 3


def peak(console):
    places = {one["name"]: one for one in console.mission["places"]}
    return places.get("peak")


bot = Console(sys.argv[1])
bot.watch("vehicles", "mission")
bot.wait(lambda it: it.mission and 1 in it.vehicles and it.vehicles[1]["ready_to_arm"])
for line in ("guided", "arm", "takeoff 12", "goto n 40 e 50 up 12", "speed 4.5", "goto n 160 e 50 up 12"):
    bot.say(f"all {line}")
fruitless = 0
for step in range(STEPS):
    before = peak(bot)
    for line in ("goto peak up 12", "goto by n 15 e -13", "goto by n -30 e 0"):
        bot.say(f"all {line}")
    fruitless = fruitless + 1 if peak(bot) == before else 0
    if fruitless == FRUITLESS:
        break
for line in ("mark peak as leak", "speed 10", "rtl"):
    bot.say(f"all {line}")
bot.wait(lambda it: it.mission["over"])
print("steps", step + 1, "score", bot.mission["score"])
