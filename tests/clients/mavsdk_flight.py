"""MAVSDK-Python: arm, take off, goto_location, offboard velocity, return.

    python mavsdk_flight.py tcpout://127.0.0.1:5760
"""

import asyncio
import os
import socket
import sys
import traceback

try:
    import mavsdk_grpc as mavsdk
    from mavsdk_grpc.action import ActionError
    from mavsdk_grpc.offboard import VelocityNedYaw
except ImportError:  # before version 4
    import mavsdk
    from mavsdk.action import ActionError
    from mavsdk.offboard import VelocityNedYaw

LIMIT_S = 120


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


async def wait_for(what, stream, holds):
    async def watch():
        async for value in stream:
            if holds(value):
                return value

    try:
        return await asyncio.wait_for(watch(), LIMIT_S)
    except asyncio.TimeoutError:
        sys.exit(f"not within {LIMIT_S} s: {what}")


async def patiently(what, act):
    for _ in range(LIMIT_S):
        try:
            return await act()
        except ActionError as error:
            print(what, error)
            await asyncio.sleep(1)
    sys.exit(f"not within {LIMIT_S} s: {what}")


async def main():
    drone = mavsdk.System(port=free_port())
    await drone.connect(system_address=sys.argv[1])
    await wait_for("connected", drone.core.connection_state(), lambda state: state.is_connected)
    print("connected")
    version = await drone.info.get_version()
    print("version", version.flight_sw_major, version.flight_sw_minor)
    # ArduPilot sends nothing unasked.
    telemetry = drone.telemetry
    for set_rate in (telemetry.set_rate_position, telemetry.set_rate_velocity_ned, telemetry.set_rate_attitude_euler, telemetry.set_rate_gps_info, telemetry.set_rate_health, telemetry.set_rate_in_air, telemetry.set_rate_battery):
        await set_rate(5)
    await wait_for(
        "healthy", drone.telemetry.health(), lambda h: h.is_global_position_ok and h.is_home_position_ok
    )
    assert await drone.param.get_param_float("WPNAV_SPEED") == 1000
    await drone.param.set_param_float("WPNAV_SPEED", 900)
    assert await drone.param.get_param_float("WPNAV_SPEED") == 900
    everything = await drone.param.get_all_params()
    print(len(everything.float_params) + len(everything.int_params), "parameters")

    await drone.action.set_takeoff_altitude(12)
    assert await drone.action.get_takeoff_altitude() == 12
    await drone.action.hold()
    await patiently("arm", drone.action.arm)
    await drone.action.takeoff()
    await wait_for("12 m", drone.telemetry.position(), lambda p: p.relative_altitude_m > 11.4)
    print("at 12 m")

    here = await wait_for("a position", drone.telemetry.position(), lambda p: True)
    north = here.latitude_deg + 0.0003
    await drone.action.goto_location(north, here.longitude_deg, here.absolute_altitude_m + 5, 0)
    await wait_for(
        "the goal",
        drone.telemetry.position(),
        lambda p: abs(p.latitude_deg - north) < 1e-5 and p.relative_altitude_m > 16,
    )
    print("at the goal")

    await drone.offboard.set_velocity_ned(VelocityNedYaw(0, 0, 0, 0))
    await drone.offboard.start()
    await drone.offboard.set_velocity_ned(VelocityNedYaw(0, 4, 0, 90))
    await wait_for(
        "4 m/s east", drone.telemetry.velocity_ned(), lambda v: v.east_m_s > 3.8
    )
    await wait_for("facing east", drone.telemetry.heading(), lambda h: abs(h.heading_deg - 90) < 5)
    print("4 m/s to the east, facing it")
    await drone.offboard.stop()
    await drone.action.return_to_launch()
    await wait_for("landed", drone.telemetry.armed(), lambda armed: not armed)
    print("ok")


try:
    asyncio.run(main())
except BaseException:
    # MAVSDK's server would keep the interpreter from ending.
    traceback.print_exc()
    os._exit(1)
