//! The lists on board vehicles, on the map.

use std::sync::Arc;

use sortie::app::room::map::{SketchKind, sketches};
use sortie::config::Symbols;
use sortie::text::Language;
use sortie::vehicle::Plan;

use super::map::{drawn, planned, resized};
use crate::harness::Console;

/// A takeoff without a place happens at home, so the plan is drawn from there.
#[test]
fn a_plan_begins_at_home_if_its_takeoff_has_no_place() {
    let home = planned(1).home.expect("a home").at_point;
    let begin = |takeoff: (i32, i32)| {
        let mut vehicle = planned(1);
        let plan = vehicle.plans.plan.content.take().expect("a plan");
        let mut items = plan.items.clone();
        (items[1].command, items[1].x, items[1].y) = (22, takeoff.0, takeoff.1);
        vehicle.plans.plan.content = Some(Arc::new(Plan {
            items,
            home_first: true,
        }));
        let mut console = Console::flying(0);
        console.vehicle(vehicle);
        let ways = sketches(console.state()).into_iter();
        let mut ways = ways.filter(|it| it.kind == SketchKind::Plan && it.points.len() > 1);
        ways.next().expect("a way").points
    };
    let in_place = begin((0, 0));
    assert!(in_place[0].distance_m(home) < 0.1);
    assert_eq!(in_place.len(), 3);
    let placed = begin(home.moved(20.0, 0.0).to_e7());
    assert!((placed[0].distance_m(home) - 20.0).abs() < 0.5);
}

/// An area to stay out of has an unbroken border with a sign inside, even without colours and braille.
#[test]
fn areas_to_stay_out_of_have_a_sign_inside() {
    let mut console = Console::flying(0);
    console.vehicle(planned(1)).press("M");
    let mut console = resized(console, (120, 40));
    console.press("z");
    let text = drawn(&console, Symbols::Ascii, Language::English, (120, 40));
    insta::assert_snapshot!("map_plan_ascii_120x40", text);
}
