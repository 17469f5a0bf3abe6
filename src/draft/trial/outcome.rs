//! The outcome of a trial in words.

use super::{PlanVerdict, TrialDraft, Tried};
use crate::draft::TrialFlight;
use crate::plan::ContentHash;
use crate::preflight::approach_words;
use crate::rehearsal::{Approach, FlightEnding, Outcome};
use crate::text;
use crate::text::{Text, TextArgument, clock_s, figure};

/// The maximum number of pairs in conflict that one text names.
const MOST_PAIRS: usize = 6;

/// The outcome of flying some drafts together.
#[derive(Debug)]
pub(super) struct TrialOutcome<'a> {
    /// The drafts, in the order of the outcome's vehicles.
    pub drafts: &'a [TrialDraft],
    pub outcome: &'a Outcome,
}

impl TrialOutcome<'_> {
    /// How each plan was flown.
    pub fn verdicts(&self) -> Vec<PlanVerdict> {
        let drafts = self.drafts.iter().enumerate();
        let verdict = |(at, draft): (usize, &TrialDraft)| PlanVerdict {
            plan: ContentHash::of(&draft.document.plan),
            failure: self.failure(at).or_else(|| self.meeting(at)),
        };
        drafts.map(verdict).collect()
    }

    /// The flights, with a text: their figures, their conflicts, or the first plan that is not
    /// flown as planned and the number of further failures.
    pub fn tried(&self) -> Tried {
        Tried {
            flight: Some(TrialFlight::of(self.drafts, self.outcome)),
            ..self.judged()
        }
    }

    fn judged(&self) -> Tried {
        let conflicts: Vec<&Approach> = self.outcome.conflicts().collect();
        if !conflicts.is_empty() {
            return Tried {
                further: self
                    .failures()
                    .filter(|(ending, _)| !is_struck(*ending))
                    .count(),
                ..self.in_conflict(&conflicts)
            };
        }
        let mut failures = self.failures().map(|(_, text)| text);
        match failures.next() {
            Some(first) => Tried {
                text: first,
                further: failures.count(),
                ..Tried::default()
            },
            None => Tried {
                text: self.summary(),
                is_sound: true,
                ..Tried::default()
            },
        }
    }

    /// The ending of each plan that fails for a reason other than a conflict, with that reason.
    fn failures(&self) -> impl Iterator<Item = (FlightEnding, Text)> {
        let vehicles = self.outcome.vehicles.iter().enumerate();
        vehicles.filter_map(|(at, flown)| Some((flown.ending, self.failure(at)?)))
    }

    fn names(&self, approach: &Approach) -> [&str; 2] {
        [approach.a, approach.b].map(|at| self.name(at))
    }

    fn name(&self, at: usize) -> &str {
        self.drafts.get(at).map_or("", |draft| &draft.name)
    }

    /// Why a plan is not flown to its end inside its fence; `None` if it is.
    fn failure(&self, at: usize) -> Option<Text> {
        let flown = self.outcome.vehicles.get(at)?;
        let name = self.name(at);
        if let Some(at_s) = flown.broke_fence_s {
            let time = clock_s(at_s);
            return Some(text!("draft-trial-fence", name = name, time = time));
        }
        match flown.ending {
            FlightEnding::Landed => None,
            FlightEnding::InAir => Some(text!("draft-trial-in-air", name = name)),
            FlightEnding::HitGround(number) => Some(text!(
                "draft-trial-hit-ground",
                name = name,
                number = number
            )),
            FlightEnding::LeftPlan(_)
            | FlightEnding::Grounded
            | FlightEnding::Crashed
            | FlightEnding::TimeUp => Some(text!("draft-trial-unfinished", name = name)),
        }
    }

    /// The conflict of a plan with another one, if it has any.
    fn meeting(&self, at: usize) -> Option<Text> {
        let conflict = self.outcome.conflicts_of(at).next()?;
        let [a, b] = self.names(conflict);
        let at_s = clock_s(conflict.at_s);
        Some(text!("draft-trial-meeting", a = a, b = b, time = at_s))
    }

    /// The outcome for drafts in conflict: all pairs that come too close to each other.
    fn in_conflict(&self, conflicts: &[&Approach]) -> Tried {
        let pair = |conflict: &&Approach| -> Text {
            let [a, b] = self.names(conflict);
            format!("{a} + {b} {}", clock_s(conflict.at_s)).into()
        };
        let named = conflicts.iter().take(MOST_PAIRS).map(pair).collect();
        let named = Text::joined(", ", named);
        let pairs = match conflicts.len().saturating_sub(MOST_PAIRS) {
            0 => named,
            more => text!("draft-trial-more", pairs = named, more = more),
        };
        Tried {
            text: text!(
                "draft-trial-conflicts",
                count = conflicts.len(),
                pairs = pairs
            ),
            details: conflicts.iter().map(|it| self.distances(it)).collect(),
            ..Tried::default()
        }
    }

    fn distances(&self, approach: &Approach) -> Text {
        approach_words(self.names(approach).map(TextArgument::from), approach)
    }

    fn summary(&self) -> Text {
        let vehicles = self.outcome.vehicles.iter();
        let longest_s = vehicles.clone().map(|it| it.time_s).fold(0.0, f64::max);
        let left = vehicles.map(|it| 100.0 - it.energy_used_percent);
        let least = left.fold(100.0, f64::min);
        let figures = text!(
            "draft-trial-figures",
            count = self.drafts.len(),
            time = clock_s(longest_s),
            left = figure(least, 0)
        );
        let closest = self.outcome.closest.first();
        let closest = closest.map(|it| self.distances(it));
        Text::joined("; ", std::iter::once(figures).chain(closest).collect())
    }
}

/// Whether the flight ended in a collision with another vehicle, which is part of a conflict.
fn is_struck(ending: FlightEnding) -> bool {
    ending == FlightEnding::Crashed
}
