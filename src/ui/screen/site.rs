//! The site of a mission and its figures: a sketch of its area beside par, wind and the best score.

use ratatui::buffer::Buffer;
use ratatui::text::{Line, Span};

use crate::app::State;
use crate::mission::Listing;
use crate::scoring::Medal;
use crate::text;
use crate::text::Text;
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::map::draw_site;
use crate::ui::widget::{aligned, clip, clock, put, width};

/// The number of rows that a readable sketch needs.
pub(super) const SITE_ROWS: u16 = 12;
/// The width of the figures at the right, in columns.
const FIGURES: u16 = 30;
/// The maximum width of the sketch, in columns.
const SKETCH: u16 = 72;

/// Draws the sketch and the figures below one rule.
pub(super) fn draw(state: &State, mission: &Listing, panel: Panel<'_>, buffer: &mut Buffer) {
    let inner = panel.titled(&panel.say("home-site"), buffer);
    let sketch = inner.width.saturating_sub(FIGURES + 1).min(SKETCH);
    let inner = panel.at(inner);
    let is_drawn = draw_site(mission, inner.columns(0, sketch), buffer);
    let from = if is_drawn { sketch + 2 } else { 0 };
    draw_figures(state, mission, inner.columns(from, FIGURES), buffer);
}

fn draw_figures(state: &State, mission: &Listing, panel: Panel<'_>, buffer: &mut Buffer) {
    let energy = text!("home-energy", wh = format!("{:.1}", mission.par_energy_wh));
    let rows = [
        ("home-par", clock(mission.par_time).into()),
        ("home-limit", clock(mission.time_limit).into()),
        ("home-par-energy", energy),
        ("home-wind", mission.wind()),
        ("home-drones", mission.vehicles.to_string().into()),
        ("home-best-so-far", best(state, mission)),
    ];
    let names = rows.each_ref().map(|(name, _)| panel.say(name));
    let indent = names.iter().map(|name| width(name)).max().unwrap_or(0) + 2;
    for (row, (name, (_, what))) in names.iter().zip(&rows).enumerate() {
        let room = panel.width().saturating_sub(indent);
        let line = Line::from(vec![
            Span::styled(aligned(name, indent, false), panel.style(Role::Muted)),
            Span::raw(clip(&panel.text(what), room)),
        ]);
        put(buffer, panel.area, row as u16, &line);
    }
}

/// The best score with its medal: from the career, otherwise from the records.
fn best(state: &State, mission: &Listing) -> Text {
    let career = state.training().career();
    let counted = career.and_then(|career| career.standing.best(&mission.id));
    let (score, medal) = match (counted, state.training().best_try(&mission.id)) {
        (Some(best), _) => (best.score, best.medal),
        (None, Some(best)) if career.is_none() => (best.score, best.medal),
        _ => (None, None),
    };
    let Some(score) = score else {
        return text!("home-never-flown");
    };
    let medal = medal.map_or(text!("debrief-no-medal"), Medal::title);
    text!("home-best-is", score = score, medal = medal)
}
