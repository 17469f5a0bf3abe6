//! `[[lesson]]`: the steps of a guided lesson.

use super::condition::condition;
use crate::mission::format::{FileTable, text};
use crate::mission::{LessonStep, STEP_KEY};
use crate::text;

pub(super) fn step(table: &mut FileTable<'_>) -> Option<LessonStep> {
    let when = table.may(
        "when",
        condition(),
        "condition for showing the step, as in events (default always)",
    );
    let until = table.may(
        "until",
        condition(),
        "condition that completes the step: the first step whose `when` holds and whose `until` does not is shown",
    );
    let english = table.need(
        "text",
        text(""),
        "instruction; `{key}` is replaced by the current key",
    );
    let ukrainian = table.may("text_uk", text(""), "the same in Ukrainian");
    let key_form = text("an action of the keymap such as `map`, or a verb such as `takeoff`");
    let key = table.may("key", key_form, "action or verb whose key replaces `{key}`");
    if !table.is_written("when") && !table.is_written("until") {
        table.fault(text!("fault-step-forever"));
    }
    for written in english.iter().chain(&ukrainian) {
        let rest = written.get_ref().replace(STEP_KEY, "");
        let is_used = rest.len() < written.get_ref().len();
        if rest.contains(['{', '}']) {
            let message = text!("fault-step-placeholder", known = STEP_KEY);
            table.draft().faults.add(written.span(), message);
        } else if is_used != key.is_some() {
            let message = text!("fault-step-key", key = STEP_KEY);
            table.draft().faults.add(written.span(), message);
        }
    }
    let faults = &mut table.draft().faults;
    Some(LessonStep {
        when,
        until,
        text: faults.translated(english?, ukrainian, "text_uk"),
        key: key.map(toml::Spanned::into_inner),
    })
}
