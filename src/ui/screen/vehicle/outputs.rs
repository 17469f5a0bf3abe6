//! Pulses to the motors and servos, and from the radio control.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};

use super::VehicleSubject;
use super::row::bar;
use crate::text;
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::{columns, put};

/// The pulses of an empty and of a full bar, in microseconds.
const SHORTEST_US: f32 = 1000.0;
const LONGEST_US: f32 = 2000.0;
/// The width of a channel's number and pulse, in columns.
const FIGURES: usize = 9;

/// Draws the outputs on the left and the channels of the radio control on the right.
pub(super) fn draw(subject: &VehicleSubject<'_>, area: Rect, buffer: &mut Buffer) {
    let (vehicle, look) = (subject.vehicle, subject.look);
    let half = area.width / 2;
    let left = columns(area, 0, half);
    let right = columns(area, half + 1, area.width);
    let inner = Panel::new(look, left).titled(&look.say("vehicle-outputs"), buffer);
    draw_pulses(subject, &vehicle.servos_us, inner, buffer);
    let rc = vehicle.rc;
    let title = match rc.and_then(|rc| rc.rssi) {
        Some(rssi) => look.text(&text!("vehicle-rc-rssi", rssi = u32::from(rssi))),
        None => "RC".to_owned(),
    };
    let inner = Panel::new(look, right).titled(&title, buffer);
    let channels = rc.map_or([0; 18], |rc| rc.channels_us);
    draw_pulses(subject, &channels, inner, buffer);
}

/// Draws the channels in use, down one column and, if there is room, down the next.
fn draw_pulses(subject: &VehicleSubject<'_>, pulses_us: &[u16], area: Rect, buffer: &mut Buffer) {
    let look = subject.look;
    let used: Vec<(usize, u16)> = pulses_us
        .iter()
        .enumerate()
        .filter(|&(_, &pulse)| pulse > 0)
        .map(|(at, &pulse)| (at + 1, pulse))
        .collect();
    if used.is_empty() {
        put(buffer, area, 0, &Line::styled("-", look.style(Role::Muted)));
        return;
    }
    let rows = usize::from(area.height.max(1));
    let blocks = used
        .len()
        .div_ceil(rows)
        .clamp(1, (usize::from(area.width) / 18).max(1));
    let width = usize::from(area.width) / blocks;
    for (at, (channel, pulse)) in used.into_iter().take(rows * blocks).enumerate() {
        let share = (f32::from(pulse) - SHORTEST_US) / (LONGEST_US - SHORTEST_US);
        let bar = bar(share, width.saturating_sub(FIGURES), look.symbols);
        let line = Line::from(vec![
            Span::styled(format!("{channel:>2} "), look.style(Role::Muted)),
            Span::raw(format!("{pulse:>4} ")),
            Span::styled(bar, look.style(Role::Accent)),
        ]);
        let column = columns(area, (at / rows * width) as u16, width as u16);
        put(buffer, column, (at % rows) as u16, &line);
    }
}
