//! Lines about a crew.

use crate::language::VehicleChoice;

/// A command about the crew.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum CrewLine {
    /// Show who is on the crew, with roles and vehicles.
    List,
    /// Offer own vehicles to somebody.
    Offer { vehicles: VehicleChoice, to: String },
    /// Ask for the vehicles of somebody.
    Ask { vehicles: VehicleChoice },
    /// Accept the newest proposal.
    Accept,
    /// Decline the newest proposal.
    Decline,
}
