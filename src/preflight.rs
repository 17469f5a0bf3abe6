//! Texts for plan files before a flight: faults, notes and findings.

use crate::diagnostic::Diagnostic;
use crate::plan::board;
use crate::plan::check::{Finding, Severity};
use crate::plan::generate::{GenerateError, Idle};
use crate::plan::{ContentHash, Document, Fault, ListKind, Loaded, Note};
use crate::rehearsal::Approach;
use crate::text;
use crate::text::{Text, TextArgument, clock_s, figure};

mod faults;
mod findings;

pub use faults::note as note_words;
pub use findings::{words as finding_words, words_of_all as shared_finding_words};

/// A remark about a file, with its place, and whether it is only a warning.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Remark {
    pub diagnostic: Diagnostic,
    pub severity: Severity,
}

/// The diagnostic for a fault that prevents a file from being read.
pub fn fault(fault: &Fault) -> Diagnostic {
    Diagnostic::new(fault.span.clone(), faults::words(&fault.kind))
}

/// The notes of a reader and the findings about the content, in the order of the file.
pub fn remarks(loaded: &Loaded, findings: &[Finding]) -> Vec<Remark> {
    let notes = loaded.notes.iter().map(|note: &Note| Remark {
        diagnostic: Diagnostic::new(note.span.clone(), faults::note(&note.kind)),
        severity: Severity::Warning,
    });
    let found = findings.iter().map(|finding| {
        let place = match finding.item {
            Some(index) => loaded.places.item(finding.list, index),
            None => loaded.places.home.clone(),
        };
        let first = || loaded.places.item(finding.list, 0);
        let span = place.or_else(first).unwrap_or(0..0);
        // One line is enough to find the item; all of it would fill the screen.
        let item = loaded.text.get(span.clone()).unwrap_or_default();
        let end = item
            .find('\n')
            .map_or(span.end, |length| span.start + length);
        Remark {
            diagnostic: Diagnostic::new(span.start..end, findings::words(finding)),
            severity: finding.severity(),
        }
    });
    let mut remarks: Vec<Remark> = notes.chain(found).collect();
    remarks.sort_by_key(|remark| remark.diagnostic.span.start);
    remarks
}

/// A summary of a document: `plan 7f3a: 12 items, fence: 5 items`.
pub fn summary(document: &Document) -> Text {
    let parts: Vec<Text> = document
        .kinds()
        .map(|kind| {
            let items = document.list(kind);
            let count = items.len();
            match kind {
                ListKind::Plan => {
                    let hash = ContentHash::of(items).to_string();
                    text!("plan-holds-plan", hash = hash, count = count)
                }
                ListKind::Fence => text!("plan-holds-fence", count = count),
                ListKind::Rally => text!("plan-holds-rally", count = count),
            }
        })
        .collect();
    if parts.is_empty() {
        text!("plan-holds-nothing")
    } else {
        Text::joined(", ", parts)
    }
}

/// The name of a list.
pub fn list_words(kind: ListKind) -> Text {
    match kind {
        ListKind::Plan => text!("plan-list-plan"),
        ListKind::Fence => text!("plan-list-fence"),
        ListKind::Rally => text!("plan-list-rally"),
    }
}

/// Why a task has no plans; `vehicle` is the number of the vehicle that the error concerns.
pub fn ungenerated(error: GenerateError, vehicle: usize) -> Text {
    match error {
        GenerateError::NoVehicle => text!("plan-generate-no-vehicle"),
        GenerateError::Empty => text!("plan-generate-empty"),
        GenerateError::TooMany(most) => text!("plan-generate-too-many", most = most),
        GenerateError::TooNarrow(least) => text!("plan-generate-narrow", least = least),
        GenerateError::Fence => text!("plan-generate-fence"),
        GenerateError::OutsideFence => text!("plan-generate-outside"),
        GenerateError::NoWay(_) => text!("plan-generate-no-way", vehicle = vehicle),
    }
}

/// Why a vehicle has no part in a task.
pub fn idle_words(why: Idle) -> Text {
    match why {
        Idle::NoWay => text!("plan-idle-no-way"),
        Idle::Far => text!("plan-idle-far"),
        Idle::Spare => text!("plan-idle-spare"),
    }
}

/// How close the flights named `a` and `b` come to each other in a rehearsal.
pub fn approach_words([a, b]: [TextArgument; 2], approach: &Approach) -> Text {
    let message = if approach.is_conflict() {
        "plan-rehearse-conflict"
    } else {
        "plan-rehearse-closest"
    };
    Text::new(
        message,
        vec![
            ("a", a),
            ("b", b),
            ("time", clock_s(approach.at_s).into()),
            ("horizontal", figure(approach.horizontal_m, 1).into()),
            ("vertical", figure(approach.vertical_m, 1).into()),
        ],
    )
}

fn command_name(command: u16) -> String {
    board::name(command).map_or_else(|| command.to_string(), str::to_owned)
}
