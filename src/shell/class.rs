//! A console in a class: as a seat, or as the desk.
//!
//! The console never waits for the other side. What arrives becomes an event like any other. What is to be said is
//! found by comparing the state with what the connection has said already, and only as far as its queue has room.

use std::collections::BTreeMap;
use std::time::Duration;

use rand::TryRng as _;
use rand::rngs::SysRng;

use super::{Console, RunningSession};
use crate::app::State;
use crate::app::effect::ClassEffect;
use crate::app::event::ClassEvent;
use crate::app::state::{ClassRole, SeatPlace};
use crate::carrier::{
    ClassFault, ClassPlace, DeskArrival, DeskPort, Outbox, SeatArrival, SeatPort, unix,
};
use crate::class::protocol::{Denial, DeskMessage};
use crate::class::{
    ConnectionId, Consent, Desk, DeskLine, Picture, Refusal, Seat, SeatLine, SeatReport, SeatSource,
};
use crate::mission::{Flight, InjectFault};
use crate::record::Happening;
use crate::scoring::FlownBy;
use crate::text::Text;

/// The time without a tick after which the process must have been stopped.
const STOOD_STILL: Duration = Duration::from_secs(2);
/// The time after that in which what has waited meanwhile arrives.
const CATCHES_UP: Duration = Duration::from_secs(1);

/// The console's part in a class.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ClassOptions {
    pub place: ClassPlace,
    pub part: ClassPart,
}

#[derive(Debug, Clone, PartialEq, Eq)]
pub enum ClassPart {
    /// A trainee's place in the class.
    Seat {
        /// Whether the trainee is asked before the console joins.
        asks: bool,
    },
    /// The desk of the class, for the instructor.
    Desk {
        /// The name of the class.
        name: String,
    },
}

impl ClassOptions {
    /// The console's part before anything has happened.
    pub(super) fn role(&self) -> ClassRole {
        // Numbers that another run of the program has only by a rare accident, which would hide a seat or an order.
        let number = SysRng.try_next_u64().unwrap_or_default();
        match &self.part {
            ClassPart::Seat { asks } => {
                let consent = if *asks {
                    Consent::Unasked
                } else {
                    Consent::Given
                };
                ClassRole::Seat(Box::new(SeatPlace::new(Seat::new(number, consent))))
            }
            ClassPart::Desk { name } => {
                ClassRole::Desk(Box::new(Desk::new(number, name.as_str().into())))
            }
        }
    }
}

/// The console's connections in a class.
pub(super) enum ClassEnd {
    None,
    Seat(Box<SeatEnd>),
    Desk(DeskEnd),
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

/// The connection of a seat.
pub(super) struct SeatEnd {
    place: ClassPlace,
    /// Whether a script or a program gives the commands.
    by_script: bool,
    pauses: ProcessPauses,
    /// `None` while the trainee does not want to join.
    port: Option<SeatPort>,
    open: Option<OpenLine<SeatLine>>,
}

/// The connections of a desk.
pub(super) struct DeskEnd {
    port: DeskPort,
    open: BTreeMap<ConnectionId, DeskConnection>,
}

/// A connection, and what has been said on it.
struct OpenLine<L> {
    outbox: Outbox,
    line: L,
}

impl<L: Default> OpenLine<L> {
    fn new(outbox: Outbox) -> Self {
        Self {
            outbox,
            line: L::default(),
        }
    }
}

/// A connection to a seat.
struct DeskConnection {
    /// The user at the other end.
    user: String,
    open: OpenLine<DeskLine>,
}

/// What arrives from the other side.
pub(super) enum ClassArrival {
    AtSeat(SeatArrival),
    AtDesk(DeskArrival),
}

impl ClassEnd {
    /// Opens the desk, or begins to look for one.
    ///
    /// # Errors
    /// The desk cannot be opened.
    pub fn open(options: Option<&ClassOptions>, flown_by: FlownBy) -> Result<Self, ClassFault> {
        let Some(ClassOptions { place, part }) = options else {
            return Ok(Self::None);
        };
        Ok(match part {
            ClassPart::Seat { .. } => Self::Seat(Box::new(SeatEnd {
                place: place.clone(),
                by_script: flown_by != FlownBy::Hand,
                pauses: ProcessPauses::default(),
                port: None,
                open: None,
            })),
            ClassPart::Desk { .. } => Self::Desk(DeskEnd {
                port: unix::open(place)?,
                open: BTreeMap::new(),
            }),
        })
    }

    /// Waits for the next arrival; without a class, it waits forever.
    pub async fn next(&mut self) -> ClassArrival {
        let arrival = match self {
            Self::Seat(seat) => match &mut seat.port {
                Some(port) => port.next().await.map(ClassArrival::AtSeat),
                None => None,
            },
            Self::Desk(desk) => desk.port.next().await.map(ClassArrival::AtDesk),
            Self::None => None,
        };
        match arrival {
            Some(arrival) => arrival,
            None => std::future::pending().await,
        }
    }

    /// Says what the other side does not know yet. `picture` takes the screen, if there is one.
    pub fn tell(&mut self, state: &State, picture: &dyn Fn() -> Option<Picture>) {
        match (self, state.class_role()) {
            (Self::Seat(end), ClassRole::Seat(place)) => {
                end.tell(place.seat(), state, picture);
            }
            (Self::Desk(end), ClassRole::Desk(desk)) => end.tell(desk, state),
            _ => {}
        }
    }
}

impl SeatEnd {
    fn tell(&mut self, seat: &Seat, state: &State, picture: &dyn Fn() -> Option<Picture>) {
        self.pauses.note(state.wall());
        if seat.consent() == Consent::Declined {
            (self.port, self.open) = (None, None);
            return;
        }
        if self.port.is_none() {
            self.port = Some(unix::join(self.place.clone()));
        }
        let Some(OpenLine { outbox, line }) = &mut self.open else {
            return;
        };
        let view = SeatView {
            state,
            by_script: self.by_script,
            picture,
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
    picture: &'a dyn Fn() -> Option<Picture>,
}

impl SeatSource for SeatView<'_> {
    fn report(&self) -> SeatReport {
        self.state.seat_report(self.by_script)
    }

    fn picture(&self) -> Option<Picture> {
        (self.picture)()
    }
}

impl DeskEnd {
    fn tell(&mut self, desk: &Desk, state: &State) {
        for (&connection, DeskConnection { open, .. }) in &mut self.open {
            while open.outbox.has_room() {
                match open.line.next(desk, connection, state.wall()) {
                    Some(message) => open.outbox.send(&message),
                    None => break,
                }
            }
        }
    }

    /// Ends connections, with the reason.
    fn deny(&mut self, denials: impl IntoIterator<Item = (ConnectionId, Denial)>) {
        for (connection, denial) in denials {
            if let Some(denied) = self.open.remove(&connection) {
                denied.open.outbox.send(&DeskMessage::Denied(denial));
            }
        }
    }
}

impl Console {
    /// Takes in what has arrived from the other side of a class.
    pub(super) async fn attend(&mut self, end: &mut ClassEnd, arrival: ClassArrival) {
        match (end, arrival) {
            (ClassEnd::Seat(end), ClassArrival::AtSeat(arrival)) => {
                self.attend_seat(end, arrival).await;
            }
            (ClassEnd::Desk(end), ClassArrival::AtDesk(arrival)) => {
                self.attend_desk(end, arrival).await;
                end.deny(std::mem::take(&mut self.denials));
            }
            _ => {}
        }
    }

    async fn attend_seat(&mut self, end: &mut SeatEnd, arrival: SeatArrival) {
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
                self.feed(ClassEvent::Said(message)).await;
            }
            // The carrier ends the connection.
            SeatArrival::Line(Err(fault)) => tracing::warn!("a line of the desk: {fault}"),
            SeatArrival::Lost => {
                end.open = None;
                self.feed(ClassEvent::Lost).await;
            }
            SeatArrival::Refused(fault) => {
                self.feed(ClassEvent::Refused(Text::from(&fault))).await;
            }
        }
    }

    async fn attend_desk(&mut self, end: &mut DeskEnd, arrival: DeskArrival) {
        match arrival {
            DeskArrival::Opened {
                connection,
                peer,
                outbox,
            } => {
                let opened = DeskConnection {
                    user: peer.user,
                    open: OpenLine::new(outbox),
                };
                end.open.insert(connection, opened);
            }
            DeskArrival::Line {
                from,
                line: Ok(message),
            } => {
                // One that was denied may have sent more.
                let Some(known) = end.open.get(&from) else {
                    return;
                };
                let event = ClassEvent::Heard {
                    connection: from,
                    user: known.user.clone(),
                    message,
                };
                self.feed(event).await;
            }
            // The carrier ends the connection.
            DeskArrival::Line {
                line: Err(fault), ..
            } => {
                tracing::warn!("a line of a seat: {fault}");
            }
            DeskArrival::Closed(connection) => {
                end.open.remove(&connection);
                self.feed(ClassEvent::Left(connection)).await;
            }
        }
    }

    /// Does something in the flight for the instructor; returns why it is not possible.
    fn instruct(
        &mut self,
        deed: impl FnOnce(&mut Flight) -> Result<(), InjectFault>,
    ) -> Option<Refusal> {
        let flight = self.running.as_mut().and_then(RunningSession::instructed);
        let Some(flight) = flight else {
            return Some(Refusal::NoMission);
        };
        match deed(flight) {
            Ok(()) => None,
            Err(InjectFault::Over) => Some(Refusal::NotFlying),
            Err(InjectFault::NotAllowed(_)) => Some(Refusal::NoInject),
            Err(InjectFault::Condition(_)) => Some(Refusal::Condition),
        }
    }

    /// Does something for the class.
    pub(super) fn serve_class(&mut self, effect: ClassEffect) {
        let now = self.clock.now();
        match effect {
            ClassEffect::Mark { id, text } => {
                let running = self.running.as_ref().filter(|it| it.is_recording());
                if let Some(running) = running {
                    running.note_down(now, Happening::Bookmark { text });
                }
                let refusal = running.is_none().then_some(Refusal::NotRecorded);
                self.post(ClassEvent::Begun { id, refusal });
            }
            ClassEffect::Inject { id, name, when } => {
                let refusal = self.instruct(|flight| match &when {
                    Some(when) => flight.arm(&name, when),
                    None => flight.inject(&name).map(drop),
                });
                self.post(ClassEvent::Begun { id, refusal });
            }
            ClassEffect::Disarm { id, name } => {
                let refusal = self.instruct(|flight| {
                    flight.disarm(name.as_deref());
                    Ok(())
                });
                self.post(ClassEvent::Begun { id, refusal });
            }
            ClassEffect::Note(line) => {
                if let Some(running) = &self.running {
                    running.note_down(now, Happening::Desk(line));
                }
            }
            ClassEffect::Deny { connection, denial } => self.denials.push((connection, denial)),
        }
    }
}

#[cfg(test)]
mod tests;
