"""pymavlink: upload a fence and a rally point, switch the fence on, be held inside it.

    python pymavlink_fence.py tcp:127.0.0.1:5760
"""

import sys
import time

from pymavlink import mavutil

LIMIT_S = 90
STILL_MS = 5_000
mav = mavutil.mavlink
FENCE, RALLY = mav.MAV_MISSION_TYPE_FENCE, mav.MAV_MISSION_TYPE_RALLY


def wait_for(master, what, holds, limit_s=LIMIT_S):
    end = time.time() + limit_s
    while time.time() < end:
        message = master.recv_match(blocking=True, timeout=1)
        if message is not None and holds(message):
            return message
    sys.exit(f"not within {limit_s} s: {what}")


def command(master, number, *params):
    params = list(params) + [0] * (7 - len(params))
    master.mav.command_long_send(master.target_system, master.target_component, number, 0, *params)
    ack = wait_for(master, f"ack of {number}", lambda m: m.get_type() == "COMMAND_ACK" and m.command == number)
    return ack.result


def accepted(master, number, *params):
    end = time.time() + LIMIT_S
    while (result := command(master, number, *params)) != mav.MAV_RESULT_ACCEPTED:
        if time.time() > end:
            sys.exit(f"command {number} {params}: result {result}")
        time.sleep(1)


def upload(master, kind, points):
    """Points are (command, param1, lat, lon)."""
    master.mav.mission_count_send(master.target_system, master.target_component, len(points), kind)
    while True:
        asked = wait_for(
            master,
            "a request",
            lambda m: m.get_type() in ("MISSION_REQUEST", "MISSION_REQUEST_INT", "MISSION_ACK")
            and m.mission_type == kind,
            10,
        )
        if asked.get_type() == "MISSION_ACK":
            assert asked.type == mav.MAV_MISSION_ACCEPTED, f"upload refused: {asked}"
            return
        number, param1, lat, lon = points[asked.seq]
        master.mav.mission_item_int_send(
            master.target_system, master.target_component, asked.seq, mav.MAV_FRAME_GLOBAL_RELATIVE_ALT, number, 0, 1,
            param1, 0, 0, 0, round(lat * 1e7), round(lon * 1e7), 0, kind,
        )  # fmt: skip


def count(master, kind):
    master.mav.mission_request_list_send(master.target_system, master.target_component, kind)
    counted = wait_for(
        master, "MISSION_COUNT", lambda m: m.get_type() == "MISSION_COUNT" and m.mission_type == kind, 10
    )
    return counted.count


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
    here = wait_for(master, "a position", lambda m: m.get_type() == "GLOBAL_POSITION_INT")
    lat, lon = here.lat * 1e-7, here.lon * 1e-7
    # About 55 m to each side in latitude.
    corners = [(-1, -1), (-1, 1), (1, 1), (1, -1)]
    polygon = [
        (mav.MAV_CMD_NAV_FENCE_POLYGON_VERTEX_INCLUSION, 4, lat + 0.0005 * north, lon + 0.0005 * east)
        for north, east in corners
    ]
    upload(master, FENCE, polygon)
    assert count(master, FENCE) == 4
    upload(master, RALLY, [(mav.MAV_CMD_NAV_RALLY_POINT, 0, lat + 0.0001, lon)])
    assert count(master, RALLY) == 1
    print("fence and rally point are stored")

    master.mav.command_long_send(
        master.target_system, master.target_component, mav.MAV_CMD_DO_FENCE_ENABLE, 0, 1, 0, 0, 0, 0, 0, 0
    )
    wait_for(master, "FENCE_STATUS", lambda m: m.get_type() == "FENCE_STATUS")
    master.set_mode("GUIDED")
    accepted(master, mav.MAV_CMD_COMPONENT_ARM_DISARM, 1)
    accepted(master, mav.MAV_CMD_NAV_TAKEOFF, 0, 0, 0, 0, 0, 0, 10)
    wait_for(master, "10 m", lambda m: m.get_type() == "GLOBAL_POSITION_INT" and m.relative_alt > 9_500)

    # A target outside is refused.
    master.mav.command_int_send(
        master.target_system, master.target_component, mav.MAV_FRAME_GLOBAL_RELATIVE_ALT_INT,
        mav.MAV_CMD_DO_REPOSITION, 0, 0, -1, 1, 0, 0, round((lat + 0.002) * 1e7), round(lon * 1e7), 10,
    )  # fmt: skip
    ack = wait_for(
        master, "ack", lambda m: m.get_type() == "COMMAND_ACK" and m.command == mav.MAV_CMD_DO_REPOSITION
    )
    assert ack.result == mav.MAV_RESULT_FAILED, ack
    print("a target outside is refused")

    # Flying against the fence ends in front of it. The velocity is repeated with each position, so these must come
    # often: if it is repeated less than every 200 ms of the vehicle's time, avoidance forgets in between how far it
    # has braked, and the vehicle swings to and fro in front of the fence.
    accepted(master, mav.MAV_CMD_SET_MESSAGE_INTERVAL, mav.MAVLINK_MSG_ID_LOCAL_POSITION_NED, 50_000)
    farthest = 0
    still_since = None
    still_ms = 0
    end = time.time() + LIMIT_S
    while still_ms < STILL_MS and time.time() < end:
        master.mav.set_position_target_local_ned_send(
            0, master.target_system, master.target_component, mav.MAV_FRAME_LOCAL_NED, 0b110111000111,
            0, 0, 0, 2, 0, 0, 0, 0, 0, 0, 0,
        )  # fmt: skip
        seen = master.recv_match(type=["LOCAL_POSITION_NED", "STATUSTEXT"], blocking=True, timeout=1)
        if seen is not None and seen.get_type() == "STATUSTEXT":
            print(master.flightmode, seen.text)
            continue
        if seen is not None:
            farthest = max(farthest, seen.x)
            if seen.x < 30 or abs(seen.vx) > 0.3:
                still_since = None
            elif still_since is None:
                still_since = seen.time_boot_ms
            still_ms = 0 if still_since is None else seen.time_boot_ms - still_since
    print(f"held at {farthest:.1f} m north")
    assert 40 < farthest < 56 and still_ms >= STILL_MS
    master.mav.command_long_send(
        master.target_system, master.target_component, mav.MAV_CMD_DO_FENCE_ENABLE, 0, 0, 0, 0, 0, 0, 0, 0
    )
    for kind in (FENCE, RALLY):
        master.mav.mission_clear_all_send(master.target_system, master.target_component, kind)
        wait_for(master, "ack", lambda m: m.get_type() == "MISSION_ACK" and m.mission_type == kind, 10)
        assert count(master, kind) == 0
    print("ok")


main()
