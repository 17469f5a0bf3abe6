//! The parameters in SI units, converted once per change instead of once per step.

use std::time::Duration;

use super::arming::ArmingRules;
use super::estimator::Faults;
use super::failsafe::FailsafeRules;
use super::flight_log::LogRules;
use super::parameters::Parameters;
use super::task::FlightTuning;
use super::upset::MotorFault;
use super::wind::WindRules;

/// Limits and settings in SI units.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Tuning {
    pub(crate) flight: FlightTuning,
    /// The bits of `GUID_OPTIONS`.
    pub(crate) guided_options: i32,
    /// `ATC_ACCEL_Y_MAX` in degrees per second squared.
    pub(crate) yaw_accel_deg_s2: f64,
    pub(crate) yaw_behaviour: i32,
    pub(crate) slew_yaw_deg_s: f64,
    /// The time after which an idle vehicle is disarmed; zero for never.
    pub(crate) disarm_delay: Duration,
    pub(crate) setpoint_timeout: Duration,
    pub(crate) ground_station: u8,
    pub(crate) only_ground_station: bool,
    pub(crate) wind: WindRules,
    /// `SIM_BATT_VOLTAGE`, in volts; when it changes, the battery is charged or drained to this
    /// voltage.
    pub(crate) battery_set_v: f64,
    pub(crate) motor_fault: Option<MotorFault>,
    pub(crate) crash_check: bool,
    pub(crate) battery_capacity_mah: f64,
    pub(crate) failsafes: FailsafeRules,
    pub(crate) recorder: LogRules,
    pub(crate) faults: Faults,
    pub(crate) arming: ArmingRules,
}

impl Tuning {
    pub(crate) fn read(all: &Parameters) -> Self {
        let cm = |name| all.value(name) * 0.01;
        let seconds = |s: f64| Duration::from_secs_f64(s.clamp(0.0, 1e6));
        Self {
            flight: FlightTuning::read(all),
            guided_options: all.value("GUID_OPTIONS") as i32,
            yaw_accel_deg_s2: cm("ATC_ACCEL_Y_MAX").clamp(10.0, 7200.0),
            yaw_behaviour: all.value("WP_YAW_BEHAVIOR") as i32,
            slew_yaw_deg_s: cm("ATC_SLEW_YAW").clamp(1.0, 360.0),
            disarm_delay: seconds(all.value("DISARM_DELAY")),
            setpoint_timeout: seconds(all.value("GUID_TIMEOUT").max(0.1)),
            ground_station: all.value("SYSID_MYGCS") as u8,
            only_ground_station: all.value("SYSID_ENFORCE") > 0.0,
            wind: WindRules::read(all),
            battery_set_v: all.value("SIM_BATT_VOLTAGE").clamp(0.0, 600.0),
            motor_fault: motor_fault(all),
            crash_check: all.value("FS_CRASH_CHECK") > 0.0,
            battery_capacity_mah: all.value("BATT_CAPACITY").max(1.0),
            failsafes: FailsafeRules::read(all),
            recorder: LogRules::read(all),
            faults: Faults::read(all),
            arming: ArmingRules::read(all),
        }
    }
}

/// The faulty motor: `SIM_ENGINE_FAIL` counts outputs from 0, and an output beyond the last one means the first.
fn motor_fault(all: &Parameters) -> Option<MotorFault> {
    let multiplier = all.value("SIM_ENGINE_MUL").clamp(-10.0, 10.0);
    let output = all.value("SIM_ENGINE_FAIL");
    ((multiplier - 1.0).abs() > 1e-6).then_some(MotorFault {
        motor: if (0.0..16.0).contains(&output) {
            output as usize
        } else {
            0
        },
        multiplier,
    })
}
