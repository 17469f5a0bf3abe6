//! The parameters that shape the flight, converted once per change instead of once per step.

use std::time::Duration;

use super::Parameters;
use crate::arming::ArmingRules;
use crate::estimator::Faults;
use crate::failsafe::Rules;
use crate::radio::RadioRules;
use crate::task::{AutoRules, PilotRules};
use crate::transfer::Recorder;
use crate::upset::MotorFault;
use crate::{fence, rally, trail, wind};

/// Limits and settings in SI units.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Tuning {
    pub(crate) speed_m_s: f64,
    pub(crate) speed_up_m_s: f64,
    pub(crate) speed_down_m_s: f64,
    pub(crate) accel_m_s2: f64,
    pub(crate) accel_z_m_s2: f64,
    pub(crate) jerk_m_s3: f64,
    pub(crate) jerk_z_m_s3: f64,
    pub(crate) lean_max_rad: f64,
    pub(crate) return_speed_m_s: f64,
    pub(crate) return_altitude_m: f64,
    pub(crate) return_climb_min_m: f64,
    pub(crate) return_cone_slope: f64,
    pub(crate) return_final_altitude_m: f64,
    pub(crate) return_loiter: Duration,
    pub(crate) land_speed_m_s: f64,
    pub(crate) land_speed_high_m_s: f64,
    pub(crate) land_altitude_low_m: f64,
    pub(crate) pilot: PilotRules,
    pub(crate) radio: RadioRules,
    /// `GUID_OPTIONS`.
    pub(crate) guided_options: i32,
    /// `ATC_ACCEL_Y_MAX` in degrees per second squared.
    pub(crate) yaw_accel_deg_s2: f64,
    pub(crate) circle_radius_m: f64,
    pub(crate) circle_rate_deg_s: f64,
    pub(crate) yaw_behaviour: i32,
    pub(crate) slew_yaw_deg_s: f64,
    /// Zero: never.
    pub(crate) disarm_delay: Duration,
    pub(crate) setpoint_timeout: Duration,
    pub(crate) ground_station: u8,
    pub(crate) only_ground_station: bool,
    pub(crate) wind: wind::Rules,
    /// To which the simulated battery is charged or drained when it changes.
    pub(crate) battery_set_v: f64,
    pub(crate) motor_fault: Option<MotorFault>,
    pub(crate) crash_check: bool,
    pub(crate) battery_capacity_mah: f64,
    pub(crate) failsafes: Rules,
    pub(crate) fence: fence::Rules,
    pub(crate) rally: rally::Rules,
    pub(crate) trail: trail::Rules,
    pub(crate) recorder: Recorder,
    pub(crate) faults: Faults,
    pub(crate) arming: ArmingRules,
    pub(crate) auto: AutoRules,
}

impl Tuning {
    /// Reads the parameters. Values without sense (zero accelerations, negative speeds) become the smallest
    /// that the equations of motion bear.
    pub(crate) fn read(all: &Parameters) -> Self {
        let cm = |name| all.value(name) * 0.01;
        let least = |value: f64| value.clamp(0.05, 1000.0);
        let seconds = |s: f64| Duration::from_secs_f64(s.clamp(0.0, 1e6));
        let or = |value: f64, otherwise: f64| if value > 0.0 { value } else { otherwise };
        let speed_m_s = least(cm("WPNAV_SPEED"));
        let speed_down_m_s = least(cm("WPNAV_SPEED_DN"));
        Self {
            speed_m_s,
            speed_up_m_s: least(cm("WPNAV_SPEED_UP")),
            speed_down_m_s,
            accel_m_s2: least(cm("WPNAV_ACCEL")),
            accel_z_m_s2: least(cm("WPNAV_ACCEL_Z")),
            jerk_m_s3: least(all.value("PSC_JERK_XY")),
            jerk_z_m_s3: least(all.value("PSC_JERK_Z")),
            lean_max_rad: cm("ANGLE_MAX").clamp(10.0, 80.0).to_radians(),
            return_speed_m_s: or(cm("RTL_SPEED"), speed_m_s),
            return_altitude_m: cm("RTL_ALT"),
            return_climb_min_m: cm("RTL_CLIMB_MIN").max(0.0),
            return_cone_slope: all.value("RTL_CONE_SLOPE"),
            return_final_altitude_m: cm("RTL_ALT_FINAL"),
            return_loiter: seconds(all.value("RTL_LOIT_TIME") * 1e-3),
            land_speed_m_s: least(cm("LAND_SPEED")),
            land_speed_high_m_s: or(cm("LAND_SPEED_HIGH"), speed_down_m_s),
            land_altitude_low_m: cm("LAND_ALT_LOW"),
            pilot: PilotRules::read(all),
            radio: RadioRules::read(all),
            guided_options: all.value("GUID_OPTIONS") as i32,
            yaw_accel_deg_s2: cm("ATC_ACCEL_Y_MAX").clamp(10.0, 7200.0),
            circle_radius_m: cm("CIRCLE_RADIUS").clamp(0.0, 2000.0),
            circle_rate_deg_s: all.value("CIRCLE_RATE").clamp(-90.0, 90.0),
            yaw_behaviour: all.value("WP_YAW_BEHAVIOR") as i32,
            slew_yaw_deg_s: cm("ATC_SLEW_YAW").clamp(1.0, 360.0),
            disarm_delay: seconds(all.value("DISARM_DELAY")),
            setpoint_timeout: seconds(all.value("GUID_TIMEOUT").max(0.1)),
            ground_station: all.value("SYSID_MYGCS") as u8,
            only_ground_station: all.value("SYSID_ENFORCE") > 0.0,
            wind: wind::Rules::read(all),
            battery_set_v: all.value("SIM_BATT_VOLTAGE").clamp(0.0, 600.0),
            motor_fault: motor_fault(all),
            crash_check: all.value("FS_CRASH_CHECK") > 0.0,
            battery_capacity_mah: all.value("BATT_CAPACITY").max(1.0),
            failsafes: Rules::read(all),
            fence: fence::Rules::read(all),
            rally: rally::Rules::read(all),
            trail: trail::Rules::read(all),
            recorder: Recorder::read(all),
            faults: Faults::read(all),
            arming: ArmingRules::read(all),
            auto: AutoRules::read(all),
        }
    }
}

/// The motor that does not obey: `SIM_ENGINE_FAIL` counts outputs from 0, and one beyond the last means the first.
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
