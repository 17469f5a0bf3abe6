//! A log on the whole screen: the notices, other aircraft, or the moments of a replay.

use std::ops::Range;

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::Line;

use super::{notices, replay, traffic};
use crate::app::State;
use crate::app::action::Action;
use crate::app::keymap::Place;
use crate::app::state::Log;
use crate::text;
use crate::ui::look::Look;
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::{put, row_of};

/// Draws a log, with the entry under the cursor marked and visible.
pub fn draw(state: &State, log: Log, cursor: Option<usize>, panel: Panel<'_>, buffer: &mut Buffer) {
    let count = state.log_length(log);
    let cursor = cursor.unwrap_or(count).min(count.saturating_sub(1));
    let title = title(state, log, cursor, panel);
    let inner = panel.boxed(&title, Role::Accent, buffer);
    if count == 0 {
        let text = panel.say("fly-nothing-yet");
        let line = Line::styled(text, panel.style(Role::Muted));
        put(buffer, inner, 0, &line);
        return;
    }
    let rows = usize::from(inner.height);
    // Every entry has at least one line: only this many on either side can be visible.
    let near = cursor.saturating_sub(rows)..(cursor + rows + 1).min(count);
    let blocks = blocks(
        state,
        log,
        near.clone(),
        usize::from(inner.width),
        panel.look,
    );
    let window = LogWindow::around(cursor - near.start, blocks, rows);
    window.draw(panel.at(inner), buffer);
    // Only the lines near the cursor were created.
    let above = near.start + window.first;
    let below = window.lines.len() - window.first + count.saturating_sub(near.end);
    panel.at(inner).mark_scroll(above, above + below, buffer);
}

fn title(state: &State, log: Log, cursor: usize, panel: Panel<'_>) -> String {
    let count = state.log_length(log);
    let name = match log {
        Log::Notices => panel.say("fly-notices"),
        Log::Traffic => panel.say("traffic-title"),
        Log::Moments if state.replay().is_some_and(|it| !it.clock.is_empty()) => {
            panel.say("replay-moments-mission")
        }
        Log::Moments => panel.say("replay-moments"),
    };
    let place = if count == 0 {
        String::new()
    } else {
        let text = text!("fly-place", at = cursor + 1, count = count);
        format!("{}   ", panel.text(&text))
    };
    let keys = text!(
        "fly-log-keys",
        scroll = state.keymap().keys(Action::UP_AND_DOWN, Place::Reader),
        key = state.keymap().key(Action::Escape, Place::Reader)
    );
    format!("{name}   {place}{}", panel.text(&keys))
}

/// The lines near the cursor, and which of them are shown.
struct LogWindow<'a> {
    lines: Vec<Line<'a>>,
    /// The lines of the entry under the cursor.
    marked: Range<usize>,
    first: usize,
}

impl<'a> LogWindow<'a> {
    /// A window of this many rows that keeps the entry under the cursor in the centre, as far as
    /// the list allows.
    fn around(cursor: usize, blocks: Vec<Vec<Line<'a>>>, rows: usize) -> Self {
        let above: usize = blocks.iter().take(cursor).map(Vec::len).sum();
        let marked = above..above + blocks.get(cursor).map_or(0, Vec::len);
        let lines: Vec<Line<'a>> = blocks.into_iter().flatten().collect();
        let first = marked
            .start
            .saturating_sub(rows / 2)
            .min(lines.len().saturating_sub(rows));
        Self {
            lines,
            marked,
            first,
        }
    }

    fn draw(&self, panel: Panel<'_>, buffer: &mut Buffer) {
        let inner = panel.area;
        let shown = self.lines.iter().enumerate().skip(self.first);
        for (row, (at, line)) in shown.take(usize::from(inner.height)).enumerate() {
            put(buffer, inner, row as u16, line);
            if self.marked.contains(&at) {
                panel.at(row_of(inner, row as u16)).mark_cursor(buffer);
            }
            if at == self.marked.start {
                // A mark that is visible without colour, in the free column beside the frame.
                let margin = Rect {
                    x: inner.x.saturating_sub(1),
                    ..inner
                };
                put(buffer, margin, row as u16, &Line::raw(">"));
            }
        }
    }
}

fn blocks<'a>(
    state: &State,
    log: Log,
    which: Range<usize>,
    width: usize,
    look: &Look,
) -> Vec<Vec<Line<'a>>> {
    let session = state.session();
    let count = which.len();
    match log {
        Log::Notices => {
            let notices = state.notices().lines().skip(which.start).take(count);
            notices
                .map(|notice| notices::lines(notice, session, width, usize::MAX, look))
                .collect()
        }
        Log::Traffic => {
            let tracked = session.traffic().tracked().iter();
            let tracked = tracked.skip(which.start).take(count);
            tracked
                .map(|it| traffic::lines(it, state.now(), width, look))
                .collect()
        }
        Log::Moments => {
            let Some(view) = state.replay() else {
                return Vec::new();
            };
            let moments = view.moments.iter().skip(which.start).take(count);
            moments
                .map(|moment| {
                    let time = replay::both_times(view, moment.at);
                    replay::moment_lines(&time, moment, width, look)
                })
                .collect()
        }
    }
}
