//! The session; dropped as a whole when it ends.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;
use std::time::Duration;

use super::alert::alert;
use super::{
    ActiveAlerts, Alert, Choice, Connections, FlownMission, Hangar, Histories, SessionLedger,
    Timing,
};
use crate::app::room_list::Room;
use crate::commands::{Act, Command, Order, PlanFlight};
use crate::doctor::LinkFinding;
use crate::draft::PlanVerdict;
use crate::geo::LatLon;
use crate::ledger::{LedgerEntry, LedgerRow};
use crate::mission::Stake;
use crate::operator::{FailedRehearsal, Meeting, RehearsalFindings};
use crate::plan::ContentHash;
use crate::swarm::Path;
use crate::text;
use crate::text::Text;
use crate::vehicle::{USUAL_RESERVE_PERCENT, Vehicle, VehicleClass, VehicleId, Vehicles};
use crate::vehicle_id::ranges;

/// The console's view of a session: its vehicles, its mission, the selection and the commands.
#[derive(Debug, Clone, Default)]
pub struct FlightView {
    /// The kind of session; `None` between sessions.
    pub(in crate::app) activity: Option<Activity>,
    /// The room to show once its vehicles are there.
    pub(in crate::app) first_room: Room,
    /// The vehicles that belong to it; empty for all that are received.
    pub(in crate::app) expected: BTreeSet<VehicleId>,
    /// The vehicles with their latest telemetry.
    pub(in crate::app) vehicles: Vehicles,
    /// The histories of their readings.
    pub(in crate::app) histories: Histories,
    pub(in crate::app) alerts: ActiveAlerts,
    /// The planned paths of vehicles in a joint manoeuvre.
    pub(in crate::app) paths: Vec<Path>,
    /// Where vehicles come too close to each other in the newest rehearsal.
    pub(in crate::app) meetings: Vec<Meeting>,
    /// The plans that failed in the newest rehearsal of each vehicle.
    pub(in crate::app) failed_rehearsals: BTreeMap<VehicleId, FailedRehearsal>,
    /// Why plans failed in the newest rehearsal of drafts.
    pub(in crate::app) failed_trials: BTreeMap<ContentHash, Text>,
    /// The places that commands may name.
    pub(in crate::app) places: BTreeMap<String, LatLon>,
    pub(in crate::app) choice: Choice,
    pub(in crate::app) commands: SessionLedger,
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
        self.choice.keep(before.choice);
        self.first_room = before.first_room;
        // Drafts outlast a session.
        self.failed_trials = before.failed_trials;
    }

    /// Notes when the session began. In free flight, its clock starts at zero; in a mission, the mission starts it.
    pub(in crate::app) fn begin(&mut self, now: Duration) {
        self.timing.began_at = now;
        if self.activity == Some(Activity::Free) {
            self.timing.restart(now);
        }
    }

    /// Session time for a time of the program's clock; in a mission, mission time.
    pub fn time(&self, at: Duration) -> Duration {
        self.timing.at(at)
    }

    /// Notes the result of a rehearsal.
    pub(in crate::app) fn note_rehearsal(&mut self, findings: RehearsalFindings) {
        self.meetings = findings.meetings;
        for vehicle in findings.passed {
            self.failed_rehearsals.remove(&vehicle);
            if let Some(plan) = self.carried(vehicle) {
                self.failed_trials.remove(&plan);
            }
        }
        let failed = findings.failed.into_iter();
        self.failed_rehearsals
            .extend(failed.map(|failed| (failed.vehicle, failed)));
    }

    /// Notes how plans of drafts were flown.
    pub(in crate::app) fn note_trial(&mut self, verdicts: &[PlanVerdict]) {
        for PlanVerdict { plan, .. } in verdicts {
            self.failed_trials.remove(plan);
        }
        // Several vehicles may fly the same plan: it has failed if one of them has.
        let failed = verdicts.iter().filter_map(|it| {
            let reason = it.failure.clone()?;
            Some((it.plan, reason))
        });
        self.failed_trials.extend(failed);
    }

    /// The hash of the plan on board a vehicle, if it has been read.
    fn carried(&self, vehicle: VehicleId) -> Option<ContentHash> {
        let plan = self.vehicles.get(&vehicle)?.plans.plan.content.as_ref()?;
        Some(ContentHash::of(plan.flown()))
    }

    /// Why an order needs a confirmation although its verb does not: by the state of its vehicles, or because the plans
    /// that it starts have failed in a rehearsal or are the same.
    pub fn hazard(&self, order: &Order) -> Option<Text> {
        let of_vehicles = order.hazard(&self.vehicles);
        of_vehicles.or_else(|| match order.act {
            Act::Command(Command::PlanFlight(PlanFlight::Start)) => self
                .rehearsal_hazard(order)
                .or_else(|| self.same_plan_hazard(order)),
            Act::Command(_)
            | Act::Deed(_)
            | Act::Manoeuvre(_)
            | Act::Plans(_)
            | Act::Rehearse { .. } => None,
        })
    }

    /// Why an order is dangerous that starts the same plan on several vehicles: they would meet.
    fn same_plan_hazard(&self, order: &Order) -> Option<Text> {
        let mut known = BTreeMap::new();
        order.targets.iter().find_map(|id| {
            let plan = self.vehicles.get(id)?.plans.plan.content.as_ref()?;
            let mark = ContentHash::of(plan.flown()).0;
            let first = known
                .insert(mark, *id)
                .filter(|_| !plan.flown().is_empty())?;
            Some(text!("hazard-plan-same", first = first, second = *id))
        })
    }

    /// Why an order is dangerous that starts plans which have failed in a rehearsal: the vehicles by the reason, and the
    /// pairs that came too close to each other.
    fn rehearsal_hazard(&self, order: &Order) -> Option<Text> {
        let mut failed: Vec<(Text, Vec<VehicleId>)> = Vec::new();
        for id in &order.targets {
            let Some(reason) = self.rehearsal_failure(*id) else {
                continue;
            };
            match failed.iter_mut().find(|(known, _)| known == reason) {
                Some((_, vehicles)) => vehicles.push(*id),
                None => failed.push((reason.clone(), vec![*id])),
            }
        }
        let has_failed = |id: &VehicleId| failed.iter().any(|(_, vehicles)| vehicles.contains(id));
        let pairs = self.meetings.iter().map(|meeting| meeting.vehicles);
        let met: Vec<[VehicleId; 2]> = pairs.filter(|pair| pair.iter().any(has_failed)).collect();
        let is_other = met.iter().flatten().any(|id| !order.targets.contains(id));
        let named = met.iter().map(|[a, b]| format!("{a}/{b}"));
        let named = named.collect::<Vec<_>>().join(", ");
        let mut parts: Vec<Text> = failed
            .into_iter()
            .map(|(reason, vehicles)| {
                let vehicles = ranges(vehicles);
                text!(
                    "hazard-plan-rehearsal",
                    vehicles = vehicles,
                    reason = reason
                )
            })
            .collect();
        parts.first()?;
        parts.extend((!named.is_empty()).then(|| text!("hazard-plan-met", pairs = named)));
        parts.extend(is_other.then(|| {
            let targets = ranges(order.targets.iter().copied());
            text!("hazard-plan-rehearse-these", targets = targets)
        }));
        Some(Text::joined("; ", parts))
    }

    /// Why the plan that a vehicle carries failed in its last rehearsal, on board or as a draft.
    fn rehearsal_failure(&self, id: VehicleId) -> Option<&Text> {
        let plan = self.carried(id)?;
        let on_board = self.failed_rehearsals.get(&id);
        let on_board = on_board.filter(|failed| failed.plan == plan);
        let reason = on_board.map(|failed| &failed.reason);
        reason.or_else(|| self.failed_trials.get(&plan))
    }

    /// A vehicle's current command and its row: the newest one under way, otherwise the newest.
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
            Some(VehicleClass::Other) | None => "vehicle",
        }
    }

    /// A vehicle's display name, which is its class.
    pub fn name(vehicle: &Vehicle) -> Text {
        Text::new(format!("class-{}", Self::class(vehicle)), Vec::new())
    }

    /// Why no vehicle is received, as found by the link doctor; a closed link shows its own error.
    pub fn worst_finding(&self) -> Option<&LinkFinding> {
        self.connections.worst_finding()
    }

    /// Whether its vehicles are still starting.
    pub fn is_starting(&self) -> bool {
        self.hangar.as_ref().is_some_and(|hangar| !hangar.begun)
    }

    /// The charge that a vehicle has to keep for after its landing, in percent.
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
            .chain(alert(vehicle, self.reserve_percent(), now))
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
        self.choice.groups_of(vehicle)
    }

    /// Stores a snapshot of a vehicle.
    pub fn insert(&mut self, vehicle: Arc<Vehicle>) {
        self.choice.note(vehicle.id);
        self.vehicles.insert(vehicle.id, vehicle);
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
        self.commands.forget(vehicle, now);
        self.vehicles.remove(&vehicle);
        self.histories.forget(vehicle);
        self.alerts.forget(vehicle);
        self.choice.forget(vehicle, &self.vehicles);
    }

    pub fn under_cursor(&self) -> Option<&Vehicle> {
        self.vehicles.get(&self.choice.cursor?).map(Arc::as_ref)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::language::{Context, Meaning, parse};
    use crate::plan::Item;
    use crate::vehicle::{Plan, Stored, Transfer};

    fn carrying(height_m: f32) -> Vehicle {
        let mut vehicle = Vehicle::new(1, 1);
        let item = Item {
            command: 22,
            frame: 3,
            z: height_m,
            ..Item::default()
        };
        vehicle.plans.plan = Stored {
            content: Some(Arc::new(Plan {
                items: vec![item],
                home_first: false,
            })),
            transfer: Transfer::Done,
        };
        vehicle
    }

    fn order(line: &str) -> Order {
        let statement = parse(line, &Context::default()).expect("a line");
        let Meaning::Act(act) = statement.meaning else {
            panic!("{line}");
        };
        Order {
            line: line.to_owned(),
            verb: statement.verb,
            targets: vec![1],
            act,
        }
    }

    /// A plan that fails in a rehearsal is begun only after a confirmation, until another plan is on board or the same
    /// one passes.
    #[test]
    fn a_failed_rehearsal_makes_the_start_of_its_plan_dangerous() {
        let mut view = FlightView::default();
        view.insert(Arc::new(carrying(20.0)));
        let plan = carrying(20.0).plans.plan.content.expect("a plan");
        let failed = FailedRehearsal {
            vehicle: 1,
            plan: ContentHash::of(plan.flown()),
            reason: Text::verbatim("does not take off"),
        };
        let start = order("plan start");
        assert_eq!(view.hazard(&start), None);
        let findings = RehearsalFindings {
            failed: vec![failed],
            ..RehearsalFindings::default()
        };
        view.note_rehearsal(findings.clone());
        let reason = view.hazard(&start).expect("it asks").to_string();
        assert!(reason.contains("does not take off"), "{reason}");
        assert_eq!(view.hazard(&order("plan skip")), None);
        view.insert(Arc::new(carrying(25.0)));
        assert_eq!(view.hazard(&start), None, "another plan");
        view.insert(Arc::new(carrying(20.0)));
        view.note_rehearsal(RehearsalFindings {
            passed: vec![1],
            ..RehearsalFindings::default()
        });
        assert_eq!(view.hazard(&start), None, "it passes now");
    }

    /// The question names the other vehicle, and how to rehearse without it.
    #[test]
    fn a_plan_that_met_another_names_it() {
        let mut view = FlightView::default();
        view.insert(Arc::new(carrying(20.0)));
        let plan = carrying(20.0).plans.plan.content.expect("a plan");
        view.note_rehearsal(RehearsalFindings {
            failed: vec![FailedRehearsal {
                vehicle: 1,
                plan: ContentHash::of(plan.flown()),
                reason: Text::verbatim("comes too close"),
            }],
            meetings: vec![Meeting {
                vehicles: [1, 3],
                at_point: LatLon::new(50.45, 30.52),
            }],
            ..RehearsalFindings::default()
        });
        let reason = view.hazard(&order("plan start")).expect("it asks");
        let reason = reason.to_string();
        assert!(
            reason.contains("too close: 1/3; `1 plan rehearse`"),
            "{reason}"
        );
    }

    #[test]
    fn all_plans_that_failed_are_named_by_their_reasons() {
        let mut view = FlightView::default();
        let plan = carrying(20.0).plans.plan.content.expect("a plan");
        let mut failed = Vec::new();
        for (id, reason) in [(1, "collides"), (2, "collides"), (3, "hits the ground")] {
            let mut vehicle = carrying(20.0);
            vehicle.id = id;
            view.insert(Arc::new(vehicle));
            failed.push(FailedRehearsal {
                vehicle: id,
                plan: ContentHash::of(plan.flown()),
                reason: Text::verbatim(reason),
            });
        }
        view.note_rehearsal(RehearsalFindings {
            failed,
            meetings: vec![Meeting {
                vehicles: [1, 2],
                at_point: LatLon::new(50.45, 30.52),
            }],
            ..RehearsalFindings::default()
        });
        let mut start = order("plan start");
        start.targets = vec![1, 2, 3];
        let reason = view.hazard(&start).expect("it asks").to_string();
        for part in ["1-2: collides", "3: hits the ground", "too close: 1/2"] {
            assert!(reason.contains(part), "{part}: {reason}");
        }
        assert!(!reason.contains("plan rehearse"), "{reason}");
    }

    /// The same holds for a draft that fails before it is uploaded.
    #[test]
    fn a_failed_rehearsal_of_a_draft_makes_the_start_of_its_plan_dangerous() {
        let mut view = FlightView::default();
        view.insert(Arc::new(carrying(20.0)));
        let plan = carrying(20.0).plans.plan.content.expect("a plan");
        let verdict = |failure: Option<&str>| PlanVerdict {
            plan: ContentHash::of(plan.flown()),
            failure: failure.map(Text::verbatim),
        };
        let start = order("plan start");
        view.note_trial(&[verdict(None)]);
        assert_eq!(view.hazard(&start), None);
        view.note_trial(&[verdict(Some("meets 2 at 0:20")), verdict(None)]);
        let reason = view.hazard(&start).expect("it asks").to_string();
        assert!(reason.contains("meets 2 at 0:20"), "{reason}");
        view.insert(Arc::new(carrying(25.0)));
        assert_eq!(view.hazard(&start), None, "another plan");
        view.insert(Arc::new(carrying(20.0)));
        view.note_rehearsal(RehearsalFindings {
            passed: vec![1],
            ..RehearsalFindings::default()
        });
        assert_eq!(view.hazard(&start), None, "it passes on board");
    }

    #[test]
    fn vehicles_with_the_same_plan_start_together_only_after_a_confirmation() {
        let mut view = FlightView::default();
        let second = |height_m| {
            let mut vehicle = carrying(height_m);
            vehicle.id = 2;
            Arc::new(vehicle)
        };
        view.insert(Arc::new(carrying(20.0)));
        view.insert(second(20.0));
        let mut start = order("plan start");
        assert_eq!(view.hazard(&start), None, "one vehicle");
        start.targets = vec![1, 2];
        let reason = view.hazard(&start).expect("it asks").to_string();
        assert!(reason.contains("1 and 2 carry the same plan"), "{reason}");
        view.insert(second(25.0));
        assert_eq!(view.hazard(&start), None);
    }
}
