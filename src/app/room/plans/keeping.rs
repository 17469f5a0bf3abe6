//! Unsaved drafts outlive the program: they are written to a file in the data folder while they
//! change, and opened again by the next console.

use std::sync::Arc;

use super::{change, files, view};
use crate::app::State;
use crate::app::effect::{Effect, Effects, FileEffect};
use crate::draft::{Draft, Drafts, kept_drafts, kept_text};
use crate::notice::Notice;
use crate::plan::{Document, ListKind};
use crate::text;
use crate::text::Text;
use crate::vehicle::Severity;

/// The unsaved drafts as they were last written: names and contents.
pub(super) type KeptContent = Vec<(String, Arc<Document>)>;

/// The drafts that would be lost if the program ended now.
fn unsaved(state: &State) -> impl Iterator<Item = &Draft> {
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

/// Opens the drafts that an earlier console left unsaved; [`keep`] then writes them for this one.
pub fn restore(state: &mut State, text: &str) {
    let drafts = &mut state.rooms.plans.drafts;
    let mut names = Vec::new();
    for draft in kept_drafts(text) {
        names.extend(add(drafts, &draft));
    }
    let Some(first) = names.first() else {
        return;
    };
    drafts.choose(first);
    let names = names.into_iter().map(Text::from).collect();
    let said = text!("draft-restored", names = Text::joined(", ", names));
    change::look_at(state, ListKind::Plan);
    view::fit(state);
    state.say(Severity::Notice, said.clone());
    let notice = Notice::general(state.now, Severity::Notice, said);
    state.notices.push(notice);
}

/// Adds a draft, unless it is open already, and returns its name. If another draft has that name,
/// the new one is renamed and belongs to no vehicle; otherwise the vehicle would get two plans.
fn add(drafts: &mut Drafts, kept: &Draft) -> Option<String> {
    let mut same = drafts.all().iter().filter(|it| it.name() == kept.name());
    if same.any(|it| it.document().is_same(kept.document())) {
        return None;
    }
    let name = drafts.free_name(kept.name());
    let vehicle = kept.vehicle().filter(|_| name == kept.name());
    let document = Arc::clone(kept.document());
    drafts.put([Draft::new(name.as_str(), document, vehicle)]);
    Some(name)
}
