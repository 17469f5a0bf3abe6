//! Drafts flown together in simulation.

use std::sync::Arc;

use super::{change, files};
use crate::app::State;
use crate::app::effect::{Effect, Effects};
use crate::app::room::Room;
use crate::draft::{Draft, Trial, TrialDraft, Tried};
use crate::notice::Notice;
use crate::operator::flies_in_rehearsals;
use crate::plan::{Document, Home};
use crate::swarm::base;
use crate::text;
use crate::text::Text;
use crate::vehicle::{Severity, VehicleId};
use crate::vehicle_id::ranges;

/// Asks the shell to fly the drafts in simulation; `vehicles` are those that would fly them.
///
/// # Errors
/// No draft has a plan, or a vehicle has no position or is a plane, a rover or a boat.
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

/// The trial to fly. With `vehicles`, each of them flies its own draft or, if it has none, the
/// current one. Without `vehicles`, all drafts that are meant for vehicles are flown; if there are
/// none, each of several selected vehicles flies the current draft, as after an upload; otherwise
/// all drafts with plans are flown.
///
/// # Errors
/// No draft has a plan, or a vehicle has no position or is a plane, a rover or a boat.
pub(super) fn prepared(state: &State, vehicles: Option<&[VehicleId]>) -> Result<Trial, Text> {
    let casting = Casting::of(state);
    let (drafts, left_out) = match vehicles {
        Some(vehicles) => (casting.flown_by(vehicles)?, casting.idle(vehicles)),
        None if !casting.own.is_empty() => {
            let own = casting.own.iter().map(|draft| alone(state, draft));
            (own.collect::<Result<_, Text>>()?, casting.unassigned())
        }
        None => casting.without_vehicles()?,
    };
    if drafts.is_empty() {
        return Err(text!("draft-trial-none"));
    }
    Ok(Trial {
        drafts,
        is_apart: false,
        is_awaited: false,
        left_out,
    })
}

/// The drafts with plans, grouped by vehicle.
struct Casting<'a> {
    state: &'a State,
    /// Drafts meant for a vehicle.
    own: Vec<&'a Draft>,
    /// Drafts without a vehicle.
    others: Vec<&'a Draft>,
    /// The current draft, if it is one of the others.
    shared: Option<&'a Draft>,
}

impl<'a> Casting<'a> {
    fn of(state: &'a State) -> Self {
        let drafts = &state.rooms.plans.drafts;
        let has_plan = |draft: &&Draft| !draft.document().plan.is_empty();
        let planned = drafts.all().iter().filter(has_plan);
        let (own, others) = planned.partition(|draft| draft.vehicle().is_some());
        let current = drafts.current().filter(has_plan);
        Self {
            state,
            own,
            others,
            shared: current.filter(|draft| draft.vehicle().is_none()),
        }
    }

    /// The draft that is meant for a vehicle, otherwise the shared one.
    fn draft_of(&self, id: VehicleId) -> Option<&'a Draft> {
        let mut own = self.own.iter().copied();
        own.find(|draft| draft.vehicle() == Some(id))
            .or(self.shared)
    }

    /// The draft that each of these vehicles would fly: its own, otherwise the shared one from the
    /// vehicle's position.
    ///
    /// # Errors
    /// A vehicle that would fly the shared draft has no position, or a vehicle cannot be rehearsed.
    fn flown_by(&self, vehicles: &[VehicleId]) -> Result<Vec<TrialDraft>, Text> {
        let mut flown = Vec::new();
        for &id in vehicles {
            let Some(draft) = self.draft_of(id) else {
                continue;
            };
            if draft.vehicle().is_some() {
                flown.push(alone(self.state, draft)?);
                continue;
            }
            flies_in_simulation(self.state, id)?;
            let vehicle = self.state.session.vehicles.get(&id);
            let home = vehicle.and_then(|it| base(it));
            let home = home.ok_or_else(|| text!("draft-trial-unplaced", vehicles = id))?;
            flown.push(TrialDraft {
                name: files::name_of(id),
                sharer: Some(id),
                document: from(draft, Some(home)),
                source: Arc::clone(draft.document()),
            });
        }
        Ok(flown)
    }

    /// The drafts to fly if none is meant for a vehicle, and the drafts left out: the current draft
    /// for each of several selected vehicles, otherwise all drafts.
    ///
    /// # Errors
    /// A vehicle that would fly the shared draft has no position, or a vehicle cannot be rehearsed.
    fn without_vehicles(&self) -> Result<(Vec<TrialDraft>, Option<Text>), Text> {
        let selected = self.state.addressed();
        if self.shared.is_some() && selected.len() > 1 {
            return Ok((self.flown_by(&selected)?, self.unchosen()));
        }
        // An upload would go to these.
        let flies = |id: &VehicleId| flies_in_simulation(self.state, *id);
        selected.iter().try_for_each(flies)?;
        let all = self.others.iter().map(|draft| alone(self.state, draft));
        Ok((all.collect::<Result<_, Text>>()?, None))
    }

    /// The vehicles that have no draft to fly.
    fn idle(&self, vehicles: &[VehicleId]) -> Option<Text> {
        let idle = vehicles.iter().copied();
        let idle = ranges(idle.filter(|id| self.draft_of(*id).is_none()));
        (!idle.is_empty()).then(|| text!("draft-trial-idle", vehicles = idle))
    }

    fn unassigned(&self) -> Option<Text> {
        let first = self.others.first()?.name();
        let names = names(self.others.iter().copied());
        Some(text!(
            "draft-trial-unassigned",
            names = names,
            first = first
        ))
    }

    /// The drafts other than the one that several vehicles share.
    fn unchosen(&self) -> Option<Text> {
        let shared = self.shared.map(Draft::name);
        let others = self.others.iter().copied();
        let names = names(others.filter(|draft| Some(draft.name()) != shared));
        (!names.is_empty()).then(|| text!("draft-trial-unchosen", names = names))
    }
}

fn names<'a>(drafts: impl Iterator<Item = &'a Draft>) -> String {
    drafts.map(Draft::name).collect::<Vec<_>>().join(", ")
}

/// A draft flown once, from its own home; without one, from the home of the vehicle under the
/// cursor or of any other.
///
/// # Errors
/// The draft's vehicle cannot be rehearsed.
fn alone(state: &State, draft: &Draft) -> Result<TrialDraft, Text> {
    if let Some(id) = draft.vehicle() {
        flies_in_simulation(state, id)?;
    }
    let home = draft.document().home.or_else(|| change::home(state));
    Ok(TrialDraft {
        name: draft.name().to_owned(),
        sharer: None,
        document: from(draft, home),
        source: Arc::clone(draft.document()),
    })
}

/// Refuses a vehicle that is known not to fly as copters do.
fn flies_in_simulation(state: &State, id: VehicleId) -> Result<(), Text> {
    let vehicle = state.session.vehicles.get(&id);
    vehicle.map_or(Ok(()), |vehicle| flies_in_rehearsals(vehicle))
}

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

/// Handles the outcome of a trial, with a notice. Its changes to drafts can be undone one by one. If a draft has changed
/// since the trial began, only the verdicts on the plans count.
pub fn tried(state: &mut State, tried: Tried) {
    state.session.rehearsed.note_trial(&tried.verdicts);
    let drafts = &mut state.rooms.plans.drafts;
    if !tried.sources.iter().all(|it| drafts.has_content(it)) {
        return discard(state, tried.is_awaited);
    }
    for changed in &tried.changed {
        let document = Arc::clone(&changed.document);
        match changed.sharer {
            Some(id) => drafts.put([Draft::new(changed.name.as_str(), document, Some(id))]),
            None => drafts.change(&changed.source, document),
        }
    }
    let severity = if tried.is_sound {
        Severity::Info
    } else {
        Severity::Warning
    };
    let text = tried.words();
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
    let notice = Notice::general(state.now, severity, text);
    state.notices.push(notice);
}

/// Discards the outcome with a notice, because the drafts have changed since the trial began.
fn discard(state: &mut State, is_awaited: bool) {
    let room = &mut state.rooms.plans;
    (room.tried, room.figures_top) = (None, None);
    let text = text!("draft-trial-discarded");
    if is_awaited {
        state.say(Severity::Warning, text.clone());
    }
    let notice = Notice::general(state.now, Severity::Warning, text);
    state.notices.push(notice);
}
