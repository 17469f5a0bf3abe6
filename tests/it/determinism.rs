//! With the same seed and the same messages at the same simulated times, the vehicles send the same
//! bytes: at any pace, with any number of threads, in a bare world and behind the server.

use std::time::Duration;

use mavlink::dialects::ardupilotmega::{
    COMMAND_LONG_DATA, MISSION_COUNT_DATA, MISSION_ITEM_INT_DATA, MavCmd, MavFrame, MavMessage,
    MavMissionType, PARAM_SET_DATA, PositionTargetTypemask, SET_POSITION_TARGET_LOCAL_NED_DATA,
};
use mavlink::types::CharArray;
use sortie::geo::LatLon;
use sortie::link::{Endpoint, Simulator, step_on_threads};
use sortie::sim::{STEP, Start, World, WorldConfig};
use sortie::wire::{Content, Decoder, Encoder};
use tokio::io::{AsyncReadExt as _, AsyncWriteExt as _, DuplexStream};
use tokio::task::JoinSet;
use tokio_util::sync::CancellationToken;

/// Enough vehicles for the server to share its steps between threads at its highest speed.
const VEHICLES: usize = 21;
/// The simulated time that is compared, in milliseconds.
const COMPARED_MS: u64 = 36_000;
/// The interval at which a server at full speed serves its ground stations, in milliseconds.
const ROUND_MS: u64 = 100;
const HOME: LatLon = LatLon {
    lat_deg: 50.0,
    lon_deg: 30.0,
};

/// Messages to a vehicle in order, with the simulated time in milliseconds.
type Script = Vec<(u64, MavMessage)>;

fn config(seed: u64) -> WorldConfig {
    let first = Start {
        at: HOME,
        altitude_amsl_m: 100.0,
        heading_deg: 30.0,
    };
    WorldConfig {
        seed,
        ..WorldConfig::row(VEHICLES, first)
    }
}

fn command(command: MavCmd, [param1, param2, param7]: [f32; 3]) -> MavMessage {
    MavMessage::COMMAND_LONG(COMMAND_LONG_DATA {
        command,
        param1,
        param2,
        param7,
        target_component: 1,
        ..Default::default()
    })
}

fn set(name: &str, value: f32) -> MavMessage {
    MavMessage::PARAM_SET(PARAM_SET_DATA {
        param_value: value,
        param_id: CharArray::from(name),
        target_component: 1,
        ..Default::default()
    })
}

/// The items of a list, each at an offset north and east of home in metres, sent without waiting
/// for requests.
fn list(from_ms: u64, kind: MavMissionType, items: &[(MavCmd, f32, [f64; 2])]) -> Script {
    let count = MavMessage::MISSION_COUNT(MISSION_COUNT_DATA {
        count: items.len() as u16,
        target_component: 1,
        mission_type: kind,
        ..Default::default()
    });
    let told = items.iter().zip(0u16..).map(move |(item, seq)| {
        let (command, param1, [north_m, east_m]) = *item;
        let (x, y) = HOME.moved(north_m, east_m).to_e7();
        let message = MavMessage::MISSION_ITEM_INT(MISSION_ITEM_INT_DATA {
            command,
            param1,
            x,
            y,
            z: 12.0,
            seq,
            frame: MavFrame::MAV_FRAME_GLOBAL_RELATIVE_ALT,
            autocontinue: 1,
            target_component: 1,
            mission_type: kind,
            ..Default::default()
        });
        (from_ms + ROUND_MS * (u64::from(seq) + 1), message)
    });
    std::iter::once((from_ms, count)).chain(told).collect()
}

/// The mission of a vehicle; two vehicles share each mission, so they meet.
fn mission(vehicle: usize) -> Script {
    let aside_m = (vehicle / 6 * 6) as f64 * 5.0;
    let items = [
        (MavCmd::MAV_CMD_NAV_WAYPOINT, 0.0, [0.0, 0.0]),
        (MavCmd::MAV_CMD_NAV_TAKEOFF, 0.0, [0.0, 0.0]),
        (MavCmd::MAV_CMD_NAV_WAYPOINT, 8.0, [30.0, aside_m + 20.0]),
        (
            MavCmd::MAV_CMD_NAV_LOITER_TURNS,
            1.0,
            [30.0, aside_m + 25.0],
        ),
        (MavCmd::MAV_CMD_NAV_RETURN_TO_LAUNCH, 0.0, [0.0, 0.0]),
    ];
    list(1500, MavMissionType::MAV_MISSION_TYPE_MISSION, &items)
}

fn fence() -> Script {
    let corner = MavCmd::MAV_CMD_NAV_FENCE_POLYGON_VERTEX_INCLUSION;
    let items = [[-50.0, -50.0], [-50.0, 300.0], [25.0, 300.0], [25.0, -50.0]];
    let items = items.map(|at| (corner, 4.0, at));
    list(2500, MavMissionType::MAV_MISSION_TYPE_FENCE, &items)
}

fn goto(p: [f32; 3]) -> MavMessage {
    MavMessage::SET_POSITION_TARGET_LOCAL_NED(SET_POSITION_TARGET_LOCAL_NED_DATA {
        x: p[0],
        y: p[1],
        z: p[2],
        type_mask: PositionTargetTypemask::from_bits_truncate(0x0DF8),
        target_component: 1,
        coordinate_frame: MavFrame::MAV_FRAME_LOCAL_NED,
        ..Default::default()
    })
}

/// Every third vehicle flies a mission, and every fourth one has its fence on. Vehicles without a
/// mission are sent to a place, and then suffer a fault or return.
fn script(vehicle: usize) -> Script {
    let interval = |id| command(MavCmd::MAV_CMD_SET_MESSAGE_INTERVAL, [id, 1e5, 0.0]);
    let mut script: Script = [2.0, 24.0, 26.0, 29.0, 30.0, 33.0, 42.0, 147.0, 168.0, 193.0]
        .into_iter()
        .map(|id| (0, interval(id)))
        .collect();
    let wind = [
        ("SIM_WIND_SPD", 6.0),
        ("SIM_WIND_DIR", 200.0),
        ("SIM_WIND_TURB", 3.0),
    ];
    script.extend(wind.map(|(name, value)| (200, set(name, value))));
    script.extend(mission(vehicle));
    script.extend(fence());
    script.extend([
        (3500, set("FENCE_TYPE", 4.0)),
        (
            3500,
            set("FENCE_ENABLE", f32::from(u8::from(vehicle % 4 == 1))),
        ),
        (4000, command(MavCmd::MAV_CMD_DO_SET_MODE, [1.0, 4.0, 0.0])),
        (
            5000,
            command(MavCmd::MAV_CMD_COMPONENT_ARM_DISARM, [1.0, 0.0, 0.0]),
        ),
    ]);
    if vehicle.is_multiple_of(3) {
        script.push((6000, command(MavCmd::MAV_CMD_MISSION_START, [0.0; 3])));
        return script;
    }
    let faults = [
        set("SIM_ENGINE_MUL", 0.0),
        set("SIM_GPS_DISABLE", 1.0),
        set("SIM_BATT_VOLTAGE", 9.9),
        set("SIM_GPS_GLITCH_X", 0.001),
        set("SIM_BARO_GLITCH", 5.0),
        command(MavCmd::MAV_CMD_DO_SET_MODE, [1.0, 6.0, 0.0]),
    ];
    let fault = faults[(vehicle - vehicle / 3) % faults.len()].clone();
    script.extend([
        (6000, command(MavCmd::MAV_CMD_NAV_TAKEOFF, [0.0, 0.0, 8.0])),
        (16_000, goto([40.0, 10.0, -12.0])),
        (20_000, fault),
    ]);
    script
}

fn encoded(encoder: &mut Encoder, message: &MavMessage) -> Vec<u8> {
    let mut bytes = Vec::new();
    encoder.encode_message(message, &mut bytes);
    bytes
}

/// The bytes that each vehicle of a bare world sends; the world is stepped on several threads and read every few
/// steps.
fn bare(seed: u64, threads: usize, steps_per_look: u64) -> (World, Vec<Vec<u8>>) {
    let mut world = World::new(&config(seed));
    let ports: Vec<_> = (0..VEHICLES)
        .map(|vehicle| world.connect(vehicle))
        .collect();
    let mut scripts: Vec<_> = (0..VEHICLES)
        .map(|vehicle| (Encoder::new(255, 190), script(vehicle)))
        .collect();
    let mut said = vec![Vec::new(); VEHICLES];
    let steps = COMPARED_MS / STEP.as_millis() as u64;
    for step in 0..steps {
        for ((encoder, script), port) in scripts.iter_mut().zip(&ports) {
            let now_ms = world.now().as_millis() as u64;
            let due = script.partition_point(|(at_ms, _)| *at_ms <= now_ms);
            for (_, message) in script.drain(..due) {
                world.receive(*port, &encoded(encoder, &message));
            }
        }
        step_on_threads(&mut world, threads);
        if (step + 1) % steps_per_look == 0 {
            for (port, said) in ports.iter().zip(&mut said) {
                world.take_output(*port, said);
            }
        }
    }
    (world, said)
}

#[test]
fn pace_and_threads_change_no_byte_and_the_seed_does() {
    let (world, said) = bare(7, 1, 1);
    for (vehicle, said) in said.iter().enumerate() {
        assert!(said.len() > 50_000, "vehicle {vehicle} said little");
    }
    let truths: Vec<_> = (0..VEHICLES).map(|vehicle| world.truth(vehicle)).collect();
    assert!(
        truths.iter().any(|t| t.mode == 3 && !t.on_ground),
        "nobody flies a mission"
    );
    for mode in [4, 6, 9] {
        assert!(truths.iter().any(|t| t.mode == mode), "nobody is in {mode}");
    }
    assert!(truths.iter().any(|t| t.on_ground), "no motor failed");
    assert!(!world.collisions().is_empty(), "nobody met");
    for (threads, steps_per_look) in [(1, 10), (2, 1), (3, 100), (64, 10)] {
        let (_, again) = bare(7, threads, steps_per_look);
        assert!(
            again == said,
            "{threads} threads, a look every {steps_per_look} steps"
        );
    }
    let (_, other) = bare(8, 1, 10);
    assert!(other != said, "the seed changes nothing");
}

/// A ground station that sends each message when the vehicle's clock reaches its time; returns the received bytes.
async fn station(mut pipe: DuplexStream, mut script: Script) -> Vec<u8> {
    let (mut encoder, mut decoder) = (Encoder::new(255, 190), Decoder::new());
    let (mut heard, mut now_ms) = (Vec::new(), 0);
    let mut buffer = vec![0; 1 << 16];
    while now_ms < COMPARED_MS + 10 * ROUND_MS {
        let due = script.partition_point(|(at_ms, _)| *at_ms <= now_ms);
        for (_, message) in script.drain(..due) {
            let bytes = encoded(&mut encoder, &message);
            pipe.write_all(&bytes).await.expect("it reads");
        }
        let len = pipe.read(&mut buffer).await.expect("it talks");
        heard.extend_from_slice(&buffer[..len]);
        decoder.push(&buffer[..len]);
        while let Some(frame) = decoder.next_frame() {
            if let Content::Message(MavMessage::SYSTEM_TIME(data)) = frame.content
                && u64::from(data.time_boot_ms).is_multiple_of(ROUND_MS)
            {
                now_ms = data.time_boot_ms.into();
            }
        }
    }
    heard
}

async fn served(seed: u64, speedup: f64) -> Vec<Vec<u8>> {
    let cancel = CancellationToken::new();
    let world = World::new(&config(seed));
    let started = Simulator::start(world, speedup, &[Endpoint::Pipes], cancel.clone()).await;
    let mut stations = JoinSet::new();
    for (vehicle, pipe) in started.expect("it starts").pipes.into_iter().enumerate() {
        stations.spawn(async move { (vehicle, station(pipe, script(vehicle)).await) });
    }
    let all = tokio::time::timeout(Duration::from_secs(3600), stations.join_all()).await;
    cancel.cancel();
    let mut all = all.expect("the vehicles fly");
    all.sort_unstable_by_key(|(vehicle, _)| *vehicle);
    all.into_iter().map(|(_, heard)| heard).collect()
}

#[tokio::test(start_paused = true)]
async fn a_server_at_any_speed_says_what_the_bare_world_says() {
    let (_, said) = bare(7, 1, 1);
    for speedup in [1.0, 10.0, 1000.0] {
        let heard = served(7, speedup).await;
        for (vehicle, (heard, said)) in heard.iter().zip(&said).enumerate() {
            let same = heard.iter().zip(said).take_while(|(a, b)| a == b).count();
            assert_eq!(same, said.len(), "vehicle {vehicle} at speed {speedup}");
        }
    }
}
