//! The scale bar, the north mark, and what the signs mean.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};

use super::ground::{RULER, TARGET, TRAIL, stroke};
use super::markers::arrow;
use crate::app::room::map::SketchKind::{Fence, KeepOut, Plan, Rally, Task};
use crate::app::room::map::sketches;
use crate::app::state::State;
use crate::geo::{Viewport, scale_bar};
use crate::ui::look::Look;
use crate::ui::theme::Role;
use crate::ui::widget::{boxed, put, upper};

/// Columns of the scale bar at most.
const LONGEST_BAR: u16 = 24;
/// Columns of the signs in the legend.
const SIGN_WIDTH: usize = 5;

/// Draws a bar of a round length into the lower left corner, and north into the upper right one.
pub fn draw_scale(look: &Look, view: &Viewport, area: Rect, buffer: &mut Buffer) {
    let (length_m, columns) = scale_bar(view.zoom, LONGEST_BAR.min(area.width / 4));
    let line = "─".repeat(usize::from(columns).saturating_sub(2));
    let bar = Line::from(vec![
        Span::styled(format!("├{line}┤"), look.style(Role::Muted)),
        Span::styled(format!(" {} ", length(length_m)), look.style(Role::Text)),
    ]);
    put(buffer, area, area.height.saturating_sub(1), &bar);
    let north = format!(" N{}", arrow(0.0, look.symbols));
    let corner = Rect {
        x: area.right().saturating_sub(3),
        width: 3.min(area.width),
        ..area
    };
    put(
        buffer,
        corner,
        0,
        &Line::styled(north, look.style(Role::Text)),
    );
}

/// A length in words: metres, or kilometres from one on.
pub fn length(metres: f64) -> String {
    match metres {
        metres if metres >= 100_000.0 => format!("{:.0} km", metres / 1000.0),
        metres if metres >= 1000.0 => {
            let km = format!("{:.1}", metres / 1000.0);
            format!("{} km", km.strip_suffix(".0").unwrap_or(&km))
        }
        metres if metres >= 10.0 || metres.fract() == 0.0 => format!("{metres:.0} m"),
        metres => format!("{metres:.1} m"),
    }
}

/// Explains the signs, those that are on the map.
pub fn draw(state: &State, look: &Look, area: Rect, buffer: &mut Buffer) {
    let lines = lines(state, look);
    let inner = boxed(
        &look.say("map-legend"),
        Role::Border,
        look,
        upper(area, lines.len() as u16 + 2),
        buffer,
    );
    for (row, line) in lines.iter().enumerate() {
        put(buffer, inner, row as u16, line);
    }
}

fn lines(state: &State, look: &Look) -> Vec<Line<'static>> {
    let session = &state.session;
    let symbols = look.symbols;
    let sketches = sketches(state);
    let has = |kind| sketches.iter().any(|sketch| sketch.kind == kind);
    let trails = !state.rooms.map.trails_hidden && !state.rooms.map.trails.is_empty();
    let targets = session.vehicles.values().any(|it| it.target.is_some());
    let row = |shown: bool, sign: String, role, id: &str| {
        shown.then(|| {
            Line::from(vec![
                Span::styled(format!("{sign:SIGN_WIDTH$} "), look.style(role)),
                Span::raw(look.say(id)),
            ])
        })
    };
    let sample = |stroke: super::canvas::Stroke| (stroke.sample(symbols), stroke.role);
    let line = |shown, stroke, id| {
        let (sign, role) = sample(stroke);
        row(shown, sign, role, id)
    };
    let armed = arrow(45.0, symbols).to_string();
    [
        row(true, armed, Role::Text, "map-legend-armed"),
        row(true, "o".to_owned(), Role::Muted, "map-legend-disarmed"),
        row(true, "?".to_owned(), Role::Danger, "map-legend-lost"),
        row(true, "[3]".to_owned(), Role::Cursor, "map-legend-cursor"),
        row(true, "3*".to_owned(), Role::Selected, "map-legend-selected"),
        row(true, "3!".to_owned(), Role::Warning, "map-legend-alert"),
        row(true, "(4)".to_owned(), Role::Text, "map-legend-several"),
        row(true, "H".to_owned(), Role::Title, "map-legend-home"),
        line(trails, TRAIL, "map-legend-trail"),
        line(targets, TARGET, "map-legend-target"),
        line(has(Task), stroke(Task), "map-legend-task"),
        line(has(Fence), stroke(Fence), "map-legend-fence"),
        line(has(KeepOut), stroke(KeepOut), "map-legend-keep-out"),
        line(has(Plan), stroke(Plan), "map-legend-plan"),
        row(has(Rally), "R1".to_owned(), Role::Title, "map-legend-rally"),
        line(state.rooms.map.mark.is_some(), RULER, "map-legend-ruler"),
    ]
    .into_iter()
    .flatten()
    .collect()
}
