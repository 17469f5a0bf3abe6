//! How the vehicles are put to use, and how their operator handles them.

use super::Flight;
use crate::ledger::{Entry, Ledger};
use crate::mission::usage::{Look, Usage};
use crate::scoring::{SwarmFigures, VehicleUse};
use crate::vehicle::VehicleId;
use crate::verb::Movement;

impl Flight {
    /// Takes the tick into the account of every vehicle.
    pub(super) fn step_usage(&mut self, ledger: &Ledger) {
        let commanded = self.note_orders(ledger);
        for (craft, usage) in self.crafts.iter().zip(&mut self.usage) {
            let flies = craft.airborne && !craft.lost;
            // Nobody hears of samples that are taken while the radio is cut.
            let samples = craft.at.is_some_and(|at| {
                let mut surveys = self.surveys.iter();
                let wants = surveys.any(|it| it.wants(at, craft.height_m, craft.speed_m_s));
                wants && flies && craft.heard
            });
            let latest = ledger
                .entries()
                .rev()
                .find(|entry| is_order_to(entry, craft.id));
            let on_station = latest.is_some_and(|entry| entry.verb.movement == Movement::Station);
            let look = Look {
                airborne_at: craft.place_m().filter(|_| flies),
                busy: samples || on_station,
                commanded: commanded.contains(&craft.id),
            };
            usage.step(look, &mut self.swarm);
        }
    }

    /// How the operator handles the swarm so far.
    pub(super) fn swarm_figures(&self) -> SwarmFigures {
        let flown = self.crafts.iter().filter(|craft| craft.flown).count();
        self.swarm.figures(flown, self.elapsed)
    }

    /// How each vehicle that the mission wants was used; those that nobody has heard were not.
    pub(super) fn vehicle_uses(&self) -> Vec<VehicleUse> {
        let heard = self.usage.iter().map(Usage::totals);
        let used = |id: &VehicleId| self.crafts.iter().any(|craft| craft.id == *id);
        let unheard = (1..=VehicleId::MAX).filter(|id| !used(id));
        let unheard = unheard.map(|vehicle| VehicleUse {
            vehicle,
            ..VehicleUse::default()
        });
        let wanted = self.mission.vehicles;
        heard.chain(unheard).take(wanted).collect()
    }

    /// Takes down the commands that are new; returns the vehicles that they were for.
    fn note_orders(&mut self, ledger: &Ledger) -> Vec<VehicleId> {
        let newest = self.ordered.as_ref().map(|(id, _)| *id);
        let new = ledger.entries().rev();
        let mut new: Vec<&Entry> = new.take_while(|entry| Some(entry.id) > newest).collect();
        new.reverse();
        let mut commanded = Vec::new();
        for entry in new.into_iter().filter(|entry| is_for_vehicles(entry)) {
            let targets: Vec<VehicleId> = entry.rows.iter().map(|row| row.vehicle).collect();
            let before = self.ordered.as_ref().map(|(_, targets)| targets);
            let switched = before.is_some_and(|before| *before != targets);
            let order = (self.elapsed, targets.len(), switched);
            self.swarm.commands.push(order);
            commanded.extend(&targets);
            self.ordered = Some((entry.id, targets));
        }
        commanded
    }
}

fn is_for_vehicles(entry: &Entry) -> bool {
    entry.verb.counts_as.is_for_vehicles()
}

fn is_order_to(entry: &Entry, vehicle: VehicleId) -> bool {
    is_for_vehicles(entry) && entry.rows.iter().any(|row| row.vehicle == vehicle)
}
