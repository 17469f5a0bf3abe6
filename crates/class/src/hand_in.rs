//! The records that a seat has to hand in.

use std::collections::VecDeque;
use std::time::Duration;

use super::{RecordName, Submission, SubmissionEnd, SubmissionRefusal};

/// The time after which a record that was refused is offered again.
const OFFER_AGAIN: Duration = Duration::from_secs(60);
/// How often a record is offered whose hash was wrong.
const TRIES: u32 = 3;
/// The maximum number of records that wait; a console keeps no more in the folder of its records.
const MOST: usize = 500;

/// The records of a seat that the desk has not acknowledged, oldest first.
#[derive(Debug, Clone, Default)]
pub struct HandIn {
    waiting: VecDeque<WaitingRecord>,
}

#[derive(Debug, Clone)]
struct WaitingRecord {
    submission: Submission,
    /// How often its hash was wrong.
    failures: u32,
    not_before: Duration,
}

/// What follows for a record from the desk's answer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum HandInOutcome {
    /// The desk keeps it.
    Kept,
    /// It is offered again later.
    Later(SubmissionRefusal),
    /// It stays at the seat.
    Never(SubmissionRefusal),
}

impl HandIn {
    /// Adds a record, or replaces what is known of it.
    pub fn offer(&mut self, submission: Submission) {
        if let Some(known) = self.find(&submission.record) {
            self.waiting[known].submission = submission;
        } else if self.waiting.len() < MOST {
            self.waiting.push_back(WaitingRecord {
                submission,
                failures: 0,
                not_before: Duration::ZERO,
            });
        }
    }

    /// The record to hand in now: the oldest one that is due.
    pub fn next(&self, now: Duration) -> Option<&Submission> {
        let due = self.waiting.iter().find(|it| it.not_before <= now)?;
        Some(&due.submission)
    }

    /// The number of records that wait.
    pub fn len(&self) -> usize {
        self.waiting.len()
    }

    /// Whether no record waits.
    pub fn is_empty(&self) -> bool {
        self.waiting.is_empty()
    }

    /// Takes in the desk's answer about a record; `None` if it does not wait.
    pub fn settle(
        &mut self,
        record: &RecordName,
        end: SubmissionEnd,
        now: Duration,
    ) -> Option<HandInOutcome> {
        let index = self.find(record)?;
        let waiting = &mut self.waiting[index];
        let SubmissionEnd::Refused(refusal) = end else {
            self.waiting.remove(index);
            return Some(HandInOutcome::Kept);
        };
        if refusal == SubmissionRefusal::Damaged {
            waiting.failures += 1;
        }
        if refusal.is_passing() && waiting.failures < TRIES {
            waiting.not_before = now + OFFER_AGAIN;
            return Some(HandInOutcome::Later(refusal));
        }
        self.waiting.remove(index);
        Some(HandInOutcome::Never(refusal))
    }

    /// The desk is another one, or back: nothing is put off any more.
    pub fn retry(&mut self) {
        for waiting in &mut self.waiting {
            waiting.not_before = Duration::ZERO;
        }
    }

    /// A record is no longer there, or cannot be read.
    pub fn forget(&mut self, record: &RecordName) {
        if let Some(index) = self.find(record) {
            self.waiting.remove(index);
        }
    }

    fn find(&self, record: &RecordName) -> Option<usize> {
        let mut waiting = self.waiting.iter();
        waiting.position(|it| it.submission.record == *record)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reception::tests::{name, submission};

    fn now(seconds: u64) -> Duration {
        Duration::from_secs(seconds)
    }

    fn refused(refusal: SubmissionRefusal) -> SubmissionEnd {
        SubmissionEnd::Refused(refusal)
    }

    #[test]
    fn a_record_waits_until_the_desk_has_it() {
        let mut hand_in = HandIn::default();
        let first = submission(b"first");
        hand_in.offer(first.clone());
        hand_in.offer(first.clone());
        assert_eq!((hand_in.len(), hand_in.next(now(0))), (1, Some(&first)));
        assert_eq!(
            hand_in.settle(&name("other"), SubmissionEnd::Kept, now(1)),
            None
        );
        let kept = hand_in.settle(&first.record, SubmissionEnd::Kept, now(1));
        assert_eq!(kept, Some(HandInOutcome::Kept));
        assert!(hand_in.is_empty());
    }

    #[test]
    fn a_full_desk_is_tried_again_without_end_and_a_wrong_hash_three_times() {
        let mut hand_in = HandIn::default();
        let record = submission(b"first").record;
        hand_in.offer(submission(b"first"));
        for minute in 0..100 {
            let full = SubmissionRefusal::Unwritable;
            let outcome = hand_in.settle(&record, refused(full), now(minute * 60));
            assert_eq!(outcome, Some(HandInOutcome::Later(full)));
            assert_eq!(hand_in.next(now(minute * 60 + 59)), None);
            assert!(hand_in.next(now(minute * 60 + 60)).is_some());
        }
        let damaged = SubmissionRefusal::Damaged;
        for (_, expected) in [
            (1, HandInOutcome::Later(damaged)),
            (2, HandInOutcome::Later(damaged)),
            (3, HandInOutcome::Never(damaged)),
        ] {
            let outcome = hand_in.settle(&record, refused(damaged), now(0));
            assert_eq!(outcome, Some(expected));
        }
        assert!(hand_in.is_empty());
    }

    #[test]
    fn a_record_that_is_put_off_holds_no_other() {
        let mut hand_in = HandIn::default();
        let first = submission(b"first");
        let second = Submission {
            record: name("second"),
            ..first.clone()
        };
        hand_in.offer(first.clone());
        hand_in.offer(second.clone());
        hand_in.settle(
            &first.record,
            refused(SubmissionRefusal::Unwritable),
            now(0),
        );
        assert_eq!(hand_in.next(now(1)), Some(&second));
        hand_in.retry();
        assert_eq!(hand_in.next(now(1)), Some(&first), "the desk is a new one");
    }
}
