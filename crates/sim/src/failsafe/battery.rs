//! The battery's two levels.

use std::time::Duration;

use mavlink::dialects::ardupilotmega::{MavBatteryChargeState, MavSeverity};

use super::actions::Action;
use crate::autopilot::Autopilot;
use crate::parameters::Parameters;

/// Below which voltage or remaining charge a battery level is reached (0: never), and the action.
#[derive(Debug, Clone, PartialEq)]
struct Level {
    voltage_v: f64,
    remaining_mah: f64,
    action: i32,
}

/// The `BATT_*` parameters.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct BatteryRules {
    low: Level,
    critical: Level,
    /// How long the voltage must be low; zero: voltages do not matter.
    delay: Duration,
    arm_voltage_v: f64,
    arm_mah: f64,
}

/// How far the battery is down. It never recovers before a reboot.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Default)]
enum Fallen {
    #[default]
    Not,
    Low,
    Critical,
}

/// What was seen of the battery.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct BatteryWatch {
    low_since: Option<Duration>,
    critical_since: Option<Duration>,
    fallen: Fallen,
    acted: Option<Action>,
}

impl BatteryWatch {
    pub(super) fn charge_state(&self) -> MavBatteryChargeState {
        match self.fallen {
            Fallen::Not => MavBatteryChargeState::MAV_BATTERY_CHARGE_STATE_OK,
            Fallen::Low => MavBatteryChargeState::MAV_BATTERY_CHARGE_STATE_LOW,
            Fallen::Critical => MavBatteryChargeState::MAV_BATTERY_CHARGE_STATE_CRITICAL,
        }
    }

    pub(super) fn has_triggered(&self) -> bool {
        self.fallen > Fallen::Not
    }

    /// Whether the most urgent action so far was to land, or more urgent still.
    pub(super) fn wants_to_land(&self) -> bool {
        self.acted
            .is_some_and(|action| action.priority() <= Action::Land.priority())
    }
}

impl Level {
    fn read(all: &Parameters, volts: &str, charge: &str, action: &str) -> Self {
        Self {
            voltage_v: all.value(volts),
            remaining_mah: all.value(charge),
            action: all.value(action) as i32,
        }
    }

    fn is_below_voltage(&self, voltage_v: f64) -> bool {
        self.voltage_v > 0.0 && voltage_v > 0.0 && voltage_v < self.voltage_v
    }

    fn is_below_charge(&self, left_mah: f64) -> bool {
        self.remaining_mah > 0.0 && left_mah < self.remaining_mah
    }
}

impl BatteryRules {
    pub(super) fn read(all: &Parameters) -> Self {
        let delay_s = all.value("BATT_LOW_TIMER").clamp(0.0, 1e6);
        Self {
            low: Level::read(all, "BATT_LOW_VOLT", "BATT_LOW_MAH", "BATT_FS_LOW_ACT"),
            critical: Level::read(all, "BATT_CRT_VOLT", "BATT_CRT_MAH", "BATT_FS_CRT_ACT"),
            delay: Duration::from_secs_f64(delay_s),
            arm_voltage_v: all.value("BATT_ARM_VOLT"),
            arm_mah: all.value("BATT_ARM_MAH"),
        }
    }
}

impl Autopilot {
    /// The battery's voltage as its monitor reads it.
    pub(crate) fn battery_voltage_v(&self) -> f64 {
        self.battery.voltage_v
    }

    /// Why the battery forbids arming at this moment.
    pub(crate) fn battery_obstacle(&self) -> Option<&'static str> {
        let rules = &self.tuning.failsafes.battery;
        let voltage_v = self.battery_voltage_v();
        let left_mah = self.charge_left_mah();
        let upside_down = |low: f64, critical: f64| critical > 0.0 && low > 0.0 && low <= critical;
        let obstacles = [
            (
                rules.arm_voltage_v > 0.0 && voltage_v < rules.arm_voltage_v,
                "Battery 1 below minimum arming voltage",
            ),
            (
                rules.arm_mah > 0.0 && left_mah < rules.arm_mah,
                "Battery 1 below minimum arming capacity",
            ),
            (
                rules.low.is_below_voltage(voltage_v),
                "Battery 1 low voltage failsafe",
            ),
            (
                rules.low.is_below_charge(left_mah),
                "Battery 1 low capacity failsafe",
            ),
            (
                rules.critical.is_below_voltage(voltage_v),
                "Battery 1 critical voltage failsafe",
            ),
            (
                rules.critical.is_below_charge(left_mah),
                "Battery 1 critical capacity failsafe",
            ),
            (
                upside_down(rules.low.remaining_mah, rules.critical.remaining_mah),
                "Battery 1 capacity failsafe critical >= low",
            ),
            (
                upside_down(rules.low.voltage_v, rules.critical.voltage_v),
                "Battery 1 voltage failsafe critical >= low",
            ),
        ];
        obstacles
            .into_iter()
            .find_map(|(holds, text)| holds.then_some(text))
    }

    fn charge_left_mah(&self) -> f64 {
        self.tuning.battery_capacity_mah - self.battery.consumed_mah
    }

    pub(super) fn watch_battery(&mut self) {
        if !self.safety.armed {
            return;
        }
        let now = self.uptime();
        let (voltage_v, left_mah) = (self.battery_voltage_v(), self.charge_left_mah());
        let rules = &self.tuning.failsafes.battery;
        let delay = rules.delay;
        let held = |since: &mut Option<Duration>, applies: bool| {
            if !applies {
                *since = None;
                return false;
            }
            now > *since.get_or_insert(now) + delay && !delay.is_zero()
        };
        let watch = &mut self.failsafe.battery;
        let critical = held(
            &mut watch.critical_since,
            rules.critical.is_below_voltage(voltage_v),
        ) | rules.critical.is_below_charge(left_mah);
        let low = held(&mut watch.low_since, rules.low.is_below_voltage(voltage_v))
            | rules.low.is_below_charge(left_mah);
        if critical && watch.fallen < Fallen::Critical {
            let action = Action::numbered(rules.critical.action);
            self.battery_fell(Fallen::Critical, "critical", action);
        } else if low && watch.fallen < Fallen::Low {
            let action = Action::numbered(rules.low.action);
            self.battery_fell(Fallen::Low, "low", action);
        }
    }

    fn battery_fell(&mut self, fallen: Fallen, word: &str, action: Action) {
        self.failsafe.battery.fallen = fallen;
        let text = format!(
            "Battery 1 is {word} {:.2}V used {:.0} mAh",
            self.battery_voltage_v(),
            self.battery.consumed_mah
        );
        self.say(MavSeverity::MAV_SEVERITY_WARNING, &text);
        let before = self.failsafe.battery.acted;
        if before.is_some_and(|before| before.priority() < action.priority()) {
            return;
        }
        self.failsafe.battery.acted = Some(action);
        if self.should_disarm() {
            self.disarm();
            self.announce("Battery", Some("Disarming"));
        } else if self.goes_on_landing() && action != Action::Nothing {
            self.announce("Battery", Some("Continuing Landing"));
            self.carry_out(Action::Land);
        } else {
            self.announce("Battery", None);
            self.carry_out(action);
        }
    }
}
