"""pymavlink: sign a link, be understood, and switch signing off again.

    python pymavlink_signing.py tcp:127.0.0.1:5760
"""

import hashlib
import os
import sys
import time

os.environ["MAVLINK20"] = "1"

from pymavlink import mavutil  # noqa: E402

SECRET = hashlib.sha256(b"a passphrase of the user").digest()


def signed_heartbeats(master, wanted, limit_s=10):
    """Whether a heartbeat comes that is signed as wanted."""
    end = time.time() + limit_s
    while time.time() < end:
        heartbeat = master.recv_match(type="HEARTBEAT", blocking=True, timeout=2)
        if heartbeat is not None and bool(heartbeat.get_signed()) == wanted:
            return True
    return False


def main():
    master = mavutil.mavlink_connection(sys.argv[1])
    master.wait_heartbeat(timeout=30)
    time.sleep(3)
    stamp = int((time.time() - 1420070400) * 1e5)
    master.mav.setup_signing_send(master.target_system, master.target_component, list(SECRET), stamp)
    master.setup_signing(SECRET, sign_outgoing=True, initial_timestamp=stamp)
    assert signed_heartbeats(master, True), "no signed heartbeat"
    print("the vehicle signs")

    master.param_fetch_one("SYSID_THISMAV")
    value = master.recv_match(type="PARAM_VALUE", blocking=True, timeout=5)
    assert value is not None and value.get_signed(), "a signed question is answered and signed"
    master.set_mode("GUIDED")
    end = time.time() + 10
    while master.flightmode != "GUIDED" and time.time() < end:
        master.recv_match(type="HEARTBEAT", blocking=True, timeout=2)
    assert master.flightmode == "GUIDED", "a signed command is obeyed"

    master.mav.setup_signing_send(master.target_system, master.target_component, [0] * 32, 0)
    master.disable_signing()
    master.mav.signing.allow_unsigned_callback = lambda *_: True
    assert signed_heartbeats(master, False), "no unsigned heartbeat"
    print("ok")


main()
