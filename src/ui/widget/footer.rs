//! The last line: the text being typed, otherwise a message, otherwise the key hints.

use ratatui::buffer::Buffer;
use ratatui::text::{Line, Span};

use crate::app::State;
use crate::app::action::Action;
use crate::app::keymap::{HintKeys, KeyHint, Place};
use crate::app::room;
use crate::app::state::ReplayView;
use crate::text;
use crate::text::Text;
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::{below, clip, put, replay, row_of, severity_role, width as width_of, wrap};

/// The maximum number of rows of a message.
const MOST_ROWS: usize = 3;

/// The columns between two key hints.
const GAP: usize = 2;

/// Draws the footer into the last row of the screen. A longer message also takes rows above it; the timeline of a replay
/// stays in the last row, below the keys of rooms that are used apart from the flight.
pub fn draw(state: &State, panel: Panel<'_>, buffer: &mut Buffer) {
    let row = below(panel.area, panel.area.height.saturating_sub(1));
    let mut lines = match (message(state, panel), recorded(state)) {
        (None, _) => vec![line(state, panel.at(row))],
        (Some(lines), None) => lines,
        (Some(lines), Some(view)) => with_timeline(state, view, lines, panel.at(row)),
    };
    if state.has_keys_above_replay() && lines.len() == 1 {
        let above = row_of(panel.area, panel.area.height.saturating_sub(2));
        lines.insert(0, hints(state, room::hints(state), panel.at(above)));
    }
    let first = panel.area.height.saturating_sub(lines.len() as u16);
    let place = panel.below(first);
    place.clear(buffer);
    for (row, line) in lines.iter().enumerate() {
        put(buffer, place.area, row as u16, line);
    }
}

/// The number of rows of the footer below a room of the panel's width; the timeline of a replay may take one more.
pub fn height(state: &State, panel: Panel<'_>) -> u16 {
    message(state, panel).map_or(1, |lines| lines.len() as u16)
}

/// A message beside the timeline of a replay, or above it if there is no room.
fn with_timeline<'a>(
    state: &State,
    view: &ReplayView,
    mut lines: Vec<Line<'a>>,
    panel: Panel<'_>,
) -> Vec<Line<'a>> {
    if let [message] = &lines[..]
        && let Some(bar) = replay::bar_beside(state, view, message, panel)
    {
        return vec![bar];
    }
    lines.push(replay::bar(state, view, panel));
    lines
}

/// A text in at most `MOST_ROWS` rows; the last one is cut if necessary.
fn rows(text: &str, width: usize) -> Vec<String> {
    let mut rows = wrap(text, width);
    if rows.len() > MOST_ROWS {
        let rest = rows.split_off(MOST_ROWS - 1).join(" ");
        rows.push(clip(&rest, width));
    }
    rows
}

/// The lines of the message; `None` if there is none, or the footer shows something else.
fn message(state: &State, panel: Panel<'_>) -> Option<Vec<Line<'static>>> {
    if !state.typing().targets().is_empty() || state.is_deaf() {
        return None;
    }
    let message = state.message()?;
    let style = panel.style(severity_role(message.severity));
    let lines = rows(&panel.text(&message.text), panel.width().saturating_sub(2));
    let drawn = |line: &String| Line::styled(format!(" {line}"), style);
    Some(lines.iter().map(drawn).collect())
}

fn line<'a>(state: &'a State, panel: Panel<'_>) -> Line<'a> {
    let look = panel.look;
    let muted = |text: String| Span::styled(text, look.style(Role::Muted));
    if !state.typing().targets().is_empty() {
        return Line::from(vec![
            muted(format!(" {} ", look.say("footer-vehicles"))),
            Span::styled(state.typing().targets(), look.style(Role::Selected)),
            muted(format!("_  {}", look.text(&list_keys(state)))),
        ]);
    }
    if state.is_deaf() {
        return Line::from(muted(format!(" {}", look.say("footer-deaf"))));
    }
    if let Some(view) = recorded(state) {
        return replay::bar(state, view, panel);
    }
    if let Some(text) = awaited(state) {
        return Line::from(muted(format!(" {}", look.text(&text))));
    }
    hints(state, room::hints(state), panel)
}

/// The flight of the past that is shown, if any: it has a timeline.
fn recorded(state: &State) -> Option<&ReplayView> {
    state.replay().filter(|view| !view.is_live)
}

/// What a member of a crew waits for, before it sees a flight.
fn awaited(state: &State) -> Option<Text> {
    let place = state.crew().member()?;
    let is_waiting = state.session().activity().is_none();
    is_waiting.then(|| place.awaited())
}

/// Keys with their meaning, as far as there is room.
pub fn hints<'a>(
    state: &State,
    hints: impl IntoIterator<Item = KeyHint>,
    panel: Panel<'_>,
) -> Line<'a> {
    let (look, width) = (panel.look, panel.width());
    let mut spans = vec![Span::raw(" ")];
    let mut used = 1;
    for hint in hints {
        let place = Place::In(state.room());
        let is_open = |line: &str| state.may_write(line);
        let Some(key) = state.keymap().open_label(hint.keys, place, is_open) else {
            continue;
        };
        let key = look.key(&key);
        let what = look.say(hint.about);
        let from = used;
        used += width_of(&key) + width_of(&what) + 1 + GAP;
        if used - GAP > width {
            break;
        }
        if let HintKeys::Actions([action]) = hint.keys {
            let place = panel.columns(from as u16, (used - from - GAP) as u16);
            look.hits.add(place.area, *action);
        }
        spans.push(Span::styled(key, look.style(Role::Key)));
        spans.push(Span::styled(format!(" {what}  "), look.style(Role::Muted)));
    }
    Line::from(spans)
}

/// The actions for the vehicle list being typed.
fn list_keys(state: &State) -> Text {
    let commands = state.keymap().command_labels(Place::In(state.room()));
    text!(
        "footer-list",
        submit = state.key(Action::Submit),
        commands = commands.join(" "),
        escape = state.key(Action::Escape)
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_message_takes_up_to_three_rows() {
        assert_eq!(rows("aaaaa", 5), ["aaaaa"]);
        assert_eq!(rows("aaaaa bbbbb", 5), ["aaaaa", "bbbbb"]);
        assert_eq!(
            rows("aaaaa bbbbb ccccc ddddd", 5),
            ["aaaaa", "bbbbb", "cccc…"]
        );
    }
}
