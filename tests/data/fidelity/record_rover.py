"""Records drives of a real ArduRover (SITL) for `cut_out.py`, all at once.

    python record_rover.py ARDUROVER FOLDER [NAME...]

A NAME is a chassis and a drive, as `rover_guided`, `skid_auto`, `boat_return`; without names, all are recorded. FOLDER
gets NAME.tlog, which the vehicle sent, and NAME.tx.tlog, which was sent to it.
"""

import io
import os
import struct
import subprocess
import sys
import threading
import time
from math import cos, hypot, radians
from pathlib import Path

os.environ["MAVLINK20"] = "1"
from pymavlink import mavutil  # noqa: E402

MAV = mavutil.mavlink
MODELS = {"rover": "rover", "skid": "rover-skid", "boat": "motorboat"}
DEFAULTS = {"rover": ["rover"], "skid": ["rover", "rover-skid"], "boat": ["rover", "motorboat"]}
LAT, LON = -35.363262, 149.165237
HOLD, FOLLOW, CIRCLE, AUTO, RTL, SMART_RTL, GUIDED = 4, 6, 9, 10, 11, 12, 15
POSITION_ONLY, VELOCITY_ONLY = 0x0DF8, 0x0DC7
# The first instance of SITL: ports 5760 + 10 * instance.
INSTANCE = 61


class Vehicle:
    def __init__(self, port, into):
        self.link = mavutil.mavlink_connection(f"tcp:127.0.0.1:{port}", source_system=255, source_component=190, retries=60)
        self.into, self.heard, self.sent = into, io.BytesIO(), io.BytesIO()
        write = self.link.write
        self.link.write = lambda data: (self.sent.write(stamp() + bytes(data)), write(data))
        self.last, self.said, self.beat = {}, [], 0.0

    def begin(self):
        """What came before is no part of the recording."""
        self.heard, self.sent = open(f"{self.into}.tlog", "wb"), open(f"{self.into}.tx.tlog", "wb")

    def close(self):
        self.heard.close()
        self.sent.close()

    def pump(self, seconds, until=lambda: False):
        """Reads for a time, or until something is true; returns whether it became true."""
        end = time.time() + seconds
        while time.time() < end:
            if time.time() - self.beat > 1:
                self.beat = time.time()
                self.link.mav.heartbeat_send(6, 8, 0, 0, 0)
            message = self.link.recv_match(blocking=True, timeout=0.02)
            if message is None or message.get_type() == "BAD_DATA":
                continue
            self.heard.write(stamp() + bytes(message.get_msgbuf()))
            self.last[message.get_type()] = message
            if message.get_type() == "STATUSTEXT":
                self.said.append(message.text)
            if until():
                return True
        return False

    def command(self, number, *parameters):
        self.last.pop("COMMAND_ACK", None)
        values = [*parameters, *[0.0] * (7 - len(parameters))]
        self.link.mav.command_long_send(1, 1, number, 0, *values)
        self.pump(2, lambda: getattr(self.last.get("COMMAND_ACK"), "command", None) == number)
        return getattr(self.last.get("COMMAND_ACK"), "result", None)

    def rate(self, message, hertz):
        self.command(MAV.MAV_CMD_SET_MESSAGE_INTERVAL, message, 1e6 / hertz)

    def mode(self, number):
        return self.command(MAV.MAV_CMD_DO_SET_MODE, 1, number)

    def set(self, name, value):
        self.link.mav.param_set_send(1, 1, name.encode(), value, MAV.MAV_PARAM_TYPE_REAL32)
        self.pump(1)

    def ready(self):
        self.pump(60, lambda: "HEARTBEAT" in self.last)
        self.rate(193, 2)
        usable = lambda: self.last["EKF_STATUS_REPORT"].flags & 16 if "EKF_STATUS_REPORT" in self.last else False
        assert self.pump(90, usable), "no position"
        # The comparison begins with the first position; a vehicle that has just booted has more to say before.
        self.command(MAV.MAV_CMD_SET_MESSAGE_INTERVAL, 32, -1)
        self.pump(5)
        self.begin()
        self.pump(3)
        for message, hertz in ((49, 1), (32, 20), (30, 20), (1, 2)):
            self.rate(message, hertz)
        self.link.mav.param_request_read_send(1, 1, b"SERVO1_FUNCTION", -1)
        self.pump(2)
        self.mode(GUIDED)
        for _ in range(20):
            if self.command(MAV.MAV_CMD_COMPONENT_ARM_DISARM, 1) == 0:
                break
            self.pump(1)
        self.pump(2)

    def away(self, north, east):
        place = self.last["LOCAL_POSITION_NED"]
        return hypot(place.x - north, place.y - east)

    def speed(self):
        place = self.last["LOCAL_POSITION_NED"]
        return hypot(place.vx, place.vy)

    def goto(self, north, east, most=60):
        lat = LAT + north / 111318.845
        lon = LON + east / (111318.845 * cos(radians(LAT)))
        self.link.mav.set_position_target_global_int_send(
            0, 1, 1, 6, POSITION_ONLY, round(lat * 1e7), round(lon * 1e7), 0, 0, 0, 0, 0, 0, 0, 0, 0
        )
        self.pump(1)
        self.pump(most, lambda: self.away(north, east) < 3 and self.speed() < 0.5)
        self.pump(5)

    def velocity(self, north, east, seconds):
        for _ in range(seconds * 5):
            self.link.mav.set_position_target_local_ned_send(0, 1, 1, 1, VELOCITY_ONLY, 0, 0, 0, north, east, 0, 0, 0, 0, 0, 0)
            self.pump(0.2)

    def until_told(self, words, most):
        count = len(self.said)
        self.pump(most, lambda: any(words in text for text in self.said[count:]))

    def upload(self, items):
        self.last.pop("MISSION_ACK", None)
        self.link.mav.mission_count_send(1, 1, len(items), 0)
        while "MISSION_ACK" not in self.last:
            if not self.pump(3, lambda: self.last.keys() & {"MISSION_REQUEST", "MISSION_REQUEST_INT", "MISSION_ACK"}):
                raise RuntimeError("no request")
            asked = self.last.pop("MISSION_REQUEST", None) or self.last.pop("MISSION_REQUEST_INT", None)
            if asked is None:
                continue
            command, parameters, north, east = items[asked.seq]
            lat = round((LAT + north / 111318.845) * 1e7) if north is not None else 0
            lon = round((LON + east / (111318.845 * cos(radians(LAT)))) * 1e7) if east is not None else 0
            values = [*parameters, *[0] * (4 - len(parameters))]
            self.link.mav.mission_item_int_send(1, 1, asked.seq, 3, command, 0, 1, *values, lat, lon, 0, 0)


def stamp():
    return struct.pack(">Q", round(time.time() * 1e6))


def guided(vehicle):
    """Places, coasting in HOLD, velocities that end, another speed."""
    vehicle.goto(40, 0)
    vehicle.goto(40, 30)
    vehicle.goto(5, 30, most=6)
    vehicle.mode(HOLD)
    vehicle.pump(12)
    vehicle.mode(GUIDED)
    vehicle.pump(2)
    vehicle.velocity(0, -1.5, 10)
    vehicle.pump(10)
    vehicle.goto(0, 0, most=3)
    vehicle.command(MAV.MAV_CMD_DO_CHANGE_SPEED, 0, 1.2)
    vehicle.goto(0, 0)


def auto(vehicle):
    """A mission with corners, a stay, another speed and a jump, then HOLD."""
    waypoint, jump, speed = MAV.MAV_CMD_NAV_WAYPOINT, MAV.MAV_CMD_DO_JUMP, MAV.MAV_CMD_DO_CHANGE_SPEED
    vehicle.upload(
        [
            (waypoint, [], 0, 0),
            (waypoint, [], 30, 0),
            (waypoint, [3], 30, 25),
            (waypoint, [], 5, 25),
            (speed, [0, 1.5], None, None),
            (waypoint, [], 5, 5),
            (jump, [2, 1], None, None),
            (waypoint, [], 0, 0),
        ]
    )
    vehicle.mode(AUTO)
    vehicle.until_told("Mission Complete", 180)
    vehicle.pump(8)
    vehicle.mode(HOLD)
    vehicle.pump(5)


def back(vehicle):
    """Back along the path, then straight home."""
    vehicle.goto(35, 0)
    vehicle.goto(35, 25)
    vehicle.mode(SMART_RTL)
    vehicle.until_told("Reached destination", 90)
    vehicle.pump(6)
    vehicle.mode(GUIDED)
    vehicle.pump(1)
    vehicle.goto(20, -30)
    vehicle.mode(RTL)
    vehicle.until_told("Reached destination", 90)
    vehicle.pump(8)
    vehicle.mode(HOLD)
    vehicle.pump(3)


def circle(vehicle):
    """Two circles around the place where each begins."""
    vehicle.goto(15, 0)
    vehicle.set("CIRC_RADIUS", 10)
    vehicle.mode(CIRCLE)
    vehicle.pump(45)
    vehicle.mode(HOLD)
    vehicle.pump(8)
    vehicle.set("CIRC_DIR", 1)
    vehicle.mode(CIRCLE)
    vehicle.pump(12)
    vehicle.command(MAV.MAV_CMD_DO_CHANGE_SPEED, 0, 1.2)
    vehicle.pump(25)
    vehicle.mode(HOLD)
    vehicle.pump(5)


def follow(vehicle):
    """Behind a vehicle with system id 2, which drives off, turns, stands and falls silent."""
    vehicle.set("FOLL_ENABLE", 1)
    vehicle.set("FOLL_SYSID", 2)
    vehicle.set("FOLL_OFS_X", -4)
    vehicle.mode(FOLLOW)
    vehicle.pump(2)
    leader, began = MAV.MAVLink(vehicle.link, srcSystem=2, srcComponent=1), time.time()
    north, east, before = 15.0, 5.0, 0.0
    while (now := time.time() - began) < 60:
        speed = (1.5, 0.0) if now < 20 else (0.0, 1.5) if now < 40 else (0.0, 0.0)
        north, east, before = north + speed[0] * (now - before), east + speed[1] * (now - before), now
        lat = round((LAT + north / 111318.845) * 1e7)
        lon = round((LON + east / (111318.845 * cos(radians(LAT)))) * 1e7)
        moving = [round(part * 100) for part in speed]
        leader.send(MAV.MAVLink_global_position_int_message(round(now * 1000), lat, lon, 584000, 0, *moving, 0, 65535))
        vehicle.pump(0.2)
    vehicle.pump(8)
    vehicle.mode(HOLD)
    vehicle.pump(3)


DRIVES = {"guided": guided, "auto": auto, "return": back, "circle": circle, "follow": follow}


def record(binary, folder, name, instance):
    chassis, drive = name.split("_")
    params = Path(binary).parents[3] / "Tools/autotest/default_params"
    defaults = ",".join(str(params / f"{part}.parm") for part in DEFAULTS[chassis])
    home = folder / f"sitl-{name}"
    home.mkdir(parents=True, exist_ok=True)
    arguments = ["--model", MODELS[chassis], "--speedup", "1", "--slave", "0", "--defaults", defaults]
    place = ["--home", f"{LAT},{LON},584,0", "--sysid", "1", f"-I{instance}"]
    sitl = subprocess.Popen(
        [binary, *arguments, *place], cwd=home, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
    )
    try:
        time.sleep(1)
        vehicle = Vehicle(5760 + 10 * instance, folder / name)
        vehicle.ready()
        DRIVES[drive](vehicle)
        vehicle.close()
        print(name, "recorded:", vehicle.said[-4:], flush=True)
    finally:
        sitl.terminate()
        sitl.wait()


if __name__ == "__main__":
    binary, folder = str(Path(sys.argv[1]).resolve()), Path(sys.argv[2]).resolve()
    names = sys.argv[3:] or [f"{chassis}_{drive}" for chassis in MODELS for drive in DRIVES]
    threads = [threading.Thread(target=record, args=(binary, folder, name, INSTANCE + i)) for i, name in enumerate(names)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
