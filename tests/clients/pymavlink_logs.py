"""pymavlink: list the logs and download the first bytes of the last one.

    python pymavlink_logs.py tcp:127.0.0.1:5760
"""

import sys
import time

from pymavlink import mavutil


def main():
    master = mavutil.mavlink_connection(sys.argv[1])
    master.wait_heartbeat(timeout=30)
    master.mav.heartbeat_send(
        mavutil.mavlink.MAV_TYPE_GCS, mavutil.mavlink.MAV_AUTOPILOT_INVALID, 0, 0, 0
    )
    # Lists are not answered while a vehicle boots.
    time.sleep(5)
    to = (master.target_system, master.target_component)
    master.mav.log_request_list_send(*to, 0, 0xFFFF)
    entry = master.recv_match(type="LOG_ENTRY", blocking=True, timeout=15)
    assert entry is not None, "no LOG_ENTRY"
    print(f"{entry.num_logs} logs, the first has {entry.size} bytes")
    if entry.num_logs > 0:
        while entry.id != entry.last_log_num:
            entry = master.recv_match(type="LOG_ENTRY", blocking=True, timeout=15)
            assert entry is not None, "the list ends early"
        wanted = min(entry.size, 4096)
        master.mav.log_request_data_send(*to, entry.id, 0, wanted)
        got = 0
        while got < wanted:
            data = master.recv_match(type="LOG_DATA", blocking=True, timeout=15)
            assert data is not None, f"the log ends at {got} of {wanted}"
            assert data.id == entry.id
            got = max(got, data.ofs + data.count)
        print(f"downloaded {got} bytes of log {entry.id}")
    master.mav.log_request_end_send(*to)
    print("ok")


main()
