//! Fences that a flight breaches or respects.

use super::*;

#[test]
fn a_fence_that_the_way_leaves_is_noticed() {
    let mut one = vehicle((0.0, 0.0), &[(150.0, 0.0)]);
    let circle = item(command::FENCE_CIRCLE_INCLUSION, (0.0, 0.0), 0.0);
    one.document.fence = vec![Item {
        params: [100.0, 0.0, 0.0, 0.0],
        ..circle
    }];
    let flown = rehearse(&[one], &calm()).expect("it can fly").vehicles[0];
    assert!(
        flown
            .broke_fence_s
            .is_some_and(|at_s| at_s > 10.0 && at_s < flown.time_s),
        "{flown:?}"
    );
}

/// A fence defined by parameters, with a plan that leaves it.
fn fenced(parameters: &[(&str, f32)]) -> Participant {
    let mut one = vehicle((0.0, 0.0), &[(150.0, 0.0)]);
    one.parameters = parameters
        .iter()
        .map(|(name, value)| ((*name).to_owned(), *value))
        .collect();
    one
}

#[test]
fn circle_and_heights_are_part_of_the_fence_as_the_vehicle_judges_them() {
    let broken = |parameters: &[(&str, f32)]| {
        let flown = rehearse(&[fenced(parameters)], &calm())
            .expect("it can fly")
            .vehicles[0];
        (flown.has_fence, flown.broke_fence_s)
    };
    let circle = [("FENCE_RADIUS", 100.0), ("FENCE_TYPE", 2.0)];
    let on = ("FENCE_ENABLE", 1.0);
    let report = ("FENCE_ACTION", 0.0);
    assert_eq!(broken(&circle), (false, None), "switched off");
    let (has_fence, at_s) = broken(&[&circle[..], &[on, report]].concat());
    assert!(
        has_fence && at_s.is_some_and(|at_s| at_s > 10.0),
        "{at_s:?}"
    );
    let ceiling = [("FENCE_ALT_MAX", 15.0), ("FENCE_RADIUS", 300.0), on, report];
    let of_kind = |kind| broken(&[&ceiling[..], &[("FENCE_TYPE", kind)]].concat());
    assert!(of_kind(1.0).1.is_some(), "20 m is above 15 m");
    assert_eq!(of_kind(2.0), (true, None), "only the circle is on");
}

#[test]
fn a_fence_that_a_command_has_switched_counts_with_its_lower_limit() {
    let floor = [
        ("FENCE_TYPE", 8.0),
        ("FENCE_ALT_MIN", -5.0),
        ("FENCE_ACTION", 0.0),
    ];
    let mut low = fenced(&floor);
    // Down a slope, below home.
    low.document.plan[1].z = -8.0;
    let flown = |switch, enable| {
        let mut one = low.clone();
        one.parameters.push(("FENCE_ENABLE".to_owned(), enable));
        one.fence_switch = switch;
        rehearse(&[one], &calm()).expect("it can fly").vehicles[0]
    };
    assert_eq!(
        flown(None, 1.0).broke_fence_s,
        None,
        "a parameter leaves the lower limit off"
    );
    assert!(flown(Some(true), 0.0).has_fence);
    assert!(!flown(Some(false), 1.0).has_fence);
}
