//! The circles of a rover: their warnings, and changes of their speed.

use std::sync::Arc;

use mavlink::dialects::ardupilotmega::MavSeverity;

use super::Vehicle;
use crate::task::{Drive, Task};

impl Vehicle {
    /// Says what the parameters ask of a circle and cannot have.
    pub(crate) fn warn_of_the_circle(&mut self) {
        let tuning = &self.tuning.flight;
        let warnings = tuning.helm.as_deref().map(|rules| rules.circle.warnings());
        for text in warnings.into_iter().flatten() {
            self.say(MavSeverity::MAV_SEVERITY_WARNING, &text);
        }
    }

    /// Sets the speed on a circle, if one is driven; `false` for a speed that is none.
    pub(crate) fn set_circle_speed(&mut self, speed_m_s: f64) -> bool {
        let tuning = Arc::clone(&self.tuning);
        let rules = tuning.flight.helm.as_deref().map(|helm| &helm.circle);
        let Some(rules) = rules.filter(|_| speed_m_s > 0.0 && speed_m_s.is_finite()) else {
            return false;
        };
        if let Some(text) = rules.speed_warning(speed_m_s) {
            self.say(MavSeverity::MAV_SEVERITY_WARNING, &text);
        }
        if let Task::Drive(Drive::Circle(circle)) = &mut self.flight.task {
            circle.set_speed(speed_m_s, rules);
        }
        true
    }
}
