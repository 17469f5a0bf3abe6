"""pymavlink: upload a mission, read it back, fly it in AUTO, clear it.

    python pymavlink_mission.py tcp:127.0.0.1:5760
"""

import sys
import time

from pymavlink import mavutil

LIMIT_S = 120
mav = mavutil.mavlink


def wait_for(master, what, holds, limit_s=LIMIT_S):
    end = time.time() + limit_s
    while time.time() < end:
        message = master.recv_match(blocking=True, timeout=1)
        if message is not None and holds(message):
            return message
    sys.exit(f"not within {limit_s} s: {what}")


def of(*kinds):
    return lambda message: message.get_type() in kinds


def accepted(master, number, *params):
    end = time.time() + LIMIT_S
    while time.time() < end:
        params = list(params) + [0] * (7 - len(params))
        master.mav.command_long_send(master.target_system, master.target_component, number, 0, *params)
        ack = wait_for(master, f"ack of {number}", lambda m: m.get_type() == "COMMAND_ACK" and m.command == number)
        if ack.result == mav.MAV_RESULT_ACCEPTED:
            return
        time.sleep(1)
    sys.exit(f"command {number}: result {ack.result}")


def item(seq, command, lat, lon, altitude, *params):
    params = list(params) + [0] * (4 - len(params))
    return mav.MAVLink_mission_item_int_message(
        0, 0, seq, mav.MAV_FRAME_GLOBAL_RELATIVE_ALT, command, int(seq == 0), 1, *params,
        round(lat * 1e7), round(lon * 1e7), altitude,
    )  # fmt: skip


def mission(lat, lon):
    return [
        item(0, mav.MAV_CMD_NAV_WAYPOINT, lat, lon, 0),
        item(1, mav.MAV_CMD_NAV_TAKEOFF, 0, 0, 20),
        item(2, mav.MAV_CMD_DO_CHANGE_SPEED, 0, 0, 0, 1, 8, -1),
        item(3, mav.MAV_CMD_NAV_WAYPOINT, lat + 0.0004, lon, 20),
        item(4, mav.MAV_CMD_NAV_WAYPOINT, lat + 0.0004, lon + 0.0004, 25, 2),
        item(5, mav.MAV_CMD_NAV_RETURN_TO_LAUNCH, 0, 0, 0),
    ]


def upload(master, items):
    master.waypoint_count_send(len(items))
    while True:
        asked = wait_for(master, "a request", of("MISSION_REQUEST", "MISSION_REQUEST_INT", "MISSION_ACK"), 10)
        if asked.get_type() == "MISSION_ACK":
            assert asked.type == mav.MAV_MISSION_ACCEPTED, f"upload refused: {asked}"
            return
        answer = items[asked.seq]
        answer.target_system, answer.target_component = master.target_system, master.target_component
        master.mav.send(answer)


def download(master):
    master.waypoint_request_list_send()
    count = wait_for(master, "MISSION_COUNT", of("MISSION_COUNT"), 10).count
    items = []
    for seq in range(count):
        master.mav.mission_request_int_send(master.target_system, master.target_component, seq)
        items.append(wait_for(master, f"item {seq}", of("MISSION_ITEM_INT"), 10))
    master.mav.mission_ack_send(master.target_system, master.target_component, mav.MAV_MISSION_ACCEPTED)
    return items


def main():
    master = mavutil.mavlink_connection(sys.argv[1])
    master.wait_heartbeat(timeout=30)
    master.mav.request_data_stream_send(
        master.target_system, master.target_component, mav.MAV_DATA_STREAM_ALL, 5, 1
    )
    wait_for(
        master,
        "an EKF that knows the position",
        lambda m: m.get_type() == "EKF_STATUS_REPORT" and m.flags & mav.ESTIMATOR_POS_HORIZ_ABS,
    )
    here = wait_for(master, "a position", of("GLOBAL_POSITION_INT"))
    items = mission(here.lat * 1e-7, here.lon * 1e-7)
    upload(master, items)
    stored = download(master)
    assert [one.command for one in stored] == [one.command for one in items], stored
    assert [(one.x, one.y, one.z) for one in stored[3:5]] == [(one.x, one.y, one.z) for one in items[3:5]], stored
    print("uploaded and read back", len(stored), "items")

    master.set_mode("GUIDED")
    accepted(master, mav.MAV_CMD_COMPONENT_ARM_DISARM, 1)
    master.motors_armed_wait()
    accepted(master, mav.MAV_CMD_MISSION_START)
    wait_for(master, "AUTO", lambda m: m.get_type() == "HEARTBEAT" and master.flightmode == "AUTO")
    for seq in (3, 4):
        reached = lambda m: m.get_type() == "MISSION_ITEM_REACHED" and m.seq >= seq
        wait_for(master, f"item {seq}", reached)
        print("reached", seq)
    wait_for(master, "item 5", lambda m: m.get_type() == "MISSION_CURRENT" and m.seq == 5)
    master.motors_disarmed_wait()
    print("landed")

    master.waypoint_clear_all_send()
    ack = wait_for(master, "MISSION_ACK", of("MISSION_ACK"), 10)
    assert ack.type == mav.MAV_MISSION_ACCEPTED
    assert len(download(master)) <= 1
    print("ok")


main()
