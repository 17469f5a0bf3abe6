//! Manoeuvres of several vehicles: surveys, formations, following, spreading, searches and relay chains.
//!
//! The [`Conductor`] turns each [`Manoeuvre`] into setpoints for its vehicles and checks their progress by telemetry.
//! It is pure: its owner (the console, an exercise) calls [`Conductor::step`] about ten times a second, sends the
//! result and enters the rows in the ledger.
//!
//! **Separation.** All vehicles first fly to their places on paths that do not meet (`transit`), then each works in
//! its own space: survey lines lie side by side (every second vehicle flies higher if they are closer than the
//! separation), each search and each follower has its own height, a formation moves as a rigid body (`march`). A
//! vehicle that would come too close to one outside of its manoeuvre waits (`guard`).
//!
//! **Leader.** The first of the targets leads a formation. A `goto` or an `altitude` to it, alone or with others,
//! moves the whole formation, and the rows of the other members end when it has arrived. Any other movement takes a
//! vehicle out of its manoeuvre; the others close up, or share its lines (`lanes`). A formation has the speed
//! commanded to its leader (`speed`). Only members with the leader's pilot are moved by such an order, or by the
//! formation's closing up: all others leave it before, and stay where they are.
//!
//! **Spacing.** A survey has lines as far apart as its command says, otherwise as wide as the sensor's strip at the
//! height of the lines, otherwise 20 m. A mission gives the strip of its sensors (`swarm_rules` in
//! `mission::together`): that of the detector with the narrowest one, on whichever drone. Free flight has no sensors.
//!
//! # How the parts fit
//! - An order: `planner` selects the vehicles that can take part and plans the manoeuvre, with `slots` (the places of
//!   a formation), `lanes` (which vehicle flies which lines), `geometry` (which vehicle gets which place) and `site`
//!   (the local frame).
//! - The flight: `transit` brings all to their places, `act` carries the manoeuvre out and repeats setpoints, `march`
//!   moves a formation, `guard` makes a vehicle wait.
//! - Plans: `tasks` makes a plan for each vehicle of `plan survey` or `draft survey`; `divided` remembers which plans
//!   are parts of the same work. `gathering` warns if a command sends several vehicles to one place.

use std::time::Duration;

use crate::commands::{Act, Command, FlightCommand, Manoeuvre, MotionCommand, Order};
use crate::geo::LatLon;
use crate::ledger::{EntryId, RowState, RowUpdate};
use crate::notice::Notice;
use crate::pilot_in_command::PilotsInCommand;
use crate::plan::generate::USUAL_SPACING_M;
use crate::rehearsal::TOO_NEAR_M;
use crate::session::Steering;
use crate::text;
use crate::text::Text;
use crate::vehicle::{Severity, VehicleId, Vehicles};
use crate::verb::Verb;

mod act;
mod divided;
mod fitting;
mod gathering;
mod geometry;
mod guard;
mod lanes;
mod march;
mod planner;
mod site;
mod slots;
mod tasks;
#[cfg(test)]
mod tests;
mod transit;

use act::{ActiveManoeuvre, WorldView};
pub use divided::{DividedWork, carrying};
use planner::Planner;
pub use tasks::{base, outermost_places};

/// The minimum line spacing that a sensor sets, in metres; a narrower strip is ignored.
const LEAST_SPACING_M: f64 = 0.3;

/// The rules of all manoeuvres in a session.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rules {
    /// The minimum distance between two vehicles, in metres.
    pub separation_m: f64,
    /// The strip that the sensor covers, which determines the default line spacing; `None` without
    /// a sensor.
    pub swath: Option<Swath>,
}

/// The width of the strip that a sensor covers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Swath {
    /// The width at height 0, in metres.
    pub at_ground_m: f64,
    /// The additional width per metre of height.
    pub per_metre: f64,
}

impl Swath {
    /// The width at a height, in metres.
    pub fn width_m(&self, height_m: f64) -> f64 {
        self.at_ground_m + self.per_metre * height_m.max(0.0)
    }
}

impl Rules {
    /// The width of the sensor's strip at a height, in metres, if it determines the line spacing.
    fn strip_m(&self, height_m: f64) -> Option<f64> {
        let width_m = self.swath?.width_m(height_m);
        (width_m >= LEAST_SPACING_M).then_some(width_m)
    }

    /// The default spacing of lines at a height, in metres, for manoeuvres and plans.
    fn line_spacing_m(&self, height_m: f64) -> f64 {
        self.strip_m(height_m).unwrap_or(USUAL_SPACING_M)
    }
}

impl Default for Rules {
    /// Without a sensor, and with the separation that rehearsals and alerts require.
    fn default() -> Self {
        Self {
            separation_m: TOO_NEAR_M,
            swath: None,
        }
    }
}

/// An order for a joint manoeuvre.
#[derive(Debug, Clone, Copy)]
struct Call<'a> {
    entry: EntryId,
    verb: &'static Verb,
    manoeuvre: &'a Manoeuvre,
    /// The vehicles that take part, the leader first.
    targets: &'a [VehicleId],
}

/// An order that each vehicle carries out on its own.
#[derive(Debug, Clone, Copy)]
struct Ordered<'a> {
    entry: EntryId,
    verb: &'static Verb,
    command: &'a Command,
    targets: &'a [VehicleId],
}

/// The vehicles at one moment, and who flies them.
#[derive(Debug, Clone, Copy)]
pub struct ConductorScene<'a> {
    /// The time on the vehicles' clock.
    pub now: Duration,
    pub vehicles: &'a Vehicles,
    pub pilots: &'a PilotsInCommand,
}

impl<'a> ConductorScene<'a> {
    fn view(self, rules: Rules) -> WorldView<'a> {
        let ConductorScene {
            now,
            vehicles,
            pilots,
        } = self;
        WorldView {
            now,
            vehicles,
            pilots,
            rules,
        }
    }
}

/// The result of an order.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Assignment {
    /// The vehicles whose own autopilots carry the order out.
    pub alone: Vec<VehicleId>,
    /// The changed rows of this order and of earlier ones.
    pub rows: Vec<RowUpdate>,
}

/// The result of a step.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct StepOutcome {
    /// The vehicles' current setpoints.
    pub steering: Vec<(VehicleId, Steering)>,
    pub rows: Vec<RowUpdate>,
    /// Notices for the user.
    pub notices: Vec<Notice>,
}

/// A vehicle's planned path, for the map.
#[derive(Debug, Clone, PartialEq)]
pub struct Path {
    pub vehicle: VehicleId,
    /// The points ahead, the next one first; a single point is a place to hold.
    pub points: Vec<LatLon>,
}

/// Controls all manoeuvres of a session.
#[derive(Debug, Clone, Default)]
pub struct Conductor {
    rules: Rules,
    acts: Vec<ActiveManoeuvre>,
    /// Output waiting for the next step.
    waiting: StepOutcome,
}

impl Conductor {
    /// A conductor without manoeuvres.
    pub fn new(rules: Rules) -> Self {
        Self {
            rules,
            ..Self::default()
        }
    }

    /// Accepts an order that already has a ledger entry, and decides which vehicles carry it out by
    /// themselves. Only commands and manoeuvres have an effect here.
    pub fn take(&mut self, entry: EntryId, order: &Order, scene: ConductorScene<'_>) -> Assignment {
        self.leave_behind(order, scene);
        let (verb, targets) = (order.verb, order.targets.as_slice());
        match &order.act {
            Act::Command(command) => {
                let ordered = Ordered {
                    entry,
                    verb,
                    command,
                    targets,
                };
                self.order(ordered, scene)
            }
            Act::Manoeuvre(manoeuvre) => {
                let call = Call {
                    entry,
                    verb,
                    manoeuvre,
                    targets,
                };
                Assignment {
                    alone: Vec::new(),
                    rows: self.begin(call, scene),
                }
            }
            Act::Deed(_) | Act::Plans(_) | Act::Rehearse { .. } => Assignment::default(),
        }
    }

    /// Before an order to the leader of a formation moves it, those whom the leader's pilot does not fly leave it.
    fn leave_behind(&mut self, order: &Order, scene: ConductorScene<'_>) {
        if !is_for_formation(&order.act) {
            return;
        }
        let view = scene.view(self.rules);
        for act in &mut self.acts {
            if act.leader().is_some_and(|it| order.targets.contains(&it)) {
                act.leave_behind(&view, &mut self.waiting);
            }
        }
    }

    /// Begins a manoeuvre. Its members leave their earlier manoeuvres; vehicles that cannot take
    /// part are refused.
    fn begin(&mut self, call: Call<'_>, scene: ConductorScene<'_>) -> Vec<RowUpdate> {
        if *call.manoeuvre == Manoeuvre::Disband {
            return self.disband(call, scene);
        }
        let mut planner = Planner::new(scene.view(self.rules), call);
        planner.pick_team();
        let taken = planner.team();
        let act = planner.make();
        let mut rows = std::mem::take(&mut planner.rows);
        if let Some(act) = act {
            self.release(&taken, &call.verb.name.into(), scene);
            self.waiting.steering.retain(|(id, _)| !taken.contains(id));
            rows.splice(0..0, std::mem::take(&mut self.waiting.rows));
            self.acts.push(act);
        }
        rows
    }

    /// Notes a command before it is sent; returns the vehicles to send it to. A movement takes its vehicles out of
    /// their manoeuvres, or moves a whole formation and is sent to none of its members.
    fn order(&mut self, ordered: Ordered<'_>, scene: ConductorScene<'_>) -> Assignment {
        let ConductorScene { now, vehicles, .. } = scene;
        let mut left = ordered.targets.to_vec();
        if ordered.verb.movement.moves() && !is_guided(ordered.command) {
            for act in &mut self.acts {
                let claimed = match goal(ordered.command, act, vehicles) {
                    Some(goal) => act.lead(goal, ordered, now, &mut self.waiting.rows),
                    None => Vec::new(),
                };
                left.retain(|id| !claimed.contains(id));
            }
            self.release(&left, &ordered.verb.name.into(), scene);
            // A stop that waits for the next step would end the new movement.
            self.waiting.steering.retain(|(id, _)| !left.contains(id));
            let meeting = gathering::meeting(ordered.command, &left, vehicles, self.rules);
            let notice = meeting.map(|text| Notice::general(now, Severity::Warning, text));
            self.waiting.notices.extend(notice);
        }
        Assignment {
            alone: left,
            rows: std::mem::take(&mut self.waiting.rows),
        }
    }

    pub fn step(&mut self, scene: ConductorScene<'_>) -> StepOutcome {
        let mut outcome = std::mem::take(&mut self.waiting);
        let view = scene.view(self.rules);
        for act in &mut self.acts {
            act.pace(scene.vehicles);
            act.step(&view, &mut outcome);
        }
        self.acts.retain(|act| !act.is_over());
        outcome
    }

    pub fn paths(&self) -> Vec<Path> {
        self.acts.iter().flat_map(ActiveManoeuvre::paths).collect()
    }

    /// Whether a vehicle is in a manoeuvre.
    pub fn has(&self, vehicle: VehicleId) -> bool {
        self.acts.iter().any(|act| act.has(vehicle))
    }

    /// Takes vehicles out of their manoeuvres; the others continue without them.
    fn release(&mut self, ids: &[VehicleId], by: &Text, scene: ConductorScene<'_>) {
        let view = scene.view(self.rules);
        let reason = text!("outcome-superseded", by = by);
        for act in &mut self.acts {
            let gone: Vec<VehicleId> = ids.iter().copied().filter(|id| act.has(*id)).collect();
            if !gone.is_empty() {
                act.lose(
                    &gone,
                    RowState::Superseded,
                    &reason,
                    &view,
                    &mut self.waiting,
                );
            }
        }
        self.acts.retain(|act| !act.is_over());
    }

    fn disband(&mut self, call: Call<'_>, scene: ConductorScene<'_>) -> Vec<RowUpdate> {
        let ConductorScene { now, vehicles, .. } = scene;
        let in_formation = |id: &VehicleId| {
            let mut acts = self.acts.iter();
            acts.any(|act| act.is_formation() && act.has(*id))
        };
        let (free, others): (Vec<VehicleId>, Vec<VehicleId>) =
            call.targets.iter().partition(|id| in_formation(id));
        let stops: Vec<(VehicleId, Steering)> = self
            .acts
            .iter()
            .flat_map(|act| act.stops(&free, vehicles))
            .collect();
        self.release(&free, &call.verb.name.into(), scene);
        self.waiting.steering.extend(stops);
        let row = |state, explanation: Option<Text>| {
            move |vehicle: VehicleId| RowUpdate {
                entry: call.entry,
                vehicle,
                state,
                tries: 1,
                at: now,
                explanation: explanation.clone(),
            }
        };
        let mut rows = std::mem::take(&mut self.waiting.rows);
        rows.extend(free.into_iter().map(row(RowState::Done, None)));
        let none = Some(text!("swarm-no-formation"));
        rows.extend(others.into_iter().map(row(RowState::Refused, none)));
        rows
    }
}

/// Whether an order to the leader of a formation is for all of it.
fn is_for_formation(act: &Act) -> bool {
    matches!(
        act,
        Act::Command(Command::Motion(
            MotionCommand::Goto { .. }
                | MotionCommand::Altitude { .. }
                | MotionCommand::Speed { .. }
        ))
    )
}

/// Whether a command sets GUIDED, the mode that every member already has.
fn is_guided(command: &Command) -> bool {
    matches!(command, Command::Flight(FlightCommand::SetMode { name }) if name.eq_ignore_ascii_case("GUIDED"))
}

#[derive(Debug, Clone, Copy, PartialEq)]
struct FormationGoal {
    /// The destination of the first vehicle.
    place: LatLon,
    /// The height above home; `None` keeps the height.
    altitude_m: Option<f64>,
}

/// The destination that a command sets for a formation, if any.
fn goal(command: &Command, act: &ActiveManoeuvre, vehicles: &Vehicles) -> Option<FormationGoal> {
    let leader = vehicles.get(&act.leader()?)?;
    let here = leader.global?;
    match command {
        Command::Motion(MotionCommand::Altitude { altitude_m }) => Some(FormationGoal {
            place: here.at_point,
            altitude_m: Some(*altitude_m),
        }),
        Command::Motion(MotionCommand::Goto { destination, .. }) => {
            let (place, altitude_m) = destination.of(leader)?;
            Some(FormationGoal { place, altitude_m })
        }
        Command::Motion(
            MotionCommand::Speed { .. }
            | MotionCommand::Yaw { .. }
            | MotionCommand::Velocity { .. }
            | MotionCommand::Orbit { .. }
            | MotionCommand::RegionOfInterest { .. }
            | MotionCommand::SetHome { .. },
        )
        | Command::Arming(_)
        | Command::Flight(_)
        | Command::PlanFlight(_)
        | Command::Device(_)
        | Command::Query(_)
        | Command::Parameter(_)
        | Command::Log(_)
        | Command::File(_)
        | Command::Plan(_)
        | Command::Signing(_)
        | Command::Raw(_) => None,
    }
}
