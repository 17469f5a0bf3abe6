//! Tests of conditions: their values, and that no input makes the parser panic.

use std::collections::{BTreeMap, BTreeSet};
use std::time::Duration;

use proptest::prelude::*;

use super::{Expression, ExpressionNames};
use crate::mission::craft::Craft;
use crate::mission::event::scope::{Scope, Sight};
use crate::mission::sensor::Sensor;
use crate::mission::zone::{Shape, Zone, ZoneKind};
use crate::scoring::AlertLevel;

fn zones() -> Vec<Zone> {
    let circle = |id: &str, center| Zone {
        id: id.to_owned(),
        kind: ZoneKind::Task,
        shape: Shape::Circle {
            center,
            radius_m: 20.0,
        },
        active: true,
        jitter_m: 0.0,
    };
    vec![circle("lane", [0.0, 0.0]), circle("far", [500.0, 0.0])]
}

fn crafts() -> Vec<Craft> {
    let craft = |id, at, height_m, speed_m_s| {
        let mut craft = Craft::new(id, &[], 1);
        craft.at = Some(at);
        craft.height_m = height_m;
        craft.speed_m_s = speed_m_s;
        craft.under_way = true;
        craft.battery_percent = Some(60.0);
        craft
    };
    let mut parked = craft(3, [0.0, -50.0], 0.0, 0.0);
    parked.under_way = false;
    vec![
        craft(1, [3.0, 4.0], 12.0, 5.0),
        craft(2, [100.0, 0.0], 30.0, 0.2),
        parked,
    ]
}

fn leaked(names: &[&str]) -> &'static [String] {
    let names: Vec<String> = names.iter().map(|name| (*name).to_owned()).collect();
    names.leak()
}

fn names(zones: &[Zone]) -> ExpressionNames<'_> {
    ExpressionNames {
        zones,
        objectives: leaked(&["cover"]),
        hazards: leaked(&["mines"]),
        sensors: Box::leak(Box::new([Sensor::by_id("s_mag").expect("it is known")])),
        events: leaked(&["first", "second"]),
        movers: leaked(&["walker"]),
        vehicles: 3,
        are_open: false,
    }
}

/// Whether a condition holds 100 s into a flight.
fn holds(source: &str) -> bool {
    let (zones, crafts) = (zones(), crafts());
    let expression = Expression::parse(source, &names(&zones)).expect(source);
    let (vehicles, margins_db) = (BTreeMap::new(), BTreeMap::from([(1, 4.5)]));
    expression.holds(&Scope {
        sight: Sight {
            now: Duration::from_secs(100),
            crafts: &crafts,
            vehicles: &vehicles,
            standings: &[],
            contacts: &[],
            marks: &[],
            last_command: Some(Duration::from_secs(70)),
            refused: 2,
        },
        zones: &zones,
        active: &[true, false],
        movers: &[],
        alerts: BTreeSet::from([AlertLevel::Critical]),
        fired: &[true, false],
        margins_db: &margins_db,
        wind_m_s: 7.5,
        chance: (1, 2),
    })
}

fn fault(source: &str) -> (usize, String) {
    let zones = zones();
    let fault = Expression::parse(source, &names(&zones)).expect_err(source);
    let help = fault.help.map_or(String::new(), |help| help.to_string());
    (fault.span.start, format!("{} {help}", fault.message))
}

#[test]
fn conditions_have_the_values_that_they_say() {
    for (source, expected) in [
        ("t > 99 and t <= 100", true),
        ("t = 100", true),
        ("t() != 100", false),
        ("1 + 2 * 3 == 7", true),
        ("(1 + 2) * 3 == 7", false),
        ("-2 - -3 == 1", true),
        ("8 / 4 / 2 == 1", true),
        ("1 / 0 > 1e9", true),
        ("0 / 0 == 0 / 0", false),
        ("true or false and false", true),
        ("(true or false) and false", false),
        ("not t > 200 and true", true),
        ("not not true", true),
        ("'a' == 'a' and 'a' != 'b'", true),
        ("true == (1 < 2)", true),
        ("agl_min() == 12 and airborne == 2", true),
        ("vehicle(1).airborne and not vehicle(3).airborne", true),
        (
            "vehicle(1).x == 3 and vehicle(1).y == 4 and vehicle(1).z == 12",
            true,
        ),
        ("vehicle(2).battery == 60 and vehicle(2).speed < 1", true),
        ("vehicle(1).link == 4.5 and vehicle(2).link > 1000", true),
        ("vehicle(1).mode == ''", true),
        ("inside('lane') == 1 and inside(far) == 0", true),
        ("outside('far') and not outside('lane')", true),
        ("active('lane') and not active('far')", true),
        ("no_command(30) and not no_command(31)", true),
        ("refused == 2", true),
        ("paused_or_clear('lane', 0)", false),
        ("paused_or_clear('far', 10)", true),
        ("paused_or_clear('walker', 10)", true),
        ("clearance('lane') == 0 and clearance('far') > 0", true),
        ("alert_open('critical') and not alert_open(warning)", true),
        ("fired('first') and not fired('second')", true),
        (
            "wind > 7 and contacts == 0 and marks == 0 and found('mines') < 1",
            true,
        ),
        (
            "coverage('cover') == 0 and progress('cover') == 0 and not met('cover')",
            true,
        ),
        (
            "separation > 90 and separation < 99.1 and battery_min == 60",
            true,
        ),
        ("lost == 0 and speed('s_mag') == 0", true),
        ("rand(1) and not rand(0)", true),
        ("mode_all(['LAND', 'RTL']) and not mode_any([LAND])", true),
    ] {
        assert_eq!(holds(source), expected, "{source}");
    }
}

#[test]
fn faults_are_told_with_their_place_and_the_nearest_name() {
    for (source, at, says) in [
        ("", 0, "a value is missing at the end"),
        ("t >", 2, "a value is missing at the end"),
        ("t", 0, "a condition is needed here, not a number"),
        ("t > 'x'", 4, "a number is needed here, not text in quotes"),
        ("1 and true", 0, "a condition is needed here, not a number"),
        ("t > 5 > 3", 6, "`>` was not expected here"),
        ("(t > 5", 5, "`)` is missing at the end"),
        ("tt > 5", 0, "unknown name `tt`"),
        ("airborn > 1", 0, "airborne"),
        ("inside('lan') > 0", 7, "lane"),
        ("vehicle(4).airborne", 8, "vehicles 1 to 3"),
        ("vehicle(1).hight > 2", 11, "a vehicle has no `hight`"),
        ("vehicle(1) > 2", 11, "`.` is needed here"),
        ("mode_any(['LNAD'])", 10, "LAND"),
        ("alert_open('urgent')", 11, "a level of alerts"),
        ("fired('third')", 6, "the id of an event"),
        ("t > 5 # 3", 6, "`#` has no meaning here"),
        ("1.2.3 > 1", 0, "`1.2.3` is not a number"),
        ("'open", 0, "is not closed"),
        ("no_command('x')", 11, "a number is needed here"),
        ("paused_or_clear('lane')", 22, "`,` is needed here"),
    ] {
        let (place, message) = fault(source);
        assert_eq!(place, at, "{source}: {message}");
        assert!(message.contains(says), "{source}: {message}");
    }
}

#[test]
fn nesting_and_length_are_limited() {
    let deep = |depth: usize| format!("{}true{}", "(".repeat(depth), ")".repeat(depth));
    assert!(holds(&deep(30)));
    assert!(fault(&deep(40)).1.contains("at most 32 levels"));
    assert!(fault(&"not ".repeat(200)).1.contains("at most 32 levels"));
    assert!(fault(&"t+".repeat(2000)).1.contains("at most 1000"));
    // Long chains do not count as nesting.
    assert!(holds(&format!("{}true", "true and ".repeat(100))));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn whatever_is_written_is_a_condition_or_a_fault_within_it(source in "\\PC{0,60}") {
        check(&source);
    }

    #[test]
    fn words_of_the_language_in_any_order_do_no_harm(
        words in proptest::collection::vec(
            prop::sample::select(vec![
                "t", "not", "and", "or", "(", ")", "-", "+", "*", "/", "<", "==", "1", "0", "'lane'",
                "inside", "vehicle", ".", "airborne", "mode_any", "[", "]", ",", "rand", "é", "true",
            ]),
            0..40,
        )
    ) {
        check(&words.join(" "));
    }
}

fn check(source: &str) {
    let zones = zones();
    match Expression::parse(source, &names(&zones)) {
        Ok(_) => {
            holds(source);
        }
        Err(fault) => assert!(fault.span.end <= source.len() && fault.span.start <= fault.span.end),
    }
}
