//! Arming, disarming, finding the ground, and the rules for each.

mod checks;

use std::time::Duration;

pub(super) use checks::{ArmingChecks, ArmingRules, LOOK_STEPS};

/// A takeoff does not begin sooner after arming (ArduCopter's 2 s of delay, and until the loops have noticed).
const LIFTS_AFTER_ARMING: Duration = Duration::from_millis(2200);
/// Away from the ground's magnetism each core of the EKF aligns its yaw once more, once after each arming.
const ALIGNS_ABOVE_GROUND_M: f64 = 2.5;
/// A vehicle that rests this long with its motors idle has landed.
const LANDED_AFTER: Duration = Duration::from_secs(1);
/// In a landing the motors are disarmed this long after the touch.
const DISARMED_AFTER_TOUCH: Duration = Duration::from_millis(2100);

/// Armed, landed, and since when.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Safety {
    pub(super) armed: bool,
    /// The autopilot's belief; the body knows the truth.
    pub(super) landed: bool,
    /// When the motors were armed last; they take their time before they lift.
    pub(super) armed_at: Duration,
    /// Above this height (metres up from the start) the yaw is aligned in flight; `None` once that is done.
    aligns_above_m: Option<f64>,
    /// When the reasons against arming are told next without being asked.
    pub(super) reports_at: Duration,
    /// Whether nothing spoke against arming at the last look.
    pub(super) may_arm: bool,
    /// Since when the vehicle has stood on the ground with nothing to do.
    idle_since: Option<Duration>,
    resting_since: Option<Duration>,
}

impl Default for Safety {
    fn default() -> Self {
        Self {
            armed: false,
            landed: true,
            armed_at: Duration::ZERO,
            aligns_above_m: None,
            reports_at: checks::REPORT_EVERY,
            may_arm: false,
            idle_since: None,
            resting_since: None,
        }
    }
}

/// What a landing is found by.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct GroundInputs {
    /// Time since boot.
    pub(super) now: Duration,
    pub(super) on_ground: bool,
    /// When a landing touched the ground.
    pub(super) touched: Option<Duration>,
    /// Whether the vehicle is on the ground and its task has nothing to do there.
    pub(super) is_resting: bool,
    /// After how long an idle vehicle is disarmed; zero: never.
    pub(super) disarm_delay: Duration,
}

impl Safety {
    /// Armed just now, at a height in metres above the start.
    pub(super) fn armed(on_ground: bool, height_m: f64, now: Duration) -> Self {
        Self {
            armed: true,
            landed: on_ground,
            armed_at: now,
            aligns_above_m: Some(height_m + ALIGNS_ABOVE_GROUND_M),
            ..Self::default()
        }
    }

    /// The motors are stopped.
    pub(super) fn disarm(&mut self) {
        self.armed = false;
        self.aligns_above_m = None;
        // What now speaks against arming is told with the next look.
        self.reports_at = Duration::ZERO;
    }

    /// Whether a landing that touched the ground at a time is over: the motors are stopped.
    pub(super) fn ends_landing(touched: Duration, now: Duration) -> bool {
        now >= touched + DISARMED_AFTER_TOUCH
    }

    /// Notices landings and vehicles that stand about armed; whether the motors are to be stopped.
    pub(super) fn watch_ground(&mut self, inputs: &GroundInputs) -> bool {
        let now = inputs.now;
        if !self.armed {
            self.landed = inputs.on_ground;
            return false;
        }
        if let Some(touched) = inputs.touched {
            if now >= touched + LANDED_AFTER {
                self.landed = true;
            }
            return Self::ends_landing(touched, now);
        }
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

    /// Whether reasons against arming are told now, unasked; `is_free` if there are none.
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

    /// Whether the yaw is aligned now, at a height in metres above the start; once after each arming.
    pub(super) fn aligns_at(&mut self, height_m: f64) -> bool {
        self.aligns_above_m
            .take_if(|above_m| height_m > *above_m)
            .is_some()
    }

    /// When a takeoff that is commanded now begins.
    pub(super) fn takeoff_begins(&self, now: Duration) -> Duration {
        now.max(self.armed_at + LIFTS_AFTER_ARMING)
    }
}
