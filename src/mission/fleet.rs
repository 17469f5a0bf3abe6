//! The drones that a mission is flown with, where somebody built their own.

use super::Mission;
use crate::text;
use crate::text::Text;
use crate::workshop::{Air, Design, Severity};

impl Mission {
    /// What flies it, in the order of the seats; empty for the mission's own drones.
    pub fn fleet(&self) -> &[Design] {
        &self.fleet
    }

    /// The air that it is flown in. Packs come from a warm bag.
    pub fn air(&self) -> Air {
        Air {
            altitude_m: self.origin.altitude_amsl_m,
            temperature_c: self.weather.temperature_c,
            ..Air::default()
        }
    }

    /// The same flown with built drones: one design for all seats, or one per seat, the last one for all that follow.
    /// Without any design, its own drones fly it.
    ///
    /// # Errors
    /// Why it cannot be flown so, in words: more designs than seats, a design that does not fly in this air, a fleet that
    /// is dearer than the budget.
    pub fn with_fleet(self, mut fleet: Vec<Design>) -> Result<Self, Vec<Text>> {
        let Some(last) = fleet.last().cloned() else {
            return Ok(self);
        };
        if fleet.len() > self.vehicles {
            let (seats, designs) = (self.vehicles, fleet.len());
            return Err(vec![text!("fleet-many", seats = seats, designs = designs)]);
        }
        fleet.resize(self.vehicles, last);
        let mut faults = faults(&fleet, self.air());
        faults.extend(too_dear(&fleet, self.outlay.budget));
        if faults.is_empty() {
            Ok(self.flown_by(fleet))
        } else {
            Err(faults)
        }
    }

    /// The same flown with one design per seat, or with its own drones if there are none; nobody asks whether they may.
    pub(super) fn flown_by(self, fleet: Vec<Design>) -> Self {
        Self { fleet, ..self }
    }
}

/// What keeps designs on the ground, each told once.
fn faults(fleet: &[Design], air: Air) -> Vec<Text> {
    let is_new = |&seat: &usize| !fleet[..seat].contains(&fleet[seat]);
    let mut told = Vec::new();
    for design in (0..fleet.len()).filter(is_new).map(|seat| &fleet[seat]) {
        let found = design.findings(air).into_iter();
        let faults = found.filter(|finding| finding.severity == Severity::Fault);
        let name = design.name.as_str();
        told.extend(faults.map(|it| text!("fleet-fault", design = name, fault = &it.text)));
    }
    told
}

fn too_dear(fleet: &[Design], budget: Option<u32>) -> Option<Text> {
    let cost: u32 = fleet.iter().map(Design::credits).sum();
    let budget = budget.filter(|budget| cost > *budget)?;
    let over = cost - budget;
    Some(text!(
        "fleet-dear",
        cost = cost,
        budget = budget,
        over = over
    ))
}

#[cfg(test)]
mod tests;
