//! Several vehicles by the rules of a mission: the least separation, and the strip that the sensors cover.

use super::Mission;
use super::needs::USUAL_HEIGHT_M;
use crate::swarm::{Rules, Swath};

const USUAL_SEPARATION_M: f64 = 2.0;
/// The minimum separation in joint manoeuvres, even where a mission sets none: vehicles are a metre wide.
const LEAST_LED_M: f64 = 2.0;

impl Mission {
    /// The required separation between vehicles in the air.
    pub(crate) fn min_separation_m(&self) -> f64 {
        self.rules.separation_m.unwrap_or(USUAL_SEPARATION_M)
    }

    /// The rules for surveys, formations and other manoeuvres: the line spacing follows from the sensors, the
    /// separation from the mission if it sets one.
    pub fn swarm_rules(&self) -> Rules {
        let swaths = self.seats.sensors.iter().filter_map(|sensor| {
            // A detector's strip has the same width at any height; a camera's widens.
            let at_ground_m = sensor.swath_m(0.0)?;
            Some(Swath {
                at_ground_m,
                per_metre: sensor.swath_m(1.0)? - at_ground_m,
            })
        });
        // The narrowest strip counts.
        let width = |swath: &Swath| swath.width_m(USUAL_HEIGHT_M);
        let usual = Rules::default();
        let separation_m = self
            .rules
            .separation_m
            .map(|metres| metres.max(LEAST_LED_M));
        Rules {
            separation_m: separation_m.unwrap_or(usual.separation_m),
            swath: swaths.min_by(|a, b| width(a).total_cmp(&width(b))),
        }
    }
}
