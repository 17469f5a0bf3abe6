//! Drafts flown together in simulation.

use std::sync::Arc;

use super::{change, files};
use crate::app::State;
use crate::app::effect::{Effect, Effects};
use crate::app::room::Room;
use crate::draft::{Draft, Trial, TrialDraft, Tried};
use crate::notice::Notice;
use crate::plan::{Document, Home};
use crate::swarm::base;
use crate::text;
use crate::text::Text;
use crate::vehicle::{Severity, VehicleId};

/// Asks the shell to fly the drafts in simulation; `vehicles` are those that would fly them.
///
/// # Errors
/// No draft has a plan, or a vehicle has no position.
pub(super) fn ask(
    state: &mut State,
    is_apart: bool,
    vehicles: Option<&[VehicleId]>,
) -> Result<Effects, Text> {
    let trial = Trial {
        is_apart,
        is_awaited: true,
        ..prepared(state, vehicles)?
    };
    let text = text!("draft-trial-flies", count = trial.drafts.len());
    state.say(Severity::Info, text);
    Ok(Effects::from(Effect::TryDrafts(trial)))
}

/// The trial to fly. With `vehicles`, each flies its own draft, otherwise the current one. Without, all drafts that are
/// meant for vehicles are flown; if there are none, each of several selected vehicles flies the current draft, as after
/// an upload; otherwise all drafts with plans are flown.
///
/// # Errors
/// No draft has a plan, or a vehicle has no position.
pub(super) fn prepared(state: &State, vehicles: Option<&[VehicleId]>) -> Result<Trial, Text> {
    let all = state.rooms.plans.drafts.all().iter();
    let planned = all.filter(|draft| !draft.document().plan.is_empty());
    let own: Vec<&Draft> = planned
        .clone()
        .filter(|it| it.vehicle().is_some())
        .collect();
    let current = state.rooms.plans.drafts.current();
    let shared = current.filter(|it| it.vehicle().is_none() && !it.document().plan.is_empty());
    let selected = state.addressed();
    let drafts = match (vehicles, shared) {
        (Some(vehicles), shared) => flown_by(state, vehicles, &own, shared)?,
        (None, Some(shared)) if own.is_empty() && selected.len() > 1 => {
            flown_by(state, &selected, &own, Some(shared))?
        }
        (None, _) if own.is_empty() => planned.map(|draft| alone(state, draft)).collect(),
        (None, _) => own.iter().map(|draft| alone(state, draft)).collect(),
    };
    if drafts.is_empty() {
        return Err(text!("draft-trial-none"));
    }
    Ok(Trial {
        drafts,
        is_apart: false,
        is_awaited: false,
    })
}

/// A draft flown once, from its home.
fn alone(state: &State, draft: &Draft) -> TrialDraft {
    let home = draft.document().home.or_else(|| change::home(state));
    TrialDraft {
        name: draft.name().to_owned(),
        sharer: None,
        document: from(draft, home),
    }
}

/// The draft that each of these vehicles would fly: its own, otherwise the shared one from where it stands.
fn flown_by(
    state: &State,
    vehicles: &[VehicleId],
    own: &[&Draft],
    shared: Option<&Draft>,
) -> Result<Vec<TrialDraft>, Text> {
    let mut flown = Vec::new();
    for &id in vehicles {
        if let Some(draft) = own.iter().find(|draft| draft.vehicle() == Some(id)) {
            flown.push(alone(state, draft));
        } else if let Some(draft) = shared {
            let home = state.session.vehicles.get(&id).and_then(|it| base(it));
            let home = home.ok_or_else(|| text!("draft-trial-unplaced", vehicles = id))?;
            flown.push(TrialDraft {
                name: files::name_of(id),
                sharer: Some(id),
                document: from(draft, Some(home)),
            });
        }
    }
    Ok(flown)
}

/// The content of a draft with this home.
fn from(draft: &Draft, home: Option<Home>) -> Arc<Document> {
    let document = draft.document();
    if document.home == home {
        return Arc::clone(document);
    }
    Arc::new(Document {
        home,
        ..Document::clone(document)
    })
}

/// Handles the outcome of a trial, and returns its notice. Its changes to drafts can be undone one by one.
pub fn tried(state: &mut State, tried: Tried) -> Notice {
    let drafts = &mut state.rooms.plans.drafts;
    for changed in &tried.changed {
        let document = Arc::clone(&changed.document);
        match changed.sharer {
            Some(id) => drafts.put([Draft::new(changed.name.as_str(), document, Some(id))]),
            None => drafts.change(&changed.name, document),
        }
    }
    state.session.rehearsed.note_trial(&tried.verdicts);
    let severity = if tried.is_sound {
        Severity::Info
    } else {
        Severity::Warning
    };
    let text = tried.text.clone();
    let is_in_sight = state.display.has_rooms && state.room == Room::Plans;
    if tried.is_awaited && is_in_sight {
        // The room shows the outcome.
        state.hush();
    } else if tried.is_awaited || !tried.is_sound && !is_in_sight {
        // The earlier message may still be useful.
        state.say(severity, text.clone());
    }
    let has_figures = tried.is_awaited && tried.flight.is_some();
    state.rooms.plans.figures_top = has_figures.then_some(0);
    state.rooms.plans.tried = Some(tried);
    Notice::general(state.now, severity, text)
}
