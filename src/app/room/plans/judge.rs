//! The faults of a draft according to the vehicle's limits, and the speeds at which the vehicle
//! would fly the draft.

use crate::app::State;
use crate::plan::Document;
use crate::plan::check::{
    CheckOptions, Finding, FindingKind, USUAL_CLEARANCE_M, check, check_terrain,
};
use crate::plan::effort::Pace;
use crate::vehicle::check_rules;

/// A parameter of the vehicle under the cursor, if it is known.
fn parameter(state: &State, name: &str) -> Option<f32> {
    let vehicle = state.session.choice.cursor?;
    let known = state.rooms.parameters.get(vehicle, name)?;
    Some(known.value as f32)
}

/// The speeds used to compute a draft's times: the user's setting, otherwise the parameters of the
/// vehicle under the cursor, otherwise ArduPilot's defaults.
pub fn pace(state: &State) -> Pace {
    let usual = Pace::default();
    let own = |name, usual| {
        let centimetres = parameter(state, name).filter(|value| *value > 0.0);
        centimetres.map_or(usual, |value| f64::from(value) / 100.0)
    };
    let given = state.rooms.plans.speed_m_s;
    Pace {
        speed_m_s: given.unwrap_or_else(|| own("WPNAV_SPEED", usual.speed_m_s)),
        climb_m_s: own("WPNAV_SPEED_UP", usual.climb_m_s),
        descent_m_s: own("WPNAV_SPEED_DN", usual.descent_m_s),
        accel_m_s2: own("WPNAV_ACCEL", usual.accel_m_s2),
        landing_m_s: own("LAND_SPEED", usual.landing_m_s),
        ..usual
    }
}

/// The faults of a document according to the parameters of the vehicle under the cursor, and its
/// clearance above known ground.
pub fn findings(state: &State, document: &Document) -> Vec<Finding> {
    let vehicle = state.session.choice.cursor;
    let vehicle = vehicle.and_then(|id| state.session.vehicles().get(&id));
    let reported = vehicle.and_then(|it| it.reports_fence_on());
    let rules = CheckOptions {
        // A draft may be for another vehicle: terrain data count only if they are known.
        has_terrain: parameter(state, "TERRAIN_ENABLE").is_some_and(|value| value > 0.0),
        ..check_rules(state.class(), reported, |name| parameter(state, name))
    };
    let mut findings = check(document, &rules);
    let ground = state.rooms.plans.ground();
    if !ground.is_empty() {
        let height = |place| ground.height_m(place);
        findings.extend(check_terrain(document, &height, USUAL_CLEARANCE_M));
        findings.sort_by_key(|finding| (finding.list, finding.item));
    }
    counted_once(findings)
}

/// Removes repeated findings. A fence item that the vehicle refuses and the same item's fence fault
/// count as one.
fn counted_once(findings: Vec<Finding>) -> Vec<Finding> {
    let mut once: Vec<Finding> = Vec::new();
    for finding in findings {
        let is_known = |known: &Finding| {
            let is_refused = matches!(known.kind, FindingKind::Refused { .. })
                && matches!(finding.kind, FindingKind::Fence(_));
            let is_there = (known.list, known.item) == (finding.list, finding.item);
            *known == finding || is_there && is_refused
        };
        if !once.iter().any(is_known) {
            once.push(finding);
        }
    }
    once
}
