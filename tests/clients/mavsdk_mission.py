"""MAVSDK-Python: upload a mission and a geofence, run the mission, watch its progress.

    python mavsdk_mission.py tcpout://127.0.0.1:5760
"""

import asyncio
import os
import socket
import sys
import traceback

try:
    import mavsdk_grpc as mavsdk
    from mavsdk_grpc.action import ActionError
    from mavsdk_grpc.geofence import FenceType, GeofenceData, Point, Polygon
    from mavsdk_grpc.mission_raw import MissionItem
except ImportError:  # before version 4
    import mavsdk
    from mavsdk.action import ActionError
    from mavsdk.geofence import FenceType, GeofenceData, Point, Polygon
    from mavsdk.mission_raw import MissionItem

LIMIT_S = 150


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


def item(seq, command, lat, lon, altitude_m, frame=6):
    nan = float("nan")
    return MissionItem(
        seq, frame, command, int(seq == 0), 1, 0, 0, 0, nan if command == 16 else 0,
        round(lat * 1e7), round(lon * 1e7), altitude_m, 0,
    )  # fmt: skip


async def main():
    drone = mavsdk.System(port=free_port())
    await drone.connect(system_address=sys.argv[1])
    await wait_for("connected", drone.core.connection_state(), lambda state: state.is_connected)
    # ArduPilot sends nothing unasked.
    telemetry = drone.telemetry
    for set_rate in (telemetry.set_rate_position, telemetry.set_rate_gps_info, telemetry.set_rate_health, telemetry.set_rate_in_air):
        await set_rate(5)
    await wait_for(
        "healthy", drone.telemetry.health(), lambda h: h.is_global_position_ok and h.is_home_position_ok
    )
    home = await wait_for("a position", drone.telemetry.position(), lambda p: True)
    lat, lon = home.latitude_deg, home.longitude_deg

    corners = [(-1, -1), (-1, 1), (1, 1), (1, -1)]
    points = [Point(lat + 0.001 * north, lon + 0.001 * east) for north, east in corners]
    await drone.geofence.upload_geofence(GeofenceData([Polygon(points, FenceType.INCLUSION)], []))
    print("geofence uploaded")

    # ArduPilot's first item is home.
    items = [
        item(0, 16, lat, lon, 0, frame=0),
        item(1, 22, lat, lon, 15),
        item(2, 16, lat + 0.0003, lon, 15),
        item(3, 16, lat + 0.0003, lon + 0.0003, 15),
        item(4, 20, 0, 0, 0),
    ]
    await drone.mission_raw.upload_mission(items)
    stored = await drone.mission_raw.download_mission()
    assert [one.command for one in stored] == [16, 22, 16, 16, 20], stored
    print("mission uploaded and read back")

    await drone.action.hold()
    for _ in range(LIMIT_S):
        try:
            await drone.action.arm()
            break
        except ActionError as error:
            print("arm", error)
            await asyncio.sleep(1)
    # ArduPilot does not leave the ground in AUTO before MISSION_START, which MAVSDK does not send.
    await drone.action.set_takeoff_altitude(10)
    await drone.action.takeoff()
    await wait_for("10 m", drone.telemetry.position(), lambda p: p.relative_altitude_m > 9.5)
    await drone.mission_raw.start_mission()
    await wait_for("item 3", drone.mission_raw.mission_progress(), lambda p: p.current >= 3)
    print("on the way to item 3")
    await wait_for("landed", drone.telemetry.armed(), lambda armed: not armed)
    await drone.mission_raw.clear_mission()
    await drone.geofence.clear_geofence()
    print("ok")


try:
    asyncio.run(main())
except BaseException:
    # MAVSDK's server would keep the interpreter from ending.
    traceback.print_exc()
    os._exit(1)
