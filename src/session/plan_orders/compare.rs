//! Whether a vehicle holds the list that was sent, and its refusals in words.

use mavlink::dialects::ardupilotmega::MavMissionResult;

use crate::plan::{ContentHash, HeightFrame, Item, ListKind, board, command};
use crate::text;
use crate::text::Text;

/// The rounding errors of storage and transmission, in metres or other units: heights are kept in centimetres, those of
/// rally points in metres.
const ROUNDING: f32 = 0.011;
const RALLY_ROUNDING: f32 = 1.001;

/// The text for a vehicle's refusal of an item, or of a list.
pub(super) fn explained(result: MavMissionResult, item: &Item) -> Text {
    use MavMissionResult as Result;
    let parameter = |number: u8| text!("plan-result-parameter", number = number);
    match result {
        Result::MAV_MISSION_UNSUPPORTED => text!("plan-result-command", command = item.command),
        Result::MAV_MISSION_UNSUPPORTED_FRAME => text!("plan-result-frame", frame = item.frame),
        Result::MAV_MISSION_INVALID_PARAM1 => parameter(1),
        Result::MAV_MISSION_INVALID_PARAM2 => parameter(2),
        Result::MAV_MISSION_INVALID_PARAM3 => parameter(3),
        Result::MAV_MISSION_INVALID_PARAM4 => parameter(4),
        Result::MAV_MISSION_INVALID_PARAM5_X => parameter(5),
        Result::MAV_MISSION_INVALID_PARAM6_Y => parameter(6),
        Result::MAV_MISSION_INVALID_PARAM7 => parameter(7),
        Result::MAV_MISSION_NO_SPACE => text!("plan-result-space"),
        Result::MAV_MISSION_DENIED => text!("plan-result-denied"),
        Result::MAV_MISSION_ACCEPTED
        | Result::MAV_MISSION_ERROR
        | Result::MAV_MISSION_INVALID
        | Result::MAV_MISSION_INVALID_SEQUENCE
        | Result::MAV_MISSION_OPERATION_CANCELLED => text!("plan-result-error"),
    }
}

/// The number of items that belong to the vehicle itself: item 0 of a plan is its home.
pub(super) fn home(kind: ListKind) -> usize {
    usize::from(kind == ListKind::Plan)
}

/// The items of a list without the items that belong to the vehicle itself.
pub(super) fn own(kind: ListKind, items: &[Item]) -> &[Item] {
    items.get(home(kind)..).unwrap_or_default()
}

/// Whether a vehicle holds the list that was sent, allowing for the losses of its storage.
pub(super) fn is_held(kind: ListKind, sent: &[Item], held: &[Item]) -> bool {
    let (sent, held) = (own(kind, sent), own(kind, held));
    sent.len() == held.len()
        && sent
            .iter()
            .zip(held)
            .all(|(sent, held)| is_item(kind, sent, held))
}

fn is_item(kind: ListKind, sent: &Item, held: &Item) -> bool {
    let kept = board::kept(kind, sent).unwrap_or(*sent);
    let rounding = match kind {
        ListKind::Plan | ListKind::Fence => ROUNDING,
        ListKind::Rally => RALLY_ROUNDING,
    };
    let params = sent.params.iter().zip(kept.params).zip(held.params);
    let is_frame = |frame: u8| HeightFrame::of(frame) == HeightFrame::of(held.frame);
    let has_height = kind != ListKind::Fence && command::has_place(sent.command);
    sent.command == held.command
        && (!has_height || is_frame(kept.frame) || is_frame(sent.frame))
        && is_near(sent.x, kept.x, held.x)
        && is_near(sent.y, kept.y, held.y)
        && (is_close(kept.z, held.z, rounding) || is_close(sent.z, held.z, rounding))
        && params.into_iter().all(|((sent, kept), held)| {
            let slack = |value: f32| (value.abs() * 1e-6).max(1e-6);
            is_close(kept, held, slack(kept)) || is_close(*sent, held, slack(*sent))
        })
}

fn is_near(sent: i32, kept: i32, held: i32) -> bool {
    sent.abs_diff(held) <= 1 || kept.abs_diff(held) <= 1
}

/// Whether two numbers are close to each other, or both unset.
fn is_close(a: f32, b: f32, slack: f32) -> bool {
    (a.is_nan() && b.is_nan()) || (a - b).abs() <= slack
}

/// The short name of a list, derived from its content.
pub(super) fn mark(own: &[Item]) -> String {
    ContentHash::of(own).to_string()
}

/// Whether the vehicle already holds a list: within the tolerance of its storage, and with the same
/// short name, so that every vehicle that holds a list also shows its name.
pub(super) fn is_identical(kind: ListKind, wanted: &[Item], held: &[Item]) -> bool {
    let name = |list| ContentHash::of(own(kind, list));
    is_held(kind, wanted, held) && name(wanted) == name(held)
}

/// Whether two readings of a vehicle's list are the same.
pub(super) fn is_same(kind: ListKind, before: &[Item], now: &[Item]) -> bool {
    let bits = |item: &Item| {
        let params = item.params.map(f32::to_bits);
        let frame = HeightFrame::of(item.frame);
        (
            item.command,
            frame,
            params,
            item.x,
            item.y,
            item.z.to_bits(),
        )
    };
    let (before, now) = (own(kind, before), own(kind, now));
    before.len() == now.len() && before.iter().zip(now).all(|(a, b)| bits(a) == bits(b))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn waypoint(params: [f32; 4], z: f32) -> Item {
        Item {
            command: 16,
            frame: 6,
            auto_continue: true,
            params,
            x: 504_500_000,
            y: 305_000_000,
            z,
        }
    }

    #[test]
    fn what_storage_rounds_is_no_difference_and_a_metre_is() {
        let home = waypoint([0.0; 4], 0.0);
        let sent = [home, waypoint([3.9, 5.0, 0.0, f32::NAN], 20.257)];
        let held = |held: Item| [home, Item { frame: 3, ..held }];
        let rounded = held(waypoint([3.0, 0.0, 0.0, 0.0], 20.25));
        assert!(is_held(ListKind::Plan, &sent, &rounded));
        for other in [
            waypoint([4.0, 0.0, 0.0, 0.0], 20.25),
            waypoint([3.0, 0.0, 0.0, 0.0], 21.25),
            Item {
                x: 504_500_002,
                ..rounded[1]
            },
            Item {
                command: 82,
                ..rounded[1]
            },
        ] {
            assert!(!is_held(ListKind::Plan, &sent, &held(other)), "{other:?}");
        }
        let sea = Item {
            frame: 0,
            ..rounded[1]
        };
        assert!(!is_held(ListKind::Plan, &sent, &[home, sea]));
        assert!(!is_held(ListKind::Plan, &sent, &sent[..1]));
    }

    #[test]
    fn home_may_move_between_two_readings() {
        let at = |z| [waypoint([0.0; 4], z), waypoint([f32::NAN; 4], 20.0)];
        assert!(is_same(ListKind::Plan, &at(1.0), &at(2.0)));
        assert!(!is_same(ListKind::Rally, &at(1.0), &at(2.0)));
    }
}
