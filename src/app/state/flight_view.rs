//! The console's view of a session. It is dropped as a whole when the session ends.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;
use std::time::Duration;

use super::alert::alert;
use super::{
    ActiveAlerts, Alert, Choice, Connections, FlownMission, Hangar, Histories, PlanFailures,
    SessionLedger, Timing, TrafficPicture,
};
use crate::app::room_list::Room;
use crate::commands::{Act, Command, Order, PlanFlight};
use crate::doctor::LinkFinding;
use crate::geo::LatLon;
use crate::ledger::{LedgerEntry, LedgerRow};
use crate::mission::Stake;
use crate::operator::RehearsalFindings;
use crate::pilot_in_command::PilotsInCommand;
use crate::record::{DeskRecord, InstructorPart};
use crate::swarm::Path;
use crate::text;
use crate::text::Text;
use crate::vehicle::{USUAL_RESERVE_PERCENT, Vehicle, VehicleClass, VehicleId, Vehicles};

/// The console's view of a session: its vehicles, its mission, the selection and the commands.
#[derive(Debug, Clone, Default)]
pub struct FlightView {
    /// The kind of session; `None` between sessions.
    pub(in crate::app) activity: Option<Activity>,
    /// The room to show once the session's vehicles are there.
    pub(in crate::app) first_room: Room,
    /// The vehicles that belong to the session; if empty, every vehicle heard belongs to it.
    pub(in crate::app) expected: BTreeSet<VehicleId>,
    /// The vehicles with their latest telemetry.
    pub(in crate::app) vehicles: Vehicles,
    /// The vehicles that fly their plans, so that a frame need not look at every vehicle.
    in_plan: BTreeSet<VehicleId>,
    /// The histories of the vehicles' readings.
    pub(in crate::app) histories: Histories,
    pub(in crate::app) alerts: ActiveAlerts,
    /// Other aircraft and their closest approaches.
    pub(in crate::app) traffic: TrafficPicture,
    /// The planned paths of vehicles in a joint manoeuvre.
    pub(in crate::app) paths: Vec<Path>,
    pub(in crate::app) rehearsed: PlanFailures,
    /// The places that commands may name.
    pub(in crate::app) places: BTreeMap<String, LatLon>,
    pub(in crate::app) choice: Choice,
    pub(in crate::app) commands: SessionLedger,
    /// Who flies the vehicles.
    pub(in crate::app) pilots: PilotsInCommand,
    /// What an instructor did in this flight.
    pub(in crate::app) instructor: InstructorPart,
    pub(in crate::app) connections: Connections,
    /// The processes that simulate the vehicles, if any.
    pub(in crate::app) hangar: Option<Hangar>,
    pub(in crate::app) task: FlownMission,
    pub(in crate::app) timing: Timing,
}

/// The kind of session.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Activity {
    /// A mission with the given id.
    Mission {
        id: String,
        title: Text,
        /// How the flight counts in a career.
        stake: Stake,
    },
    /// Simulated vehicles without a mission.
    Free,
    /// Running vehicles at these addresses.
    Connected { addresses: Vec<String> },
}

impl Activity {
    /// The session's title in the header.
    pub fn title(&self) -> Text {
        match self {
            Self::Mission { title, .. } => title.clone(),
            Self::Free => text!("session-free"),
            Self::Connected { addresses } => addresses.join(" ").into(),
        }
    }
}

impl FlightView {
    /// Other aircraft, the most urgent first.
    pub fn traffic(&self) -> &TrafficPicture {
        &self.traffic
    }

    /// Who flies the vehicles.
    pub fn pilots(&self) -> &PilotsInCommand {
        &self.pilots
    }

    /// Notes an order of an instructor that has just ended.
    pub(in crate::app) fn note_instructor(&mut self, line: &DeskRecord, at: Duration) {
        self.instructor.add(self.elapsed(at), line);
    }

    /// The time of the mission; without one, that of the session.
    pub(in crate::app) fn elapsed(&self, at: Duration) -> Duration {
        let progress = self.task.progress.as_ref();
        progress.map_or_else(|| self.time(at), |it| it.elapsed)
    }

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
        self.choice.keep(before.choice);
        self.first_room = before.first_room;
        self.rehearsed.keep_trials(before.rehearsed);
    }

    /// Records when the session began. In free flight, the session's clock starts at zero; in a
    /// mission, the mission starts it.
    pub(in crate::app) fn begin(&mut self, now: Duration) {
        self.timing.began_at = now;
        if self.activity == Some(Activity::Free) {
            self.timing.restart(now);
        }
    }

    /// Converts a time on the program's clock to session time; in a mission, to mission time.
    pub fn time(&self, at: Duration) -> Duration {
        self.timing.at(at)
    }

    /// Stores the result of a rehearsal.
    pub(in crate::app) fn note_rehearsal(&mut self, findings: RehearsalFindings) {
        self.rehearsed.note(findings, &self.vehicles);
    }

    /// Why an order needs a confirmation although its verb does not: the state of its vehicles, a
    /// place outside the mission's fence, or plans to be started that failed in a rehearsal or are
    /// identical. `None` if it needs none.
    pub fn hazard(&self, order: &Order) -> Option<Text> {
        let of_vehicles = order.hazard(&self.vehicles);
        let of_place = || self.fence_hazard(order);
        of_vehicles.or_else(of_place).or_else(|| match order.act {
            Act::Command(Command::PlanFlight(PlanFlight::Start)) => {
                self.rehearsed.hazard(order, &self.vehicles)
            }
            Act::Command(_)
            | Act::Deed(_)
            | Act::Manoeuvre(_)
            | Act::Plans(_)
            | Act::Rehearse { .. } => None,
        })
    }

    /// A vehicle's current command and its row: the newest one under way, otherwise the one that ended last.
    pub fn latest(&self, vehicle: VehicleId) -> Option<(&LedgerEntry, &LedgerRow)> {
        self.commands.latest(vehicle)
    }

    /// A vehicle's class, in the grammar's words.
    pub fn class(vehicle: &Vehicle) -> &'static str {
        match vehicle.heartbeat.map(|heartbeat| heartbeat.class) {
            Some(VehicleClass::Copter) => "copter",
            Some(VehicleClass::Plane) => "plane",
            Some(VehicleClass::Rover) => "rover",
            Some(VehicleClass::Sub) => "sub",
            Some(VehicleClass::Px4 | VehicleClass::Other) | None => "vehicle",
        }
    }

    /// A vehicle's display name, which is its kind.
    pub fn name(vehicle: &Vehicle) -> Text {
        vehicle.kind_name()
    }

    /// The doctor's explanation of why no vehicle is heard; `None` for a closed link, which shows
    /// its own error.
    pub fn worst_finding(&self) -> Option<&LinkFinding> {
        self.connections.worst_finding()
    }

    /// Whether the session's vehicles are still starting.
    pub fn is_starting(&self) -> bool {
        self.hangar.as_ref().is_some_and(|hangar| !hangar.begun)
    }

    /// The battery charge that a vehicle must have left after landing, in percent.
    pub fn reserve_percent(&self) -> f64 {
        let mission = self.task.listing.as_ref();
        mission.map_or(USUAL_RESERVE_PERCENT, |it| it.land_reserve_percent)
    }

    /// A vehicle's most serious condition now, if it has any.
    pub fn alert(&self, vehicle: &Vehicle, now: Duration) -> Option<Alert> {
        let is_down = self.alerts.down.contains(&vehicle.id);
        let process = is_down.then(super::alert::process_ended);
        process
            .into_iter()
            .chain(self.alerts.separation(vehicle.id))
            .chain(self.alerts.traffic(vehicle.id))
            .chain(alert(vehicle, self.reserve_percent(), now))
            .min_by_key(|alert| alert.severity)
    }

    /// The number of the session's vehicles that are armed as far as known: those that are in contact, and whose
    /// process has not ended.
    pub fn armed(&self) -> usize {
        let is_down = |vehicle: &Vehicle| self.alerts.down.contains(&vehicle.id);
        let vehicles = self.vehicles.values().map(Arc::as_ref);
        vehicles
            .filter(|vehicle| vehicle.armed() && self.expects(vehicle.id))
            .filter(|vehicle| !vehicle.link.lost && !is_down(vehicle))
            .count()
    }

    /// Whether the vehicle that is heard on a link has been simulated by a process that has ended.
    pub fn leads_to_ended_process(&self, link: usize) -> bool {
        let down = self.alerts.down.iter();
        let mut vehicles = down.filter_map(|id| self.vehicles.get(id));
        vehicles.any(|vehicle| vehicle.link.via.map(usize::from) == Some(link))
    }

    /// Whether a vehicle has been heard over this link.
    pub fn carries_vehicle(&self, link: usize) -> bool {
        let mut vehicles = self.vehicles.values();
        vehicles.any(|vehicle| vehicle.link.via.map(usize::from) == Some(link))
    }

    /// The names of a vehicle's groups.
    pub fn groups_of(&self, vehicle: VehicleId) -> Vec<&str> {
        self.choice.groups_of(vehicle)
    }

    /// Stores a snapshot of a vehicle.
    pub fn insert(&mut self, vehicle: Arc<Vehicle>) {
        let id = vehicle.id;
        self.choice.note(id);
        if vehicle.flies_plan() {
            self.in_plan.insert(id);
        } else {
            self.in_plan.remove(&id);
        }
        self.vehicles.insert(id, vehicle);
    }

    /// Whether a vehicle flies its plan.
    pub fn is_plan_flown(&self) -> bool {
        !self.in_plan.is_empty()
    }

    /// The vehicles to which the target `all` refers.
    pub fn all(&self) -> impl Iterator<Item = VehicleId> + '_ {
        let ids = self.vehicles.keys().copied();
        ids.filter(|id| self.expects(*id))
    }

    /// The vehicles that belong to the session; empty if any vehicle does.
    pub fn expected(&self) -> &BTreeSet<VehicleId> {
        &self.expected
    }

    /// Whether a vehicle belongs to the session.
    pub fn expects(&self, vehicle: VehicleId) -> bool {
        self.expected.is_empty() || self.expected.contains(&vehicle)
    }

    /// Drops a vehicle and its pending commands.
    pub fn forget(&mut self, vehicle: VehicleId, now: Duration) {
        self.commands.forget(vehicle, now);
        self.vehicles.remove(&vehicle);
        self.in_plan.remove(&vehicle);
        self.histories.forget(vehicle);
        self.alerts.forget(vehicle);
        self.choice.forget(vehicle, &self.vehicles);
    }

    pub fn under_cursor(&self) -> Option<&Vehicle> {
        self.vehicles.get(&self.choice.cursor?).map(Arc::as_ref)
    }
}
