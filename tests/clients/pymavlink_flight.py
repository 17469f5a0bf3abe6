"""pymavlink: arm, take off, fly to a place and at a velocity, return.

    python pymavlink_flight.py tcp:127.0.0.1:5760
"""

import sys
import time

from pymavlink import mavutil

LIMIT_S = 90


def wait_for(master, what, holds):
    """Reads messages until `holds(message)`."""
    end = time.time() + LIMIT_S
    while time.time() < end:
        message = master.recv_match(blocking=True, timeout=1)
        if message is not None and holds(message):
            return message
    sys.exit(f"not within {LIMIT_S} s: {what}")


def command(master, number, *params):
    params = list(params) + [0] * (7 - len(params))
    master.mav.command_long_send(master.target_system, master.target_component, number, 0, *params)
    ack = wait_for(
        master,
        f"ack of {number}",
        lambda m: m.get_type() == "COMMAND_ACK" and m.command == number,
    )
    return ack.result


def accepted(master, number, *params):
    # A vehicle that has just booted refuses to arm: try as people do.
    end = time.time() + LIMIT_S
    while (result := command(master, number, *params)) != mavutil.mavlink.MAV_RESULT_ACCEPTED:
        if time.time() > end:
            sys.exit(f"command {number} {params}: result {result}")
        time.sleep(1)


def position(message):
    return message.get_type() == "LOCAL_POSITION_NED"


def main():
    master = mavutil.mavlink_connection(sys.argv[1])
    master.wait_heartbeat(timeout=30)
    print("heartbeat from", master.target_system, master.target_component, master.flightmode)
    master.mav.request_data_stream_send(
        master.target_system, master.target_component, mavutil.mavlink.MAV_DATA_STREAM_ALL, 10, 1
    )
    wait_for(
        master,
        "an EKF that knows the position",
        lambda m: m.get_type() == "EKF_STATUS_REPORT" and m.flags & mavutil.mavlink.ESTIMATOR_POS_HORIZ_ABS,
    )

    assert "GUIDED" in master.mode_mapping()
    master.set_mode("GUIDED")
    wait_for(master, "GUIDED", lambda m: m.get_type() == "HEARTBEAT" and master.flightmode == "GUIDED")
    accepted(master, mavutil.mavlink.MAV_CMD_COMPONENT_ARM_DISARM, 1)
    master.motors_armed_wait()
    accepted(master, mavutil.mavlink.MAV_CMD_NAV_TAKEOFF, 0, 0, 0, 0, 0, 0, 15)
    wait_for(
        master, "15 m", lambda m: m.get_type() == "GLOBAL_POSITION_INT" and m.relative_alt > 14_500
    )
    print("at 15 m; location", master.location(relative_alt=True))

    master.mav.set_position_target_local_ned_send(
        0, master.target_system, master.target_component, mavutil.mavlink.MAV_FRAME_LOCAL_NED, 0b110111111000,
        30, 20, -15, 0, 0, 0, 0, 0, 0, 0, 0,
    )  # fmt: skip
    wait_for(master, "N 30 E 20", lambda m: position(m) and abs(m.x - 30) < 1 and abs(m.y - 20) < 1)
    print("at N 30 E 20")

    fast = None
    end = time.time() + LIMIT_S
    while fast is None and time.time() < end:
        master.mav.set_position_target_local_ned_send(
            0, master.target_system, master.target_component, mavutil.mavlink.MAV_FRAME_LOCAL_NED, 0b110111000111,
            0, 0, 0, -3, 0, 0, 0, 0, 0, 0, 0,
        )  # fmt: skip
        seen = master.recv_match(type="LOCAL_POSITION_NED", blocking=True, timeout=1)
        fast = seen if seen is not None and seen.vx < -2.8 else None
    assert fast is not None, "3 m/s south"
    print("3 m/s to the south")

    here = master.messages["GLOBAL_POSITION_INT"]
    master.mav.command_int_send(
        master.target_system, master.target_component, mavutil.mavlink.MAV_FRAME_GLOBAL_RELATIVE_ALT_INT,
        mavutil.mavlink.MAV_CMD_DO_REPOSITION, 0, 0, -1, 1, 0, 0,
        here.lat, here.lon, 20,
    )  # fmt: skip
    wait_for(
        master, "20 m", lambda m: m.get_type() == "GLOBAL_POSITION_INT" and m.relative_alt > 19_500
    )
    master.set_mode_rtl()
    wait_for(master, "RTL", lambda m: m.get_type() == "HEARTBEAT" and master.flightmode == "RTL")
    master.motors_disarmed_wait()
    print("ok")


main()
