//! The console's part in a class: a seat, or the desk.

use std::collections::BTreeSet;
use std::time::Duration;

use super::{Room, State};
use crate::class::{
    Consent, Danger, Deed, Desk, Happening, NotedStep, OrderId, Seat, TryName, Words,
};
use crate::ledger::EntryId;
use crate::pilot_in_command::Person;
use crate::text;
use crate::text::Text;
use crate::vehicle_id::ranges;

/// The time without a line of the desk, which says something every 2 s, after which it no longer holds a flight.
const DESK_SILENT: Duration = Duration::from_secs(10);
/// How long a desk is looked for before a notice says that none answers.
const SEARCHED: Duration = Duration::from_secs(10);

/// What a console is in a class.
#[derive(Debug, Clone, Default)]
pub enum ClassRole {
    /// Nothing: no class is configured.
    #[default]
    None,
    /// A trainee's place in the class.
    Seat(Box<SeatPlace>),
    /// The desk of the class, for the instructor.
    Desk(Box<Desk>),
}

/// A trainee's place in a class, and the reports about the present flight.
#[derive(Debug, Clone)]
pub struct SeatPlace {
    pub(in crate::app) seat: Seat,
    pub(in crate::app) search: DeskSearch,
    /// Orders whose effect has not been seen yet.
    pub(in crate::app) pending: Vec<PendingOrder>,
    /// The injects of the desk that wait for their conditions.
    pub(in crate::app) armed: Vec<ArmedOrder>,
    /// The situations that were captured in this flight.
    pub(in crate::app) situations: Vec<SeatSituation>,
    /// The step of a lesson that waits for its condition.
    pub(in crate::app) step: Option<WaitingStep>,
    /// The try of an exam that the desk has opened last.
    pub(in crate::app) exam: Option<OpenTry>,
    /// The tries that were opened at this console.
    pub(in crate::app) tries: BTreeSet<TryName>,
    /// The number of flights that this console has begun.
    pub(in crate::app) flights: u32,
    /// Whether the mission of this flight is over and was passed.
    pub(in crate::app) has_passed: bool,
    /// The room that was shown before the trainee looked on at what the desk shows.
    pub(in crate::app) looked_from: Option<Room>,
    /// Whether the desk has frozen the flight.
    pub(in crate::app) is_frozen: bool,
    /// The flight whose brief is held until the desk starts the mission.
    pub(in crate::app) held: Option<HeldBrief>,
    /// When the desk last said something, by the wall clock.
    pub(in crate::app) heard_at: Duration,
    /// When dangers were last looked for, on the console's clock.
    pub(in crate::app) looked_at: Duration,
    /// A collision or a broken fence that is near.
    pub(in crate::app) danger: Option<Danger>,
    /// The least distance between two vehicles in the air during this flight, in metres.
    pub(in crate::app) least_separation_m: Option<f64>,
    /// How often a vehicle did not carry out a command during this flight.
    pub(in crate::app) failures: u32,
}

/// How the console looks for its desk.
#[derive(Debug, Clone, Default)]
pub(in crate::app) struct DeskSearch {
    /// The class, and where its desk should be.
    place: String,
    /// Why the desk that was found there last is not joined.
    pub refused: Option<Text>,
    /// Since when no desk has answered, by the wall clock; `None` once one has.
    since: Option<Duration>,
    is_reported: bool,
}

impl DeskSearch {
    /// What to say if no desk has answered for a while, once.
    pub fn report(&mut self, wall: Duration) -> Option<Text> {
        let since = *self.since.get_or_insert(wall);
        if self.is_reported || self.refused.is_some() || wall < since + SEARCHED {
            return None;
        }
        self.is_reported = true;
        Some(text!("class-no-answer-yet", place = &self.place))
    }
}

/// An order of the desk that is being carried out.
#[derive(Debug, Clone)]
pub(in crate::app) struct PendingOrder {
    pub id: OrderId,
    pub deed: Deed,
    /// How its effect is recognised.
    pub trace: OrderTrace,
    /// When the effect must have been seen, by the wall clock.
    pub due: Duration,
}

/// How the effect of an order is recognised.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(in crate::app) enum OrderTrace {
    /// By the state of the console.
    #[default]
    State,
    /// By this entry in the ledger.
    Entry(EntryId),
    /// By one more inject: the mission had carried out the same one this often before.
    Injected(usize),
    /// By a flight after this many.
    Flight(u32),
}

/// An inject of the desk that waits for its condition.
#[derive(Debug, Clone)]
pub(in crate::app) struct ArmedOrder {
    pub id: OrderId,
    pub name: Words,
    pub when: Words,
    /// How often the mission had carried out the same one before.
    pub before: usize,
}

/// A situation that was captured, as far as the class knows it.
#[derive(Debug, Clone)]
pub(in crate::app) struct SeatSituation {
    /// Its name; its number if the instructor has not named it.
    pub name: Words,
    /// Whether the instructor has named it.
    pub is_named: bool,
    /// The time of the flight.
    pub at: Duration,
    /// The injects that waited for their conditions.
    pub armed: Vec<ArmedOrder>,
}

/// A step of a lesson that waits for its condition.
#[derive(Debug, Clone)]
pub(in crate::app) struct WaitingStep {
    pub id: OrderId,
    pub step: NotedStep,
    /// The flight that was asked to watch the condition, by its number.
    pub asked: Option<u32>,
}

/// A try of an exam at this seat.
#[derive(Debug, Clone)]
pub(in crate::app) struct OpenTry {
    pub name: TryName,
    /// The title of the exam.
    pub title: Text,
    /// The number of tries at its mission.
    pub tries: u32,
    /// The flight by its number, which may be the next one.
    pub flight: u32,
    /// When it must end, by the wall clock.
    pub until: Duration,
    /// Whether it was ended because its time is up; once is enough.
    pub is_ended: bool,
}

/// A flight whose brief is held until the desk starts the mission.
#[derive(Debug, Clone)]
pub(in crate::app) struct HeldBrief {
    /// The flight by its number, which may be the next one.
    pub flight: u32,
    pub mission: Words,
}

/// The try of an exam, for the trainee.
#[derive(Debug, Clone, Copy)]
pub struct ShownTry<'a> {
    /// The title of the exam.
    pub title: &'a Text,
    /// The number of the try at its mission, from 1.
    pub number: u32,
    /// The number of tries at its mission.
    pub tries: u32,
    /// The time that is left for it.
    pub left: Duration,
}

impl SeatPlace {
    /// A place that is not taken yet. `place` says which class it is, and where its desk should be.
    pub fn new(seat: Seat, place: String) -> Self {
        let search = DeskSearch {
            place,
            ..DeskSearch::default()
        };
        Self {
            seat,
            search,
            pending: Vec::new(),
            armed: Vec::new(),
            situations: Vec::new(),
            step: None,
            exam: None,
            tries: BTreeSet::new(),
            flights: 0,
            has_passed: false,
            looked_from: None,
            is_frozen: false,
            held: None,
            heard_at: Duration::ZERO,
            looked_at: Duration::ZERO,
            danger: None,
            least_separation_m: None,
            failures: 0,
        }
    }

    fn text(&self) -> Text {
        let seat = &self.seat;
        match (seat.consent(), seat.instructor(), seat.class()) {
            (Consent::Given, Some(instructor), Some(class)) => text!(
                "class-joined",
                class = class.as_str(),
                instructor = instructor
            ),
            (Consent::Given | Consent::Unasked, ..) => {
                let waits = || text!("class-waits", place = &self.search.place);
                self.search.refused.clone().unwrap_or_else(waits)
            }
            (Consent::Declined, ..) => text!("class-left"),
        }
    }

    /// The seat's journal and connection.
    pub fn seat(&self) -> &Seat {
        &self.seat
    }

    /// The instructor at the desk, also of one that is gone.
    pub(in crate::app) fn instructor(&self) -> Option<Person> {
        self.seat.last_instructor().map(Person::instructor)
    }

    /// Whether the desk has said something lately: one that has not holds neither the flight nor its vehicles.
    pub(in crate::app) fn hears_desk(&self, wall: Duration) -> bool {
        wall < self.heard_at + DESK_SILENT
    }

    /// Whether the desk wants to start the present flight.
    pub(in crate::app) fn is_held(&self) -> bool {
        self.held
            .as_ref()
            .is_some_and(|it| it.flight == self.flights)
    }

    /// The try of an exam that is the present flight.
    pub(in crate::app) fn open_try(&self) -> Option<&OpenTry> {
        self.exam.as_ref().filter(|it| it.flight == self.flights)
    }

    /// The name of the try of an exam that is the present flight.
    pub fn flown_try(&self) -> Option<&TryName> {
        self.open_try().map(|it| &it.name)
    }

    /// Counts what happened, and adds it to the journal if the trainee has joined: what came before is not for the desk.
    pub(in crate::app) fn note(&mut self, clock_s: Option<f64>, what: Happening) {
        match what {
            Happening::Started { ref mission } => {
                self.is_frozen = false;
                self.situations.clear();
                // A flight is never hidden by what the desk shows.
                self.seat.look_on(false);
                self.flights += 1;
                // The flight of the try could not be begun, and this is another one.
                let is_other = |it: &OpenTry| mission.as_ref() != Some(&it.name.mission);
                if self.open_try().is_some_and(is_other) {
                    self.exam = None;
                }
                let is_same = |it: &HeldBrief| mission.as_ref() == Some(&it.mission);
                // A trainee who has left the brief and opens it again still waits.
                let flight = self.flights;
                self.held = self
                    .held
                    .take()
                    .filter(is_same)
                    .map(|it| HeldBrief { flight, ..it });
                self.has_passed = false;
                self.danger = None;
                self.least_separation_m = None;
                self.failures = 0;
            }
            Happening::Failed { .. } => self.failures += 1,
            Happening::Ended { passed, .. } => self.has_passed = passed,
            Happening::Command { .. } | Happening::Objective { .. } | Happening::Order { .. } => {}
        }
        if self.seat.consent() == Consent::Given {
            self.seat.note(clock_s, what);
        }
    }
}

impl ClassRole {
    /// The console's place in a class, for its trainee.
    pub fn place_text(&self) -> Text {
        self.seat()
            .map_or_else(|| text!("class-none"), SeatPlace::text)
    }

    /// The trainee's place, if this is one.
    pub fn seat(&self) -> Option<&SeatPlace> {
        match self {
            Self::Seat(place) => Some(place),
            Self::None | Self::Desk(_) => None,
        }
    }

    /// The desk, if this is one.
    pub fn desk(&self) -> Option<&Desk> {
        match self {
            Self::Desk(desk) => Some(desk),
            Self::None | Self::Seat(_) => None,
        }
    }

    pub(in crate::app) fn seat_mut(&mut self) -> Option<&mut SeatPlace> {
        match self {
            Self::Seat(place) => Some(place),
            Self::None | Self::Desk(_) => None,
        }
    }

    pub(in crate::app) fn desk_mut(&mut self) -> Option<&mut Desk> {
        match self {
            Self::Desk(desk) => Some(desk),
            Self::None | Self::Seat(_) => None,
        }
    }

    /// The instructor whose desk watches this seat; `None` if none does.
    pub fn watcher(&self) -> Option<&str> {
        let seat = &self.seat()?.seat;
        seat.class().and(seat.instructor())
    }

    /// Whether the desk watches the screen of this seat.
    pub fn is_screen_watched(&self) -> bool {
        self.seat()
            .is_some_and(|place| place.seat.is_screen_watched())
    }

    /// Whether the desk has frozen the flight.
    pub fn is_frozen(&self) -> bool {
        self.seat().is_some_and(|place| place.is_frozen)
    }
}

impl<R> State<R> {
    /// Whether the flight is a try of an exam that is not over: the trainee can neither restart it nor leave the class.
    pub fn has_open_try(&self) -> bool {
        let open = self.class.seat().and_then(SeatPlace::open_try);
        open.is_some() && self.session.activity.is_some() && !self.session.task.over
    }

    /// Why the trainee cannot start the mission whose brief is shown: the desk does.
    pub fn holds_brief(&self) -> Option<Text> {
        let place = self.class.seat()?;
        let instructor = place.seat.last_instructor().unwrap_or_default();
        let is_held = place.is_held() && place.hears_desk(self.wall);
        let is_held = is_held && self.session.is_reading();
        is_held.then(|| text!("class-brief-held", instructor = instructor))
    }

    /// Starts the mission if it is waiting for the user to leave the brief, and the desk does not hold it.
    pub(in crate::app) fn leave_brief(&mut self) {
        if self.holds_brief().is_none() {
            self.session.leave_brief();
        }
    }

    /// At the desk: the names of seats; their number if there are many.
    pub(in crate::app) fn seat_names(&self, seats: &[usize]) -> Text {
        let known = self.class.desk().map_or(&[][..], Desk::seats);
        match seats.len() {
            0..=4 => {
                let names = seats.iter().filter_map(|&seat| known.get(seat));
                let names: Vec<&str> = names.map(|seat| seat.name.as_str()).collect();
                names.join(", ").into()
            }
            count => text!("class-seats", count = count),
        }
    }

    /// The try of an exam that is flown and not over.
    pub fn shown_try(&self) -> Option<ShownTry<'_>> {
        let open = self.class.seat()?.open_try()?;
        self.has_open_try().then(|| ShownTry {
            title: &open.title,
            number: open.name.number,
            tries: open.tries,
            left: open.until.saturating_sub(self.wall),
        })
    }

    /// Why the trainee cannot leave the class while the instructor flies vehicles; they go back without the desk.
    pub fn keeps_vehicles(&self) -> Option<Text> {
        let place = self.class.seat()?;
        let pilot = place.instructor()?;
        let vehicles = self.session.pilots.flown_by(&pilot);
        let is_held = !vehicles.is_empty() && place.hears_desk(self.wall);
        is_held.then(|| {
            let vehicles = ranges(vehicles);
            text!("pilot-keeps", pilot = pilot.name(), vehicles = vehicles)
        })
    }

    /// Why the trainee cannot resume a flight that the desk has frozen. Without the desk, or if it is silent, the trainee
    /// can.
    pub fn keeps_frozen(&self) -> Option<Text> {
        let place = self.class.seat()?;
        let instructor = self.class.watcher()?;
        let is_held = place.is_frozen && place.hears_desk(self.wall);
        is_held.then(|| text!("class-frozen", instructor = instructor))
    }
}
