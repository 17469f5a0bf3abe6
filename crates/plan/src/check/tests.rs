use super::*;
use crate::Home;

const HOME: Home = Home {
    x: 504_501_000,
    y: 305_234_000,
    z: 170.0,
};

fn item(command: u16, north_m: f64, east_m: f64, z: f32) -> Item {
    let home = sortie_geo::LatLon::from_e7(HOME.x, HOME.y);
    let (x, y) = if command::has_place(command) {
        home.moved(north_m, east_m).to_e7()
    } else {
        (0, 0)
    };
    Item {
        command,
        frame: 3,
        auto_continue: true,
        params: [0.0; 4],
        x,
        y,
        z,
    }
}

fn good() -> Document {
    Document {
        home: Some(HOME),
        plan: vec![
            item(22, 0.0, 0.0, 20.0),
            item(16, 100.0, 0.0, 20.0),
            item(16, 100.0, 100.0, 25.0),
            item(20, 0.0, 0.0, 0.0),
        ],
        ..Document::default()
    }
}

fn with(item: Item, params: [f32; 4]) -> Item {
    Item { params, ..item }
}

fn square(command: u16, centre: [f64; 2], half_m: f64) -> Vec<Item> {
    let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
    let corner = |(north, east): (f64, f64)| {
        let place = item(
            command,
            centre[0] + north * half_m,
            centre[1] + east * half_m,
            0.0,
        );
        with(Item { frame: 0, ..place }, [4.0, 0.0, 0.0, 0.0])
    };
    corners.map(corner).to_vec()
}

fn found(document: &Document, options: &CheckOptions) -> Vec<(Option<usize>, FindingKind)> {
    let findings = check(document, options);
    findings
        .into_iter()
        .map(|finding| (finding.item, finding.kind))
        .collect()
}

fn found_usual(document: &Document) -> Vec<(Option<usize>, FindingKind)> {
    found(document, &CheckOptions::default())
}

#[test]
fn a_sound_plan_has_no_findings() {
    assert_eq!(found_usual(&good()), []);
    assert_eq!(found_usual(&Document::default()), []);
}

#[test]
fn what_an_upload_refuses_is_an_error_and_what_a_flight_skips_a_warning() {
    let mut plan = good();
    plan.plan.insert(1, item(195, 10.0, 0.0, 0.0));
    plan.plan.insert(2, item(83, 0.0, 0.0, 0.0));
    let findings = check(&plan, &CheckOptions::default());
    let kinds: Vec<_> = findings
        .iter()
        .map(|it| (it.item, it.kind, it.severity()))
        .collect();
    let refused = FindingKind::Refused {
        command: 195,
        reason: Refusal::Command,
    };
    let skipped = FindingKind::Skipped {
        command: 83,
        vehicle: VehicleKind::Copter,
    };
    assert_eq!(
        kinds,
        [
            (Some(1), refused, Severity::Error),
            (Some(2), skipped, Severity::Warning)
        ]
    );
    let plane = CheckOptions {
        vehicle: Some(VehicleKind::Plane),
        ..CheckOptions::default()
    };
    assert_eq!(found(&plan, &plane), [(Some(1), refused)]);
    let long = Document {
        plan: vec![item(16, 1.0, 1.0, 10.0); 650],
        ..good()
    };
    let too_many = FindingKind::TooMany {
        count: 651,
        most: 650,
    };
    assert_eq!(found_usual(&long)[0], (None, too_many));
}

#[test]
fn jumps_lead_somewhere() {
    let with_jump = |jump: Item| {
        let mut plan = good();
        plan.plan.insert(3, jump);
        found_usual(&plan)
    };
    let jump = |target: f32, times| with(item(177, 0.0, 0.0, 0.0), [target, times, 0.0, 0.0]);
    assert_eq!(with_jump(jump(2.0, 3.0)), []);
    let nowhere = FindingKind::JumpNowhere { target: 9, last: 5 };
    assert!(with_jump(jump(9.0, 1.0)).contains(&(Some(3), nowhere)));
    assert!(with_jump(jump(4.0, 1.0)).contains(&(Some(3), FindingKind::JumpRing)));
    let endless = FindingKind::NeverEnds { first: 2, last: 3 };
    assert_eq!(
        with_jump(jump(2.0, -1.0)),
        [(None, endless), (Some(4), FindingKind::Unreached)]
    );
    let tag = with(item(601, 0.0, 0.0, 0.0), [7.0, 1.0, 0.0, 0.0]);
    assert_eq!(with_jump(tag), [(Some(3), FindingKind::NoTag(7))]);
}

#[test]
fn a_plan_that_repeats_its_items_for_ever_never_ends() {
    let jump = |target: f32, times| with(item(177, 0.0, 0.0, 0.0), [target, times, 0.0, 0.0]);
    let mut plan = good();
    plan.plan.truncate(3);
    plan.plan.push(jump(1.0, -1.0));
    let endless = FindingKind::NeverEnds { first: 1, last: 3 };
    assert_eq!(found_usual(&plan), [(None, endless)]);
    let rest = good().plan;
    plan.plan.extend(&rest[2..]);
    let mut expected = vec![(None, endless)];
    let unreached = 4..plan.plan.len();
    expected.extend(unreached.map(|index| (Some(index), FindingKind::Unreached)));
    assert_eq!(found_usual(&plan), expected);
    // An endless jump that skips items, and a jump that is repeated twice, let the plan end.
    let mut ends = good();
    ends.plan.insert(1, jump(3.0, -1.0));
    ends.plan.insert(3, jump(1.0, 2.0));
    let kinds = found_usual(&ends);
    assert!(
        kinds
            .iter()
            .all(|(_, kind)| !matches!(kind, FindingKind::NeverEnds { .. })),
        "{kinds:?}"
    );
}

#[test]
fn a_plan_begins_with_a_takeoff_and_ends() {
    let mut plan = good();
    plan.plan.remove(0);
    plan.plan.pop();
    assert_eq!(
        found_usual(&plan),
        [(None, FindingKind::NoTakeoff), (None, FindingKind::NoEnd)]
    );
    let rover = CheckOptions {
        vehicle: Some(VehicleKind::Rover),
        ..CheckOptions::default()
    };
    assert_eq!(found(&plan, &rover), []);
}

#[test]
fn fences_hold_for_home_for_places_and_for_the_legs_between_them() {
    let inside = Document {
        fence: square(command::FENCE_POLYGON_INCLUSION, [50.0, 50.0], 80.0),
        ..good()
    };
    assert_eq!(found_usual(&inside), []);
    let narrow = Document {
        fence: square(command::FENCE_POLYGON_INCLUSION, [100.0, 50.0], 80.0),
        ..good()
    };
    let area = BrokenArea {
        area: 0,
        is_exclusion: false,
    };
    let home = FindingKind::HomeBreaksFence(area);
    let takeoff = FindingKind::BreaksFence(area);
    assert_eq!(found_usual(&narrow), [(Some(0), takeoff), (None, home)]);
    let tower = Document {
        fence: square(command::FENCE_POLYGON_EXCLUSION, [100.0, 50.0], 10.0),
        ..good()
    };
    let leg = FindingKind::LegBreaksFence { area: 0 };
    assert_eq!(found_usual(&tower), [(Some(2), leg)]);
    let circle = with(
        item(command::FENCE_CIRCLE_EXCLUSION, 50.0, 3.0, 0.0),
        [5.0, 0.0, 0.0, 0.0],
    );
    let pond = Document {
        fence: vec![circle],
        ..good()
    };
    assert_eq!(found_usual(&pond), [(Some(1), leg)]);
    let mut broken = square(command::FENCE_POLYGON_EXCLUSION, [300.0, 50.0], 10.0);
    broken.pop();
    let broken = Document {
        fence: broken,
        ..good()
    };
    let count = FindingKind::Fence(FenceError::ItemCount);
    assert_eq!(found_usual(&broken), [(Some(2), count)]);
}

/// ArduCopter ignores rally points outside its fence: it returns home instead.
#[test]
fn rally_points_outside_the_fence_are_ignored() {
    let rally = |north_m, height_m| item(command::RALLY_POINT, north_m, 0.0, height_m);
    let mut plan = Document {
        fence: square(command::FENCE_POLYGON_INCLUSION, [50.0, 50.0], 80.0),
        rally: vec![rally(20.0, 20.0), rally(200.0, 20.0)],
        ..good()
    };
    let ignored = FindingKind::RallyIgnored;
    let at = |area, is_exclusion| ignored(RallyFault::Area(BrokenArea { area, is_exclusion }));
    assert_eq!(found_usual(&plan), [(Some(1), at(0, false))]);
    assert_eq!(at(0, false).severity(), Severity::Warning);
    let tower = square(command::FENCE_POLYGON_EXCLUSION, [30.0, -20.0], 5.0);
    plan.fence.extend(tower);
    plan.rally[0] = item(command::RALLY_POINT, 30.0, -20.0, 20.0);
    let expected = [(Some(0), at(1, true)), (Some(1), at(0, false))];
    assert_eq!(found_usual(&plan), expected);
    plan.fence.clear();
    let options = CheckOptions {
        ceiling_m: Some(50.0),
        radius_m: Some(150.0),
        ..CheckOptions::default()
    };
    plan.rally[0].z = 60.0;
    let above = RallyFault::Ceiling {
        height_m: 60.0,
        most_m: 50.0,
    };
    let findings = found(&plan, &options);
    assert_eq!(findings[0], (Some(0), ignored(above)));
    assert!(matches!(
        findings[1],
        (
            Some(1),
            FindingKind::RallyIgnored(RallyFault::Radius { .. })
        )
    ));
    assert_eq!(findings.len(), 2);
}

#[test]
fn limits_hold_above_home_whatever_the_frame() {
    let mut plan = good();
    plan.plan[2].frame = 0;
    plan.plan[2].z = 300.0;
    let options = CheckOptions {
        ceiling_m: Some(100.0),
        radius_m: Some(120.0),
        ..CheckOptions::default()
    };
    let findings = found(&plan, &options);
    let above = FindingKind::AboveCeiling {
        height_m: 130.0,
        most_m: 100.0,
    };
    let mixed = FindingKind::MixedFrames {
        before: Height {
            metres: 20.0,
            frame: HeightFrame::Home,
        },
        here: Height {
            metres: 300.0,
            frame: HeightFrame::SeaLevel,
        },
        above_home_m: Some([20.0, 130.0]),
    };
    assert_eq!(findings[..2], [(Some(2), above), (Some(2), mixed)]);
    assert!(
        matches!(findings[2], (Some(2), FindingKind::BeyondRadius { distance_m, .. }) if (distance_m - 141.4).abs() < 0.5)
    );
    plan.plan[2].frame = 10;
    assert!(found_usual(&plan).contains(&(Some(2), FindingKind::NoTerrain)));
    plan.plan[2].frame = 3;
    plan.plan[2].z = -5.0;
    let low = |may_slope| FindingKind::LowHeight {
        height_m: -5.0,
        may_slope,
    };
    assert_eq!(found_usual(&plan), [(Some(2), low(false))]);
    let slope = CheckOptions {
        may_slope: true,
        ..CheckOptions::default()
    };
    assert_eq!(found(&plan, &slope), [(Some(2), low(true))]);
    let severities = [false, true].map(|may_slope| low(may_slope).severity());
    assert_eq!(severities, [Severity::Error, Severity::Warning]);
}

#[test]
fn commands_with_a_place_are_stored_with_one() {
    let unsupported = [25, 36, 80, 195];
    let plan = (0..5000).filter(|number| command::has_place(*number));
    for number in plan.filter(|number| !unsupported.contains(number)) {
        assert!(board::has_place(number), "{number}");
    }
}
