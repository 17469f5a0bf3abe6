//! The records that a seat hands in when its console ends.

use std::time::Duration;

use tokio::time::Instant;

use super::ClassEnd;
use crate::app::State;
use crate::app::event::ClassEvent;
use crate::class::RecordName;
use crate::shell::Console;

/// How long the end of the console may wait for the desk. What is not handed in by then waits for the next console.
const LAST_RECORDS: Duration = Duration::from_secs(3);

impl Console {
    /// The record of a mission is complete.
    pub(in crate::shell) fn note_record(&mut self, record: String) {
        // The name of a mission that is no name of a record is never handed in.
        if let Ok(record) = RecordName::try_from(record) {
            self.post(ClassEvent::Recorded(record));
        }
    }

    /// Hands in what waits before the console ends, if the desk is there.
    pub(in crate::shell) async fn hand_in_rest(&mut self, end: &mut ClassEnd) {
        let until = Instant::now() + LAST_RECORDS;
        self.take_in().await;
        loop {
            end.carry_out(std::mem::take(&mut self.class_work));
            self.tell_class(end, &|| None);
            if !end.has_records(self.app.state()) {
                return;
            }
            tokio::select! {
                arrival = end.next() => self.attend(end, arrival).await,
                () = tokio::time::sleep_until(until) => return,
            }
        }
    }
}

impl ClassEnd {
    /// Whether there are records that the desk can have now, or, at the desk, whether records or grades are written.
    fn has_records(&self, state: &State) -> bool {
        let end = match self {
            Self::Seat(end) => end,
            Self::Desk(end) => return end.is_busy(),
            Self::None => return false,
        };
        let (Some(files), Some(place)) = (&end.files, state.class_role().seat()) else {
            return false;
        };
        let seat = place.seat();
        let is_there = end.open.is_some() && seat.class().is_some();
        let waits = seat.hand_in().next(state.wall()).is_some();
        files.is_busy() || (is_there && waits)
    }
}
