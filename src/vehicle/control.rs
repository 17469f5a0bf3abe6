//! Operator control: the ground station that a vehicle obeys (`CONTROL_STATUS`).

use super::Vehicle;
use crate::text;
use crate::text::Text;
use crate::wire::SystemId;

/// The stations in control of a vehicle, as it announces them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ControlStatus {
    /// The system id of the station in control; `None` while every station may command the vehicle.
    pub owner: Option<SystemId>,
    /// Further stations whose commands the vehicle accepts; 0 where unused.
    pub others: [SystemId; 10],
    /// Whether another station may take control without asking.
    pub takeover: bool,
}

impl Vehicle {
    /// The station that keeps this console from commanding the vehicle, if there is one.
    pub fn barred_by(&self) -> Option<SystemId> {
        let control = self.control?;
        let owner = control.owner.filter(|owner| *owner != self.station)?;
        (!control.others.contains(&self.station)).then_some(owner)
    }

    /// Whether this console is in control of the vehicle.
    pub fn is_controlled_here(&self) -> bool {
        let owner = self.control.and_then(|control| control.owner);
        owner == Some(self.station)
    }

    /// The reason for a refusal to this console, and the line that asks for control.
    pub fn not_in_control(&self) -> Option<Text> {
        let owner = self.barred_by()?;
        let line = format!("{} control request", self.id);
        Some(text!("reason-not-in-control", station = owner, line = line))
    }
}
