//! How orders to seats ended, on the last line of the desk.

use crate::app::State;
use crate::class::{CallEnd, Desk, OrderState, Outcome, SeatEnd};
use crate::class_text::{deed_text, ended_text, refusal_of};
use crate::text;
use crate::text::Text;
use crate::vehicle::Severity;

/// Tells how orders ended that no seat keeps waiting.
pub(super) fn tell(state: &mut State) {
    let ended = state.class.desk_mut().map(Desk::take_ended_calls);
    for call in ended.into_iter().flatten() {
        let is_good = call.seats.iter().all(|end| SameEnd::of(end).is_good());
        let severity = if is_good {
            Severity::Notice
        } else {
            Severity::Warning
        };
        let text = text(state, &call);
        state.say(severity, text);
    }
}

/// The seats at which an order ended in the same way.
struct Group {
    end: SameEnd,
    seats: Vec<usize>,
}

#[derive(PartialEq)]
enum SameEnd {
    Done,
    /// The seat has refused it, for this reason.
    Refused(Text),
    Other(Text),
}

impl SameEnd {
    fn of(end: &SeatEnd) -> Self {
        match end.state {
            OrderState::Ended(Outcome::Done) => Self::Done,
            OrderState::Ended(Outcome::Refused(refusal)) => {
                Self::Refused(refusal_of(refusal, end.why.as_ref()))
            }
            OrderState::Ended(outcome) => Self::Other(ended_text(outcome, None)),
            OrderState::Waiting => Self::Other(text!("class-waiting")),
            OrderState::Unanswered => Self::Other(text!("class-unanswered")),
        }
    }

    fn is_good(&self) -> bool {
        *self == Self::Done
    }
}

impl Group {
    /// The groups, those that have done it first.
    fn all(ends: &[SeatEnd]) -> Vec<Self> {
        let mut groups: Vec<Self> = Vec::new();
        for end in ends {
            let same = SameEnd::of(end);
            match groups.iter_mut().find(|group| group.end == same) {
                Some(group) => group.seats.push(end.seat),
                None => groups.push(Self {
                    end: same,
                    seats: vec![end.seat],
                }),
            }
        }
        groups.sort_by_key(|group| !group.end.is_good());
        groups
    }

    fn text(&self, state: &State) -> Text {
        let (count, which) = (self.seats.len(), state.seat_names(&self.seats));
        match &self.end {
            SameEnd::Done => text!("class-call-done", count = count),
            SameEnd::Refused(reason) => text!(
                "class-call-refused",
                count = count,
                which = which,
                reason = reason.clone()
            ),
            SameEnd::Other(end) => text!(
                "class-call-other",
                count = count,
                which = which,
                state = end.clone()
            ),
        }
    }
}

fn text(state: &State, call: &CallEnd) -> Text {
    let deed = deed_text(&call.deed);
    let ends = match call.seats.as_slice() {
        [end] => match end.state {
            OrderState::Ended(outcome) => ended_text(outcome, end.why.as_ref()),
            OrderState::Waiting => text!("class-waiting"),
            OrderState::Unanswered => text!("class-unanswered"),
        },
        ends => {
            let groups = Group::all(ends).into_iter();
            Text::joined(", ", groups.map(|group| group.text(state)).collect())
        }
    };
    text!("class-order", deed = deed, state = ends)
}
