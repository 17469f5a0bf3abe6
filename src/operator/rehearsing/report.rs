//! The result of a rehearsal: rows of the ledger, notices, and the findings that the console keeps.

use std::time::Duration;

use crate::geo::LatLon;
use crate::ledger::{EntryId, RowEnding, RowState, RowUpdate};
use crate::notice::Notice;
use crate::plan::ContentHash;
use crate::rehearsal::{Approach, FlightEnding, Flown, Outcome};
use crate::text;
use crate::text::{Text, clock_s, figure};
use crate::vehicle::{Mode, Severity, VehicleId};

const MOST_CONFLICTS: usize = 5;

/// A vehicle of a rehearsal.
#[derive(Debug, Clone, Copy)]
pub(super) struct Seat {
    pub(super) vehicle: VehicleId,
    /// The remaining charge of its battery, in percent.
    pub(super) charge_percent: f64,
    /// The plan that is flown.
    pub(super) plan: ContentHash,
}

/// The result of a rehearsal.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Rehearsed {
    pub rows: Vec<RowUpdate>,
    pub notices: Vec<Notice>,
    pub findings: RehearsalFindings,
}

/// The findings of a rehearsal, which hold as long as the vehicles carry the same plans.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct RehearsalFindings {
    /// Where vehicles come too close to each other.
    pub meetings: Vec<Meeting>,
    /// The vehicles whose plans failed.
    pub failed: Vec<FailedRehearsal>,
    /// The vehicles whose plans can be flown.
    pub passed: Vec<VehicleId>,
}

/// A plan that a vehicle does not fly as intended.
#[derive(Debug, Clone, PartialEq)]
pub struct FailedRehearsal {
    pub vehicle: VehicleId,
    /// The plan that was flown.
    pub plan: ContentHash,
    /// Why the plan failed, in words.
    pub reason: Text,
}

/// A place at which two vehicles come too close to each other in a rehearsal.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Meeting {
    pub vehicles: [VehicleId; 2],
    /// The place half-way between them.
    pub at_point: LatLon,
}

impl Rehearsed {
    /// The same result at another time.
    #[must_use]
    pub fn at(mut self, now: Duration) -> Self {
        for row in &mut self.rows {
            row.at = now;
        }
        for notice in &mut self.notices {
            notice.at = now;
        }
        self
    }
}

pub(super) fn row(
    entry: EntryId,
    vehicle: VehicleId,
    state: RowState,
    explanation: Option<Text>,
    at: Duration,
) -> RowUpdate {
    RowUpdate {
        entry,
        vehicle,
        state,
        tries: 1,
        at,
        explanation,
    }
}

/// The result of an outcome for these vehicles.
pub(super) fn report(
    entry: EntryId,
    seats: &[Seat],
    outcome: &Outcome,
    now: Duration,
) -> Rehearsed {
    let mut rehearsed = Rehearsed::default();
    for (index, (seat, flown)) in seats.iter().zip(&outcome.vehicles).enumerate() {
        let meets = outcome.conflicts_of(index).next().is_some();
        let RowEnding { state, text } = verdict(seat, flown, meets);
        if state == RowState::Done {
            rehearsed.findings.passed.push(seat.vehicle);
        } else {
            rehearsed.findings.failed.push(FailedRehearsal {
                vehicle: seat.vehicle,
                plan: seat.plan,
                reason: text.clone(),
            });
        }
        rehearsed
            .rows
            .push(row(entry, seat.vehicle, state, Some(text), now));
    }
    rehearsed.findings.meetings = outcome.conflicts().map(|it| meeting(seats, it)).collect();
    let said = approaches(seats, &outcome.closest).into_iter();
    let said = said.map(|(severity, text)| Notice::general(now, severity, text));
    rehearsed.notices.extend(said);
    rehearsed
}

/// Texts about the pairs that come too close, or would if one of them were late: the first ones,
/// and the number of others; if there are none, the closest pair.
fn approaches(seats: &[Seat], closest: &[Approach]) -> Vec<(Severity, Text)> {
    let near: Vec<&Approach> = closest.iter().filter(|it| it.late_s.is_some()).collect();
    if near.is_empty() {
        let first = closest.first().map(|it| (Severity::Info, words(seats, it)));
        return first.into_iter().collect();
    }
    let named = near.iter().take(MOST_CONFLICTS);
    let named = named.map(|it| words(seats, it));
    let more = near.len().saturating_sub(MOST_CONFLICTS);
    let more = (more > 0).then(|| text!("rehearse-more", count = more));
    let texts = named.chain(more);
    texts.map(|text| (Severity::Warning, text)).collect()
}

fn name(seats: &[Seat], index: usize) -> VehicleId {
    seats.get(index).map_or(0, |seat| seat.vehicle)
}

fn meeting(seats: &[Seat], approach: &Approach) -> Meeting {
    Meeting {
        vehicles: [approach.a, approach.b].map(|index| name(seats, index)),
        at_point: approach.place,
    }
}

fn words(seats: &[Seat], approach: &Approach) -> Text {
    let [a, b] = [approach.a, approach.b].map(|index| name(seats, index));
    let message = match approach.late_s {
        Some(0) => "rehearse-conflict",
        Some(late_s) => return text!("rehearse-late", a = a, b = b, late = late_s),
        None => "rehearse-closest",
    };
    Text::new(
        message,
        vec![
            ("a", a.into()),
            ("b", b.into()),
            ("time", clock_s(approach.at_s).into()),
            ("horizontal", figure(approach.horizontal_m, 1).into()),
            ("vertical", figure(approach.vertical_m, 1).into()),
        ],
    )
}

/// The outcome for a vehicle: done if it flew as planned, kept its distance from the others, and
/// had enough charge.
fn verdict(seat: &Seat, flown: &Flown, meets: bool) -> RowEnding {
    let used = flown.energy_used_percent;
    let left = seat.charge_percent - used;
    let is_empty = left <= 0.0;
    let state = if flown.is_as_planned() && !is_empty && !meets {
        RowState::Done
    } else {
        RowState::NoEffect
    };
    let time = clock_s(flown.time_s);
    let [used, left] = [used, left].map(|percent| figure(percent, 0));
    let text = match (flown.broke_fence_s, flown.ending) {
        (Some(at_s), _) => text!("rehearse-fence", time = clock_s(at_s)),
        (None, FlightEnding::Landed | FlightEnding::InAir) if is_empty => {
            text!("rehearse-battery", used = used)
        }
        (None, FlightEnding::HitGround(number)) => {
            text!("rehearse-hit-ground", time = time, number = number)
        }
        (None, FlightEnding::Landed | FlightEnding::InAir) if meets => {
            text!("rehearse-meets", time = time)
        }
        (None, FlightEnding::Landed) => {
            text!("rehearse-landed", time = time, used = used, left = left)
        }
        (None, FlightEnding::InAir) => text!("rehearse-ends-in-air", time = time, used = used),
        (None, FlightEnding::LeftPlan(number)) => {
            let mode = Mode::copter(number).to_string();
            text!("rehearse-left-plan", time = time, mode = mode)
        }
        (None, FlightEnding::Grounded) => text!("rehearse-grounded"),
        (None, FlightEnding::Crashed) => text!("rehearse-crashed", time = time),
        (None, FlightEnding::TimeUp) => text!("rehearse-time-up", time = time),
    };
    RowEnding::new(state, text)
}

/// How a rehearsed flight ended.
pub fn ending_words(ending: FlightEnding) -> Text {
    match ending {
        FlightEnding::Landed => text!("plan-rehearse-landed"),
        FlightEnding::InAir => text!("plan-rehearse-in-air"),
        FlightEnding::LeftPlan(number) => {
            let mode = Mode::copter(number).to_string();
            text!("plan-rehearse-left-plan", mode = mode)
        }
        FlightEnding::Grounded => text!("plan-rehearse-grounded"),
        FlightEnding::Crashed => text!("plan-rehearse-crashed"),
        FlightEnding::HitGround(number) => text!("plan-rehearse-hit-ground", number = number),
        FlightEnding::TimeUp => text!("plan-rehearse-time-up"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_pairs_that_are_not_named_are_counted() {
        let said = |near: usize| -> Vec<String> {
            let pair = |at: usize| Approach {
                a: 0,
                b: at + 1,
                horizontal_m: 1.0,
                vertical_m: 0.0,
                at_s: 60.0,
                place: LatLon::new(50.45, 30.52),
                limit_m: 5.0,
                late_s: (at < near).then_some(0),
            };
            let pairs: Vec<Approach> = (0..10).map(pair).collect();
            let said = approaches(&[], &pairs).into_iter();
            said.map(|(_, text)| text.to_string()).collect()
        };
        assert_eq!(said(0).len(), 1, "the closest pair");
        assert_eq!(said(5).len(), 5);
        let many = said(7);
        assert_eq!(many.len(), 6);
        assert!(many[5].contains("2 more pairs"), "{many:?}");
    }
}
