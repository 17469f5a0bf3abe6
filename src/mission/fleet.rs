//! Missions flown with drones that the trainee built.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::Mission;
use super::fit::Fit;
use super::ground_truth::Load;
use super::radio::{Model, Radio, Set};
use super::sensor::Sensor;
use crate::sim::Airframe;
use crate::text;
use crate::text::Text;
use crate::workshop::{Air, Design, FindingSeverity, PartSlot};

/// Seconds of spray in a sprayer's tank.
pub(super) const TANK_S: u32 = 15;
/// The part that releases pieces.
pub(super) const DROPPER: &str = "s_drop";

impl Mission {
    /// The designs that fly the mission, one per seat; empty for the mission's own drones.
    pub fn fleet(&self) -> &[Design] {
        &self.seats.designs
    }

    /// The air in which the mission is flown. Battery packs are warm at launch.
    pub fn air(&self) -> Air {
        Air {
            altitude_m: self.site.origin.altitude_amsl_m,
            temperature_c: self.site.weather.temperature_c,
            ..Air::default()
        }
    }

    /// The same mission flown with built drones: one design for all drones, or one per drone, where
    /// the last one also fills the seats that follow. Ground robots and boats are the mission's own. Without any design, the mission's own drones
    /// fly it.
    ///
    /// # Errors
    /// A text for each fault: more designs than seats, a design that does not fly in this air, a
    /// fleet that costs more than the budget.
    pub fn with_fleet(self, mut fleet: Vec<Design>) -> Result<Self, Vec<Text>> {
        let Some(last) = fleet.last().cloned() else {
            return Ok(self);
        };
        let drones = self.seats.are_drones().filter(|it| *it).count();
        if fleet.len() > drones {
            let designs = fleet.len();
            return Err(vec![text!("fleet-many", seats = drones, designs = designs)]);
        }
        fleet.resize(drones, last.clone());
        let mut faults = faults(&fleet, self.air());
        faults.extend(too_dear(&fleet, self.seats.outlay.budget));
        if faults.is_empty() {
            let mut designs = fleet.into_iter();
            let of_seat = |is_drone| if is_drone { designs.next() } else { None };
            let all = self.seats.are_drones().map(of_seat);
            let all = all.map(|design| design.unwrap_or_else(|| last.clone()));
            let all = all.collect();
            Ok(self.flown_by(all))
        } else {
            Err(faults)
        }
    }

    /// The same mission with one design per seat, or with its own drones if `fleet` is empty; nothing is checked. The
    /// drones carry the equipment of their designs, and their radios set the range.
    pub(super) fn flown_by(mut self, fleet: Vec<Design>) -> Self {
        if fleet.is_empty() {
            return self;
        }
        let station = self.seats.pads.first().copied().unwrap_or_default();
        let radio = self.site.radio.get_or_insert(Radio {
            own: None,
            station,
            antenna_m: Radio::USUAL_ANTENNA_M,
        });
        let seats = fleet.iter().zip(&self.seats.asked);
        self.seats.fits = seats
            .zip(self.seats.are_drones())
            .map(|((design, asked), is_drone)| {
                if is_drone {
                    Fit::of(design, asked, radio.own)
                } else {
                    asked.clone()
                }
            })
            .collect();
        let mut all = Fit::default();
        let carried = self.seats.fits.iter().flat_map(|fit| &fit.sensors);
        carried.for_each(|sensor| all.add(sensor));
        self.seats.sensors = all.sensors;
        self.seats.designs = fleet;
        self
    }

    /// The airframes of the built drones, in the order of the seats; empty if the mission's own drones fly it.
    pub(crate) fn airframes(&self) -> Vec<Arc<Airframe>> {
        let mut airframes: Vec<Arc<Airframe>> = Vec::new();
        for (seat, design) in self.seats.designs.iter().enumerate() {
            let alike = self.seats.designs[..seat]
                .iter()
                .position(|it| it == design);
            airframes.push(match alike {
                Some(first) => Arc::clone(&airframes[first]),
                None => airframe(design),
            });
        }
        airframes
    }
}

impl Fit {
    /// The equipment of a design: the sensors that the mission requires come first. `own` is the radio of the mission's
    /// drones.
    fn of(design: &Design, asked: &Self, own: Option<Set>) -> Self {
        let mut fit = Self {
            loads: loads(design),
            radio: radio(design, own),
            ..Self::default()
        };
        let mounted = design
            .in_slot(PartSlot::Payload)
            .iter()
            .filter_map(|part| Sensor::by_id(part.id));
        let wanted = asked.sensors.iter().copied();
        wanted
            .filter(|sensor| design.has(sensor.id))
            .chain(mounted)
            .for_each(|sensor| fit.add(sensor));
        fit
    }
}

/// The loads of a design. Loads counted in pieces need a dropper.
fn loads(design: &Design) -> BTreeMap<Load, u32> {
    let mounted = design.in_slot(PartSlot::Payload);
    let pieces = |load: Load| {
        let count = mounted.iter().filter(|part| part.id == load.part()).count();
        match load {
            Load::Spray => count as u32 * TANK_S,
            _ if design.has(DROPPER) => count as u32,
            Load::Ball | Load::Kit | Load::Node => 0,
        }
    };
    let counted = Load::ALL.map(|load| (load, pieces(load)));
    counted
        .into_iter()
        .filter(|(_, count)| *count > 0)
        .collect()
}

/// The radio of a design. A radio model that relays in the mission relays on every drone.
fn radio(design: &Design, own: Option<Set>) -> Option<Set> {
    let part = design.in_slot(PartSlot::Radio).first()?;
    let set = Set::of(Model::of(part)?);
    let relays = own.is_some_and(|own| own.model.id == part.id && own.relays);
    Some(Set {
        gain_dbi: set.gain_dbi + design.antenna_gain_dbi(),
        relays: set.relays || relays,
        ..set
    })
}

/// A design as the simulator flies it: with its parameters.
fn airframe(design: &Design) -> Arc<Airframe> {
    let built = design.airframe().and_then(|built| {
        let (airframe, _) = Airframe::from_json(&built.frame.to_string()).ok()?;
        Some(airframe.with_parameters(built.parameters))
    });
    // Designs without a drive were refused earlier.
    built.map_or_else(Airframe::shared_standard, Arc::new)
}

/// The reasons why designs cannot fly, each once.
fn faults(fleet: &[Design], air: Air) -> Vec<Text> {
    let is_new = |&seat: &usize| !fleet[..seat].contains(&fleet[seat]);
    let mut told = Vec::new();
    for design in (0..fleet.len()).filter(is_new).map(|seat| &fleet[seat]) {
        let found = design.findings(air).into_iter();
        let faults = found.filter(|finding| finding.severity() == FindingSeverity::Fault);
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
