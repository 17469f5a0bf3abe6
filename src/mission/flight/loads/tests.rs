use crate::commands::Deed;
use crate::ledger::{EntryId, RowState};
use crate::mission::Mission;
use crate::mission::fake::{Pilot, given};

fn laden() -> Pilot {
    let file = include_str!("../../../../missions/01-air-sample.toml");
    let loads = "[\"s_voc\"]\nloads = { ball = 2, spray = 3 }";
    let file = file.replace("[\"s_voc\"]", loads);
    let mission = Mission::parse(&file).expect("it is good");
    let mut pilot = Pilot::flying(mission, 1);
    pilot.wait(1.0);
    pilot
}

fn entry(pilot: &mut Pilot) -> EntryId {
    let now = pilot.now;
    pilot.ledger.open(now, given("1 arm"), &[1])
}

fn act(pilot: &mut Pilot, deed: &Deed) -> (RowState, String) {
    let entry = entry(pilot);
    let row = pilot.flight.act(entry, deed, &[1]).remove(0);
    (row.state, row.explanation.unwrap_or_default().to_string())
}

fn left(pilot: &Pilot, load: &str) -> Option<f64> {
    let loads = pilot.flight.progress().loads;
    let found = loads.iter().find(|known| known.load == *load);
    found.map(|known| f64::from(known.left))
}

#[test]
fn balls_fall_from_the_air_only_not_from_too_high_and_not_when_there_are_none() {
    let mut pilot = laden();
    assert_eq!(act(&mut pilot, &Deed::Drop).0, RowState::Refused);
    pilot.take_off(50.0);
    let (state, why) = act(&mut pilot, &Deed::Drop);
    assert_eq!(
        (state, why.as_str()),
        (RowState::Refused, "50 m is too high: at most 40 m")
    );
    assert_eq!(left(&pilot, "balls"), Some(2.0));
    pilot.land();
    pilot.take_off(15.0);
    for after in [1.0, 0.0] {
        assert_eq!(act(&mut pilot, &Deed::Drop).0, RowState::Done);
        assert_eq!(left(&pilot, "balls"), Some(after));
    }
    let (state, why) = act(&mut pilot, &Deed::Drop);
    assert_eq!(
        (state, why.starts_with("no balls left")),
        (RowState::Refused, true)
    );
}

#[test]
fn a_stay_on_the_pad_fills_the_loads_again() {
    let mut pilot = laden();
    pilot.take_off(15.0);
    act(&mut pilot, &Deed::Drop);
    assert_eq!(left(&pilot, "balls"), Some(1.0));
    pilot.land();
    pilot.wait(5.0);
    assert_eq!(left(&pilot, "balls"), Some(1.0));
    pilot.wait(16.0);
    assert_eq!(left(&pilot, "balls"), Some(2.0));
}

#[test]
fn the_sprayer_uses_a_second_of_its_load_each_second_until_it_is_empty() {
    let mut pilot = laden();
    pilot.take_off(10.0);
    assert_eq!(
        act(&mut pilot, &Deed::Spray { on: false }).0,
        RowState::Refused
    );
    assert_eq!(act(&mut pilot, &Deed::Spray { on: true }).0, RowState::Done);
    pilot.wait(1.5);
    assert_eq!(left(&pilot, "spray"), Some(2.0));
    assert_eq!(
        act(&mut pilot, &Deed::Spray { on: false }).0,
        RowState::Done
    );
    pilot.wait(3.0);
    assert_eq!(left(&pilot, "spray"), Some(2.0));
    act(&mut pilot, &Deed::Spray { on: true });
    pilot.wait(5.0);
    assert_eq!(left(&pilot, "spray"), Some(0.0));
    assert_eq!(
        act(&mut pilot, &Deed::Spray { on: true }).0,
        RowState::Refused
    );
}

#[test]
fn a_sample_tells_what_the_sensor_shows_to_one_who_hovers() {
    let mut pilot = laden();
    pilot.take_off(15.0);
    pilot.goto(40.0, 0.0, 4.0);
    pilot.wait(2.0);
    let (state, remark) = act(&mut pilot, &Deed::Sample);
    assert_eq!(state, RowState::Done);
    assert!(
        remark.starts_with("gas ") && remark.ends_with(" ppm"),
        "{remark}"
    );
}
