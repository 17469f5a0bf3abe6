//! The choice of parts for each slot. Designs are TOML files that can be shared.

mod file;

use std::collections::BTreeMap;

use super::kind::DesignKind;
use super::part::{Battery, Esc, Frame, Motor, Part, PartSlot, Propeller, Radio, Spec};
use crate::sim::{Chassis as Steering, VehicleKind};
use crate::text::Text;

pub use file::DesignError;

/// The mass of wiring, connectors and mounts: a base in grams, and a share of the mass of all parts.
const WIRING_G: f64 = 60.0;
const WIRING_SHARE: f64 = 0.03;
const WIRING_CREDITS: u32 = 15;
/// The part that raises the antenna gain beyond the radio's own.
const RELAY: &str = "s_relay";
const RELAY_DBI: f64 = 6.0;
/// The power of receivers, lights and losses of any drone, in watts.
const OTHER_POWER_W: f64 = 1.0;

/// A choice of parts. It may be incomplete: [`super::DesignFinding`]s list the missing parts.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Design {
    pub name: String,
    slots: BTreeMap<PartSlot, Vec<&'static Part>>,
}

/// The parts that turn a battery's charge into thrust, if the design has all of them.
#[derive(Debug, Clone, Copy)]
pub(super) struct Drive<'a> {
    pub frame: &'a Frame,
    pub motor: &'a Motor,
    pub propeller: &'a Propeller,
    pub esc: &'a Esc,
    pub battery: &'a Battery,
    pub packs: u8,
}

impl Design {
    /// A design without any parts.
    pub fn new(name: impl Into<String>) -> Self {
        Self {
            name: name.into(),
            slots: BTreeMap::new(),
        }
    }

    /// The same design with another name.
    ///
    /// # Errors
    /// The name is empty, too long, or has more than one line.
    pub fn named(&self, name: &str) -> Result<Self, Text> {
        let name = name.trim();
        file::checked_name(name)?;
        Ok(Self {
            name: name.to_owned(),
            slots: self.slots.clone(),
        })
    }

    /// Whether the design has no parts.
    pub fn is_empty(&self) -> bool {
        self.slots.is_empty()
    }

    /// The parts in a slot.
    pub fn in_slot(&self, slot: PartSlot) -> &[&'static Part] {
        self.slots.get(&slot).map_or(&[], Vec::as_slice)
    }

    /// All parts, slot by slot, with the number of pieces of each.
    pub fn pieces(&self) -> impl Iterator<Item = (&'static Part, u32)> {
        let motors = u32::from(self.motors());
        self.slots.iter().flat_map(move |(slot, parts)| {
            let pieces = if slot.is_per_motor() { motors } else { 1 };
            parts.iter().map(move |part| (*part, pieces))
        })
    }

    /// Whether a part of this id is on board.
    pub fn has(&self, id: &str) -> bool {
        self.slots.values().flatten().any(|part| part.id == id)
    }

    /// This design with one more part. In a slot for one part it replaces the current one, and so
    /// does a battery of another kind. Any other part that is already on board is not added again,
    /// unless it is a load. A full slot takes no further part. A frame, chassis or hull removes the
    /// parts that only another kind of vehicle takes.
    #[must_use]
    pub fn with(&self, part: &'static Part) -> Self {
        let slot = part.slot();
        let mut changed = self.clone();
        let there = changed.slots.entry(slot).or_default();
        let replaces = match slot {
            PartSlot::Battery => there.iter().any(|other| other.id != part.id),
            PartSlot::Payload => false,
            PartSlot::Frame
            | PartSlot::Motor
            | PartSlot::Propeller
            | PartSlot::Esc
            | PartSlot::Autopilot
            | PartSlot::Navigation
            | PartSlot::Power
            | PartSlot::Radio => true,
        };
        if replaces {
            there.clear();
        }
        let is_twice = there.iter().any(|other| other.id == part.id);
        let may_repeat = slot == PartSlot::Battery || part.is_load();
        if there.len() < slot.room() && (may_repeat || !is_twice) {
            there.push(part);
        }
        if slot == PartSlot::Frame {
            changed.drop_unfit();
        }
        changed
    }

    /// Removes the parts that the design's kind of vehicle does not take.
    fn drop_unfit(&mut self) {
        let kind = self.kind();
        for parts in self.slots.values_mut() {
            parts.retain(|part| part.fits(kind));
        }
        self.slots.retain(|_, parts| !parts.is_empty());
    }

    /// This design with one piece of a part removed.
    #[must_use]
    pub fn without(&self, part: &Part) -> Self {
        let mut changed = self.clone();
        if let Some(there) = changed.slots.get_mut(&part.slot()) {
            if let Some(at) = there.iter().rposition(|other| other.id == part.id) {
                there.remove(at);
            }
            if there.is_empty() {
                changed.slots.remove(&part.slot());
            }
        }
        changed
    }

    /// The number of motors of the frame, chassis or hull; 0 without one.
    pub fn motors(&self) -> u8 {
        match self.spec(PartSlot::Frame) {
            Some(Spec::Frame(frame)) => frame.motors,
            Some(Spec::Chassis(chassis)) => chassis.motors,
            Some(Spec::Hull(hull)) => hull.motors,
            _ => 0,
        }
    }

    /// The kind of vehicle: that of the frame, chassis or hull, otherwise that of the other parts; a drone while no part
    /// says.
    pub fn kind(&self) -> DesignKind {
        let mut parts = self.slots.values().flatten();
        parts.find_map(|part| part.only_for()).unwrap_or_default()
    }

    /// What the design is in the simulators.
    pub fn vehicle_kind(&self) -> VehicleKind {
        match self.spec(PartSlot::Frame) {
            Some(Spec::Chassis(chassis)) => VehicleKind::Rover(chassis.steering),
            Some(Spec::Hull(_)) => VehicleKind::Rover(Steering::Boat),
            _ => VehicleKind::Copter,
        }
    }

    /// Mass ready to fly or drive, in kilograms.
    pub fn mass_kg(&self) -> f64 {
        let parts: f64 = self
            .pieces()
            .map(|(part, pieces)| part.mass_g * f64::from(pieces))
            .sum();
        (parts + WIRING_G) * (1.0 + WIRING_SHARE) * 1e-3
    }

    /// The price of all its parts, in credits.
    pub fn credits(&self) -> u32 {
        let parts: u32 = self
            .pieces()
            .map(|(part, pieces)| part.credits * pieces)
            .sum();
        parts + WIRING_CREDITS
    }

    /// The power of its electronics and sensors, in watts.
    pub fn electronics_w(&self) -> f64 {
        let parts: f64 = self.pieces().map(|(part, _)| part.power_w).sum();
        parts + OTHER_POWER_W
    }

    /// The properties of the first part in a slot; `None` if the slot is empty.
    pub(super) fn spec(&self, slot: PartSlot) -> Option<&'static Spec> {
        self.in_slot(slot).first().map(|part| &part.spec)
    }

    /// The number of the battery's cells in series; `None` without a battery.
    pub(super) fn cells(&self) -> Option<u8> {
        match self.spec(PartSlot::Battery)? {
            Spec::Battery(battery) => Some(battery.cells),
            _ => None,
        }
    }

    /// The gain of its antenna beyond that of its radio, in dBi: only a relay on board has a better antenna.
    pub fn antenna_gain_dbi(&self) -> f64 {
        if self.has(RELAY) { RELAY_DBI } else { 0.0 }
    }

    /// The drive; `None` if one of its slots is empty.
    pub(super) fn drive(&self) -> Option<Drive<'static>> {
        match (
            self.spec(PartSlot::Frame)?,
            self.spec(PartSlot::Motor)?,
            self.spec(PartSlot::Propeller)?,
            self.spec(PartSlot::Esc)?,
            self.spec(PartSlot::Battery)?,
        ) {
            (
                Spec::Frame(frame),
                Spec::Motor(motor),
                Spec::Propeller(propeller),
                Spec::Esc(esc),
                Spec::Battery(battery),
            ) => Some(Drive {
                frame,
                motor,
                propeller,
                esc,
                battery,
                packs: self.in_slot(PartSlot::Battery).len() as u8,
            }),
            _ => None,
        }
    }

    pub(super) fn radio(&self) -> Option<&'static Radio> {
        match self.spec(PartSlot::Radio)? {
            Spec::Radio(radio) => Some(radio),
            _ => None,
        }
    }
}
