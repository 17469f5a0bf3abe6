//! Commands to the mission itself: reports, and the trainee's prediction and goal before takeoff.

use std::collections::BTreeSet;

use super::{Flight, Loads, LoadsScene};
use crate::commands::{Deed, FindKind, Goal, Spot, Subject};
use crate::ledger::{EntryId, RowState, RowUpdate};
use crate::mission::report::Mark;
use crate::mission::{Point, Stake};
use crate::text;
use crate::text::Text;
use crate::vehicle::VehicleId;

/// The prediction and the goal given before takeoff.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Pledge {
    /// The score that the trainee expects.
    pub prediction: Option<u16>,
    /// The goal that the trainee wants to reach.
    pub goal: Option<Goal>,
}

/// The outcome of a deed for one vehicle: an optional remark, or the reason why it failed.
pub(super) type Done = Result<Option<Text>, Text>;

impl Flight {
    /// Carries out a deed for each vehicle, at the mission time of the last step; returns the
    /// ledger's rows, in mission time.
    pub fn act(&mut self, entry: EntryId, deed: &Deed, vehicles: &[VehicleId]) -> Vec<RowUpdate> {
        // Old records name all vehicles.
        let vehicles = deed.doers(vehicles);
        if let Some(recorder) = &mut self.recorder {
            recorder.act(deed, vehicles);
        }
        let outcomes = if self.is_over() {
            vec![Err(text!("deed-over")); vehicles.len()]
        } else {
            self.outcomes(deed, vehicles)
        };
        let row = |(&vehicle, outcome): (&VehicleId, Done)| {
            let (state, explanation) = match outcome {
                Ok(remark) => (RowState::Done, remark),
                Err(reason) => (RowState::Refused, Some(reason)),
            };
            RowUpdate {
                entry,
                vehicle,
                state,
                tries: 1,
                at: self.elapsed,
                explanation,
            }
        };
        vehicles.iter().zip(outcomes).map(row).collect()
    }

    fn outcomes(&mut self, deed: &Deed, vehicles: &[VehicleId]) -> Vec<Done> {
        // A hint counts once, however many vehicles are named.
        if *deed == Deed::Hint {
            return vec![self.give_clue().map(Some); vehicles.len()];
        }
        let reports_before = self.search.marks().len();
        let each = vehicles.iter().map(|&vehicle| self.act_with(vehicle, deed));
        let mut outcomes: Vec<Done> = each.collect();
        // The reports of all vehicles are counted once.
        let count = self.search.marks().len().saturating_sub(reports_before);
        let mut done = outcomes.iter_mut().filter(|outcome| outcome.is_ok());
        if let Some(first) = done.next().filter(|_| count > 0) {
            *first = Ok(Some(text!("deed-marked", count = count)));
        }
        outcomes
    }

    /// The trainee's prediction and goal.
    pub fn pledge(&self) -> Pledge {
        self.pledge
    }

    /// The prediction and the goal while they can still be changed; `None` once a vehicle has
    /// flown.
    pub fn open_pledge(&self) -> Option<Pledge> {
        self.before_launch().is_ok().then_some(self.pledge)
    }

    /// Copies the prediction and the goal of an attempt in which nothing flew. The record contains
    /// them as if they had been given again.
    pub fn renew(&mut self, pledge: Pledge) {
        let prediction = pledge.prediction.map(|points| Deed::Predict { points });
        for deed in prediction.into_iter().chain(pledge.goal.map(Deed::Goal)) {
            // This attempt's ledger has no command for them, and one vehicle is enough.
            self.act(EntryId(0), &deed, &[1]);
        }
    }

    fn act_with(&mut self, vehicle: VehicleId, deed: &Deed) -> Done {
        match deed {
            Deed::Mark { subject, kind } => match *subject {
                Subject::Spot(spot) => self.mark(vehicle, spot, *kind),
                Subject::Contacts { confirmed } => self.mark_contacts(vehicle, confirmed, *kind),
            },
            Deed::Unmark { spot } => {
                let at = self.point(vehicle, *spot)?;
                self.search.unmark(at)
            }
            Deed::Predict { points } => {
                self.before_launch()?;
                self.pledge.prediction = Some(*points);
                Ok(None)
            }
            Deed::Goal(goal) => {
                self.before_launch()?;
                self.pledge.goal = Some(*goal);
                Ok(None)
            }
            Deed::Workload { level } => {
                if self.stake == Stake::Exam {
                    return Err(text!("deed-workload-in-exam"));
                }
                self.swarm.answer(self.elapsed, *level);
                Ok(None)
            }
            Deed::Sample => self.loads_and_scene().1.take_sample(vehicle),
            Deed::Drop => {
                let (loads, mut scene) = self.loads_and_scene();
                loads.drop_piece(vehicle, &mut scene)
            }
            Deed::Spray { on } => {
                let (loads, scene) = self.loads_and_scene();
                loads.set_sprayer(vehicle, *on, &scene)
            }
            Deed::Hint => Err(text!("deed-no-hint")),
        }
    }

    /// Checks that no vehicle has flown yet; otherwise returns the reason for the refusal.
    pub(super) fn before_launch(&self) -> Result<(), Text> {
        if self.crafts.iter().any(|craft| craft.flown) {
            return Err(text!("deed-launched"));
        }
        Ok(())
    }

    fn loads_and_scene(&mut self) -> (&mut Loads, LoadsScene<'_>) {
        let scene = LoadsScene {
            crafts: &self.crafts,
            world: &mut self.world,
            journal: &mut self.journal,
        };
        (&mut self.loads, scene)
    }

    fn mark(&mut self, by: VehicleId, spot: Spot, kind: Option<FindKind>) -> Done {
        self.check_kind(kind)?;
        let at = self.point(by, spot)?;
        self.search.mark(Mark {
            at,
            kind,
            by,
            when: self.elapsed,
        })
    }

    fn mark_contacts(&mut self, by: VehicleId, confirmed: bool, kind: Option<FindKind>) -> Done {
        self.check_kind(kind)?;
        self.search.mark_contacts(by, &self.journal, |contact| {
            let is_kind = kind.is_none_or(|kind| kind == contact.kind);
            is_kind && (!confirmed || contact.is_confirmed())
        })
    }

    /// Refuses a report of a kind that no objective requires, since it would be ignored silently. If no objective
    /// requires reports, any kind is accepted.
    fn check_kind(&self, kind: Option<FindKind>) -> Result<(), Text> {
        let objectives = self.mission.objectives.iter();
        let sought = objectives.filter_map(|objective| objective.kind.sought());
        let kinds = sought.flat_map(|it| self.world.kinds(it.hazard));
        let known: BTreeSet<FindKind> = kinds.collect();
        match kind {
            Some(kind) if !known.is_empty() && !known.contains(&kind) => {
                let words: Vec<String> =
                    known.iter().map(|it| format!("`{}`", it.name())).collect();
                Err(text!(
                    "deed-other-kind",
                    kind = kind.name(),
                    kinds = words.join(", ")
                ))
            }
            Some(_) | None => Ok(()),
        }
    }

    fn point(&self, vehicle: VehicleId, spot: Spot) -> Result<Point, Text> {
        match spot {
            Spot::At(place) => Ok(self.mission.site.origin.point(place)),
            Spot::Offset { north_m, east_m } => Ok([east_m, north_m]),
            Spot::Here => {
                let craft = self.crafts.iter().find(|craft| craft.id == vehicle);
                let at = craft.and_then(|craft| craft.at);
                at.ok_or_else(|| text!("deed-no-position"))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::mission::Mission;

    const AIR_SAMPLE: &str = include_str!("../../../missions/01-air-sample.toml");

    fn states(deed: &Deed) -> Vec<RowState> {
        let mission = Mission::parse(AIR_SAMPLE).expect("the shipped mission is good");
        let mut flight = Flight::new(Arc::new(mission), 1);
        let rows = flight.act(EntryId(0), deed, &[3, 4, 5]);
        rows.iter().map(|row| row.state).collect()
    }

    #[test]
    fn each_report_is_answered_with_the_number_that_it_adds() {
        let mission = Mission::parse(AIR_SAMPLE).expect("the shipped mission is good");
        let mut flight = Flight::new(Arc::new(mission), 1);
        let mut answers = |north_m: f64| {
            let spot = Spot::Offset {
                north_m,
                east_m: 0.0,
            };
            let deed = Deed::Mark {
                subject: Subject::Spot(spot),
                kind: Some(FindKind::Mine),
            };
            let rows = flight.act(EntryId(0), &deed, &[1, 2]);
            let words = rows
                .into_iter()
                .map(|row| row.explanation.map(|it| it.to_string()));
            words.collect::<Vec<_>>()
        };
        assert_eq!(answers(5.0), [Some("1 reported".to_owned())]);
        assert_eq!(answers(50.0), [Some("1 reported".to_owned())]);
    }

    #[test]
    fn a_report_of_a_kind_that_the_mission_does_not_know_is_refused_with_those_that_it_does() {
        const PLUME: &str = include_str!("../../../missions/03-plume-source.toml");
        let mission = Mission::parse(PLUME).expect("the shipped mission is good");
        let mut flight = Flight::new(Arc::new(mission), 1);
        let mut report = |kind| {
            let subject = Subject::Spot(Spot::Offset {
                north_m: 90.0,
                east_m: 0.0,
            });
            let rows = flight.act(EntryId(0), &Deed::Mark { subject, kind }, &[1]);
            let reason = rows[0].explanation.as_ref().map(ToString::to_string);
            (rows[0].state, reason.unwrap_or_default())
        };
        let (state, reason) = report(Some(FindKind::Source));
        assert_eq!(state, RowState::Refused);
        assert!(reason.contains("`leak`"), "{reason}");
        assert_eq!(report(Some(FindKind::Leak)).0, RowState::Done);
        assert_eq!(report(None).0, RowState::Done);
    }

    #[test]
    fn contacts_and_places_are_reported_by_the_first_vehicle_alone() {
        use RowState::{Done, Refused};
        let contacts = |confirmed| Deed::Mark {
            subject: Subject::Contacts { confirmed },
            kind: None,
        };
        let spot = Deed::Mark {
            subject: Subject::Spot(Spot::Offset {
                north_m: 5.0,
                east_m: 0.0,
            }),
            kind: Some(FindKind::Mine),
        };
        assert_eq!(states(&contacts(true)), [Refused]);
        assert_eq!(states(&contacts(false)), [Refused]);
        assert_eq!(states(&spot), [Done]);
        let unmark = Deed::Unmark {
            spot: Spot::Offset {
                north_m: 5.0,
                east_m: 0.0,
            },
        };
        assert_eq!(states(&unmark), [Refused]);
    }
}
