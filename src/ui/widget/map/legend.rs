//! The scale bar, the north mark, and the legend.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};

use super::canvas::Stroke;
use super::ground::{KEEP_OUT, RULER, is_seen, next_place, next_sign, stroke};
use super::labels::blank;
use super::markers::{LOST, arrow, tally};
use super::ways::{GHOST, target, trail};
use super::{finds, fire, swept, traffic};
use crate::app::State;
use crate::app::room::map::SketchKind::{
    Course, Fence, Jamming, KeepOut, Leg, Meeting, NoFly, People, Plan, Radio, Rally, Task, Wire,
};
use crate::app::room::map::{PAUSED, Sketch, leg, shows_leg, sketches};
use crate::geo::{LatLon, Viewport, scale_bar};
use crate::ui::look::Look;
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::{clip, put, width};
use crate::vehicle::VehicleId;

/// The maximum width of the scale bar, in columns.
const LONGEST_BAR: u16 = 24;
/// The vehicle whose colour the legend shows.
const FIRST: VehicleId = 1;
/// The width of the signs in the legend, in columns.
const SIGN_WIDTH: usize = 5;

/// Draws a bar of a round length in the lower left corner, and the north mark in the upper right one.
pub fn draw_scale(look: &Look, view: &Viewport, area: Rect, buffer: &mut Buffer) {
    let (length_m, columns) = scale_bar(view.zoom, LONGEST_BAR.min(area.width / 4));
    let line = "─".repeat(usize::from(columns).saturating_sub(2));
    let bar = Line::from(vec![
        Span::styled(format!("├{line}┤"), look.style(Role::Muted)),
        Span::styled(format!(" {} ", length(length_m)), look.style(Role::Text)),
    ]);
    let corner = Rect {
        y: area.bottom().saturating_sub(1),
        width: (bar.width() as u16).min(area.width),
        height: 1.min(area.height),
        ..area
    };
    blank(Panel::new(look, corner), buffer);
    put(buffer, corner, 0, &bar);
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

/// A length as text: in metres below 1 km, otherwise in kilometres.
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

/// Draws the legend with the signs that are in the map's view.
pub fn draw(state: &State, view: Option<&Viewport>, panel: Panel<'_>, buffer: &mut Buffer) {
    let rows = rows(state, view, panel.look);
    let inner =
        panel
            .upper(rows.len() as u16 + 2)
            .boxed(&panel.say("map-legend"), Role::Border, buffer);
    let room = usize::from(inner.width).saturating_sub(SIGN_WIDTH + 1);
    let height = usize::from(inner.height);
    let is_cut = rows.len() > height;
    let shown = if is_cut {
        height.saturating_sub(1)
    } else {
        height
    };
    for (row, entry) in (0..).zip(rows.into_iter().take(shown)) {
        put(buffer, inner, row, &entry.line(room, panel.look));
    }
    if is_cut {
        put(buffer, inner, shown as u16, &Line::raw("…"));
    }
}

/// A sign, its role, and the message with its meaning.
struct LegendRow {
    sign: String,
    role: Role,
    meaning: &'static str,
}

impl From<(String, Role, &'static str)> for LegendRow {
    fn from((sign, role, meaning): (String, Role, &'static str)) -> Self {
        Self {
            sign,
            role,
            meaning,
        }
    }
}

impl LegendRow {
    /// The line with this many columns for the meaning.
    fn line(self, room: usize, look: &Look) -> Line<'static> {
        // Blanks without the sign's style: reversed, every sign would be the same block.
        let blanks = " ".repeat((SIGN_WIDTH + 1).saturating_sub(width(&self.sign)));
        Line::from(vec![
            Span::styled(self.sign, look.style(self.role)),
            Span::raw(blanks),
            Span::raw(clip(&look.say(self.meaning), room)),
        ])
    }
}

fn rows(state: &State, view: Option<&Viewport>, look: &Look) -> Vec<LegendRow> {
    let seen = seen(state, view);
    let signs = [
        (
            arrow(45.0, look.symbols).into(),
            trail(FIRST).role,
            "map-legend-armed",
        ),
        ("o".to_owned(), Role::Muted, "map-legend-disarmed"),
        (LOST.into(), Role::Danger, "map-legend-lost"),
        ("[3]".to_owned(), Role::Cursor, "map-legend-cursor"),
        ("[3+2]".to_owned(), Role::Cursor, "map-legend-hidden"),
        ("3*".to_owned(), Role::Selected, "map-legend-selected"),
        ("3!".to_owned(), Role::Warning, "map-legend-alert"),
        ("3!".to_owned(), Role::Danger, "map-legend-critical"),
        (tally(4), Role::Text, "map-legend-several"),
        ("H".to_owned(), Role::Title, "map-legend-home"),
        ("┼".to_owned(), Role::Cursor, "map-legend-pointer"),
    ];
    let finds = finds::SIGNS
        .iter()
        .filter(|(trust, ..)| finds::has(state, *trust))
        .map(|(_, sign, role, id)| (format!("{sign}c1"), *role, *id));
    let mission = state.session().mission();
    let movers = mission
        .filter(|it| !it.movers.is_empty())
        .map(|_| ("P U".to_owned(), Role::Danger, "map-legend-movers"));
    let aircraft = (!state.session().traffic().is_empty()).then(|| {
        (
            traffic::sample(look.symbols),
            Role::Warning,
            "map-legend-traffic",
        )
    });
    let mut vehicles = state.session().vehicles().values();
    let pause = vehicles
        .any(|vehicle| vehicle.has_paused())
        .then(|| (PAUSED.to_owned(), Role::Warning, "map-legend-paused"));
    let strokes = strokes(state, &seen)
        .into_iter()
        .filter(|(shown, ..)| *shown)
        .map(|(_, stroke, id)| (stroke.sample(look.symbols), stroke.role, id));
    signs
        .into_iter()
        .chain(finds)
        .chain(movers)
        .chain(aircraft)
        .chain(pause)
        .chain(places(state, view, look))
        .chain(shades(state, look))
        .chain(keep_out(&seen, look))
        .chain(strokes)
        .map(LegendRow::from)
        .collect()
}

/// The signs of the named places in view; the next one to go to has its own.
fn places(
    state: &State,
    view: Option<&Viewport>,
    look: &Look,
) -> Vec<(String, Role, &'static str)> {
    let next = next_place(state);
    let is_in_view = |place: LatLon| view.is_none_or(|view| view.cell(place).is_some());
    let mut others = state.session().places().values();
    let has_others = others.any(|&place| Some(place) != next && is_in_view(place));
    let rows = [
        (has_others, ("+".to_owned(), Role::Info, "map-legend-place")),
        (
            next.is_some_and(is_in_view),
            (
                next_sign(look.symbols).to_owned(),
                Role::Key,
                "map-legend-next",
            ),
        ),
    ];
    let shown = rows.into_iter().filter(|(shown, _)| *shown);
    shown.map(|(_, row)| row).collect()
}

/// The lines and places of which the view shows a part; without a view, all.
fn seen(state: &State, view: Option<&Viewport>) -> Vec<Sketch> {
    let mut sketches = sketches(state);
    sketches.retain(|sketch| view.is_none_or(|view| is_seen(sketch, view)));
    sketches
}

/// The border of an area to stay out of and the sign inside, if the map has such an area.
fn keep_out(seen: &[Sketch], look: &Look) -> Option<(String, Role, &'static str)> {
    let is_any = seen.iter().any(|it| it.kind == KeepOut);
    let border = stroke(KeepOut);
    let end: String = border.sample(look.symbols).chars().take(2).collect();
    let sign = format!("{end}{KEEP_OUT}{end}");
    is_any.then_some((sign, border.role, "map-legend-keep-out"))
}

fn shades(state: &State, look: &Look) -> Vec<(String, Role, &'static str)> {
    let swept = swept::sign(look.symbols).to_string().repeat(3);
    let fire = fire::sample(look.symbols);
    let shades = [
        (
            swept::is_any(state),
            (swept, swept::ROLE, "map-legend-swept"),
        ),
        (
            fire::is_any(state),
            (fire, fire::role(look), "map-legend-fire"),
        ),
    ];
    let shown = shades.into_iter().filter(|(shown, _)| *shown);
    shown.map(|(_, row)| row).collect()
}

/// The kinds of lines, and whether there are any on the map.
fn strokes(state: &State, seen: &[Sketch]) -> [(bool, Stroke, &'static str); 16] {
    let map = state.rooms().map();
    let has = |kind| seen.iter().any(|sketch| sketch.kind == kind);
    // The colours are those of the vehicles, as with trails.
    let plan = |kind| stroke(kind).with_role(trail(FIRST).role);
    let trails = !map.hides_trails() && !map.trails().is_empty();
    let mut vehicles = state.session().vehicles().values();
    let ghost = state.ghost_time().is_some();
    let targets = vehicles.any(|vehicle| leg(vehicle).is_some() && !shows_leg(state, vehicle));
    [
        (trails, trail(FIRST), "map-legend-trail"),
        (targets, target(FIRST), "map-legend-target"),
        (ghost, GHOST, "map-legend-ghost"),
        (has(Task), stroke(Task), "map-legend-task"),
        (has(Fence), stroke(Fence), "map-legend-fence"),
        (has(NoFly), stroke(NoFly), "map-legend-no-fly"),
        (has(Jamming), stroke(Jamming), "map-legend-jamming"),
        (has(People), stroke(People), "map-legend-people"),
        (has(Radio), stroke(Radio), "map-legend-radio"),
        (has(Wire), stroke(Wire), "map-legend-wire"),
        (has(Plan), plan(Plan), "map-legend-plan"),
        (has(Leg), plan(Leg), "map-legend-leg"),
        (has(Rally), stroke(Rally), "map-legend-rally"),
        (has(Course), stroke(Course), "map-legend-course"),
        (has(Meeting), stroke(Meeting), "map-legend-meeting"),
        (map.mark().is_some(), RULER, "map-legend-ruler"),
    ]
}
