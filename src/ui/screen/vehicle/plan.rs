//! The plan on board around the current item, and the size of the fence and the number of rally points.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};

use super::VehicleSubject;
use super::row::{UNKNOWN, filled, labelled};
use crate::commands::command_name;
use crate::geo::LatLon;
use crate::plan::{HeightFrame, Item};
use crate::text;
use crate::text::Text;
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::{below, leg, put, upper};
use crate::vehicle::{Plan, PlanLeg, Transfer, Vehicle};

/// The number of rows of the fence and the rally points.
const OTHERS: u16 = 2;
/// The widths of an item's number, name, and height, in columns.
const SEQ: usize = 4;
const NAME: usize = 16;
const HEIGHT: usize = 8;

/// Draws as many items as fit, the current one among them.
pub(super) fn draw(subject: &VehicleSubject<'_>, area: Rect, buffer: &mut Buffer) {
    let (vehicle, look) = (subject.vehicle, subject.look);
    let stored = &vehicle.plans.plan;
    let title = match stored.content.as_deref() {
        Some(plan) if !plan.flown().is_empty() => {
            let (item, last) = (u32::from(vehicle.plan.current), plan.items.len() - 1);
            look.text(&if vehicle.has_paused() {
                text!("vehicle-plan-paused", item = item, last = last)
            } else {
                text!("vehicle-plan-at", item = item, last = last)
            })
        }
        _ => look.say("vehicle-plan"),
    };
    let inner = Panel::new(look, area).titled(&title, buffer);
    let leg = vehicle.plan_leg();
    let others = OTHERS + u16::from(leg.is_some());
    let items = upper(inner, inner.height.saturating_sub(others));
    match stored.content.as_deref() {
        Some(plan) if !plan.flown().is_empty() => draw_items(subject, plan, items, buffer),
        content => {
            let text = standing(stored.transfer, content.is_some(), || {
                text!("vehicle-plan-empty")
            });
            put(
                buffer,
                items,
                0,
                &Line::styled(look.text(&text), look.style(Role::Muted)),
            );
        }
    }
    draw_others(subject, leg.as_ref(), below(inner, items.height), buffer);
}

/// Draws the leg, if one is flown, the fence and the rally points, each in a row.
fn draw_others(
    subject: &VehicleSubject<'_>,
    leg: Option<&PlanLeg>,
    area: Rect,
    buffer: &mut Buffer,
) {
    let (vehicle, look) = (subject.vehicle, subject.look);
    let others = [
        ("vehicle-fence", fence(vehicle)),
        ("vehicle-rally", rally(vehicle)),
    ];
    let times = leg.map(|leg| ("vehicle-leg", leg_times(leg)));
    let rows = times.into_iter().chain(others);
    for (row, (label, text)) in rows.enumerate() {
        let value = vec![Span::raw(look.text(&text))];
        let line = labelled(look, &look.say(label), value);
        put(buffer, area, row as u16, &line);
    }
}

/// The distance and the time to the next place, and the time to the end of the plan.
fn leg_times(leg: &PlanLeg) -> Text {
    let known = |text: Option<String>| text.unwrap_or_else(|| UNKNOWN.to_owned());
    text!(
        "vehicle-leg-times",
        way = known(leg::way(leg)),
        end = known(leg::end(leg))
    )
}

/// The content of a list, or why it is unknown.
fn standing(transfer: Transfer, is_known: bool, content: impl Fn() -> Text) -> Text {
    match transfer {
        _ if is_known => content(),
        Transfer::Coming { received, total } => text!(
            "vehicle-plan-coming",
            received = u32::from(received),
            total = total.map_or("?".to_owned(), |total| total.to_string())
        ),
        Transfer::Unsupported => text!("vehicle-plan-unsupported"),
        Transfer::Failed => text!("vehicle-plan-failed"),
        Transfer::Unasked | Transfer::Done => Text::from("-"),
    }
}

fn fence(vehicle: &Vehicle) -> Text {
    let stored = &vehicle.plans.fence;
    let areas = stored.content.as_ref().map_or(0, |fence| fence.areas.len());
    let content = || text!("vehicle-fence-areas", count = areas);
    match vehicle.fence {
        Some(fence) if fence.breached => text!("vehicle-fence-breached"),
        _ => standing(stored.transfer, stored.content.is_some(), content),
    }
}

fn rally(vehicle: &Vehicle) -> Text {
    let stored = &vehicle.plans.rally;
    let points = stored
        .content
        .as_ref()
        .map_or(0, |rally| rally.points.len());
    let content = || text!("vehicle-rally-points", count = points);
    standing(stored.transfer, stored.content.is_some(), content)
}

fn draw_items(subject: &VehicleSubject<'_>, plan: &Plan, area: Rect, buffer: &mut Buffer) {
    let (vehicle, look) = (subject.vehicle, subject.look);
    let items = plan.flown();
    let skipped = plan.items.len() - items.len();
    let current = usize::from(vehicle.plan.current).checked_sub(skipped);
    let rows = usize::from(area.height);
    // One finished item stays above the current one, to show where the vehicle is coming from.
    let first = current
        .unwrap_or(0)
        .saturating_sub(1)
        .min(items.len().saturating_sub(rows));
    Panel::new(look, area).mark_scroll(first, items.len(), buffer);
    for (row, at) in (first..items.len()).take(rows).enumerate() {
        let is_current = current == Some(at);
        let mark = if is_current { '>' } else { ' ' };
        let role = match current {
            _ if is_current => Role::Accent,
            Some(current) if at < current => Role::Muted,
            _ => Role::Text,
        };
        let way = way_m(vehicle, items, at, is_current)
            .map_or(String::new(), |way_m| format!("{way_m:.0} m"));
        let line = format!("{mark}{}{way:>7}", described(skipped + at, &items[at]));
        put(
            buffer,
            area,
            row as u16,
            &Line::styled(line, look.style(role)),
        );
    }
}

/// An item as text: number, name and height.
fn described(number: usize, item: &Item) -> String {
    let name = command_name(item.command).map_or_else(
        || item.command.to_string(),
        |name| name.strip_prefix("NAV_").unwrap_or(name).to_owned(),
    );
    let height = match (
        item.place().is_some() || item.is_takeoff(),
        item.altitude_m(),
    ) {
        (true, Some(altitude_m)) => {
            // Heights above home are usual and need no mark.
            let frame = match item.height_frame() {
                HeightFrame::SeaLevel => " ASL",
                HeightFrame::Terrain => " AGL",
                HeightFrame::Home | HeightFrame::Other => "",
            };
            format!("{altitude_m:.0} m{frame}")
        }
        _ => String::new(),
    };
    format!("{number:>SEQ$} {} {height:>HEIGHT$}", filled(&name, NAME))
}

/// The distance to an item in metres: from the previous item, or from the vehicle to the current
/// item. `None` if a place is missing.
fn way_m(vehicle: &Vehicle, items: &[Item], at: usize, is_current: bool) -> Option<f64> {
    let to = items[at].place().filter(|_| items[at].is_waypoint())?;
    let from: LatLon = if is_current {
        vehicle.global?.at_point
    } else {
        let mut before = items[..at].iter().rev().filter(|item| item.is_waypoint());
        before.find_map(Item::place)?
    };
    Some(from.distance_m(to)).filter(|way_m| way_m.is_finite())
}
