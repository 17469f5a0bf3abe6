//! Tests with worked examples, real drones, and properties of every design.

use std::collections::BTreeSet;

use super::{Air, Design, DesignKind, FindingKind, FindingSeverity, Part, PartSlot, part, parts};
use crate::text::{Language, Locale};

mod driving;
mod machines;
mod properties;
mod worked;

fn design(name: &str, ids: &str) -> Design {
    ids.split_whitespace()
        .fold(Design::new(name), |design, id| {
            design.with(part(id).unwrap_or_else(|| panic!("no part {id}")))
        })
}

#[test]
fn cold_takes_time_away_and_height_thrust() {
    let drone = worked::WORKED[1].design();
    let figures = |air| drone.figures(air).expect("complete");
    let warm = figures(Air::default());
    let cold = figures(Air {
        battery_c: -10.0,
        ..Air::default()
    });
    let high = figures(Air {
        altitude_m: 2000.0,
        temperature_c: 2.0,
        ..Air::default()
    });
    assert!(cold.hover_time_s < 0.76 * warm.hover_time_s);
    let thrust = high.thrust_to_weight / warm.thrust_to_weight;
    assert!((0.80..0.90).contains(&thrust), "{thrust}");
}

#[test]
fn radios_reach_as_far_as_their_budget() {
    // Ranges with a margin of 20 dB, computed by hand from P.525 and the two-ray model.
    for (radio, low_m, high_m) in [
        ("r_wifi24", 300.0, 300.0),
        ("r_sik915", 1800.0, 4000.0),
        ("r_rfd900", 4200.0, 9400.0),
        ("r_mesh24", 2200.0, 2400.0),
    ] {
        let drone = Design::new("radio").with(part(radio).expect("known"));
        for (height_m, wanted_m) in [(10.0, low_m), (50.0, high_m)] {
            let found_m = drone.link(height_m).expect("a radio").range_m;
            let error_m: f64 = found_m - wanted_m;
            // Computed by hand, to a hundred metres.
            assert!(
                error_m.abs() < 75.0,
                "{radio} at {height_m} m: {found_m:.0} m"
            );
        }
    }
}

#[test]
fn every_part_has_a_name_of_its_own_in_each_language() {
    for language in Language::ALL {
        let locale = Locale::new(language);
        let names: BTreeSet<String> = parts()
            .map(|part| format!("{:?} {}", part.slot(), locale.text(&part.name())))
            .collect();
        assert_eq!(names.len(), parts().count(), "{language:?}");
    }
}

#[test]
fn faults_of_a_design_are_told_with_their_reason() {
    let told = |ids: &str| -> Vec<String> {
        let drone = design("test", ids);
        let findings = drone.findings(Air::default());
        let faults = findings
            .iter()
            .filter(|f| f.severity() == FindingSeverity::Fault);
        faults.map(|f| f.text.to_string()).collect()
    };
    let whole = |drive: &str| format!("{drive} gps_m8n pm_02 fc_h7 r_sik915");
    assert!(told(&whole("fr_450q m2212_920 p10x4.5p b3s5000 e30opto")).is_empty());
    let cases = [
        ("fr_450q m2212_920 p15x5.5 b3s5000 e30opto", "15"),
        ("fr_450q m2212_920 p10x4.5p b6s22000 e30opto", "6"),
        ("fr_450q m2203_2000 p5x4.5 b3s5000 e30opto", "thrust"),
        ("fr_450q m2212_920 p10x4.5p e30opto", "battery"),
    ];
    for (drive, word) in cases {
        let faults = told(&whole(drive)).join("; ");
        assert!(faults.to_lowercase().contains(word), "{drive}: {faults}");
    }
}
