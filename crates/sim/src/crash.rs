//! What the autopilot makes of a flight that it has lost: `ArduCopter`'s crash check and its check for lost thrust.

use glam::DVec3;
use mavlink::dialects::ardupilotmega::MavSeverity;

use super::autopilot::Autopilot;
use super::kinematics::STEP_S;
use super::mode;

/// A crash: more than this far off the wanted lean and leaning, slow and hardly accelerating, for so long.
const CRASH_ERROR_DEG: f64 = 30.0;
const CRASH_LEAN_DEG: f64 = 15.0;
const CRASH_SPEED_M_S: f64 = 10.0;
const CRASH_ACCEL_M_S2: f64 = 3.0;
const CRASH_STEPS: u32 = 200;
/// Lost thrust: sinking at full throttle with no lean beyond this asked for, for so long.
const LOSS_LEAN_DEG: f64 = 15.0;
const LOSS_THROTTLE: f64 = 0.9;
const LOSS_STEPS: u32 = 100;
/// Which motor works hardest is noise while all do the same; the real vehicle was heard to name the second.
const SOME_MOTOR: usize = 2;
/// After a touch the ground is not mentioned again for so long.
const CONTACT_STEPS: u32 = 100;
/// The acceleration is filtered at 1 Hz.
const ACCEL_BLEND: f64 = STEP_S / (STEP_S + 1.0 / std::f64::consts::TAU);

/// What has been seen so far.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct CrashWatch {
    accel_m_s2: DVec3,
    crashing_steps: u32,
    losing_steps: u32,
    loss_told: bool,
    since_contact: Option<u32>,
}

impl Autopilot {
    /// Looks for a crash and for lost thrust.
    pub(super) fn watch_crash(&mut self) {
        if let Some(steps) = self.crash.since_contact {
            self.crash.since_contact = (steps < CONTACT_STEPS).then_some(steps + 1);
        }
        if !self.safety.armed || self.safety.landed {
            self.crash.crashing_steps = 0;
            self.crash.losing_steps = 0;
            self.crash.loss_told = false;
            return;
        }
        if self.body.upset.is_some() {
            self.watch_attitude();
        }
        if self.body.saturated || self.crash.losing_steps > 0 {
            self.watch_thrust();
        }
    }

    /// The ground was touched at a speed.
    pub(super) fn report_impact(&mut self, impact_m_s: f64) {
        if self.crash.since_contact.is_none() {
            let text = format!("SIM Hit ground at {impact_m_s:.3} m/s");
            self.say(MavSeverity::MAV_SEVERITY_INFO, &text);
            self.crash.since_contact = Some(0);
        }
    }

    fn watch_attitude(&mut self) {
        let change = self.body.accel_m_s2 - self.crash.accel_m_s2;
        self.crash.accel_m_s2 += change * ACCEL_BLEND;
        let accel = self.crash.accel_m_s2.length();
        let error_deg = self.body.lean_error_rad().to_degrees();
        let (roll, pitch) = self.body.roll_pitch_rad();
        let lean_deg = (roll.cos() * pitch.cos())
            .clamp(-1.0, 1.0)
            .acos()
            .to_degrees();
        let crashing = self.tuning.crash_check
            && self.mode.number != mode::ACRO
            && accel < CRASH_ACCEL_M_S2
            && lean_deg > CRASH_LEAN_DEG
            && error_deg > CRASH_ERROR_DEG
            && self.body.velocity_m_s.length() < CRASH_SPEED_M_S;
        if !crashing {
            self.crash.crashing_steps = 0;
            return;
        }
        self.crash.crashing_steps += 1;
        if self.crash.crashing_steps >= CRASH_STEPS {
            self.crash.crashing_steps = 0;
            let text = format!(
                "Crash: Disarming: AngErr={error_deg:.0}>{CRASH_ERROR_DEG:.0}, \
                 Accel={accel:.1}<{CRASH_ACCEL_M_S2:.1}"
            );
            self.say(MavSeverity::MAV_SEVERITY_EMERGENCY, &text);
            self.disarm();
        }
    }

    fn watch_thrust(&mut self) {
        let body = &self.body;
        let asked = body.lean_m_s2.length() / super::kinematics::GRAVITY_M_S2;
        let losing = (body.saturated || body.throttle >= LOSS_THROTTLE)
            && asked < LOSS_LEAN_DEG.to_radians().tan()
            && body.velocity_m_s.z > 0.0
            && body.lean_error_rad() < CRASH_ERROR_DEG.to_radians()
            && !self.crash.loss_told;
        if !losing {
            self.crash.losing_steps = 0;
            return;
        }
        self.crash.losing_steps += 1;
        if self.crash.losing_steps < LOSS_STEPS {
            return;
        }
        self.crash.losing_steps = 0;
        // Told once a flight: on the real vehicle the thrust boost stays on from here.
        self.crash.loss_told = true;
        let motor = match &mut self.body.upset {
            Some(upset) => {
                upset.mixer.boost = true;
                upset.mixer.lost + 1
            }
            None => SOME_MOTOR,
        };
        let text = format!("Potential Thrust Loss ({motor})");
        self.say(MavSeverity::MAV_SEVERITY_EMERGENCY, &text);
    }
}
