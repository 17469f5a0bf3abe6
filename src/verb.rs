//! The properties of a verb besides its grammar: how its orders are sent, whether they move a
//! vehicle, and how they count.
//!
//! Each [`Verb`] is part of its row in the single table of verbs, in [`language`](crate::language).
//! The ledger stores it with every order, so code reads a property of an order here and never
//! compares names.

use std::fmt;
use std::time::Duration;

/// A verb, or one of several meanings of a verb.
#[derive(Clone, Copy)]
pub struct Verb {
    /// The verb's name in the ledger; unique in the table.
    pub name: &'static str,
    /// Whether the verb needs a confirmation.
    pub danger: Danger,
    /// The retries of the command.
    pub retry: Retry,
    /// The precedence over other orders to the same vehicle.
    pub precedence: Precedence,
    /// The effect on the movement of the vehicles.
    pub movement: Movement,
    /// How commands with the verb count in a score.
    pub counts_as: CountsAs,
    /// Who of a crew may give its orders to vehicles that others fly.
    pub duty: CrewDuty,
    /// The kinds of vehicles that cannot carry its orders out.
    pub unsuited: &'static [Unsuited],
}

impl Verb {
    /// A verb that sends nothing and does not count.
    pub const fn unsent(name: &'static str) -> Self {
        Self {
            name,
            danger: Danger::None,
            retry: Retry::ONCE,
            precedence: Precedence::InTurn,
            movement: Movement::None,
            counts_as: CountsAs::Word,
            duty: CrewDuty::Flying,
            unsuited: &[],
        }
    }
}

/// The task in a crew to which an order belongs. The pilot in command may give every order to the own vehicles.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CrewDuty {
    /// Flying a vehicle: for its pilot in command only.
    Flying,
    /// Reports and payloads: also for the crew's sensor operators, for every vehicle.
    Sensors,
    /// Making a vehicle safe: also for the crew's safety pilots, for every vehicle.
    Safety,
}

/// A kind of vehicle that cannot carry out the orders of a verb, and why.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Unsuited {
    pub kind: UnsuitedKind,
    /// The text with the reason and the way out. Its arguments are `kind`, the name of the vehicle's kind, `vehicle` and
    /// `verb`.
    pub reason: &'static str,
}

/// A kind of vehicle, as far as it decides which verbs suit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum UnsuitedKind {
    /// Rovers and boats, which have no height of their own.
    Surface,
    /// Planes with `ArduPilot`, also those that hover.
    Plane,
    /// Planes with `ArduPilot` that are not known to hover.
    FixedWing,
}

impl Unsuited {
    /// Rovers and boats, for this reason.
    pub const fn surface(reason: &'static str) -> Self {
        let kind = UnsuitedKind::Surface;
        Self { kind, reason }
    }

    /// Planes, for this reason.
    pub const fn plane(reason: &'static str) -> Self {
        let kind = UnsuitedKind::Plane;
        Self { kind, reason }
    }

    /// Planes that do not hover, for this reason.
    pub const fn fixed_wing(reason: &'static str) -> Self {
        let kind = UnsuitedKind::FixedWing;
        Self { kind, reason }
    }
}

/// Whether a command needs a confirmation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Danger {
    /// The command is sent without a confirmation.
    None,
    /// The targets are listed, and the command is sent only after a second key press.
    Confirm,
}

/// The retries of a command without an answer. A command that arrives late can do harm, so no attempt is made after
/// the deadline.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Retry {
    /// The maximum number of attempts, the first included.
    pub tries: u8,
    /// The time between two attempts.
    pub every: Duration,
    /// The deadline, counted from the time of the order.
    pub deadline: Duration,
}

impl Retry {
    /// A single attempt, for commands that must not be carried out twice.
    pub const ONCE: Self = Self::new(1, 1000, 3000);

    /// Retries with times in milliseconds.
    pub const fn new(tries: u8, every_ms: u64, deadline_ms: u64) -> Self {
        Self {
            tries,
            every: Duration::from_millis(every_ms),
            deadline: Duration::from_millis(deadline_ms),
        }
    }
}

/// The precedence of an order over other orders to the same vehicle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Precedence {
    /// The order waits for the answers to earlier orders.
    InTurn,
    /// The order waits for the answers to earlier orders, and later orders wait for its effect, on
    /// which they depend.
    Awaited,
    /// The order is sent at once and drops all orders that have not been answered.
    Urgent,
    /// The precedence depends on the flight mode: modes that land or stop a vehicle are urgent.
    /// Later orders wait for the order's effect.
    ByMode,
}

/// An order's effect on the movement of its vehicles.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Movement {
    None,
    /// The order turns the vehicle: the next movement supersedes it.
    Turn,
    /// The order moves or stops the vehicle and supersedes the previous movement.
    To(Arrival),
    /// Like `To(Done)`; once the vehicles are in their places, their task is to stay there.
    Station,
}

impl Movement {
    /// When the vehicles of an order with this movement count as arrived; `None` if it is not a
    /// movement.
    pub fn arrival(self) -> Option<Arrival> {
        match self {
            Self::None | Self::Turn => None,
            Self::To(arrival) => Some(arrival),
            Self::Station => Some(Arrival::Done),
        }
    }

    /// Whether the order supersedes the previous movement.
    pub fn moves(self) -> bool {
        self.arrival().is_some()
    }

    /// Whether the next movement supersedes the order.
    pub fn gives_way(self) -> bool {
        match self {
            Self::None => false,
            Self::Turn | Self::To(_) | Self::Station => true,
        }
    }
}

/// When a vehicle has arrived, for `wait arrived`; applied by `arrived` in `language::wait`.
/// [`Effect`](crate::commands::Effect) decides when the ledger shows an order as done.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Arrival {
    /// When the order is done; without a visible effect, when the vehicle stands still at its target.
    Done,
    /// When the vehicle stands still at the target of an earlier order.
    AtTarget,
    /// When the order is done: the vehicle is on the ground.
    Landed,
    /// When the vehicle is in the requested mode; for a landing mode, when it is on the ground.
    Mode,
}

/// How an order counts in a score.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CountsAs {
    /// A command that gives its vehicles another task.
    Task,
    /// A command that changes a setting and leaves the task alone; repeating the last line of its verb changes nothing.
    Setting,
    /// As [`CountsAs::Setting`]: another plan on board.
    PlanChange,
    /// As [`CountsAs::Setting`]: the plan on board was flown in simulation.
    Rehearsal,
    /// A query to a vehicle: a refusal counts, an acceptance earns nothing.
    Question,
    /// A report of a contact, which is not sent to vehicles: a refusal counts, an acceptance earns nothing.
    Report,
    /// A message between trainee and mission: it does not count as a command.
    Word,
    /// As [`CountsAs::Word`], but allowed before takeoff only: a prediction or a goal.
    Pledge,
    /// A trainee's self-assessment: not part of the flight, and without effect on any score.
    SelfReport,
}

impl CountsAs {
    /// Whether the order is a message to the mission or a self-assessment, instead of a command.
    pub fn is_said_to_mission(self) -> bool {
        match self {
            Self::Word | Self::Pledge | Self::SelfReport => true,
            Self::Task
            | Self::Setting
            | Self::PlanChange
            | Self::Rehearsal
            | Self::Question
            | Self::Report => false,
        }
    }

    /// Whether the order is sent to vehicles.
    pub fn is_for_vehicles(self) -> bool {
        match self {
            Self::Task | Self::Setting | Self::PlanChange | Self::Rehearsal | Self::Question => {
                true
            }
            Self::Report | Self::Word | Self::Pledge | Self::SelfReport => false,
        }
    }
}

impl PartialEq for Verb {
    /// Compares the names, which are unique in the table.
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
