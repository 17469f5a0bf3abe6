//! The lines of a journal after its head.

use std::time::Duration;

use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::desk_line::DeskRecord;
use super::foreign_line::ForeignLine;
use crate::alert::AlertKind;
use crate::commands::Order;
use crate::crew::CrewRecord;
use crate::geo::LatLon;
use crate::language;
use crate::ledger::{EntryId, LedgerRow, Risk, RowState, RowUpdate};
use crate::notice::Notice;
use crate::pilot_in_command::Person;
use crate::session::{RadioFault, Want};
use crate::swarm::Path;
use crate::text::{StoredText, Text};
use crate::vehicle::{Severity, VehicleId};
use crate::verb::Verb;

/// The maximum time between two lines of a journal, and the maximum length of a mission.
const LONGEST_SILENCE: Duration = Duration::from_secs(24 * 3600);

/// An event and its time.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct JournalLine {
    /// Microseconds since the beginning of the record.
    us: u64,
    #[serde(flatten)]
    pub what: Happening,
}

impl JournalLine {
    /// An event at a time from the beginning of the record.
    pub fn new(at: Duration, what: Happening) -> Self {
        let us = u64::try_from(at.as_micros()).unwrap_or(u64::MAX);
        Self { us, what }
    }

    /// The same event, moved to `at` if it is earlier, because events within one tick are timed by clocks that were
    /// read one after the other.
    #[must_use]
    pub fn not_before(self, at: Duration) -> Self {
        Self::new(self.at().max(at), self.what)
    }

    /// The time of the event, from the beginning of the record.
    pub fn at(&self) -> Duration {
        Duration::from_micros(self.us)
    }

    /// Whether its time is possible after that of the previous line. Without a limit, one damaged
    /// digit could make a replay last for centuries.
    pub(super) fn can_follow(&self, before: Duration) -> bool {
        let is_short = match self.what {
            Happening::Mission { ms } => Duration::from_millis(ms) <= LONGEST_SILENCE,
            Happening::Entry(_)
            | Happening::Row(_)
            | Happening::Foreign(_)
            | Happening::Notice(_)
            | Happening::Loss(_)
            | Happening::Paths(_)
            | Happening::Speedup { .. }
            | Happening::Paused { .. }
            | Happening::Bookmark { .. }
            | Happening::Desk(_)
            | Happening::Crew(_)
            | Happening::End => true,
        };
        is_short && is_next(self.at(), before)
    }

    /// The event as a line, with its line end.
    pub fn to_line(&self) -> String {
        written(self)
    }
}

/// Whether a line can have this time after another line.
pub(super) fn is_next(at: Duration, before: Duration) -> bool {
    (before..=before + LONGEST_SILENCE).contains(&at)
}

/// An event that is not part of the links' traffic.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Happening {
    /// A command was given.
    Entry(EntryLine),
    /// The state of a command has changed for one vehicle.
    Row(RowLine),
    /// Another ground station has commanded a vehicle, or its command has a new state.
    Foreign(ForeignLine),
    /// A notice that a replay cannot derive from telemetry or the mission.
    Notice(NoticeLine),
    /// The radio between a vehicle and the console has changed to this state.
    Loss(LossLine),
    /// The paths of joint manoeuvres have changed: these are the paths of all vehicles in a manoeuvre.
    Paths(Vec<PathLine>),
    /// The speed-up over the wall clock has changed.
    Speedup { rate: f64 },
    /// A pause has ended: simulator, links and mission stood still for this long by the wall clock.
    Paused { ms: u64 },
    /// The mission was advanced to this time of its own clock.
    Mission { ms: u64 },
    /// The operator set a bookmark.
    Bookmark { text: String },
    /// An order of an instructor's desk has ended.
    Desk(DeskRecord),
    /// The members of a crew, or the pilots of vehicles, have changed.
    Crew(CrewRecord),
    /// The session was ended normally.
    End,
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct EntryLine {
    /// The number of the command in the ledger.
    pub id: u32,
    /// The whole line in the console's grammar.
    pub line: String,
    #[serde(serialize_with = "verb_name", deserialize_with = "known_verb")]
    pub verb: &'static Verb,
    #[serde(default, skip_serializing_if = "is_none")]
    pub risk: Risk,
    /// Who gave the command; `None` for the user of the console.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub by: Option<Person>,
    pub vehicles: Vec<VehicleId>,
}

impl EntryLine {
    /// The line of an order with its ledger entry.
    pub fn of(entry: EntryId, order: &Order) -> Self {
        let given = order.given();
        Self {
            id: entry.0,
            line: given.line.to_owned(),
            verb: given.verb,
            risk: given.risk,
            by: order.by.clone(),
            vehicles: order.targets.clone(),
        }
    }
}

/// The outcome of a command for one vehicle.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RowLine {
    /// The number of its entry in the ledger.
    pub id: u32,
    pub vehicle: VehicleId,
    pub state: RowState,
    /// How many times the command has been sent.
    pub tries: u8,
    /// The reason for a refusal, or a remark, in English.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub why: Option<String>,
    /// The same for other languages; `None` if it has no other words there, and in records older than this field.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub text: Option<StoredText>,
}

impl RowLine {
    /// The line of an update.
    pub fn of(update: &RowUpdate) -> Self {
        Self {
            id: update.entry.0,
            vehicle: update.vehicle,
            state: update.state,
            tries: update.tries,
            why: update.explanation.as_ref().map(ToString::to_string),
            text: update.explanation.as_ref().and_then(Text::stored),
        }
    }

    /// The line of a row in its current state.
    pub fn standing(entry: EntryId, row: &LedgerRow) -> Self {
        Self {
            id: entry.0,
            vehicle: row.vehicle,
            state: row.state,
            tries: row.tries,
            why: row.explanation.as_ref().map(ToString::to_string),
            text: row.explanation.as_ref().and_then(Text::stored),
        }
    }

    /// The update of a line, at a time.
    pub fn update(&self, at: Duration) -> RowUpdate {
        RowUpdate {
            entry: EntryId(self.id),
            vehicle: self.vehicle,
            state: self.state,
            tries: self.tries,
            at,
            explanation: self.explanation(),
        }
    }
}

impl RowLine {
    /// The reason for a refusal, or a remark, in the reader's language if possible.
    fn explanation(&self) -> Option<Text> {
        let why = self.why.as_ref()?;
        let stored = self.text.as_ref();
        Some(stored.map_or_else(|| Text::verbatim(why.clone()), |it| it.text(why)))
    }
}

/// A notice to the operator, in English.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct NoticeLine {
    /// The vehicle that the notice is about, if any.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub vehicle: Option<VehicleId>,
    /// Its severity: a `MAV_SEVERITY`.
    pub severity: u8,
    /// The alert that the notice is about, if any.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub kind: Option<AlertKind>,
    pub text: String,
}

impl NoticeLine {
    /// The line of a notice.
    pub fn of(notice: &Notice) -> Self {
        Self {
            vehicle: notice.vehicle,
            severity: notice.severity as u8,
            kind: notice.kind,
            text: notice.text.to_string(),
        }
    }

    /// The notice of a line, at a time.
    pub fn notice(&self, at: Duration) -> Notice {
        Notice {
            vehicle: self.vehicle,
            kind: self.kind,
            ..Notice::general(
                at,
                Severity::from_wire(self.severity),
                Text::verbatim(self.text.clone()),
            )
        }
    }
}

impl Happening {
    /// The line of a demand, if it belongs in the journal. Only demands on the radio do, because
    /// the console simulates it; the vehicle's answers to other demands are in telemetry.
    pub fn of_demand(vehicle: VehicleId, want: &Want) -> Option<Self> {
        match want {
            Want::Radio(fault) => Some(Self::Loss(LossLine::of(vehicle, *fault))),
            Want::Parameter { .. } | Want::RadioTest(_) | Want::Lists(_) => None,
        }
    }
}

/// The path on which a joint manoeuvre leads a vehicle.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PathLine {
    pub vehicle: VehicleId,
    /// The points ahead, the next one first: latitude and longitude in degrees.
    pub points: Vec<[f64; 2]>,
}

impl PathLine {
    /// The lines of all paths.
    pub fn all(paths: &[Path]) -> Vec<Self> {
        let line = |path: &Path| {
            let points = path.points.iter().map(|at| [at.lat_deg, at.lon_deg]);
            Self {
                vehicle: path.vehicle,
                points: points.collect(),
            }
        };
        paths.iter().map(line).collect()
    }

    /// The path as the map draws it.
    pub fn path(&self) -> Path {
        let points = self.points.iter();
        Path {
            vehicle: self.vehicle,
            points: points.map(|&[lat, lon]| LatLon::new(lat, lon)).collect(),
        }
    }
}

/// The state of the radio link between a vehicle and the console.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct LossLine {
    pub vehicle: VehicleId,
    /// The share of frames lost in either direction, 0 to 1.
    pub loss: f64,
    /// The delay of frames that are not lost, in microseconds.
    pub delay_us: u64,
    /// The seed that decides which frames are lost.
    pub seed: u64,
}

impl LossLine {
    /// The line of a fault.
    pub fn of(vehicle: VehicleId, fault: RadioFault) -> Self {
        Self {
            vehicle,
            loss: fault.loss,
            delay_us: u64::try_from(fault.delay.as_micros()).unwrap_or(u64::MAX),
            seed: fault.seed,
        }
    }

    /// The fault as the radio model uses it.
    pub fn fault(&self) -> RadioFault {
        RadioFault {
            loss: self.loss,
            delay: Duration::from_micros(self.delay_us),
            seed: self.seed,
        }
    }
}

/// A value as a line of JSON, with its line end.
pub(super) fn written(what: &impl Serialize) -> String {
    // Plain data with text keys can always be written.
    let mut line = serde_json::to_string(what).unwrap_or_default();
    line.push('\n');
    line
}

#[expect(
    clippy::trivially_copy_pass_by_ref,
    reason = "the serialiser passes references"
)]
fn is_none(risk: &Risk) -> bool {
    *risk == Risk::None
}

#[expect(
    clippy::trivially_copy_pass_by_ref,
    reason = "serde passes fields by reference"
)]
fn verb_name<S: Serializer>(verb: &&'static Verb, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(verb.name)
}

fn known_verb<'de, D: Deserializer<'de>>(deserializer: D) -> Result<&'static Verb, D::Error> {
    let name = String::deserialize(deserializer)?;
    language::verb(&name).ok_or_else(|| D::Error::custom("no verb"))
}
