//! Urgent lines: alerts of the mission with the time left for them, vehicles with a very weak link,
//! and the question about the workload. They take the whole width, so their words are rarely cut
//! off.

use ratatui::buffer::Buffer;
use ratatui::text::Line;

use crate::app::State;
use crate::app::keymap::{Meaning, Place};
use crate::app::state::Room;
use crate::mission::Progress;
use crate::scoring::AlertLevel;
use crate::text;
use crate::text::Text;
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::{clip, put, row_of};

/// The link margin below which a vehicle may soon be out of contact, in dB.
const WEAK_DB: f64 = 6.0;
/// The maximum number of rows.
const MOST: usize = 4;

/// The number of rows; 0 while nothing is urgent.
pub fn height(state: &State) -> u16 {
    lines(state).len() as u16
}

/// Draws the lines, the most urgent first.
pub fn draw(state: &State, panel: Panel<'_>, buffer: &mut Buffer) {
    for (row, (text, role)) in lines(state).into_iter().enumerate() {
        let here = row_of(panel.area, row as u16);
        let words = clip(&panel.text(&text), usize::from(panel.area.width));
        // The rows are cleared, so that no content below them is visible between the words.
        buffer.set_stringn(
            here.x,
            here.y,
            " ".repeat(usize::from(here.width)),
            usize::from(here.width),
            panel.style(role),
        );
        put(buffer, here, 0, &Line::styled(words, panel.style(role)));
    }
}

fn lines(state: &State) -> Vec<(Text, Role)> {
    let progress = state.session().mission();
    let mut lines = match progress {
        Some(progress) if !state.session().is_over() => all(progress),
        _ => return Vec::new(),
    };
    lines.extend(workload_question(state).map(|question| (question, Role::Accent)));
    if lines.len() > MOST {
        let count = lines.len() + 1 - MOST;
        lines.truncate(MOST - 1);
        lines.push((text!("mission-urgent-more", count = count), Role::Warning));
    }
    lines
}

/// The question about the workload, if it is open now.
pub fn workload_question(state: &State) -> Option<Text> {
    let answer = Meaning::words("workload ");
    let key = state.keymap().key(answer, Place::In(Room::Fly));
    let question = || text!("workload-question", key = key);
    state.asks_workload().then(question)
}

fn all(progress: &Progress) -> Vec<(Text, Role)> {
    let alerts = progress.alerts.iter().map(|alert| {
        let role = match alert.level {
            AlertLevel::Critical => Role::Danger,
            AlertLevel::Warning => Role::Warning,
            AlertLevel::Caution => Role::Accent,
        };
        let seconds = alert.remaining.as_secs();
        let text = &alert.text;
        (text!("mission-alert", seconds = seconds, text = text), role)
    });
    let margins = progress.margins_db.iter();
    let low = margins.filter(|(_, margin_db)| **margin_db < WEAK_DB);
    let weak = low.map(|(vehicle, margin_db)| {
        let margin = format!("{margin_db:.0}");
        let text = text!("mission-radio-weak", vehicle = *vehicle, margin = margin);
        (text, Role::Warning)
    });
    alerts.chain(weak).collect()
}
