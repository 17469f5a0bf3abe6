//! Arbitrary flights for property tests.

use proptest::prelude::*;

use super::*;

/// The rules that these flights may break; breaking them does not harm people.
const BROKEN: [SafetyKind; 8] = [
    SafetyKind::Geofence,
    SafetyKind::Crash,
    SafetyKind::Separation,
    SafetyKind::Collision,
    SafetyKind::BatteryLow,
    SafetyKind::BatteryCritical,
    SafetyKind::OffPad,
    SafetyKind::NoFly,
];

prop_compose! {
    fn any_objective()(
        (share, whole) in (0.0..=1.0f64, any::<bool>()),
        mandatory in any::<bool>(),
        quality in proptest::option::of(0.0..=1.0f64),
        is_measured in any::<bool>(),
    ) -> ObjectiveFact {
        ObjectiveFact {
            product: quality.map(|quality| Product {
                quality,
                words: "map".into(),
                advice: Text::default(),
                is_measured,
            }),
            ..objective(if whole { 1.0 } else { share }, mandatory)
        }
    }
}

/// Gives each objective its own texts.
fn numbered((index, objective): (usize, ObjectiveFact)) -> ObjectiveFact {
    let words = |what: &str| format!("{what} {index}").into();
    ObjectiveFact {
        advice: words("sample more of"),
        product: objective.product.map(|product| Product {
            words: words("map"),
            ..product
        }),
        ..objective
    }
}

prop_compose! {
    fn any_alert()(level in 0..3usize, limit_s in 1u64..60, after_s in proptest::option::of(0u64..200)) -> AlertFact {
        AlertFact {
            text: "alert".into(),
            level: [AlertLevel::Caution, AlertLevel::Warning, AlertLevel::Critical][level],
            at: Duration::ZERO,
            limit: Duration::from_secs(limit_s),
            answered_after: after_s.map(Duration::from_secs),
        }
    }
}

prop_compose! {
    fn any_use()(airborne_s in 0u64..500, productive in 0.0..=1.0f64, idle in 0.0..=1.0f64) -> VehicleUse {
        let airborne = Duration::from_secs(airborne_s);
        VehicleUse {
            vehicle: 1,
            airborne,
            productive: airborne.mul_f64(productive),
            idle: airborne.mul_f64((1.0 - productive) * idle),
        }
    }
}

prop_compose! {
    pub fn any_facts()(
        objectives in proptest::collection::vec(any_objective(), 1..5),
        elapsed_s in 0u64..1000,
        energy in proptest::option::of(0.0..100.0f64),
        breaches in proptest::collection::vec((0..BROKEN.len(), 0u64..100), 0..6),
        (accepted, empty, rejected, dangerous, duplicates) in (0u32..100, 0u32..9, 0u32..100, 0u32..9, 0u32..9),
        alerts in proptest::collection::vec(any_alert(), 0..4),
        usage in proptest::collection::vec(any_use(), 1..9),
        (levels, free_level) in (proptest::array::uniform3(0u32..5), 0u8..=3),
    ) -> Facts {
        Facts {
            objectives: objectives.into_iter().enumerate().map(numbered).collect(),
            elapsed: Duration::from_secs(elapsed_s),
            energy_wh: energy,
            safety: breaches.iter().map(|&(kind, s)| event(BROKEN[kind], s)).collect(),
            commands: CommandTally { given: accepted + empty + rejected + dangerous + duplicates, accepted, empty, rejected, forgiven: 0, dangerous, duplicates },
            alerts,
            vehicles: usage.len(),
            usage,
            hints: HintsUsed { levels, free_level },
            given_up: false,
        }
    }
}
