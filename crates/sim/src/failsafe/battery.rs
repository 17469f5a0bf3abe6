//! The battery's two levels, low and critical, while the vehicle is armed; and the arming checks of the battery.
//!
//! A level is reached at once when the charge left is below `BATT_LOW_MAH` (`BATT_CRT_MAH`), and when the voltage has
//! been below `BATT_LOW_VOLT` (`BATT_CRT_VOLT`) for longer than `BATT_LOW_TIMER` (0 ignores voltages). A limit of 0
//! is off. Each level is reached once, until a reboot.
//!
//! Its action is `BATT_FS_LOW_ACT` (`BATT_FS_CRT_ACT`), unless the action of the other level was more urgent. On the
//! ground, the vehicle disarms instead; a landing under way may go on (`FS_OPTIONS`). The action is returned as a
//! `Reaction::Act`; `act` in `autopilot::reactions` carries it out, and falls back to RTL or LAND if it cannot
//! enter the mode.

use std::time::Duration;

use mavlink::dialects::ardupilotmega::{MavBatteryChargeState, MavSeverity};

use super::{Failsafe, FailsafeInputs, announce};
use crate::kind::VehicleKind;
use crate::parameters::Parameters;
use crate::reaction::{FailsafeAction, Reaction};

/// A battery level: its voltage and charge (0 for none), and the action.
#[derive(Debug, Clone, PartialEq)]
struct BatteryLevel {
    voltage_v: f64,
    remaining_mah: f64,
    action: FailsafeAction,
}

/// The rules from the `BATT_*` parameters.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct BatteryRules {
    low: BatteryLevel,
    critical: BatteryLevel,
    /// How long the voltage must be low; zero to ignore voltages.
    delay: Duration,
    arm_voltage_v: f64,
    arm_mah: f64,
}

/// The battery's level. It never recovers before a reboot.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Default)]
enum Fallen {
    #[default]
    Not,
    Low,
    Critical,
}

/// The state of the battery check.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct BatteryWatch {
    low_since: Option<Duration>,
    critical_since: Option<Duration>,
    fallen: Fallen,
    acted: Option<FailsafeAction>,
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

    /// Whether the most urgent action so far was at least as urgent as a landing.
    pub(super) fn wants_to_land(&self) -> bool {
        self.acted
            .is_some_and(|action| action.priority() <= FailsafeAction::Land.priority())
    }
}

impl BatteryLevel {
    fn read(all: &Parameters, volts: &str, charge: &str, action: &str) -> Self {
        Self {
            voltage_v: all.value(volts),
            remaining_mah: all.value(charge),
            action: match all.kind() {
                VehicleKind::Copter => FailsafeAction::numbered(all.value(action) as i32),
                VehicleKind::Rover(_) => FailsafeAction::of_rover(all.value(action) as i32),
            },
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
            low: BatteryLevel::read(all, "BATT_LOW_VOLT", "BATT_LOW_MAH", "BATT_FS_LOW_ACT"),
            critical: BatteryLevel::read(all, "BATT_CRT_VOLT", "BATT_CRT_MAH", "BATT_FS_CRT_ACT"),
            delay: Duration::from_secs_f64(delay_s),
            arm_voltage_v: all.value("BATT_ARM_VOLT"),
            arm_mah: all.value("BATT_ARM_MAH"),
        }
    }

    /// The reason why the battery forbids arming now; `None` if it does not.
    pub(crate) fn obstacle(&self, voltage_v: f64, left_mah: f64) -> Option<&'static str> {
        let upside_down = |low: f64, critical: f64| critical > 0.0 && low > 0.0 && low <= critical;
        let obstacles = [
            (
                self.arm_voltage_v > 0.0 && voltage_v < self.arm_voltage_v,
                "Battery 1 below minimum arming voltage",
            ),
            (
                self.arm_mah > 0.0 && left_mah < self.arm_mah,
                "Battery 1 below minimum arming capacity",
            ),
            (
                self.low.is_below_voltage(voltage_v),
                "Battery 1 low voltage failsafe",
            ),
            (
                self.low.is_below_charge(left_mah),
                "Battery 1 low capacity failsafe",
            ),
            (
                self.critical.is_below_voltage(voltage_v),
                "Battery 1 critical voltage failsafe",
            ),
            (
                self.critical.is_below_charge(left_mah),
                "Battery 1 critical capacity failsafe",
            ),
            (
                upside_down(self.low.remaining_mah, self.critical.remaining_mah),
                "Battery 1 capacity failsafe critical >= low",
            ),
            (
                upside_down(self.low.voltage_v, self.critical.voltage_v),
                "Battery 1 voltage failsafe critical >= low",
            ),
        ];
        obstacles
            .into_iter()
            .find_map(|(holds, text)| holds.then_some(text))
    }
}

impl Failsafe {
    pub(crate) fn watch_battery(&mut self, inputs: &FailsafeInputs<'_>) -> Vec<Reaction> {
        if !inputs.armed {
            return Vec::new();
        }
        let rules = &inputs.rules.battery;
        let voltage_v = inputs.battery.voltage_v;
        let left_mah = inputs.battery_capacity_mah - inputs.battery.consumed_mah;
        let held = |since: &mut Option<Duration>, applies: bool| {
            if !applies {
                *since = None;
                return false;
            }
            inputs.now > *since.get_or_insert(inputs.now) + rules.delay && !rules.delay.is_zero()
        };
        let watch = &mut self.battery;
        let critical = held(
            &mut watch.critical_since,
            rules.critical.is_below_voltage(voltage_v),
        ) | rules.critical.is_below_charge(left_mah);
        let low = held(&mut watch.low_since, rules.low.is_below_voltage(voltage_v))
            | rules.low.is_below_charge(left_mah);
        if critical && watch.fallen < Fallen::Critical {
            watch.fall(Fallen::Critical, &rules.critical, inputs)
        } else if low && watch.fallen < Fallen::Low {
            watch.fall(Fallen::Low, &rules.low, inputs)
        } else {
            Vec::new()
        }
    }
}

impl BatteryWatch {
    fn fall(
        &mut self,
        fallen: Fallen,
        level: &BatteryLevel,
        inputs: &FailsafeInputs<'_>,
    ) -> Vec<Reaction> {
        self.fallen = fallen;
        let word = if fallen == Fallen::Critical {
            "critical"
        } else {
            "low"
        };
        let text = format!(
            "Battery 1 is {word} {:.2}V used {:.0} mAh",
            inputs.battery.voltage_v, inputs.battery.consumed_mah
        );
        let mut reactions = vec![Reaction::Say(MavSeverity::MAV_SEVERITY_WARNING, text)];
        let action = level.action;
        let before = self.acted;
        if before.is_some_and(|before| before.priority() < action.priority()) {
            return reactions;
        }
        self.acted = Some(action);
        if inputs.is_rover {
            reactions.push(Reaction::Act(action));
            return reactions;
        }
        reactions.extend(if inputs.should_disarm() {
            [Reaction::Disarm, announce("Battery", Some("Disarming"))]
        } else if inputs.goes_on_landing() && action != FailsafeAction::Nothing {
            [
                announce("Battery", Some("Continuing Landing")),
                Reaction::Act(FailsafeAction::Land),
            ]
        } else {
            [announce("Battery", None), Reaction::Act(action)]
        });
        reactions
    }
}
