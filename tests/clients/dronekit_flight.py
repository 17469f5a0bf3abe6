"""DroneKit: connect, arm, take off, simple_goto, a mission in AUTO, return.

    python dronekit_flight.py tcp:127.0.0.1:5760
"""

import collections
import collections.abc
import sys
import time

# DroneKit was written for Pythons whose `collections` had these.
for name in ("MutableMapping", "Mapping", "Sequence", "Iterable", "Callable"):
    if not hasattr(collections, name):
        setattr(collections, name, getattr(collections.abc, name))

from dronekit import Command, LocationGlobalRelative, VehicleMode, connect  # noqa: E402
from pymavlink import mavutil  # noqa: E402

LIMIT_S = 120


def wait_for(what, holds):
    end = time.time() + LIMIT_S
    while not holds():
        if time.time() > end:
            sys.exit(f"not within {LIMIT_S} s: {what}")
        time.sleep(0.1)


def metres_between(a, b):
    north = (a.lat - b.lat) * 1.113195e5
    east = (a.lon - b.lon) * 1.113195e5 * 0.815
    return (north * north + east * east) ** 0.5


def main():
    vehicle = connect(sys.argv[1], wait_ready=True, timeout=60, heartbeat_timeout=60)
    print("connected:", vehicle.version, vehicle.mode.name, vehicle.battery, vehicle.gps_0)
    print(len(vehicle.parameters), "parameters, RTL_ALT", vehicle.parameters["RTL_ALT"])
    vehicle.parameters["RTL_ALT"] = 1600
    wait_for("RTL_ALT is set", lambda: vehicle.parameters["RTL_ALT"] == 1600)

    wait_for("armable", lambda: vehicle.is_armable)
    vehicle.mode = VehicleMode("GUIDED")
    wait_for("GUIDED", lambda: vehicle.mode.name == "GUIDED")
    while not vehicle.armed:
        vehicle.armed = True
        time.sleep(1)
    vehicle.simple_takeoff(12)
    wait_for("12 m", lambda: vehicle.location.global_relative_frame.alt > 12 * 0.95)
    print("at 12 m")

    home = vehicle.location.global_relative_frame
    goal = LocationGlobalRelative(home.lat + 0.0003, home.lon + 0.0002, 15)
    vehicle.simple_goto(goal, groundspeed=6)
    wait_for("the goal", lambda: metres_between(vehicle.location.global_relative_frame, goal) < 1.5)
    print("at the goal, going", vehicle.groundspeed, "heading", vehicle.heading)

    commands = vehicle.commands
    commands.download()
    commands.wait_ready(timeout=30)
    assert vehicle.home_location is not None, "the home location comes with the mission"
    commands.clear()
    frame = mavutil.mavlink.MAV_FRAME_GLOBAL_RELATIVE_ALT
    waypoint = mavutil.mavlink.MAV_CMD_NAV_WAYPOINT
    commands.add(
        Command(0, 0, 0, frame, mavutil.mavlink.MAV_CMD_NAV_TAKEOFF, 0, 0, 0, 0, 0, 0, 0, 0, 15)
    )
    for north, east in ((0.0003, 0.0003), (0.0001, 0.0003), (0, 0)):
        commands.add(
            Command(0, 0, 0, frame, waypoint, 0, 0, 0, 0, 0, 0, home.lat + north, home.lon + east, 15)
        )
    commands.upload(timeout=30)
    commands.next = 0
    vehicle.mode = VehicleMode("AUTO")
    wait_for("AUTO", lambda: vehicle.mode.name == "AUTO")
    wait_for("waypoint 3", lambda: commands.next >= 3)
    print("in the mission, next", commands.next)

    vehicle.mode = VehicleMode("RTL")
    wait_for("landed", lambda: not vehicle.armed)
    vehicle.close()
    print("ok")


main()
