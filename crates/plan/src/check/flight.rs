//! The order of a plan: jumps, takeoff, ending.

use super::{Finding, FindingKind, VehicleKind, is_jump, plan_finding};
use crate::{Item, ListKind, board, command};

pub(super) fn check(items: &[Item], vehicle: VehicleKind, findings: &mut Vec<Finding>) {
    if items.is_empty() {
        return;
    }
    for (index, item) in items.iter().enumerate() {
        let kind = jump_fault(items, index, item);
        findings.extend(kind.map(|kind| plan_finding(index, kind)));
    }
    let whole = |kind| Finding {
        list: ListKind::Plan,
        item: None,
        kind,
    };
    let first = items
        .iter()
        .find(|item| command::is_takeoff(item.command) || command::is_flown_to(item.command));
    let lifts = first.is_none_or(|item| command::is_takeoff(item.command));
    if vehicle.flies_above_ground() && !lifts {
        findings.push(whole(FindingKind::NoTakeoff));
    }
    let reached = reached(items);
    if reached.ends_openly && vehicle.flies_above_ground() {
        findings.push(whole(FindingKind::NoEnd));
    }
    let unseen = reached.seen.iter().enumerate().filter(|(_, seen)| !**seen);
    findings.extend(unseen.map(|(index, _)| plan_finding(index, FindingKind::Unreached)));
    let endless = endless(items, &reached);
    findings.extend(endless.map(whole));
}

/// The items that a plan without an end repeats; `None` if the plan ends, or if the vehicle ends it
/// at a ring of jumps.
fn endless(items: &[Item], reached: &Reached) -> Option<FindingKind> {
    let seen = || items.iter().enumerate().filter(|(at, _)| reached.seen[*at]);
    let ends = reached.ends_openly
        || seen().any(|(at, item)| ends_at(items, at) || jump_fault(items, at, item).is_some());
    if ends {
        return None;
    }
    let loops = seen().filter(|(_, item)| is_jump(item) && is_endless(item));
    let loops = loops.filter_map(|(at, item)| Some((target(items, item)?, at)));
    let (first, last) = loops
        .filter(|(to, at)| to < at)
        .reduce(|(first, last), (to, at)| (first.min(to), last.max(at)))?;
    Some(FindingKind::NeverEnds {
        first: first + 1,
        last,
    })
}

fn ends_at(items: &[Item], at: usize) -> bool {
    let Some(item) = items.get(at) else {
        return true;
    };
    // After a landing in the middle, the plan continues with the next takeoff.
    let lands = matches!(item.command, command::LAND | command::VTOL_LAND);
    command::is_end(item.command) && !(lands && at + 1 < items.len())
}

fn is_endless(jump: &Item) -> bool {
    jump.params[1] as i16 == -1
}

/// The index of the item to which a jump leads.
fn target(items: &[Item], item: &Item) -> Option<usize> {
    match item.command {
        command::DO_JUMP => {
            let number = item.params[0] as usize;
            (1..=items.len()).contains(&number).then(|| number - 1)
        }
        command::DO_JUMP_TAG => {
            let tag = item.params[0] as u16;
            let has_tag = |it: &Item| it.command == command::JUMP_TAG && it.params[0] as u16 == tag;
            items.iter().position(has_tag)
        }
        _ => None,
    }
}

fn jump_fault(items: &[Item], index: usize, item: &Item) -> Option<FindingKind> {
    let last = items.len();
    if let Some(target) = board::wrong_jump(item, last + 1) {
        return Some(FindingKind::JumpNowhere { target, last });
    }
    if !is_jump(item) {
        return None;
    }
    let Some(mut at) = target(items, item) else {
        return Some(FindingKind::NoTag(item.params[0] as u16));
    };
    // Only a ring of jumps leads back here without an item to fly.
    for _ in 0..items.len() {
        if at == index {
            return Some(FindingKind::JumpRing);
        }
        match items
            .get(at)
            .filter(|item| is_jump(item))
            .and_then(|item| target(items, item))
        {
            Some(next) => at = next,
            None => return None,
        }
    }
    None
}

struct Reached {
    seen: Vec<bool>,
    /// Whether the vehicle can reach the end of the list in flight.
    ends_openly: bool,
}

/// Follows a plan along every path that jumps allow.
fn reached(items: &[Item]) -> Reached {
    let mut seen = vec![false; items.len()];
    let mut ends_openly = false;
    let mut left = vec![0];
    // After a landing, the plans of other vehicles continue with the next item: only a return ends every plan.
    while let Some(at) = left.pop() {
        let Some(item) = items.get(at) else {
            ends_openly = true;
            continue;
        };
        if std::mem::replace(&mut seen[at], true) {
            continue;
        }
        if is_jump(item) {
            left.extend(target(items, item));
        }
        let stops = ends_at(items, at) || (is_jump(item) && is_endless(item));
        if !stops {
            left.push(at + 1);
        }
    }
    Reached { seen, ends_openly }
}
