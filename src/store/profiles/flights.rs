//! Flights: the history of a career, and its runs.

use std::collections::BTreeSet;

use rusqlite::{Connection, params};
use serde::Serialize;

use super::{Profile, ProfileError, Profiles, json};
use crate::campaign::{CareerEntry, CareerFlight, is_practice, next_try};
use crate::scoring::{FlightBackend, Report, TryReport};

/// A finished run, to be stored.
#[derive(Debug, Clone, PartialEq)]
pub struct RunEntry {
    /// The run's unique id: the name of its recording.
    pub id: String,
    /// When the flight ended, in UTC.
    pub when: String,
    /// The run's entry in the career.
    pub flight: CareerFlight,
    /// The report: revision, seed, ledger, events, score.
    pub report: Report,
    /// The airframes that flew, a TOML design for each drone that was built; empty for the mission's own drones.
    pub airframes: Vec<String>,
    /// The recorded run's file, if it was recorded.
    pub recording: Option<String>,
}

#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PastRun {
    pub id: String,
    /// When the flight ended, in UTC.
    pub when: String,
    /// Revision of the mission.
    pub revision: u32,
    /// Seed of hazards and sensors.
    pub seed: u64,
    pub backend: FlightBackend,
    /// The recorded run's file, if it was recorded.
    pub recording: Option<String>,
    /// The run's entry in the career.
    pub flight: CareerFlight,
}

impl PastRun {
    /// The run as an attempt at its mission; `attempt` counts from 1.
    pub fn as_try(&self, attempt: u32) -> TryReport {
        TryReport {
            attempt,
            when: self.when.clone(),
            score: Some(self.flight.score),
            medal: self.flight.medal,
            passed: self.flight.passed,
            seed: self.seed,
            revision: self.revision,
            is_practice: is_practice(self.flight.stake, self.flight.flown_by),
        }
    }
}

impl Profiles {
    /// A profile's history, oldest first. Impossible entries ([`CareerEntry::fault`]) are left out and logged.
    ///
    /// # Errors
    /// The database cannot be read, or contains data that no version of the program writes.
    pub fn history(&self, profile: &Profile) -> Result<Vec<CareerEntry>, ProfileError> {
        let mut query =
            self.ask("SELECT id, entry FROM entries WHERE profile = ?1 ORDER BY number")?;
        let rows = query
            .query_map([profile.key], |row| {
                Ok((row.get::<_, String>(0)?, row.get::<_, String>(1)?))
            })
            .and_then(Iterator::collect::<Result<Vec<_>, _>>)
            .map_err(|error| self.fault(error))?;
        let entries = rows.iter().map(|(id, json)| self.entry(id, json));
        entries.filter_map(Result::transpose).collect()
    }

    /// An entry of a history, unless it is impossible.
    fn entry(&self, id: &str, json: &str) -> Result<Option<CareerEntry>, ProfileError> {
        let entry: CareerEntry = self.read(json)?;
        let fault = entry.fault();
        if let Some(fault) = &fault {
            let path = self.path.display();
            tracing::warn!("{path}: the entry {id:?} is ignored: {fault}");
        }
        Ok(fault.is_none().then_some(entry))
    }

    /// A profile's runs without their reports, oldest first; the same runs as in its history.
    ///
    /// # Errors
    /// The database cannot be read.
    pub fn runs(&self, profile: &Profile) -> Result<Vec<PastRun>, ProfileError> {
        let mut query = self.ask(
            "SELECT id, ended, revision, seed, backend, recording, entry
             FROM runs JOIN entries USING (profile, id) WHERE profile = ?1 ORDER BY number",
        )?;
        let rows = query
            .query_map([profile.key], |row| {
                let seed: i64 = row.get(3)?;
                let run = (
                    row.get::<_, String>(0)?,
                    row.get(1)?,
                    row.get(2)?,
                    seed as u64,
                );
                let backend: String = row.get(4)?;
                Ok((run, backend, row.get(5)?, row.get::<_, String>(6)?))
            })
            .and_then(Iterator::collect::<Result<Vec<_>, _>>);
        let mut runs = Vec::new();
        for ((id, when, revision, seed), backend, recording, entry) in
            rows.map_err(|error| self.fault(error))?
        {
            let Some(backend) = FlightBackend::named(&backend) else {
                let path = self.path.display();
                tracing::warn!("{path}: the run {id:?} is left out: unknown backend {backend:?}");
                continue;
            };
            if let Some(CareerEntry::Flight(flight)) = self.entry(&id, &entry)? {
                runs.push(PastRun {
                    id,
                    when,
                    revision,
                    seed,
                    backend,
                    recording,
                    flight,
                });
            }
        }
        Ok(runs)
    }

    /// A profile's comparable attempts at a mission, those at one revision, oldest first.
    ///
    /// # Errors
    /// The database cannot be read.
    pub fn tries(
        &self,
        profile: &Profile,
        mission: &str,
        revision: u32,
    ) -> Result<Vec<TryReport>, ProfileError> {
        let mut runs = self.runs(profile)?;
        runs.retain(|run| run.flight.mission == mission && run.revision == revision);
        let mut tries = Vec::new();
        for run in &runs {
            tries.push(run.as_try(next_try(&tries)));
        }
        Ok(tries)
    }

    /// The ids of all runs of all profiles.
    pub(in crate::store) fn run_ids(&self) -> Result<BTreeSet<String>, ProfileError> {
        let mut query = self.ask("SELECT DISTINCT id FROM runs")?;
        let rows = query
            .query_map([], |row| row.get(0))
            .and_then(Iterator::collect);
        rows.map_err(|error| self.fault(error))
    }

    /// Stores a finished run, unless it is stored already; returns whether it was new.
    ///
    /// # Errors
    /// The database cannot be written; nothing of the run is stored then.
    pub fn store(&mut self, profile: &Profile, run: &RunEntry) -> Result<bool, ProfileError> {
        let entry = json(&CareerEntry::Flight(run.flight.clone()));
        let fault = |error| self.fault(error);
        let transaction = self.transaction()?;
        let is_new = transaction
            .execute(
                "INSERT INTO entries (profile, id, at, entry) VALUES (?1, ?2, ?3, ?4) ON CONFLICT DO NOTHING",
                params![profile.key, run.id, run.when, entry],
            )
            .map_err(fault)?
            > 0;
        if is_new {
            let row = RunRow {
                id: &run.id,
                ended: &run.when,
                airframes: &run.airframes,
                recording: run.recording.as_deref(),
                report: &run.report,
            };
            row.insert(&transaction, profile.key).map_err(fault)?;
        }
        transaction.commit().map_err(fault)?;
        Ok(is_new)
    }
}

/// A finished run as a row of the tables.
pub(super) struct RunRow<'a> {
    pub id: &'a str,
    pub ended: &'a str,
    pub airframes: &'a [String],
    pub recording: Option<&'a str>,
    pub report: &'a Report,
}

impl RunRow<'_> {
    pub fn insert(&self, connection: &Connection, profile: i64) -> rusqlite::Result<usize> {
        let report = self.report;
        connection.execute(
            "INSERT INTO runs (profile, id, ended, revision, seed, backend, airframes, report, recording)
             VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9)",
            params![
                profile,
                self.id,
                self.ended,
                report.revision,
                // SQLite has no unsigned integers, so the bits are stored as a signed one.
                report.seed as i64,
                report.backend.name(),
                json(&self.airframes),
                json(report),
                self.recording,
            ],
        )
    }
}
