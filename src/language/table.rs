//! The verb table: every verb, once.

use super::argument::{Arguments, Problem};
use super::verb::{Meaning, Retry, Verb};
use crate::commands::Command;

mod devices;
mod flight;
mod mission;
mod motion;
mod swarm;
mod waiting;

/// All verbs, in the order in which they are shown.
pub fn verbs() -> &'static [Verb] {
    VERBS
}

/// The verb that is called that, by name or alias, upper or lower case.
pub fn verb(word: &str) -> Option<&'static Verb> {
    VERBS.iter().find(|verb| verb.is_called(word))
}

static VERBS: &[Verb] = &[
    flight::ARM,
    flight::DISARM,
    flight::KILL,
    flight::MODE,
    flight::TAKEOFF,
    flight::LAND,
    flight::RTL,
    flight::HOLD,
    flight::RESUME,
    motion::GOTO,
    motion::ALTITUDE,
    motion::SPEED,
    motion::YAW,
    motion::VELOCITY,
    motion::ORBIT,
    motion::ROI,
    motion::HOME,
    swarm::SURVEY,
    swarm::SEARCH,
    swarm::FORMATION,
    swarm::FOLLOW,
    swarm::SPREAD,
    waiting::WAIT,
    mission::MARK,
    mission::UNMARK,
    mission::SAMPLE,
    mission::DROP,
    mission::SPRAY,
    mission::PREDICT,
    mission::GOAL,
    mission::HINT,
    devices::SERVO,
    devices::RELAY,
    devices::REBOOT,
    devices::INTERVAL,
    devices::REQUEST,
    devices::PARAM,
    devices::LONG,
    devices::INT,
];

/// A motor that starts late can hurt somebody: give up soon.
const AT_ONCE: Retry = Retry::new(3, 1000, 3500);
/// What is harmless when it arrives a little late.
const CHANGE: Retry = Retry::new(5, 1000, 8000);
/// What is right whenever it arrives: coming down.
const COME_DOWN: Retry = Retry::new(15, 1000, 20_000);
/// What must get through.
const STOP_MOTORS: Retry = Retry::new(10, 300, 3500);
/// Questions, and settings of devices.
const ASK: Retry = Retry::new(3, 1000, 4000);
/// Setpoints: no answer ever comes, they are sent again until the effect shows.
const SETPOINT: Retry = Retry::new(3, 1000, 4000);
/// What must not happen twice.
const ONCE: Retry = Retry::new(1, 1000, 3000);

type Built = Result<Meaning, Problem>;

/// A command as the result of a builder.
#[expect(
    clippy::unnecessary_wraps,
    reason = "it is the last expression of functions that can fail"
)]
fn command(command: Command) -> Built {
    Ok(Meaning::Command(command))
}

/// The first of these arguments that is given, to point at.
fn given(arguments: &Arguments, names: &[&'static str]) -> Option<&'static str> {
    names.iter().copied().find(|name| arguments.flag(name))
}
