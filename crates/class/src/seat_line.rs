//! What a seat has said on one connection.

use std::time::Duration;

use super::protocol::{DeskMessage, Hello, SeatMessage, VERSION};
use super::{Consent, Seat, SeatReport};

/// The time between two reports.
pub const REPORT_EVERY: Duration = Duration::from_millis(500);

/// A seat's half of one connection. A new connection needs a new one.
#[derive(Debug, Clone, Default)]
pub struct SeatLine {
    has_greeted: bool,
    /// The number of the next entry; `None` until the desk has asked.
    next_entry: Option<u64>,
    next_report: Option<Duration>,
}

impl SeatLine {
    /// Takes in a line of the desk, as far as it concerns what is to be said. The rest is for [`Seat`].
    pub fn hear(&mut self, message: &DeskMessage) {
        if let DeskMessage::Ask { from } = message {
            self.next_entry = Some(*from);
        }
    }

    /// The next line, if there is something to say now. Nothing is said before the trainee has agreed.
    pub fn next(
        &mut self,
        seat: &Seat,
        report: impl FnOnce() -> SeatReport,
        now: Duration,
    ) -> Option<SeatMessage> {
        if seat.consent() != Consent::Given {
            return None;
        }
        if !self.has_greeted {
            self.has_greeted = true;
            return Some(SeatMessage::Hello(Hello {
                protocol: VERSION,
                sitting: seat.sitting(),
            }));
        }
        seat.class()?;
        if self.next_report.is_none_or(|due| due <= now) {
            self.next_report = Some(now + REPORT_EVERY);
            return Some(SeatMessage::Report {
                last: seat.journal().last(),
                report: Box::new(report()),
            });
        }
        let batch = seat.journal().from(self.next_entry?)?;
        self.next_entry = batch.entries.last().map(|entry| entry.number + 1);
        Some(SeatMessage::Entries(batch))
    }
}
