//! The conditions that a script can wait for, and whether each of them holds now ([`Until::holds`]). When a vehicle
//! counts as arrived is a property of its verb ([`Arrival`]); `arrived` applies it.

use std::collections::BTreeMap;
use std::time::Duration;

use strum::{EnumString, IntoStaticStr, VariantNames};

use crate::commands::{is_back, stopped_m};
use crate::ledger::{Ledger, RowState};
use crate::vehicle::{Mode, Vehicle, VehicleClass, VehicleId, Vehicles};
use crate::verb::Arrival;

/// The default time-out of a wait.
pub(super) const DEFAULT_TIMEOUT: Duration = Duration::from_secs(60);
/// The distance to its target at which a vehicle counts as arrived, in metres, if the ledger does
/// not show the arrival.
const ARRIVED_M: f64 = 2.0;
/// A speed below this counts as standing still.
const STILL_M_S: f32 = 0.5;

#[derive(Debug, Clone, PartialEq)]
pub struct Wait {
    pub until: Until,
    pub timeout: Duration,
}

/// The data that a script uses to evaluate a wait.
#[derive(Debug, Clone, Copy)]
pub struct Seen<'a> {
    pub vehicles: &'a Vehicles,
    /// The commands with their outcome.
    pub ledger: &'a Ledger,
    /// The findings of the mission.
    pub findings: &'a Findings,
}

/// The findings of a mission so far: the readings of sensors, never the truth. Empty without a mission.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Findings {
    /// The number of contacts.
    pub contacts: usize,
    /// The reading of each vehicle's first sensor, in its unit.
    pub readings: BTreeMap<VehicleId, f64>,
    /// The vehicle of each alert that waits for an answer, if the alert is about one.
    pub alerts: Vec<Option<VehicleId>>,
}

/// The condition of a wait, for every target.
#[derive(Debug, Clone, PartialEq)]
pub enum Until {
    /// A time has passed; this needs no targets.
    Passed(Duration),
    /// The vehicle is in this state.
    Situation(Situation),
    /// The vehicle is in the mode with this name or number.
    Mode(String),
    /// A value is above or below a bound.
    Compared {
        field: Field,
        relation: Relation,
        /// The bound, in the field's unit.
        value: f64,
    },
}

/// A state of a vehicle.
#[derive(Debug, Clone, Copy, PartialEq, Eq, EnumString, VariantNames)]
#[strum(serialize_all = "kebab-case")]
pub enum Situation {
    /// Its motors are armed.
    Armed,
    /// Its motors are disarmed.
    Disarmed,
    /// The last movement order was carried out: the vehicle has reached its target, or completed
    /// its part of a joint manoeuvre.
    Arrived,
    /// The vehicle is on the ground.
    Landed,
    /// The vehicle is in the air.
    Airborne,
    Ready,
    /// An alert of the mission about the vehicle waits for an answer.
    Alerted,
}

/// A value that can be compared.
#[derive(Debug, Clone, Copy, PartialEq, Eq, EnumString, IntoStaticStr)]
#[strum(serialize_all = "kebab-case", const_into_str)]
pub enum Field {
    /// Height above home in metres.
    Altitude,
    /// Speed over ground in m/s.
    Speed,
    /// Charge left in percent.
    Battery,
    /// Distance to home in metres.
    Distance,
    Heading,
    #[strum(serialize = "sats")]
    Satellites,
    /// The reading of the first sensor, in its unit.
    Reading,
    /// The number of contacts of all vehicles.
    Contacts,
    /// The number of alerts that wait for an answer.
    Alerts,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, EnumString, VariantNames)]
pub enum Relation {
    #[strum(serialize = ">")]
    Above,
    #[strum(serialize = "<")]
    Below,
    #[strum(serialize = ">=")]
    AtLeast,
    #[strum(serialize = "<=")]
    AtMost,
}

impl Situation {
    fn holds(self, vehicle: &Vehicle, seen: Seen<'_>) -> bool {
        let heard = vehicle.heartbeat.is_some();
        match self {
            Self::Armed => vehicle.armed(),
            Self::Disarmed => heard && !vehicle.armed(),
            Self::Arrived => arrived(vehicle, seen.ledger),
            Self::Landed => vehicle.is_on_the_ground(),
            Self::Airborne => vehicle.airborne(),
            Self::Ready => vehicle.ready_to_arm(),
            Self::Alerted => seen.findings.alerts.contains(&Some(vehicle.id)),
        }
    }
}

impl Field {
    /// The field's current value, if known.
    pub fn of(self, vehicle: &Vehicle, findings: &Findings) -> Option<f64> {
        match self {
            Self::Altitude => vehicle.altitude_m(),
            Self::Speed => vehicle.ground_speed_m_s().map(f64::from),
            Self::Battery => vehicle.battery()?.remaining_percent.map(f64::from),
            Self::Distance => vehicle.distance_home_m(),
            Self::Heading => vehicle.heading_deg().map(f64::from),
            Self::Satellites => vehicle.gps?.satellites.map(f64::from),
            Self::Reading => findings.readings.get(&vehicle.id).copied(),
            Self::Contacts => Some(findings.contacts as f64),
            Self::Alerts => Some(findings.alerts.len() as f64),
        }
    }
}

impl Relation {
    /// Whether the comparison holds for a figure and a bound.
    pub fn holds(self, figure: f64, value: f64) -> bool {
        match self {
            Self::Above => figure > value,
            Self::Below => figure < value,
            Self::AtLeast => figure >= value,
            Self::AtMost => figure <= value,
        }
    }
}

impl Until {
    /// Whether the condition concerns vehicles, so a script must name them; a time, the contacts
    /// and the alerts do not.
    pub(super) fn is_of_vehicles(&self) -> bool {
        !matches!(
            self,
            Self::Passed(_)
                | Self::Compared {
                    field: Field::Contacts | Field::Alerts,
                    ..
                }
        )
    }

    /// Whether the condition holds for a vehicle. A time never does.
    pub fn holds(&self, vehicle: &Vehicle, seen: Seen<'_>) -> bool {
        match self {
            Self::Passed(_) => false,
            Self::Situation(situation) => situation.holds(vehicle, seen),
            Self::Mode(name) => vehicle.mode().is_some_and(|mode| {
                let announced = vehicle.modes.named(name);
                mode.is(name)
                    || announced.is_some_and(|known| known.number == mode.number)
                    || name
                        .parse::<u32>()
                        .is_ok_and(|number| mode.number == number)
            }),
            Self::Compared {
                field,
                relation,
                value,
            } => field
                .of(vehicle, seen.findings)
                .is_some_and(|figure| relation.holds(figure, *value)),
        }
    }
}

/// Whether the vehicle has reached the target of its last movement order.
fn arrived(vehicle: &Vehicle, ledger: &Ledger) -> bool {
    let last = ledger.entries().rev().find_map(|entry| {
        let arrival = entry.verb.movement.arrival()?;
        let row = entry.rows.iter().find(|row| row.vehicle == vehicle.id)?;
        Some((arrival, row.state))
    });
    match last {
        Some((_, state)) if !state.is_final() => false,
        // Rovers, boats and planes return without a landing; the order itself is done when they are back.
        Some((Arrival::Landed, RowState::Done)) if returns_only(vehicle) => true,
        Some((Arrival::Landed, _)) => has_come_down(vehicle),
        Some((Arrival::Mode, RowState::Done)) => !comes_down(vehicle) || has_come_down(vehicle),
        Some((Arrival::Done, RowState::Done)) => true,
        // The order had nothing to do.
        Some((Arrival::Done, RowState::NoEffect)) if vehicle.target.is_none() => true,
        // The ledger did not observe the effect, or cannot, so standing still at the target counts.
        Some((Arrival::Done | Arrival::Mode | Arrival::AtTarget, _)) | None => {
            still_at_target(vehicle)
        }
    }
}

/// Whether the vehicle's mode ends on the ground.
fn comes_down(vehicle: &Vehicle) -> bool {
    vehicle.mode().is_some_and(Mode::comes_down)
}

/// Whether the vehicle runs `ArduPilot` and returns without a landing.
fn returns_only(vehicle: &Vehicle) -> bool {
    let class = vehicle.mode().map(|mode| mode.class);
    matches!(class, Some(VehicleClass::Plane | VehicleClass::Rover))
}

/// Whether the vehicle is on the ground; a rover or boat, whether it is back or disarmed.
fn has_come_down(vehicle: &Vehicle) -> bool {
    if vehicle.is_on_surface() {
        !vehicle.armed() || is_back(vehicle)
    } else {
        vehicle.is_on_the_ground()
    }
}

fn still_at_target(vehicle: &Vehicle) -> bool {
    let (Some(global), Some(target)) = (vehicle.global, vehicle.target) else {
        return false;
    };
    let is_on_surface = vehicle.is_on_surface();
    let near_m = if is_on_surface {
        stopped_m(vehicle)
    } else {
        ARRIVED_M
    };
    let near = target
        .at_point
        .is_some_and(|point| global.at_point.distance_m(point) <= near_m);
    let height_m = target.altitude_m.filter(|_| !is_on_surface);
    let level =
        height_m.is_none_or(|altitude_m| (global.altitude_m - altitude_m).abs() <= ARRIVED_M);
    near && level && global.ground_speed_m_s() < STILL_M_S
}
