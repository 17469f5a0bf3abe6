//! What a failsafe does: numbers as in the `BATT_FS_*_ACT` and `FS_DR_ENABLE` parameters.

use std::time::Duration;

use mavlink::dialects::ardupilotmega::MavSeverity;

use super::Options;
use crate::autopilot::Autopilot;
use crate::mode;
use crate::task::Task;

/// A landing that a failsafe begins waits this long before it descends.
const PAUSE: Duration = Duration::from_secs(4);

/// `ArduCopter`'s `FailsafeAction`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Action {
    Nothing,
    Land,
    Return,
    PathBackOrReturn,
    PathBackOrLand,
    Terminate,
    PlannedLanding,
    BrakeOrLand,
}

impl Action {
    /// The action of a battery parameter's value; unknown numbers do nothing.
    pub(super) fn numbered(number: i32) -> Self {
        match number {
            1 => Self::Land,
            2 => Self::Return,
            3 => Self::PathBackOrReturn,
            4 => Self::PathBackOrLand,
            5 => Self::Terminate,
            6 => Self::PlannedLanding,
            7 => Self::BrakeOrLand,
            _ => Self::Nothing,
        }
    }

    /// How urgent it is: 0 is the most urgent. The battery's second level must not undo the first's.
    pub(super) fn priority(self) -> u8 {
        match self {
            Self::Terminate => 0,
            Self::Land => 1,
            Self::Return => 2,
            Self::PathBackOrLand => 3,
            Self::PathBackOrReturn => 4,
            Self::Nothing => 5,
            Self::PlannedLanding | Self::BrakeOrLand => 6,
        }
    }
}

impl Autopilot {
    pub(super) fn carry_out(&mut self, action: Action) {
        match action {
            Action::Nothing => {}
            Action::Land => self.land_after_pause(),
            Action::Return => self.return_or_land(),
            Action::PathBackOrReturn => {
                if !self.set_mode(mode::SMART_RTL) {
                    self.warn("SmartRTL Unavailable, Trying RTL Mode");
                    self.return_or_land();
                }
            }
            Action::PathBackOrLand => {
                if !self.set_mode(mode::SMART_RTL) {
                    self.warn("SmartRTL Unavailable, Using Land Mode");
                    self.land_after_pause();
                }
            }
            Action::Terminate => self.disarm(),
            Action::PlannedLanding => {
                if !self.set_mode(mode::AUTO_RTL) {
                    self.warn("Trying RTL Mode");
                    self.return_or_land();
                }
            }
            Action::BrakeOrLand => {
                if !self.set_mode(mode::BRAKE) {
                    self.warn("Trying Land Mode");
                    self.land_after_pause();
                }
            }
        }
    }

    /// A vehicle that stands is disarmed instead of being sent somewhere.
    pub(super) fn should_disarm(&self) -> bool {
        let idle = self.sticks().throttle_is_low();
        match self.mode.number {
            mode::STABILIZE | mode::ACRO => idle || self.safety.landed,
            _ => self.safety.landed,
        }
    }

    /// Whether a landing is under way that must not be interrupted (`FS_OPTIONS`).
    pub(super) fn goes_on_landing(&self) -> bool {
        self.is_landing()
            && self
                .tuning
                .failsafes
                .options
                .has(Options::LANDING_CONTINUES)
    }

    /// Whether the vehicle is landing.
    pub(super) fn is_landing(&self) -> bool {
        self.mode.number == mode::LAND
            || matches!(&self.task, Task::Return(way) if way.landing().is_some())
    }

    /// LAND, which first waits a while.
    pub(super) fn land_after_pause(&mut self) {
        let already = self.mode.number == mode::LAND;
        if self.set_mode(mode::LAND) && !already {
            let until = self.uptime() + PAUSE;
            if let Task::Land(landing) = &mut self.task {
                landing.waits_until = Some(until);
            }
        }
    }

    fn return_or_land(&mut self) {
        if !self.set_mode(mode::RTL) {
            self.land_after_pause();
        }
    }

    fn warn(&mut self, text: &str) {
        self.say(MavSeverity::MAV_SEVERITY_WARNING, text);
    }
}
