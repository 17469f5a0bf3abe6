//! Findings about the signatures of a vehicle's frames.

use super::super::{Chart, Sender};
use super::Cause;
use crate::signing::SECOND;
use crate::wire::SystemId;

/// The systems for which the console had a key at the last observation.
pub(super) fn last_keyed(chart: &Chart) -> &[SystemId] {
    chart.last().map_or(&[], |last| &last.keyed)
}

/// Whether a vehicle signs, but never with the key that the console has for it.
pub(super) fn has_only_a_wrong_key(chart: &Chart, sender: &Sender) -> bool {
    let seals = chart.numbered(sender).seals;
    let is_keyed = last_keyed(chart).contains(&sender.source.system);
    is_keyed && seals.foreign > 0 && seals.right == 0
}

/// The findings about a vehicle's signatures.
pub(super) fn signing(chart: &Chart, sender: &Sender) -> Vec<Cause> {
    let system = sender.source.system;
    let seals = chart.numbered(sender).seals;
    let is_keyed = chart.is_keyed(system);
    let is_expected = is_keyed || chart.last().is_some_and(|last| last.is_signing_required);
    let behind_s = seals.behind / SECOND;
    let mut causes = Vec::new();
    if is_expected && seals.unsigned > 0 {
        causes.push(Cause::Unsigned(system));
    }
    if is_keyed && seals.foreign > 0 {
        causes.push(Cause::WrongKey(system));
    }
    // Datagrams that overtake each other are milliseconds behind.
    if seals.old > 0 && behind_s > 0 {
        causes.push(Cause::OldStamps(system, behind_s));
    }
    causes
}
