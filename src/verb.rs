//! What is known about a verb besides its grammar: how its orders are sent, what they move, how they count.
//!
//! Each [`Verb`] is part of its row of the one table, in [`language`](crate::language). The ledger keeps it with every
//! order, so that whoever judges an order reads a property here and knows no names.

use std::fmt;
use std::time::Duration;

/// A verb, or one meaning of a verb that has several.
#[derive(Clone, Copy)]
pub struct Verb {
    /// What the ledger calls it; unique in the table.
    pub name: &'static str,
    /// Whether it asks before it goes out.
    pub danger: Danger,
    /// How often and until when it is sent again.
    pub retry: Retry,
    /// How it ranks with the other orders to the same vehicle.
    pub precedence: Precedence,
    /// What it does to the movement of its vehicles.
    pub movement: Movement,
    /// How it counts in a score.
    pub counts_as: CountsAs,
}

impl Verb {
    /// One that no vehicle hears: nothing is sent, and nothing counts.
    pub const fn unsent(name: &'static str) -> Self {
        Self {
            name,
            danger: Danger::None,
            retry: Retry::new(1, 1000, 3000),
            precedence: Precedence::InTurn,
            movement: Movement::None,
            counts_as: CountsAs::Word,
        }
    }
}

/// Whether a command asks before it goes out.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Danger {
    /// It goes out at once.
    None,
    /// It names its targets and asks for a second key.
    Confirm,
}

/// When a command without an answer is sent again. A command that arrives late can do harm, so no try goes
/// out after the deadline.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Retry {
    /// Tries at most, the first included.
    pub tries: u8,
    /// The time between two.
    pub every: Duration,
    /// When to give up, counted from when the order was given.
    pub deadline: Duration,
}

impl Retry {
    /// The times are in milliseconds.
    pub const fn new(tries: u8, every_ms: u64, deadline_ms: u64) -> Self {
        Self {
            tries,
            every: Duration::from_millis(every_ms),
            deadline: Duration::from_millis(deadline_ms),
        }
    }
}

/// How an order ranks with the other orders to the same vehicle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Precedence {
    /// It waits for the answers to those before it.
    InTurn,
    /// The same, and those after it wait until its effect shows, because they depend on it.
    Awaited,
    /// It is sent at once and drops all that have not been answered.
    Urgent,
    /// As the flight mode that it asks for: modes that bring a vehicle down or stop it are urgent. Those after it wait
    /// until its effect shows.
    ByMode,
}

/// What an order does to the movement of its vehicles.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Movement {
    None,
    /// It turns the nose: the next movement takes its place.
    Turn,
    /// It moves or stops them and takes the place of the movement before.
    To(Arrival),
    /// As `To(Done)`; once in their places, it is the task of the vehicles to stay there.
    Station,
}

impl Movement {
    /// When a vehicle has arrived that was ordered so; `None` where the order leads nowhere.
    pub fn arrival(self) -> Option<Arrival> {
        match self {
            Self::None | Self::Turn => None,
            Self::To(arrival) => Some(arrival),
            Self::Station => Some(Arrival::Done),
        }
    }

    /// Whether it takes the place of the movement before.
    pub fn moves(self) -> bool {
        self.arrival().is_some()
    }

    /// Whether the next movement takes its place.
    pub fn gives_way(self) -> bool {
        match self {
            Self::None => false,
            Self::Turn | Self::To(_) | Self::Station => true,
        }
    }
}

/// When a vehicle has arrived, for `wait arrived`. When the ledger calls an order done is decided by
/// [`Effect`](crate::commands::Effect).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Arrival {
    /// When the order is done; where no effect was seen in time, when it stands still at its target.
    Done,
    /// When it stands still at its target, which an order before this one has given it.
    AtTarget,
    /// When it is on the ground.
    Landed,
    /// When it is in the mode that was asked for; if that mode brings it down, when it is on the ground.
    Mode,
}

/// How an order counts in a score.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CountsAs {
    /// A command that gives its vehicles another task.
    Task,
    /// A command that sets something besides the task, in a slot of its own.
    Setting,
    /// A question to a vehicle: it may be refused, but its acceptance is no merit.
    Question,
    /// A report of a find, which no vehicle hears: it may be refused, but its acceptance is no merit.
    Report,
    /// A word between trainee and mission: no command at all.
    Word,
    /// What trainees say of themselves: no part of the flight, and of no effect on any score.
    SelfReport,
}

impl CountsAs {
    /// Whether it is no command, but is said to the mission.
    pub fn is_said_to_mission(self) -> bool {
        match self {
            Self::Word | Self::SelfReport => true,
            Self::Task | Self::Setting | Self::Question | Self::Report => false,
        }
    }

    /// Whether vehicles are told something.
    pub fn is_for_vehicles(self) -> bool {
        match self {
            Self::Task | Self::Setting | Self::Question => true,
            Self::Report | Self::Word | Self::SelfReport => false,
        }
    }
}

impl PartialEq for Verb {
    /// Names are unique in the table.
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

impl Eq for Verb {}

impl fmt::Debug for Verb {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("Verb").field(&self.name).finish()
    }
}
