//! Missions flown with vehicles that the trainee built.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::Mission;
use super::fit::{DROPPER, FLAIL, Fit, TANK_S};
use super::ground_truth::Load;
use super::radio::{Model, Radio, Set};
use super::sensor::Sensor;
use crate::sim::{Airframe, VehicleKind};
use crate::text;
use crate::text::Text;
use crate::workshop::{self, Air, Design, DesignKind, FindingSeverity, PartSlot};

/// The designs of a fleet, dealt to seats of these kinds: each seat takes the next design of its kind, and the last one
/// also fills the seats of the kind that follow. A seat without a design of its kind has the mission's own vehicle.
pub fn dealt<'a>(seats: &[DesignKind], fleet: &'a [Design]) -> Vec<Option<&'a Design>> {
    let nth = |seat: usize| {
        seats[..seat]
            .iter()
            .filter(|it| **it == seats[seat])
            .count()
    };
    let of_seat = |seat: usize| {
        let mut alike = fleet.iter().filter(|it| it.kind() == seats[seat]);
        let own = alike.clone().nth(nth(seat));
        own.or_else(|| alike.next_back())
    };
    (0..seats.len()).map(of_seat).collect()
}

impl Mission {
    /// The designs that fly the mission, in the order of their seats; empty for the mission's own vehicles.
    pub fn fleet(&self) -> &[Design] {
        &self.seats.designs
    }

    /// The design of each seat; `None` for the mission's own vehicle.
    pub fn designs(&self) -> Vec<Option<&Design>> {
        dealt(&self.seat_kinds(), &self.seats.designs)
    }

    /// The kind of design that each seat takes.
    pub fn seat_kinds(&self) -> Vec<DesignKind> {
        let kinds = self.seats.kinds.iter();
        kinds.map(|kind| DesignKind::of(*kind)).collect()
    }

    /// The air in which the mission is flown. Battery packs are warm at launch.
    pub fn air(&self) -> Air {
        Air {
            altitude_m: self.site.origin.altitude_amsl_m,
            temperature_c: self.site.weather.temperature_c,
            ..Air::default()
        }
    }

    /// The same mission flown with built vehicles. Each seat takes the next design of its kind, and the last one also
    /// fills the seats of the kind that follow. Seats of kinds without a design keep the mission's own vehicles.
    ///
    /// # Errors
    /// A text for each fault: a design of a kind that no seat takes, more designs than seats, a design that does not fly
    /// or drive in this air, a fleet that costs more than the budget.
    pub fn with_fleet(self, fleet: Vec<Design>) -> Result<Self, Vec<Text>> {
        let unseated = self.unseated(&fleet);
        if !unseated.is_empty() {
            return Err(unseated);
        }
        let seated: Vec<Design> = dealt(&self.seat_kinds(), &fleet)
            .into_iter()
            .flatten()
            .cloned()
            .collect();
        let mut faults = faults(&seated, self.air());
        faults.extend(too_dear(&seated, self.seats.outlay.budget));
        if faults.is_empty() {
            Ok(self.flown_by(fleet))
        } else {
            Err(faults)
        }
    }

    /// Why the mission has no seats for some designs.
    fn unseated(&self, fleet: &[Design]) -> Vec<Text> {
        let seats = self.seat_kinds();
        let of_kind = |kind| {
            let designs: Vec<&Design> = fleet.iter().filter(|it| it.kind() == kind).collect();
            let room = seats.iter().filter(|it| **it == kind).count();
            let design = designs.first()?;
            if room == 0 {
                let mut taken = seats.clone();
                taken.sort_unstable();
                taken.dedup();
                let taken = taken.into_iter().map(DesignKind::name).collect();
                return Some(text!(
                    "fleet-kind",
                    design = design.name.as_str(),
                    kind = kind.name(),
                    kinds = Text::joined(", ", taken)
                ));
            }
            let count = designs.len();
            (count > room).then(|| {
                text!(
                    "fleet-many",
                    kind = kind.id(),
                    seats = room,
                    designs = count
                )
            })
        };
        DesignKind::ALL.into_iter().filter_map(of_kind).collect()
    }

    /// The same mission with these designs in their seats, or with its own vehicles if `fleet` is empty; nothing is
    /// checked. The vehicles carry the equipment of their designs, and their radios set the range.
    pub(super) fn flown_by(mut self, fleet: Vec<Design>) -> Self {
        self.seats.designs = fleet;
        let seated = self.designs();
        self.seats.designs = seated.iter().copied().flatten().cloned().collect();
        if self.seats.designs.is_empty() {
            return self;
        }
        let station = self.seats.pads.first().copied().unwrap_or_default();
        let radio = self.site.radio.get_or_insert(Radio {
            own: None,
            station,
            antenna_m: Radio::USUAL_ANTENNA_M,
        });
        let own = radio.own;
        let designs = self.designs();
        let seats = designs.iter().zip(&self.seats.asked);
        let fits: Vec<Fit> = seats
            .map(|(design, asked)| match design {
                Some(design) => Fit::of(design, asked, own),
                None => asked.clone(),
            })
            .collect();
        self.seats.fits = fits;
        let mut all = Fit::default();
        let carried = self.seats.fits.iter().flat_map(|fit| &fit.sensors);
        carried.for_each(|sensor| all.add(sensor));
        self.seats.sensors = all.sensors;
        self
    }

    /// The kind of each vehicle in the simulator: that of its design, otherwise that of the mission.
    pub(super) fn vehicle_kinds(&self) -> Vec<VehicleKind> {
        let seats = self.designs().into_iter().zip(&self.seats.kinds);
        seats
            .map(|(design, own)| design.map_or(*own, Design::vehicle_kind))
            .collect()
    }

    /// The airframes of the vehicles, in the order of the seats; empty if the mission's own ones fly it.
    pub(crate) fn airframes(&self) -> Vec<Arc<Airframe>> {
        if self.seats.designs.is_empty() {
            return Vec::new();
        }
        let designs = self.designs();
        let mut airframes: Vec<Arc<Airframe>> = Vec::new();
        for (seat, design) in designs.iter().enumerate() {
            let alike = designs[..seat].iter().position(|it| it == design);
            airframes.push(match (alike, design) {
                (Some(first), _) => Arc::clone(&airframes[first]),
                (None, Some(design)) => airframe(design),
                (None, None) => Airframe::shared_standard(),
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
            flail: design.has(FLAIL),
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

/// A design as the simulator flies or drives it: with its parameters.
fn airframe(design: &Design) -> Arc<Airframe> {
    let built = design.airframe().and_then(workshop::Airframe::simulated);
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
