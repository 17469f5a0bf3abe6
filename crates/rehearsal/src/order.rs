//! The order in which vehicles are placed one after the other.

/// Up to this many vehicles, all orders are tried.
const ALL_ORDERS: usize = 5;
/// For more vehicles, the maximum number of rounds in which all neighbours in the order are exchanged.
const SWAP_ROUNDS: usize = 12;

/// The best result of all orders of the vehicles: the one with the lowest cost. For more than
/// [`ALL_ORDERS`] vehicles, neighbours are exchanged as long as that helps. `None` if no order has
/// a result.
pub(crate) fn best_order<R>(
    vehicles: usize,
    mut result: impl FnMut(&[usize]) -> Option<(u32, R)>,
) -> Option<(u32, R)> {
    let mut order: Vec<usize> = (0..vehicles).collect();
    let mut best = result(&order);
    let is_better = |found: &Option<(u32, R)>, best: &Option<(u32, R)>| match (found, best) {
        (Some((cost, _)), Some((least, _))) => cost < least,
        (Some(_), None) => true,
        (None, _) => false,
    };
    if vehicles <= ALL_ORDERS {
        while next_order(&mut order) {
            let found = result(&order);
            if is_better(&found, &best) {
                best = found;
            }
        }
        return best;
    }
    for _ in 0..SWAP_ROUNDS {
        let mut helped = false;
        for place in 1..vehicles {
            order.swap(place - 1, place);
            let found = result(&order);
            if is_better(&found, &best) {
                (best, helped) = (found, true);
            } else {
                order.swap(place - 1, place);
            }
        }
        if !helped {
            break;
        }
    }
    best
}

/// Changes an order to the next one in lexicographic order; returns false after the last.
fn next_order(order: &mut [usize]) -> bool {
    let Some(pivot) = order.windows(2).rposition(|pair| pair[0] < pair[1]) else {
        return false;
    };
    let greater = order.iter().rposition(|it| *it > order[pivot]);
    order.swap(pivot, greater.unwrap_or(pivot));
    order[pivot + 1..].reverse();
    true
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_orders_are_visited_once() {
        let mut order = vec![0, 1, 2, 3];
        let mut seen = vec![order.clone()];
        while next_order(&mut order) {
            seen.push(order.clone());
        }
        seen.sort_unstable();
        seen.dedup();
        assert_eq!(seen.len(), 24);
    }
}
