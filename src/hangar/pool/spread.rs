//! Chooses the hangars for vehicles.

use crate::hangar::Capacity;

/// A hangar for each of `count` vehicles: always the one with the largest free share, or the first of several with the
/// same share. `None` if there is not enough room.
pub(super) fn spread(rooms: &[Capacity], count: usize) -> Option<Vec<usize>> {
    let mut rooms = rooms.to_vec();
    let mut chosen = Vec::with_capacity(count);
    for _ in 0..count {
        let free = (0..rooms.len()).filter(|&place| rooms[place].free > 0);
        let best = free.reduce(|best, place| {
            if has_larger_share(rooms[place], rooms[best]) {
                place
            } else {
                best
            }
        })?;
        rooms[best].free -= 1;
        rooms[best].running += 1;
        chosen.push(best);
    }
    Some(chosen)
}

fn has_larger_share(a: Capacity, b: Capacity) -> bool {
    let all = |room: Capacity| u64::from(room.free) + u64::from(room.running);
    u64::from(a.free) * all(b) > u64::from(b.free) * all(a)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn with_room(figures: &[(u16, u16)]) -> Vec<Capacity> {
        figures
            .iter()
            .map(|&(running, free)| Capacity { running, free })
            .collect()
    }

    #[test]
    fn the_emptiest_is_chosen_and_of_equal_ones_the_first() {
        for (rooms, count, expected) in [
            (&[(0, 4)][..], 4, Some(&[0, 0, 0, 0][..])),
            (&[(0, 4)], 5, None),
            (&[], 0, Some(&[])),
            (&[], 1, None),
            (&[(0, 2), (0, 2)], 4, Some(&[0, 1, 0, 1])),
            (&[(2, 2), (0, 4)], 3, Some(&[1, 1, 0])),
            (&[(0, 8), (0, 2)], 5, Some(&[0, 1, 0, 0, 0])),
            (&[(3, 0), (0, 1)], 1, Some(&[1])),
            (&[(3, 0), (0, 1)], 2, None),
        ] {
            let rooms = with_room(rooms);
            let chosen = spread(&rooms, count);
            assert_eq!(chosen.as_deref(), expected, "{rooms:?} {count}");
        }
    }

    proptest! {
        #[test]
        fn nobody_gets_more_than_fits(
            rooms in proptest::collection::vec((0_u16..20, 0_u16..20), 0..6),
            count in 0_usize..60,
        ) {
            let rooms = with_room(&rooms);
            let free: usize = rooms.iter().map(|room| usize::from(room.free)).sum();
            match spread(&rooms, count) {
                None => prop_assert!(count > free),
                Some(chosen) => {
                    prop_assert_eq!(chosen.len(), count);
                    for (place, room) in rooms.iter().enumerate() {
                        let here = chosen.iter().filter(|&&at| at == place).count();
                        prop_assert!(here <= usize::from(room.free));
                    }
                }
            }
        }
    }
}
