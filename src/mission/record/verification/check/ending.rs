//! The end of a record: the score, or how far a record without an end goes.

use std::time::Duration;

use super::{RecordCheck, steps};
use crate::ledger::RowState;
use crate::mission::record::RecordExtent;
use crate::mission::record::line::ShownVehicles;
use crate::mission::record::verification::reflight::{Divergence, LATE_AT_MOST, SHOWN_WITHIN};
use crate::mission::record::{End, Rescored, Stored};
use crate::mission::{Stake, TICK};
use crate::scoring::Report;
use crate::text;

impl RecordCheck {
    /// How much of the flight was compared.
    pub(in crate::mission::record::verification) fn extent(&self, stored: &Stored) -> RecordExtent {
        if !stored.is_open() {
            return RecordExtent::Whole;
        }
        RecordExtent::Part {
            to: self.ticked,
            went_on: self.went_on,
        }
    }

    /// Whether a line is later than the last line of an input log without an end.
    pub(super) fn is_beyond_cut(&self, shown: &ShownVehicles<'_>) -> bool {
        let at = shown.simulated.unwrap_or(shown.mission);
        self.reflight.is_cut && at > self.reflight.lasts()
    }

    /// Flies on to the end of the input log; returns whether the vehicles show changes that the
    /// record should contain after its last line. A killed console loses the last moments, so
    /// changes in that time are not counted.
    pub(super) fn goes_on(&mut self) -> Result<bool, Divergence> {
        let lasts = self.reflight.lasts();
        let lost = SHOWN_WITHIN.mul_f64(self.reflight.pace).min(LATE_AT_MOST);
        if lasts <= self.seen_to + lost {
            return Ok(false);
        }
        let mut at = self.seen_to + TICK;
        while at < lasts {
            self.reflight.fly_to(steps(at))?;
            if self.compare_all(at, at.saturating_sub(lost), at).is_err() {
                return Ok(true);
            }
            at += TICK;
        }
        Ok(false)
    }

    /// Checks that the refusals and the score follow from the flight.
    pub(in crate::mission::record::verification) fn compare_end(
        &mut self,
        stored: &Stored,
        rescored: &Rescored,
    ) -> Result<(), Divergence> {
        if !stored.is_open() {
            self.compare_wanted()?;
        }
        drop(self.reenactment.advance(Duration::MAX));
        self.compare_refusals(stored)?;
        if !stored.is_open() {
            return self.compare_outcome(stored, &rescored.report);
        }
        if self.reenactment.flight().is_over() {
            return Err(self.reflight.differs(None, text!("verify-end-removed")));
        }
        Ok(())
    }

    /// Checks that the record contains every command that a vehicle refused; if the record has no
    /// end, only the refusals that had time to be recorded.
    fn compare_refusals(&self, stored: &Stored) -> Result<(), Divergence> {
        let is_open = stored.is_open();
        let until = if is_open {
            self.seen_to.saturating_sub(LATE_AT_MOST)
        } else {
            Duration::MAX
        };
        for witness in &self.reflight.witnesses {
            let id = witness.session.vehicle().id;
            let admitted = self.reenactment.tries_of(id, |state| {
                is_admitted(state) || is_open && !state.is_final()
            });
            let refused = witness.refusals(until);
            if refused > admitted && !self.muffled.contains_key(&id) {
                let what = text!("verify-refusals", refused = refused, admitted = admitted);
                return Err(self.reflight.differs(Some(id), what));
            }
        }
        Ok(())
    }

    /// Checks that the record ends with the score that follows from it.
    fn compare_outcome(&self, stored: &Stored, report: &Report) -> Result<(), Divergence> {
        let again = End {
            score: report.score,
            medal: report.medal,
            passed: report.passed,
            sim_time_s: report.sim_time_s,
        };
        match stored.end() {
            Some(end)
                if *end == again && stored.head.stake == Stake::Exam && stored.has_pauses() =>
            {
                Err(self.reflight.differs(None, text!("verify-exam-paused")))
            }
            Some(end) if *end == again => Ok(()),
            Some(end) if end.score == again.score => {
                Err(self.reflight.differs(None, text!("verify-other-end")))
            }
            Some(end) => {
                let what = text!(
                    "verify-other-score",
                    recorded = end.score,
                    score = again.score
                );
                Err(self.reflight.differs(None, what))
            }
            None => Err(self.reflight.differs(None, text!("record-no-end"))),
        }
    }
}

/// Whether a row with this state admits that the vehicle refused a command.
fn is_admitted(state: RowState) -> bool {
    match state {
        RowState::Refused
        | RowState::Superseded
        | RowState::Overtaken
        | RowState::Barred
        | RowState::TimedOut
        | RowState::NoEffect => true,
        RowState::Queued
        | RowState::Sent
        | RowState::SentOnly
        | RowState::InProgress(_)
        | RowState::Accepted
        | RowState::Done => false,
    }
}
