//! The use of the vehicles, and the operator's handling of them.

use std::collections::BTreeMap;
use std::time::Duration;

use crate::ledger::{EntryId, Ledger, LedgerEntry};
use crate::mission::craft::Craft;
use crate::mission::survey::Surveys;
use crate::mission::usage::{UsageLook, VehicleUsage};
use crate::scoring::{SwarmFigures, SwarmTimes, VehicleUse, WorkloadCourse, WorkloadReport};
use crate::vehicle::VehicleId;
use crate::verb::Movement;

/// The account of the vehicles' use and of the operator's commands.
#[derive(Debug, Clone, Default)]
pub(super) struct SwarmAccount {
    /// Each vehicle's use of time, in the order of the vehicles.
    usage: Vec<VehicleUsage>,
    times: SwarmTimes,
    course: WorkloadCourse,
    newest: Option<NewestOrder>,
    latest: BTreeMap<VehicleId, EntryId>,
}

#[derive(Debug, Clone)]
struct NewestOrder {
    id: EntryId,
    targets: Vec<VehicleId>,
}

impl SwarmAccount {
    pub fn add(&mut self, vehicle: VehicleId) {
        self.usage.push(VehicleUsage::new(vehicle));
    }

    /// Adds a tick to every vehicle's account.
    pub fn step(&mut self, crafts: &[Craft], surveys: &Surveys, ledger: &Ledger, now: Duration) {
        let commanded = self.note_orders(ledger, now);
        for (craft, usage) in crafts.iter().zip(&mut self.usage) {
            let flies = craft.under_way && !craft.lost;
            // Samples taken while the radio is cut do not count.
            let samples = craft.can_see() && surveys.want(craft);
            let newest = self.latest.get(&craft.id);
            let latest = newest.and_then(|entry| ledger.entry(*entry));
            let on_station = latest.is_some_and(|entry| entry.verb.movement == Movement::Station);
            let look = UsageLook {
                airborne_at: craft.place_m().filter(|_| flies),
                busy: samples || on_station,
                commanded: commanded.contains(&craft.id),
            };
            usage.step(look, &mut self.times);
        }
        if self.course.is_due(now) {
            let loads = self.usage.iter().map(VehicleUsage::load);
            self.course.note(loads.sum());
        }
    }

    /// Records the trainee's answer to the workload question, from 1 to 5.
    pub fn answer(&mut self, now: Duration, level: u8) {
        self.course.answer(now, level);
    }

    /// The number of the newest workload question that was answered, from 1; `None` if none was.
    pub fn answered_question(&self) -> Option<u64> {
        self.course.answered_question()
    }

    /// The workload over the flight.
    pub fn workload(&self) -> WorkloadReport {
        let commands = self.times.commands.iter().map(|command| command.0);
        self.course.report(&commands.collect::<Vec<_>>())
    }

    /// Figures on the operator's handling so far.
    pub fn figures(&self, crafts: &[Craft], now: Duration) -> SwarmFigures {
        let flown = crafts.iter().filter(|craft| craft.flown).count();
        self.times.figures(flown, now)
    }

    /// The use of `wanted` vehicles; a vehicle that was never heard from has zero use.
    pub fn uses(&self, wanted: usize) -> Vec<VehicleUse> {
        let heard = self.usage.iter().map(VehicleUsage::totals);
        let used: Vec<VehicleId> = heard.clone().map(|totals| totals.vehicle).collect();
        let unheard = (1..=VehicleId::MAX).filter(|id| !used.contains(id));
        let unused = unheard.map(|vehicle| VehicleUse {
            vehicle,
            ..VehicleUse::default()
        });
        heard.chain(unused).take(wanted).collect()
    }

    /// Records new commands; returns the vehicles that they addressed.
    fn note_orders(&mut self, ledger: &Ledger, now: Duration) -> Vec<VehicleId> {
        let newest = self.newest.as_ref().map(|order| order.id);
        let entries = ledger.judged_entries().rev();
        let mut new: Vec<&LedgerEntry> = entries
            .take_while(|entry| Some(entry.id) > newest)
            .collect();
        new.reverse();
        let mut commanded = Vec::new();
        for entry in new.into_iter().filter(|entry| is_for_vehicles(entry)) {
            let targets: Vec<VehicleId> = entry.rows.iter().map(|row| row.vehicle).collect();
            let before = self.newest.as_ref().map(|order| &order.targets);
            let switched = before.is_some_and(|before| *before != targets);
            self.times.commands.push((now, targets.len(), switched));
            commanded.extend(&targets);
            let id = entry.id;
            self.latest
                .extend(targets.iter().map(|target| (*target, id)));
            self.newest = Some(NewestOrder { id, targets });
        }
        commanded
    }
}

fn is_for_vehicles(entry: &LedgerEntry) -> bool {
    entry.verb.counts_as.is_for_vehicles()
}
