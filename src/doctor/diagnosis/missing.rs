//! Expected vehicles that were never heard. They are apart because an expected vehicle may come over any link.

use std::collections::BTreeSet;

use super::autopilots;
use super::finding::Cause;
use crate::doctor::{Chart, Way};
use crate::vehicle_id::VehicleId;

/// The finding that expected vehicles were never heard on any link, not even before they fell silent; `None` if all
/// were, or if a recording is played.
pub(super) fn missing(charts: &[Chart], expected: &BTreeSet<VehicleId>) -> Option<Cause> {
    if charts.iter().any(|chart| chart.way() == Way::File) {
        return None;
    }
    let observed = charts.iter().filter_map(Chart::last);
    let heard: BTreeSet<VehicleId> = observed
        .flat_map(|last| last.numbered.keys())
        .map(|(system, _)| VehicleId::from(*system))
        .collect();
    let never: Vec<VehicleId> = expected.difference(&heard).copied().collect();
    let present: BTreeSet<VehicleId> = charts
        .iter()
        .flat_map(autopilots)
        .map(|sender| VehicleId::from(sender.source.system))
        .collect();
    let others = present.difference(expected).copied().collect();
    (!never.is_empty()).then_some(Cause::Missing { never, others })
}
