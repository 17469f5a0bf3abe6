//! The remarks of a command's rows: answers, and explanations that several rows share.

use unicode_width::UnicodeWidthStr as _;

use crate::ledger::{LedgerEntry, LedgerRow, RowState};
use crate::text::Text;
use crate::ui::look::Look;
use crate::vehicle::VehicleId;
use crate::vehicle_id::ranges;

/// The maximum width of a remark that counts as a value, not a sentence.
const LONGEST_VALUE: usize = 24;

/// The answer to a query, once every vehicle has answered: `= 500`, or `1,3-4: 500   2: 700` if they differ.
pub(super) fn outcome(entry: &LedgerEntry, look: &Look) -> Option<String> {
    let told = |row: &LedgerRow| row.state == RowState::Done && row.explanation.is_some();
    if !entry.rows.iter().all(told) {
        return None;
    }
    // The line already contains the name of the value.
    let asked = entry.line.split_whitespace().next_back()?;
    let short = |text: &Text| {
        let text = look.text(text);
        match text.split_once(' ') {
            Some((name, value)) if name.eq_ignore_ascii_case(asked) => value.to_owned(),
            _ => text,
        }
    };
    let remarks = explanations(entry);
    if let [remark] = remarks.as_slice() {
        return Some(short(&remark.text));
    }
    // Different sentences on one line would run together, so each gets its own line.
    let is_long = |remark: &SharedRemark| look.text(&remark.text).width() > LONGEST_VALUE;
    if remarks.iter().any(is_long) {
        return None;
    }
    let parts = remarks.into_iter().map(|remark| {
        let text = short(&remark.text);
        let vehicles = ranges(remark.vehicles);
        format!("{vehicles}: {}", text.trim_start_matches("= "))
    });
    Some(parts.collect::<Vec<_>>().join("   "))
}

/// The remark of one or several rows.
pub(super) struct SharedRemark {
    pub text: Text,
    pub vehicles: Vec<VehicleId>,
}

/// The explanations of rows, merged if they differ only in their vehicle, in the order of their first occurrence.
pub(super) fn explanations(entry: &LedgerEntry) -> Vec<SharedRemark> {
    let mut found: Vec<SharedRemark> = Vec::new();
    let explained = |row: &&LedgerRow| row.state != RowState::Superseded;
    for row in entry.rows.iter().filter(explained) {
        let Some(remark) = row.remark() else {
            continue;
        };
        let text = remark.regarding("");
        match found.iter_mut().find(|known| known.text == text) {
            Some(known) => known.vehicles.push(row.vehicle),
            None => found.push(SharedRemark {
                text,
                vehicles: vec![row.vehicle],
            }),
        }
    }
    for remark in &mut found {
        let vehicles = ranges(remark.vehicles.iter().copied());
        remark.text = remark.text.regarding(&vehicles);
    }
    found
}
