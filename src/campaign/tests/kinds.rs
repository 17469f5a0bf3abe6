//! The kinds of vehicles that a career unlocks.

use super::*;
use crate::campaign::Reward;
use crate::workshop::DesignKind;

#[test]
fn a_mission_unlocks_a_kind_of_vehicle_with_all_parts_that_only_it_takes() {
    let course = MissionCourse::new([Offer {
        kinds: vec![DesignKind::Robot],
        ..offer("one", 1, &[], &[])
    }]);
    let before = CareerStanding::default();
    let state = |standing: &CareerStanding, id: &str| {
        standing.part_state(part(id).expect("known"), &course)
    };
    for id in ["ch_410k", "gm_37", "s_flail"] {
        assert_eq!(
            state(&before, id),
            PartState::Locked("one".to_owned()),
            "{id}"
        );
    }
    let title = |standing: &CareerStanding, kind| {
        let lock = standing.kind_lock(kind, &course);
        lock.map(|offer| offer.id.clone())
    };
    assert_eq!(title(&before, DesignKind::Robot).as_deref(), Some("one"));
    assert_eq!(title(&before, DesignKind::Drone), None);
    let flown = flight(&course, "one", 900, 1);
    let mut after = before.clone();
    after.enter(&CareerEntry::Flight(flown.clone()));
    assert_eq!(title(&after, DesignKind::Robot), None);
    assert!(matches!(state(&after, "ch_410k"), PartState::ForSale(_)));
    let reward = Reward::between(&before, &after, &course, &flown);
    let opened: Vec<&str> = reward.vehicles.iter().map(|it| it.id.as_str()).collect();
    assert_eq!(
        (opened, reward.parts.len()),
        (vec!["robot"], 0),
        "not part by part"
    );
    let progress = CareerProgress::of(&course, &[CareerEntry::Flight(flown)], 1);
    let open = progress.vehicles.iter().filter(|it| it.after.is_none());
    assert_eq!(open.count(), DesignKind::ALL.len());
}

#[test]
fn robots_and_boats_are_unlocked_before_the_missions_that_need_them() {
    let missions = crate::store::missions();
    let missions: Vec<Mission> = missions
        .iter()
        .map(|source| Mission::parse(&source.text).expect("no faults"))
        .collect();
    let course = MissionCourse::new(missions.iter().map(Offer::of));
    let mut standing = CareerStanding::default();
    for id in ["07-clearance", "11-flood-search"] {
        let mut flown = flight(&course, id, 900, 1);
        flown.passed = true;
        standing.enter(&CareerEntry::Flight(flown));
    }
    for mission in &missions {
        for kind in mission.seat_kinds() {
            let lock = standing.kind_lock(kind, &course);
            assert!(lock.is_none(), "{}: {kind:?}", mission.id);
        }
    }
}
