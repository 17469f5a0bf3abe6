//! The circles of a rover and their warnings, and changes of the speed of a drive.

use std::sync::Arc;

use mavlink::dialects::ardupilotmega::MavSeverity;

use super::Vehicle;
use crate::mode::ModeId;
use crate::task::{Drive, Task};

/// The lowest speed that a rover accepts along a path, in m/s.
const SPEED_MIN_M_S: f64 = 0.05;

impl Vehicle {
    /// Warns of values of `CIRC_*` that the vehicle cannot drive.
    pub(crate) fn warn_of_the_circle(&mut self) {
        let tuning = &self.tuning.flight;
        let warnings = tuning.helm.as_deref().map(|rules| rules.circle.warnings());
        for text in warnings.into_iter().flatten() {
            self.say(MavSeverity::MAV_SEVERITY_WARNING, &text);
        }
    }

    /// Sets the speed of the drive under way; `false` while there is none, or for a speed that it cannot have.
    pub(crate) fn set_drive_speed(&mut self, speed_m_s: f64) -> bool {
        let flight = &mut self.flight;
        let on_path = match &mut flight.task {
            Task::Drive(Drive::Circle(_)) => return self.set_circle_speed(speed_m_s),
            Task::Drive(Drive::Heading(heading)) if speed_m_s.is_finite() => {
                heading.set_speed(speed_m_s);
                return true;
            }
            Task::Drive(Drive::Follow(fastest_m_s)) if speed_m_s >= 0.0 => {
                *fastest_m_s = speed_m_s;
                return true;
            }
            Task::Drive(Drive::Heading(_) | Drive::Loiter(_)) => false,
            Task::Route(_) | Task::Drive(Drive::Goto(_) | Drive::Return(_)) => true,
            _ => flight.mode.id == ModeId::Auto,
        };
        let able = on_path && speed_m_s >= SPEED_MIN_M_S && speed_m_s.is_finite();
        if able {
            flight.speeds.ground_m_s = Some(speed_m_s);
        }
        able
    }

    /// Sets the speed on a circle, if one is driven; `false` unless the speed is positive and finite.
    fn set_circle_speed(&mut self, speed_m_s: f64) -> bool {
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
