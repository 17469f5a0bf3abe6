//! The embedded simulator beside flights of the real `ArduCopter` (tests/data/fidelity/README.md).

use std::path::Path;

use sortie::fidelity::{self, Comparison, Flight, Recording};

/// Position may differ by this much, root-mean-square, at up to [`FAST_M_S`].
const POSITION_RMS_M: f64 = 1.5;
const FAST_M_S: f64 = 10.4;
/// Arrivals may differ by this share, or by this many seconds if they are near.
const ARRIVAL_PERCENT: f64 = 5.0;
const ARRIVAL_S: f64 = 0.25;

/// What misses an aim: the recording, the manoeuvre, its second in the recording, and the most that is measured of
/// the difference in position (metres) and in arrival (percent). The aims hold for everything else.
const EXCEPTIONS: &[(&str, &str, f64, f64, f64)] = &[
    // At 30 degrees of lean a sinking vehicle has less thrust, and flies 9.7 m/s instead of 10.2.
    ("b_classic", "to 0 -50 -20", 91.5, 2.3, 5.0),
    // 20 m/s were asked and drag allows 10.3: the real path runs a little ahead of the vehicle, and stops later.
    ("b_classic", "velocity 0 0 0", 156.0, 1.8, 5.0),
    // From 8 m/s downwards: 0.4 s later.
    ("b_classic", "velocity 0 0 0", 216.2, 1.5, 25.0),
    // The nose follows the course and the course the nose: what is a few degrees at first grows to 20.
    ("b_classic", "velocity 5 0 0 of the body", 228.2, 3.0, 5.0),
    ("b_classic", "velocity 0 0 0", 234.2, 2.2, 5.0),
    ("b_classic", "to 0 0 -30", 294.2, 5.6, 5.0),
    // The real vehicle pitches up 0.2 s sooner.
    ("b_classic", "BRAKE", 500.6, 1.9, 14.0),
    // After 0.7 s of DRIFT without thrust, at 8 m/s downwards.
    ("b_classic", "GUIDED", 534.4, 1.5, 75.0),
    // 5 m higher after ACRO, whose throttle at the middle holds the real vehicle and lifts ours.
    ("b_classic", "RTL", 544.6, 4.6, 5.0),
];

fn compared(name: &str) -> Comparison {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/fidelity");
    let read = |ending: &str| std::fs::read(folder.join(format!("{name}{ending}"))).expect("there");
    fidelity::fly(&Recording::from_tlogs(&read(".tlog"), &read(".tx.tlog")))
}

fn arrival_is_off(flight: &Flight) -> bool {
    let (Some(real), Some(simulated)) = (flight.recorded_reach_s, flight.simulated_reach_s) else {
        return flight.recorded_reach_s.is_some() != flight.simulated_reach_s.is_some();
    };
    let late = (simulated - real).abs();
    late > ARRIVAL_S && late > real * ARRIVAL_PERCENT / 100.0
}

/// What misses the aims, in words.
fn faults(name: &str, comparison: &Comparison) -> Vec<String> {
    let mut faults = Vec::new();
    for flight in &comparison.manoeuvres {
        let position = flight.position_m.rms;
        let off = flight.top_speed_m_s <= FAST_M_S && position > POSITION_RMS_M;
        let late = flight.later_percent().unwrap_or_default();
        let exception = EXCEPTIONS.iter().find(|(recording, manoeuvre, at_s, ..)| {
            *recording == name && *manoeuvre == flight.name && (at_s - flight.at_s).abs() < 1.0
        });
        let excused = exception.is_some_and(|(.., most_m, most_percent)| {
            position <= *most_m && late.abs() <= *most_percent
        });
        if (off || arrival_is_off(flight)) != exception.is_some() || exception.is_some() && !excused
        {
            faults.push(format!(
                "{name} at {:.1} s, {}: {position:.2} m, there after {:?} instead of {:?} s ({late:+.1} %)",
                flight.at_s, flight.name, flight.simulated_reach_s, flight.recorded_reach_s
            ));
        }
    }
    for answers in &comparison.answers {
        if ["acks", "modes"].contains(&answers.kind) && !answers.identical() {
            faults.push(format!("{name}: {:?}", answers.first_difference));
        }
    }
    faults
}

#[test]
fn manoeuvres_are_flown_like_the_real_ones_and_answered_in_the_same_order() {
    let mut all = Vec::new();
    for (name, manoeuvres) in [("b_classic", 45), ("k_steps_50hz", 18)] {
        let comparison = compared(name);
        let count = comparison.manoeuvres.len();
        assert!(count >= manoeuvres, "only {count} manoeuvres of {name}");
        all.extend(faults(name, &comparison));
    }
    assert!(all.is_empty(), "{}", all.join("\n"));
}

#[test]
fn every_recording_can_be_replayed() {
    for name in [
        "c2_refusals_air",
        "d_mission",
        "e_fence_rally",
        "g_batt",
        "g_gps",
    ] {
        let comparison = compared(name);
        assert!(
            comparison.manoeuvres.len() > 2,
            "{name}: nothing is compared"
        );
        assert!(
            comparison
                .manoeuvres
                .iter()
                .all(|flight| flight.position_m.rms.is_finite())
        );
        assert!(comparison.answers[0].recorded > 4, "{name}: no acks");
    }
}
