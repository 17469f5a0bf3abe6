//! Velocities, which PX4 takes only in OFFBOARD.

use std::time::Duration;

use sortie::commands::{ArmingCommand, Command, FlightCommand, MotionCommand};
use sortie::ledger::RowState;

use super::stand_in::{OFFBOARD, Unwilling};
use super::{Talk, takeoff};

fn velocity(north_m_s: f64, seconds: u64) -> Command {
    Command::Motion(MotionCommand::Velocity {
        ned_m_s: [north_m_s, 0.0, 0.0],
        lasting: Duration::from_secs(seconds),
    })
}

/// A talk with a vehicle that hovers 8 m above home.
fn in_the_air() -> Talk {
    let mut talk = Talk::new();
    talk.order(1, "arm", Command::Arming(ArmingCommand::Arm));
    talk.order(2, "takeoff", takeoff(8.0));
    talk.pass(6);
    assert_eq!(talk.last(2), Some(RowState::Done));
    talk
}

#[test]
fn a_velocity_is_flown_in_offboard_and_ends_in_loiter() {
    let mut talk = in_the_air();
    let start = talk.px4.at_e7().0;
    talk.order(3, "velocity", velocity(2.0, 5));
    assert_eq!(talk.mode(), "AUTO.LOITER", "setpoints come first");
    talk.pass(3);
    assert_eq!(
        (talk.mode(), talk.last(3)),
        ("OFFBOARD".into(), Some(RowState::Accepted)),
        "{}",
        talk.explanation(3)
    );
    talk.pass(2);
    assert_eq!(talk.mode(), "OFFBOARD");
    talk.pass(4);
    assert_eq!(
        (talk.mode(), talk.last(3)),
        ("AUTO.LOITER".into(), Some(RowState::Done)),
        "{}",
        talk.explanation(3)
    );
    let moved_m = f64::from(talk.px4.at_e7().0 - start) / 90.0;
    assert!((8.0..13.0).contains(&moved_m), "{moved_m}");
    talk.pass(5);
    assert_eq!(talk.last(3), Some(RowState::Done), "it stays done");
}

#[test]
fn a_new_velocity_takes_over_in_offboard_and_a_hold_ends_it() {
    let mut talk = in_the_air();
    talk.order(3, "velocity", velocity(2.0, 60));
    talk.pass(4);
    talk.order(4, "velocity", velocity(-3.0, 60));
    talk.pass(1);
    assert_eq!(talk.last(3), Some(RowState::Superseded));
    assert_eq!(
        (talk.mode(), talk.px4.velocity_m_s()),
        ("OFFBOARD".into(), [-3.0, 0.0, 0.0])
    );
    talk.pass(20);
    assert_eq!(talk.last(4), Some(RowState::Accepted));
    talk.order(5, "hold", Command::Flight(FlightCommand::Hold));
    talk.pass(2);
    assert_eq!(
        (talk.mode(), talk.last(4), talk.last(5)),
        (
            "AUTO.LOITER".into(),
            Some(RowState::Superseded),
            Some(RowState::Done)
        )
    );
}

#[test]
fn a_refused_or_lost_offboard_ends_the_velocity_with_the_reason() {
    let mut talk = in_the_air();
    talk.px4.unwilling = Some(Unwilling::EnterOffboard);
    talk.order(3, "velocity", velocity(2.0, 5));
    talk.pass(12);
    assert_eq!(talk.last(3), Some(RowState::Refused));
    assert_eq!(talk.mode(), "AUTO.LOITER");
    talk.px4.unwilling = None;
    talk.order(4, "velocity", velocity(2.0, 30));
    talk.pass(4);
    // A failsafe, or a pilot, leaves the mode.
    talk.px4.mode = (4, 5);
    talk.pass(1);
    assert_eq!(talk.last(4), Some(RowState::Overtaken));
    assert_eq!(talk.explanation(4), "by AUTO.RTL");
    talk.px4.mode = OFFBOARD;
    talk.pass(3);
    assert_eq!(talk.mode(), "POSCTL", "setpoints are no longer sent");
}

#[test]
fn a_vehicle_that_stays_in_offboard_is_not_done() {
    let mut talk = in_the_air();
    talk.px4.unwilling = Some(Unwilling::HearLoiter);
    talk.order(3, "velocity", velocity(2.0, 5));
    talk.pass(20);
    assert_eq!(talk.last(3), Some(RowState::NoEffect));
    assert!(talk.explanation(3).contains("OFFBOARD"));
}
