//! Parameters with different names across firmware versions.

use mavlink::dialects::ardupilotmega::{MavParamType, PARAM_VALUE_DATA};
use mavlink::types::CharArray;

use super::*;

/// A vehicle with one parameter, which ignores other names.
struct Firmware {
    scene: Scene,
    name: &'static str,
    value: f32,
    /// The number of its answers that are lost.
    losses: usize,
}

impl Firmware {
    fn new(name: &'static str) -> Self {
        Self {
            scene: Scene::new(),
            name,
            value: 0.0,
            losses: 0,
        }
    }

    fn say(&mut self, index: u16) {
        self.scene.hear(MavMessage::PARAM_VALUE(PARAM_VALUE_DATA {
            param_id: CharArray::from(self.name),
            param_value: self.value,
            param_type: MavParamType::MAV_PARAM_TYPE_REAL32,
            param_index: index,
            param_count: 1,
        }));
    }

    /// Advances time while it answers.
    fn pass(&mut self, time: Duration) {
        for step in 0..time.as_millis() / 50 {
            self.scene.pass(ms(50));
            if step % 20 == 0 {
                self.scene.heartbeat(STABILIZE, false);
            }
            for sent in std::mem::take(&mut self.scene.sent) {
                let id = match &sent {
                    Outgoing::Message(MavMessage::PARAM_REQUEST_READ(read)) => read.param_id,
                    Outgoing::Message(MavMessage::PARAM_SET(set)) => set.param_id,
                    _ => continue,
                };
                if id.to_str() != Ok(self.name) {
                    continue;
                }
                if let Outgoing::Message(MavMessage::PARAM_SET(set)) = &sent {
                    self.value = set.param_value;
                }
                if self.losses > 0 {
                    self.losses -= 1;
                } else {
                    self.say(u16::MAX);
                }
            }
        }
    }

    fn set(&mut self, name: &str, value: f64) {
        let name = name.to_owned();
        self.scene.order(
            1,
            "param",
            Command::Parameter(ParameterCommand::Set { name, value }),
        );
        self.pass(ms(5000));
    }

    fn outcome(&self) -> (RowState, String) {
        let last = *self.scene.states(1).last().expect("it has a row");
        (last, self.scene.explanation(1))
    }
}

#[test]
fn a_fault_is_set_by_the_name_that_the_firmware_has() {
    for (has, written, value, stored, says) in [
        (
            "SIM_GPS_DISABLE",
            "SIM_GPS_DISABLE",
            1.0,
            1.0,
            "SIM_GPS_DISABLE = 1",
        ),
        (
            "SIM_GPS1_ENABLE",
            "SIM_GPS_DISABLE",
            1.0,
            0.0,
            "SIM_GPS1_ENABLE = 0 (this vehicle's name for SIM_GPS_DISABLE, with the opposite meaning)",
        ),
        (
            "SIM_GPS_DISABLE",
            "SIM_GPS1_ENABLE",
            0.0,
            1.0,
            "SIM_GPS_DISABLE = 1 (this vehicle's name for SIM_GPS1_ENABLE, with the opposite meaning)",
        ),
        (
            "SIM_GPS1_GLTCH_X",
            "SIM_GPS_GLITCH_X",
            0.001,
            0.001,
            "SIM_GPS1_GLTCH_X = 0.001 (this vehicle's name for SIM_GPS_GLITCH_X)",
        ),
    ] {
        for is_listed in [false, true] {
            let mut vehicle = Firmware::new(has);
            if is_listed {
                vehicle.say(0);
            }
            vehicle.set(written, value);
            assert_eq!(
                vehicle.outcome(),
                (RowState::Done, says.to_owned()),
                "{is_listed}"
            );
            assert_eq!(vehicle.value.to_bits(), f32::to_bits(stored), "{written}");
        }
    }
}

#[test]
fn nothing_is_asked_of_a_vehicle_whose_name_is_known() {
    let mut vehicle = Firmware::new("SIM_GPS1_ENABLE");
    vehicle.say(0);
    vehicle.scene.sent.clear();
    let name = "SIM_GPS_DISABLE".to_owned();
    let command = Command::Parameter(ParameterCommand::Set { name, value: 1.0 });
    vehicle.scene.order(1, "param", command);
    assert!(matches!(
        &vehicle.scene.sent[..],
        [Outgoing::Message(MavMessage::PARAM_SET(set))] if set.param_id.to_str() == Ok("SIM_GPS1_ENABLE")
    ));
}

#[test]
fn an_answer_that_is_lost_is_asked_for_again() {
    let mut vehicle = Firmware::new("SIM_GPS1_ENABLE");
    vehicle.losses = 1;
    vehicle.set("SIM_GPS_DISABLE", 1.0);
    assert_eq!(vehicle.outcome().0, RowState::Done);
    assert_eq!(vehicle.value.to_bits(), 0.0_f32.to_bits());
}

#[test]
fn a_parameter_is_read_by_the_name_that_the_firmware_has() {
    let mut vehicle = Firmware::new("SIM_GPS1_ENABLE");
    vehicle.value = 1.0;
    let name = "SIM_GPS_DISABLE".to_owned();
    vehicle.scene.order(
        1,
        "param",
        Command::Parameter(ParameterCommand::Get { name }),
    );
    vehicle.pass(ms(5000));
    let (state, says) = vehicle.outcome();
    assert_eq!(state, RowState::Done);
    assert!(says.starts_with("SIM_GPS1_ENABLE = 1 (this"), "{says}");
}

#[test]
fn a_vehicle_with_neither_name_refuses_and_names_the_nearest() {
    let mut vehicle = Firmware::new("SIM_GPS_DISABLED");
    // Its list is incomplete, so the vehicle must be queried.
    vehicle.say(u16::MAX);
    vehicle.set("SIM_GPS_DISABLE", 1.0);
    let says = "not sent: the vehicle has neither SIM_GPS_DISABLE nor SIM_GPS1_ENABLE; did you mean SIM_GPS_DISABLED?";
    assert_eq!(vehicle.outcome(), (RowState::Refused, says.to_owned()));
    let mut vehicle = Firmware::new("SIM_GPS_DISABLED");
    vehicle.say(0);
    vehicle.set("SIM_GPS_DISABLE", 1.0);
    let says =
        "not sent: the vehicle has no parameter SIM_GPS_DISABLE; did you mean SIM_GPS_DISABLED?";
    assert_eq!(vehicle.outcome(), (RowState::Refused, says.to_owned()));
}

#[test]
fn what_is_urgent_does_not_wait_for_a_name() {
    let mut vehicle = Firmware::new("NOTHING");
    let name = "SIM_GPS_DISABLE".to_owned();
    let command = Command::Parameter(ParameterCommand::Set { name, value: 1.0 });
    vehicle.scene.order(1, "param", command);
    vehicle
        .scene
        .order(2, "land", Command::Flight(FlightCommand::Land));
    assert_eq!(vehicle.scene.states(1).last(), Some(&RowState::Superseded));
    assert_eq!(vehicle.scene.states(2), [RowState::Sent]);
}

#[test]
fn a_vehicle_that_nobody_asked_is_not_said_to_lack_a_name() {
    let mut vehicle = Firmware::new("SIM_GPS1_ENABLE");
    let name = "NOTHING".to_owned();
    vehicle.scene.order(
        2,
        "param",
        Command::Parameter(ParameterCommand::Get { name }),
    );
    vehicle.set("SIM_GPS_DISABLE", 1.0);
    assert_eq!(vehicle.scene.states(2).last(), Some(&RowState::TimedOut));
    let says = "not sent: expired after 3.5 s in the queue";
    assert_eq!(vehicle.outcome(), (RowState::TimedOut, says.to_owned()));
}

#[test]
fn a_slow_link_is_not_taken_for_a_vehicle_without_the_parameter() {
    let mut vehicle = Firmware::new("SIM_GPS1_ENABLE");
    // With a speed-up, a delay of the link is many times as long in the vehicle's time.
    vehicle.scene.session.vehicle.link.round_trip = Some(ms(2500));
    let name = "SIM_GPS_DISABLE".to_owned();
    let command = Command::Parameter(ParameterCommand::Set { name, value: 1.0 });
    vehicle.scene.order(1, "param", command);
    for _ in 0..100 {
        vehicle.scene.pass(ms(50));
        vehicle.scene.heartbeat(STABILIZE, false);
    }
    assert_eq!(vehicle.outcome().0, RowState::TimedOut);
}
