//! `[[objectives]]`: the keys common to all kinds.

use crate::mission::format::{FileTable, NameKind, flag, number};
use crate::mission::objective::{self, Objective};
use crate::text;

pub(super) fn objective(table: &mut FileTable<'_>) -> Option<Objective> {
    let id = table.need_id("objectives");
    let title = table.need_text("title", "title shown to trainees");
    let value_form = number(0.1, 1000.0, "");
    let value = table.need("value", value_form, "weight among the objectives");
    let mandatory = table.or(
        "mandatory",
        flag(),
        false,
        "whether the mission fails if this is not met; at least one objective must be mandatory",
    );
    let (_, kind) = table.need_kind(NameKind::ObjectiveKind, objective::KINDS)?;
    table.draft().surveys.extend(kind.survey().cloned());
    for name in kind.place_names() {
        if table.draft().drawn.contains(&name) {
            table.fault_of("id", text!("fault-gates-twice", name = name));
            break;
        }
    }
    table.draft().drawn.extend(kind.place_names());
    id?;
    Some(Objective {
        id: table.own_id(),
        title: title?,
        value: value?,
        mandatory,
        kind,
    })
}

/// Checks that the mission has an objective that can be met.
pub(super) fn check(file: &mut FileTable<'_>, objectives: Option<&[Objective]>) {
    let none_mandatory = |all: &[Objective]| all.iter().all(|objective| !objective.mandatory);
    if objectives.is_some_and(none_mandatory) && file.draft().faults.is_empty() {
        file.fault_of("objectives", text!("fault-none-mandatory"));
    }
}
