//! The connection of a seat.

use std::time::Duration;

use super::seat_files::{self, SeatAnswer, SeatTask};
use super::worker::Worker;
use super::{ClassArrival, ClassSight, OpenLine, or_never};
use crate::app::State;
use crate::app::effect::ClassEffect;
use crate::app::event::ClassEvent;
use crate::carrier::{ClassPlace, SeatArrival, SeatPort};
use crate::class::protocol::DeskMessage;
use crate::class::{
    Consent, Insight, Picture, Piece, PieceRequest, Seat, SeatLine, SeatReport, SeatSource, TryHead,
};
use crate::scoring::FlownBy;
use crate::shell::{Console, ConsoleOptions};
use crate::store::WaitingRecords;
use crate::text::Text;

/// The time without a tick after which the process must have been stopped.
const STOOD_STILL: Duration = Duration::from_secs(2);
/// The time after that in which what has waited meanwhile arrives.
const CATCHES_UP: Duration = Duration::from_secs(1);

/// The connection of a seat.
pub(in crate::shell) struct SeatEnd {
    place: ClassPlace,
    /// Whether a script or a program gives the commands.
    by_script: bool,
    pauses: ProcessPauses,
    /// `None` while the trainee does not want to join.
    port: Option<SeatPort>,
    pub(super) open: Option<OpenLine<SeatLine>>,
    /// Reads the records that are handed in; `None` if flights are not recorded.
    pub(super) files: Option<Worker<SeatTask, SeatAnswer>>,
    /// The piece that was read last.
    piece: Option<Piece>,
}

/// When this process was stopped, by the wall clock.
#[derive(Debug, Default)]
struct ProcessPauses {
    last_tick: Option<Duration>,
    ended: Option<Duration>,
}

impl ProcessPauses {
    fn note(&mut self, tick: Duration) {
        if self.is_now(tick) {
            self.ended = Some(tick);
        }
        self.last_tick = Some(tick);
    }

    fn is_now(&self, now: Duration) -> bool {
        self.last_tick.is_some_and(|tick| now >= tick + STOOD_STILL)
    }

    /// Whether the process was stopped, and has gone on for less than a second.
    fn is_fresh(&self, now: Duration) -> bool {
        self.is_now(now) || self.ended.is_some_and(|ended| now < ended + CATCHES_UP)
    }
}

impl SeatEnd {
    /// The end of a seat that is not connected yet.
    pub fn new(place: &ClassPlace, options: &ConsoleOptions) -> Self {
        let records = options.preferences.records.as_ref();
        let waiting = records.map(|records| WaitingRecords::new(records, place.id()));
        Self {
            place: place.clone(),
            by_script: options.flown_by() != FlownBy::Hand,
            pauses: ProcessPauses::default(),
            port: None,
            open: None,
            files: waiting.and_then(seat_files::start),
            piece: None,
        }
    }

    /// Waits for the next arrival.
    pub async fn next(&mut self) -> ClassArrival {
        let port = self.port.as_mut().map(SeatPort::next);
        let files = self.files.as_mut().map(Worker::next);
        tokio::select! {
            arrival = or_never(port) => ClassArrival::AtSeat(arrival),
            answers = or_never(files) => ClassArrival::OfSeatFiles(answers),
        }
    }

    /// Ends the connection.
    pub async fn close(self) {
        if let Some(port) = self.port {
            port.close().await;
        }
    }

    /// Does what the state asks for.
    pub fn carry_out(&mut self, effect: ClassEffect) {
        let Some(files) = &mut self.files else {
            return;
        };
        match effect {
            ClassEffect::HandIn(record) => files.give(SeatTask::Offer(record)),
            ClassEffect::Settle(record) => files.give(SeatTask::Settle(record)),
            _ => {}
        }
    }

    /// Reads what the desk needs.
    fn prepare(&mut self, message: &DeskMessage) {
        let Some(files) = &mut self.files else {
            return;
        };
        match message {
            DeskMessage::Welcome { .. } => files.give(SeatTask::Look),
            DeskMessage::Fetch(request) => files.give(SeatTask::Read(request.clone())),
            _ => {}
        }
    }

    /// Says what the desk does not know yet.
    pub(super) fn tell(&mut self, seat: &Seat, state: &State, sight: &ClassSight<'_>) {
        self.pauses.note(state.wall());
        if seat.consent() == Consent::Declined {
            (self.port, self.open) = (None, None);
            return;
        }
        if self.port.is_none() {
            self.port = Some(self.place.join());
        }
        let Some(OpenLine { outbox, line }) = &mut self.open else {
            return;
        };
        let view = SeatView {
            state,
            by_script: self.by_script,
            sight,
            piece: self.piece.as_ref(),
        };
        while outbox.has_room() {
            match line.next(seat, &view, state.wall()) {
                Some(message) => outbox.send(&message),
                None => return,
            }
        }
    }
}

/// What a seat tells its desk.
struct SeatView<'a> {
    state: &'a State,
    by_script: bool,
    sight: &'a ClassSight<'a>,
    /// The piece that was read last.
    piece: Option<&'a Piece>,
}

impl SeatSource for SeatView<'_> {
    fn report(&self) -> SeatReport {
        self.state.seat_report(self.by_script)
    }

    fn picture(&self) -> Option<Picture> {
        (self.sight.picture)()
    }

    fn insight(&self) -> Option<Insight> {
        self.state.insight(&(self.sight.truth)())
    }

    fn head(&self) -> Option<TryHead> {
        let name = self.state.class_role().seat()?.flown_try()?.clone();
        let head = (self.sight.head)()?;
        Some(TryHead {
            name,
            is_over: self.state.session().is_over(),
            head,
        })
    }

    fn piece(&self, request: &PieceRequest) -> Option<Piece> {
        self.piece.filter(|piece| piece.of == *request).cloned()
    }
}

impl Console {
    /// Takes in what has arrived from the desk.
    pub(super) async fn attend_seat(&mut self, end: &mut SeatEnd, arrival: SeatArrival) {
        match arrival {
            SeatArrival::Found { desk, outbox } => {
                end.open = Some(OpenLine::new(outbox));
                let instructor = desk.user;
                self.feed(ClassEvent::Found { instructor }).await;
            }
            // It may have waited for long, so that the desk has given it up; if not, the desk repeats it.
            SeatArrival::Line(Ok(DeskMessage::Order(_)))
                if end.pauses.is_fresh(self.clock.wall()) => {}
            SeatArrival::Line(Ok(message)) => {
                if let Some(open) = &mut end.open {
                    open.line.hear(&message);
                }
                end.prepare(&message);
                self.feed(ClassEvent::Said(message)).await;
            }
            // The carrier ends the connection.
            SeatArrival::Line(Err(fault)) => tracing::warn!("a line of the desk: {fault}"),
            SeatArrival::Lost => {
                end.open = None;
                self.feed(ClassEvent::Lost).await;
            }
            SeatArrival::Refused(fault) => {
                self.feed(ClassEvent::Refused(Text::from(&*fault))).await;
            }
        }
    }

    /// Takes in what the thread has read.
    pub(super) async fn take_seat_answers(&mut self, end: &mut SeatEnd, answers: Vec<SeatAnswer>) {
        for answer in answers {
            match answer {
                SeatAnswer::Event(event) => self.feed(*event).await,
                SeatAnswer::Piece(piece) => end.piece = Some(piece),
            }
        }
    }
}
