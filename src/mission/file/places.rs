//! `[[places]]`: named points.

use crate::commands::{CONTACT_STEMS, PEAK_PLACE};
use crate::mission::format::{Draft, FileTable, NamedPlace, point, text_by};
use crate::mission::objective::NEXT_PLACE;
use crate::mission::pad;
use crate::text;

pub(super) fn place(table: &mut FileTable<'_>) -> Option<NamedPlace> {
    let id_form = text_by(
        "2 to 32 letters, digits, `-` and `_`, beginning with a letter",
        is_name,
        "fault-place-id",
    );
    let id = table.need(
        "id",
        id_form,
        "name for commands and objectives: `goto tower up 20`",
    );
    let at = table.need("at", point(), "position");
    let id = id?;
    if is_taken(id.get_ref()) {
        table.fault_of("id", text!("fault-place-taken"));
    }
    table.draft().add_id("places", &id);
    Some(NamedPlace {
        written: id.span(),
        name: id.into_inner(),
        at: at?,
    })
}

/// Rejects places named like cells, whose names the objectives define.
pub(super) fn check_no_cells(draft: &mut Draft) {
    for survey in &draft.surveys {
        let is_cell = |name: &str| survey.cells.iter().any(|cell| cell.name == name);
        for place in draft.places.iter().filter(|place| is_cell(&place.name)) {
            let (name, survey) = (&place.name, &survey.id);
            let fault = text!("fault-place-cell", name = name, survey = survey);
            draft.faults.add(place.written.clone(), fault);
        }
    }
}

/// Whether a name is allowed: a single letter would read as an axis of `goto`.
fn is_name(name: &str) -> bool {
    let plain = |c: char| c.is_ascii_alphanumeric() || c == '-' || c == '_';
    (2..=32).contains(&name.len())
        && name.starts_with(|c: char| c.is_ascii_alphabetic())
        && name.chars().all(plain)
}

fn is_taken(name: &str) -> bool {
    let numbered = |prefix| {
        let rest = name.strip_prefix(prefix);
        rest.is_some_and(|rest: &str| rest.chars().all(|c| c.is_ascii_digit()))
    };
    [pad::STEM, "gate", PEAK_PLACE]
        .into_iter()
        .chain(CONTACT_STEMS)
        .any(numbered)
        || name == NEXT_PLACE
}
