//! Flights by stick, compared with figures measured with `RC_CHANNELS_OVERRIDE` on an `ArduCopter` 4.6 SITL.

use mavlink::dialects::ardupilotmega::{
    AttitudeTargetTypemask, MANUAL_CONTROL_DATA, MavCmd, MavMessage, MavResult,
    RC_CHANNELS_OVERRIDE_DATA, SET_ATTITUDE_TARGET_DATA,
};

use super::*;
use sortie_geo::maths;

const MIDDLE: u16 = 1500;

/// Holds roll, pitch, throttle and yaw for a while.
fn hold(ground: &mut Ground, sticks: [u16; 4], seconds: f64) {
    for _ in 0..(seconds / 0.1).round() as usize {
        ground.say(MavMessage::RC_CHANNELS_OVERRIDE(
            RC_CHANNELS_OVERRIDE_DATA {
                chan1_raw: sticks[0],
                chan2_raw: sticks[1],
                chan3_raw: sticks[2],
                chan4_raw: sticks[3],
                chan5_raw: u16::MAX,
                chan6_raw: u16::MAX,
                chan7_raw: u16::MAX,
                chan8_raw: u16::MAX,
                target_system: 1,
                target_component: 1,
                ..Default::default()
            },
        ));
        ground.run(0.1);
    }
}

const CENTRED: [u16; 4] = [MIDDLE; 4];

fn mode(ground: &mut Ground, number: f32) {
    let result = ground.long(MavCmd::MAV_CMD_DO_SET_MODE, [1.0, number]);
    assert_eq!(result, MavResult::MAV_RESULT_ACCEPTED);
}

fn close(what: &str, got: f64, measured: f64, within: f64) {
    println!("{what}: {got:.2}, measured {measured:.2}");
    assert!(
        (got - measured).abs() <= within,
        "{what}: {got:.2}, measured {measured:.2}"
    );
}

fn north(ground: &Ground) -> (f64, f64) {
    let truth = ground.truth();
    (truth.position_ned_m[0], truth.velocity_ned_m_s[0])
}

#[test]
fn loiter_takes_off_climbs_and_stops_by_the_throttle_stick() {
    let mut ground = Ground::new();
    ground.run(2.0);
    mode(&mut ground, 5.0);
    hold(&mut ground, [MIDDLE, MIDDLE, 1000, MIDDLE], 0.5);
    ground.long(MavCmd::MAV_CMD_COMPONENT_ARM_DISARM, [1.0]);
    // The motors spin up two seconds after arming.
    hold(&mut ground, [MIDDLE, MIDDLE, 1000, MIDDLE], 2.0);
    hold(&mut ground, [MIDDLE, MIDDLE, 1700, MIDDLE], 8.0);
    close(
        "climb at 1700",
        -ground.truth().velocity_ned_m_s[2],
        0.64,
        0.03,
    );
    close("height", -ground.truth().position_ned_m[2], 3.97, 0.5);
    hold(&mut ground, CENTRED, 4.0);
    close("stopped", ground.truth().velocity_ned_m_s[2], 0.0, 0.05);
    let before = ground.truth().position_ned_m[2];
    hold(&mut ground, [MIDDLE, MIDDLE, 2000, MIDDLE], 5.0);
    close(
        "climb at 2000",
        -ground.truth().velocity_ned_m_s[2],
        2.48,
        0.06,
    );
    close("way", before - ground.truth().position_ned_m[2], 10.35, 1.0);
}

#[test]
fn loiter_accelerates_coasts_and_brakes_like_the_real_one() {
    let mut ground = Ground::hovering(10.0);
    hold(&mut ground, CENTRED, 0.1);
    mode(&mut ground, 5.0);
    hold(&mut ground, CENTRED, 1.0);
    let from = north(&ground).0;
    for (seconds, speed) in [
        (1.1, 2.77),
        (1.1, 5.30),
        (1.1, 7.17),
        (1.1, 8.59),
        (2.2, 9.97),
    ] {
        hold(&mut ground, [MIDDLE, 1000, MIDDLE, MIDDLE], seconds);
        close("full stick", north(&ground).1, speed, 0.5);
    }
    hold(&mut ground, [MIDDLE, 1000, MIDDLE, MIDDLE], 3.5);
    close("top speed", north(&ground).1, 10.26, 0.2);
    close("way", north(&ground).0 - from, 77.1, 4.0);
    let from = north(&ground).0;
    for (speed, within) in [(9.86, 0.5), (5.88, 0.8), (1.72, 0.8), (0.12, 0.4)] {
        hold(&mut ground, CENTRED, 1.1);
        close("let go", north(&ground).1, speed, within);
    }
    hold(&mut ground, CENTRED, 5.0);
    close("stopping distance", north(&ground).0 - from, 24.8, 2.5);
}

/// A vehicle that is ready, and armed in a mode with the throttle down.
fn armed_in(number: f32) -> Ground {
    let mut ground = Ground::new();
    ground.run(2.0);
    mode(&mut ground, number);
    hold(&mut ground, [MIDDLE, MIDDLE, 1000, MIDDLE], 1.0);
    let result = ground.long(MavCmd::MAV_CMD_COMPONENT_ARM_DISARM, [1.0]);
    assert_eq!(result, MavResult::MAV_RESULT_ACCEPTED);
    ground
}

#[test]
fn the_motors_wait_for_two_seconds_after_arming() {
    let lifted = |wait_s: f64| {
        let mut ground = armed_in(5.0);
        hold(&mut ground, [MIDDLE, MIDDLE, 1000, MIDDLE], wait_s);
        let mut elapsed = 0.0;
        while ground.truth().position_ned_m[2] > -0.3 {
            hold(&mut ground, [MIDDLE, MIDDLE, 1900, MIDDLE], 0.1);
            elapsed += 0.1;
        }
        elapsed
    };
    close("at once", lifted(0.0), 4.0, 0.3);
    close("after 3 s", lifted(3.0), 2.2, 0.3);
}

#[test]
fn a_touch_of_the_throttle_takes_off_to_the_pilots_height() {
    let mut ground = armed_in(16.0);
    ground.set("PILOT_TKOFF_ALT", 700.0);
    hold(&mut ground, [MIDDLE, MIDDLE, 1000, MIDDLE], 2.0);
    hold(&mut ground, [MIDDLE, MIDDLE, 1710, MIDDLE], 0.5);
    hold(&mut ground, CENTRED, 12.0);
    close("height", -ground.truth().position_ned_m[2], 7.2, 0.3);
}

#[test]
fn a_raised_throttle_in_stabilize_stays_and_the_air_limits_the_climb() {
    let mut ground = armed_in(0.0);
    hold(&mut ground, [MIDDLE, MIDDLE, 1000, MIDDLE], 2.0);
    hold(&mut ground, [MIDDLE, MIDDLE, 1700, MIDDLE], 4.0);
    close("throttle", ground.truth().throttle, 0.59, 0.02);
    hold(&mut ground, [MIDDLE, MIDDLE, 1700, MIDDLE], 3.8);
    close("throttle stays", ground.truth().throttle, 0.59, 0.02);
    close("climb", -ground.truth().velocity_ned_m_s[2], 8.7, 0.6);
    close("height", -ground.truth().position_ned_m[2], 51.0, 5.0);
}

#[test]
fn the_yaw_stick_turns_at_the_pilots_rate() {
    let mut ground = Ground::hovering(10.0);
    hold(&mut ground, CENTRED, 0.1);
    mode(&mut ground, 5.0);
    for (stick, rate) in [(2000, 206.0), (1600, 33.75)] {
        hold(&mut ground, [MIDDLE, MIDDLE, MIDDLE, stick], 2.0);
        let before = ground.truth().heading_deg;
        hold(&mut ground, [MIDDLE, MIDDLE, MIDDLE, stick], 0.2);
        let turned = (ground.truth().heading_deg - before).rem_euclid(360.0);
        close("rate", turned / 0.2, rate, 0.03 * rate);
        hold(&mut ground, CENTRED, 3.0);
    }
    let before = ground.truth().heading_deg;
    hold(&mut ground, CENTRED, 1.0);
    close("still", ground.truth().heading_deg, before, 0.5);
}

#[test]
fn altitude_hold_leans_and_drifts_on_while_position_hold_brakes() {
    for (number, coasting, stopped) in [(2.0, 1.6, false), (16.0, 0.08, true)] {
        let mut ground = Ground::hovering(10.0);
        hold(&mut ground, CENTRED, 0.1);
        mode(&mut ground, number);
        hold(&mut ground, CENTRED, 1.0);
        hold(&mut ground, [MIDDLE, 1300, MIDDLE, MIDDLE], 6.0);
        close("lean", -ground.truth().pitch_deg, 11.26, 0.3);
        close("speed", north(&ground).1, 4.57, 0.35);
        hold(&mut ground, CENTRED, 4.0);
        close("coasting", north(&ground).1, coasting, 0.5);
        close("height", -ground.truth().position_ned_m[2], 10.0, 0.3);
        hold(&mut ground, CENTRED, 4.0);
        assert_eq!(
            north(&ground).1.abs() < 0.15,
            stopped,
            "{}",
            north(&ground).1
        );
    }
}

#[test]
fn stabilize_hovers_at_the_middle_of_the_throttle_and_falls_below_it() {
    let mut ground = Ground::hovering(30.0);
    ground.set("MOT_THST_HOVER", 0.36);
    hold(&mut ground, CENTRED, 0.1);
    mode(&mut ground, 0.0);
    hold(&mut ground, CENTRED, 2.0);
    close("hover", ground.truth().velocity_ned_m_s[2], 0.02, 0.1);
    hold(&mut ground, [MIDDLE, MIDDLE, 1400, MIDDLE], 1.0);
    close("sinks", ground.truth().velocity_ned_m_s[2], 2.12, 0.4);
    hold(&mut ground, [MIDDLE, MIDDLE, 1400, MIDDLE], 1.0);
    close("sinks on", ground.truth().velocity_ned_m_s[2], 3.65, 0.6);
    hold(&mut ground, [1600, MIDDLE, 1500, MIDDLE], 1.0);
    close("leans", ground.truth().roll_deg, 5.0, 0.5);
}

#[test]
fn acro_and_drift_obey_the_sticks_too() {
    let mut ground = Ground::hovering(30.0);
    hold(&mut ground, CENTRED, 0.1);
    mode(&mut ground, 1.0);
    hold(&mut ground, [1600, MIDDLE, MIDDLE, MIDDLE], 0.6);
    close("roll after 0.6 s", ground.truth().roll_deg, 19.0, 7.0);
    hold(&mut ground, CENTRED, 1.0);
    close("levels slowly", ground.truth().roll_deg, 8.0, 4.0);

    let mut ground = Ground::hovering(30.0);
    hold(&mut ground, CENTRED, 0.1);
    mode(&mut ground, 11.0);
    hold(&mut ground, [MIDDLE, 1300, MIDDLE, MIDDLE], 6.0);
    close("drift forward", north(&ground).1, 4.6, 0.6);
    hold(&mut ground, CENTRED, 4.0);
    close("drift brakes", north(&ground).1, 0.0, 0.3);
}

#[test]
fn sticks_arm_switch_modes_and_move_a_landing() {
    let mut ground = Ground::new();
    ground.heartbeat();
    ground.run(2.0);
    hold(&mut ground, [MIDDLE, MIDDLE, 1000, 2000], 2.5);
    assert!(ground.truth().armed);

    let mut ground = Ground::hovering(10.0);
    let switch = |ground: &mut Ground, pulse_us: u16, seconds: f64| {
        for _ in 0..(seconds * 10.0) as usize {
            let data = RC_CHANNELS_OVERRIDE_DATA {
                chan1_raw: MIDDLE,
                chan2_raw: MIDDLE,
                chan3_raw: MIDDLE,
                chan4_raw: MIDDLE,
                chan5_raw: pulse_us,
                target_system: 1,
                ..Default::default()
            };
            ground.say(MavMessage::RC_CHANNELS_OVERRIDE(data));
            ground.run(0.1);
        }
    };
    switch(&mut ground, 1100, 1.0);
    assert_eq!(ground.truth().mode, 7, "FLTMODE1");
    switch(&mut ground, 0, 1.0);
    assert_eq!(
        ground.truth().mode,
        0,
        "FLTMODE6 of the transmitter's own 1800"
    );
    mode(&mut ground, 9.0);
    hold(&mut ground, [MIDDLE, 1300, MIDDLE, MIDDLE], 4.0);
    let speed = ground.truth().velocity_ned_m_s;
    close(
        "moves a landing",
        maths::hypot(speed[0], speed[1]),
        0.47,
        0.05,
    );
}

#[test]
fn manual_control_moves_the_channels_and_a_stranger_does_not() {
    let mut ground = Ground::new();
    ground.run(2.0);
    let control = |target| {
        MavMessage::MANUAL_CONTROL(MANUAL_CONTROL_DATA {
            x: 500,
            y: 200,
            z: 600,
            r: -100,
            target,
            ..Default::default()
        })
    };
    ground.say(control(1));
    let channels = |ground: &Ground| {
        let sticks = ground.world.slots[0].autopilot.vehicle.sticks();
        sticks.channels_us[..4].to_vec()
    };
    assert_eq!(channels(&ground), [1600, 1250, 1600, 1450]);
    ground.run(3.1);
    assert_eq!(channels(&ground), [1500, 1500, 1000, 1500], "3 s later");
    ground.say(control(7));
    assert_eq!(channels(&ground), [1500, 1500, 1000, 1500], "for another");
}

#[test]
fn attitudes_hold_the_height_and_level_without_braking_when_they_end() {
    let mut ground = Ground::hovering(10.0);
    let half = (-10f64).to_radians() / 2.0;
    let ask = |thrust: f32, pitched: bool| {
        let q = if pitched {
            [maths::cos(half) as f32, 0.0, maths::sin(half) as f32, 0.0]
        } else {
            [1.0, 0.0, 0.0, 0.0]
        };
        MavMessage::SET_ATTITUDE_TARGET(SET_ATTITUDE_TARGET_DATA {
            q,
            thrust,
            target_system: 1,
            type_mask: AttitudeTargetTypemask::from_bits_truncate(7),
            ..Default::default()
        })
    };
    for _ in 0..20 {
        ground.say(ask(0.5, true));
        ground.run(0.2);
    }
    close("speed after 4 s", north(&ground).1, 3.65, 0.4);
    close("pitch", ground.truth().pitch_deg, -10.0, 0.3);
    close("height", -ground.truth().position_ned_m[2], 10.0, 0.2);
    ground.run(6.0);
    close("drifts on", north(&ground).1, 1.65, 0.5);
    close("level", ground.truth().pitch_deg, 0.0, 0.3);
    for _ in 0..20 {
        ground.say(ask(0.75, false));
        ground.run(0.2);
    }
    close("climbs", -ground.truth().velocity_ned_m_s[2], 1.24, 0.08);
    ground.run(5.0);
    close("stops", ground.truth().velocity_ned_m_s[2], 0.0, 0.08);
}

#[test]
fn a_circle_listens_to_the_pitch_stick() {
    let mut ground = Ground::hovering(10.0);
    hold(&mut ground, CENTRED, 0.1);
    mode(&mut ground, 7.0);
    hold(&mut ground, CENTRED, 15.0);
    let speed = |ground: &Ground| {
        let v = ground.truth().velocity_ned_m_s;
        maths::hypot(v[0], v[1])
    };
    close("speed at 10 m and 20 degrees/s", speed(&ground), 3.35, 0.3);
    hold(&mut ground, [MIDDLE, 1200, MIDDLE, MIDDLE], 1.2);
    hold(&mut ground, CENTRED, 12.0);
    assert!(speed(&ground) < 2.2, "smaller: {}", speed(&ground));
}
