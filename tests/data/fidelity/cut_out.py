"""Cuts recordings of a real vehicle down to what `sortie bench fidelity` reads.

    python cut_out.py FOLDER_OF_RECORDINGS NAME...

From NAME.tlog it keeps acks, texts, origins, changes of mode and of arming, the function of the first output, and of position, attitude and voltage the
samples between which a straight line is nearer to all the others than the tolerances below. NAME.tx.tlog is copied.
"""

import shutil
import struct
import sys
from math import degrees
from pathlib import Path

from pymavlink import mavutil

KEPT = {"COMMAND_ACK", "MISSION_ACK", "MISSION_ITEM_REACHED", "STATUSTEXT"}
# It tells a rover that turns on the spot from one with steered wheels.
KEPT_PARAMETER = "SERVO1_FUNCTION"
# Position 3 cm and velocity 5 cm/s, attitude 0.3 degrees, voltage 20 mV.
THINNED = {
    "LOCAL_POSITION_NED": lambda m: [m.x / 0.03, m.y / 0.03, m.z / 0.03, m.vx / 0.05, m.vy / 0.05, m.vz / 0.05],
    "ATTITUDE": lambda m: [degrees(angle) / 0.3 for angle in (m.roll, m.pitch, m.yaw)],
    "SYS_STATUS": lambda m: [m.voltage_battery / 20],
}
# An angle that changes by more between two samples could have turned either way.
WIDEST = 90 / 0.3


def records(path):
    log = mavutil.mavlink_connection(str(path), notimestamps=False)
    while (message := log.recv_msg()) is not None:
        if message.get_type() != "BAD_DATA":
            yield message._timestamp, message


def on_the_line(first, last, between):
    (t0, a), (t1, b) = first, last
    if any(abs(y - x) > WIDEST for x, y in zip(a, b)):
        return False
    for t, values in between:
        share = (t - t0) / (t1 - t0) if t1 > t0 else 0
        if any(abs(x + share * (y - x) - value) > 1 for x, y, value in zip(a, b, values)):
            return False
    return True


class Thinner:
    """Lets a sample pass once the line from the last one that passed would miss one in between."""

    def __init__(self, values_of):
        self.values_of = values_of
        self.passed = None
        self.between = []

    def add(self, time, message):
        values = self.values_of(message)
        if self.passed is None:
            self.passed = (time, values)
            return [(time, message)]
        let_pass = []
        points = [(t, v) for t, v, _ in self.between]
        # Patience ends: a line of more than 200 samples is begun anew.
        if self.between and (len(points) > 200 or not on_the_line(self.passed, (time, values), points)):
            t, v, m = self.between[-1]
            self.passed = (t, v)
            self.between = []
            let_pass = [(t, m)]
        self.between.append((time, values, message))
        return let_pass

    def rest(self):
        return [(t, m) for t, _, m in self.between[-1:]]


def cut(folder, name, into):
    thinners = {kind: Thinner(values_of) for kind, values_of in THINNED.items()}
    kept = []
    heartbeat = origin = None
    for time, message in records(folder / f"{name}.tlog"):
        kind = message.get_type()
        if kind in KEPT:
            kept.append((time, message))
        elif kind == "PARAM_VALUE" and message.param_id == KEPT_PARAMETER:
            kept.append((time, message))
        elif kind in thinners:
            kept += thinners[kind].add(time, message)
        elif kind == "HEARTBEAT" and heartbeat != (heartbeat := (message.custom_mode, message.base_mode & 128)):
            kept.append((time, message))
        elif kind == "GPS_GLOBAL_ORIGIN" and origin is None:
            origin = time
            kept.append((time, message))
    for thinner in thinners.values():
        kept += thinner.rest()
    kept.sort(key=lambda record: record[0])
    with open(into / f"{name}.tlog", "wb") as out:
        for time, message in kept:
            out.write(struct.pack(">Q", round(time * 1e6)) + bytes(message.get_msgbuf()))
    shutil.copyfile(folder / f"{name}.tx.tlog", into / f"{name}.tx.tlog")
    (into / f"{name}.tx.tlog").chmod(0o644)


if __name__ == "__main__":
    for name in sys.argv[2:]:
        cut(Path(sys.argv[1]), name, Path(__file__).parent)
