//! Plans flown in the embedded simulator: pauses, resumptions, skipped items, and the end.

use mavlink::dialects::ardupilotmega::{COMMAND_LONG_DATA, MavCmd};

use super::*;
use crate::commands::Act;
use crate::language::{Context, Meaning};
use crate::vehicle::{PlanPhase, Vehicle};

/// An item at these distances north and east of home, 15 m high.
fn item(command: u16, north_m: f64, east_m: f64) -> Item {
    let (x, y) = HOME.moved(north_m, east_m).to_e7();
    Item {
        command,
        frame: 3,
        auto_continue: true,
        params: [0.0; 4],
        x,
        y,
        z: 15.0,
    }
}

/// A takeoff, three places and a return.
fn square() -> Vec<Item> {
    vec![
        item(22, 0.0, 0.0),
        item(16, 120.0, 0.0),
        item(16, 120.0, 120.0),
        item(16, 0.0, 120.0),
        item(20, 0.0, 0.0),
    ]
}

impl Rig {
    /// A vehicle that carries a plan, ready to arm.
    pub(super) fn carrying(items: &[Item]) -> Self {
        let mut rig = Self::new(true);
        rig.file("plan", ListKind::Plan, items);
        rig.upload(ListKind::Plan, "plan");
        assert_eq!(rig.ended(s(30)), RowState::Done, "{:?}", rig.row);
        rig.pass(s(10));
        rig
    }

    /// A vehicle that flies to the second item of its plan.
    fn flying(items: &[Item]) -> Self {
        let mut rig = Self::carrying(items);
        rig.works("mode guided", 5);
        rig.works("arm", 5);
        rig.works("plan start", 5);
        rig.until(60, |vehicle| vehicle.plan.current == 2);
        rig.pass(s(5));
        rig
    }

    /// Gives a line, and returns how it ended and why.
    fn give(&mut self, line: &str, within: u64) -> (RowState, String) {
        let statement = language::parse(line, &Context::default()).expect("a line");
        let Meaning::Act(Act::Command(command)) = statement.meaning else {
            panic!("{line} is no command");
        };
        self.entries += 1;
        self.row = None;
        let order = VehicleCommand::new(EntryId(self.entries), statement.verb, command);
        self.session.order(order, self.now);
        let state = self.ended(s(within));
        (state, self.explanation())
    }

    pub(super) fn works(&mut self, line: &str, within: u64) {
        let (state, reason) = self.give(line, within);
        assert_eq!(state, RowState::Done, "{line}: {reason}");
    }

    fn refuses(&mut self, line: &str, reason: &str) {
        let (state, explanation) = self.give(line, 10);
        assert_eq!(state, RowState::Refused, "{line}: {explanation}");
        assert!(explanation.contains(reason), "{line}: {explanation}");
    }

    pub(super) fn until(&mut self, within: u64, holds: impl Fn(&Vehicle) -> bool) {
        let until = self.now + s(within);
        while !holds(self.session.vehicle()) {
            assert!(self.now < until, "{:?}", self.session.vehicle().plan);
            self.step();
        }
    }

    fn current(&self) -> u16 {
        self.session.vehicle().plan.current
    }

    fn mode(&self) -> String {
        let mode = self.session.vehicle().mode().expect("a mode");
        mode.to_string()
    }

    pub(super) fn set(&mut self, name: &str, value: f32) {
        let set = MavMessage::PARAM_SET(PARAM_SET_DATA {
            param_value: value,
            target_system: 1,
            target_component: 1,
            param_id: name.into(),
            ..PARAM_SET_DATA::DEFAULT
        });
        self.say(&set.into());
        self.pass(s(1));
    }
}

#[test]
fn a_pause_holds_in_auto_and_a_resumption_goes_on() {
    let mut rig = Rig::flying(&square());
    rig.works("plan pause", 15);
    let vehicle = rig.session.vehicle();
    assert_eq!(vehicle.plan.phase, Some(PlanPhase::Paused));
    assert!(vehicle.flies_plan());
    assert!(vehicle.ground_speed_m_s().is_some_and(|speed| speed < 0.5));
    rig.refuses("plan pause", "already paused");
    rig.works("plan resume", 5);
    assert_eq!(rig.current(), 2);
    rig.until(60, |vehicle| vehicle.plan.current == 3);
    rig.refuses("plan resume", "at item 3");
}

/// The vehicle stops beyond its item, and reports the next one as active.
#[test]
fn a_pause_close_to_a_place_can_be_resumed() {
    let places = LatLon::new(HOME.lat_deg, HOME.lon_deg);
    let mut rig = Rig::flying(&square());
    rig.until(60, |vehicle| {
        let at = vehicle.global.map(|it| places.offset_to(it.at_point));
        at.is_some_and(|it| <[f64; 2]>::from(it)[0] > 116.0)
    });
    let (state, reason) = rig.give("plan pause", 15);
    assert_eq!(state, RowState::Done, "{reason}");
    rig.pass(s(5));
    let speed = |rig: &Rig| rig.session.vehicle().ground_speed_m_s().expect("known");
    assert!(speed(&rig) < 0.5);
    rig.works("plan resume", 10);
    rig.pass(s(5));
    assert!(speed(&rig) > 2.0, "{:?}", rig.session.vehicle().plan);
}

/// The vehicle reaches the height of its item while it slows down, and stays there until it is
/// resumed.
#[test]
fn an_item_reached_while_stopping_does_not_end_a_pause() {
    let high = |command, north_m| Item {
        z: 60.0,
        ..item(command, north_m, 0.0)
    };
    let mut rig = Rig::flying(&[item(22, 0.0, 0.0), high(16, 0.0), high(16, 70.0)]);
    let height = |vehicle: &Vehicle| vehicle.global.map_or(0.0, |it| it.altitude_m);
    rig.until(60, |vehicle| height(vehicle) > 57.5);
    rig.works("plan pause", 15);
    for _ in 0..20 {
        rig.pass(s(3));
        let vehicle = rig.session.vehicle();
        assert!(vehicle.has_paused(), "{:?}", vehicle.plan);
    }
    assert_eq!(rig.current(), 3, "the item was reached");
    rig.refuses("plan pause", "already paused");
    rig.works("plan resume", 10);
    rig.pass(s(4));
    assert!(!rig.session.vehicle().has_paused());
}

#[test]
fn a_plan_starts_as_soon_as_its_upload_is_done() {
    let mut rig = Rig::new(true);
    rig.file("plan", ListKind::Plan, &square());
    rig.works("mode guided", 5);
    rig.works("arm", 5);
    rig.upload(ListKind::Plan, "plan");
    assert_eq!(rig.ended(s(30)), RowState::Done, "{:?}", rig.row);
    rig.works("plan start", 5);
}

#[test]
fn a_resumption_from_another_mode_never_begins_again() {
    for restart in [0.0, 1.0] {
        let mut rig = Rig::flying(&square());
        rig.set("MIS_RESTART", restart);
        rig.until(60, |vehicle| vehicle.plan.current == 3);
        rig.works("brake", 5);
        rig.pass(s(5));
        rig.refuses("plan skip", "BRAKE");
        rig.works("plan resume", 5);
        assert_eq!((rig.mode(), rig.current()), ("AUTO".to_owned(), 3));
        rig.pass(s(3));
        assert_eq!(rig.current(), 3, "MIS_RESTART {restart}");
        rig.works("guided", 5);
        rig.works("plan resume from 2", 5);
        rig.pass(s(3));
        assert_eq!((rig.mode(), rig.current()), ("AUTO".to_owned(), 2));
        rig.works("plan pause", 15);
        rig.works("plan resume 4", 5);
        rig.pass(s(3));
        let vehicle = rig.session.vehicle();
        assert_eq!(
            (vehicle.plan.current, vehicle.plan.phase),
            (4, Some(PlanPhase::Active))
        );
        assert!(vehicle.ground_speed_m_s().is_some_and(|speed| speed > 3.0));
    }
}

/// Telemetry shows the effect of the first steps before the last one is answered.
#[test]
fn the_answer_to_a_resumption_is_not_taken_for_lost() {
    for restart in [0.0, 1.0] {
        let mut rig = Rig::flying(&square());
        rig.set("MIS_RESTART", restart);
        rig.radio(0.0, 150, 1);
        for (delay, line) in
            (0..12).zip(["plan resume from 2", "plan resume from 3"].iter().cycle())
        {
            rig.works("guided", 5);
            rig.pass(Duration::from_millis(1000 + 90 * delay));
            let (state, words) = rig.give(line, 10);
            assert_eq!(state, RowState::Done, "{line}: {words}");
            assert_eq!(words, "", "{line}, {delay}");
            rig.pass(s(2));
        }
    }
}

#[test]
fn items_are_skipped_one_by_one_and_the_last_cannot_be() {
    let mut rig = Rig::flying(&square());
    for item in 3..=5 {
        rig.works("plan skip", 5);
        assert_eq!(rig.current(), item);
    }
    rig.refuses("plan skip", "item 5 is the last");
    rig.refuses("plan goto 6", "the last is 5");
    rig.refuses("plan resume from 9", "the last is 5");
    rig.works("plan goto 2", 5);
    assert_eq!(rig.current(), 2, "going back is seen, too");
}

#[test]
fn an_aborted_plan_ends_at_home() {
    let mut rig = Rig::flying(&square());
    let (state, reason) = rig.give("plan abort", 200);
    assert_eq!(state, RowState::Done, "{reason}");
    assert_eq!(rig.mode(), "RTL");
    assert!(rig.session.vehicle().is_on_the_ground());
    rig.pass(s(10));
    for line in ["plan pause", "plan skip", "plan abort"] {
        rig.refuses(line, "not armed");
    }
    rig.refuses("plan resume", "on the ground");
}

#[test]
fn an_abort_returns_a_vehicle_that_waits_and_leaves_one_that_lands() {
    let mut rig = Rig::flying(&square());
    rig.works("loiter", 5);
    rig.give("plan pause", 5);
    let (state, reason) = rig.give("plan abort", 200);
    assert_eq!(state, RowState::Done, "{reason}");
    let mut rig = Rig::flying(&square());
    let (state, _) = rig.give("plan goto 5", 5);
    assert_eq!(state, RowState::Done);
    rig.works("mode land", 200);
    assert_eq!(rig.mode(), "LAND");
}

#[test]
fn a_vehicle_without_a_plan_refuses_with_the_reason() {
    let mut rig = Rig::new(true);
    rig.pass(s(5));
    for line in [
        "plan start",
        "plan pause",
        "plan resume",
        "plan skip",
        "plan abort",
        "plan goto 1",
    ] {
        rig.refuses(line, "no plan on board");
    }
}

#[test]
fn a_plan_that_is_over_resumes_only_from_an_item() {
    let mut plan = square();
    plan.pop();
    let mut rig = Rig::flying(&plan);
    rig.works("plan goto 4", 5);
    rig.until(90, |vehicle| {
        vehicle.plan.phase == Some(PlanPhase::Complete)
    });
    rig.refuses("plan resume", "to the end");
    rig.works("plan resume from 2", 5);
    rig.until(60, |vehicle| vehicle.plan.current == 3);
}

#[test]
fn a_takeoff_cannot_pause_and_the_reason_is_said() {
    let mut rig = Rig::carrying(&square());
    rig.works("mode guided", 5);
    rig.works("arm", 5);
    rig.works("plan start", 5);
    rig.pass(s(3));
    rig.refuses("plan pause", "only on the way to a waypoint");
}

#[test]
fn what_is_left_out_without_an_order_is_said() {
    let mut plan = square();
    plan.insert(2, item(210, 0.0, 0.0));
    let mut rig = Rig::flying(&plan);
    said(&mut rig);
    rig.until(60, |vehicle| vehicle.plan.current == 4);
    rig.pass(s(2));
    let told = said(&mut rig);
    let unknown = "item 3 skipped: the vehicle does not know command 210 in a plan";
    assert!(told.iter().any(|text| text == unknown), "{told:?}");
    // Another ground station makes the return, item 6, the current item.
    let mut other = Encoder::new(254, 190);
    let mut bytes = Vec::new();
    let set = COMMAND_LONG_DATA {
        command: MavCmd::MAV_CMD_DO_SET_MISSION_CURRENT,
        param1: 6.0,
        target_system: 1,
        target_component: 1,
        ..COMMAND_LONG_DATA::DEFAULT
    };
    other.encode(&MavMessage::COMMAND_LONG(set).into(), &mut bytes);
    rig.world.receive(rig.port, &bytes);
    rig.pass(s(3));
    let told = said(&mut rig);
    let skipped = "plan went on from item 4 to 6; not reported as reached: 5";
    assert!(told.iter().any(|text| text == skipped), "{told:?}");
}

#[test]
fn orders_and_quick_items_are_no_surprise() {
    let mut plan = square();
    let mut delay = item(93, 0.0, 0.0);
    delay.params = [0.2, -1.0, -1.0, -1.0];
    plan.insert(2, delay);
    let mut rig = Rig::flying(&plan);
    said(&mut rig);
    rig.until(60, |vehicle| vehicle.plan.current == 4);
    rig.works("plan skip", 5);
    rig.works("plan goto 2", 5);
    rig.pass(s(3));
    let told = said(&mut rig);
    assert!(
        told.iter().all(|text| !text.starts_with("plan went")),
        "{told:?}"
    );
}

#[test]
fn a_plan_that_begins_again_by_itself_is_said() {
    let mut rig = Rig::flying(&square());
    rig.set("MIS_RESTART", 1.0);
    rig.until(60, |vehicle| vehicle.plan.current == 3);
    rig.works("brake", 5);
    rig.pass(s(15));
    said(&mut rig);
    rig.works("auto", 5);
    rig.pass(s(3));
    let told = said(&mut rig);
    // The takeoff is over at once.
    let back = "plan went back from item 3 to 2";
    assert!(told.iter().any(|text| text == back), "{told:?}");
}

#[test]
fn estimated_times_are_those_of_the_flight() {
    let mut plan = square();
    plan[2].params[0] = 6.0;
    let mut rig = Rig::flying(&plan);
    rig.pass(s(3));
    let leg = rig.session.vehicle().plan_leg().expect("a leg");
    let (next, end) = (leg.next.expect("known"), leg.end.expect("known"));
    let begun = rig.now;
    rig.until(60, |vehicle| vehicle.plan.current == 3);
    let took = rig.now.saturating_sub(begun);
    assert!(took.abs_diff(next) < s(3), "{took:?} instead of {next:?}");
    rig.until(200, |vehicle| !vehicle.armed());
    let all = rig.now.saturating_sub(begun);
    assert!(all.abs_diff(end) < end / 8, "{all:?} instead of {end:?}");
}
