//! What the vehicle does by itself when the ground station falls silent or the battery runs low.

use std::time::Duration;

use mavlink::dialects::ardupilotmega::MavSeverity;

use super::autopilot::Autopilot;
use super::battery::Battery;
use super::mode;
use super::parameters::{Parameters, Tuning};

/// The vehicle looks this often.
pub(super) const EVERY_STEPS: u64 = 10;

/// When the failsafes act and what they do, from the `FS_GCS_*` and `BATT_*` parameters.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Rules {
    ground_station: u8,
    ground_station_timeout: Duration,
    low: BatteryRule,
    critical: BatteryRule,
    battery_delay: Duration,
}

/// Below which voltage or remaining charge a battery level is reached (0: never), and the action.
#[derive(Debug, Clone, PartialEq)]
struct BatteryRule {
    voltage_v: f64,
    remaining_mah: f64,
    action: u8,
}

/// What has been seen so far.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Failsafe {
    /// When the ground station's last heartbeat came.
    pub(super) heard: Option<Duration>,
    silent: bool,
    low_since: Option<Duration>,
    critical_since: Option<Duration>,
    level: Level,
}

/// How far the battery is down. It never recovers before a reboot.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Default)]
enum Level {
    #[default]
    Good,
    Low,
    Critical,
}

impl Rules {
    /// Reads the parameters.
    pub(super) fn read(all: &Parameters) -> Self {
        let seconds = |name| Duration::from_secs_f64(all.value(name).clamp(0.0, 1e6));
        let battery = |volts, charge, action| BatteryRule {
            voltage_v: all.value(volts),
            remaining_mah: all.value(charge),
            action: all.value(action) as u8,
        };
        Self {
            ground_station: all.value("FS_GCS_ENABLE") as u8,
            ground_station_timeout: seconds("FS_GCS_TIMEOUT"),
            low: battery("BATT_LOW_VOLT", "BATT_LOW_MAH", "BATT_FS_LOW_ACT"),
            critical: battery("BATT_CRT_VOLT", "BATT_CRT_MAH", "BATT_FS_CRT_ACT"),
            battery_delay: seconds("BATT_LOW_TIMER"),
        }
    }
}

impl BatteryRule {
    fn applies(&self, tuning: &Tuning, battery: &Battery) -> bool {
        battery.voltage_v < self.voltage_v
            || self.remaining_mah > 0.0
                && tuning.battery_capacity_mah - battery.consumed_mah < self.remaining_mah
    }
}

impl Failsafe {
    /// Whether the vehicle reports itself in distress.
    pub(super) fn is_active(&self) -> bool {
        self.silent || self.level > Level::Good
    }

    /// Whether the battery forbids arming.
    pub(super) fn battery_is_down(&self) -> bool {
        self.level > Level::Good
    }
}

impl Autopilot {
    /// Looks at the link and at the battery, and acts.
    pub(super) fn watch_failsafes(&mut self) {
        self.watch_ground_station();
        self.watch_battery();
    }

    fn watch_ground_station(&mut self) {
        let rule = self.tuning.failsafes.ground_station;
        let timeout = self.tuning.failsafes.ground_station_timeout;
        let Some(heard) = self.failsafe.heard else {
            return;
        };
        let silent = rule != 0 && self.uptime() > heard + timeout;
        if silent == self.failsafe.silent {
            return;
        }
        self.failsafe.silent = silent;
        if silent {
            self.say(MavSeverity::MAV_SEVERITY_WARNING, "GCS Failsafe");
            // 5 lands, the others return (by the same way here, where SmartRTL is asked for).
            self.flee(if rule == 5 { mode::LAND } else { mode::RTL });
        } else {
            self.say(MavSeverity::MAV_SEVERITY_WARNING, "GCS Failsafe Cleared");
        }
    }

    fn watch_battery(&mut self) {
        if !self.safety.armed {
            return;
        }
        let now = self.uptime();
        let battery = self.battery;
        let rules = self.tuning.failsafes.clone();
        let held = |since: &mut Option<Duration>, applies: bool| {
            if !applies {
                *since = None;
                return false;
            }
            now >= *since.get_or_insert(now) + rules.battery_delay
        };
        let low = held(
            &mut self.failsafe.low_since,
            rules.low.applies(&self.tuning, &battery),
        );
        let critical = held(
            &mut self.failsafe.critical_since,
            rules.critical.applies(&self.tuning, &battery),
        );
        if critical && self.failsafe.level < Level::Critical {
            self.battery_fell(Level::Critical, "critical", rules.critical.action);
        } else if low && self.failsafe.level < Level::Low {
            self.battery_fell(Level::Low, "low", rules.low.action);
        }
    }

    fn battery_fell(&mut self, level: Level, word: &str, action: u8) {
        self.failsafe.level = level;
        let text = format!(
            "Battery 1 is {word} {:.2}V used {:.0} mAh",
            self.battery.voltage_v, self.battery.consumed_mah
        );
        self.say(MavSeverity::MAV_SEVERITY_WARNING, &text);
        if action == 0 {
            return;
        }
        self.say(MavSeverity::MAV_SEVERITY_WARNING, "Battery Failsafe");
        match action {
            1 => self.flee(mode::LAND),
            5 => self.disarm(),
            _ => self.flee(mode::RTL),
        }
    }

    /// Brings the vehicle down: at once if it stands, else in a mode.
    fn flee(&mut self, to: u8) {
        if !self.safety.armed {
            return;
        }
        if self.safety.landed {
            self.disarm();
        } else if self.mode.number != mode::LAND && !self.set_mode(to) {
            self.set_mode(mode::LAND);
        }
    }
}
