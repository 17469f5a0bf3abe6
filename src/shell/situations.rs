//! Situations of a flight in the embedded simulator: everything from which it can continue is kept, and put back.
//!
//! The simulator and the program's clock stand while a situation is captured or recalled. The work is done at the end of the
//! tick after that, when everything on the way has arrived.

use std::time::Duration;

use super::Console;
use super::session::SessionSituation;
use crate::app::FlightSnapshot;
use crate::app::effect::SituationEffect;
use crate::app::event::{ClassEvent, SessionEvent};
use crate::class::Refusal;
use crate::record::{DeskRecord, Happening};

/// A situation of the whole console.
pub(super) struct Situation {
    /// The time on the program's clock.
    at: Duration,
    session: SessionSituation,
    shown: FlightSnapshot,
}

impl Console {
    /// Stops everything, so that what is on the way can arrive.
    pub(super) fn begin_situation(&mut self, work: SituationEffect) {
        match &work {
            SituationEffect::Capture { .. } => {
                self.running.iter().for_each(|running| running.hold(true));
                self.clock.stop();
            }
            SituationEffect::Recall { .. } => self.pause(),
        }
        self.situation_work.push_back(work);
    }

    /// Does what was begun, in its order.
    pub(super) async fn finish_situations(&mut self) {
        let mut was_recalled = false;
        while let Some(work) = self.situation_work.pop_front() {
            let (id, refusal) = match work {
                SituationEffect::Capture { id, slot } => (id, self.capture(slot).await.err()),
                SituationEffect::Recall { id, slot, line } => {
                    was_recalled = true;
                    (id, self.recall(slot, line).await.err())
                }
            };
            self.post(ClassEvent::Begun { id, refusal });
            let is_last = self.situation_work.is_empty();
            if is_last && !was_recalled && !self.app.state().session().is_paused() {
                self.clock.go_on();
                self.running.iter().for_each(|running| running.hold(false));
            }
        }
    }

    async fn capture(&mut self, slot: usize) -> Result<(), Refusal> {
        let running = self.running.as_ref().ok_or(Refusal::NotFlying)?;
        let session = running.situation().await.ok_or(Refusal::CannotFreeze)?;
        let situation = Situation {
            at: self.clock.now(),
            session,
            shown: FlightSnapshot::of(self.app.state()),
        };
        self.situations.insert(slot, situation);
        Ok(())
    }

    async fn recall(&mut self, slot: usize, line: DeskRecord) -> Result<(), Refusal> {
        let now = self.clock.now();
        let situation = self.situations.get(&slot).ok_or(Refusal::NoSituation)?;
        let running = self.running.as_mut().ok_or(Refusal::NotFlying)?;
        running.note_down(now, Happening::Desk(line));
        let record = running.leave_for(&situation.session).await;
        self.clock.go_back(situation.at);
        let notice = running.recall(&situation.session, situation.at).await;
        let shown = situation.shown.clone();
        self.next_look = situation.at;
        self.post(SessionEvent::Recalled(Box::new(shown)));
        if let Some(notice) = notice {
            self.post(notice);
        }
        if let Some(record) = record {
            self.note_record(record);
        }
        Ok(())
    }
}
