//! Manoeuvres of several vehicles, as a mission counts them.

use super::Mission;
use crate::swarm::{Rules, Swath};

/// Of several sensors that see differently wide strips, the narrowest at this height counts.
const USUAL_HEIGHT_M: f64 = 20.0;
/// How far apart vehicles have to be where the mission does not say it.
const USUAL_SEPARATION_M: f64 = 2.0;
/// Vehicles that are led together keep this distance even where a mission asks for none: they are a metre wide.
const LEAST_LED_M: f64 = 2.0;

impl Mission {
    /// How far apart vehicles in the air have to be.
    pub(crate) fn min_separation_m(&self) -> f64 {
        self.separation_m.unwrap_or(USUAL_SEPARATION_M)
    }

    /// The rules for surveys, formations and the like: the spacing of lines is what the sensors see, and the separation
    /// is the mission's own if it has one.
    pub fn swarm_rules(&self) -> Rules {
        let swaths = self.sensors.iter().filter_map(|sensor| {
            // A detector has one width at any height, a camera a cone.
            let at_ground_m = sensor.swath_m(0.0)?;
            Some(Swath {
                at_ground_m,
                per_metre: sensor.swath_m(1.0)? - at_ground_m,
            })
        });
        let width = |swath: &Swath| swath.width_m(USUAL_HEIGHT_M);
        let usual = Rules::default();
        let separation_m = self.separation_m.map(|metres| metres.max(LEAST_LED_M));
        Rules {
            separation_m: separation_m.unwrap_or(usual.separation_m),
            swath: swaths.min_by(|a, b| width(a).total_cmp(&width(b))),
        }
    }
}
