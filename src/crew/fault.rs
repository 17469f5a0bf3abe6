//! Why something is not possible in a crew.

use super::Proposal;
use crate::text;
use crate::text::Text;
use crate::vehicle_id::{VehicleId, ranges};

/// Why something is not possible in a crew.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum CrewFault {
    /// Nobody of this name is on the crew.
    Nobody(String),
    /// It is the own name.
    Oneself,
    /// This person's role does not fly vehicles.
    NoPilot(String),
    /// These vehicles have another pilot.
    NotYours(Vec<VehicleId>),
    /// These vehicles are flown by the one who asks already.
    YoursAlready(Vec<VehicleId>),
    /// The vehicles have several pilots, so one cannot answer.
    SeveralPilots,
    /// A vehicle that is not part of the session.
    NoVehicle,
    /// The one who proposes has as many open proposals as one may have.
    ManyProposals,
    /// Nothing waits for an answer.
    NothingProposed,
    /// These proposals wait for an answer, but not the one that is meant.
    OtherProposals(Vec<Proposal>),
    /// Several of these proposals may be meant.
    SeveralProposals(Vec<Proposal>),
    /// The vehicles have another pilot by now.
    Overtaken,
}

impl CrewFault {
    /// The reason in words.
    pub fn text(&self) -> Text {
        match self {
            Self::Nobody(name) => text!("crew-nobody", name = name),
            Self::Oneself => text!("crew-oneself"),
            Self::NoPilot(name) => text!("crew-no-pilot", name = name),
            Self::NotYours(vehicles) => {
                text!(
                    "crew-not-yours",
                    vehicles = ranges(vehicles.iter().copied())
                )
            }
            Self::YoursAlready(vehicles) => {
                text!("crew-yours", vehicles = ranges(vehicles.iter().copied()))
            }
            Self::SeveralPilots => text!("crew-several"),
            Self::NoVehicle => text!("crew-no-vehicle"),
            Self::ManyProposals => text!("crew-many-proposals"),
            Self::NothingProposed => text!("crew-nothing"),
            Self::OtherProposals(open) => {
                text!("crew-other-proposals", proposals = listed(open))
            }
            Self::SeveralProposals(open) => {
                let first = open.first().map(|it| ranges(it.vehicles.iter().copied()));
                text!(
                    "crew-several-proposals",
                    proposals = listed(open),
                    vehicles = first.unwrap_or_default()
                )
            }
            Self::Overtaken => text!("crew-overtaken"),
        }
    }
}

fn listed(proposals: &[Proposal]) -> Text {
    Text::joined("; ", proposals.iter().map(Proposal::listed).collect())
}
