//! What the command line can do besides commanding vehicles: a table beside that of the verbs for vehicles.

use super::effect::HangarDeed;
use super::room_list::Room;
use super::setting::Setting;
use crate::diagnostic::Diagnostic;
use crate::language::words;
use crate::vehicle::VehicleId;

mod following;
mod offer;
mod reader;
pub mod swarm;
mod table;

pub use offer::{Names, complete, lines};
use reader::LineReader;
use swarm::SwarmLine;
pub use table::{CONSOLE_VERBS, ConsoleVerb, InPlain, PlainAnswer, in_plain};

/// A line that the console carries out itself.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum ConsoleLine {
    Select(String),
    /// Give vehicles a group's name; no targets means the selection.
    Group {
        /// The name, without `@`.
        name: String,
        /// The targets as they were written.
        targets: String,
    },
    /// Go to a room.
    Show(Room),
    /// Start a mission, by id; none starts free flight.
    Fly(Option<String>),
    /// Connect to these addresses.
    Connect(Vec<String>),
    /// Have something happen in the mission.
    Inject(String),
    /// Give the lines of a macro.
    Macro(String),
    /// Change a setting for this session.
    Set(Setting),
    /// Something about the parameters of the vehicle under the cursor.
    Params(ParamsDeed),
    /// Shows the hangar, or has the process of a vehicle ended or started again.
    Hangar(Option<(HangarDeed, VehicleId)>),
    /// One about the table or its alerts.
    Swarm(SwarmLine),
    Bare(BareLine),
}

/// What the console does with parameters.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum ParamsDeed {
    Show,
    /// Asks the vehicle for all of them again.
    Fetch,
    /// Saves them to a file.
    Save(String),
    /// Loads a file, or compares with one or with another vehicle: first the differences show.
    Compare(String),
}

/// Console lines of a verb alone.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BareLine {
    Help,
    Links,
    Ledger,
    Notices,
    Brief,
    /// Let the session stand still.
    Pause,
    /// Let it go on.
    Continue,
    Abandon,
    /// The same mission again.
    Restart,
    /// Back to the home screen.
    Leave,
    Quit,
}

/// Reads a line that is the console's own; `None` if it is not, so that the grammar of commands may try.
pub fn parse(line: &str, names: &Names<'_>) -> Option<Result<ConsoleLine, Diagnostic>> {
    let words = words(line);
    let verb = table::find(words.first()?.text)?;
    let reader = LineReader::new(verb, line, &words, names);
    Some(reader.and_then(|reader| (verb.read)(&reader)))
}

/// The usage of the console's own verb that a line begins with.
pub fn usage(line: &str) -> Option<&'static str> {
    let words = words(line);
    table::find(words.first()?.text).map(|verb| verb.usage)
}

#[cfg(test)]
mod tests;
