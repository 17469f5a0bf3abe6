//! The verb table: every verb, once.
//!
//! # How the parts fit
//! - For vehicles: `flight` (arm, take off, return, stop), `motion` (go, turn, climb), `swarm` (together), `plans`
//!   (the lists on board), `devices` (outputs, parameters, logs, keys), `files`, and `raw` for commands as typed.
//! - For the mission: `mission` (loads, reports, prediction). For a script: `waiting`.
//! - For the console: `console` (screen, selection), `session` (start, speed, end), `class`, `crew`, `drafts`, `replay`,
//!   `review`.
//!
//! The properties of a verb (danger, retries, precedence, when it has arrived) stand in its row.

use super::argument::{Arguments, Problem};
use super::console::ConsoleLine;
use super::verb::{Meaning, Scope, VerbRow};
use crate::commands::{Act, Command, Deed, Manoeuvre, PlanTask};
use crate::verb::{CountsAs, CrewDuty, Danger, Movement, Precedence, Retry, Verb};

mod class;
mod console;
mod crew;
mod devices;
mod drafts;
mod files;
mod flight;
mod mission;
mod motion;
mod plans;
mod raw;
mod replay;
mod review;
mod session;
mod swarm;
mod waiting;

pub(super) use drafts::arguments_of;

/// The whole table, in display order.
pub fn rows() -> impl Iterator<Item = &'static VerbRow> {
    TABLE.into_iter().flatten()
}

/// The row of a word, which may be an alias; `None` if there is none. Case does not matter.
pub fn row(word: &str) -> Option<&'static VerbRow> {
    rows().find(|row| row.is_called(word))
}

/// The verbs of orders, by their names in the ledger: `arm`, `relay to`.
pub fn verbs() -> impl Iterator<Item = &'static Verb> {
    let orders = rows().filter(|row| row.scope == Scope::Everywhere);
    orders.flat_map(VerbRow::verbs)
}

/// The verb of an order, by its name in the ledger; `None` if there is none.
pub fn verb(name: &str) -> Option<&'static Verb> {
    verbs().find(|verb| verb.name == name)
}

static TABLE: [&[VerbRow]; 15] = [
    flight::ROWS,
    motion::ROWS,
    swarm::ROWS,
    waiting::ROWS,
    mission::ROWS,
    plans::ROWS,
    drafts::ROWS,
    devices::ROWS,
    files::ROWS,
    replay::ROWS,
    review::ROWS,
    console::ROWS,
    session::ROWS,
    class::ROWS,
    crew::ROWS,
];

/// For arming: a motor that starts late can hurt a person, so the attempts end soon.
const AT_ONCE: Retry = Retry::new(3, 1000, 3500);
/// For commands that are harmless even if late.
const CHANGE: Retry = Retry::new(5, 1000, 8000);
/// For landing commands, which are right at any time.
const COME_DOWN: Retry = Retry::new(15, 1000, 20_000);
/// For commands that must get through.
const STOP_MOTORS: Retry = Retry::new(10, 300, 3500);
/// For queries, and for settings of devices.
const ASK: Retry = Retry::new(3, 1000, 4000);
/// For setpoints, which have no answer and are repeated until the effect shows.
const SETPOINT: Retry = Retry::new(3, 1000, 4000);
/// For commands that must not take effect twice.
const ONCE: Retry = Retry::ONCE;

/// A verb that changes a setting of a device.
const fn setting(name: &'static str) -> Verb {
    Verb {
        name,
        danger: Danger::None,
        retry: ASK,
        precedence: Precedence::InTurn,
        movement: Movement::None,
        counts_as: CountsAs::Setting,
        duty: CrewDuty::Flying,
        unsuited: &[],
    }
}

/// A verb that asks the vehicle for something and changes nothing else.
const fn question(name: &'static str) -> Verb {
    Verb {
        counts_as: CountsAs::Question,
        ..setting(name)
    }
}

/// A verb whose command can do anything to the vehicle: sent once, after a confirmation.
const fn confirmed(name: &'static str) -> Verb {
    Verb {
        name,
        danger: Danger::Confirm,
        retry: ONCE,
        precedence: Precedence::InTurn,
        movement: Movement::None,
        counts_as: CountsAs::Task,
        duty: CrewDuty::Flying,
        unsuited: &[],
    }
}

type Built = Result<Meaning, Problem>;

#[expect(
    clippy::unnecessary_wraps,
    reason = "it is the last expression of functions that can fail"
)]
fn command(command: Command) -> Built {
    Ok(Meaning::Act(Act::Command(command)))
}

#[expect(
    clippy::unnecessary_wraps,
    reason = "it is the last expression of functions that can fail"
)]
fn deed(deed: Deed) -> Built {
    Ok(Meaning::Act(Act::Deed(deed)))
}

#[expect(
    clippy::unnecessary_wraps,
    reason = "it is the last expression of functions that can fail"
)]
fn manoeuvre(manoeuvre: Manoeuvre) -> Built {
    Ok(Meaning::Act(Act::Manoeuvre(manoeuvre)))
}

#[expect(
    clippy::unnecessary_wraps,
    reason = "it is the last expression of functions that can fail"
)]
fn plans(task: PlanTask) -> Built {
    Ok(Meaning::Act(Act::Plans(task)))
}

#[expect(
    clippy::unnecessary_wraps,
    reason = "it is the last expression of functions that can fail"
)]
fn console(line: ConsoleLine) -> Built {
    Ok(Meaning::Console(line))
}

/// The first of these arguments that was given, for a fault to point at.
fn given(arguments: &Arguments, names: &[&'static str]) -> Option<&'static str> {
    names.iter().copied().find(|name| arguments.flag(name))
}
