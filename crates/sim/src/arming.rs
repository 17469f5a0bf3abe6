//! Arming, disarming, finding the ground, and the rules for each.

mod checks;

use std::time::Duration;

use mavlink::dialects::ardupilotmega::MavSeverity;

use super::autopilot::Autopilot;
use super::mode;
use super::place::Place;
use super::task::Task;
use super::telemetry;

pub(super) use checks::ArmingRules;

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
    pub(super) aligns_above_m: Option<f64>,
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

impl Safety {
    /// When a takeoff that is commanded now begins.
    pub(super) fn takeoff_begins(&self, now: Duration) -> Duration {
        now.max(self.armed_at + LIFTS_AFTER_ARMING)
    }
}

impl Autopilot {
    /// Arms, or says why not. Forced, only the checks that cannot be switched off count.
    pub(super) fn arm(&mut self, forced: bool) -> bool {
        if self.safety.armed {
            return true;
        }
        let mandatory = if forced {
            self.mandatory_obstacles()
        } else {
            Vec::new()
        };
        if !forced || !mandatory.is_empty() {
            self.refuse("Arm", &mandatory);
            let mut reasons = self.arming_obstacles();
            if reasons.is_empty() {
                reasons = self.last_obstacles();
            }
            if !reasons.is_empty() {
                self.refuse("Arm", &reasons);
                return false;
            }
            let may_arm = self.mode.number == mode::AUTO && self.tuning.flight.auto.may_arm;
            if !self.mode.armable && !may_arm {
                let text = format!("Arm: {} mode not armable", self.mode.name);
                self.say(MavSeverity::MAV_SEVERITY_CRITICAL, &text);
                return false;
            }
        }
        self.start_motors(forced);
        true
    }

    fn start_motors(&mut self, forced: bool) {
        self.safety = Safety {
            armed: true,
            landed: self.body.on_ground,
            armed_at: self.uptime(),
            aligns_above_m: Some(self.believed().height_m() + ALIGNS_ABOVE_GROUND_M),
            ..Safety::default()
        };
        self.begin_trail(self.is_ready());
        if self.datum.home.is_some() {
            self.set_home(self.here());
        }
        if !forced && self.tuning.arming.is_off() {
            self.say(
                MavSeverity::MAV_SEVERITY_WARNING,
                "Warning: Arming Checks Disabled",
            );
        }
        self.say(MavSeverity::MAV_SEVERITY_INFO, "Arming motors");
        self.control.take_over(self.estimator.belief(&self.body));
        self.yaw.settle(self.body.yaw_deg);
        if self.body.on_ground {
            self.wait_on_ground();
        }
    }

    /// Disarms, in the air too.
    pub(super) fn disarm(&mut self) {
        if !self.safety.armed {
            return;
        }
        self.safety.armed = false;
        self.safety.aligns_above_m = None;
        // What now speaks against arming is told with the next look.
        self.safety.reports_at = Duration::ZERO;
        self.say(MavSeverity::MAV_SEVERITY_INFO, "Disarming motors");
        self.mission.reset();
        if self.body.on_ground {
            self.safety.landed = true;
            self.body.throttle = 0.0;
            self.wait_on_ground();
        }
    }

    /// Whether a landing has come to the point where the motors are disarmed.
    pub(super) fn landing_is_over(&self) -> bool {
        self.touched_in_landing()
            .is_some_and(|touched| self.uptime() >= touched + DISARMED_AFTER_TOUCH)
    }

    /// Makes a place home and tells everybody.
    pub(super) fn set_home(&mut self, home: Place) {
        self.datum.home = Some(home);
        self.outbox.extend(telemetry::message(49, self));
        self.outbox.extend(telemetry::message(242, self));
    }

    /// Makes the present place home: what `SMART_RTL` goes back to as well.
    pub(super) fn set_home_here(&mut self) {
        self.set_home(self.here());
        self.begin_trail(true);
    }

    /// Notices landings and vehicles that stand about armed.
    pub(super) fn watch_ground(&mut self) {
        let now = self.uptime();
        if !self.safety.armed {
            self.safety.landed = self.body.on_ground;
            return;
        }
        if let Some(touched) = self.touched_in_landing() {
            if now >= touched + LANDED_AFTER {
                self.safety.landed = true;
            }
            if now >= touched + DISARMED_AFTER_TOUCH {
                self.disarm();
            }
            return;
        }
        let resting = self.body.on_ground && self.is_resting();
        if !resting {
            self.safety.idle_since = None;
            self.safety.resting_since = None;
            self.safety.landed &= self.body.on_ground;
            return;
        }
        let resting_since = *self.safety.resting_since.get_or_insert(now);
        if now >= resting_since + LANDED_AFTER {
            self.safety.landed = true;
        }
        let idle_since = *self.safety.idle_since.get_or_insert(now);
        let delay = self.tuning.disarm_delay;
        if !delay.is_zero() && now >= idle_since + delay {
            self.disarm();
        }
    }

    /// Tells of the alignment of the yaw in the air.
    pub(super) fn watch_alignment(&mut self) {
        let height_m = self.believed().height_m();
        let due = self
            .safety
            .aligns_above_m
            .is_some_and(|above_m| height_m > above_m);
        let Some(compass) = self.estimator.compass_in_use().filter(|_| due) else {
            return;
        };
        self.safety.aligns_above_m = None;
        for core in 0..2 {
            let text = format!("EKF3 IMU{core} MAG{compass} in-flight yaw alignment complete");
            self.say(MavSeverity::MAV_SEVERITY_INFO, &text);
        }
    }

    /// The task of a mode for a vehicle that stands on the ground.
    fn wait_on_ground(&mut self) {
        self.task = match self.mode.number {
            mode::STABILIZE | mode::ACRO | mode::DRIFT => Task::Manual,
            mode::GUIDED | mode::GUIDED_NOGPS | mode::AUTO | mode::BRAKE | mode::CIRCLE => {
                Task::Wait
            }
            mode::RTL | mode::SMART_RTL | mode::LAND => self.task.clone(),
            _ => Task::Piloted,
        };
    }

    fn touched_in_landing(&self) -> Option<Duration> {
        match &self.task {
            Task::Land(landing) => landing.touched,
            Task::Return(returning) => returning.landing().and_then(|landing| landing.touched),
            _ => None,
        }
    }

    fn is_resting(&self) -> bool {
        match &self.task {
            Task::Wait | Task::Route(_) => true,
            Task::Manual | Task::Piloted => self.sticks().throttle_is_low(),
            _ => false,
        }
    }
}
