//! Whether a list is fit for a vehicle: the findings of a check, by the vehicle's own rules.

use super::list::{PlanOrderGoal, whole};
use super::{Desk, PlanOnFile};
use crate::plan::check::{Severity, check};
use crate::plan::{Document, Home, ListKind};
use crate::preflight::{finding_words, list_words};
use crate::text;
use crate::text::Text;
use crate::vehicle::{Vehicle, VehicleClass, check_rules};

/// The maximum number of warnings that a row shows.
const MOST_SHOWN: usize = 2;

/// A document's list for a vehicle, with warnings, unless it has errors.
///
/// # Errors
/// The list is empty, or has errors: the first error, and the number of others.
pub(super) fn checked(
    content: PlanOnFile,
    kind: ListKind,
    desk: &Desk<'_>,
) -> Result<PlanOrderGoal, Text> {
    let PlanOnFile { document, notes } = content;
    if document.list(kind).is_empty() {
        return Err(text!("refused-plan-empty", list = list_words(kind)));
    }
    let vehicle = &*desk.vehicle;
    let class = vehicle.heartbeat.map_or(VehicleClass::Other, |it| it.class);
    let reported = vehicle.reports_fence_on();
    let value = |name: &str| desk.parameters.get(name).map(|known| known.value as f32);
    let rules = check_rules(class, reported, value);
    let mut found = check(&as_flown(&document, kind, vehicle), &rules);
    found.retain(|finding| finding.list == kind);
    let (errors, warnings): (Vec<_>, Vec<_>) = found
        .iter()
        .partition(|finding| finding.severity() == Severity::Error);
    if let Some((first, others)) = errors.split_first() {
        let first = finding_words(first);
        return Err(match others.len() {
            0 => first,
            more => text!("refused-plan-faults", first = first, more = more),
        });
    }
    let notes = notes.into_iter().filter(|(list, _)| *list == kind);
    let notes = notes.map(|(_, note)| note);
    let warnings = warnings.iter().map(finding_words);
    Ok(PlanOrderGoal {
        items: Some(whole(&document, kind)),
        warnings: notes.chain(warnings).collect(),
    })
}

/// The document as the vehicle flies it: from its own home, inside the fence on board if that is on and the document has
/// none.
fn as_flown(document: &Document, kind: ListKind, vehicle: &Vehicle) -> Document {
    let mut flown = document.clone();
    if let Some(home) = vehicle.home {
        let (x, y) = home.at_point.to_e7();
        flown.home = Some(Home {
            x,
            y,
            z: home.altitude_amsl_m as f32,
        });
    }
    let on_board = vehicle.fence_in_force();
    if let Some(fence) = on_board.filter(|_| kind != ListKind::Fence && flown.fence.is_empty()) {
        flown.fence.clone_from(&fence.items);
    }
    flown
}

/// The warnings about a list in words, if there are any.
pub(super) fn warned(warnings: &[Text]) -> Option<Text> {
    let shown = warnings.iter().take(MOST_SHOWN).cloned().collect();
    let shown = Text::joined("; ", shown);
    match warnings.len() {
        0 => None,
        count if count <= MOST_SHOWN => Some(text!(
            "outcome-plan-warned",
            count = count,
            warnings = shown
        )),
        count => Some(text!(
            "outcome-plan-warned-more",
            warnings = shown,
            more = count - MOST_SHOWN
        )),
    }
}
