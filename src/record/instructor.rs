//! The instructor's part in a flight, from the orders of the desk in its journal.

use std::time::Duration;

use serde::{Deserialize, Serialize};

use super::{DeskRecord, Happening, Journal, MissionClock};
use crate::class::{Deed, Outcome, Words};
use crate::class_text::vehicles_text;
use crate::text;
use crate::text::{Text, clock, rounded};
use crate::vehicle::VehicleId;

/// What an instructor did in a flight that its score does not show, in the order in which it began.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct InstructorPart(Vec<InstructorAct>);

/// Something that an instructor did in a flight. Times are mission times in seconds.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum InstructorAct {
    /// The instructor was the pilot in command of vehicles.
    Flew {
        by: String,
        /// The vehicles that the instructor flew; empty for all of the flight.
        vehicles: Vec<VehicleId>,
        from_s: f64,
        /// `None` if it was so until the end of the flight.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        until_s: Option<f64>,
    },
    /// The instructor triggered an inject of the mission.
    Injected {
        by: String,
        /// Its name in commands.
        inject: String,
        at_s: f64,
        /// The vehicles that it hit, in words; `None` for one that hits none.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        hit: Option<String>,
    },
    /// The instructor returned to an earlier situation of the flight.
    Recalled {
        by: String,
        situation: String,
        at_s: f64,
    },
    /// The flight continued from an earlier situation, at its time.
    Continued {
        by: String,
        situation: String,
        from_s: f64,
    },
}

impl InstructorAct {
    /// What was done, and when.
    pub fn text(&self) -> Text {
        match self {
            Self::Flew {
                by,
                vehicles,
                from_s,
                until_s,
            } => {
                let vehicles = vehicles_text(vehicles);
                let from = minutes(*from_s);
                match until_s.map(minutes) {
                    Some(until) => text!(
                        "instructor-flew",
                        by = by,
                        vehicles = vehicles,
                        from = from,
                        until = until
                    ),
                    None => text!(
                        "instructor-flies",
                        by = by,
                        vehicles = vehicles,
                        from = from
                    ),
                }
            }
            Self::Injected {
                by,
                inject,
                at_s,
                hit,
            } => {
                let at = minutes(*at_s);
                let done = text!("instructor-injected", by = by, inject = inject, at = at);
                let hit = hit.as_deref().map(Text::verbatim);
                Text::joined(": ", std::iter::once(done).chain(hit).collect())
            }
            Self::Recalled {
                by,
                situation,
                at_s,
            } => text!(
                "instructor-recalled",
                by = by,
                situation = situation,
                at = minutes(*at_s)
            ),
            Self::Continued {
                by,
                situation,
                from_s,
            } => text!(
                "instructor-continued",
                by = by,
                situation = situation,
                from = minutes(*from_s)
            ),
        }
    }
}

impl InstructorPart {
    /// The part that a journal tells of.
    pub fn of(journal: &Journal) -> Self {
        let mission = MissionClock::of(journal);
        let mut part = Self::default();
        for line in &journal.lines {
            if let Happening::Desk(order) = &line.what {
                part.add(mission.flight_time(line.at()), order);
            }
        }
        part
    }

    /// What was done, in the order in which it began.
    pub fn acts(&self) -> &[InstructorAct] {
        &self.0
    }

    /// Whether the instructor did nothing of this kind.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Adds an order that ended at a mission time, if it belongs to this part and was carried out.
    pub fn add(&mut self, at: Duration, order: &DeskRecord) {
        if order.outcome != Outcome::Done {
            return;
        }
        match &order.deed {
            Deed::TakeOver { vehicles } => self.take_over(at, &order.by, vehicles),
            Deed::HandBack { vehicles } => self.hand_back(at, Some(&order.by), vehicles),
            Deed::Inject { name, .. } => self.0.push(InstructorAct::Injected {
                by: order.by.clone(),
                inject: name.to_string(),
                at_s: seconds(at),
                hit: order.why.as_ref().map(Words::to_string),
            }),
            Deed::Recall { situation } => {
                // The mission's time goes back: whoever still flies begins anew.
                self.hand_back(at, None, &[]);
                self.0.push(InstructorAct::Recalled {
                    by: order.by.clone(),
                    situation: situation.to_string(),
                    at_s: seconds(at),
                });
            }
            _ => {}
        }
    }

    /// The flight continues from a situation at a mission time: what came after it is left behind, and only turns at
    /// the vehicles that began before it go on.
    pub fn go_back(&mut self, to: Duration, by: &str, situation: &str) {
        let to_s = seconds(to);
        self.0.retain_mut(|act| match act {
            InstructorAct::Flew {
                from_s, until_s, ..
            } => {
                if let Some(until_s) = until_s {
                    *until_s = until_s.min(to_s);
                }
                *from_s < to_s
            }
            InstructorAct::Injected { at_s: begun_s, .. }
            | InstructorAct::Recalled { at_s: begun_s, .. }
            | InstructorAct::Continued {
                from_s: begun_s, ..
            } => *begun_s <= to_s,
        });
        self.0.push(InstructorAct::Continued {
            by: by.to_owned(),
            situation: situation.to_owned(),
            from_s: to_s,
        });
    }

    /// A person flies these vehicles from a mission time on.
    fn take_over(&mut self, at: Duration, by: &str, vehicles: &[VehicleId]) {
        // Taking over what one already flies changes nothing.
        let new: Vec<VehicleId> = vehicles
            .iter()
            .copied()
            .filter(|vehicle| !self.flies(by, *vehicle))
            .collect();
        if new.is_empty() && !vehicles.is_empty() {
            return;
        }
        if !new.is_empty() {
            self.hand_back(at, None, &new);
        }
        self.0.push(InstructorAct::Flew {
            by: by.to_owned(),
            vehicles: new,
            from_s: seconds(at),
            until_s: None,
        });
    }

    fn flies(&self, person: &str, vehicle: VehicleId) -> bool {
        self.0.iter().any(|act| {
            matches!(act, InstructorAct::Flew { by, vehicles, until_s: None, .. }
                if by == person && vehicles.contains(&vehicle))
        })
    }

    /// These vehicles, or all, are no longer flown by a person, or by anybody.
    fn hand_back(&mut self, at: Duration, person: Option<&str>, back: &[VehicleId]) {
        let mut acts = Vec::with_capacity(self.0.len());
        for mut act in std::mem::take(&mut self.0) {
            let mut rest = None;
            if let InstructorAct::Flew {
                by,
                vehicles,
                until_s: until @ None,
                ..
            } = &mut act
                && person.is_none_or(|person| person == by)
            {
                let is_back = |vehicle: &VehicleId| back.is_empty() || back.contains(vehicle);
                let (ended, kept): (Vec<VehicleId>, _) =
                    vehicles.iter().partition(|it| is_back(it));
                if !ended.is_empty() || vehicles.is_empty() {
                    if !kept.is_empty() {
                        rest = Some(kept);
                    }
                    (*vehicles, *until) = (ended, Some(seconds(at)));
                }
            }
            let kept = rest.map(|kept| act.still_flown(kept));
            acts.push(act);
            acts.extend(kept);
        }
        self.0 = acts;
    }
}

impl InstructorAct {
    /// The same turn for the vehicles that were not handed back.
    fn still_flown(&self, kept: Vec<VehicleId>) -> Self {
        let mut same = self.clone();
        if let Self::Flew {
            vehicles, until_s, ..
        } = &mut same
        {
            (*vehicles, *until_s) = (kept, None);
        }
        same
    }
}

fn seconds(at: Duration) -> f64 {
    rounded(at.as_secs_f64(), 1)
}

fn minutes(at_s: f64) -> String {
    clock(Duration::try_from_secs_f64(at_s).unwrap_or_default())
}

#[cfg(test)]
mod tests;
