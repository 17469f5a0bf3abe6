//! The run record: all inputs of a mission, as lines of JSON, from which it can be scored again.
//!
//! The first line is the [`Head`]: the mission's text, the seed, the attempt. Then come ticks with changes (vehicles
//! and rows of the ledger), deeds and other occurrences, in order, and a tick every second in any case. The last line
//! is the [`End`] with the score. A [`Flight`](super::Flight) is a function of these lines, so a truncated record is
//! scored as far as it goes.
//!
//! Numbers of telemetry are stored as the integers that messages carry, so that reading gives exactly the received
//! values. Explanations of refusals are stored in English, and as messages for other languages: the ids of messages
//! belong to this version of the program, so a version that words them otherwise shows the English words.

use std::collections::BTreeMap;
use std::time::Duration;

use serde::{Deserialize, Serialize};

use super::{Mission, Stake, TICK, is_due};
use crate::commands::Deed;
use crate::hash::RunningHash;
use crate::ledger::{EntryId, Ledger, LedgerEntry, LedgerRow, RowState};
use crate::record::{EntryLine, RowLine};
use crate::scoring::{FlightBackend, FlownBy, Medal, Report};
use crate::vehicle::{VehicleId, Vehicles};
use crate::workshop::Design;

mod line;
mod observed;
mod replay;
mod verification;

use line::{RecordChange, RecordLine};
use observed::{ObservedVehicle, WatchedVehicle};
pub use replay::{Reenactment, Rescored, Stored, WithoutEnd};
pub use verification::{Divergence, RecordExtent, Verification, refly};

const VERSION: u32 = 1;
/// The time between lines while nothing changes, so that a record without an end shows how long the flight was.
const LINE_EVERY: Duration = Duration::from_secs(1);

/// The circumstances of a recorded flight.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Head {
    /// The version of the format.
    pub sortie_run: u32,
    /// Id of the mission.
    pub mission: String,
    /// Revision of the mission.
    pub revision: u32,
    /// Seed of hazards and sensors.
    pub seed: u64,
    /// The number of the attempt, from 1.
    pub attempt: u32,
    /// The program that simulated the vehicles.
    pub backend: FlightBackend,
    /// The source of the commands; `None` in records older than this field.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub flown_by: Option<FlownBy>,
    /// Its start in UTC: `2026-11-20T14:03:22Z`.
    pub when: String,
    /// The name of the pilot's profile, if there is one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub profile: Option<String>,
    /// Its purpose. Records without it are from before careers existed, and count as practice.
    #[serde(default, skip_serializing_if = "is_practice")]
    pub stake: Stake,
    /// The built drones that flew, as TOML in the order of the seats; empty for the mission's own.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub designs: Vec<String>,
    /// The program that recorded the flight.
    pub program: String,
    pub source: String,
}

impl Head {
    /// The head of the record of a flight that is about to begin.
    pub(super) fn of(mission: &Mission, seed: u64, attempt: u32, occasion: &Occasion) -> Self {
        Self {
            sortie_run: VERSION,
            mission: mission.id.clone(),
            revision: mission.rev,
            seed,
            attempt,
            backend: occasion.backend,
            flown_by: Some(occasion.flown_by),
            when: occasion.when.clone(),
            profile: occasion.profile.clone(),
            stake: occasion.stake,
            designs: mission.seats.designs.iter().map(Design::to_toml).collect(),
            program: env!("SORTIE_VERSION").to_owned(),
            source: mission.file.text.clone(),
        }
    }
}

/// The time, simulator, source of commands and purpose of a flight.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Occasion {
    /// Its start in UTC: `2026-11-20T14:03:22Z`.
    pub when: String,
    /// The program that simulates the vehicles.
    pub backend: FlightBackend,
    /// The source of the commands.
    pub flown_by: FlownBy,
    /// The name of the pilot's profile, if there is one.
    pub profile: Option<String>,
    pub stake: Stake,
}

#[expect(
    clippy::trivially_copy_pass_by_ref,
    reason = "the serialiser passes references"
)]
fn is_practice(stake: &Stake) -> bool {
    *stake == Stake::Practice
}

/// The score of a recorded flight.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct End {
    /// The points, 0 to 1000.
    pub score: u16,
    /// The medal, if one was earned.
    pub medal: Option<Medal>,
    /// Whether the mission was passed.
    pub passed: bool,
    /// Mission time used, in seconds.
    pub sim_time_s: f64,
}

impl End {
    /// Parses the line that ends a record; `None` for any other line.
    pub fn of_line(line: &[u8]) -> Option<Self> {
        let line: RecordLine = serde_json::from_slice(line).ok()?;
        line.end().copied()
    }
}

/// Whether a line ends a record because an earlier situation of the flight was recalled, which makes it practice.
pub fn is_recall(line: &[u8]) -> bool {
    matches!(serde_json::from_slice(line), Ok(RecordLine::Recall))
}

/// The mission time of a line of a record; `None` if it has none.
pub fn time_of_line(line: &[u8]) -> Option<Duration> {
    let line: RecordLine = serde_json::from_slice(line).ok()?;
    line.time().map(Duration::from_millis)
}

fn checksum(lines: RunningHash) -> String {
    format!("{:016x}", lines.value())
}

/// Writes the record of a flight while it is flown.
#[derive(Debug, Clone)]
pub(super) struct Recorder {
    written: String,
    sum: RunningHash,
    watched: BTreeMap<VehicleId, WatchedVehicle>,
    /// Ledger entries that may still change, with their rows as last written.
    open: BTreeMap<EntryId, Vec<(RowState, u8)>>,
    newest: Option<EntryId>,
    revision: Option<u64>,
    stepped: Option<Duration>,
    /// The number of simulator steps so far, if the simulator's time is not the mission's.
    simulated: Option<u64>,
    is_step_written: bool,
    /// Whether the last line is the end: nothing follows it.
    has_ended: bool,
}

impl Recorder {
    pub fn new(head: &Head) -> Self {
        let mut recorder = Self {
            written: String::new(),
            sum: RunningHash::default(),
            watched: BTreeMap::new(),
            open: BTreeMap::new(),
            newest: None,
            revision: None,
            stepped: None,
            simulated: None,
            is_step_written: true,
            has_ended: false,
        };
        recorder.write(head);
        recorder
    }

    /// The lines since the last call.
    pub fn take(&mut self) -> String {
        std::mem::take(&mut self.written)
    }

    /// Notes the number of simulator steps so far, if the simulator's time is not the mission's.
    pub fn note_simulated(&mut self, steps: u64) {
        self.simulated = Some(steps);
    }

    pub fn step(&mut self, now: Duration, vehicles: &Vehicles, ledger: &Ledger) {
        let change = RecordChange {
            v: self.changed_vehicles(vehicles),
            ..self.changed_ledger(ledger)
        };
        let is_next = self.stepped.is_some_and(|before| now == before + TICK);
        self.stepped = Some(now);
        self.is_step_written =
            !is_next || change != RecordChange::default() || is_due(now, LINE_EVERY);
        if self.is_step_written {
            let t = now.as_millis() as u64;
            let s = self.simulated;
            self.write(&RecordLine::Tick { t, s, change });
        }
    }

    /// Writes an occurrence after the newest step, which then also needs a line.
    fn befall(&mut self, line: &RecordLine) {
        self.write_step();
        self.write(line);
    }

    /// Writes the line of the newest step, if it has none.
    fn write_step(&mut self) {
        if !std::mem::replace(&mut self.is_step_written, true) {
            let t = self.stepped.unwrap_or_default().as_millis() as u64;
            let change = RecordChange::default();
            let s = self.simulated;
            self.write(&RecordLine::Tick { t, s, change });
        }
    }

    pub fn act(&mut self, deed: &Deed, vehicles: &[VehicleId]) {
        let (deed, vehicles) = (deed.clone(), vehicles.to_vec());
        self.befall(&RecordLine::Act { deed, vehicles });
    }

    pub fn lose(&mut self, vehicle: VehicleId, vehicles: &Vehicles) {
        let change = RecordChange {
            v: self.changed_vehicles(vehicles),
            ..RecordChange::default()
        };
        self.befall(&RecordLine::Lose { vehicle, change });
    }

    pub fn inject(&mut self, name: &str) {
        let name = name.to_owned();
        self.befall(&RecordLine::Inject { name });
    }

    pub fn pause(&mut self, lasted: Duration) {
        let seconds = lasted.as_secs();
        self.befall(&RecordLine::Pause { seconds });
    }

    pub fn abandon(&mut self) {
        self.befall(&RecordLine::Abandon);
    }

    pub fn recall(&mut self) {
        self.befall(&RecordLine::Recall);
    }

    pub fn stop(&mut self) {
        self.befall(&RecordLine::Stop);
    }

    pub fn end(&mut self, ledger: &Ledger, report: &Report) {
        // Without its end, the record still shows that the mission was over.
        self.write_step();
        let change = self.changed_ledger(ledger);
        let end = End {
            score: report.score,
            medal: report.medal,
            passed: report.passed,
            sim_time_s: report.sim_time_s,
        };
        let t = self.stepped.unwrap_or_default().as_millis() as u64;
        let checksum = Some(checksum(self.sum));
        self.write(&RecordLine::End {
            t,
            change,
            end,
            checksum,
        });
        self.has_ended = true;
    }

    fn write(&mut self, line: &impl Serialize) {
        // What is said in the debrief is no part of the flight.
        if self.has_ended {
            return;
        }
        // Plain data with string keys only: serialising cannot fail.
        if let Ok(mut line) = serde_json::to_string(line) {
            line.push('\n');
            self.sum.add(line.as_bytes());
            self.written.push_str(&line);
        }
    }

    fn changed_vehicles(&mut self, vehicles: &Vehicles) -> Vec<ObservedVehicle> {
        let changed = |(&id, vehicle)| self.watched.entry(id).or_default().changes(id, vehicle);
        let vehicles = vehicles.iter().map(|(id, vehicle)| (id, &**vehicle));
        vehicles.filter_map(changed).collect()
    }

    fn changed_ledger(&mut self, ledger: &Ledger) -> RecordChange {
        let mut change = RecordChange::default();
        if self.revision.replace(ledger.revision()) == Some(ledger.revision()) {
            return change;
        }
        let newest = self.newest;
        let mut new: Vec<&LedgerEntry> = ledger
            .entries()
            .rev()
            .take_while(|entry| Some(entry.id) > newest)
            .collect();
        new.reverse();
        for entry in new {
            self.newest = Some(entry.id);
            let queued = |_: &LedgerRow| (RowState::Queued, 0);
            self.open
                .insert(entry.id, entry.rows.iter().map(queued).collect());
            change.e.push(EntryLine {
                id: entry.id.0,
                line: entry.line.clone(),
                verb: entry.verb,
                risk: entry.risk,
                by: entry.by.clone(),
                vehicles: entry.rows.iter().map(|row| row.vehicle).collect(),
            });
        }
        self.open.retain(|&id, known| {
            let Some(entry) = ledger.entry(id) else {
                return false;
            };
            for (row, known) in entry.rows.iter().zip(known) {
                if std::mem::replace(known, (row.state, row.tries)) != (row.state, row.tries) {
                    change.r.push(RowLine::standing(id, row));
                }
            }
            !entry.is_final()
        });
        change
    }
}

#[cfg(test)]
mod tests;
