//! What an event means for the journal of a seat.

use crate::app::State;
use crate::app::event::{Event, SessionEvent, Started, VehicleEvent};
use crate::app::state::{Activity, ClassRole};
use crate::class::Happening;
use crate::ledger::{RowState, RowUpdate};
use crate::mission::{ObjectiveProgress, Progress};

/// What happens with an event that the console has not handled yet. A replay is not a flight, so nothing happens.
pub fn witnessed(state: &State, event: &Event) -> Vec<Happening> {
    if !matches!(state.class, ClassRole::Seat(_)) || state.replay.is_some() {
        return Vec::new();
    }
    match event {
        Event::Session(SessionEvent::Started(it)) => vec![started(it)],
        Event::Session(SessionEvent::Mission(progress)) => met(state, progress),
        Event::Session(SessionEvent::MissionEnded(report)) => vec![Happening::Ended {
            score: report.score,
            passed: report.passed,
        }],
        Event::Vehicle(VehicleEvent::Row(row)) => failed(state, row).into_iter().collect(),
        _ => Vec::new(),
    }
}

fn started(started: &Started) -> Happening {
    let mission = match &started.activity {
        Activity::Mission { id, .. } => Some(id.as_str().into()),
        Activity::Free | Activity::Connected { .. } => None,
    };
    Happening::Started { mission }
}

/// The objectives that are met now and were not before.
fn met(state: &State, progress: &Progress) -> Vec<Happening> {
    let before = state.session.task.progress.as_ref();
    let was_met = |index: usize| {
        let before = before.and_then(|it| it.objectives.get(index));
        before.is_some_and(ObjectiveProgress::is_reached)
    };
    let now = progress.objectives.iter().enumerate();
    let new = now.filter(|(index, it)| it.is_reached() && !was_met(*index));
    new.map(|(_, it)| Happening::Objective {
        title: state.locale().text(&it.title).into(),
    })
    .collect()
}

fn failed(state: &State, update: &RowUpdate) -> Option<Happening> {
    let entry = state.session.ledger().entry(update.entry)?;
    let row = entry.rows.iter().find(|it| it.vehicle == update.vehicle)?;
    let is_own = entry.by.is_none() && entry.verb.counts_as.is_for_vehicles();
    // What another person's vehicle does not take is no mistake.
    let is_mistake = update.state.is_failure() && update.state != RowState::Barred;
    let is_new = is_own && is_mistake && !row.state.is_final();
    is_new.then(|| Happening::Failed {
        line: entry.line.as_str().into(),
        vehicle: update.vehicle,
    })
}
