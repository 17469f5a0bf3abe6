//! Drives beside those of a real `ArduRover` 4.6 in SITL: the same commands after the same times, and the paths
//! compared at the recorded times.

use mavlink::dialects::ardupilotmega::{
    MavCmd, MavFrame, MavMessage, PositionTargetTypemask, RC_CHANNELS_OVERRIDE_DATA,
    SET_POSITION_TARGET_LOCAL_NED_DATA,
};

use super::driving::{enter, guided, speed};
use super::*;
use sortie_geo::wrap_180;

/// A turn rate and a velocity; nothing else.
const VELOCITY_AND_RATE: u16 = 0x05C7;

/// One row of a recording: seconds, metres north and east, metres per second, degrees.
struct Row {
    t_s: f64,
    at_m: [f64; 2],
    speed_m_s: f64,
    heading_deg: f64,
}

fn rows(text: &str) -> Vec<Row> {
    let numbers = |line: &str| -> Vec<f64> {
        line.split(',')
            .map(|word| word.parse().expect("a number"))
            .collect()
    };
    let rows = text.lines().skip(1).map(numbers);
    rows.map(|row| Row {
        t_s: row[0],
        at_m: [row[1], row[2]],
        speed_m_s: row[3],
        heading_deg: row[4],
    })
    .collect()
}

/// The root mean squares of the differences of place, speed and heading.
#[derive(Debug)]
struct Differences {
    place_m: f64,
    speed_m_s: f64,
    heading_deg: f64,
}

/// Steps through a recording, with `each` before every step; places are relative to those at its begin.
fn beside(ground: &mut Ground, recording: &str, mut each: impl FnMut(&mut Ground)) -> Differences {
    let rows = rows(recording);
    let first = rows[0].at_m;
    let begin = ground.truth();
    let mut elapsed = 0.0;
    let mut sums = [0.0; 3];
    for row in &rows {
        while elapsed < row.t_s {
            each(ground);
            ground.step();
            elapsed += 0.01;
        }
        let truth = ground.truth();
        let [north, east] = [0, 1].map(|axis| {
            let way = truth.position_ned_m[axis] - begin.position_ned_m[axis];
            way - (row.at_m[axis] - first[axis])
        });
        let speed = speed(&truth);
        sums[0] += north * north + east * east;
        let faster = speed - row.speed_m_s;
        sums[1] += faster * faster;
        // The heading of a standing vehicle drifts with the real estimate.
        if row.speed_m_s > 0.5 {
            let turned = wrap_180(truth.heading_deg - row.heading_deg);
            sums[2] += turned * turned;
        }
    }
    let [place_m, speed_m_s, heading_deg] = sums.map(|sum| (sum / rows.len() as f64).sqrt());
    Differences {
        place_m,
        speed_m_s,
        heading_deg,
    }
}

/// Sends something ten times a second.
fn repeated(mut send: impl FnMut(&mut Ground)) -> impl FnMut(&mut Ground) {
    let mut steps = 0;
    move |ground| {
        if steps % 10 == 0 {
            send(ground);
        }
        steps += 1;
    }
}

fn assert_close(what: &str, got: &Differences, most: [f64; 3]) {
    println!("{what}: {got:.2?}");
    let [place_m, speed_m_s, heading_deg] = most;
    assert!(got.place_m < place_m, "{what}: {got:?}");
    assert!(got.speed_m_s < speed_m_s, "{what}: {got:?}");
    assert!(got.heading_deg < heading_deg, "{what}: {got:?}");
}

#[test]
fn a_drive_to_a_place_is_as_recorded() {
    for (chassis, recording, most) in [
        (
            Chassis::Ackermann,
            include_str!("driven/rover_goto.csv"),
            [1.0, 0.2, 5.0],
        ),
        (
            Chassis::Skid,
            include_str!("driven/skid_goto.csv"),
            [1.0, 0.2, 5.0],
        ),
        (
            Chassis::Boat,
            include_str!("driven/boat_goto.csv"),
            [1.0, 0.2, 5.0],
        ),
    ] {
        let mut ground = guided(chassis);
        ground.run(1.0);
        let goal = if chassis == Chassis::Boat {
            [30.0, 0.0, 0.0]
        } else {
            [40.0, 10.0, 0.0]
        };
        ground.goto(goal);
        let got = beside(&mut ground, recording, |_| ());
        assert_close(&format!("{chassis:?} goto"), &got, most);
        if chassis == Chassis::Skid {
            ground.goto([0.0, 0.0, 0.0]);
            let got = beside(&mut ground, include_str!("driven/skid_back.csv"), |_| ());
            assert_close("turn on the spot and back", &got, [1.0, 0.2, 5.0]);
        }
    }
}

#[test]
fn setpoints_are_driven_as_recorded() {
    let mut ground = guided(Chassis::Ackermann);
    ground.run(1.0);
    let east = repeated(|ground: &mut Ground| ground.fly([0.0, 2.0, 0.0]));
    let got = beside(&mut ground, include_str!("driven/rover_velocity.csv"), east);
    assert_close("velocity", &got, [1.0, 0.2, 5.0]);
    let got = beside(
        &mut ground,
        include_str!("driven/rover_silence.csv"),
        |_| (),
    );
    assert_close("silence", &got, [1.0, 0.2, 5.0]);
    let turn = repeated(|ground: &mut Ground| {
        ground.say(MavMessage::SET_POSITION_TARGET_LOCAL_NED(
            SET_POSITION_TARGET_LOCAL_NED_DATA {
                vx: 2.0,
                yaw_rate: 0.5,
                type_mask: PositionTargetTypemask::from_bits_truncate(VELOCITY_AND_RATE),
                target_system: 1,
                target_component: 1,
                coordinate_frame: MavFrame::MAV_FRAME_LOCAL_NED,
                ..Default::default()
            },
        ));
    });
    let got = beside(&mut ground, include_str!("driven/rover_turn.csv"), turn);
    assert_close("turn", &got, [1.0, 0.2, 5.0]);
}

#[test]
fn sticks_drive_as_recorded() {
    let mut ground = guided(Chassis::Ackermann);
    enter(&mut ground, 0.0);
    for (what, [steering, throttle], recording) in [
        (
            "throttle",
            [1500, 1700],
            include_str!("driven/rover_manual.csv"),
        ),
        (
            "steering",
            [1700, 1600],
            include_str!("driven/rover_steer.csv"),
        ),
        (
            "coast",
            [1500, 1500],
            include_str!("driven/rover_coast.csv"),
        ),
    ] {
        let sticks = repeated(|ground: &mut Ground| {
            ground.say(MavMessage::RC_CHANNELS_OVERRIDE(
                RC_CHANNELS_OVERRIDE_DATA {
                    chan1_raw: steering,
                    chan3_raw: throttle,
                    target_system: 1,
                    target_component: 1,
                    ..Default::default()
                },
            ));
        });
        let got = beside(&mut ground, recording, sticks);
        assert_close(what, &got, [2.0, 0.3, 15.0]);
    }
}

#[test]
fn a_mission_is_as_recorded() {
    let mut ground = guided(Chassis::Ackermann);
    let at = |north: f64, east: f64, command: u16, first: f32| {
        let (x, y) = start().at.moved(north, east).to_e7();
        Item {
            command,
            params: [first, 0.0, 0.0, 0.0],
            frame: crate::frame::GLOBAL_RELATIVE_ALT,
            x,
            y,
            ..Item::default()
        }
    };
    let act = |command: u16, params: [f32; 4]| Item {
        command,
        params,
        ..Item::default()
    };
    let items = [
        at(40.0, 0.0, 16, 0.0),
        at(40.0, 40.0, 16, 0.0),
        act(178, [1.0, 2.0, -1.0, 0.0]),
        at(0.0, 40.0, 16, 3.0),
        act(93, [2.0, -1.0, -1.0, -1.0]),
        act(115, [90.0, 0.0, 0.0, 0.0]),
        at(0.0, 0.0, 19, 2.0),
        act(20, [0.0; 4]),
    ];
    assert!(ground.world.load(0, ListKind::Plan, &items));
    let first = ground.heard.len();
    ground.long(MavCmd::MAV_CMD_MISSION_START, [0.0]);
    let got = beside(
        &mut ground,
        include_str!("driven/rover_mission.csv"),
        |_| (),
    );
    let said: Vec<String> = ground
        .messages_since(first)
        .into_iter()
        .filter_map(|message| match message {
            MavMessage::STATUSTEXT(text) => text.text.to_str().ok().map(str::to_owned),
            _ => None,
        })
        .collect();
    assert_eq!(
        said,
        [
            "Mission: 1 WP",
            "Reached waypoint #1",
            "Mission: 2 WP",
            "Reached waypoint #2",
            "Mission: 3 ChangeSpeed",
            "speed: 2.0 m/s",
            "Mission: 4 WP",
            "Reached waypoint #4. Loiter for 3 seconds",
            "Mission: 5 Delay",
            "Delaying 2 sec",
            "Mission: 6 CondYaw",
            "Mission: 7 LoitTime",
            "Skipping invalid cmd #115",
            "Reached waypoint #7. Loiter for 2 seconds",
            "Finished active loiter",
            "Mission: 8 RTL",
            "Mission Complete",
        ]
    );
    assert_close("mission", &got, [1.5, 0.4, 5.0]);
}
