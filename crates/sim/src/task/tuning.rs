//! The parameters that affect flight, in SI units.

use std::time::Duration;

use super::{AutoRules, PilotRules};
use crate::fence::FenceRules;
use crate::helm::HelmRules;
use crate::kind::VehicleKind;
use crate::kinematics::GRAVITY_M_S2;
use crate::leader::FollowRules;
use crate::parameters::Parameters;
use crate::radio::RadioRules;
use crate::rally::RallyRules;
use crate::trail::TrailRules;
use sortie_geo::maths;

/// Limits and settings of the tasks.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct FlightTuning {
    pub(crate) speed_m_s: f64,
    pub(crate) speed_up_m_s: f64,
    pub(crate) speed_down_m_s: f64,
    pub(crate) accel_m_s2: f64,
    pub(crate) accel_z_m_s2: f64,
    pub(crate) jerk_m_s3: f64,
    pub(crate) jerk_z_m_s3: f64,
    /// The horizontal acceleration that the largest lean gives (`ANGLE_MAX`).
    pub(crate) lean_max_m_s2: f64,
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
    pub(crate) circle_radius_m: f64,
    pub(crate) circle_rate_deg_s: f64,
    pub(crate) fence: FenceRules,
    pub(crate) rally: RallyRules,
    pub(crate) trail: TrailRules,
    pub(crate) auto: AutoRules,
    /// How a rover follows another vehicle; `None` if it may not.
    pub(crate) follow: Option<FollowRules>,
    /// How a rover steers; `None` for a vehicle that flies.
    pub(crate) helm: Option<Box<HelmRules>>,
}

impl FlightTuning {
    /// The speeds along waypoints: cruise, climb, descent.
    pub(crate) fn speeds_m_s(&self) -> [f64; 3] {
        [self.speed_m_s, self.speed_up_m_s, self.speed_down_m_s]
    }

    /// Reads the parameters. Invalid values (zero accelerations, negative speeds) are raised to the smallest that the
    /// equations of motion allow.
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
            lean_max_m_s2: GRAVITY_M_S2
                * maths::tan(cm("ANGLE_MAX").clamp(10.0, 80.0).to_radians()),
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
            circle_radius_m: cm("CIRCLE_RADIUS").clamp(0.0, 2000.0),
            circle_rate_deg_s: all.value("CIRCLE_RATE").clamp(-90.0, 90.0),
            fence: FenceRules::read(all),
            rally: RallyRules::read(all),
            trail: TrailRules::read(all),
            auto: AutoRules::read(all),
            follow: FollowRules::read(all),
            helm: None,
        }
        .with_helm(all)
    }

    /// The speeds and limits of a rover, if the parameters are those of one.
    fn with_helm(self, all: &Parameters) -> Self {
        if all.kind() == VehicleKind::Copter {
            return self;
        }
        let helm = HelmRules::read(all);
        let asked_jerk = all.value("WP_JERK");
        let jerk_m_s3 = if asked_jerk > 0.0 {
            asked_jerk
        } else {
            helm.accel_m_s2
        };
        let return_speed = all.value("RTL_SPEED");
        Self {
            speed_m_s: helm.speed_max_m_s,
            accel_m_s2: helm.accel_m_s2,
            jerk_m_s3,
            return_speed_m_s: if return_speed > 0.0 {
                return_speed
            } else {
                helm.speed_max_m_s
            },
            auto: AutoRules::of_rover(all, &helm, jerk_m_s3),
            helm: Some(Box::new(helm)),
            ..self
        }
    }
}
