//! Drafts flown together in simulation, before any vehicle gets them.

use std::sync::Arc;
use std::time::Duration;

use crate::plan::{ContentHash, Document};
use crate::preflight::list_words;
use crate::rehearsal::{
    Approach, Conditions, Ending, Flown, Outcome, Participant, RehearsalError, Remedy, deconflict,
    rehearse,
};
use crate::text;
use crate::text::{Text, clock, figure};
use crate::vehicle_id::VehicleId;

/// Metres between separate heights.
const LAYER_M: f32 = 6.0;
/// The maximum number of pairs in conflict that one text names.
const MOST_PAIRS: usize = 6;

/// Drafts to fly together.
#[derive(Debug, Clone, PartialEq)]
pub struct Trial {
    pub drafts: Vec<TrialDraft>,
    /// Whether to look for changes that keep them apart.
    pub is_apart: bool,
    /// Whether the user has asked for it, and waits for the outcome.
    pub is_awaited: bool,
}

/// A draft as one vehicle flies it.
#[derive(Debug, Clone, PartialEq)]
pub struct TrialDraft {
    /// The name of the draft; if several vehicles fly it, the name of the draft that this vehicle would get.
    pub name: String,
    /// The vehicle, if it flies a draft that is not meant for it alone: a change gives it a draft of its own.
    pub sharer: Option<VehicleId>,
    /// The content, with the home from which it is flown.
    pub document: Arc<Document>,
}

/// The outcome of a trial.
#[derive(Debug, Clone, PartialEq)]
pub struct Tried {
    /// The outcome in words.
    pub text: Text,
    /// The conflicts, each with its time and distances; the closest first.
    pub details: Vec<Text>,
    /// Whether all plans are flown to their ends, apart from each other and inside their fences.
    pub is_sound: bool,
    /// The drafts to change, with their new content. If the draft of one sharer changes, those of all
    /// sharers are here.
    pub changed: Vec<TrialDraft>,
    /// The plans that were flown as they are.
    pub verdicts: Vec<PlanVerdict>,
    /// Whether the user waits for it.
    pub is_awaited: bool,
}

/// How a plan was flown in a trial.
#[derive(Debug, Clone, PartialEq)]
pub struct PlanVerdict {
    pub plan: ContentHash,
    /// Why it was not flown as intended.
    pub failure: Option<Text>,
}

impl Trial {
    /// Flies the drafts. Takes about a second for many vehicles, and several for changes that keep them apart.
    pub fn fly(&self) -> Tried {
        Tried {
            is_awaited: self.is_awaited,
            ..self.outcome()
        }
    }

    fn outcome(&self) -> Tried {
        let participant = |draft: &TrialDraft| Participant {
            document: Document::clone(&draft.document),
            ..Participant::default()
        };
        let crew: Vec<Participant> = self.drafts.iter().map(participant).collect();
        let conditions = Conditions::default();
        if !self.is_apart {
            return match rehearse(&crew, &conditions) {
                Ok(outcome) => Tried {
                    verdicts: self.verdicts(&outcome),
                    ..self.told(&outcome)
                },
                Err(error) => self.failed(&error),
            };
        }
        match deconflict(&crew, &conditions, LAYER_M) {
            Ok(Some(proposal)) => self.changed(&proposal.remedies, &proposal.outcome),
            Ok(None) => unsound(text!("plan-deconflict-impossible")),
            Err(error) => self.failed(&error),
        }
    }

    fn name(&self, index: usize) -> &str {
        self.drafts.get(index).map_or("", |draft| &draft.name)
    }

    fn failed(&self, error: &RehearsalError) -> Tried {
        unsound(match error {
            RehearsalError::NoPlan(at) => {
                text!("plan-rehearse-no-plan", file = self.name(*at))
            }
            RehearsalError::NoHome(_) => text!("draft-no-home"),
            RehearsalError::Refused(at, kind) => {
                let list = list_words(*kind);
                text!("draft-trial-refused", name = self.name(*at), list = list)
            }
            RehearsalError::NoParameter(name) => text!("plan-rehearse-no-parameter", name = name),
        })
    }

    fn verdicts(&self, outcome: &Outcome) -> Vec<PlanVerdict> {
        let flown = self.drafts.iter().zip(&outcome.vehicles).enumerate();
        let verdict = |(at, (draft, flown)): (usize, (&TrialDraft, &Flown))| {
            let meeting = || {
                let mut conflicts = outcome.conflicts();
                let conflict = conflicts.find(|it| [it.a, it.b].contains(&at))?;
                let [a, b] = [conflict.a, conflict.b].map(|at| self.name(at));
                let at_s = time(conflict.at_s);
                Some(text!("draft-trial-meeting", a = a, b = b, time = at_s))
            };
            PlanVerdict {
                plan: ContentHash::of(&draft.document.plan),
                failure: self.failure(at, flown).or_else(meeting),
            }
        };
        flown.map(verdict).collect()
    }

    /// Why a plan is not flown to its end inside its fence; `None` if it is.
    fn failure(&self, at: usize, flown: &Flown) -> Option<Text> {
        let name = self.name(at);
        if let Some(at_s) = flown.broke_fence_s {
            return Some(text!("draft-trial-fence", name = name, time = time(at_s)));
        }
        let is_good = matches!(flown.ending, Ending::Landed | Ending::InAir);
        (!is_good).then(|| text!("draft-trial-unfinished", name = name))
    }

    /// All pairs that come too close to each other.
    fn in_conflict(&self, conflicts: &[&Approach]) -> Tried {
        let pair = |conflict: &&Approach| -> Text {
            let [a, b] = [conflict.a, conflict.b].map(|at| self.name(at));
            format!("{a} + {b} {}", time(conflict.at_s)).into()
        };
        let pairs = conflicts.iter().take(MOST_PAIRS).map(pair).collect();
        let mut pairs = Text::joined(", ", pairs);
        let more = conflicts.len().saturating_sub(MOST_PAIRS);
        if more > 0 {
            pairs = text!("draft-trial-more", pairs = pairs, more = more);
        }
        let distances = |conflict: &&Approach| {
            let [a, b] = [conflict.a, conflict.b].map(|at| self.name(at));
            let metres = [conflict.horizontal_m, conflict.vertical_m].map(|it| figure(it, 1));
            let [horizontal, vertical] = metres;
            text!(
                "plan-rehearse-conflict",
                a = a,
                b = b,
                time = time(conflict.at_s),
                horizontal = horizontal,
                vertical = vertical
            )
        };
        let text = text!(
            "draft-trial-conflicts",
            count = conflicts.len(),
            pairs = pairs
        );
        Tried {
            details: conflicts.iter().map(distances).collect(),
            ..unsound(text)
        }
    }

    /// The figures of a rehearsal, its conflicts, or the first plan that is not flown to its end.
    fn told(&self, outcome: &Outcome) -> Tried {
        if outcome.conflicts().next().is_some() {
            return self.in_conflict(&outcome.conflicts().collect::<Vec<&Approach>>());
        }
        let mut flown = outcome.vehicles.iter().enumerate();
        match flown.find_map(|(at, it)| self.failure(at, it)) {
            Some(failure) => unsound(failure),
            None => Tried {
                is_sound: true,
                ..unsound(self.summary(outcome))
            },
        }
    }

    fn summary(&self, outcome: &Outcome) -> Text {
        let vehicles = outcome.vehicles.iter();
        let longest_s = vehicles.clone().map(|it| it.time_s).fold(0.0, f64::max);
        let least = vehicles
            .map(|it| it.energy_left_percent)
            .fold(100.0, f64::min);
        let figures = text!(
            "draft-trial-figures",
            count = self.drafts.len(),
            time = time(longest_s),
            left = figure(least, 0)
        );
        let closest = outcome.closest.first();
        let closest = closest.map(|it| self.approach(it));
        Text::joined("; ", std::iter::once(figures).chain(closest).collect())
    }

    /// How close two drafts come to each other without a conflict.
    fn approach(&self, closest: &Approach) -> Text {
        let [a, b] = [closest.a, closest.b].map(|at| self.name(at));
        let distances = [closest.horizontal_m, closest.vertical_m];
        let [horizontal, vertical] = distances.map(|metres| figure(metres, 0));
        text!(
            "draft-trial-closest",
            a = a,
            b = b,
            time = time(closest.at_s),
            horizontal = horizontal,
            vertical = vertical
        )
    }

    fn changed(&self, remedies: &[Remedy], outcome: &Outcome) -> Tried {
        let told = self.told(outcome);
        let all = remedies.iter().zip(&self.drafts);
        let is_needed = |remedy: &Remedy| *remedy != Remedy::Nothing;
        if !remedies.iter().any(is_needed) {
            let text = Text::joined("; ", vec![text!("plan-deconflict-none"), told.text]);
            return Tried { text, ..told };
        }
        let is_other =
            |(remedy, draft): &(&Remedy, &TrialDraft)| is_needed(remedy) || draft.sharer.is_some();
        let changed = all
            .clone()
            .filter(is_other)
            .map(|(remedy, draft)| TrialDraft {
                document: Arc::new(remedy.apply(&draft.document)),
                ..draft.clone()
            });
        let changed: Vec<TrialDraft> = changed.collect();
        let needed = all.filter(|(remedy, _)| is_needed(remedy));
        let mut words: Vec<Text> = needed
            .map(|(remedy, draft)| remedy_words(*remedy, &draft.name))
            .collect();
        let waits = remedies.iter().any(|it| matches!(it, Remedy::Delay(_)));
        words.extend(waits.then(|| text!("draft-trial-disarm")));
        let splits = changed.iter().any(|draft| draft.sharer.is_some());
        words.extend(splits.then(|| text!("draft-trial-split")));
        Tried {
            text: Text::joined("; ", words),
            changed,
            ..told
        }
    }
}

fn unsound(text: Text) -> Tried {
    Tried {
        text,
        details: Vec::new(),
        is_sound: false,
        changed: Vec::new(),
        verdicts: Vec::new(),
        is_awaited: false,
    }
}

fn time(seconds: f64) -> String {
    clock(Duration::from_secs_f64(seconds.max(0.0)))
}

fn remedy_words(remedy: Remedy, name: &str) -> Text {
    match remedy {
        Remedy::Nothing => Text::default(),
        Remedy::Delay(seconds) => text!("draft-trial-delay", name = name, seconds = seconds),
        Remedy::Layer(metres) => {
            text!("draft-trial-layer", name = name, height = figure(metres, 0))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geo::LatLon;
    use crate::plan::{Home, Item, command};

    const HOME: LatLon = LatLon::new(50.45, 30.52);

    /// A flight from a place to another at 20 m, and back to the ground there.
    fn flight(name: &str, from_m: f64, to_m: f64) -> TrialDraft {
        let at = |east_m: f64| HOME.moved(0.0, east_m).to_e7();
        let item = |command, (x, y), z| Item {
            command,
            frame: 3,
            auto_continue: true,
            x,
            y,
            z,
            ..Item::default()
        };
        let (x, y) = at(from_m);
        let document = Document {
            home: Some(Home { x, y, z: 170.0 }),
            plan: vec![
                item(command::TAKEOFF, (0, 0), 20.0),
                item(command::WAYPOINT, at(to_m), 20.0),
                item(command::LAND, at(to_m), 0.0),
            ],
            ..Document::default()
        };
        TrialDraft {
            name: name.to_owned(),
            sharer: None,
            document: Arc::new(document),
        }
    }

    #[test]
    fn drafts_that_meet_are_found_and_kept_apart() {
        let meeting = vec![flight("east", 0.0, 100.0), flight("west", 100.0, 0.0)];
        let mut trial = Trial {
            drafts: meeting,
            is_apart: false,
            is_awaited: true,
        };
        let tried = trial.fly();
        assert!(!tried.is_sound && tried.changed.is_empty());
        let failures = tried.verdicts.iter().map(|it| it.failure.as_ref());
        assert_eq!(failures.flatten().count(), 2, "both meet: {tried:?}");
        assert!(tried.text.to_string().contains("east"), "{}", tried.text);
        trial.is_apart = true;
        let tried = trial.fly();
        assert!(tried.is_sound, "{}", tried.text);
        assert_eq!(tried.changed.len(), 1);
        trial
            .drafts
            .retain(|draft| draft.name != tried.changed[0].name);
        trial.drafts.extend(tried.changed);
        trial.is_apart = false;
        let again = trial.fly();
        assert!(again.is_sound, "{}", again.text);
        assert!(again.verdicts.iter().all(|it| it.failure.is_none()));
    }

    /// Vehicles that fly the same plan meet at its first place; a change gives each a draft of its own.
    #[test]
    fn a_shared_draft_is_flown_and_changed_for_each_vehicle() {
        let shared = |id: VehicleId| {
            let flown = flight(&format!("vehicle-{id}"), 8.0 * f64::from(id), 100.0);
            let mut document = Document::clone(&flown.document);
            if let Some(last) = document.plan.last_mut() {
                last.command = command::RETURN_TO_LAUNCH;
            }
            TrialDraft {
                sharer: Some(id),
                document: Arc::new(document),
                ..flown
            }
        };
        let mut trial = Trial {
            drafts: vec![shared(1), shared(2), shared(3)],
            is_apart: false,
            is_awaited: true,
        };
        let tried = trial.fly();
        let said = tried.text.to_string();
        assert!(!tried.is_sound && said.contains("3 conflicts"), "{said}");
        trial.is_apart = true;
        let tried = trial.fly();
        assert!(tried.is_sound, "{}", tried.text);
        let changed = tried.changed.iter().map(|draft| draft.sharer);
        assert_eq!(changed.collect::<Vec<_>>(), [Some(1), Some(2), Some(3)]);
        trial.drafts = tried.changed;
        trial.is_apart = false;
        let again = trial.fly();
        assert!(again.is_sound, "{}", again.text);
    }

    #[test]
    fn all_pairs_that_come_too_close_are_named() {
        let drafts = [
            ("a", 0.0, 100.0),
            ("b", 100.0, 0.0),
            ("c", 1000.0, 1100.0),
            ("d", 1100.0, 1000.0),
        ];
        let trial = Trial {
            drafts: drafts.map(|(name, from, to)| flight(name, from, to)).into(),
            is_apart: false,
            is_awaited: true,
        };
        let tried = trial.fly();
        let text = tried.text.to_string();
        assert!(text.contains("a + b") && text.contains("c + d"), "{text}");
        assert_eq!(tried.details.len(), 2);
        assert!(
            text.starts_with("2 conflicts: ") && text.len() < 80,
            "{text}"
        );
    }

    #[test]
    fn drafts_that_are_apart_stay_as_they_are() {
        let trial = Trial {
            drafts: vec![flight("north", 0.0, 60.0), flight("south", 200.0, 300.0)],
            is_apart: true,
            is_awaited: true,
        };
        let tried = trial.fly();
        assert!(tried.is_sound && tried.changed.is_empty(), "{}", tried.text);
    }
}
