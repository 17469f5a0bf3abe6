//! One sample of a flight, stored as small integers.

use std::time::Duration;

use crate::battery::Battery;
use crate::body::Body;
use crate::place::LocalDatum;
use sortie_geo::maths;

/// A sample of one moment, in the units of the log.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct LogSample {
    pub(crate) boot_ms: u32,
    pub(crate) lat_e7: i32,
    pub(crate) lon_e7: i32,
    pub(crate) altitude_amsl_cm: i32,
    /// Heights above home, and above the estimator's origin.
    pub(crate) above_home_cm: i32,
    pub(crate) above_origin_cm: i32,
    pub(crate) speed_cm_s: u16,
    pub(crate) course_cd: u16,
    pub(crate) down_cm_s: i16,
    pub(crate) roll_cd: i16,
    pub(crate) pitch_cd: i16,
    pub(crate) yaw_cd: u16,
    pub(crate) voltage_cv: u16,
    pub(crate) current_ca: u16,
    pub(crate) consumed_mah: u16,
    pub(crate) remaining_percent: u8,
    pub(crate) satellites: u8,
    /// The estimator's test ratios of velocity, position, height and compass, in hundredths.
    pub(crate) ratios_percent: [u8; 4],
}

/// The inputs of a sample.
#[derive(Debug, Clone, Copy)]
pub(crate) struct LogInputs<'a> {
    pub(crate) now: Duration,
    /// The autopilot's estimate of the motion.
    pub(crate) body: &'a Body,
    pub(crate) datum: &'a LocalDatum,
    pub(crate) battery: &'a Battery,
    /// The battery's capacity from the parameters.
    pub(crate) capacity_mah: f64,
    pub(crate) satellites: u8,
    /// The estimator's test ratios of velocity, position, height and compass.
    pub(crate) ratios: [f64; 4],
}

impl LogSample {
    /// The sample of a moment.
    pub(crate) fn taken(inputs: &LogInputs<'_>) -> Self {
        let LogInputs { body, battery, .. } = *inputs;
        let here = inputs.datum.place_of(body.position_m);
        let (lat_e7, lon_e7) = here.at.to_e7();
        let home = inputs.datum.home();
        let home_m = home.map_or(here.altitude_amsl_m, |home| home.altitude_amsl_m);
        let (roll, pitch) = body.roll_pitch_rad();
        let velocity = body.velocity_m_s;
        let centi = |value: f64| value * 100.0;
        let degrees = |rad: f64| centi(rad.to_degrees());
        Self {
            boot_ms: inputs.now.as_millis() as u32,
            lat_e7,
            lon_e7,
            altitude_amsl_cm: centi(here.altitude_amsl_m) as i32,
            above_home_cm: centi(here.altitude_amsl_m - home_m) as i32,
            above_origin_cm: centi(-body.position_m.z) as i32,
            speed_cm_s: centi(velocity.truncate().length()) as u16,
            course_cd: degrees(maths::atan2(velocity.y, velocity.x)).rem_euclid(36_000.0) as u16,
            down_cm_s: centi(velocity.z) as i16,
            roll_cd: degrees(roll) as i16,
            pitch_cd: degrees(pitch) as i16,
            yaw_cd: centi(sortie_geo::wrap_360(body.yaw_deg)) as u16,
            voltage_cv: centi(battery.voltage_v) as u16,
            current_ca: centi(battery.current_a) as u16,
            consumed_mah: battery.consumed_mah as u16,
            remaining_percent: battery.remaining_percent(inputs.capacity_mah) as u8,
            satellites: inputs.satellites,
            ratios_percent: inputs
                .ratios
                .map(|ratio| centi(ratio).clamp(0.0, 255.0) as u8),
        }
    }
}
