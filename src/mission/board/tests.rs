//! Plans on board, and their faults.

use super::*;
use crate::plan::ListKind;

const INHERITED: &str = include_str!("../../../missions/16-inherited-plans.toml");

/// The mission with only one kind of fault.
fn with_only(fault: &str) -> Mission {
    let line = INHERITED
        .lines()
        .find(|line| line.starts_with("faults = "))
        .expect("it has faults");
    let source = INHERITED
        .replacen(line, &format!("faults = [\"{fault}\"]"), 1)
        .replacen("faulty = 2", "faulty = 1", 1);
    Mission::parse(&source).expect("no faults")
}

/// The plans of one flight: the faulty one, and a sound one.
fn plans(mission: &Mission, seed: u64) -> (Vec<Item>, Vec<Item>) {
    let drawn = mission.board.drawn(seed);
    let faulty = drawn.iter().position(Option::is_some).expect("one");
    let sound = mission.sound_plan(mission.seats.pads[faulty], &mission.board.routes[faulty]);
    (mission.board_document(faulty, seed).plan, sound)
}

#[test]
fn each_seed_has_as_many_faulty_plans_as_the_mission_says() {
    let mission = Mission::parse(INHERITED).expect("no faults");
    let mut kinds = Vec::new();
    for seed in 1..=40 {
        let drawn = mission.board.drawn(seed);
        let faults: Vec<PlanFault> = drawn.iter().flatten().copied().collect();
        assert!(faults.len() == 2 && faults[0] != faults[1], "{drawn:?}");
        kinds.extend(faults);
        for (seat, fault) in drawn.iter().enumerate() {
            let sound = mission.sound_plan(mission.seats.pads[seat], &mission.board.routes[seat]);
            let carried = mission.board_document(seat, seed).plan;
            assert_eq!(carried == sound, fault.is_none(), "{fault:?}");
        }
    }
    let all = &mission.board.faults;
    assert!(all.iter().all(|fault| kinds.contains(fault)), "{kinds:?}");
}

#[test]
fn faults_are_what_their_names_say() {
    for seed in 1..=10 {
        let (plan, sound) = plans(&with_only("sea_level"), seed);
        let changed = plan.iter().zip(&sound).filter(|(a, b)| a != b);
        let frames: Vec<u8> = changed.map(|(item, _)| item.frame).collect();
        assert_eq!(frames, [frame::SEA_LEVEL]);
        let (plan, sound) = plans(&with_only("gap"), seed);
        assert_eq!(plan.len() + 2, sound.len());
        let (plan, _) = plans(&with_only("no_return"), seed);
        assert!(
            plan.iter()
                .all(|it| it.command != command::RETURN_TO_LAUNCH)
        );
        let (plan, _) = plans(&with_only("endless"), seed);
        let jump = plan[plan.len() - 2];
        assert!(jump.command == command::DO_JUMP && jump.params[1] < 0.0);
        let (plan, _) = plans(&with_only("stay"), seed);
        assert!(plan.iter().any(|item| item.params[0] >= LONG_STAY_S));
        let mission = with_only("copied");
        let (plan, sound) = plans(&mission, seed);
        assert!(plan != sound);
        let seats = 0..mission.board.routes.len();
        let same = seats.filter(|&seat| mission.board_document(seat, seed).plan == plan);
        assert_eq!(same.count(), 2);
    }
}

#[test]
fn a_place_outside_breaks_the_fence_on_board() {
    let mission = with_only("outside");
    for seed in 1..=10 {
        let seat = mission.board.drawn(seed).iter().position(Option::is_some);
        let document = mission.board_document(seat.expect("one"), seed);
        assert_eq!(document.list(ListKind::Fence).len(), 4);
        let astray = document.plan.iter().filter_map(|item| {
            let place = (item.x != 0).then(|| item.point())?;
            let at = mission.site.origin.point(place);
            let mut fences = mission.fences();
            fences.any(|fence| !fence.shape.contains(at)).then_some(at)
        });
        assert_eq!(astray.count(), 1);
    }
}

#[test]
fn a_mission_without_plans_wants_nothing_on_board() {
    let source = include_str!("../../../missions/00-first-flight.toml");
    let mission = Mission::parse(source).expect("no faults");
    assert!(mission.board_wants(0, 1).is_empty() && mission.board.drawn(1).is_empty());
}
