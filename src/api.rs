//! The interface for programs: their requests to the console, and its answers.
//!
//! A program and the console exchange JSON objects, one per line. [`Call`] reads a line of a
//! program; [`Message`] is a line of the console. A [`Client`] holds the subjects that a program
//! watches and the states that it has been sent, and finds what has changed. The module is pure:
//! the shell owns the socket, and passes lines and states in.

use serde::{Deserialize, Serialize};
use serde_json::Value;
use utoipa::ToSchema;

use crate::diagnostic::serde_words;
use crate::text;
use crate::text::{Locale, Text};
use crate::vehicle::VehicleId;

mod client;
mod foreign;
mod schema;
mod traffic;
mod view;

#[cfg(test)]
mod tests;

pub use client::{Client, present};
pub use foreign::ForeignView;
pub use schema::schema;
pub use traffic::{AircraftView, ApproachView};
pub use view::{
    ContactView, EntryView, ForwardView, LinkView, LinksState, MissionView, NamedPlaceView,
    NoticeView, ObjectiveView, ParameterView, PlanItemView, PlanView, ReadingView, RecordView,
    RowView, VehicleView,
};

/// The version of this interface; it increases with every change that is not an addition.
pub const INTERFACE: u32 = 1;
/// The maximum length of a line from a program, in bytes.
pub const LONGEST_LINE: usize = 64 * 1024;
/// The shortest and the longest time between two states of a watched subject, in seconds.
pub const WATCH_S: std::ops::RangeInclusive<f64> = 0.05..=3600.0;
/// The time between two states of a watched subject unless a program asks for another, in seconds.
pub const USUAL_WATCH_S: f64 = 0.5;

/// A request from a program: one JSON object on a line.
#[derive(Debug, Clone, PartialEq, Deserialize, Serialize, ToSchema)]
#[serde(tag = "do", rename_all = "snake_case", deny_unknown_fields)]
pub enum Request {
    /// Carry out a line of the command grammar. It must name its targets. The answer is `ok`, followed by a `row`
    /// whenever the state of a vehicle changes, and by `ended`.
    Say {
        /// The line, such as `1-4 takeoff 20`.
        line: String,
        /// Whether a line that would need a confirmation by the user is confirmed.
        #[serde(default)]
        confirm: bool,
    },
    /// Send the present state of a subject once.
    Get {
        what: Subject,
        /// The vehicle whose parameters or plan are requested.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        vehicle: Option<VehicleId>,
    },
    /// Answer `ok`; then send these subjects, and send them again whenever they change. Replaces the subjects watched
    /// before; an empty list ends watching.
    Watch {
        what: Vec<Topic>,
        /// The shortest time between two states of the same subject, in seconds; 0.5 by default. Notices are sent at
        /// the same times, and rows as soon as they change.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        every_s: Option<f64>,
    },
}

/// A state that can be fetched.
#[derive(
    Debug,
    Clone,
    Copy,
    PartialEq,
    Eq,
    Deserialize,
    Serialize,
    ToSchema,
    strum::EnumString,
    strum::VariantArray,
    strum::IntoStaticStr,
)]
#[serde(rename_all = "snake_case")]
#[strum(serialize_all = "snake_case")]
pub enum Subject {
    Vehicles,
    /// All notices that the console still lists.
    Notices,
    /// All commands that the console still lists, with their rows.
    Ledger,
    Mission,
    Links,
    /// Other aircraft, the most urgent first.
    Traffic,
    /// The parameters of one vehicle, as far as they have been read.
    Parameters,
    /// The plan on board one vehicle, as far as it has been read.
    Plan,
    /// The records of flights, newest first.
    Records,
}

/// A subject that can be watched.
#[derive(
    Debug,
    Clone,
    Copy,
    PartialEq,
    Eq,
    PartialOrd,
    Ord,
    Deserialize,
    Serialize,
    ToSchema,
    strum::EnumString,
    strum::VariantArray,
    strum::IntoStaticStr,
)]
#[serde(rename_all = "snake_case")]
#[strum(serialize_all = "snake_case")]
pub enum Topic {
    Vehicles,
    Notices,
    Ledger,
    Mission,
}

/// A request with the number that its answers repeat.
#[derive(Debug, Clone, PartialEq)]
pub struct Call {
    pub id: Option<u64>,
    pub request: Request,
}

impl Call {
    /// Reads a line of a program.
    ///
    /// # Errors
    /// The line is not a request; the fault repeats its number, if it can be read.
    pub fn read(line: &str, locale: &Locale) -> Result<Self, Fault> {
        let fault = |id, text: &Text| Fault::new(id, locale.text(text));
        let mut value: Value = serde_json::from_str(line)
            .map_err(|error| fault(None, &text!("api-no-json", error = error.to_string())))?;
        let Some(object) = value.as_object_mut() else {
            return Err(fault(None, &text!("api-no-object")));
        };
        let id = match object.remove("id") {
            None => None,
            Some(id) => Some(
                id.as_u64()
                    .ok_or_else(|| fault(None, &text!("api-bad-id")))?,
            ),
        };
        let request: Request = serde_json::from_value(value).map_err(|error| {
            fault(
                id,
                &text!("api-bad-request", error = serde_words(&error.to_string())),
            )
        })?;
        if let Request::Watch {
            every_s: Some(every_s),
            ..
        } = request
            && !WATCH_S.contains(&every_s)
        {
            let text = text!(
                "api-bad-interval",
                least = WATCH_S.start().to_string(),
                most = WATCH_S.end().to_string()
            );
            return Err(fault(id, &text));
        }
        Ok(Self { id, request })
    }
}

/// A line from the console to a program: an object with one field, which names its kind.
#[derive(Debug, Clone, PartialEq, Serialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum Message {
    /// The first line of every connection.
    Welcome(Welcome),
    /// A line was carried out, or subjects are watched.
    #[serde(rename = "ok")]
    Accepted(Accepted),
    /// A request could not be carried out.
    Fault(Fault),
    /// The state of a command for one vehicle has changed.
    Row(RowView),
    /// A command has ended for all its vehicles.
    Ended(Ended),
    /// Another ground station has commanded a vehicle, or its command has a new state.
    Foreign(ForeignView),
    Vehicles(StateList<VehicleView>),
    Ledger(LedgerState),
    Notices(StateList<NoticeView>),
    Notice(NoticeView),
    Mission(MissionState),
    Links(LinksState),
    Traffic(StateList<AircraftView>),
    Parameters(StateList<ParameterView>),
    Plan(PlanView),
    Records(StateList<RecordView>),
}

impl Message {
    /// The message as a line, without its end.
    pub fn line(&self) -> String {
        // Only a map with keys that are not strings or a failing writer could fail.
        serde_json::to_string(self).unwrap_or_default()
    }
}

/// The first message to a program: versions, and whether the program may give commands.
#[derive(Debug, Clone, PartialEq, Serialize, ToSchema)]
pub struct Welcome {
    /// The version of the program that answers.
    pub sortie: String,
    /// The version of this interface.
    pub interface: u32,
    /// Whether lines are carried out; otherwise the socket is read-only.
    pub commands: bool,
}

/// A request that was carried out without a state as its answer.
#[derive(Debug, Clone, PartialEq, Serialize, ToSchema)]
pub struct Accepted {
    pub id: Option<u64>,
    /// The command's number in the ledger; none for a line to the console itself.
    pub entry: Option<u32>,
    /// The console's answer to the line as text, if there is one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub text: Option<String>,
}

/// The reason why a request was not carried out.
#[derive(Debug, Clone, PartialEq, Serialize, ToSchema)]
pub struct Fault {
    pub id: Option<u64>,
    pub message: String,
    /// Advice, unless the remedy is obvious.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub help: Option<String>,
    /// The faulty part of the line, in bytes: its start, and the end after its last byte.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub span: Option<[usize; 2]>,
    /// Whether the same request with `confirm` would be carried out.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub asks: bool,
}

impl Fault {
    /// A fault without advice and place.
    pub fn new(id: Option<u64>, message: String) -> Self {
        Self {
            id,
            message,
            help: None,
            span: None,
            asks: false,
        }
    }
}

/// A command that has ended.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, ToSchema)]
pub struct Ended {
    pub entry: u32,
    /// Whether the command was done for every vehicle.
    pub done: bool,
}

/// A list of states.
#[derive(Debug, Clone, PartialEq, Serialize, ToSchema)]
pub struct StateList<T> {
    #[serde(skip_serializing_if = "Option::is_none")]
    pub id: Option<u64>,
    pub list: Vec<T>,
}

impl<T> StateList<T> {
    fn new(id: Option<u64>, list: impl IntoIterator<Item = T>) -> Self {
        let list = list.into_iter().collect();
        Self { id, list }
    }
}

/// The commands of this console and of other ground stations.
#[derive(Debug, Clone, PartialEq, Serialize, ToSchema)]
pub struct LedgerState {
    #[serde(skip_serializing_if = "Option::is_none")]
    pub id: Option<u64>,
    /// The commands of this console.
    pub list: Vec<EntryView>,
    /// The commands of other ground stations.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub foreign: Vec<ForeignView>,
}

/// The mission, if one is being flown.
#[derive(Debug, Clone, PartialEq, Serialize, ToSchema)]
pub struct MissionState {
    #[serde(skip_serializing_if = "Option::is_none")]
    pub id: Option<u64>,
    pub mission: Option<MissionView>,
}
