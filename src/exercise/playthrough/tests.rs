use super::*;
use crate::campaign::Skill;
use crate::language::Context;

fn pilot(mission: &str, script: &str) -> (Mission, Script) {
    let mission = Mission::parse(mission).expect("no faults");
    let (places, areas) = (mission.places_to_name(), mission.named_areas());
    let vehicles: Vec<u16> = (1..=mission.seats.count as u16).collect();
    let context = Context {
        places: Some(&places),
        areas: Some(&areas),
        vehicles: &vehicles,
        ..Context::default()
    };
    let script = Script::parse(script, &context).expect("no faults");
    (mission, script)
}

macro_rules! shipped {
    ($mission:literal, $pilot:literal) => {
        pilot(
            include_str!(concat!("../../../missions/", $mission, ".toml")),
            include_str!(concat!("../../../missions/pilots/", $pilot, ".pilot")),
        )
    };
}

#[test]
fn a_career_grows_from_nothing_by_what_the_campaign_advises() {
    let mut career = Playthrough::new(
        [
            shipped!("00-first-flight", "00-first-flight"),
            shipped!("01-air-sample", "01-air-sample"),
            shipped!("drills/d00-arm-and-hover", "d00-arm-and-hover"),
        ],
        20_000,
        1,
    );
    let mut laps = Vec::new();
    while !career.is_complete() {
        assert!(laps.len() < 8, "{laps:#?}");
        laps.push(career.fly().expect("there is always something to fly"));
    }
    assert!(laps.iter().all(|lap| lap.passed), "{laps:#?}");
    let (first, last) = (&laps[0], &laps[laps.len() - 1]);
    assert!(last.credits > 500 || laps.iter().any(|lap| !lap.bought.is_empty()));
    assert!(last.mean_skill_percent > first.mean_skill_percent);
    assert_eq!(last.licence, 4, "after two passes");
    // The same flights give the same career.
    let standing = CareerStanding::of(career.history());
    assert_eq!(standing.credits(), last.credits);
    assert!(standing.skill(Skill::K1).chance(last.day) > 0.2);
}
