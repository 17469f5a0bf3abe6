//! `plan rehearse`: the plans on board, flown in simulation from where the vehicles stand.

use std::sync::Arc;
use std::time::Duration;

use crate::commands::Order;
use crate::ledger::{EntryId, RowState};
use crate::notice::Notice;
use crate::parameters::ParameterList;
use crate::plan::{ContentHash, Document, Home};
use crate::rehearsal::{
    Conditions, Heard, Outcome, Participant, RehearsalError, rehearse, rehearse_heard,
};
use crate::sim::Airframe;
use crate::text;
use crate::text::Text;
use crate::vehicle::{
    FenceSwitch, Severity, Transfer, Vehicle, VehicleClass, VehicleId, Vehicles, Wind,
};
use crate::vehicle_id::ranges;

mod air;
mod queue;
mod report;

use air::KnownAir;
pub(super) use queue::{Prepared, RehearsalQueue};
use report::Seat;
pub use report::{FailedRehearsal, Meeting, RehearsalFindings, Rehearsed, ending_words};

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
    // The profile of the wind.
    "SIM_WIND_T_",
];
const CARRIED_BY_NAME: &[&str] = &["SIM_WIND_T"];

/// A rehearsal that is to be flown.
#[derive(Debug, Clone)]
pub struct PlanRehearsal {
    entry: EntryId,
    crew: Vec<Member>,
    air: KnownAir,
}

#[derive(Debug, Clone)]
struct Member {
    seat: Seat,
    participant: Participant,
    /// Whether the vehicle reports that its fence is on.
    reported_fence: Option<bool>,
    /// Whether its parameters have been read completely.
    is_read: bool,
}

/// The bit mask of the fence types (`FENCE_TYPE`) whose limits are known. Without `FENCE_RADIUS`,
/// the flight would be judged by the simulator's own circle.
fn known_kinds(value: impl Fn(&str) -> Option<f32>) -> f32 {
    const AREAS: u8 = 4;
    const LIMITS: [(u8, &str); 3] = [
        (1, "FENCE_ALT_MAX"),
        (2, "FENCE_RADIUS"),
        (8, "FENCE_ALT_MIN"),
    ];
    let kinds = value("FENCE_TYPE").map_or(AREAS, |kinds| kinds as u8);
    let unknown = LIMITS.iter().filter(|(_, name)| value(name).is_none());
    f32::from(unknown.fold(kinds, |kinds, (kind, _)| kinds & !kind))
}

/// Two rehearsals are the same if they belong to the same order.
impl PartialEq for PlanRehearsal {
    fn eq(&self, other: &Self) -> bool {
        self.entry == other.entry
    }
}

/// The winds known without the vehicles: the user's and the mission's.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Winds {
    pub(super) given: Option<Wind>,
    pub(super) of_mission: Option<Wind>,
}

/// An order to rehearse, with the data that does not come from the vehicles.
#[derive(Debug, Clone)]
pub(super) struct RehearsalRequest {
    pub(super) entry: EntryId,
    pub(super) order: Order,
    pub(super) winds: Winds,
    /// The airframes of the mission's drones.
    pub(super) airframes: Vec<Arc<Airframe>>,
}

/// The vehicles of an order whose plans can be flown, and the rows of the other vehicles.
fn prepare(request: &RehearsalRequest, vehicles: &Vehicles, now: Duration) -> Prepared {
    let (entry, order, winds) = (request.entry, &request.order, request.winds);
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
        rows.push(report::row(entry, id, state, explanation, now));
    }
    let targets = order.targets.iter().filter_map(|id| vehicles.get(id));
    let air = KnownAir::of(winds.given, winds.of_mission, targets.map(AsRef::as_ref));
    let mut rehearsal = (!crew.is_empty()).then_some(PlanRehearsal { entry, crew, air });
    if let Some(rehearsal) = &mut rehearsal {
        rehearsal.set_airframes(&request.airframes);
    }
    Prepared { rows, rehearsal }
}

/// Refuses the vehicles whose flight the simulator does not know.
///
/// # Errors
/// The vehicle is a plane or moves on a surface.
pub fn flies_in_rehearsals(vehicle: &Vehicle) -> Result<(), Text> {
    if matches!(vehicle.class(), VehicleClass::Plane | VehicleClass::Rover) {
        return Err(text!("rehearse-kind", kind = vehicle.kind_name()));
    }
    Ok(())
}

fn member(id: VehicleId, vehicle: &Vehicle) -> Result<Member, Text> {
    if vehicle.airborne() {
        return Err(text!("rehearse-in-air"));
    }
    flies_in_rehearsals(vehicle)?;
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
        seat: Seat {
            vehicle: id,
            charge_percent: charge.map_or(100.0, f64::from),
            plan: ContentHash::of(plan.flown()),
        },
        reported_fence: vehicle.reports_fence_on(),
        is_read: false,
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
            charge_percent: charge.map(f64::from),
            delay_s: 0.0,
            parameters: Vec::new(),
            fence_switch: None,
        },
    })
}

impl PlanRehearsal {
    /// The vehicles that are flown.
    pub fn vehicles(&self) -> Vec<VehicleId> {
        self.crew.iter().map(|it| it.seat.vehicle).collect()
    }

    /// Stores the parameters of a vehicle that determine how it flies.
    pub fn set_parameters(&mut self, vehicle: VehicleId, list: &Arc<ParameterList>) {
        let value = |name: &str| list.get(name).map(|known| known.value as f32);
        let members = self.crew.iter_mut();
        for member in members.filter(|member| member.seat.vehicle == vehicle) {
            let carried = |name: &str| {
                CARRIED.iter().any(|start| name.starts_with(start))
                    || CARRIED_BY_NAME.contains(&name)
            };
            member.participant.parameters = list
                .iter()
                .filter(|(name, _)| carried(name))
                .map(|(name, known)| (name.to_owned(), known.value as f32))
                .collect();
            let fence = FenceSwitch::of(member.reported_fence, value);
            member.participant.fence_switch = fence.by_command;
            if fence.is_on == Some(true) {
                let kinds = ("FENCE_TYPE".to_owned(), known_kinds(value));
                member.participant.parameters.push(kinds);
            }
            member.is_read = list.is_complete();
            self.air.note_parameters(vehicle, value);
        }
    }

    /// Sets the airframe of each vehicle: the first one is that of vehicle 1, and so on; the last
    /// one applies to all further vehicles.
    pub fn set_airframes(&mut self, airframes: &[Arc<Airframe>]) {
        for member in &mut self.crew {
            let seat = usize::from(member.seat.vehicle).saturating_sub(1);
            let own = airframes.get(seat).or(airframes.last());
            if let Some(own) = own {
                member.participant.airframe = Some(Arc::clone(own));
            }
        }
    }

    /// Flies the plans. Takes about a second for 32 vehicles and ten minutes of flight.
    pub fn fly(&self, now: Duration) -> Rehearsed {
        self.reported(self.outcome(), now)
    }

    /// Flies the plans, and passes everything that the vehicles send to `listener`, in the order of
    /// [`Self::vehicles`].
    pub fn fly_heard(&self, now: Duration, listener: &mut dyn FnMut(Heard<'_>)) -> Rehearsed {
        let outcome = rehearse_heard(&self.participants(), &self.weather(), listener);
        self.reported(outcome, now)
    }

    fn reported(&self, outcome: Result<Outcome, RehearsalError>, now: Duration) -> Rehearsed {
        let seats: Vec<Seat> = self.crew.iter().map(|it| it.seat).collect();
        match outcome {
            Ok(outcome) => {
                let mut rehearsed = report::report(self.entry, &seats, &outcome, now);
                let said = Notice::general(now, Severity::Info, self.conditions());
                rehearsed.notices.insert(0, said);
                rehearsed
            }
            Err(error) => {
                let reason = Some(self.refusal(&error));
                let row = |vehicle| {
                    report::row(self.entry, vehicle, RowState::Refused, reason.clone(), now)
                };
                Rehearsed {
                    rows: self.vehicles().into_iter().map(row).collect(),
                    ..Rehearsed::default()
                }
            }
        }
    }

    /// The figures of the rehearsal.
    ///
    /// # Errors
    /// The simulator refuses a plan.
    pub fn outcome(&self) -> Result<Outcome, RehearsalError> {
        rehearse(&self.participants(), &self.weather())
    }

    fn participants(&self) -> Vec<Participant> {
        self.crew.iter().map(|it| it.participant.clone()).collect()
    }

    fn weather(&self) -> Conditions {
        let wind = self.air.wind();
        Conditions {
            wind_m_s: wind.speed_m_s,
            wind_from_deg: wind.from_deg,
            parameters: self.air.parameters(),
            ..Conditions::default()
        }
    }

    /// The wind and the airframes of the rehearsal, and their sources.
    fn conditions(&self) -> Text {
        let standard = self
            .crew
            .iter()
            .filter(|it| it.participant.airframe.is_none());
        let standard: Vec<VehicleId> = standard.map(|it| it.seat.vehicle).collect();
        let airframes = if standard.is_empty() {
            text!("rehearse-airframes-own")
        } else if standard.len() == self.crew.len() {
            text!("rehearse-airframes-standard")
        } else {
            text!("rehearse-airframes-mixed", vehicles = ranges(standard))
        };
        let unread = self.crew.iter().filter(|it| !it.is_read);
        let unread = ranges(unread.map(|it| it.seat.vehicle));
        let mut parts = vec![self.air.words(), airframes];
        if !unread.is_empty() {
            parts.push(text!("rehearse-parameters-unread", vehicles = unread));
        }
        let conditions = Text::joined("; ", parts);
        text!("rehearse-conditions", conditions = conditions)
    }

    fn name(&self, index: usize) -> VehicleId {
        self.crew.get(index).map_or(0, |it| it.seat.vehicle)
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
}
