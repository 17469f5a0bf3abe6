//! The effect of a command in telemetry.

use std::time::Duration;

use super::modes::mode_named;
use super::nearness::{STILL_M_S, arrival_m, arrived, is_back, separation};
use super::setpoint::TravelEnd;
use crate::geo::{LatLon, wrap_180, wrap_360};
use crate::text;
use crate::text::Text;
use crate::vehicle::{Mode, PlanPhase, Target, Vehicle, VehicleClass};
use crate::wire::SystemId;

/// The least distance from a height at which it counts as reached.
const LEVEL_M: f64 = 1.0;
/// The same for a plane, whose height varies more.
const PLANE_LEVEL_M: f64 = 5.0;
/// A climb counts as done this far below its target height, because its last part is slow. A
/// setpoint given earlier would abort a takeoff.
const CLIMB_ENDS_M: f64 = 1.5;
/// The distance from which a vehicle's target is another one than that of its command.
const OTHER_TARGET_M: f64 = 5.0;
/// The tolerance of a turn.
const TURNED_DEG: f64 = 5.0;
/// The distance from the requested place within which home counts as set.
const HOME_M: f64 = 5.0;
/// How long a change of a state bit may take to appear: it becomes visible with the next heartbeat.
pub(super) const SOON: Duration = Duration::from_secs(3);

/// The effect to watch for after a command was accepted.
#[derive(Debug, Clone, PartialEq)]
pub struct Effect {
    watched: Watched,
    within: Duration,
}

#[derive(Debug, Clone, PartialEq)]
pub(super) enum Watched {
    Nothing,
    /// The plane has no airspeed sensor, so its speed shows nothing about the one that was asked for.
    UnmeasuredSpeed,
    Armed(bool),
    Mode(Mode),
    /// The vehicle is on the ground, landed by a mode.
    Landed(Mode),
    /// The vehicle is back, in a mode that returns but does not land.
    Returned(Mode),
    Still,
    Altitude {
        altitude_m: f64,
        tolerance_m: f64,
    },
    /// The vehicle has climbed at least this far above home, and PX4 has ended the takeoff by another mode.
    TakenOff {
        least_m: f64,
        takeoff: Mode,
    },
    Place(TravelEnd),
    Heading(f64),
    Velocity([f64; 3]),
    Home(LatLon),
    /// The vehicle has reached an item of its plan, or is past it.
    PlanItem(PlanAim),
    /// As [`Self::PlanItem`], and the vehicle flies its plan in AUTO without a pause.
    PlanFlown(PlanAim),
    Servo {
        output: u8,
        pulse_us: u16,
    },
    Rebooted {
        reboots: u32,
    },
    /// This station is in control, or none.
    Owner(Option<SystemId>),
}

/// An item at which a plan is to continue.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct PlanAim {
    item: u16,
    /// The current item before the command.
    before: u16,
    /// Whether a jump decides where the plan continues.
    jumps: bool,
}

impl PlanAim {
    pub fn new(vehicle: &Vehicle, item: u16) -> Self {
        let plan = vehicle.plans.plan.content.as_ref();
        Self {
            item,
            before: vehicle.plan.current,
            jumps: plan.is_some_and(|plan| plan.jumps_from(item)),
        }
    }

    /// Whether the plan has reached the item. Commands that do not navigate are passed at once, so
    /// a later item counts as well; after a step back, only if it precedes the item that was
    /// current before. If a jump decides, any other item counts.
    fn is_met(self, vehicle: &Vehicle) -> bool {
        let now = vehicle.plan.current;
        if self.jumps {
            now != self.before
        } else if self.item < self.before {
            (self.item..self.before).contains(&now)
        } else {
            now >= self.item
        }
    }
}

/// Whether the vehicle is on the ground in the mode that landed it. PX4 changes the mode when it disarms.
fn has_landed(vehicle: &Vehicle, mode: Mode) -> bool {
    let is_over = mode.class == VehicleClass::Px4 && !vehicle.armed();
    (is_over || vehicle.mode() == Some(mode)) && vehicle.is_on_the_ground()
}

/// Whether the vehicle is at least this high, and no longer in the mode of the takeoff.
fn has_taken_off(vehicle: &Vehicle, least_m: f64, takeoff: Mode) -> bool {
    let is_up = vehicle.altitude_m().is_some_and(|now| now >= least_m);
    is_up && vehicle.airborne() && vehicle.mode() != Some(takeoff)
}

/// Whether the vehicle flies its plan and neither pauses nor has reached the end.
fn is_flown(vehicle: &Vehicle) -> bool {
    let moves = match vehicle.plan.phase {
        Some(PlanPhase::Active) | None => true,
        Some(
            PlanPhase::NoPlan | PlanPhase::NotStarted | PlanPhase::Paused | PlanPhase::Complete,
        ) => false,
    };
    vehicle.flies_plan() && moves && !vehicle.has_paused()
}

impl Effect {
    /// Whether the telemetry shows the effect; `None` if there is nothing to watch beyond the
    /// acceptance.
    pub fn seen(&self, vehicle: &Vehicle) -> Option<bool> {
        Some(match &self.watched {
            Watched::Nothing | Watched::UnmeasuredSpeed => return None,
            Watched::Armed(armed) => vehicle.heartbeat.is_some_and(|beat| beat.armed == *armed),
            Watched::Mode(mode) => vehicle.mode() == Some(*mode),
            Watched::Landed(mode) => has_landed(vehicle, *mode),
            Watched::Returned(mode) => vehicle.mode() == Some(*mode) && is_back(vehicle),
            Watched::Still => speed_m_s(vehicle).is_some_and(|speed| speed < STILL_M_S),
            Watched::Altitude {
                altitude_m,
                tolerance_m,
            } => vehicle
                .altitude_m()
                .is_some_and(|now| (now - altitude_m).abs() <= *tolerance_m),
            Watched::TakenOff { least_m, takeoff } => has_taken_off(vehicle, *least_m, *takeoff),
            Watched::Place(place) => arrived(vehicle, *place),
            Watched::Heading(heading) => vehicle
                .heading_deg()
                .is_some_and(|now| wrap_180(f64::from(now) - heading).abs() <= TURNED_DEG),
            Watched::Velocity(wanted) => velocity_m_s(vehicle).is_some_and(|now| {
                let tolerance = (0.2 * length(*wanted)).max(STILL_M_S);
                length(difference(now, *wanted)) <= tolerance
            }),
            Watched::Home(place) => vehicle
                .home
                .is_some_and(|home| home.at_point.distance_m(*place) <= HOME_M),
            Watched::PlanItem(aim) => aim.is_met(vehicle),
            Watched::PlanFlown(aim) => aim.is_met(vehicle) && is_flown(vehicle),
            Watched::Servo { output, pulse_us } => {
                usize::from(*output)
                    .checked_sub(1)
                    .and_then(|index| vehicle.servos_us.get(index))
                    == Some(pulse_us)
            }
            Watched::Rebooted { reboots } => {
                vehicle.link.reboots > *reboots || vehicle.link.renumbered.is_some()
            }
            Watched::Owner(owner) => vehicle
                .control
                .is_some_and(|control| control.owner == *owner),
        })
    }

    /// Whether a vehicle's target is another place than the one that it was sent to.
    pub fn is_elsewhere(&self, vehicle: &Vehicle, target: &Target) -> bool {
        let Watched::Place(end) = self.watched else {
            return false;
        };
        let places = target.at_point.zip(end.point(vehicle));
        places.is_some_and(|(at, asked)| at.distance_m(asked) > OTHER_TARGET_M)
    }

    /// Whether a vehicle that is sent to a place stands still elsewhere.
    pub fn stays_behind(&self, vehicle: &Vehicle) -> bool {
        let Watched::Place(end) = self.watched else {
            return false;
        };
        let places = vehicle.global.zip(end.point(vehicle));
        places.is_some_and(|(now, asked)| {
            f64::from(now.speed_m_s()) < STILL_M_S
                && now.at_point.distance_m(asked) > OTHER_TARGET_M
        })
    }

    /// How long to wait for the effect after the acceptance.
    pub fn within(&self) -> Duration {
        self.within
    }

    /// What a user should know about a command that was carried out; `None` if that is nothing.
    pub fn remark(&self, vehicle: &Vehicle) -> Option<Text> {
        if self.watched == Watched::UnmeasuredSpeed {
            return Some(text!("outcome-unmeasured-speed"));
        }
        let is_reboot = matches!(self.watched, Watched::Rebooted { .. });
        let system = vehicle.link.renumbered.filter(|_| is_reboot)?;
        Some(text!("outcome-renumbered", system = system))
    }

    /// A description of the effect, such as "armed" or "within 1.5 m of the target".
    pub fn describe(&self, vehicle: &Vehicle) -> Text {
        match &self.watched {
            Watched::Nothing | Watched::UnmeasuredSpeed => text!("effect-nothing"),
            Watched::Armed(true) => text!("effect-armed"),
            Watched::Armed(false) => text!("effect-disarmed"),
            Watched::Mode(mode) => text!("effect-mode", mode = vehicle.name_of(*mode)),
            Watched::Landed(_) => text!("effect-landed"),
            Watched::Returned(_) => text!("effect-returned"),
            Watched::Still => text!("effect-still"),
            Watched::Altitude {
                altitude_m,
                tolerance_m,
            } => text!(
                "effect-altitude",
                metres = format!("{altitude_m:.1}"),
                tolerance = format!("{tolerance_m:.1}")
            ),
            Watched::TakenOff { least_m, .. } => {
                text!("effect-taken-off", metres = format!("{least_m:.1}"))
            }
            Watched::Place(_) => {
                let metres = (arrival_m(vehicle) * 10.0).round() / 10.0;
                text!("effect-place", metres = metres.to_string())
            }
            Watched::Heading(heading) => {
                text!("effect-heading", degrees = format!("{heading:.0}"))
            }
            Watched::Velocity(_) => text!("effect-velocity"),
            Watched::Home(_) => text!("effect-home"),
            Watched::PlanItem(aim) => text!("effect-plan-item", item = aim.item),
            Watched::PlanFlown(aim) => text!("effect-plan-flown", item = aim.item),
            Watched::Servo { output, pulse_us } => {
                text!("effect-servo", output = *output, pulse = *pulse_us)
            }
            Watched::Rebooted { .. } => text!("effect-rebooted"),
            Watched::Owner(Some(_)) => text!("effect-control"),
            Watched::Owner(None) => text!("effect-no-control"),
        }
    }

    pub(super) fn new(watched: Watched, within: Duration) -> Self {
        Self { watched, within }
    }

    pub(super) fn nothing() -> Self {
        Self::new(Watched::Nothing, Duration::ZERO)
    }
}

pub(super) fn mode_effect(before: &Vehicle, name: &str) -> Effect {
    match mode_named(before, name) {
        Some(mode) => Effect::new(Watched::Mode(mode), SOON),
        None => Effect::nothing(),
    }
}

/// The effect of a mode in which a multirotor lands, and other vehicles with `ArduPilot` return. For all others, only the
/// change of mode is checked.
pub(super) fn landing_effect(before: &Vehicle, name: &str) -> Effect {
    match mode_named(before, name) {
        Some(mode) if is_copter(before, mode) => {
            let way_m = before.distance_home_m().unwrap_or(0.0);
            let height_m = before.altitude_m().unwrap_or(0.0).max(0.0);
            let time = patience(way_m / 1.5 + height_m / 0.3 + 180.0);
            Effect::new(Watched::Landed(mode), time)
        }
        Some(mode) if returns(mode) => {
            let way_m = before.distance_home_m().unwrap_or(0.0);
            Effect::new(Watched::Returned(mode), patience(way_m / 0.5 + 60.0))
        }
        _ => mode_effect(before, name),
    }
}

/// Whether a vehicle in this mode returns without a landing.
fn returns(mode: Mode) -> bool {
    mode.is("RTL") && matches!(mode.class, VehicleClass::Plane | VehicleClass::Rover)
}

/// Whether a vehicle in this mode is a multirotor.
fn is_copter(vehicle: &Vehicle, mode: Mode) -> bool {
    let class = vehicle.heartbeat.map(|heartbeat| heartbeat.class);
    match mode.class {
        VehicleClass::Px4 => class == Some(VehicleClass::Copter),
        class => class == VehicleClass::Copter,
    }
}

/// The effect of a takeoff. PX4 ends it in another mode, by default AUTO.LOITER, and does not descend to a height below
/// the vehicle.
pub(super) fn takeoff_effect(before: &Vehicle, altitude_m: f64) -> Effect {
    let climb = altitude_effect(before, altitude_m, 0.05);
    let takeoff = before
        .mode()
        .filter(|mode| mode.class == VehicleClass::Px4)
        .and_then(|mode| mode.class.mode("AUTO.TAKEOFF"));
    match (takeoff, &climb.watched) {
        (Some(takeoff), Watched::Altitude { tolerance_m, .. }) => {
            let least_m = altitude_m - tolerance_m;
            Effect::new(Watched::TakenOff { least_m, takeoff }, climb.within)
        }
        _ => climb,
    }
}

/// The effect of reaching a height within a tolerance: a share of the height, limited to 1 to 1.5 m
/// (for a plane, 5 m) and to half the height, so that the ground does not count as reached. The time limit assumes 0.5
/// m/s.
pub(super) fn altitude_effect(before: &Vehicle, altitude_m: f64, share: f64) -> Effect {
    let way_m = (altitude_m - before.altitude_m().unwrap_or(0.0)).abs();
    let tolerance_m = if before.class() == VehicleClass::Plane {
        PLANE_LEVEL_M
    } else {
        (share * altitude_m).clamp(LEVEL_M, CLIMB_ENDS_M)
    };
    let tolerance_m = tolerance_m.min(0.5 * altitude_m);
    Effect::new(
        Watched::Altitude {
            altitude_m,
            tolerance_m,
        },
        patience(way_m / 0.5 + 20.0),
    )
}

pub(super) fn yaw_effect(
    before: &Vehicle,
    angle_deg: f64,
    relative: bool,
    rate: Option<f64>,
) -> Effect {
    let Some(now) = before.heading_deg().map(f64::from) else {
        return Effect::nothing();
    };
    let target = if relative { now + angle_deg } else { angle_deg };
    let way_deg = if relative { angle_deg.abs() } else { 180.0 };
    let rate_deg_s = rate.filter(|rate| *rate > 0.0).unwrap_or(30.0);
    Effect::new(
        Watched::Heading(wrap_360(target)),
        patience(way_deg / rate_deg_s + 5.0),
    )
}

/// The time limit of a flight to a place: assumes a speed below the usual one, and adds time to
/// accelerate and to settle.
pub(super) fn travel_time(before: &Vehicle, place: TravelEnd) -> Duration {
    match separation(before, place) {
        Some((horizontal_m, vertical_m)) => patience(horizontal_m / 1.5 + vertical_m / 0.5 + 20.0),
        None => Duration::from_secs(120),
    }
}

/// A duration from any number of seconds, limited to a day.
fn patience(seconds: f64) -> Duration {
    Duration::try_from_secs_f64(seconds.clamp(0.0, 86_400.0)).unwrap_or(SOON)
}

fn velocity_m_s(vehicle: &Vehicle) -> Option<[f64; 3]> {
    match (vehicle.local, vehicle.global) {
        (Some(local), _) => Some(local.velocity_m_s.map(f64::from)),
        (None, Some(global)) => {
            Some([global.north_m_s, global.east_m_s, global.down_m_s].map(f64::from))
        }
        (None, None) => None,
    }
}

fn speed_m_s(vehicle: &Vehicle) -> Option<f64> {
    velocity_m_s(vehicle).map(length)
}

fn difference(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn length(v: [f64; 3]) -> f64 {
    v.iter().map(|x| x * x).sum::<f64>().sqrt()
}
