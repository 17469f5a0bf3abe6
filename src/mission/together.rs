//! What a mission says of vehicles that do something together.

use super::Mission;
use crate::swarm::{Rules, Swath};

/// Of several sensors that see differently wide strips, the narrowest at this height counts.
const USUAL_HEIGHT_M: f64 = 20.0;

impl Mission {
    /// The rules for surveys, formations and the like: the spacing of lines is what the sensors see.
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
        Rules {
            swath: swaths.min_by(|a, b| width(a).total_cmp(&width(b))),
            ..Rules::default()
        }
    }
}
