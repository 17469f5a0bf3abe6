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
    /// Let the vehicles of a proposal change hands.
    Accept(ProposalLine),
    /// Answer a proposal with no; its vehicles stay where they are.
    Decline(ProposalLine),
}

/// The proposal that a line answers; without any word about it, the only one.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ProposalLine {
    /// Its vehicles; `None` if they are not named.
    pub vehicles: Option<VehicleChoice>,
    /// Who has made it; `None` if the person is not named.
    pub from: Option<String>,
}
