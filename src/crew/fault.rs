//! Why something is not possible in a crew.

use crate::text;
use crate::text::Text;
use crate::vehicle_id::{VehicleId, ranges};

/// Why something is not possible in a crew.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum CrewFault {
    /// No more members fit.
    Full,
    /// The user has as many places as one may have.
    ManyOfUser,
    /// The connection has a member already.
    JoinedTwice,
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
    /// Nothing waits for an answer.
    NothingProposed,
    /// The vehicles have another pilot by now.
    Overtaken,
}

impl CrewFault {
    /// The reason in words.
    pub fn text(&self) -> Text {
        match self {
            Self::Full => text!("crew-full"),
            Self::ManyOfUser => text!("crew-full-user"),
            Self::JoinedTwice => text!("crew-joined-twice"),
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
            Self::NothingProposed => text!("crew-nothing"),
            Self::Overtaken => text!("crew-overtaken"),
        }
    }
}
