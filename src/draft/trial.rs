//! Drafts flown together in simulation, before any vehicle gets them.

use std::sync::Arc;

use super::TrialFlight;
use crate::plan::{ContentHash, Document};
use crate::preflight::list_words;
use crate::rehearsal::{
    Conditions, Heard, Outcome, Participant, RehearsalError, deconflict, rehearse_heard,
};
use crate::text;
use crate::text::Text;
use crate::vehicle_id::VehicleId;

mod outcome;
mod remedies;
#[cfg(test)]
mod tests;

use outcome::TrialOutcome;
use remedies::TrialRemedies;

/// The distance between heights that keep drafts apart, in metres.
const LAYER_M: f32 = 6.0;

/// Drafts to fly together.
#[derive(Debug, Clone, PartialEq)]
pub struct Trial {
    pub drafts: Vec<TrialDraft>,
    /// Whether to look for changes that keep the drafts apart.
    pub is_apart: bool,
    /// Whether the user has requested the trial and waits for the outcome.
    pub is_awaited: bool,
    /// The drafts or vehicles that are left out and why, in words, if there are any.
    pub left_out: Option<Text>,
}

/// A draft as one vehicle flies it.
#[derive(Debug, Clone, PartialEq)]
pub struct TrialDraft {
    /// The name of the draft; if several vehicles fly it, the name of the draft that this vehicle would get.
    pub name: String,
    /// The vehicle, if it flies a draft that is not meant for it alone: a change then gives the
    /// vehicle a draft of its own.
    pub sharer: Option<VehicleId>,
    /// The content, with the home from which it is flown.
    pub document: Arc<Document>,
    /// The content of the open draft when the trial begins.
    pub source: Arc<Document>,
}

/// The outcome of a trial.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Tried {
    /// The outcome in words.
    pub text: Text,
    /// The number of other plans, besides those in the text, that are not flown as intended.
    pub further: usize,
    /// The drafts or vehicles that were left out and why, in words, if there are any.
    pub left_out: Option<Text>,
    /// The conflicts, each with its time and distances; the closest first.
    pub details: Vec<Text>,
    /// Whether all plans are flown to their ends, without conflicts and inside their fences.
    pub is_sound: bool,
    /// The drafts to change, with their new content. If any draft changes, the list also contains
    /// the drafts of all sharers.
    pub changed: Vec<TrialDraft>,
    /// How each plan was flown without changes.
    pub verdicts: Vec<PlanVerdict>,
    /// The flights, if there were any.
    pub flight: Option<TrialFlight>,
    /// Whether the user waits for the outcome.
    pub is_awaited: bool,
    /// The contents of the open drafts when the trial began.
    pub sources: Vec<Arc<Document>>,
}

/// How a plan was flown in a trial.
#[derive(Debug, Clone, PartialEq)]
pub struct PlanVerdict {
    pub plan: ContentHash,
    /// Why the plan was not flown as intended.
    pub failure: Option<Text>,
}

impl Tried {
    /// The outcome with the number of further failures.
    pub fn outcome(&self) -> Text {
        let count = self.further;
        let further = (count > 0).then(|| text!("draft-trial-further", count = count));
        let text = std::iter::once(self.text.clone());
        Text::joined("; ", text.chain(further).collect())
    }

    /// The outcome, and the drafts or vehicles that were left out.
    pub fn words(&self) -> Text {
        let outcome = std::iter::once(self.outcome());
        Text::joined("; ", outcome.chain(self.left_out.clone()).collect())
    }
}

impl Trial {
    /// Flies the drafts. Takes about a second with many vehicles, and several seconds if it looks
    /// for changes that keep them apart.
    pub fn fly(&self) -> Tried {
        self.fly_heard(&mut |_| {})
    }

    /// Flies the drafts, and passes the vehicles' messages to `listener`, in the order of the
    /// drafts. Flights of a search for changes are not passed on.
    pub fn fly_heard(&self, listener: &mut dyn FnMut(Heard<'_>)) -> Tried {
        let participant = |draft: &TrialDraft| Participant {
            document: Document::clone(&draft.document),
            ..Participant::default()
        };
        let crew: Vec<Participant> = self.drafts.iter().map(participant).collect();
        let tried = if self.is_apart {
            self.keep_apart(&crew)
        } else {
            rehearse_heard(&crew, &Conditions::default(), listener).map(|outcome| {
                let found = self.found(&outcome);
                Tried {
                    verdicts: found.verdicts(),
                    ..found.tried()
                }
            })
        };
        Tried {
            is_awaited: self.is_awaited,
            left_out: self.left_out.clone(),
            sources: self
                .drafts
                .iter()
                .map(|it| Arc::clone(&it.source))
                .collect(),
            ..tried.unwrap_or_else(|error| self.failed(&error))
        }
    }

    fn keep_apart(&self, crew: &[Participant]) -> Result<Tried, RehearsalError> {
        let Some(proposal) = deconflict(crew, &Conditions::default(), LAYER_M)? else {
            return Ok(Tried {
                text: text!("plan-deconflict-impossible"),
                ..Tried::default()
            });
        };
        let remedies = TrialRemedies {
            drafts: &self.drafts,
            remedies: &proposal.remedies,
        };
        Ok(remedies.tried(self.found(&proposal.outcome).tried()))
    }

    fn found<'a>(&'a self, outcome: &'a Outcome) -> TrialOutcome<'a> {
        TrialOutcome {
            drafts: &self.drafts,
            outcome,
        }
    }

    fn failed(&self, error: &RehearsalError) -> Tried {
        let name = |at: &usize| self.drafts.get(*at).map_or("", |draft| &draft.name);
        let text = match error {
            RehearsalError::NoPlan(at) => text!("plan-rehearse-no-plan", file = name(at)),
            RehearsalError::NoHome(_) => text!("draft-no-home"),
            RehearsalError::Refused(at, kind) => {
                let list = list_words(*kind);
                text!("draft-trial-refused", name = name(at), list = list)
            }
            RehearsalError::NoParameter(name) => {
                text!("plan-rehearse-no-parameter", name = name)
            }
        };
        Tried {
            text,
            ..Tried::default()
        }
    }
}
