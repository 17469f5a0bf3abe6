//! Loss of control: `ArduCopter`'s crash check and its check for lost thrust.

use glam::DVec3;
use mavlink::dialects::ardupilotmega::MavSeverity;

use super::body::Body;
use super::kinematics::{GRAVITY_M_S2, STEP_S};
use super::mode::ModeId;
use super::reaction::Reaction;
use sortie_geo::maths;

/// Crash detection: the minimum lean error and lean, the maximum speed and acceleration, and the time.
const CRASH_ERROR_DEG: f64 = 30.0;
const CRASH_LEAN_DEG: f64 = 15.0;
const CRASH_SPEED_M_S: f64 = 10.0;
const CRASH_ACCEL_M_S2: f64 = 3.0;
const CRASH_STEPS: u32 = 200;
/// Thrust loss detection: the greatest demanded lean while sinking at full throttle, and the time.
const LOSS_LEAN_DEG: f64 = 15.0;
const LOSS_THROTTLE: f64 = 0.9;
const LOSS_STEPS: u32 = 100;
/// The motor reported as failing, counted from 1. With equal loads it is random; the real vehicle reported the second.
const SOME_MOTOR: usize = 2;
/// The minimum time between two reports of a touchdown, in steps.
const CONTACT_STEPS: u32 = 100;
/// The share of a new value in the filtered acceleration in each step: a filter of 1 Hz.
const ACCEL_BLEND: f64 = STEP_S / (STEP_S + 1.0 / std::f64::consts::TAU);

/// The state of the checks.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct CrashWatch {
    accel_m_s2: DVec3,
    crashing_steps: u32,
    losing_steps: u32,
    loss_told: bool,
    since_contact: Option<u32>,
}

/// The inputs of the checks.
pub(super) struct CrashInputs<'a> {
    pub(super) body: &'a Body,
    /// Whether the vehicle is armed and has not landed.
    pub(super) is_flying: bool,
    /// Whether `FS_CRASH_CHECK` is set.
    pub(super) checks_crash: bool,
    pub(super) mode: ModeId,
}

impl CrashWatch {
    /// Checks for a crash and for thrust loss.
    #[inline]
    pub(super) fn step(&mut self, inputs: &CrashInputs<'_>) -> Vec<Reaction> {
        if let Some(steps) = self.since_contact {
            self.since_contact = (steps < CONTACT_STEPS).then_some(steps + 1);
        }
        if !inputs.is_flying {
            self.crashing_steps = 0;
            self.losing_steps = 0;
            self.loss_told = false;
            return Vec::new();
        }
        let may_lose_thrust = inputs.body.saturated || self.losing_steps > 0;
        if inputs.body.upset.is_none() && !may_lose_thrust {
            return Vec::new();
        }
        self.watch(inputs, may_lose_thrust)
    }

    fn watch(&mut self, inputs: &CrashInputs<'_>, may_lose_thrust: bool) -> Vec<Reaction> {
        let mut reactions = Vec::new();
        if inputs.body.upset.is_some() {
            reactions.extend(self.watch_attitude(inputs).into_iter().flatten());
        }
        if may_lose_thrust {
            reactions.extend(self.watch_thrust(inputs.body).into_iter().flatten());
        }
        reactions
    }

    /// Reports a touchdown at a speed in m/s; `None` if one was reported shortly before.
    pub(super) fn touch(&mut self, impact_m_s: f64) -> Option<Reaction> {
        if self.since_contact.is_some() {
            return None;
        }
        self.since_contact = Some(0);
        let text = format!("SIM Hit ground at {impact_m_s:.3} m/s");
        Some(Reaction::Say(MavSeverity::MAV_SEVERITY_INFO, text))
    }

    fn watch_attitude(&mut self, inputs: &CrashInputs<'_>) -> Option<[Reaction; 2]> {
        let body = inputs.body;
        self.accel_m_s2 += (body.accel_m_s2 - self.accel_m_s2) * ACCEL_BLEND;
        let accel = self.accel_m_s2.length();
        let error_deg = body.lean_error_rad().to_degrees();
        let (roll, pitch) = body.roll_pitch_rad();
        let lean_deg =
            maths::acos((maths::cos(roll) * maths::cos(pitch)).clamp(-1.0, 1.0)).to_degrees();
        let crashing = inputs.checks_crash
            && inputs.mode != ModeId::Acro
            && accel < CRASH_ACCEL_M_S2
            && lean_deg > CRASH_LEAN_DEG
            && error_deg > CRASH_ERROR_DEG
            && body.velocity_m_s.length() < CRASH_SPEED_M_S;
        if !crashing {
            self.crashing_steps = 0;
            return None;
        }
        self.crashing_steps += 1;
        if self.crashing_steps < CRASH_STEPS {
            return None;
        }
        self.crashing_steps = 0;
        let text = format!(
            "Crash: Disarming: AngErr={error_deg:.0}>{CRASH_ERROR_DEG:.0}, \
             Accel={accel:.1}<{CRASH_ACCEL_M_S2:.1}"
        );
        Some([
            Reaction::Say(MavSeverity::MAV_SEVERITY_EMERGENCY, text),
            Reaction::Disarm,
        ])
    }

    fn watch_thrust(&mut self, body: &Body) -> Option<[Reaction; 2]> {
        let asked = body.lean_m_s2.length() / GRAVITY_M_S2;
        let losing = (body.saturated || body.throttle >= LOSS_THROTTLE)
            && asked < maths::tan(LOSS_LEAN_DEG.to_radians())
            && body.velocity_m_s.z > 0.0
            && body.lean_error_rad() < CRASH_ERROR_DEG.to_radians()
            && !self.loss_told;
        if !losing {
            self.losing_steps = 0;
            return None;
        }
        self.losing_steps += 1;
        if self.losing_steps < LOSS_STEPS {
            return None;
        }
        self.losing_steps = 0;
        // Reported once per flight, because the thrust boost of the real vehicle stays on from here.
        self.loss_told = true;
        let upset = body.upset.as_ref();
        let motor = upset.map_or(SOME_MOTOR, |upset| upset.mixer.lost + 1);
        let text = format!("Potential Thrust Loss ({motor})");
        Some([
            Reaction::BoostThrust,
            Reaction::Say(MavSeverity::MAV_SEVERITY_EMERGENCY, text),
        ])
    }
}
