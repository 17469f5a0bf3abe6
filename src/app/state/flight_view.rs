//! The session; dropped as a whole when it ends.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;
use std::time::Duration;

use super::alert::alert;
use super::{
    Alarms, Alert, ForwardSummary, Hangar, Heights, Histories, LinkSummary, Selection, SessionPace,
    SessionTime,
};
use crate::app::room_list::Room;
use crate::doctor::{Cause, LinkFinding, Weight};
use crate::geo::LatLon;
use crate::language::Groups;
use crate::ledger::{EntryId, Given, Ledger, LedgerEntry, LedgerRow, RowState, RowUpdate};
use crate::mission::{Area, Listing, Progress, Stake};
use crate::swarm::Path;
use crate::text;
use crate::text::Text;
use crate::vehicle::{Vehicle, VehicleClass, VehicleId, Vehicles};

/// The console's view of a session: its vehicles, its mission, the selection and the notices.
#[derive(Debug, Clone, Default)]
pub struct FlightView {
    /// The kind of session; `None` between sessions.
    pub(in crate::app) activity: Option<Activity>,
    /// The room to show once its vehicles are there.
    pub(in crate::app) first_room: Room,
    /// When it began, on the program's clock.
    pub(in crate::app) began_at: Duration,
    /// The vehicles that belong to it; empty for all that are received.
    pub(in crate::app) expected: BTreeSet<VehicleId>,
    /// The vehicles with their latest telemetry.
    pub(in crate::app) vehicles: Vehicles,
    /// The histories of their readings.
    pub(in crate::app) histories: Histories,
    /// The selected vehicles; without any, commands go to the one under the cursor.
    pub(in crate::app) selection: Selection,
    /// The vehicle under the cursor.
    pub(in crate::app) cursor: Option<VehicleId>,
    pub(in crate::app) alarms: Alarms,
    /// All commands of the session.
    pub(in crate::app) ledger: Ledger,
    /// The links, in the order of their addresses.
    pub(in crate::app) links: Vec<LinkSummary>,
    /// The forwards to other ground stations.
    pub(in crate::app) forwards: Vec<ForwardSummary>,
    /// The processes that simulate the vehicles, if any.
    pub(in crate::app) hangar: Option<Hangar>,
    /// The mission, if there is one.
    pub(in crate::app) listing: Option<Box<Listing>>,
    /// The findings of the link doctor, worst first.
    pub(in crate::app) findings: Vec<LinkFinding>,
    /// Findings already reported, by link and name.
    pub(in crate::app) told: BTreeSet<(usize, &'static str)>,
    /// The mission's progress, if there is one.
    pub(in crate::app) mission: Option<Progress>,
    /// Mission time by the program's clock.
    pub(in crate::app) clock: SessionTime,
    /// The greatest height of any vehicle, by mission time.
    pub(in crate::app) heights: Heights,
    /// Whether the mission is over and its debrief is ready.
    pub(in crate::app) over: bool,
    /// Whether time runs.
    pub(in crate::app) flow: TimeFlow,
    /// The groups that commands may name.
    pub(in crate::app) groups: Groups,
    /// The places that commands may name.
    pub(in crate::app) places: BTreeMap<String, LatLon>,
    /// The areas of the mission that are known from the start.
    pub(in crate::app) areas: Vec<Area>,
    /// The planned paths of vehicles in a joint manoeuvre.
    pub(in crate::app) paths: Vec<Path>,
    /// For each vehicle, its newest ledger entry and those that were under way when that was opened.
    recent: BTreeMap<VehicleId, Vec<EntryId>>,
    /// The speed-up of simulated time.
    pub(in crate::app) pace: SessionPace,
    /// Whether the user has moved the cursor.
    cursor_placed: bool,
}

/// Whether a session's time runs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum TimeFlow {
    #[default]
    Passes,
    /// The session is paused.
    Paused,
    /// The mission has not begun: its brief is still shown.
    AwaitsReader,
}

/// The kind of session.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Activity {
    /// A mission with the given id.
    Mission {
        id: String,
        title: Text,
        /// The stake of the flight.
        stake: Stake,
    },
    /// Simulated vehicles without a task.
    Free,
    /// Running vehicles at these addresses.
    Connected { addresses: Vec<String> },
}

impl Activity {
    /// Its title in the header.
    pub fn title(&self) -> Text {
        match self {
            Self::Mission { title, .. } => title.clone(),
            Self::Free => text!("session-free"),
            Self::Connected { addresses } => addresses.join(" ").into(),
        }
    }
}

impl FlightView {
    /// The planned paths of vehicles in a joint manoeuvre.
    pub fn paths(&self) -> &[Path] {
        &self.paths
    }

    /// A session that has just begun.
    pub fn new(activity: Activity, places: BTreeMap<String, LatLon>) -> Self {
        Self {
            activity: Some(activity),
            places,
            ..Self::default()
        }
    }

    /// Takes the user's choices from the previous view.
    pub(in crate::app) fn keep_choices(&mut self, before: Self) {
        self.selection = before.selection;
        self.groups = before.groups;
        self.first_room = before.first_room;
        if before.cursor_placed {
            self.cursor = before.cursor;
            self.cursor_placed = true;
        }
    }

    /// Starts its clock at zero; in a mission, that of the mission.
    pub(in crate::app) fn begin(&mut self, now: Duration) {
        self.began_at = now;
        if self.activity == Some(Activity::Free) {
            self.clock = SessionTime::default();
            self.clock.go(now, self.pace.now);
        }
    }

    /// Session time for a time of the program's clock; in a mission, mission time.
    pub fn time(&self, at: Duration) -> Duration {
        let clock = self.clock.at(at);
        clock.unwrap_or_else(|| at.saturating_sub(self.began_at))
    }

    /// Opens a ledger entry.
    pub fn open(&mut self, at: Duration, given: Given<'_>, targets: &[VehicleId]) -> EntryId {
        let entry = self.ledger.open(at, given, targets);
        for &id in targets {
            let under_way = |&known: &EntryId| {
                row(&self.ledger, known, id).is_some_and(|(_, row)| !row.state.is_final())
            };
            let recent = self.recent.entry(id).or_default();
            recent.retain(under_way);
            recent.push(entry);
        }
        entry
    }

    /// A vehicle's current command and its row: the newest one under way, otherwise the newest.
    pub fn latest(&self, vehicle: VehicleId) -> Option<(&LedgerEntry, &LedgerRow)> {
        let recent = self.recent.get(&vehicle)?;
        let found = |&id: &EntryId| row(&self.ledger, id, vehicle);
        let mut newest_first = recent.iter().rev().filter_map(found);
        newest_first
            .find(|(_, row)| !row.state.is_final())
            .or_else(|| recent.last().and_then(found))
    }

    /// A vehicle's class, in the grammar's words.
    pub fn class(vehicle: &Vehicle) -> &'static str {
        match vehicle.heartbeat.map(|heartbeat| heartbeat.class) {
            Some(VehicleClass::Copter) => "copter",
            Some(VehicleClass::Plane) => "plane",
            Some(VehicleClass::Rover) => "rover",
            Some(VehicleClass::Sub) => "sub",
            Some(VehicleClass::Other) | None => "vehicle",
        }
    }

    /// A vehicle's display name, which is its class.
    pub fn name(vehicle: &Vehicle) -> Text {
        Text::new(format!("class-{}", Self::class(vehicle)), Vec::new())
    }

    /// Why no vehicle is received, as found by the link doctor; a closed link shows its own error.
    pub fn worst_finding(&self) -> Option<&LinkFinding> {
        let worst = self.findings.first()?;
        let is_told = worst.cause.weight() == Weight::Fatal && worst.cause != Cause::NotOpen;
        is_told.then_some(worst)
    }

    /// Whether its vehicles are still starting.
    pub fn is_starting(&self) -> bool {
        self.hangar.as_ref().is_some_and(|hangar| !hangar.begun)
    }

    /// A vehicle's most serious condition now, if it has any.
    pub fn alert(&self, vehicle: &Vehicle, now: Duration) -> Option<Alert> {
        let is_down = self.alarms.down.contains(&vehicle.id);
        let process = is_down.then(super::alert::process_ended);
        process
            .into_iter()
            .chain(alert(vehicle, now))
            .min_by_key(|alert| alert.severity)
    }

    /// The number of armed vehicles.
    pub fn armed(&self) -> usize {
        self.vehicles
            .values()
            .filter(|vehicle| vehicle.armed())
            .count()
    }

    /// The names of a vehicle's groups.
    pub fn groups_of(&self, vehicle: VehicleId) -> Vec<&str> {
        let mine = |members: &[VehicleId]| members.contains(&vehicle);
        let groups = self.groups.iter().filter(|(_, members)| mine(members));
        groups.map(|(name, _)| name.as_str()).collect()
    }

    /// Puts the cursor on a vehicle and keeps it there.
    pub fn place_cursor(&mut self, id: VehicleId) {
        self.cursor = Some(id);
        self.cursor_placed = true;
    }

    /// Stores a snapshot of a vehicle. Until the user moves the cursor, it is on the vehicle with the lowest number.
    pub fn insert(&mut self, vehicle: Arc<Vehicle>) {
        let id = vehicle.id;
        self.vehicles.insert(id, vehicle);
        if self
            .cursor
            .is_none_or(|cursor| id < cursor && !self.cursor_placed)
        {
            self.cursor = Some(id);
        }
    }

    /// The vehicles of the target `all`.
    pub fn all(&self) -> impl Iterator<Item = VehicleId> + '_ {
        let ids = self.vehicles.keys().copied();
        ids.filter(|id| self.expects(*id))
    }

    /// Whether a vehicle belongs to the session.
    pub fn expects(&self, vehicle: VehicleId) -> bool {
        self.expected.is_empty() || self.expected.contains(&vehicle)
    }

    /// Drops a vehicle and its pending commands.
    pub fn forget(&mut self, vehicle: VehicleId, now: Duration) {
        for entry in self.recent.remove(&vehicle).unwrap_or_default() {
            let known = row(&self.ledger, entry, vehicle).map(|(_, row)| row.tries);
            self.ledger.apply(&RowUpdate {
                entry,
                vehicle,
                state: RowState::TimedOut,
                tries: known.unwrap_or_default(),
                at: now,
                explanation: Some(text!("outcome-forgotten")),
            });
        }
        self.vehicles.remove(&vehicle);
        self.histories.forget(vehicle);
        self.selection.remove(&vehicle);
        self.alarms.forget(vehicle);
        for members in self.groups.values_mut() {
            members.retain(|member| *member != vehicle);
        }
        if self.cursor == Some(vehicle) {
            let below = || self.vehicles.range(..vehicle).next_back();
            let nearest = self.vehicles.range(vehicle..).next().or_else(below);
            self.cursor = nearest.map(|(&id, _)| id);
        }
    }

    /// The vehicle under the cursor.
    pub fn under_cursor(&self) -> Option<&Vehicle> {
        self.vehicles.get(&self.cursor?).map(Arc::as_ref)
    }
}

fn row(ledger: &Ledger, entry: EntryId, vehicle: VehicleId) -> Option<(&LedgerEntry, &LedgerRow)> {
    let entry = ledger.entry(entry)?;
    let row = entry.rows.iter().find(|row| row.vehicle == vehicle)?;
    Some((entry, row))
}
