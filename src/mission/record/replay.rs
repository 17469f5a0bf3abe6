//! Reading a record, and replaying it through the mission.

use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::Duration;

use super::{End, Head, RecordChange, RecordLine, VERSION, checksum};
use crate::diagnostic::Diagnostic;
use crate::hash::RunningHash;
use crate::ledger::{EntryId, Given, Ledger, RowState, RowUpdate};
use crate::mission::{Flight, Mission, Stake, TICK};
use crate::notice::Notice;
use crate::scoring::{FlightBackend, Report};
use crate::session::Want;
use crate::text;
use crate::text::Text;
use crate::vehicle::{VehicleId, Vehicles};
use crate::workshop::Design;

/// A record in memory.
#[derive(Debug, Clone, PartialEq)]
pub struct Stored {
    pub head: Head,
    /// The damage to the file after its readable part.
    pub damage: Option<Text>,
    pub(super) lines: Arc<Vec<RecordLine>>,
    is_altered: bool,
    ending: RecordEnding,
}

/// How the lines of a record end.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum RecordEnding {
    /// The last line is the score of a finished flight.
    Score,
    /// After a whole line that is not the end.
    Open,
    /// In the middle of a line.
    Torn,
    /// Before a line that is damaged or goes back in time.
    Damaged,
}

/// How a flight whose record has no end is scored.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum WithoutEnd {
    /// As if the mission time had run out where the record ends.
    Over,
    /// As if the trainee had abandoned the mission where the record ends.
    Left,
}

/// A record scored again.
#[derive(Debug, Clone, PartialEq)]
pub struct Rescored {
    /// The result by the current rules.
    pub report: Report,
    /// The recorded result; `None` for a record without an end.
    pub before: Option<End>,
}

impl Stored {
    /// Reads a record up to the first line that is damaged or goes back in time.
    ///
    /// # Errors
    /// The text is not a record, or is a record of another version.
    pub fn read(text: &str) -> Result<Self, Text> {
        let mut all = text.split_inclusive('\n');
        let first = all.next().unwrap_or_default();
        let version = serde_json::from_str::<serde_json::Value>(first)
            .ok()
            .and_then(|head| head.get("sortie_run")?.as_u64())
            .ok_or_else(|| text!("record-none"))?;
        if version != u64::from(VERSION) {
            return Err(text!("record-version", version = version, known = VERSION));
        }
        let head: Head = serde_json::from_str(first)
            .map_err(|error| text!("record-head", error = error.to_string()))?;
        let mut stored = Self {
            head,
            damage: None,
            lines: Arc::default(),
            is_altered: false,
            ending: RecordEnding::Score,
        };
        let mut lines = Vec::new();
        let mut since = 0;
        let mut sum = RunningHash::default();
        sum.add(first.as_bytes());
        for (index, line) in all.enumerate() {
            let is_over = lines
                .last()
                .is_some_and(|it: &RecordLine| it.end().is_some());
            let read = serde_json::from_str(line)
                .ok()
                .filter(|read: &RecordLine| read.time().is_none_or(|t| t >= since));
            let Some(read) = read.filter(|_| !is_over) else {
                stored.break_off(index + 2, !is_over && !line.ends_with('\n'));
                break;
            };
            since = read.time().unwrap_or(since);
            let stated = read.checksum();
            stored.is_altered = stated.is_some_and(|stated| stated != checksum(sum));
            sum.add(line.as_bytes());
            if read == RecordLine::Recall {
                stored.head.stake = Stake::Practice;
            }
            lines.push(read);
        }
        stored.lines = Arc::new(lines);
        if stored.damage.is_none() && stored.end().is_none() {
            stored.ending = RecordEnding::Open;
            stored.damage = Some(text!("record-no-end"));
        }
        Ok(stored)
    }

    /// Ends the record before a line of the file.
    fn break_off(&mut self, line: usize, is_torn: bool) {
        (self.ending, self.damage) = if is_torn {
            (RecordEnding::Torn, Some(text!("record-torn", line = line)))
        } else {
            let damaged = text!("record-damaged", line = line);
            (RecordEnding::Damaged, Some(damaged))
        };
    }

    /// The fault of a damaged line; `None` for a record that is whole or only lacks its end.
    pub fn damaged_line(&self) -> Option<&Text> {
        match self.ending {
            RecordEnding::Score | RecordEnding::Open => None,
            RecordEnding::Torn | RecordEnding::Damaged => self.damage.as_ref(),
        }
    }

    /// Whether all lines are valid, and only the end is missing.
    pub fn is_open(&self) -> bool {
        match self.ending {
            RecordEnding::Open | RecordEnding::Torn => true,
            RecordEnding::Score | RecordEnding::Damaged => false,
        }
    }

    /// Whether the flight was paused after its mission's time had begun. A machine that starts the vehicles slowly stalls
    /// before that, and nothing is gained by it.
    pub fn has_pauses(&self) -> bool {
        let lines = self.lines.iter();
        let mut flown = lines.skip_while(|line| line.time().is_none_or(|ms| ms == 0));
        flown.any(|line| matches!(line, RecordLine::Pause { .. }))
    }

    /// Whether the record was changed after the flight: its end states another checksum. Records from before
    /// checksums existed have none.
    pub fn is_altered(&self) -> bool {
        self.is_altered
    }

    /// Whether the end states a checksum, so that edits are detected.
    pub fn has_checksum(&self) -> bool {
        let mut lines = self.lines.iter();
        lines.any(|line| line.checksum().is_some())
    }

    /// The recorded result, if the flight was flown to its end.
    pub fn end(&self) -> Option<&End> {
        self.lines.last().and_then(RecordLine::end)
    }

    /// Whether the flight was left before the mission was over, by the trainee or because the console ended.
    pub fn was_left(&self) -> bool {
        let mut lines = self.lines.iter();
        self.end().is_none() || lines.any(|line| matches!(line, RecordLine::Abandon))
    }

    /// Scores the record again; `without_end` applies if it has no end.
    ///
    /// # Errors
    ///
    /// This program cannot read the mission in the record.
    pub fn rescore(&self, without_end: WithoutEnd) -> Result<Rescored, Text> {
        let mut replay = self.reenact()?;
        drop(replay.advance(Duration::MAX));
        if self.end().is_none() && without_end == WithoutEnd::Left {
            replay.flight.abandon();
        }
        Ok(Rescored {
            report: replay.report(),
            before: self.end().copied(),
        })
    }

    /// The flight before its first step, ready to be repeated step by step.
    ///
    /// # Errors
    ///
    /// This program cannot read the mission in the record.
    pub fn reenact(&self) -> Result<Reenactment, Text> {
        let mission = self.head.flown()?;
        let mut flight = Flight::new(Arc::new(mission), self.head.seed);
        flight.set_attempt(self.head.attempt);
        flight.set_flown_by(self.head.flown_by);
        flight.set_stake(self.head.stake);
        Ok(Reenactment {
            flight,
            backend: self.head.backend,
            vehicles: BTreeMap::new(),
            ledger: Ledger::new(),
            entries: BTreeMap::new(),
            now: None,
            lines: Arc::clone(&self.lines),
            is_broken: false,
            next: 0,
            said: Vec::new(),
        })
    }
}

impl Head {
    /// The mission as it was flown.
    ///
    /// # Errors
    ///
    /// This program cannot read the mission or the drones in the record.
    pub fn flown(&self) -> Result<Mission, Text> {
        let mission = Mission::parse(&self.source)
            .map_err(|faults| unreadable(&faults, &self.mission, &self.source))?;
        let mut fleet = Vec::new();
        for design in &self.designs {
            let built = Design::from_toml(design);
            fleet.push(built.map_err(|faults| unreadable(&faults, "design.toml", design))?);
        }
        // The price limits may have changed since the flight.
        Ok(mission.flown_by(fleet).flown_for(self.stake))
    }
}

fn unreadable(faults: &[Diagnostic], name: &str, source: &str) -> Text {
    let fault = faults.first().map(|fault| fault.one_line(name, source));
    text!("record-mission", fault = fault.unwrap_or_default())
}

/// A recorded flight, repeated up to a chosen time.
#[derive(Debug)]
pub struct Reenactment {
    flight: Flight,
    backend: FlightBackend,
    vehicles: Vehicles,
    ledger: Ledger,
    /// The recorded ids of ledger entries, with their ids in this flight.
    entries: BTreeMap<u32, EntryId>,
    now: Option<Duration>,
    pub(super) lines: Arc<Vec<RecordLine>>,
    /// Whether a line that was added cannot be read.
    is_broken: bool,
    next: usize,
    said: Vec<Notice>,
}

impl Reenactment {
    /// Advances to a mission time and returns the notices.
    pub fn advance(&mut self, until: Duration) -> Vec<Notice> {
        let lines = Arc::clone(&self.lines);
        while let Some(line) = lines.get(self.next) {
            let is_due = line
                .time()
                .is_none_or(|t| Duration::from_millis(t) <= until);
            if !is_due {
                // Steps without a change have no line.
                self.pass(until.saturating_add(TICK));
                break;
            }
            self.next += 1;
            self.take(line);
        }
        std::mem::take(&mut self.said)
    }

    /// Adds whole lines that the record has got since; one that cannot be read is left out, with all that ever follow.
    pub fn grow(&mut self, lines: &str) {
        let mut read: Vec<RecordLine> = Vec::new();
        for line in lines.lines() {
            if self.is_broken {
                break;
            }
            let line = serde_json::from_str(line);
            self.is_broken = line.is_err();
            read.extend(line.ok());
        }
        if !read.is_empty() {
            Arc::make_mut(&mut self.lines).extend(read);
        }
    }

    /// Whether the record has ended.
    pub fn is_over(&self) -> bool {
        self.next == self.lines.len()
    }

    /// The flight so far.
    pub fn flight(&self) -> &Flight {
        &self.flight
    }

    /// The vehicles as the mission last saw them.
    pub fn vehicles(&self) -> &Vehicles {
        &self.vehicles
    }

    /// The report, as if the flight had ended here.
    pub fn report(&self) -> Report {
        Report {
            backend: self.backend,
            ..self.flight.report(&self.ledger)
        }
    }

    /// The mission's demands on vehicles since the last call.
    pub(super) fn take_wants(&mut self) -> impl Iterator<Item = (VehicleId, Want)> + use<> {
        let demands = self.flight.take_demands();
        demands
            .into_iter()
            .map(|demand| (demand.vehicle, demand.want))
    }

    /// How often the commands to a vehicle were sent, counting only commands in a state that
    /// `is_wanted` accepts.
    pub(super) fn tries_of(&self, vehicle: VehicleId, is_wanted: impl Fn(RowState) -> bool) -> u32 {
        let rows = self.ledger.entries().flat_map(|entry| &entry.rows);
        let counted = rows.filter(|row| row.vehicle == vehicle && is_wanted(row.state));
        counted.map(|row| u32::from(row.tries)).sum()
    }

    fn take(&mut self, line: &RecordLine) {
        match line {
            RecordLine::Tick { t, change, .. } => {
                let at = Duration::from_millis(*t);
                self.pass(at);
                self.change(change, at);
                self.step(at);
            }
            RecordLine::Act { deed, vehicles } => {
                // The rows of the deed are in the record.
                drop(self.flight.act(EntryId(0), deed, vehicles));
            }
            RecordLine::Lose { vehicle, change } => {
                self.change(change, self.now.unwrap_or_default());
                let said = self.flight.lose(*vehicle, &self.vehicles);
                self.said.extend(said);
            }
            RecordLine::Inject { name } => drop(self.flight.inject(name)),
            RecordLine::Pause { seconds } => {
                let said = self.flight.note_pause(Duration::from_secs(*seconds));
                self.said.extend(said);
            }
            RecordLine::Abandon => self.flight.abandon(),
            // Nothing follows in the record.
            RecordLine::Recall => {}
            RecordLine::Stop => self.flight.stop(),
            RecordLine::End { t, change, .. } => {
                let at = Duration::from_millis(*t);
                self.pass(at + TICK);
                self.change(change, at);
            }
        }
    }

    /// Runs the steps before `until` that have no line, while the flight lasts: a damaged time may
    /// be years ahead.
    fn pass(&mut self, until: Duration) {
        while let Some(next) = self.now.map(|now| now + TICK).filter(|next| *next < until)
            && !self.flight.is_over()
        {
            self.step(next);
        }
    }

    fn step(&mut self, at: Duration) {
        self.now = Some(at);
        let said = self.flight.step(at, &self.vehicles, &self.ledger);
        self.said.extend(said);
    }

    fn change(&mut self, change: &RecordChange, at: Duration) {
        for observed in &change.v {
            let vehicle = self
                .vehicles
                .entry(observed.id())
                .or_insert_with(|| Arc::new(observed.vehicle()));
            observed.apply(Arc::make_mut(vehicle), at);
        }
        for entry in &change.e {
            let given = Given {
                line: &entry.line,
                verb: entry.verb,
                risk: entry.risk,
                by: entry.by.as_ref(),
            };
            let id = self.ledger.open(at, given, &entry.vehicles);
            self.entries.insert(entry.id, id);
        }
        for row in &change.r {
            let Some(&entry) = self.entries.get(&row.id) else {
                continue;
            };
            self.ledger.apply(&RowUpdate {
                entry,
                ..row.update(at)
            });
        }
    }
}
