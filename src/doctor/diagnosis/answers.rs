//! Whether a vehicle answers the console. It is apart because it alone weighs how many unanswered queries are no
//! accident.

use std::time::Duration;

use super::finding::Cause;
use super::signatures::{has_only_a_wrong_key, last_keyed};
use crate::doctor::{Chart, Sender, Way};
use crate::geo::maths;

const QUERY_EVERY: Duration = Duration::from_secs(5);
/// The minimum time that a vehicle is given to answer.
const ANSWER_WITHIN: Duration = Duration::from_secs(12);
/// The minimum silence after which a vehicle that has answered before counts as one-way.
const ANSWERS_AGAIN_WITHIN: Duration = Duration::from_secs(30);
/// The number of sent messages after which an answer is expected.
const ASKED_ENOUGH: u64 = 3;
/// The accepted probability, on a link with losses, that a vehicle seems not to answer although it
/// does.
const MISTAKEN: f64 = 0.001;
/// The maximum number of queries to wait for, however many frames the link loses.
const MOST_QUERIES: u32 = 60;

/// The number of consecutive unanswered queries that almost certainly show that a vehicle does not
/// answer, if the share `lost` of the frames is lost in each direction.
pub(super) fn queries_without_doubt(lost: f64) -> u32 {
    let answered = (1.0 - lost) * (1.0 - lost);
    // The lower limit means no loss; the upper one keeps the logarithm below 0 at total loss.
    let missed = (1.0 - answered).clamp(0.0, 0.99);
    let queries = (maths::ln(MISTAKEN) / maths::ln(missed)).ceil();
    queries.min(f64::from(MOST_QUERIES)) as u32
}

/// The finding about whether a vehicle answers the console's messages: it does not if at least
/// `queries` messages are unanswered. `None` if there is nothing to report.
pub(super) fn answering(chart: &Chart, sender: &Sender, queries: u32) -> Option<Cause> {
    let (way, system) = (chart.way(), sender.source.system);
    let is_foreign = sender.signed && !last_keyed(chart).contains(&system);
    let patience = QUERY_EVERY * queries;
    let answers = sender
        .answered_ago
        .is_some_and(|ago| ago < patience.max(ANSWERS_AGAIN_WITHIN));
    if answers || way == Way::File {
        return is_foreign.then_some(Cause::SignedButAnswers(system));
    }
    let asked_enough = ASKED_ENOUGH.max(queries.into());
    if sender.known_for < patience.max(ANSWER_WITHIN) || sender.asked < asked_enough {
        return is_foreign.then_some(Cause::Signed(system));
    }
    if is_foreign {
        Some(Cause::Signed(system))
    } else {
        // A vehicle with another key ignores the frames of this one, although it receives them.
        (!has_only_a_wrong_key(chart, sender)).then_some(Cause::OneWay(system))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_more_frames_are_lost_the_more_queries_count() {
        let queries = |percent: u32| queries_without_doubt(f64::from(percent) / 100.0);
        assert_eq!(
            [0, 5, 30, 50, 100].map(queries),
            [0, 3, 11, 25, MOST_QUERIES]
        );
    }
}
