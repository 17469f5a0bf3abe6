//! The command language: `[targets] verb [arguments]`, for vehicles and for the console itself.
//!
//! The palette, pilot scripts, mission injects, key bindings, the ledger and the debrief all use it. One table
//! ([`rows`]) declares every verb once; parser, completion, hints, help and the manual are generated from it.
//!
//! Targets are `3`, `1-4,7`, `@red` (a named group), `all`, or none for the current selection; they come before the
//! verb, or right after `wait`. Upper and lower case mean the same in verbs, keywords and modes. A number may carry its
//! unit (`20m`, `5m/s`, `30s`, `3min`, `90deg`). `#` begins a comment.
//!
//! # How the parts fit
//! - Reading a line: `lexer` splits it, `head` finds targets and verb, `form` matches the rest with the verb's forms,
//!   `read` and `argument` turn words into values, `parse` builds the statement. `fault` says which word is wrong,
//!   and why.
//! - What can be meant: `table` has the verbs, `verb` is one row of it; `names`, `modes` and `fields` are names that
//!   depend on the session, the vehicle's class and the message; `targets` and `choice` are vehicles, `radio` the
//!   settings of a radio test.
//! - Helping the user: `complete` offers the next words, `manual` writes the table as text.
//! - `console` has the lines that the console carries out itself. `pilot` runs scripts; `wait` evaluates their
//!   conditions.

use std::collections::{BTreeMap, BTreeSet};

use crate::commands::Order;
use crate::geo::{LatLon, Outline};
use crate::parameters::ParameterList;
use crate::text;
use crate::text::Text;
use crate::vehicle::{VehicleClass, VehicleId};
use crate::verb::Verb;

mod argument;
mod choice;
mod complete;
mod console;
mod fault;
mod fields;
mod form;
mod head;
mod lexer;
mod manual;
mod modes;
mod names;
mod parse;
mod pilot;
mod radio;
mod read;
mod table;
mod targets;
mod verb;
mod wait;

#[cfg(test)]
mod tests;

pub use argument::{Argument, Kind, Unit, field_text};
pub use choice::VehicleChoice;
pub use complete::{
    Completion, begun, complete, file_begun, hint, lines, usages_begun, vehicle_verbs,
};
pub use console::{
    AlertLine, ClassLine, ConsoleLine, CrewLine, DraftLine, DraftWork, ForwardLine, GhostLine,
    GhostSource, GradingLine, LineNeeds, LoopTarget, MessagesLine, ParametersLine, ProcessDeed,
    ProposalLine, RadioChoice, Rating, ReplayLine, ReplayedTrainees, Report, ReviewLine,
    SeatChoice, SeekTarget, TableLine,
};
pub use head::said;
pub use lexer::{Word, comment_start, words};
pub use manual::manual;
pub use modes::OfferedModes;
pub use names::{Listed, NameList, Named, Names, UnknownNames, mission_meant};
pub use parse::{draft_part, free_texts, parse};
pub use pilot::{Pilot, PilotEvent, Script};
pub use table::{row, rows, verb, verbs};
pub use targets::Targets;
pub use verb::{Channel, Form, Meaning, Scope, VerbRow};
pub use wait::{Field, Findings, Relation, Seen, Situation, Until, Wait};

/// Named groups of vehicles, by their names without the `@`.
pub type Groups = BTreeMap<String, Vec<VehicleId>>;

/// The names that a line may refer to.
#[derive(Debug, Clone, Copy)]
pub struct Context<'a> {
    pub groups: &'a Groups,
    /// Named places; names with spaces cannot be used. `None` if they are not known yet: then every name is accepted,
    /// which suffices for a check, but the built command has no position.
    pub places: Option<&'a BTreeMap<String, LatLon>>,
    /// Named areas; `None` if they are not known yet, as with places.
    pub areas: Option<&'a BTreeMap<String, Outline>>,
    /// The known vehicles; empty if they are not known yet, and then every number is accepted.
    pub vehicles: &'a [VehicleId],
    /// The vehicles that `all` means; empty for all vehicles.
    pub expected: &'a BTreeSet<VehicleId>,
    /// The class whose mode names are valid. [`VehicleClass::Other`] accepts those of every class.
    pub class: VehicleClass,
    /// The modes that vehicles have announced; `None` if no vehicle has.
    pub modes: Option<&'a OfferedModes>,
    /// The known parameters of the line's first target.
    pub parameters: Option<&'a ParameterList>,
    /// The lists of names that the console provides.
    pub names: &'a dyn Names,
    /// The source of the line, which restricts the verbs.
    pub channel: Channel,
}

static NO_GROUPS: Groups = BTreeMap::new();
static NONE_EXPECTED: BTreeSet<VehicleId> = BTreeSet::new();
static NO_PLACES: BTreeMap<String, LatLon> = BTreeMap::new();
static NO_AREAS: BTreeMap<String, Outline> = BTreeMap::new();

impl Default for Context<'_> {
    /// A line of a script: no groups, no places, no areas, unknown vehicles, copters.
    fn default() -> Self {
        Self {
            groups: &NO_GROUPS,
            places: Some(&NO_PLACES),
            areas: Some(&NO_AREAS),
            vehicles: &[],
            expected: &NONE_EXPECTED,
            class: VehicleClass::Copter,
            modes: None,
            parameters: None,
            names: &UnknownNames,
            channel: Channel::Script,
        }
    }
}

#[derive(Debug, Clone, PartialEq)]
pub struct Statement {
    pub targets: Targets,
    pub verb: &'static Verb,
    /// Where the verb is allowed.
    pub scope: Scope,
    pub meaning: Meaning,
    /// The line in its canonical spelling: single spaces, no comment, no aliases.
    pub line: String,
}

impl Statement {
    /// The statement with its vehicles as numbers: other consoles have other groups.
    ///
    /// # Errors
    /// As [`Targets::resolve`].
    pub fn in_numbers(self, context: &Context) -> Result<Self, Text> {
        if !matches!(self.targets, Targets::All | Targets::Group(_)) {
            return Ok(self);
        }
        let targets = Targets::Ids(self.targets.resolve(&[], context)?);
        let after = self.line.strip_prefix(&self.targets.to_string());
        let line = after.map_or_else(|| self.line.clone(), |after| format!("{targets}{after}"));
        Ok(Self {
            targets,
            line,
            ..self
        })
    }

    /// The order that the line gives; the selection replaces missing targets.
    ///
    /// # Errors
    /// A text if there is no target vehicle (see [`Targets::resolve`]), or if the line is not an
    /// order.
    pub fn into_order(self, selection: &[VehicleId], context: &Context) -> Result<Order, Text> {
        let targets = self.targets.resolve(selection, context)?;
        let Meaning::Act(act) = self.meaning else {
            return Err(text!("order-none", verb = self.verb.name));
        };
        // The ledger must list the targets, even after the selection has changed. A command to the mission has none.
        let line = match self.targets {
            Targets::Selection if self.verb.counts_as.is_said_to_mission() => self.line,
            Targets::Selection => format!("{} {}", Targets::Ids(targets.clone()), self.line),
            Targets::All | Targets::Ids(_) | Targets::Group(_) => self.line,
        };
        Ok(Order {
            line,
            verb: self.verb,
            targets,
            act,
            by: None,
        })
    }
}
