//! Changes of a key against a scripted vehicle and recorded keys.

use std::sync::Mutex;

use mavlink::dialects::ardupilotmega::{
    HEARTBEAT_DATA, MavAutopilot, MavModeFlag, MavState, MavType, SETUP_SIGNING_DATA,
};
use proptest::prelude::*;

use super::*;
use crate::language;
use crate::ledger::EntryId;
use crate::vehicle::{Heartbeat, Mode, SystemStatus, VehicleClass};

/// The requests that the key desk received.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Call {
    Begin,
    Send(SentKey),
    Proved,
}

#[derive(Debug, Default)]
struct Desk {
    calls: Mutex<Vec<Call>>,
    fails: bool,
    requires: bool,
}

impl Desk {
    fn note(&self, call: Call) {
        self.calls.lock().expect("no panic").push(call);
    }

    fn calls(&self) -> Vec<Call> {
        self.calls.lock().expect("no panic").clone()
    }
}

impl KeyDesk for Desk {
    fn begin(&self, _: SystemId, _: SigningChange) -> Result<(), Text> {
        self.note(Call::Begin);
        if self.fails {
            Err("the disk is full".into())
        } else {
            Ok(())
        }
    }

    fn requires_signatures(&self) -> bool {
        self.requires
    }

    fn message(&self, vehicle: MavAddress, which: SentKey) -> Option<Outgoing> {
        self.note(Call::Send(which));
        let message = MavMessage::SETUP_SIGNING(SETUP_SIGNING_DATA {
            target_system: vehicle.system,
            ..SETUP_SIGNING_DATA::default()
        });
        Some(message.into())
    }

    fn proved(&self, _: SystemId, _: SigningChange) -> Result<(), Text> {
        self.note(Call::Proved);
        Ok(())
    }
}

/// The signing of vehicle 3, and the output of the session.
struct Scene {
    signing: VehicleSigning,
    desk: Arc<Desk>,
    vehicle: Vehicle,
    now: Duration,
    questions: Vec<i64>,
    rows: Vec<RowUpdate>,
}

impl Scene {
    /// `shown` is the signature of the vehicle's last frame.
    fn new(shown: Seal) -> Self {
        Self::with(Desk::default(), shown)
    }

    fn with(desk: Desk, shown: Seal) -> Self {
        let desk = Arc::new(desk);
        let mut scene = Self {
            signing: VehicleSigning::default(),
            desk: Arc::clone(&desk),
            vehicle: Vehicle::new(3, 1),
            now: Duration::from_secs(100),
            questions: Vec::new(),
            rows: Vec::new(),
        };
        scene.signing.use_desk(Some(desk));
        scene.beat(shown);
        scene
    }

    fn order(&mut self, change: SigningChange) {
        let verb = language::verb("signing").expect("in the table");
        let order = VehicleCommand::new(EntryId(1), verb, Command::Signing(change));
        let mut output = Output::default();
        self.signing
            .order(order, &self.vehicle, self.now, &mut output);
        self.collect(output);
        self.pass(0);
    }

    fn pass(&mut self, ms: u64) {
        let until = self.now + Duration::from_millis(ms);
        loop {
            let mut output = Output::default();
            self.signing.poll(&self.vehicle, self.now, &mut output);
            self.collect(output);
            if self.now >= until {
                return;
            }
            self.now += Duration::from_millis(50).min(until.saturating_sub(self.now));
        }
    }

    fn collect(&mut self, output: Output) {
        for message in output.messages {
            if let Outgoing::Message(MavMessage::TIMESYNC(sync)) = message {
                self.questions.push(sync.ts1);
            }
        }
        for report in output.reports {
            if let super::super::Report::Row(row) = report {
                self.rows.push(row);
            }
        }
    }

    fn hear(&mut self, message: MavMessage, seal: Seal) {
        let frame = Frame {
            system: 3,
            component: 1,
            sequence: 0,
            version: mavlink::MavlinkVersion::V2,
            seal,
            wire_len: 40,
            content: Content::Message(message),
        };
        let mut output = Output::default();
        self.signing
            .receive(&frame, &self.vehicle, self.now, &mut output);
        self.collect(output);
    }

    fn beat(&mut self, seal: Seal) {
        self.hear(
            MavMessage::HEARTBEAT(HEARTBEAT_DATA {
                custom_mode: 0,
                mavtype: MavType::MAV_TYPE_QUADROTOR,
                autopilot: MavAutopilot::MAV_AUTOPILOT_ARDUPILOTMEGA,
                base_mode: MavModeFlag::empty(),
                system_status: MavState::MAV_STATE_STANDBY,
                mavlink_version: 3,
            }),
            seal,
        );
    }

    fn answer(&mut self, seal: Seal) {
        let ts1 = self.questions.last().copied().unwrap_or(-7);
        self.answer_to(ts1, seal);
    }

    fn answer_to(&mut self, ts1: i64, seal: Seal) {
        let sync = TIMESYNC_DATA {
            tc1: 5,
            ts1,
            ..TIMESYNC_DATA::default()
        };
        self.hear(MavMessage::TIMESYNC(sync), seal);
    }

    fn end(&self) -> Option<(RowState, String)> {
        let last = self.rows.last().filter(|row| row.state.is_final())?;
        let words = last.explanation.as_ref().map(ToString::to_string);
        Some((last.state, words.unwrap_or_default()))
    }
}

#[test]
fn a_key_is_written_sent_shown_asked_for_and_proved() {
    for (change, before, after) in [
        (SigningChange::SetUp, Seal::Unsigned, Seal::RightWithNext),
        (SigningChange::Rotate, Seal::Right, Seal::RightWithNext),
        (SigningChange::Remove, Seal::Right, Seal::Unsigned),
    ] {
        let mut scene = Scene::new(before);
        scene.order(change);
        assert_eq!(
            scene.desk.calls(),
            [Call::Begin, Call::Send(change.forward())]
        );
        scene.beat(before);
        scene.pass(300);
        assert!(scene.questions.is_empty(), "{change:?} has not shown");
        scene.beat(after);
        scene.pass(100);
        assert_eq!(scene.questions.len(), 1);
        assert_eq!(scene.end(), None, "{change:?} has shown, but is not proved");
        scene.answer_to(-12345, after);
        assert_eq!(scene.end(), None, "an answer to someone else");
        scene.answer(after);
        let (state, words) = scene.end().expect("ended");
        assert_eq!(state, RowState::Done, "{change:?} {words}");
        assert_eq!(scene.desk.calls().last(), Some(&Call::Proved));
        let states: Vec<RowState> = scene.rows.iter().map(|row| row.state).collect();
        assert_eq!(states, [RowState::Sent, RowState::Accepted, RowState::Done]);
        assert!(!scene.signing.is_busy());
    }
}

#[test]
fn a_vehicle_that_shows_nothing_keeps_its_state() {
    let mut scene = Scene::new(Seal::Unsigned);
    scene.order(SigningChange::SetUp);
    for _ in 0..10 {
        scene.beat(Seal::Unsigned);
        scene.pass(600);
    }
    let (state, words) = scene.end().expect("ended");
    assert_eq!(state, RowState::TimedOut);
    assert!(words.contains('5'), "{words}");
    let sent = scene.desk.calls();
    assert_eq!(sent[0], Call::Begin);
    assert_eq!(sent[1..], [Call::Send(SentKey::Next); 5]);
    assert!(scene.questions.is_empty());
}

#[test]
fn the_reason_of_a_vehicle_is_the_reason_of_the_row() {
    let mut scene = Scene::new(Seal::Unsigned);
    scene.order(SigningChange::SetUp);
    let notice = |source, text: &str| Notice {
        source,
        ..Notice::about(3, Duration::ZERO, Severity::Warning, text.to_owned().into())
    };
    scene.signing.hear_texts(&[
        notice(NoticeSource::Vehicle, "Failed to save signing key"),
        notice(NoticeSource::Program, "link lost"),
    ]);
    scene.pass(6000);
    let (state, words) = scene.end().expect("ended");
    assert_eq!(state, RowState::Refused);
    assert!(words.contains("Failed to save signing key"), "{words}");
}

#[test]
fn without_an_answer_the_earlier_key_is_sent_again() {
    for (change, before, after) in [
        (SigningChange::SetUp, Seal::Unsigned, Seal::RightWithNext),
        (SigningChange::Rotate, Seal::Right, Seal::RightWithNext),
    ] {
        let mut scene = Scene::new(before);
        scene.order(change);
        scene.beat(after);
        scene.pass(8000);
        let (state, _) = scene.end().expect("ended");
        assert_eq!(state, RowState::TimedOut);
        assert_eq!(scene.questions.len(), 10);
        let calls = scene.desk.calls();
        assert_eq!(calls[calls.len() - 3..], [Call::Send(change.back()); 3]);
        assert!(!calls.contains(&Call::Proved));
    }
}

#[test]
fn a_forged_unsigned_heartbeat_does_not_prove_a_removal() {
    let mut scene = Scene::new(Seal::Right);
    scene.order(SigningChange::Remove);
    scene.beat(Seal::Unsigned);
    scene.pass(100);
    scene.answer(Seal::Right);
    assert_eq!(scene.end(), None);
    scene.pass(10_000);
    assert_eq!(
        scene.end().map(|(state, _)| state),
        Some(RowState::TimedOut)
    );
    assert!(!scene.desk.calls().contains(&Call::Proved));
}

#[test]
fn a_change_that_does_not_fit_is_refused_before_anything_is_sent() {
    use SigningChange::{Remove, Rotate, SetUp};
    for (change, shown) in [
        (SetUp, Seal::Right),
        (Rotate, Seal::Unsigned),
        (Remove, Seal::Unsigned),
        (Rotate, Seal::Foreign),
        (Remove, Seal::Foreign),
    ] {
        let mut scene = Scene::new(shown);
        scene.order(change);
        let (state, words) = scene.end().expect("ended");
        assert_eq!(state, RowState::Refused, "{change:?} {shown:?} {words}");
        assert_eq!(scene.desk.calls(), []);
    }
    let mut scene = Scene::new(Seal::Unsigned);
    scene.order(SetUp);
    scene.order(SetUp);
    let refused = scene.rows.last().map(|row| row.state);
    assert_eq!(refused, Some(RowState::Refused), "one at a time");
    let mut scene = Scene::new(Seal::Unsigned);
    scene.signing.use_desk(None);
    scene.order(SetUp);
    assert_eq!(scene.end().map(|(state, _)| state), Some(RowState::Refused));
}

#[test]
fn a_key_is_not_removed_while_unsigned_frames_are_ignored() {
    for (change, is_refused) in [
        (SigningChange::Remove, true),
        (SigningChange::Rotate, false),
    ] {
        let desk = Desk {
            requires: true,
            ..Desk::default()
        };
        let mut scene = Scene::with(desk, Seal::Right);
        scene.order(change);
        let refused = scene.end().filter(|(state, _)| *state == RowState::Refused);
        assert_eq!(refused.is_some(), is_refused, "{change:?} {refused:?}");
        let words = refused.map(|(_, words)| words).unwrap_or_default();
        assert_eq!(words.contains("--require-signing"), is_refused, "{words}");
        assert_eq!(scene.desk.calls().is_empty(), is_refused);
    }
}

#[test]
fn an_armed_vehicle_is_refused() {
    let mut scene = Scene::new(Seal::Unsigned);
    scene.vehicle.heartbeat = Some(Heartbeat {
        mav_type: 2,
        autopilot: Heartbeat::ARDUPILOT,
        class: VehicleClass::Copter,
        mode: Mode {
            class: VehicleClass::Copter,
            number: 4,
        },
        armed: true,
        status: SystemStatus::Active,
        at: Duration::ZERO,
    });
    scene.order(SigningChange::SetUp);
    assert_eq!(scene.end().map(|(state, _)| state), Some(RowState::Refused));
    assert_eq!(scene.desk.calls(), []);
}

#[test]
fn a_key_that_cannot_be_written_is_not_sent() {
    let desk = Desk {
        fails: true,
        ..Desk::default()
    };
    let mut scene = Scene::with(desk, Seal::Unsigned);
    scene.order(SigningChange::SetUp);
    let (state, words) = scene.end().expect("ended");
    assert_eq!(state, RowState::Refused);
    assert!(words.contains("the disk is full"), "{words}");
    assert_eq!(scene.desk.calls(), [Call::Begin]);
}

fn seal() -> impl Strategy<Value = Seal> {
    prop_oneof![
        Just(Seal::Unsigned),
        Just(Seal::Foreign),
        Just(Seal::Old(5)),
        Just(Seal::Right),
        Just(Seal::RightWithNext),
    ]
}

/// An action of the vehicle, or of an impostor.
#[derive(Debug, Clone)]
enum Turn {
    Beat(Seal),
    Answer(Seal),
    Pass(u64),
}

proptest! {
    #[test]
    fn whatever_arrives_a_change_ends_once_and_is_proved_only_by_an_answer(
        is_rotation in any::<bool>(),
        turns in prop::collection::vec(
            prop_oneof![
                seal().prop_map(Turn::Beat),
                seal().prop_map(Turn::Answer),
                (0u64..3000).prop_map(Turn::Pass),
            ],
            0..60,
        ),
    ) {
        let (change, before) = if is_rotation {
            (SigningChange::Rotate, Seal::Right)
        } else {
            (SigningChange::SetUp, Seal::Unsigned)
        };
        let mut scene = Scene::new(before);
        scene.order(change);
        let mut may_be_proved = false;
        for turn in turns {
            match turn {
                Turn::Beat(seal) => scene.beat(seal),
                Turn::Answer(seal) => {
                    may_be_proved |= seal == Seal::RightWithNext && !scene.questions.is_empty();
                    scene.answer(seal);
                }
                Turn::Pass(ms) => scene.pass(ms),
            }
        }
        // Nothing more arrives.
        scene.pass(60_000);
        let ends = scene.rows.iter().filter(|row| row.state.is_final()).count();
        prop_assert_eq!(ends, 1);
        let calls = scene.desk.calls();
        prop_assert_eq!(calls.first(), Some(&Call::Begin));
        let is_proved = calls.contains(&Call::Proved);
        prop_assert_eq!(scene.end().map(|(state, _)| state) == Some(RowState::Done), is_proved);
        prop_assert!(may_be_proved || !is_proved);
    }
}
