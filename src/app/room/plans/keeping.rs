//! Unsaved drafts outlive the program: they are written to a file of the data folder while they change.

use std::sync::Arc;

use super::{change, files, view};
use crate::app::State;
use crate::app::effect::{Effect, Effects, FileEffect};
use crate::draft::{Draft, kept_drafts, kept_text};
use crate::notice::Notice;
use crate::plan::{Document, ListKind};
use crate::text;
use crate::text::Text;
use crate::vehicle::Severity;

/// The unsaved drafts as they were last written: names and contents.
pub(super) type KeptContent = Vec<(String, Arc<Document>)>;

fn unsaved(state: &State) -> impl Iterator<Item = &Draft> {
/// The drafts that would be lost if the program ended now.
    let drafts = state.rooms.plans.drafts.all().iter();
    drafts.filter(|draft| !files::is_elsewhere(state, draft))
}

fn content(state: &State) -> KeptContent {
    let drafts = unsaved(state);
    drafts
        .map(|draft| (draft.name().to_owned(), Arc::clone(draft.document())))
        .collect()
}

/// Asks the shell to write the unsaved drafts, if they have changed.
pub fn keep(state: &mut State) -> Effects {
    let now = content(state);
    let before = &state.rooms.plans.written;
    let is_same = now.len() == before.len()
        && now
            .iter()
            .zip(before)
            .all(|(now, before)| now.0 == before.0 && Arc::ptr_eq(&now.1, &before.1));
    if is_same {
        return Effects::none();
    }
    let text = kept_text(unsaved(state));
    state.rooms.plans.written = now;
    Effects::from(Effect::File(FileEffect::KeepDrafts(text)))
}

/// Opens the drafts of an earlier session that were not saved.
pub fn restore(state: &mut State, text: &str) {
    let drafts = kept_drafts(text);
    if drafts.is_empty() {
        return;
    }
    let names = drafts.iter().map(|draft| draft.name().into()).collect();
    let said = text!("draft-restored", names = Text::joined(", ", names));
    state.rooms.plans.drafts.put(drafts);
    state.rooms.plans.written = content(state);
    change::look_at(state, ListKind::Plan);
    view::fit(state);
    state.say(Severity::Notice, said.clone());
    let notice = Notice::general(state.now, Severity::Notice, said);
    state.notices.push(notice);
}
