//! What a seat has said on one connection.

use std::time::Duration;

use super::protocol::{DeskMessage, Hello, SeatMessage, VERSION};
use super::watch::{Picture, PictureSender};
use super::{Consent, Seat, SeatReport};

/// The time between two reports.
pub const REPORT_EVERY: Duration = Duration::from_millis(500);

/// Where a seat's state and screen come from, when they are needed.
pub trait SeatSource {
    /// The state of the seat.
    fn report(&self) -> SeatReport;
    /// The screen as the trainee sees it; `None` without one.
    fn picture(&self) -> Option<Picture>;
}

/// A seat's half of one connection. A new connection needs a new one.
#[derive(Debug, Clone, Default)]
pub struct SeatLine {
    has_greeted: bool,
    /// The number of the next entry; `None` until the desk has asked.
    next_entry: Option<u64>,
    next_report: Option<Duration>,
    /// What the desk has seen of the screen, while it watches.
    screen: Option<PictureSender>,
}

impl SeatLine {
    /// Takes in a line of the desk, as far as it concerns what is to be said. The rest is for [`Seat`].
    pub fn hear(&mut self, message: &DeskMessage) {
        match message {
            DeskMessage::Ask { from } => self.next_entry = Some(*from),
            DeskMessage::Watch { on } => self.screen = on.then(PictureSender::default),
            DeskMessage::Welcome { .. }
            | DeskMessage::Denied(_)
            | DeskMessage::Order(_)
            | DeskMessage::Here => {}
        }
    }

    /// The next line, if there is something to say now. Nothing is said before the trainee has agreed.
    pub fn next(
        &mut self,
        seat: &Seat,
        source: &impl SeatSource,
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
                report: Box::new(source.report()),
            });
        }
        if let Some(screen) = &mut self.screen
            && let Some(part) = screen.next(|| source.picture(), now)
        {
            return Some(SeatMessage::Screen(part));
        }
        let batch = seat.journal().from(self.next_entry?)?;
        self.next_entry = batch.entries.last().map(|entry| entry.number + 1);
        Some(SeatMessage::Entries(batch))
    }
}
