//! The sensors that are fitted, in use and healthy, from `SYS_STATUS`.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};

use super::VehicleSubject;
use super::row::filled;
use crate::text;
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::{columns, put};
use crate::vehicle::{FixType, Grade, Health, Vehicle};

/// The minimum width of an entry, in columns.
const ENTRY: u16 = 25;
/// The width of a sensor's state, in columns.
const STATE: usize = 5;

/// The id of the satellite receiver's name.
const GPS: &str = "sensor-gps";

/// The bits of `MAV_SYS_STATUS_SENSOR` from 0, as the ids of their names.
const NAMES: [&str; 31] = [
    "sensor-gyro",
    "sensor-accelerometer",
    "sensor-compass",
    "sensor-barometer",
    "sensor-airspeed",
    GPS,
    "sensor-flow",
    "sensor-vision",
    "sensor-laser",
    "sensor-ground-truth",
    "sensor-rate-control",
    "sensor-attitude-control",
    "sensor-yaw-control",
    "sensor-height-control",
    "sensor-position-control",
    "sensor-motors",
    "sensor-rc",
    "sensor-gyro-2",
    "sensor-accelerometer-2",
    "sensor-compass-2",
    "sensor-fence",
    "sensor-ahrs",
    "sensor-terrain",
    "sensor-reverse-motor",
    "sensor-logging",
    "sensor-battery",
    "sensor-proximity",
    "sensor-satellite-link",
    "sensor-prearm",
    "sensor-avoidance",
    "sensor-propulsion",
];

#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Condition {
    Bad,
    /// Healthy, but of little use now.
    Poor,
    Good,
    Off,
}

/// Draws the fitted sensors, faulty ones first.
pub(super) fn draw(subject: &VehicleSubject<'_>, area: Rect, buffer: &mut Buffer) {
    let look = subject.look;
    let inner = Panel::new(look, area).titled(&look.say("vehicle-sensors"), buffer);
    let Some(health) = subject.vehicle.health else {
        put(
            buffer,
            inner,
            0,
            &Line::styled("-", look.style(Role::Muted)),
        );
        return;
    };
    let poor_fix = poor_fix(subject.vehicle);
    let entries = fitted(&health, poor_fix);
    if entries.is_empty() {
        put(
            buffer,
            inner,
            0,
            &Line::styled("-", look.style(Role::Muted)),
        );
        return;
    }
    let rows = usize::from(inner.height.max(1));
    let blocks = usize::from((inner.width / ENTRY).max(1));
    let width = usize::from(inner.width) / blocks;
    let lines = entries.len().div_ceil(blocks);
    Panel::new(look, inner).mark_scroll(0, lines, buffer);
    for (at, (condition, id)) in entries.into_iter().take(rows * blocks).enumerate() {
        let (word, role) = match condition {
            _ if subject.vehicle.link.lost => (look.say("vehicle-grade-old"), Role::Muted),
            Condition::Bad => (look.say("sensor-bad"), Role::Danger),
            Condition::Poor => (look.say("sensor-poor"), Role::Warning),
            Condition::Good => (look.say("sensor-good"), Role::Ok),
            Condition::Off => (look.say("sensor-off"), Role::Muted),
        };
        let (name, name_role) = match poor_fix.filter(|_| id == GPS) {
            Some(fix) => (
                look.text(&text!("sensor-gps-fix", fix = fix.text())),
                Role::Warning,
            ),
            None => (look.say(id), Role::Text),
        };
        let name = filled(&name, width.saturating_sub(STATE + 2));
        let line = Line::from(vec![
            Span::styled(format!("{} ", filled(&word, STATE)), look.style(role)),
            Span::styled(name, look.style(name_role)),
        ]);
        let column = columns(inner, (at / rows * width) as u16, width as u16);
        put(buffer, column, (at % rows) as u16, &line);
    }
}

/// The fix of a receiver that has no good one. `SYS_STATUS` calls such a receiver healthy.
fn poor_fix(vehicle: &Vehicle) -> Option<FixType> {
    let gps = vehicle.gps?;
    (Grade::of_fix(gps.fix) != Grade::Good).then_some(gps.fix)
}

/// The sensors that are fitted or in use, with their condition, most serious first; the receiver's is
/// poor with a poor fix.
fn fitted(health: &Health, poor_fix: Option<FixType>) -> Vec<(Condition, &'static str)> {
    let mut entries: Vec<_> = NAMES
        .into_iter()
        .enumerate()
        .filter_map(|(at, id)| {
            let bit = 1 << at;
            if (health.present | health.enabled) & bit == 0 {
                return None;
            }
            let condition = match (health.enabled & bit != 0, health.healthy & bit != 0) {
                (true, true) if id == GPS && poor_fix.is_some() => Condition::Poor,
                (true, true) => Condition::Good,
                (true, false) => Condition::Bad,
                (false, _) => Condition::Off,
            };
            Some((condition, id))
        })
        .collect();
    entries.sort_by_key(|&(condition, _)| condition);
    entries
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::*;

    #[test]
    fn what_is_wrong_comes_first_and_what_is_not_fitted_is_left_out() {
        let health = Health {
            present: 0b1_0111,
            enabled: 0b0_0111,
            healthy: 0b1_0101,
            load_percent: 0.0,
            at: Duration::ZERO,
        };
        assert_eq!(
            fitted(&health, None),
            [
                (Condition::Bad, "sensor-accelerometer"),
                (Condition::Good, "sensor-gyro"),
                (Condition::Good, "sensor-compass"),
                (Condition::Off, "sensor-airspeed"),
            ]
        );
    }

    #[test]
    fn a_receiver_without_a_fix_is_not_called_well() {
        let health = Health {
            present: 0b10_0001,
            enabled: 0b10_0001,
            healthy: 0b10_0001,
            load_percent: 0.0,
            at: Duration::ZERO,
        };
        assert_eq!(
            fitted(&health, Some(FixType::NoFix)),
            [(Condition::Poor, GPS), (Condition::Good, "sensor-gyro")]
        );
    }
}
