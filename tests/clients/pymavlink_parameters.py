"""pymavlink: dump all parameters, read by name and by index, set, and fetch the list once more over MAVFTP.

    python pymavlink_parameters.py tcp:127.0.0.1:5760
"""

import os
import sys
import tempfile
import time

from pymavlink import mavftp, mavparm, mavutil

LIMIT_S = 60


def dump(master):
    """Asks for the list, then again for what is missing, as MAVProxy does."""
    master.param_fetch_all()
    found = {}
    count = None
    end = time.time() + LIMIT_S
    while (count is None or len(found) < count) and time.time() < end:
        value = master.recv_match(type="PARAM_VALUE", blocking=True, timeout=2)
        if value is None and count is not None:
            for index in sorted(set(range(count)) - {index for index, _ in found.values()})[:50]:
                master.mav.param_request_read_send(master.target_system, master.target_component, b"", index)
        elif value is not None and value.param_index != 65535:
            count = value.param_count
            found[value.param_id] = (value.param_index, value.param_value)
    assert count and len(found) == count, f"{len(found)} of {count} parameters"
    return {name: value for name, (_, value) in found.items()}


def main():
    master = mavutil.mavlink_connection(sys.argv[1])
    master.wait_heartbeat(timeout=30)
    # Nothing but heartbeats comes until the vehicle has heard somebody.
    master.mav.heartbeat_send(
        mavutil.mavlink.MAV_TYPE_GCS, mavutil.mavlink.MAV_AUTOPILOT_INVALID, 0, 0, 0
    )
    # A vehicle does not answer in the first two seconds of its boot.
    time.sleep(3)
    values = dump(master)
    print(len(values), "parameters")
    for name in ("WPNAV_SPEED", "RTL_ALT", "FENCE_ENABLE", "BATT_CAPACITY", "SYSID_THISMAV"):
        assert name in values, f"{name} is missing"

    master.param_fetch_one("RTL_ALT")
    value = master.recv_match(type="PARAM_VALUE", condition="PARAM_VALUE.param_id=='RTL_ALT'", blocking=True, timeout=5)
    assert value is not None and value.param_value == values["RTL_ALT"], "RTL_ALT by name"
    master.param_fetch_one(0)
    assert master.recv_match(type="PARAM_VALUE", blocking=True, timeout=5) is not None, "parameter 0 by index"

    parameters = mavparm.MAVParmDict()
    assert parameters.mavset(master, "RTL_ALT", 2000, retries=3), "RTL_ALT is set"
    master.param_fetch_one("RTL_ALT")
    value = master.recv_match(type="PARAM_VALUE", blocking=True, timeout=5)
    assert value.param_value == 2000
    parameters.mavset(master, "RTL_ALT", values["RTL_ALT"], retries=3)

    ftp = mavftp.MAVFTP(master, master.target_system, master.target_component)
    with tempfile.TemporaryDirectory() as folder:
        into = os.path.join(folder, "vehicle.param")
        asked = ftp.cmd_getparams([into], sort_type="missionplanner")
        fetched = ftp.process_ftp_reply("getparams", timeout=LIMIT_S)
        assert fetched.error_code == mavftp.FtpError.Success, f"MAVFTP: {asked.error_code!r} {fetched.error_code!r}"
        with open(into) as file:
            lines = file.readlines()
    print("over MAVFTP:", len(lines), "parameters")
    assert len(lines) >= len(values)
    print("ok")


main()
