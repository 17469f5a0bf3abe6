//! An order to several seats at once, and how it ended at each.

use super::{Deed, OrderId, OrderState, Outcome, SeatRecord, Words};

/// The maximum number of calls whose ends are waited for.
const REMEMBERED: usize = 16;

/// An order that the instructor has given to seats at once.
#[derive(Debug, Clone)]
struct Call {
    deed: Deed,
    orders: Vec<CalledSeat>,
    /// How it had ended at the seats when that was last told.
    told: Option<Vec<OrderState>>,
}

#[derive(Debug, Clone, Copy)]
struct CalledSeat {
    seat: usize,
    order: OrderId,
}

/// How an order to seats has ended.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CallEnd {
    /// What was asked for.
    pub deed: Deed,
    /// How it ended at each seat.
    pub seats: Vec<SeatEnd>,
}

/// How an order has ended at one seat.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SeatEnd {
    /// The seat, by its index at the desk.
    pub seat: usize,
    /// The last state of the order at that seat.
    pub state: OrderState,
    /// What the seat has said about it.
    pub why: Option<Words>,
}

/// The calls whose ends the instructor waits for.
#[derive(Debug, Clone, Default)]
pub(super) struct Calls(Vec<Call>);

impl Calls {
    /// Waits for the end of an order to these seats, which has this number at each.
    pub fn begin(&mut self, deed: Deed, orders: impl Iterator<Item = (usize, OrderId)>) {
        let orders = orders.map(|(seat, order)| CalledSeat { seat, order });
        if self.0.len() >= REMEMBERED {
            self.0.remove(0);
        }
        self.0.push(Call {
            deed,
            orders: orders.collect(),
            told: None,
        });
    }

    /// The calls that no seat keeps waiting, each once, and again when a seat has said more.
    pub fn take_ended(&mut self, seats: &[SeatRecord]) -> Vec<CallEnd> {
        let mut ended = Vec::new();
        self.0.retain_mut(|call| {
            let ends = call.ends(seats);
            let states: Vec<OrderState> = ends.iter().map(|end| end.state).collect();
            if states.is_empty() {
                // The seats have had so many orders since then that none remembers this one.
                return false;
            }
            let is_answered = !states.contains(&OrderState::Waiting);
            if is_answered && call.told.as_ref() != Some(&states) {
                ended.push(CallEnd {
                    deed: call.deed.clone(),
                    seats: ends,
                });
                call.told = Some(states.clone());
            }
            !is_answered || states.iter().any(|state| more_follows(*state))
        });
        ended
    }
}

impl Call {
    fn ends(&self, seats: &[SeatRecord]) -> Vec<SeatEnd> {
        let end = |called: &CalledSeat| {
            let mut orders = seats.get(called.seat)?.orders().rev();
            let given = orders.find(|it| it.order.id == called.order)?;
            Some(SeatEnd {
                seat: called.seat,
                state: given.state,
                why: given.why.clone(),
            })
        };
        self.orders.iter().filter_map(end).collect()
    }
}

/// Whether the seat will say more about the order.
fn more_follows(state: OrderState) -> bool {
    matches!(
        state,
        OrderState::Waiting | OrderState::Ended(Outcome::Armed | Outcome::UnderWay)
    )
}
