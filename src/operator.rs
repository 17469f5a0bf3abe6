//! Carries out command lines: the part that the console and pilot scripts share.
//!
//! [`read_order`] reads a line and finds its vehicles. An [`Operator`] carries an order out: it
//! decides which vehicles get a command, what the mission does with the order, and which rows of
//! the ledger change. It is pure: its owner opens the entry in the ledger, carries out each
//! [`Dispatch`], and calls [`Operator::conduct`] about ten times a second.

use std::collections::BTreeMap;
use std::ops::Range;
use std::time::Duration;

use crate::commands::{Act, Command, Deed, Order, QueryCommand};
use crate::diagnostic::Diagnostic;
use crate::language::{self, Context, Statement};
use crate::ledger::{EntryId, RowState, RowUpdate};
use crate::mission::Flight;
use crate::notice::Notice;
use crate::pilot_in_command::PilotsInCommand;
use crate::session::{Steering, VehicleCommand};
use crate::swarm::{Conductor, ConductorScene, DividedWork, Path, Rules};
use crate::text;
use crate::text::Text;
use crate::vehicle::{VehicleId, Vehicles, Wind};
use crate::verb::CountsAs;

mod plans;
mod rehearsing;
#[cfg(test)]
mod tests;

pub use rehearsing::{
    FailedRehearsal, Meeting, PlanRehearsal, RehearsalFindings, Rehearsed, ending_words,
    flies_in_rehearsals,
};
use rehearsing::{Prepared, RehearsalQueue, RehearsalRequest, Winds};

/// Work for the owner of an operator.
#[derive(Debug, Clone, PartialEq)]
pub enum Dispatch {
    /// Apply a change to a row of the ledger.
    Row(RowUpdate),
    /// Give a vehicle a command.
    Command(VehicleId, VehicleCommand),
    /// Send a vehicle its setpoint.
    Steer(VehicleId, Steering),
    /// Show the user a notice.
    Notice(Notice),
    /// Fly plans in simulation, which takes a while.
    Rehearse(PlanRehearsal),
    /// Show the mission's reason for refusing an order. The rows contain it too, but no vehicle
    /// reports it.
    Refused(Text),
}

/// The state in which orders are carried out, at one moment.
#[derive(Debug)]
pub struct OperatorScene<'a> {
    /// The time on the vehicles' clock.
    pub now: Duration,
    /// The vehicles, as last heard.
    pub vehicles: &'a Vehicles,
    /// The mission, if one is flown.
    pub flight: Option<&'a mut Flight>,
    /// Who flies the vehicles.
    pub pilots: &'a PilotsInCommand,
}

/// Carries out orders to vehicles and to the mission, and joint manoeuvres.
#[derive(Debug, Clone, Default)]
pub struct Operator {
    conductor: Conductor,
    /// Setpoints to deliver again: a stop is sent only once, so a lost one would never arrive.
    undelivered: BTreeMap<VehicleId, Steering>,
    rehearsals: RehearsalQueue,
    divided: DividedWork,
}

/// Reads a line and finds its vehicles; without targets, `selection` applies.
///
/// # Errors
/// The fault and its place in the line.
pub fn read_order(
    line: &str,
    context: &Context<'_>,
    selection: &[VehicleId],
) -> Result<Order, Diagnostic> {
    order_of(
        language::parse(line, context)?,
        line,
        context,
        selection,
        |_| true,
    )
}

/// The order of a line that has been read; without targets, `selection` applies. What has the same result for every
/// vehicle is done by one that its giver flies, if there is one among the targets.
///
/// # Errors
/// Its vehicles do not exist; the fault is at the first word of the line.
pub fn order_of(
    statement: Statement,
    line: &str,
    context: &Context<'_>,
    selection: &[VehicleId],
    is_flown: impl Fn(VehicleId) -> bool,
) -> Result<Order, Diagnostic> {
    let refused = |text: Text| Diagnostic::new(first_word(line), text);
    let mut order = statement.into_order(selection, context).map_err(refused)?;
    let mut targets = order.targets.iter();
    if let Some(missing) = targets.find(|id| !context.vehicles.contains(id)) {
        return Err(refused(text!("order-no-vehicle", vehicle = *missing)));
    }
    if let Act::Deed(deed) = &order.act {
        let doers = deed.doers(&order.targets);
        let mut targets = order.targets.iter();
        let flown = targets.find(|&&id| is_flown(id));
        order.targets = match flown {
            Some(&flown) if doers.len() < order.targets.len() => vec![flown],
            _ => doers.to_vec(),
        };
    }
    Ok(order)
}

/// The first word of a line, at which a fault of the whole line is shown.
pub fn first_word(line: &str) -> Range<usize> {
    let start = line.len() - line.trim_start().len();
    let length = line[start..].find(char::is_whitespace);
    start..length.map_or(line.trim_end().len(), |length| start + length)
}

impl Dispatch {
    /// The same work with its times set to `now`, on another clock.
    #[must_use]
    pub fn at(self, now: Duration) -> Self {
        match self {
            Self::Row(row) => Self::Row(RowUpdate { at: now, ..row }),
            Self::Notice(notice) => Self::Notice(Notice { at: now, ..notice }),
            Self::Command(..) | Self::Steer(..) | Self::Rehearse(_) | Self::Refused(_) => self,
        }
    }
}

impl Operator {
    /// An operator of vehicles that have no orders yet.
    pub fn new(rules: Rules) -> Self {
        Self {
            conductor: Conductor::new(rules),
            ..Self::default()
        }
    }

    /// The work that follows from an order with an open entry in the ledger. Vehicles of which somebody else is the
    /// pilot in command do not take part.
    pub fn carry_out(
        &mut self,
        entry: EntryId,
        order: &Order,
        scene: OperatorScene<'_>,
    ) -> Vec<Dispatch> {
        let (barred, mut work) = barred(entry, order, &scene);
        if barred.is_empty() {
            return self.carry_out_whole(entry, order, scene);
        }
        let is_own = |vehicle: &VehicleId| !barred.contains(vehicle);
        let own = Order {
            targets: order.targets.iter().copied().filter(is_own).collect(),
            ..order.clone()
        };
        if !own.targets.is_empty() {
            work.extend(self.carry_out_whole(entry, &own, scene));
        }
        work
    }

    fn carry_out_whole(
        &mut self,
        entry: EntryId,
        order: &Order,
        scene: OperatorScene<'_>,
    ) -> Vec<Dispatch> {
        let work = self.work(entry, order, scene);
        for dispatch in &work {
            if let Dispatch::Command(vehicle, command) = dispatch
                && command.changes_plan()
            {
                self.rehearsals.note_write(*vehicle, entry);
                if matches!(order.act, Act::Command(_)) {
                    self.divided.forget(*vehicle);
                }
            }
        }
        work
    }

    /// Notes a change of a row that comes from a vehicle: rehearsals wait for the end of uploads.
    pub fn note_row(&mut self, row: &RowUpdate) {
        if row.state.is_final() {
            self.rehearsals.note_end(row.vehicle, row.entry);
        }
    }

    fn work(&mut self, entry: EntryId, order: &Order, scene: OperatorScene<'_>) -> Vec<Dispatch> {
        match &order.act {
            Act::Command(command) => {
                let flight = scene.flight.as_deref();
                if let Some(reason) = flight.and_then(|flight| flight.refusal(command)) {
                    return refused(entry, order, &reason, scene.now);
                }
                let (mut work, vehicles) = self.assign(entry, order, &scene);
                work.extend(vehicles.into_iter().map(|vehicle| {
                    let command = VehicleCommand::new(entry, order.verb, command.clone());
                    Dispatch::Command(vehicle, command)
                }));
                work
            }
            Act::Manoeuvre(_) => self.assign(entry, order, &scene).0,
            Act::Plans(task) => self.put_plans(entry, order, task, &scene),
            Act::Rehearse { wind } => self.rehearse(entry, order, *wind, &scene),
            Act::Deed(deed) => done_by_mission(entry, order, deed, scene),
        }
    }

    /// Adds vehicles to a manoeuvre, or removes them. Returns the changed rows, and the vehicles whose own autopilots
    /// carry the order out.
    fn assign(
        &mut self,
        entry: EntryId,
        order: &Order,
        scene: &OperatorScene<'_>,
    ) -> (Vec<Dispatch>, Vec<VehicleId>) {
        // Earlier setpoints no longer matter.
        self.undelivered.retain(|id, _| !order.targets.contains(id));
        let around = ConductorScene {
            now: scene.now,
            vehicles: scene.vehicles,
            pilots: scene.pilots,
        };
        let assignment = self.conductor.take(entry, order, around);
        let rows = assignment.rows.into_iter().map(Dispatch::Row);
        (rows.collect(), assignment.alone)
    }

    /// Advances joint manoeuvres and rehearsals; returns the work that is due.
    pub fn conduct(&mut self, scene: ConductorScene<'_>) -> Vec<Dispatch> {
        let ConductorScene { now, vehicles, .. } = scene;
        let turn = self.conductor.step(scene);
        let mut late = std::mem::take(&mut self.undelivered);
        late.retain(|id, _| turn.steering.iter().all(|(newer, _)| newer != id));
        let rows = turn.rows.into_iter().map(Dispatch::Row);
        let steering = late.into_iter().chain(turn.steering);
        let notices = turn.notices.into_iter().map(Dispatch::Notice);
        let rehearsals = self.rehearsals.step(vehicles, now);
        rows.chain(steering.map(|(id, steering)| Dispatch::Steer(id, steering)))
            .chain(notices)
            .chain(rehearsals.into_iter().flat_map(prepared))
            .collect()
    }

    /// Rehearses plans, with the wind and the airframes of the mission.
    fn rehearse(
        &mut self,
        entry: EntryId,
        order: &Order,
        given: Option<Wind>,
        scene: &OperatorScene<'_>,
    ) -> Vec<Dispatch> {
        let flight = scene.flight.as_deref();
        let request = RehearsalRequest {
            entry,
            order: order.clone(),
            winds: Winds {
                given,
                of_mission: flight.map(Flight::wind),
            },
            airframes: flight.map_or_else(Vec::new, |it| it.mission().airframes()),
        };
        let taken = self.rehearsals.take(request, scene.vehicles, scene.now);
        prepared(taken).collect()
    }

    /// Notes whether steering has been delivered. If not, the next [`Self::conduct`] returns it
    /// again, unless the vehicle gets an order or newer steering before then.
    pub fn note_delivery(&mut self, vehicle: VehicleId, steering: Steering, is_delivered: bool) {
        if is_delivered {
            self.undelivered.remove(&vehicle);
        } else {
            self.undelivered.insert(vehicle, steering);
        }
    }

    pub fn paths(&self) -> Vec<Path> {
        self.conductor.paths()
    }
}

/// The vehicles that do not get the order, because its giver does not fly them, with the rows that say so. Rehearsals, what
/// is said to the mission, and questions concern no pilot, except for the question that changes what a vehicle sends.
fn barred(
    entry: EntryId,
    order: &Order,
    scene: &OperatorScene<'_>,
) -> (Vec<VehicleId>, Vec<Dispatch>) {
    let concerns_pilots = match order.verb.counts_as {
        CountsAs::Task | CountsAs::Setting | CountsAs::PlanChange | CountsAs::Report => true,
        CountsAs::Question => matches!(
            order.act,
            Act::Command(Command::Query(QueryCommand::Interval { .. }))
        ),
        CountsAs::Rehearsal | CountsAs::Word | CountsAs::Pledge | CountsAs::SelfReport => false,
    };
    let (by, duty) = (order.by.as_ref(), order.verb.duty);
    let refusal = |&vehicle: &VehicleId| {
        let reason = scene.pilots.refusal(vehicle, by, duty)?;
        let row = Dispatch::Row(RowUpdate {
            entry,
            vehicle,
            state: RowState::Barred,
            tries: 0,
            at: scene.now,
            explanation: Some(reason),
        });
        Some((vehicle, row))
    };
    let targets = order.targets.iter().filter(|_| concerns_pilots);
    targets.filter_map(refusal).unzip()
}

fn prepared(prepared: Prepared) -> impl Iterator<Item = Dispatch> {
    let rows = prepared.rows.into_iter().map(Dispatch::Row);
    rows.chain(prepared.rehearsal.map(Dispatch::Rehearse))
}

/// Passes an order to the mission; without a mission it is refused.
fn done_by_mission(
    entry: EntryId,
    order: &Order,
    deed: &Deed,
    scene: OperatorScene<'_>,
) -> Vec<Dispatch> {
    let now = scene.now;
    let rows: Vec<RowUpdate> = match scene.flight {
        Some(flight) => flight.act(entry, deed, &order.targets),
        None => order
            .targets
            .iter()
            .map(|&vehicle| no_mission(entry, vehicle))
            .collect(),
    };
    let mut refused = rows.iter().filter(|row| row.state == RowState::Refused);
    let reason = refused.next().and_then(|row| row.explanation.clone());
    let refusal = reason.map(|reason| {
        let parts = vec![order.line.as_str().into(), reason];
        Dispatch::Refused(Text::joined(": ", parts))
    });
    rows.into_iter()
        .map(|row| Dispatch::Row(RowUpdate { at: now, ..row }))
        .chain(refusal)
        .collect()
}

fn refused(entry: EntryId, order: &Order, reason: &Text, now: Duration) -> Vec<Dispatch> {
    let row = |&vehicle: &VehicleId| {
        Dispatch::Row(RowUpdate {
            entry,
            vehicle,
            state: RowState::Refused,
            tries: 0,
            at: now,
            explanation: Some(reason.clone()),
        })
    };
    let mut work: Vec<Dispatch> = order.targets.iter().map(row).collect();
    let parts = vec![order.line.as_str().into(), reason.clone()];
    work.push(Dispatch::Refused(Text::joined(": ", parts)));
    work
}

fn no_mission(entry: EntryId, vehicle: VehicleId) -> RowUpdate {
    RowUpdate {
        entry,
        vehicle,
        state: RowState::Refused,
        tries: 0,
        at: Duration::ZERO,
        explanation: Some(text!("deed-no-mission")),
    }
}
