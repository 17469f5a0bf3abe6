//! The lists as the vehicle stores them, and the effects of a change.

use mavlink::dialects::ardupilotmega::MavSeverity::{MAV_SEVERITY_DEBUG, MAV_SEVERITY_WARNING};

use crate::autopilot::Autopilot;
use crate::cmd;
use crate::fence::{Fence, severity};
use crate::plan::{Item, ListKind};
use crate::transfer::fence;
use crate::vehicle::Vehicle;
use sortie_plan::board;

/// An item of a list in the form of a download: `MISSION_ITEM_INT` without its sender and receiver.
pub(in crate::transfer) fn as_sent(vehicle: &Vehicle, kind: ListKind, seq: usize) -> Option<Item> {
    if kind == ListKind::Plan && seq == 0 {
        return Some(home(vehicle));
    }
    vehicle.plans.list(kind).get(seq).copied()
}

/// Replaces a whole list with checked items; `false` if there are too many.
pub(in crate::transfer) fn replace(
    autopilot: &mut Autopilot,
    kind: ListKind,
    items: Vec<Item>,
) -> bool {
    if items.len() > board::most_items(kind) {
        return false;
    }
    *autopilot.vehicle.plans.list_mut(kind) = items;
    announce(autopilot, kind);
    autopilot.plans_changed(kind);
    true
}

/// Accepts a complete fence, or reports why it is refused; returns whether it was accepted.
pub(in crate::transfer) fn take_fence(autopilot: &mut Autopilot, items: Vec<Item>) -> bool {
    if let Err(error) = Fence::check(&items) {
        autopilot.vehicle.say(severity(error), &error.to_string());
        autopilot
            .vehicle
            .say(MAV_SEVERITY_WARNING, "Fence validation failed");
        return false;
    }
    if board::fence_bytes(&items) > board::FENCE_STORAGE {
        autopilot
            .vehicle
            .say(MAV_SEVERITY_WARNING, "Fence exceeds storage size");
        return false;
    }
    autopilot
        .vehicle
        .say(MAV_SEVERITY_DEBUG, "Fence Indexed OK");
    replace(autopilot, ListKind::Fence, items)
}

/// Whether an item is valid in a mission of `items` items: jumps must lead to an existing item.
pub(in crate::transfer) fn leads_somewhere(item: &Item, items: usize) -> bool {
    board::wrong_jump(item, items).is_none()
}

/// Updates the parameters that contain the lengths of the lists.
pub(in crate::transfer) fn announce(autopilot: &mut Autopilot, kind: ListKind) {
    let length = autopilot.vehicle.plans.list(kind).len() as f32;
    let (name, total) = match kind {
        ListKind::Plan => ("MIS_TOTAL", length),
        ListKind::Fence => ("FENCE_TOTAL", fence::total(&autopilot.vehicle.plans.fence)),
        ListKind::Rally => ("RALLY_TOTAL", length),
    };
    autopilot.vehicle.store_parameter(name, total);
}

/// Item 0 of a mission: the current home.
fn home(vehicle: &Vehicle) -> Item {
    let mut item = Item {
        command: cmd::NAV_WAYPOINT,
        auto_continue: true,
        ..Item::default()
    };
    if let Some(home) = vehicle.datum.home() {
        (item.x, item.y) = home.at.to_e7();
        item.z = (home.altitude_amsl_m * 100.0).round() as f32 * 0.01;
    }
    item
}
