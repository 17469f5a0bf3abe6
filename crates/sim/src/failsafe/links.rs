//! The links to the ground: the ground station's heartbeats and the remote control.

use std::time::Duration;

use mavlink::dialects::ardupilotmega::MavSeverity;

use super::Options;
use super::actions::Action;
use crate::autopilot::Autopilot;
use crate::estimator::RadioFault;
use crate::mode;

/// A throttle that is too low must be seen this often, at 50 frames per second.
const LOW_FOR: Duration = Duration::from_millis(50);
/// The throttle of a receiver that has lost its transmitter, in microseconds.
const LOST_THROTTLE_US: f64 = 950.0;

/// What was heard on the links.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct LinkWatch {
    station_lost: bool,
    radio_lost: bool,
    /// Since when the remote control has been silent or too low.
    radio_bad_since: Option<Duration>,
}

impl LinkWatch {
    pub(super) fn station_is_lost(&self) -> bool {
        self.station_lost
    }

    pub(super) fn radio_is_lost(&self) -> bool {
        self.radio_lost
    }
}

impl Autopilot {
    pub(super) fn watch_ground_station(&mut self) {
        let rules = &self.tuning.failsafes;
        let (rule, timeout) = (rules.ground_station, rules.ground_station_timeout);
        let Some(heard) = self.failsafe.heard else {
            return;
        };
        if rule == 0 {
            return;
        }
        let lost = self.uptime() > heard + timeout;
        if lost == self.failsafe.links.station_lost {
            return;
        }
        self.failsafe.links.station_lost = lost;
        if lost {
            self.lose_ground_station(rule);
        } else {
            self.say(MavSeverity::MAV_SEVERITY_WARNING, "GCS Failsafe Cleared");
        }
    }

    fn lose_ground_station(&mut self, rule: i32) {
        // The ground station's hands on the sticks are gone as well.
        self.radio.until = Duration::ZERO;
        let options = self.tuning.failsafes.options;
        let in_auto = self.mode.number == mode::AUTO;
        let piloted = !self.mode.autonomous;
        let action = match rule {
            3 => Action::PathBackOrReturn,
            4 => Action::PathBackOrLand,
            5 => Action::Land,
            6 => Action::PlannedLanding,
            7 => Action::BrakeOrLand,
            _ => Action::Return,
        };
        if !self.safety.armed {
            self.announce("GCS", None);
        } else if self.should_disarm() {
            self.disarm();
            self.announce("GCS", Some("Disarming"));
        } else if self.is_landing() && self.failsafe.battery.wants_to_land() {
            self.announce("GCS + Battery", Some("Continuing Landing"));
            self.carry_out(Action::Land);
        } else if self.goes_on_landing() {
            self.announce("GCS", Some("Continuing Landing"));
            self.carry_out(Action::Land);
        } else if in_auto && options.has(Options::STATION_CONTINUES_AUTO) {
            self.announce("GCS", Some("Continuing Auto Mode"));
        } else if piloted
            && self.mode.number != mode::LAND
            && options.has(Options::STATION_CONTINUES_PILOTED)
        {
            self.announce("GCS", Some("Continuing Pilot Control"));
        } else {
            self.announce("GCS", None);
            self.carry_out(action);
        }
    }

    /// The throttle that comes from the remote control, in microseconds.
    pub(crate) fn radio_throttle_us(&self) -> f64 {
        let overridden = self.uptime() < self.radio.until;
        if self.tuning.faults.radio == RadioFault::Low && !overridden {
            LOST_THROTTLE_US
        } else {
            f64::from(self.sticks().channels_us[2])
        }
    }

    /// Looks at the remote control. Costs nothing while it works.
    pub(crate) fn watch_radio(&mut self) {
        let links = &self.failsafe.links;
        let fault = self.tuning.faults.radio;
        if fault == RadioFault::Fine && !links.radio_lost && links.radio_bad_since.is_none() {
            return;
        }
        let now = self.uptime();
        let rules = &self.tuning.failsafes;
        let overridden = now < self.radio.until;
        let low = self.radio_throttle_us() < rules.radio_low_us;
        let delay = match fault {
            _ if rules.radio == 0 => None,
            RadioFault::Silent if !overridden => Some(rules.radio_timeout),
            _ if low => Some(LOW_FOR),
            _ => None,
        };
        let Some(delay) = delay else {
            self.failsafe.links.radio_bad_since = None;
            if std::mem::take(&mut self.failsafe.links.radio_lost) {
                self.say(MavSeverity::MAV_SEVERITY_WARNING, "Radio Failsafe Cleared");
            }
            return;
        };
        let since = *self.failsafe.links.radio_bad_since.get_or_insert(now);
        if !self.failsafe.links.radio_lost && now >= since + delay {
            self.failsafe.links.radio_lost = true;
            self.lose_radio();
        }
    }

    fn lose_radio(&mut self) {
        let options = self.tuning.failsafes.options;
        let action = match self.tuning.failsafes.radio {
            1 | 2 => Action::Return,
            4 => Action::PathBackOrReturn,
            5 => Action::PathBackOrLand,
            6 => Action::PlannedLanding,
            7 => Action::BrakeOrLand,
            _ => Action::Land,
        };
        if self.should_disarm() {
            self.announce("Radio", Some("Disarming"));
            self.disarm();
        } else if self.is_landing() && self.failsafe.battery.wants_to_land() {
            self.announce("Radio + Battery", Some("Continuing Landing"));
            self.carry_out(Action::Land);
        } else if self.goes_on_landing() {
            self.announce("Radio", Some("Continuing Landing"));
            self.carry_out(Action::Land);
        } else if self.mode.number == mode::AUTO && options.has(Options::RADIO_CONTINUES_AUTO) {
            self.announce("Radio", Some("Continuing Auto"));
        } else if self.mode.number == mode::GUIDED && options.has(Options::RADIO_CONTINUES_GUIDED) {
            self.announce("Radio", Some("Continuing Guided Mode"));
        } else {
            self.announce("Radio", None);
            self.carry_out(action);
        }
    }
}
