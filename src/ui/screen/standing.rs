//! The trainee's progress: skills and why they changed, scores by mission, credits and experience.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};

use crate::app::State;
use crate::app::action::Action;
use crate::app::room::standing::{Pane, shows_all};
use crate::app::state::Career;
use crate::campaign::VehicleProgress;
use crate::text;
use crate::text::Text;
use crate::ui::look::Look;
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::{below, columns, put, upper, wrap};

mod scores;
mod skills;
mod wealth;

/// The number of rows of credits and experience on a screen that shows everything.
const WEALTH_ROWS: u16 = 12;

struct StandingSubject<'a> {
    state: &'a State,
    career: &'a Career,
    look: &'a Look,
}

/// Draws the summary and the chosen pane, or all panes if there is room.
pub fn draw(state: &State, panel: Panel<'_>, buffer: &mut Buffer) {
    let Some(career) = state.training().career() else {
        return draw_nobody(state, panel, buffer);
    };
    let subject = StandingSubject {
        state,
        career,
        look: panel.look,
    };
    draw_summary(&subject, panel.area, buffer);
    let panel = panel.below(3);
    let (width, height) = state.display().size();
    if !shows_all(width, height) && !shows_all(panel.area.width, panel.area.height + 5) {
        match state.rooms().standing().pane() {
            Pane::Skills => skills::draw(&subject, panel.area, buffer),
            Pane::Scores => scores::draw(&subject, panel.area, buffer),
            Pane::Wealth => wealth::draw(&subject, panel.area, buffer),
        }
        return;
    }
    let top = upper(
        panel.area,
        panel.area.height.saturating_sub(WEALTH_ROWS + 1),
    );
    let half = panel.area.width / 2;
    let left = columns(top, 0, half.saturating_sub(1));
    skills::draw(&subject, left, buffer);
    scores::draw(&subject, columns(top, half + 1, panel.area.width), buffer);
    wealth::draw(&subject, below(panel.area, top.height + 1), buffer);
}

fn draw_nobody(state: &State, panel: Panel<'_>, buffer: &mut Buffer) {
    let text = panel.text(&text!(
        "standing-no-profile",
        key = state.key(Action::Profiles)
    ));
    let lines = wrap(
        &text,
        usize::from(panel.area.width.saturating_sub(2)).min(80),
    );
    for (row, line) in lines.into_iter().enumerate() {
        let line = Line::styled(format!(" {line}"), panel.style(Role::Muted));
        put(buffer, below(panel.area, 1), row as u16, &line);
    }
}

/// Draws name, level, credits, licence, level of automatic advice, and the kinds of vehicles.
fn draw_summary(subject: &StandingSubject<'_>, area: Rect, buffer: &mut Buffer) {
    let look = subject.look;
    let standing = &subject.career.standing;
    let (experience, level, needed) = standing.experience();
    let parts = [
        text!("standing-level", level = level),
        text!(
            "standing-experience",
            experience = experience,
            needed = needed
        ),
        text!("standing-credits", credits = standing.credits()),
        text!("standing-licence", count = standing.licence()),
        text!("standing-flights", count = standing.flights()),
    ];
    let name = crate::notice::sanitised(&subject.career.name);
    let line = Line::from(vec![
        Span::styled(format!(" {name}"), look.style(Role::Title)),
        Span::raw(format!(
            "   {}",
            look.text(&Text::joined("   ", parts.to_vec()))
        )),
    ]);
    put(buffer, area, 0, &line);
    let key = look.text(&subject.state.key(Action::Aids));
    let aids = Line::from(vec![
        Span::raw(format!(" {}", look.text(&subject.career.aids.explained()))),
        Span::styled(format!("   {key}"), look.style(Role::Key)),
        Span::styled(
            format!(" {}", look.say("standing-aids-key")),
            look.style(Role::Muted),
        ),
    ]);
    put(buffer, area, 1, &aids);
    let kinds = VehicleProgress::all(standing, &subject.career.course);
    let kinds = look.text(&VehicleProgress::line(&kinds));
    let kinds = Line::styled(format!(" {kinds}"), look.style(Role::Muted));
    put(buffer, area, 2, &kinds);
}

impl StandingSubject<'_> {
    /// Draws a pane's rule with its title; the rule is heavy for the pane with the cursor.
    fn pane(&self, pane: Pane, title: &str, area: Rect, buffer: &mut Buffer) -> Rect {
        Panel::new(self.look, area).focused(title, self.has_cursor(pane), buffer)
    }

    fn has_cursor(&self, pane: Pane) -> bool {
        self.state.rooms().standing().pane() == pane
    }
}

/// A day relative to today: today, in a number of days, or that number of days ago.
fn days(from_today: i64) -> Text {
    match from_today {
        0 => text!("days-today"),
        1.. => text!("days-ahead", count = from_today),
        _ => text!("days-ago", count = -from_today),
    }
}
