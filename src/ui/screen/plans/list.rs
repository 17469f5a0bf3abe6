//! The items of a list: a line for each.

use std::time::Duration;

use ratatui::buffer::Buffer;
use ratatui::text::{Line, Span};

use super::Shown;
use crate::draft::{PlanFrame, Stop, place};
use crate::geo::LatLon;
use crate::language::Unit;
use crate::plan::check::{Finding, Severity};
use crate::plan::{Item, ListKind, command, field};
use crate::text::{figure, lasting};
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::map::length;
use crate::ui::widget::{aligned, put, row_of};

/// The widths of the parts of a line, in columns.
const NUMBER: usize = 3;
const WORD: usize = 10;
const PLACE: usize = 15;
const HEIGHT: usize = 5;
const LEG: usize = 8;
const SLOPE: usize = 6;
const TIME: usize = 7;
/// The minimum width of a line that shows the leg, and of one that also shows the parameters, in
/// columns.
const WITH_LEG: usize = 58;
const WITH_PARAMETERS: usize = 90;
/// The width of everything but the parameters, in columns.
const USED: usize = 67;
const LONGEST_S: f64 = 359_999.0;

/// Draws the heading and as many lines around the cursor as fit.
pub(super) fn draw(shown: &Shown<'_>, panel: Panel<'_>, buffer: &mut Buffer) {
    put(
        buffer,
        panel.area,
        0,
        &Line::styled(heading(shown.room.list(), panel), panel.style(Role::Muted)),
    );
    let list = panel.below(1);
    let items = shown.room.items();
    let at = shown.room.row().unwrap_or(0);
    let visible = usize::from(list.area.height);
    let most = items.len().saturating_sub(visible);
    let top = at.saturating_sub(visible / 2).min(most);
    for (row, (index, item)) in (0..).zip(items.iter().enumerate().skip(top).take(visible)) {
        let place = row_of(list.area, row);
        put(buffer, place, 0, &line(shown, index, item, panel));
        if index == at {
            // A mark of a range stays in its column.
            if buffer[(place.x, place.y)].symbol() == " " {
                put(buffer, place, 0, &Line::raw(">"));
            }
            list.at(place).mark_cursor(buffer);
        }
    }
    list.mark_list(top, items.len(), true, buffer);
}

/// The names of the columns; only items of a plan have legs.
fn heading(list: ListKind, panel: Panel<'_>) -> String {
    let word = |id, columns, right| aligned(&panel.say(id), columns, right);
    let mut heading = format!(
        "    # {} {} {}",
        word("plans-column-command", WORD, false),
        word("plans-column-place", PLACE, false),
        word("plans-column-height", HEIGHT, true),
    );
    if list == ListKind::Plan && panel.width() >= WITH_LEG {
        heading.extend([
            "   ".to_owned(),
            word("plans-column-leg", LEG, true),
            word("plans-column-slope", SLOPE, true),
        ]);
    }
    if list == ListKind::Plan && panel.width() >= WITH_PARAMETERS {
        heading.push_str(&word("plans-column-time", TIME, true));
        heading.push_str("  ");
        heading.push_str(&panel.say("plans-column-parameters"));
    }
    heading
}

fn line(shown: &Shown<'_>, index: usize, item: &Item, panel: Panel<'_>) -> Line<'static> {
    let is_marked = shown.room.is_marking()
        && shown
            .room
            .marked()
            .is_some_and(|it| (it.first..=it.last).contains(&(index + 1)));
    let (fault, role) = fault(shown, index);
    let home = shown.document.home;
    let home = home.map(|home| LatLon::from_e7(home.x, home.y));
    let word = field::word(item.command).map_or_else(|| item.command.to_string(), str::to_owned);
    let has_parameters = panel.width() >= WITH_PARAMETERS;
    let position = position(item, home).unwrap_or_else(|| {
        if has_parameters {
            String::new()
        } else {
            parameters(item)
        }
    });
    let mut spans = vec![
        Span::styled(
            if is_marked { "▌" } else { " " },
            panel.style(Role::Selected),
        ),
        Span::raw(aligned(&(index + 1).to_string(), NUMBER, true)),
        Span::styled(fault, panel.style(role)),
        Span::raw(format!(
            " {} {} {}",
            aligned(&word, WORD, false),
            aligned(&position, PLACE, false),
            aligned(&height(item), HEIGHT, true)
        )),
        Span::styled(format!(" {}", frame(item)), panel.style(Role::Muted)),
    ];
    if shown.room.list() == ListKind::Plan && panel.width() >= WITH_LEG {
        spans.push(Span::raw(leg(shown.course.at(index), has_parameters)));
    }
    if has_parameters {
        let room = panel.width().saturating_sub(USED);
        spans.push(Span::raw(format!(
            "  {}",
            aligned(&parameters(item), room, false)
        )));
    }
    Line::from(spans)
}

/// The mark of the worst finding about an item.
fn fault(shown: &Shown<'_>, index: usize) -> (&'static str, Role) {
    let list = shown.room.list();
    let about = shown
        .findings
        .iter()
        .filter(|it| it.list == list && it.item == Some(index));
    match about.map(Finding::severity).max() {
        Some(Severity::Error) => ("!", Role::Danger),
        Some(Severity::Warning) => ("?", Role::Warning),
        None => (" ", Role::Text),
    }
}

/// The place of an item as an offset from home, otherwise in degrees; `None` if it has no place.
fn position(item: &Item, home: Option<LatLon>) -> Option<String> {
    let here = place(item)?;
    Some(match home {
        Some(home) => {
            let (north_m, east_m) = home.offset_to(here);
            format!("n {} e {}", figure(north_m, 0), figure(east_m, 0))
        }
        None => format!("{:.4} {:.4}", here.lat_deg, here.lon_deg),
    })
}

/// The height of an item, or the radius of a circle.
fn height(item: &Item) -> String {
    if command::is_circle(item.command) {
        return figure(item.params[0], 0);
    }
    let has_height = command::has_place(item.command) && !command::is_fence(item.command);
    if has_height {
        figure(item.z, 0)
    } else {
        String::new()
    }
}

/// A letter for the reference of the height; `r` for a radius.
fn frame(item: &Item) -> &'static str {
    if command::is_circle(item.command) {
        return "r";
    }
    if !command::has_place(item.command) || command::is_fence(item.command) {
        return " ";
    }
    match PlanFrame::of(item) {
        Some(PlanFrame::Home) => "h",
        Some(PlanFrame::Terrain) => "t",
        Some(PlanFrame::Sea) => "s",
        None => "?",
    }
}

fn leg(stop: Option<&Stop>, with_time: bool) -> String {
    let way = stop.map(Stop::way_m).filter(|way_m| *way_m >= 1.0);
    let leg_m = way.map_or_else(String::new, |way_m| length(way_m.round()));
    let slope = stop.and_then(Stop::slope_percent);
    let slope = slope.map_or_else(String::new, percent);
    let mut leg = format!(
        " {}{}",
        aligned(&leg_m, LEG, true),
        aligned(&slope, SLOPE, true)
    );
    if with_time {
        let time = stop.map_or_else(String::new, |stop| seconds(stop.leg_s));
        leg.push_str(&aligned(&time, TIME, true));
    }
    leg
}

/// A slope in percent; a level leg has no sign.
pub(super) fn percent(slope: f64) -> String {
    if slope.abs() < 0.5 {
        "0 %".to_owned()
    } else {
        format!("{slope:+.0} %")
    }
}

/// A time in seconds as text for a narrow column; NaN counts as 0.
pub(super) fn seconds(seconds: f64) -> String {
    let known = if seconds.is_nan() { 0.0 } else { seconds };
    lasting(Duration::from_secs_f64(known.clamp(0.0, LONGEST_S).round()))
}

/// The parameters of an item that are not 0, by their names.
pub(super) fn parameters(item: &Item) -> String {
    let fields = field::fields(item.command).iter();
    let is_of_fence = command::is_fence(item.command);
    let set = fields.filter(|field| !is_of_fence && field.value(item) != 0.0);
    let words = set.map(|field| {
        let unit = Unit::of_field(field.unit).symbol();
        let value = field.value(item);
        let gap = if unit.is_empty() { "" } else { " " };
        format!("{} {value}{gap}{unit}", field.name)
    });
    words.collect::<Vec<_>>().join("  ")
}
