//! Drafts flown together in simulation.

use std::sync::Arc;

use super::change;
use crate::app::State;
use crate::app::effect::{Effect, Effects};
use crate::draft::{Draft, Trial, Tried};
use crate::notice::Notice;
use crate::plan::Document;
use crate::text;
use crate::text::Text;
use crate::vehicle::Severity;

/// Asks the shell to fly the drafts.
///
/// # Errors
/// No draft has a plan.
pub(super) fn ask(state: &mut State, is_apart: bool) -> Result<Effects, Text> {
    let trial = Trial {
        is_apart,
        is_awaited: true,
        ..prepared(state)?
    };
    let text = text!("draft-trial-flies", count = trial.drafts.len());
    state.say(Severity::Info, text);
    Ok(Effects::from(Effect::TryDrafts(trial)))
}

/// A trial of the drafts with plans that are meant for vehicles, otherwise of all drafts with plans.
///
/// # Errors
/// There are none.
pub(super) fn prepared(state: &State) -> Result<Trial, Text> {
    let all = state.rooms.plans.drafts.all().iter();
    let planned = all.filter(|draft| !draft.document().plan.is_empty());
    let own = planned.clone().filter(|draft| draft.vehicle().is_some());
    let mut flown: Vec<&Draft> = own.collect();
    if flown.is_empty() {
        flown = planned.collect();
    }
    if flown.is_empty() {
        return Err(text!("draft-trial-none"));
    }
    let home = change::home(state);
    let with_home = |draft: &Draft| {
        let document = draft.document();
        if document.home.is_some() {
            return Arc::clone(document);
        }
        Arc::new(Document {
            home,
            ..Document::clone(document)
        })
    };
    let drafts = flown
        .into_iter()
        .map(|draft| (draft.name().to_owned(), with_home(draft)));
    Ok(Trial {
        drafts: drafts.collect(),
        is_apart: false,
        is_awaited: false,
    })
}

/// Handles the outcome of a trial, and returns the notice of it. Drafts that it changes can be undone one by one.
pub fn tried(state: &mut State, tried: Tried) -> Notice {
    for (name, document) in &tried.changed {
        let document = Arc::clone(document);
        state.rooms.plans.drafts.change(name, document);
    }
    state.session.note_trial(&tried.verdicts);
    let severity = if tried.is_sound {
        Severity::Info
    } else {
        Severity::Warning
    };
    let text = tried.text.clone();
    // What was said before may still be of use.
    if tried.is_awaited || !tried.is_sound {
        state.say(severity, text.clone());
    }
    state.rooms.plans.tried = Some(tried);
    Notice::general(state.now, severity, text)
}
