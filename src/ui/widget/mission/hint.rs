//! The advice of a mission: the step of its lesson, its running hint, or the hint that was asked for.

use ratatui::buffer::Buffer;
use ratatui::text::Line;

use crate::mission::Progress;
use crate::text;
use crate::text::Text;
use crate::ui::look::Look;
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::{clip_rows, put, wrap};

/// Draws the hint, with a mark if it is cut.
pub(super) fn draw_hint(lines: Vec<String>, panel: Panel<'_>, buffer: &mut Buffer) {
    let shown = clip_rows(lines, usize::from(panel.area.height), panel.width());
    for (row, line) in (0..).zip(shown) {
        let line = Line::styled(line, panel.style(Role::Accent));
        put(buffer, panel.area, row, &line);
    }
}

/// The number of rows that show the whole hint below the pane's title; 0 without a hint.
pub fn hint_height(progress: &Progress, width: u16, look: &Look) -> u16 {
    match hint_lines(progress, usize::from(width), look).len() {
        0 => 0,
        lines => lines as u16 + 1,
    }
}

/// The advice, wrapped: the requested hint, until there is new automatic advice.
pub fn hint_lines(progress: &Progress, width: usize, look: &Look) -> Vec<String> {
    let asked_for = progress.clues.given.last();
    let given =
        asked_for.map(|(level, hint)| text!("mission-hint-of", level = *level, hint = hint));
    let own = progress.hint.as_ref();
    let hint = own.map(|hint| text!("mission-hint", hint = hint));
    let running = lesson(progress).or(hint);
    let shown = if progress.clues.is_news {
        given.or(running)
    } else {
        running
    };
    let lines = shown.map(|text| wrap(&look.text(&text), width));
    lines.unwrap_or_default()
}

/// The step of the lesson, if there is one.
pub fn lesson(progress: &Progress) -> Option<Text> {
    let step = progress.lesson.as_ref()?;
    Some(text!("mission-lesson", step = &step.text))
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use ratatui::layout::Rect;

    use super::*;
    use crate::commands::Deed;
    use crate::ledger::EntryId;
    use crate::mission::{Flight, Mission};

    const LINE_INSPECTION: &str = include_str!("../../../../missions/04-line-inspection.toml");

    /// Advice that is no longer shown to a practised trainee leaves no room for an old hint.
    #[test]
    fn a_requested_hint_disappears_when_the_advice_changes() {
        let mission = Mission::parse(LINE_INSPECTION).expect("it is good");
        let mut flight = Flight::new(Arc::new(mission), 1);
        flight.act(EntryId(0), &Deed::Hint, &[1]);
        let mut progress = flight.progress();
        progress.hint = None;
        let shown = |progress: &Progress| hint_lines(progress, 200, &Look::default());
        assert!(shown(&progress)[0].starts_with("hint 1: "));
        progress.clues.is_news = false;
        assert!(shown(&progress).is_empty(), "{:?}", shown(&progress));
    }

    #[test]
    fn a_hint_that_is_cut_says_so() {
        let (look, area) = (Look::default(), Rect::new(0, 0, 12, 2));
        let drawn = |lines: &[&str]| {
            let mut buffer = Buffer::empty(area);
            let lines: Vec<String> = lines.iter().map(ToString::to_string).collect();
            draw_hint(lines, Panel::new(&look, area), &mut buffer);
            let row = |y| (0..12).map(|x| buffer[(x, y)].symbol()).collect::<String>();
            [row(0).trim_end().to_owned(), row(1).trim_end().to_owned()]
        };
        assert_eq!(drawn(&["one", "two"]), ["one", "two"]);
        assert_eq!(drawn(&["one", "two", "three"]), ["one", "two …"]);
    }
}
