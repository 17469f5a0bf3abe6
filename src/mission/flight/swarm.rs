//! How the vehicles are put to use, and how their operator handles them.

use std::time::Duration;

use crate::ledger::{EntryId, Ledger, LedgerEntry};
use crate::mission::craft::Craft;
use crate::mission::survey::Surveys;
use crate::mission::usage::{UsageLook, VehicleUsage};
use crate::scoring::{SwarmFigures, SwarmTimes, VehicleUse};
use crate::vehicle::VehicleId;
use crate::verb::Movement;

/// The account of how the vehicles are used and led.
#[derive(Debug, Default)]
pub(super) struct SwarmAccount {
    /// What each craft did with its time, in the order of the crafts.
    usage: Vec<VehicleUsage>,
    times: SwarmTimes,
    /// The newest command to vehicles.
    newest: Option<NewestOrder>,
}

/// A command to vehicles.
#[derive(Debug)]
struct NewestOrder {
    id: EntryId,
    targets: Vec<VehicleId>,
}

impl SwarmAccount {
    /// Another vehicle takes part.
    pub fn add(&mut self, vehicle: VehicleId) {
        self.usage.push(VehicleUsage::new(vehicle));
    }

    /// Takes the tick into the account of every vehicle.
    pub fn step(&mut self, crafts: &[Craft], surveys: &Surveys, ledger: &Ledger, now: Duration) {
        let commanded = self.note_orders(ledger, now);
        for (craft, usage) in crafts.iter().zip(&mut self.usage) {
            let flies = craft.airborne && !craft.lost;
            // Nobody hears of samples that are taken while the radio is cut.
            let samples = craft.can_see() && surveys.want(craft);
            let mut entries = ledger.entries().rev();
            let latest = entries.find(|entry| is_order_to(entry, craft.id));
            let on_station = latest.is_some_and(|entry| entry.verb.movement == Movement::Station);
            let look = UsageLook {
                airborne_at: craft.place_m().filter(|_| flies),
                busy: samples || on_station,
                commanded: commanded.contains(&craft.id),
            };
            usage.step(look, &mut self.times);
        }
    }

    /// How the operator handles the swarm so far.
    pub fn figures(&self, crafts: &[Craft], now: Duration) -> SwarmFigures {
        let flown = crafts.iter().filter(|craft| craft.flown).count();
        self.times.figures(flown, now)
    }

    /// How each of so many vehicles was used; those that nobody has heard were not.
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

    /// Takes down the commands that are new; returns the vehicles that they were for.
    fn note_orders(&mut self, ledger: &Ledger, now: Duration) -> Vec<VehicleId> {
        let newest = self.newest.as_ref().map(|order| order.id);
        let entries = ledger.entries().rev();
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
            self.newest = Some(NewestOrder { id, targets });
        }
        commanded
    }
}

fn is_for_vehicles(entry: &LedgerEntry) -> bool {
    entry.verb.counts_as.is_for_vehicles()
}

fn is_order_to(entry: &LedgerEntry, vehicle: VehicleId) -> bool {
    is_for_vehicles(entry) && entry.rows.iter().any(|row| row.vehicle == vehicle)
}
