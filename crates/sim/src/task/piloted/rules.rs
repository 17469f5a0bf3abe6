//! The meaning of the sticks: the parameters of the piloted modes.

use std::time::Duration;

use crate::kinematics::GRAVITY_M_S2;
use crate::parameters::Parameters;
use sortie_geo::maths;

/// The meaning of the sticks, from `LOIT_*`, `PILOT_*`, `PHLD_*`, `ACRO_*`, `ANGLE_MAX`.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct PilotRules {
    pub(super) climb_m_s: f64,
    pub(super) sink_m_s: f64,
    pub(super) accel_z_m_s2: f64,
    /// Share of the throttle's travel around its middle that holds the height.
    pub(super) dead_throttle: f64,
    pub(super) lean_max_rad: f64,
    pub(super) loiter_lean_rad: f64,
    pub(super) loiter_speed_m_s: f64,
    pub(super) loiter_accel_m_s2: f64,
    pub(super) brake_accel_m_s2: f64,
    pub(super) brake_jerk_m_s3: f64,
    pub(super) brake_delay: Duration,
    pub(super) hold_brake_rad_s: f64,
    pub(super) hold_brake_rad: f64,
    pub(super) acro_rate_rad_s: f64,
    pub(super) acro_balance_per_s: f64,
    pub(super) turn_deg_s: f64,
    pub(super) acro_turn_deg_s: f64,
    pub(super) hover: f64,
    /// The height of a takeoff by the throttle stick, in metres; 0 for none.
    pub(super) takeoff_m: f64,
    /// Whether the sticks move a vehicle that lands on its own.
    pub(crate) moves_landing: bool,
}

impl PilotRules {
    /// The throttle that holds the vehicle in the air (`MOT_THST_HOVER`).
    pub(crate) fn hover(&self) -> f64 {
        self.hover
    }

    pub(crate) fn read(all: &Parameters) -> Self {
        let cm = |name| (all.value(name) * 0.01).clamp(0.05, 1000.0);
        let lean_max_rad = (all.value("ANGLE_MAX") * 0.01)
            .clamp(10.0, 80.0)
            .to_radians();
        let loiter_deg = all.value("LOIT_ANG_MAX");
        let climb_m_s = cm("PILOT_SPEED_UP");
        Self {
            climb_m_s,
            sink_m_s: if all.value("PILOT_SPEED_DN") > 0.0 {
                cm("PILOT_SPEED_DN")
            } else {
                climb_m_s
            },
            accel_z_m_s2: cm("PILOT_ACCEL_Z"),
            dead_throttle: all.value("THR_DZ").clamp(0.0, 400.0) / 1000.0,
            lean_max_rad,
            loiter_lean_rad: if loiter_deg > 0.0 {
                loiter_deg.clamp(1.0, 80.0).to_radians().min(lean_max_rad)
            } else {
                lean_max_rad * 2.0 / 3.0
            },
            loiter_speed_m_s: cm("LOIT_SPEED").max(0.2),
            loiter_accel_m_s2: cm("LOIT_ACC_MAX").min(GRAVITY_M_S2 * maths::tan(lean_max_rad)),
            brake_accel_m_s2: cm("LOIT_BRK_ACCEL"),
            brake_jerk_m_s3: cm("LOIT_BRK_JERK"),
            brake_delay: Duration::from_secs_f64(all.value("LOIT_BRK_DELAY").clamp(0.0, 1e4)),
            hold_brake_rad_s: all.value("PHLD_BRAKE_RATE").clamp(1.0, 100.0).to_radians(),
            hold_brake_rad: (all.value("PHLD_BRAKE_ANGLE") * 0.01)
                .clamp(1.0, 60.0)
                .to_radians(),
            acro_rate_rad_s: all.value("ACRO_RP_RATE").clamp(1.0, 1080.0).to_radians(),
            acro_balance_per_s: all.value("ACRO_BAL_ROLL").clamp(0.0, 10.0),
            turn_deg_s: all.value("PILOT_Y_RATE").clamp(1.0, 360.0),
            acro_turn_deg_s: all.value("ACRO_Y_RATE").clamp(1.0, 1080.0),
            takeoff_m: (all.value("PILOT_TKOFF_ALT") * 0.01).clamp(0.0, 10.0),
            hover: all.value("MOT_THST_HOVER").clamp(0.125, 0.6875),
            moves_landing: all.value("LAND_REPOSITION") > 0.0,
        }
    }
}
