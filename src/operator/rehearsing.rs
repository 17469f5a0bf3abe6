//! `plan rehearse`: the plans on board, flown in simulation from where the vehicles stand.

use std::sync::Arc;
use std::time::Duration;

use crate::commands::Order;
use crate::geo::LatLon;
use crate::ledger::{EntryId, RowState, RowUpdate};
use crate::notice::Notice;
use crate::parameters::ParameterList;
use crate::plan::{Document, Home};
use crate::rehearsal::{
    Approach, Conditions, Ending, Flown, Outcome, Participant, RehearsalError, rehearse,
};
use crate::text;
use crate::text::{Text, clock, figure};
use crate::vehicle::{Severity, Transfer, Vehicle, VehicleId, Vehicles};

/// The parameters that decide how a plan is flown; others, such as those of sensors, are not carried over.
const CARRIED: &[&str] = &[
    "WPNAV_",
    "RTL_",
    "LAND_",
    "CIRCLE_",
    "FENCE_",
    "PILOT_SPEED_",
    "BATT_CAPACITY",
    "BATT_LOW_MAH",
    "BATT_CRT_MAH",
    "DISARM_DELAY",
    "MIS_",
];
/// The most conflicts that are reported.
const MOST_CONFLICTS: usize = 5;

/// A rehearsal that is to be flown.
#[derive(Debug, Clone)]
pub struct PlanRehearsal {
    entry: EntryId,
    crew: Vec<Member>,
    conditions: Conditions,
}

#[derive(Debug, Clone)]
struct Member {
    vehicle: VehicleId,
    participant: Participant,
    charge_percent: f64,
}

/// Two rehearsals are the same if they belong to the same order.
impl PartialEq for PlanRehearsal {
    fn eq(&self, other: &Self) -> bool {
        self.entry == other.entry
    }
}

/// The result of a rehearsal.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Rehearsed {
    pub rows: Vec<RowUpdate>,
    pub notices: Vec<Notice>,
    /// Where vehicles come too close to each other.
    pub meetings: Vec<Meeting>,
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

/// The vehicles of an order whose plans can be flown, and the rows of the others.
pub(super) fn prepare(
    entry: EntryId,
    order: &Order,
    vehicles: &Vehicles,
    now: Duration,
) -> (Vec<RowUpdate>, Option<PlanRehearsal>) {
    let mut rows = Vec::new();
    let mut crew = Vec::new();
    for &id in &order.targets {
        let (state, explanation) = match vehicles.get(&id).map(|it| member(id, it)) {
            Some(Ok(member)) => {
                crew.push(member);
                (RowState::InProgress(0), None)
            }
            Some(Err(reason)) => (RowState::Refused, Some(reason)),
            None => (RowState::Refused, Some(text!("refused-not-heard"))),
        };
        rows.push(row(entry, id, state, explanation, now));
    }
    let mut winds = order.targets.iter().filter_map(|id| vehicles.get(id)?.wind);
    let wind = winds.next();
    let conditions = Conditions {
        wind_m_s: wind.map_or(0.0, |wind| wind.speed_m_s),
        wind_from_deg: wind.map_or(0.0, |wind| wind.from_deg),
        ..Conditions::default()
    };
    let rehearsal = (!crew.is_empty()).then_some(PlanRehearsal {
        entry,
        crew,
        conditions,
    });
    (rows, rehearsal)
}

fn row(
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

fn member(id: VehicleId, vehicle: &Vehicle) -> Result<Member, Text> {
    if vehicle.airborne() {
        return Err(text!("rehearse-in-air"));
    }
    let here = vehicle.global.ok_or_else(|| text!("refused-no-position"))?;
    let lists = &vehicle.plans;
    let plan = lists.plan.content.as_ref();
    let plan = plan.filter(|_| lists.plan.transfer == Transfer::Done);
    let plan = plan.ok_or_else(|| text!("rehearse-unread"))?;
    if plan.flown().is_empty() {
        return Err(text!("rehearse-no-plan"));
    }
    let (x, y) = here.at_point.to_e7();
    let fence = lists.fence.content.as_ref();
    let rally = lists.rally.content.as_ref();
    let charge = vehicle.battery().and_then(|it| it.remaining_percent);
    Ok(Member {
        vehicle: id,
        participant: Participant {
            document: Document {
                home: Some(Home {
                    x,
                    y,
                    z: here.altitude_amsl_m as f32,
                }),
                plan: plan.flown().to_vec(),
                fence: fence.map(|it| it.items.clone()).unwrap_or_default(),
                rally: rally.map(|it| it.items.clone()).unwrap_or_default(),
                origin: None,
            },
            airframe: None,
            delay_s: 0.0,
            parameters: Vec::new(),
        },
        charge_percent: charge.map_or(100.0, f64::from),
    })
}

impl PlanRehearsal {
    /// The vehicles that are flown.
    pub fn vehicles(&self) -> Vec<VehicleId> {
        self.crew.iter().map(|member| member.vehicle).collect()
    }

    /// Gives a vehicle the parameters that have been read, as far as they decide how it flies.
    pub fn set_parameters(&mut self, vehicle: VehicleId, list: &Arc<ParameterList>) {
        let members = self.crew.iter_mut();
        for member in members.filter(|member| member.vehicle == vehicle) {
            let carried = |name: &str| CARRIED.iter().any(|start| name.starts_with(start));
            member.participant.parameters = list
                .iter()
                .filter(|(name, _)| carried(name))
                .map(|(name, known)| (name.to_owned(), known.value))
                .collect();
        }
    }

    /// Flies the plans. Takes about a second for 32 vehicles and ten minutes.
    pub fn fly(&self, now: Duration) -> Rehearsed {
        let participants: Vec<Participant> =
            self.crew.iter().map(|it| it.participant.clone()).collect();
        match rehearse(&participants, &self.conditions) {
            Ok(outcome) => self.report(&outcome, now),
            Err(error) => {
                let reason = self.refusal(&error);
                let row = |member: &Member| {
                    let reason = Some(reason.clone());
                    row(self.entry, member.vehicle, RowState::Refused, reason, now)
                };
                Rehearsed {
                    rows: self.crew.iter().map(row).collect(),
                    ..Rehearsed::default()
                }
            }
        }
    }

    fn name(&self, index: usize) -> VehicleId {
        self.crew.get(index).map_or(0, |member| member.vehicle)
    }

    fn refusal(&self, error: &RehearsalError) -> Text {
        match error {
            RehearsalError::NoPlan(_) => text!("rehearse-no-plan"),
            RehearsalError::NoHome(_) => text!("refused-no-position"),
            RehearsalError::Refused(index, _) => {
                text!("rehearse-refused", vehicle = self.name(*index))
            }
            RehearsalError::NoParameter(name) => text!("plan-rehearse-no-parameter", name = name),
        }
    }

    fn report(&self, outcome: &Outcome, now: Duration) -> Rehearsed {
        let flown = self.crew.iter().zip(&outcome.vehicles).enumerate();
        let rows = flown.map(|(index, (member, flown))| {
            let mut meetings = outcome.conflicts();
            let meets = meetings.any(|it| it.a == index || it.b == index);
            let (state, text) = verdict(member, flown, meets);
            row(self.entry, member.vehicle, state, Some(text), now)
        });
        let conflicts = outcome.conflicts().take(MOST_CONFLICTS);
        let closest = outcome
            .closest
            .iter()
            .take(1)
            .filter(|it| !it.is_conflict());
        let notices = conflicts.chain(closest).map(|approach| {
            let severity = if approach.is_conflict() {
                Severity::Warning
            } else {
                Severity::Info
            };
            Notice::general(now, severity, self.approach(approach))
        });
        Rehearsed {
            rows: rows.collect(),
            notices: notices.collect(),
            meetings: outcome.conflicts().map(|it| self.meeting(it)).collect(),
        }
    }

    fn meeting(&self, approach: &Approach) -> Meeting {
        Meeting {
            vehicles: [self.name(approach.a), self.name(approach.b)],
            at_point: approach.place,
        }
    }

    fn approach(&self, approach: &Approach) -> Text {
        let message = if approach.is_conflict() {
            "rehearse-conflict"
        } else {
            "rehearse-closest"
        };
        Text::new(
            message,
            vec![
                ("a", self.name(approach.a).into()),
                ("b", self.name(approach.b).into()),
                ("time", minutes(approach.at_s).into()),
                ("horizontal", figure(approach.horizontal_m, 1).into()),
                ("vertical", figure(approach.vertical_m, 1).into()),
            ],
        )
    }
}

fn minutes(seconds: f64) -> String {
    clock(Duration::from_secs_f64(seconds.max(0.0)))
}

/// What becomes of a vehicle, and whether that is as planned.
fn verdict(member: &Member, flown: &Flown, meets: bool) -> (RowState, Text) {
    let time = minutes(flown.time_s);
    let used = 100.0 - flown.energy_left_percent;
    let left = member.charge_percent - used;
    if let Some(at_s) = flown.broke_fence_s {
        let text = text!("rehearse-fence", time = minutes(at_s));
        return (RowState::NoEffect, text);
    }
    let is_empty = left <= 0.0;
    let used = figure(used, 0);
    let text = match flown.ending {
        Ending::Landed | Ending::InAir if is_empty => text!("rehearse-battery", used = used),
        Ending::Landed | Ending::InAir if meets => text!("rehearse-meets", time = time),
        Ending::Landed => {
            let left = figure(left, 0);
            return (
                RowState::Done,
                text!("rehearse-landed", time = time, used = used, left = left),
            );
        }
        Ending::InAir => {
            let text = text!("rehearse-ends-in-air", time = time, used = used);
            return (RowState::Done, text);
        }
        Ending::LeftPlan(mode) => text!("rehearse-left-plan", time = time, mode = mode),
        Ending::Grounded => text!("rehearse-grounded"),
        Ending::Crashed => text!("rehearse-crashed", time = time),
        Ending::TimeUp => text!("rehearse-time-up", time = time),
    };
    (RowState::NoEffect, text)
}
