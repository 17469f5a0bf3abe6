//! The order of a plan's items: the list, its jumps and its tags (`AP_Mission`).

use std::collections::BTreeMap;

use crate::cmd;
use crate::plan::Item;

/// The maximum number of jumps in a row before the search gives up.
const JUMPS_IN_A_ROW: usize = 64;
/// The repeat count of an endless jump.
const FOR_EVER: i16 = -1;
/// The maximum number of items before a takeoff.
const BEFORE_TAKEOFF: u16 = 16;

/// The number of times that each jump, by its index in the list, has been taken.
pub(super) type Jumps = BTreeMap<u16, i16>;

/// Whether the command is a navigation command; others act or wait in parallel with one.
pub(super) fn is_navigation(command: u16) -> bool {
    command <= cmd::NAV_LAST
        || matches!(
            command,
            cmd::NAV_SET_YAW_SPEED | cmd::NAV_SCRIPT_TIME | cmd::NAV_ATTITUDE_TIME
        )
}

/// The first item at or after `from` that is not a jump. Jumps on the way are counted, and reported
/// in `texts`; the first time that an unlimited jump is taken, it is not reported.
pub(super) fn next_counting(
    items: &[Item],
    from: u16,
    jumps: &mut Jumps,
    texts: &mut Vec<String>,
) -> Option<u16> {
    let mut at = from;
    let mut left = JUMPS_IN_A_ROW;
    loop {
        let item = items.get(usize::from(at))?;
        let Some((target, times)) = jump_of(items, item) else {
            return Some(at);
        };
        left = left.checked_sub(1)?;
        if usize::from(target) >= items.len() || target == 0 {
            return None;
        }
        let known = jumps.contains_key(&at) || times != FOR_EVER;
        let taken = jumps.entry(at).or_insert(0);
        if times != FOR_EVER && *taken >= times {
            at += 1;
            continue;
        }
        *taken = taken.saturating_add(1);
        if known {
            texts.push(if times == FOR_EVER {
                format!("Mission: {at} Jump {taken}/unlimited")
            } else {
                format!("Mission: {at} Jump {taken}/{times}")
            });
        }
        at = target;
    }
}

/// Like `next_counting`, but without counting, to look ahead.
pub(super) fn next_ahead(items: &[Item], from: u16, jumps: &Jumps) -> Option<u16> {
    let mut at = from;
    let mut first_jump = None;
    for _ in 0..=JUMPS_IN_A_ROW {
        let item = items.get(usize::from(at))?;
        let Some((target, times)) = jump_of(items, item) else {
            return Some(at);
        };
        if usize::from(target) >= items.len() || target == 0 || first_jump == Some(at) {
            return None;
        }
        first_jump.get_or_insert(at);
        let taken = jumps.get(&at).copied().unwrap_or(0);
        at = if times == FOR_EVER || taken < times {
            target
        } else {
            at + 1
        };
    }
    None
}

/// The next navigation command at or after `from`, if there is one.
pub(super) fn next_navigation(items: &[Item], from: u16, jumps: &Jumps) -> Option<u16> {
    (from..items.len() as u16)
        .map_while(|at| next_ahead(items, at, jumps))
        .find(|&at| {
            items
                .get(usize::from(at))
                .is_some_and(|item| is_navigation(item.command))
        })
}

/// The first item with a tag, if there is one.
pub(super) fn tagged(items: &[Item], tag: u16) -> Option<u16> {
    items
        .iter()
        .skip(1)
        .position(|item| item.command == cmd::JUMP_TAG && item.params[0] as u16 == tag)
        .map(|place| place as u16 + 1)
}

/// Whether the vehicle takes off before it flies anywhere.
pub(super) fn takes_off_first(items: &[Item], from: u16, jumps: &Jumps) -> bool {
    for start in from..from.saturating_add(BEFORE_TAKEOFF) {
        let next = next_navigation(items, start, jumps);
        match next
            .and_then(|at| items.get(usize::from(at)))
            .map(|item| item.command)
        {
            Some(cmd::NAV_TAKEOFF | cmd::NAV_VTOL_TAKEOFF) => return true,
            Some(cmd::NAV_DELAY) => {}
            _ => return false,
        }
    }
    false
}

/// The target of a jump, and how many times it is taken; an unknown tag leads to item 0, which ends the search.
fn jump_of(items: &[Item], item: &Item) -> Option<(u16, i16)> {
    let (target, times) = (item.params[0] as u16, item.params[1] as i16);
    match item.command {
        cmd::DO_JUMP => Some((target, times)),
        cmd::DO_JUMP_TAG => Some((tagged(items, target).unwrap_or(0), times)),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn item(command: u16, p: [f32; 2]) -> Item {
        Item {
            command,
            params: [p[0], p[1], 0.0, 0.0],
            ..Item::default()
        }
    }

    #[test]
    fn a_jump_is_taken_as_often_as_it_says_and_then_passed() {
        let list = [
            item(16, [0.0; 2]),
            item(22, [0.0; 2]),
            item(177, [1.0, 2.0]),
            item(20, [0.0; 2]),
        ];
        let (mut jumps, mut texts) = (Jumps::new(), Vec::new());
        let found: Vec<_> = (0..3)
            .map(|_| next_counting(&list, 2, &mut jumps, &mut texts))
            .collect();
        assert_eq!(found, [Some(1), Some(1), Some(3)]);
        assert_eq!(texts, ["Mission: 2 Jump 1/2", "Mission: 2 Jump 2/2"]);
    }

    /// A real vehicle reports "Jump 2/unlimited" to "Jump 64/unlimited" and gives up.
    #[test]
    fn a_jump_to_itself_ends_after_64_rounds() {
        let list = [
            item(16, [0.0; 2]),
            item(22, [0.0; 2]),
            item(177, [2.0, -1.0]),
        ];
        let (mut jumps, mut texts) = (Jumps::new(), Vec::new());
        assert_eq!(next_counting(&list, 2, &mut jumps, &mut texts), None);
        assert_eq!(texts.len(), 63);
        assert_eq!(texts[62], "Mission: 2 Jump 64/unlimited");
        assert_eq!(next_ahead(&list, 2, &jumps), None);
    }

    proptest! {
        #[test]
        fn any_list_of_jumps_comes_to_an_end(commands in proptest::collection::vec((prop_oneof![Just(16u16), Just(177), Just(600), Just(601)], -2.0..20.0f32, -2.0..4.0f32), 0..20), from in 0u16..25) {
            let list: Vec<_> = commands.into_iter().map(|(c, a, b)| item(c, [a.trunc(), b.trunc()])).collect();
            let (mut jumps, mut texts) = (Jumps::new(), Vec::new());
            let found = next_counting(&list, from, &mut jumps, &mut texts);
            prop_assert!(found.is_none_or(|at| usize::from(at) < list.len()));
            prop_assert!(next_navigation(&list, from, &jumps).is_none_or(|at| is_navigation(list[usize::from(at)].command)));
            takes_off_first(&list, from, &jumps);
        }
    }
}
