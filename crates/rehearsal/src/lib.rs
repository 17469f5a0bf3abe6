//! Plans of several vehicles, flown in the embedded simulator before any vehicle leaves the ground: how long each
//! takes, what is left of its battery, and how close the vehicles come to each other.
//!
//! A rehearsal is a pure function of the documents and the conditions: no clock, no threads, no files.
//!
//! # How the parts fit
//! - The flight: `stage` flies all vehicles in one world, `flight` records one of them, `place` has their starts and
//!   tracks.
//! - How close they come: `approach`; whether they stay apart if one is late: `late`.
//! - What keeps them apart: `deconflict` finds later starts or separate heights, `order` the best order for that.

#![warn(missing_docs)]

mod approach;
mod deconflict;
mod flight;
mod late;
mod order;
mod place;
mod stage;

use std::sync::Arc;

use sortie_plan::{Document, ListKind};
use sortie_sim::{Airframe, Start};

pub use approach::{Approach, Separation, SeparationLimits, TOO_NEAR_M, TOO_NEAR_VERTICALLY_M};
pub use deconflict::{Proposal, Remedy, deconflict};
pub use late::LATE_S;

/// A vehicle and its plan.
#[derive(Debug, Clone, Default)]
pub struct Participant {
    /// The lists on board.
    pub document: Document,
    /// The airframe; `None` for the standard quadcopter.
    pub airframe: Option<Arc<Airframe>>,
    /// The time at which the vehicle's motors start, in seconds.
    pub delay_s: f64,
    /// The charge of the battery at the start, in percent; `None` for a full battery.
    pub charge_percent: Option<f64>,
    /// Parameters of this vehicle alone; those that the simulator does not have are left out.
    pub parameters: Vec<(String, f32)>,
    /// The fence as switched on or off by a command; `None` if `FENCE_ENABLE` applies. Only a
    /// command switches on the lower limit (`FENCE_ALT_MIN`).
    pub fence_switch: Option<bool>,
}

/// The conditions that are the same for all vehicles.
#[derive(Debug, Clone, PartialEq)]
pub struct Conditions {
    /// The home for documents without one.
    pub home: Option<Start>,
    /// The mean wind in m/s.
    pub wind_m_s: f32,
    /// The direction from which the wind blows, in degrees clockwise from north.
    pub wind_from_deg: f32,
    /// The strength of the gusts, as in `SIM_WIND_TURB`.
    pub turbulence: f32,
    /// The seed of the gusts.
    pub seed: u64,
    /// Parameters that differ from their defaults, for all vehicles.
    pub parameters: Vec<(String, f32)>,
    /// The maximum duration of a flight, in seconds.
    pub limit_s: f64,
}

impl Default for Conditions {
    /// Calm air, and at most an hour.
    fn default() -> Self {
        Self {
            home: None,
            wind_m_s: 0.0,
            wind_from_deg: 0.0,
            turbulence: 0.0,
            seed: 1,
            parameters: Vec::new(),
            limit_s: 3600.0,
        }
    }
}

/// Why plans cannot be rehearsed. Vehicles are counted from 0.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum RehearsalError {
    /// A document without a plan.
    #[error("vehicle {0} has no plan")]
    NoPlan(usize),
    /// Neither the document nor the conditions contain a home.
    #[error("vehicle {0} has no home")]
    NoHome(usize),
    /// The vehicle refuses a list.
    #[error("vehicle {0} refuses its {1:?} list")]
    Refused(usize, ListKind),
    /// A parameter that the vehicle does not have, or an invalid value.
    #[error("no parameter {0}")]
    NoParameter(String),
}

/// How a flight ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FlightEnding {
    /// The vehicle landed and stopped its motors.
    Landed,
    /// The plan ended in the air.
    InAir,
    /// The vehicle left its plan for another mode, such as RTL, because of a failsafe: the mode's number.
    LeftPlan(u8),
    /// The vehicle never left the ground.
    Grounded,
    /// The vehicle collided with another one; both have this ending.
    Crashed,
    /// The vehicle touched the ground on the way to this item, which is not a landing; items are counted from 1.
    HitGround(u16),
    /// The vehicle was still flying when the time was up.
    TimeUp,
}

/// The outcome for one vehicle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Flown {
    /// The time from the start of the vehicle's motors to the end of the flight, in seconds.
    pub time_s: f64,
    /// The charge that the flight used, in percent of the battery's capacity; at most 100.
    pub energy_used_percent: f64,
    /// The greatest distance from home over the ground, in metres.
    pub farthest_m: f64,
    /// When the vehicle first breached its fence, in seconds of its flight. `ArduCopter`'s rules apply to a fence that
    /// is switched on (`FENCE_TYPE`, the areas, the circle around home, the heights); otherwise, the areas of its list
    /// count.
    pub broke_fence_s: Option<f64>,
    /// Whether the vehicle has a fence that is switched on, or areas in its list.
    pub has_fence: bool,
    /// Whether `DISARM_DELAY` was set to 0 because the plan begins with a wait on the ground.
    pub was_kept_armed: bool,
    /// The way in which the flight ended.
    pub ending: FlightEnding,
    /// How far east of its home the vehicle started, in metres, because another vehicle stood there.
    pub moved_east_m: f64,
}

impl Flown {
    /// Whether the vehicle flew its plan to the end, inside its fence.
    pub fn is_as_planned(&self) -> bool {
        let is_at_end = match self.ending {
            FlightEnding::Landed => true,
            FlightEnding::InAir
            | FlightEnding::HitGround(_)
            | FlightEnding::LeftPlan(_)
            | FlightEnding::Grounded
            | FlightEnding::Crashed
            | FlightEnding::TimeUp => false,
        };
        is_at_end && self.broke_fence_s.is_none()
    }
}

/// The outcome of a rehearsal.
#[derive(Debug, Clone, PartialEq)]
pub struct Outcome {
    /// The vehicles, in the order of the participants.
    pub vehicles: Vec<Flown>,
    /// The closest approach of each pair that was in the air together; the closest pair first.
    pub closest: Vec<Approach>,
    /// The simulated time, in seconds.
    pub simulated_s: f64,
    tracks: Vec<place::Track>,
}

impl Outcome {
    /// Whether all pairs stay apart, even if one vehicle is up to `late_s` seconds late; `late_s` is at most
    /// [`LATE_S`].
    pub fn is_apart(&self, late_s: u32) -> bool {
        self.closest
            .iter()
            .all(|approach| approach.is_apart(late_s))
    }

    /// Whether every vehicle flew as planned and no pair came into conflict.
    pub fn is_as_planned(&self) -> bool {
        self.vehicles.iter().all(Flown::is_as_planned) && self.conflicts().next().is_none()
    }

    /// The pairs that came too close to each other.
    pub fn conflicts(&self) -> impl Iterator<Item = &Approach> {
        self.closest
            .iter()
            .filter(|approach| approach.is_conflict())
    }

    /// The conflicts of one vehicle, by its number among the participants.
    pub fn conflicts_of(&self, vehicle: usize) -> impl Iterator<Item = &Approach> {
        self.conflicts()
            .filter(move |approach| [approach.a, approach.b].contains(&vehicle))
    }
}

/// Flies all plans at once.
///
/// # Errors
/// See [`RehearsalError`].
pub fn rehearse(
    participants: &[Participant],
    conditions: &Conditions,
) -> Result<Outcome, RehearsalError> {
    let places = place::places(participants, conditions)?;
    let origin = place::origin(&places);
    Ok(stage::Stage::new(participants, &places, origin, conditions)?.run())
}

/// Telemetry of one vehicle in a rehearsal: everything that it sends to its ground station.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Heard<'a> {
    /// The time since the start of the rehearsal, in seconds.
    pub at_s: f64,
    /// The vehicle, counted from 0; its system id is one higher.
    pub vehicle: usize,
    /// One or more complete MAVLink frames.
    pub bytes: &'a [u8],
}

/// Flies all plans at once, and hands over the telemetry of the vehicles in chronological order.
///
/// # Errors
/// See [`RehearsalError`].
pub fn rehearse_heard(
    participants: &[Participant],
    conditions: &Conditions,
    listener: &mut dyn FnMut(Heard<'_>),
) -> Result<Outcome, RehearsalError> {
    let places = place::places(participants, conditions)?;
    let origin = place::origin(&places);
    let stage = stage::Stage::new(participants, &places, origin, conditions)?;
    Ok(stage.run_heard(Some(listener)))
}

#[cfg(test)]
mod tests;
