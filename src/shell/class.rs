//! A console in a class: as a seat, or as the desk.
//!
//! The console never waits for the other side. What arrives becomes an event like any other. What is to be said is
//! found by comparing the state with what the connection has said already, and only as far as its queue has room.
//!
//! # How the parts fit
//! - `seat_end` and `desk_end` are the connections of either side.
//! - Records of flights go through a thread (`worker`): `seat_files` reads those that are handed in, `desk_files` keeps
//!   them and computes the results; `last_records` hands in what waits when a console ends.

use rand::TryRng as _;
use rand::rngs::SysRng;

use super::{Console, ConsoleOptions, RunningSession};
use crate::app::State;
use crate::app::effect::ClassEffect;
use crate::app::event::ClassEvent;
use crate::app::state::{ClassRole, FlightTruth, SeatPlace};
use crate::carrier::{
    ClassFault, ClassPlace, DeskArrival, DeskPlace, Outbox, SeatArrival, own_user_name,
};
use crate::class::{Consent, Desk, Picture, RecordHead, Refusal, Seat};
use crate::mission::{Flight, InjectFault};
use crate::record::Happening;
use crate::text;
use crate::ui;
use desk_end::DeskEnd;
use desk_files::DeskAnswer;
use seat_end::SeatEnd;
use seat_files::SeatAnswer;

mod desk_end;
mod desk_files;
mod exams;
mod faults;
mod last_records;
mod lessons;
mod seat_end;
mod seat_files;
mod worker;

/// The console's part in a class.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum ClassOptions {
    /// A trainee's place in the class.
    Seat {
        place: ClassPlace,
        /// Whether the trainee is asked before the console joins.
        asks: bool,
    },
    /// The desk of the class, for the instructor.
    Desk {
        place: DeskPlace,
        /// The name of the class.
        name: String,
        /// The name under which the instructor's grades are kept.
        grader: String,
    },
}

impl ClassOptions {
    /// The console's part before anything has happened.
    pub(super) fn role(&self) -> ClassRole {
        // Numbers that another run of the program has only by a rare accident, which would hide a seat or an order.
        let number = SysRng.try_next_u64().unwrap_or_default();
        match self {
            Self::Seat { place, asks } => {
                let consent = if *asks {
                    Consent::Unasked
                } else {
                    Consent::Given
                };
                ClassRole::Seat(Box::new(SeatPlace::new(
                    Seat::new(number, consent),
                    place.to_string(),
                )))
            }
            Self::Desk { name, place, .. } => {
                let instructor = own_user_name().into();
                let desk = Desk::new(number, name.as_str().into(), instructor);
                ClassRole::Desk(Box::new(match place.address() {
                    Some(address) => desk.listening_at(address.into()),
                    None => desk,
                }))
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

/// What of the console is not in its state.
struct ClassSight<'a> {
    /// Takes the screen, if there is one.
    pub picture: &'a dyn Fn() -> Option<Picture>,
    /// Takes the head of the record of the mission in flight.
    pub head: &'a dyn Fn() -> Option<RecordHead>,
    /// Takes the truth of the flight.
    pub truth: &'a dyn Fn() -> FlightTruth,
    /// At the desk: draws what it shows to the class, if that may be shown now.
    pub shown: &'a dyn Fn() -> Option<Picture>,
}

/// What arrives from the other side.
pub(super) enum ClassArrival {
    AtSeat(SeatArrival),
    AtDesk(DeskArrival),
    /// What came of reading the records of this seat.
    OfSeatFiles(Vec<SeatAnswer>),
    OfDeskFiles(Vec<DeskAnswer>),
}

impl ClassEnd {
    /// Opens the desk, or begins to look for one.
    ///
    /// # Errors
    /// The desk cannot be opened.
    pub async fn open(options: &ConsoleOptions) -> Result<Self, ClassFault> {
        Ok(match &options.class {
            None => Self::None,
            Some(ClassOptions::Seat { place, .. }) => {
                Self::Seat(Box::new(SeatEnd::new(place, options)))
            }
            Some(ClassOptions::Desk {
                place,
                name,
                grader,
            }) => {
                let port = place.open().await?;
                let files = desk_files::start(options, name, grader);
                Self::Desk(DeskEnd::new(port, files))
            }
        })
    }

    /// Waits for the next arrival; without a class, it waits forever.
    pub async fn next(&mut self) -> ClassArrival {
        match self {
            Self::Seat(seat) => seat.next().await,
            Self::Desk(desk) => desk.next().await,
            Self::None => std::future::pending().await,
        }
    }

    /// Ends the connections, so that the other side knows at once.
    pub async fn close(self) {
        match self {
            Self::Seat(seat) => seat.close().await,
            Self::Desk(desk) => desk.close().await,
            Self::None => {}
        }
    }

    /// Does what the state asks for.
    pub fn carry_out(&mut self, work: Vec<ClassEffect>) {
        for effect in work {
            match self {
                Self::Seat(end) => end.carry_out(effect),
                Self::Desk(end) => end.carry_out(effect),
                Self::None => {}
            }
        }
    }

    /// Says what the other side does not know yet.
    fn tell(&mut self, state: &State, sight: &ClassSight<'_>) {
        match (self, state.class_role()) {
            (Self::Seat(end), ClassRole::Seat(place)) => {
                end.tell(place.seat(), state, sight);
            }
            (Self::Desk(end), ClassRole::Desk(desk)) => end.tell(desk, state, sight),
            _ => {}
        }
    }
}

/// What a future brings; without one, and at its end, nothing ever comes.
async fn or_never<T>(next: Option<impl Future<Output = Option<T>>>) -> T {
    if let Some(next) = next
        && let Some(arrival) = next.await
    {
        return arrival;
    }
    std::future::pending().await
}

impl Console {
    /// Tells the other side of a class what it does not know yet. `picture` takes the screen, if there is one.
    pub(super) fn tell_class(&self, end: &mut ClassEnd, picture: &dyn Fn() -> Option<Picture>) {
        let head = || self.record_head();
        let truth = || {
            let running = self.running.as_ref();
            running.map_or_else(FlightTruth::default, RunningSession::truth)
        };
        let shown = || self.shown_to_class();
        let sight = ClassSight {
            picture,
            head: &head,
            truth: &truth,
            shown: &shown,
        };
        end.tell(self.app.state(), &sight);
    }

    /// What the desk shows to the class, drawn so that it fits the terminals of all seats that look on.
    fn shown_to_class(&self) -> Option<Picture> {
        let state = self.app.state();
        let [columns, rows] = state.class_role().desk()?.shown_size();
        let own = state.display().size();
        let size = (columns.min(own.0), rows.min(own.1));
        ui::shown_to_class(state, &self.sight.look, size)
    }

    /// Takes in what has arrived from the other side of a class.
    pub(super) async fn attend(&mut self, end: &mut ClassEnd, arrival: ClassArrival) {
        match (end, arrival) {
            (ClassEnd::Seat(end), ClassArrival::AtSeat(arrival)) => {
                self.attend_seat(end, arrival).await;
            }
            (ClassEnd::Desk(end), ClassArrival::AtDesk(arrival)) => {
                self.attend_desk(end, arrival).await;
            }
            (ClassEnd::Seat(end), ClassArrival::OfSeatFiles(answers)) => {
                self.take_seat_answers(end, answers).await;
            }
            (ClassEnd::Desk(end), ClassArrival::OfDeskFiles(answers)) => {
                self.take_desk_answers(end, answers).await;
            }
            _ => {}
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
            ClassEffect::Expect { id, when } => {
                let refusal = self.instruct(|flight| flight.expect(id, &when));
                if refusal.is_some() {
                    self.post(ClassEvent::Begun { id, refusal });
                }
            }
            ClassEffect::Note(line) => {
                if let Some(running) = &self.running {
                    running.note_down(now, Happening::Desk(line));
                }
            }
            ClassEffect::ListLessons => self.list_lessons(),
            ClassEffect::ReadLesson { name, seats } => self.read_lesson(name, seats),
            ClassEffect::ReadGraded(asked) if self.options.preferences.data.is_none() => {
                let flight = Err(text!("career-nowhere"));
                self.post(ClassEvent::Graded { asked, flight });
            }
            ClassEffect::FindFlights { .. } if self.options.preferences.data.is_none() => {
                let fault = Err(text!("career-nowhere"));
                self.post(ClassEvent::FlightsFound(fault));
            }
            ClassEffect::ReadExam { name, seats } => self.read_exam(name, seats),
            ClassEffect::HandIn(_)
            | ClassEffect::KeepNotes { .. }
            | ClassEffect::Settle(_)
            | ClassEffect::ReadGraded(_)
            | ClassEffect::FindFlights { .. }
            | ClassEffect::KeepGrades { .. }
            | ClassEffect::Receive { .. }
            | ClassEffect::Deny { .. } => self.class_work.push(effect),
        }
    }
}

#[cfg(test)]
mod tests;
