"""MAVProxy, driven through its standard input as from a keyboard: parameters, mission, fence, rally, flight.

    python mavproxy_flight.py tcp:127.0.0.1:5760
"""

import os
import queue
import re
import subprocess
import sys
import tempfile
import threading
import time

LIMIT_S = 120
LAT, LON = -35.363262, 149.165237

WAYPOINTS = f"""QGC WPL 110
0\t1\t0\t16\t0\t0\t0\t0\t{LAT}\t{LON}\t584\t1
1\t0\t3\t22\t0\t0\t0\t0\t0\t0\t15\t1
2\t0\t3\t16\t0\t0\t0\t0\t{LAT + 0.0003}\t{LON}\t15\t1
3\t0\t3\t16\t0\t0\t0\t0\t{LAT + 0.0003}\t{LON + 0.0003}\t20\t1
4\t0\t3\t20\t0\t0\t0\t0\t0\t0\t0\t1
"""
CORNERS = [(-1, -1), (-1, 1), (1, 1), (1, -1)]
FENCE = "QGC WPL 110\n" + "".join(
    f"{seq}\t0\t3\t5001\t4\t0\t0\t0\t{LAT + 0.001 * north}\t{LON + 0.001 * east}\t0\t1\n"
    for seq, (north, east) in enumerate(CORNERS)
)
RALLY = f"QGC WPL 110\n0\t0\t3\t5100\t0\t0\t0\t0\t{LAT + 0.0001}\t{LON}\t20\t1\n"


class Terminal:
    """MAVProxy with a keyboard and a screen."""

    def __init__(self, address, folder):
        command = [
            sys.executable, "-m", "MAVProxy.mavproxy", "--master", address, "--state-basedir", folder,
            "--aircraft", "test", "--cmd", "set heartbeat 1; set streamrate 5",
        ]  # fmt: skip
        self.process = subprocess.Popen(
            command, cwd=folder, env={**os.environ, "HOME": folder, "PYTHONUNBUFFERED": "1", "TERM": "dumb"},
            stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, bufsize=1,
        )  # fmt: skip
        self.lines = queue.Queue()
        threading.Thread(target=self.read, daemon=True).start()

    def read(self):
        for line in self.process.stdout:
            print("  |", line.rstrip()[:150])
            self.lines.put(line)
        self.lines.put(None)

    def type(self, line):
        print("  >", line)
        self.process.stdin.write(line + "\n")

    def see(self, pattern, limit_s=LIMIT_S):
        """Waits until a line matches."""
        end = time.time() + limit_s
        while time.time() < end:
            try:
                line = self.lines.get(timeout=1)
            except queue.Empty:
                continue
            if line is None:
                break
            if re.search(pattern, line, re.IGNORECASE):
                return
        self.process.kill()
        sys.exit(f"not within {limit_s} s: {pattern}")

    def type_until(self, line, pattern):
        """Types a line every few seconds until it has an effect."""
        end = time.time() + LIMIT_S
        while time.time() < end:
            self.type(line)
            try:
                again = time.time() + 3
                while time.time() < again:
                    seen = self.lines.get(timeout=1)
                    if seen is None:
                        sys.exit("MAVProxy ended")
                    if re.search(pattern, seen, re.IGNORECASE):
                        return
            except queue.Empty:
                pass
        self.process.kill()
        sys.exit(f"not within {LIMIT_S} s: {pattern}")


def main():
    with tempfile.TemporaryDirectory() as folder:
        for name, text in (("way.txt", WAYPOINTS), ("fence.txt", FENCE), ("rally.txt", RALLY)):
            with open(os.path.join(folder, name), "w") as file:
                file.write(text)
        terminal = Terminal(sys.argv[1], folder)
        try:
            fly(terminal)
        finally:
            terminal.process.kill()
    print("ok")


def fly(terminal):
    terminal.see(r"Detected vehicle 1:1|online system 1")
    terminal.see(r"Received \d+ parameters")
    terminal.type("param show RTL_ALT")
    terminal.see(r"RTL_ALT\s+1500")
    terminal.type("param set RTL_ALT 1200")
    terminal.type_until("param show RTL_ALT", r"RTL_ALT\s+1200")
    terminal.type("wp load way.txt")
    terminal.see(r"TYPE_MISSION: ACCEPTED")
    terminal.type("wp list")
    terminal.see(r"Saved 5 waypoints|Requesting 5")
    terminal.type("rally load rally.txt")
    terminal.see(r"TYPE_RALLY: ACCEPTED")
    terminal.type("fence load fence.txt")
    terminal.see(r"TYPE_FENCE: ACCEPTED")
    terminal.type_until("mode GUIDED", r"GUIDED> |Mode GUIDED")
    terminal.type_until("arm throttle", r"AP: Arming motors|^ARMED|\bARMED$")
    terminal.type("takeoff 10")
    terminal.see(r"height 10|Got COMMAND_ACK: NAV_TAKEOFF: ACCEPTED")
    terminal.type_until("mode AUTO", r"Mode AUTO|AUTO> ")
    terminal.see(r"Reached command #2|Mission: 3")
    terminal.see(r"Mission: 4|Reached command #3")
    terminal.see(r"AP: Disarming motors|\bDISARMED\b")


main()
