//! Arming, disarming, landing detection, and the rules for each.

mod checks;
mod consistency;
mod reason;
mod values;

use std::time::Duration;

pub(super) use checks::{ArmingChecks, ArmingRules, LOOK_STEPS};
pub(super) use consistency::ImuWatch;
pub(super) use reason::Reason;

/// The delay after arming during which the motors do not spin up.
const MOTORS_WAIT: Duration = Duration::from_secs(2);
/// The minimum time from arming to a takeoff (ArduCopter's 2 s of delay, and the loops' reaction).
const LIFTS_AFTER_ARMING: Duration = Duration::from_millis(2200);
/// The height, in metres, at which each core of the EKF aligns its yaw once more after each arming,
/// clear of magnetic disturbance.
const ALIGNS_ABOVE_GROUND_M: f64 = 2.5;
/// A vehicle that rests for this long with idle motors counts as landed.
const LANDED_AFTER: Duration = Duration::from_secs(1);
const DISARMED_AFTER_TOUCH: Duration = Duration::from_millis(2100);

/// How arming is requested.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum ArmingMethod {
    /// By a command of a ground station.
    Command,
    /// By a command that skips the optional checks.
    ForcedCommand,
    /// By a switch of the remote control.
    Switch,
    /// By the yaw stick.
    YawStick,
}

/// The state of arming and landing.
#[derive(Debug, Clone, PartialEq)]
#[expect(
    clippy::struct_excessive_bools,
    reason = "each is a fact of its own, and any may hold beside any other"
)]
pub(super) struct Safety {
    pub(super) armed: bool,
    /// Whether the autopilot considers the vehicle landed; the body has the true state.
    pub(super) landed: bool,
    /// Whether a switch has stopped the motors (`MotorEStop`).
    pub(super) emergency_stop: bool,
    /// Whether the switch of the motor interlock lets the motors turn.
    pub(super) interlock: bool,
    /// When the motors were last armed; they need time before they lift.
    pub(super) armed_at: Duration,
    /// The height (metres up from the start) above which the yaw is aligned in flight; `None` once done.
    aligns_above_m: Option<f64>,
    /// When the reasons not to arm will be reported next.
    pub(super) reports_at: Duration,
    /// Whether the last check found no reason not to arm.
    pub(super) may_arm: bool,
    idle_since: Option<Duration>,
    resting_since: Option<Duration>,
    /// Whether the vehicle stood on the ground when the landing under way began.
    stood: Option<bool>,
}

impl Default for Safety {
    fn default() -> Self {
        Self {
            armed: false,
            landed: true,
            emergency_stop: false,
            interlock: false,
            armed_at: Duration::ZERO,
            aligns_above_m: None,
            reports_at: checks::REPORT_EVERY,
            may_arm: false,
            idle_since: None,
            resting_since: None,
            stood: None,
        }
    }
}

/// The inputs of the landing detection.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct GroundInputs {
    pub(super) now: Duration,
    pub(super) on_ground: bool,
    /// When a landing touched the ground.
    pub(super) touched: Option<Duration>,
    /// Whether the vehicle is on the ground and its task has nothing more to do there.
    pub(super) is_resting: bool,
    /// The time after which an idle vehicle is disarmed; zero for never.
    pub(super) disarm_delay: Duration,
}

impl Safety {
    /// The state after arming, at a height in metres above the start.
    pub(super) fn armed(on_ground: bool, height_m: f64, now: Duration) -> Self {
        Self {
            armed: true,
            landed: on_ground,
            armed_at: now,
            aligns_above_m: Some(height_m + ALIGNS_ABOVE_GROUND_M),
            ..Self::default()
        }
    }

    pub(super) fn disarm(&mut self) {
        self.armed = false;
        self.aligns_above_m = None;
        // New reasons not to arm are reported with the next check.
        self.reports_at = Duration::ZERO;
    }

    /// Whether a landing that touched down at `touched` is over and the motors stop: at once without a flight, unless
    /// they have yet to spin up. A mission learns of it a step before they stop.
    pub(super) fn ends_landing(&self, touched: Duration, now: Duration) -> bool {
        let ends_at_once = self.stood == Some(true) && now > touched && now >= self.lifts_from();
        ends_at_once || now >= touched + DISARMED_AFTER_TOUCH
    }

    /// Detects landings, and armed vehicles that idle; returns whether to stop the motors.
    pub(super) fn watch_ground(&mut self, inputs: &GroundInputs) -> bool {
        let now = inputs.now;
        if !self.armed {
            self.landed = inputs.on_ground;
            return false;
        }
        if let Some(touched) = inputs.touched {
            self.stood.get_or_insert(self.landed);
            if now >= touched + LANDED_AFTER {
                self.landed = true;
            }
            return self.ends_landing(touched, now);
        }
        self.stood = None;
        if !inputs.is_resting {
            self.idle_since = None;
            self.resting_since = None;
            self.landed &= inputs.on_ground;
            return false;
        }
        let resting_since = *self.resting_since.get_or_insert(now);
        if now >= resting_since + LANDED_AFTER {
            self.landed = true;
        }
        let idle_since = *self.idle_since.get_or_insert(now);
        !inputs.disarm_delay.is_zero() && now >= idle_since + inputs.disarm_delay
    }

    /// Whether to report the reasons not to arm now; `is_free` means that there are none.
    pub(super) fn tells_obstacles(&mut self, is_free: bool, now: Duration) -> bool {
        let could_arm = std::mem::replace(&mut self.may_arm, is_free);
        if could_arm && !is_free && self.reports_at > now + checks::REPORT_SOON {
            self.reports_at -= checks::REPORT_EVERY.saturating_sub(checks::REPORT_SOON);
        }
        let due = now >= self.reports_at;
        if due {
            self.reports_at = now + checks::REPORT_EVERY;
        }
        due
    }

    /// Whether the yaw is still to be aligned in this flight.
    pub(super) fn awaits_alignment(&self) -> bool {
        self.aligns_above_m.is_some()
    }

    /// Whether to align the yaw now, at a height in metres above the start; once after each arming.
    pub(super) fn aligns_at(&mut self, height_m: f64) -> bool {
        self.aligns_above_m
            .take_if(|above_m| height_m > *above_m)
            .is_some()
    }

    /// The time from which a pilot's throttle spins the motors up.
    pub(super) fn lifts_from(&self) -> Duration {
        self.armed_at + MOTORS_WAIT
    }

    /// The start time of a takeoff commanded now.
    pub(super) fn takeoff_begins(&self, now: Duration) -> Duration {
        now.max(self.armed_at + LIFTS_AFTER_ARMING)
    }
}
