//! The item under the cursor, the cursor of the map, and the reports.

use ratatui::buffer::Buffer;
use ratatui::text::{Line, Span};

use super::list::{parameters, percent, seconds};
use super::{Shown, reports};
use crate::app::State;
use crate::app::room::plans::layout;
use crate::draft::{Stop, place};
use crate::geo::{GridSize, LatLon};
use crate::plan::check::legs;
use crate::plan::{HeightFrame, Item, ListKind, command, field};
use crate::text;
use crate::text::Text;
use crate::text::figure;
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::map::length;
use crate::ui::widget::{clip, put};

/// Draws the item, the cursor and the reports; without a draft, only the reports.
pub(super) fn draw(
    state: &State,
    shown: Option<&Shown<'_>>,
    panel: Panel<'_>,
    buffer: &mut Buffer,
) {
    if let Some(shown) = shown {
        draw_item(state, shown, panel, buffer);
    }
    reports::draw(state, shown, panel.below(2), buffer);
}

fn draw_item(state: &State, shown: &Shown<'_>, panel: Panel<'_>, buffer: &mut Buffer) {
    let item = shown
        .room
        .row()
        .and_then(|row| Some((row, shown.room.items().get(row)?)));
    if let Some((row, item)) = item {
        put(buffer, panel.area, 0, &item_line(shown, row, item, panel));
    }
    put(buffer, panel.area, 1, &cursor_line(state, shown, panel));
}

/// The item under the cursor: its command, its parameters, the leg that leads to it.
fn item_line(shown: &Shown<'_>, row: usize, item: &Item, panel: Panel<'_>) -> Line<'static> {
    let word = field::word(item.command).map_or_else(|| item.command.to_string(), str::to_owned);
    let mut words = vec![format!(" {} {word}", row + 1)];
    words.extend(height(item).map(|height| panel.text(&height)));
    words.push(parameters(item));
    let stop = (shown.room.list() == ListKind::Plan)
        .then(|| shown.course.at(row))
        .flatten();
    words.extend(stop.map(|stop| leg(stop, panel)));
    words.extend(above_ground(shown, row).map(|text| panel.text(&text)));
    words.retain(|word| !word.is_empty());
    Line::raw(clip(&words.join("  "), panel.width()))
}

/// The leg to an item and the turns there, or the climb if it leads straight up.
fn leg(stop: &Stop, panel: Panel<'_>) -> String {
    let (time, slope) = (seconds(stop.leg_s), stop.slope_percent());
    if slope.is_none() && stop.turns_m < 1.0 {
        let climb = format!("{} m", figure(stop.climb_m, 0));
        return panel.text(&text!("plans-climb", height = climb, time = time));
    }
    let length = length(stop.way_m().round());
    let leg = panel.text(&text!("plans-leg", length = length, time = time));
    slope.map_or_else(|| leg.clone(), |slope| format!("{leg}, {}", percent(slope)))
}

/// The minimum height above the ground on the leg to an item; `None` if the ground is unknown.
fn above_ground(shown: &Shown<'_>, row: usize) -> Option<Text> {
    let ground = shown.room.ground();
    if ground.is_empty() || shown.room.list() != ListKind::Plan {
        return None;
    }
    let legs = legs(shown.document, &|place| ground.height_m(place));
    let leg = legs.into_iter().find(|leg| leg.item == row)?;
    let [height_m, _] = leg.lowest?;
    Some(text!("plans-above-ground", height = figure(height_m, 0)))
}

/// The height of an item with its reference, if it has one.
fn height(item: &Item) -> Option<Text> {
    if !command::has_place(item.command) || command::is_fence(item.command) {
        return None;
    }
    let height = figure(item.z, 0);
    Some(match item.height_frame() {
        HeightFrame::SeaLevel => text!("plan-height-sea", height = height),
        HeightFrame::Home => text!("plan-height-home", height = height),
        HeightFrame::Terrain => text!("plan-height-terrain", height = height),
        HeightFrame::Other => text!("plan-height-other", height = height),
    })
}

/// The position of the map's cursor: in degrees, from home, and from the item under the list's cursor.
fn cursor_line(state: &State, shown: &Shown<'_>, panel: Panel<'_>) -> Line<'static> {
    let canvas = layout(state.display().grid()).canvas;
    let map = shown.room.map();
    let Some(view) = map.view(GridSize::new(canvas.columns, canvas.rows)) else {
        return Line::default();
    };
    let cursor = map.pointed(&view);
    let muted = |id: &str| Span::styled(format!("{} ", panel.say(id)), panel.style(Role::Muted));
    let mut spans = vec![
        Span::raw(" "),
        muted("plans-cursor"),
        Span::raw(format!("{:.6} {:.6}  ", cursor.lat_deg, cursor.lon_deg)),
    ];
    if let Some(home) = shown.document.home {
        let (north_m, east_m) = LatLon::from_e7(home.x, home.y).offset_to(cursor);
        spans.push(Span::raw(format!(
            "n {} e {} m  ",
            figure(north_m, 0),
            figure(east_m, 0)
        )));
    }
    let items = shown.room.items();
    let item = shown.room.row().and_then(|row| items.get(row));
    if let Some(from) = item.and_then(place) {
        let way_m = from.distance_m(cursor).round();
        if way_m < 1.0 {
            return Line::from(spans);
        }
        let bearing = from.bearing_deg(cursor).round() % 360.0;
        let way = format!("{} {bearing:03.0}°", length(way_m));
        spans.push(muted("plans-from-item"));
        spans.push(Span::raw(way));
    }
    Line::from(spans)
}
