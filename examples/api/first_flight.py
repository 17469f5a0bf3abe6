#!/usr/bin/env python3
"""Flies the first mission: sortie fly 00 --api /tmp/sortie.sock, then first_flight.py /tmp/sortie.sock

The clock starts when Enter is pressed in the brief.
"""

import sys

from console import Console

console = Console(sys.argv[1])
console.watch("vehicles", "mission")
console.wait(lambda it: it.mission and 1 in it.vehicles and it.vehicles[1]["ready_to_arm"])
console.say("all guided")
console.say("all arm")
console.say("all takeoff 20")
hover_until = console.mission["elapsed_s"] + 12
console.wait(lambda it: it.mission["elapsed_s"] > hover_until)
for gate in ("gate1", "gate2", "gate3"):
    console.say(f"all goto {gate} up 20")
console.say("all rtl")
console.wait(lambda it: it.mission["over"])
print("score", console.mission["score"])
