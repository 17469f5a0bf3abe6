//! What a seat has said on one connection.

use std::time::Duration;

use super::insight::InsightSender;
use super::protocol::{DeskMessage, Hello, SeatMessage, VERSION};
use super::watch::{Picture, PictureSender};
use super::{
    Consent, Insight, Piece, PieceRequest, RecordName, Seat, SeatReport, TryHead, TryName,
};

/// The time between two reports.
pub const REPORT_EVERY: Duration = Duration::from_millis(500);
/// The time between two heads of an exam's record.
pub const HEAD_EVERY: Duration = Duration::from_secs(10);
/// The time after which a head is sent again that the desk has not noted: it may not know yet that the try is open.
const HEAD_AGAIN: Duration = Duration::from_secs(2);

/// The time without an answer of the desk after which a record is offered again.
const SUBMIT_AGAIN: Duration = Duration::from_secs(10);

/// Where a seat's state, screen and records come from, when they are needed.
pub trait SeatSource {
    /// The state of the seat.
    fn report(&self) -> SeatReport;
    /// The screen as the trainee sees it; `None` without one.
    fn picture(&self) -> Option<Picture>;
    /// What is behind the screen; `None` without a flight.
    fn insight(&self) -> Option<Insight>;
    /// A piece of a record; `None` until it is read.
    fn piece(&self, request: &PieceRequest) -> Option<Piece>;
    /// How far the record of an exam's try has grown; `None` if none is flown.
    fn head(&self) -> Option<TryHead>;
}

/// A seat's half of one connection. A new connection needs a new one.
#[derive(Debug, Clone, Default)]
pub struct SeatLine {
    has_greeted: bool,
    /// The number of the next entry; `None` until the desk has asked.
    next_entry: Option<u64>,
    next_report: Option<Duration>,
    /// When the last head was sent; a new connection begins with one.
    head_sent: Option<Duration>,
    is_head_noted: bool,
    /// The try of which a head was sent after its flight.
    end_sent: Option<TryName>,
    /// What the desk has seen of the screen, while it watches.
    screen: Option<PictureSender>,
    /// What the desk knows of what is behind the screen, while it watches.
    insight: Option<InsightSender>,
    /// The record that is being handed in.
    submitted: Option<Submitted>,
}

/// A record that was offered on this connection.
#[derive(Debug, Clone)]
struct Submitted {
    record: RecordName,
    /// When it was offered, or a piece of it was sent.
    at: Duration,
    /// What the desk has asked for.
    asked: Option<PieceRequest>,
}

impl SeatLine {
    /// Takes in a line of the desk, as far as it concerns what is to be said. The rest is for [`Seat`].
    pub fn hear(&mut self, message: &DeskMessage) {
        match message {
            DeskMessage::Ask { from } => self.next_entry = Some(*from),
            DeskMessage::Watch { on, insight } => {
                self.screen = on.then(PictureSender::default);
                self.insight = insight.then(InsightSender::default);
            }
            DeskMessage::Fetch(request) => {
                if let Some(submitted) = &mut self.submitted
                    && submitted.record == request.record
                {
                    submitted.asked = Some(request.clone());
                }
            }
            DeskMessage::Settled { .. } => self.submitted = None,
            DeskMessage::Witnessed { .. } => self.is_head_noted = true,
            DeskMessage::Welcome { .. }
            | DeskMessage::Denied(_)
            | DeskMessage::Order(_)
            | DeskMessage::Show(_)
            | DeskMessage::Hide
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
                name: seat.name().cloned(),
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
        if let Some(head) = self.next_head(source, now) {
            return Some(SeatMessage::Head(head));
        }
        if let Some(watched) = self.next_watched(source, now) {
            return Some(watched);
        }
        if let Some(next) = self.next_entry
            && let Some(batch) = seat.journal().from(next)
        {
            self.next_entry = batch.entries.last().map(|entry| entry.number + 1);
            return Some(SeatMessage::Entries(batch));
        }
        self.hand_in(seat, source, now)
    }

    /// What the desk that watches has not seen yet: of the screen, and of what is behind it.
    fn next_watched(&mut self, source: &impl SeatSource, now: Duration) -> Option<SeatMessage> {
        if let Some(screen) = &mut self.screen
            && let Some(part) = screen.next(|| source.picture(), now)
        {
            return Some(SeatMessage::Screen(part));
        }
        let insight = self.insight.as_mut()?.next(|| source.insight(), now)?;
        Some(SeatMessage::Insight(Box::new(insight)))
    }

    /// The head of an exam's record, if one is due: at once after the flight, before the record is handed in.
    fn next_head(&mut self, source: &impl SeatSource, now: Duration) -> Option<TryHead> {
        let wait = if self.is_head_noted {
            HEAD_EVERY
        } else {
            HEAD_AGAIN
        };
        let head = source.head()?;
        let is_end = head.is_over && self.end_sent.as_ref() != Some(&head.name);
        if !is_end && self.head_sent.is_some_and(|sent| now < sent + wait) {
            return None;
        }
        if head.is_over {
            self.end_sent = Some(head.name.clone());
        }
        (self.head_sent, self.is_head_noted) = (Some(now), false);
        Some(head)
    }

    /// The next line about a record, after everything else: a record waits for the class, not the class for a record.
    fn hand_in(
        &mut self,
        seat: &Seat,
        source: &impl SeatSource,
        now: Duration,
    ) -> Option<SeatMessage> {
        let submission = seat.hand_in().next(now)?;
        let known = self.submitted.as_mut();
        if let Some(submitted) = known.filter(|it| it.record == submission.record) {
            if let Some(piece) = submitted.asked.as_ref().and_then(|it| source.piece(it)) {
                (submitted.asked, submitted.at) = (None, now);
                return Some(SeatMessage::Piece(piece));
            }
            // Also if the piece could not be read: the desk then asks for it again.
            if now < submitted.at + SUBMIT_AGAIN {
                return None;
            }
        }
        self.submitted = Some(Submitted {
            record: submission.record.clone(),
            at: now,
            asked: None,
        });
        Some(SeatMessage::Submit(submission.clone()))
    }
}
