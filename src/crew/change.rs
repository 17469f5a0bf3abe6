//! What changes in a crew, as the journal keeps it.

use serde::{Deserialize, Serialize};

use super::Role;
use crate::pilot_in_command::{Person, PilotsInCommand};
use crate::text;
use crate::text::Text;
use crate::vehicle_id::{VehicleId, VehicleIds, ranges};

/// A change in a crew.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum CrewChange {
    /// A flight began with a crew that was there already.
    Began,
    /// A member has joined, with this role, and flies the vehicles of a post from now on.
    Joined {
        who: Person,
        role: Role,
        #[serde(default, skip_serializing_if = "Vec::is_empty")]
        vehicles: Vec<VehicleId>,
    },
    /// A member is not there any more; the vehicles went back to the host.
    Left {
        who: Person,
        vehicles: Vec<VehicleId>,
        #[serde(default)]
        why: Departure,
    },
    /// Vehicles have got another pilot, with the consent of both.
    HandedOver {
        vehicles: Vec<VehicleId>,
        from: Person,
        to: Person,
    },
}

/// Why a member is not on the crew any more.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Departure {
    /// The member's user has left the crew.
    #[default]
    Left,
    /// The connection has ended without a word: it broke, or the member's console was killed.
    Lost,
    /// The connection is there, but nothing was heard for too long.
    Silent,
}

/// A change in a crew, with the pilots of all vehicles after it.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct CrewRecord {
    pub change: CrewChange,
    /// Everybody except for the host who flies something.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub flown: Vec<Flown>,
}

impl CrewRecord {
    /// The pilots of all vehicles, for the host.
    pub fn pilots(&self) -> PilotsInCommand {
        let mut pilots = PilotsInCommand::default();
        for flown in &self.flown {
            let vehicles: Vec<VehicleId> = flown.vehicles.iter().collect();
            pilots.take_over(&vehicles, &flown.by);
        }
        pilots
    }
}

/// Two people on a crew: one looks at the flight of the other. Each sees the own commands without a name.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CrewViewpoint {
    /// The member who looks.
    pub own: Person,
    pub host: Person,
}

impl CrewViewpoint {
    /// Who gave a command of the host's record; `None` if it was the member.
    pub fn by(&self, recorded: Option<&Person>) -> Option<Person> {
        let by = recorded.unwrap_or(&self.host);
        (*by != self.own).then(|| by.clone())
    }

    /// The pilots of all vehicles before anybody has got one.
    pub fn begun(&self) -> PilotsInCommand {
        PilotsInCommand::seen_by(&self.own, &self.host, &[])
    }

    /// The pilots of all vehicles.
    pub fn pilots(&self, line: &CrewRecord) -> PilotsInCommand {
        let flown = line.flown.iter();
        let flown: Vec<_> = flown
            .map(|it| (it.by.clone(), it.vehicles.iter().collect()))
            .collect();
        PilotsInCommand::seen_by(&self.own, &self.host, &flown)
    }
}

/// The vehicles of one pilot.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Flown {
    pub by: Person,
    pub vehicles: VehicleIds,
}

impl Flown {
    /// Everybody who flies something, except for the user of the console.
    pub fn all(pilots: &PilotsInCommand) -> Vec<Self> {
        let others = pilots.others().into_iter();
        let flown = others.map(|(by, vehicles)| Self {
            by: by.clone(),
            vehicles: vehicles.into(),
        });
        flown.collect()
    }
}

impl CrewChange {
    /// The change in words, for the host or for a member who looks; `None` if there is nothing to say.
    pub fn text(&self, viewpoint: Option<&CrewViewpoint>) -> Option<Text> {
        match self {
            Self::Began => None,
            Self::Joined {
                who,
                role,
                vehicles,
            } => {
                let (who, role) = (who.name(), role.text());
                Some(if vehicles.is_empty() {
                    text!("crew-joined", who = who, role = role)
                } else {
                    let vehicles = ranges(vehicles.iter().copied());
                    text!(
                        "crew-joined-vehicles",
                        who = who,
                        role = role,
                        vehicles = vehicles
                    )
                })
            }
            Self::Left { who, vehicles, why } => {
                let left = why.text(who);
                let flown = (!vehicles.is_empty()).then(|| now_flown(vehicles, viewpoint));
                let parts = std::iter::once(left).chain(flown).collect();
                Some(Text::joined(": ", parts))
            }
            Self::HandedOver { vehicles, from, to } => Some(text!(
                "crew-handed-over",
                from = from.name(),
                to = to.name(),
                vehicles = ranges(vehicles.iter().copied())
            )),
        }
    }
}

/// Who flies vehicles that went back to the host.
fn now_flown(vehicles: &[VehicleId], viewpoint: Option<&CrewViewpoint>) -> Text {
    let vehicles = ranges(vehicles.iter().copied());
    match viewpoint {
        Some(CrewViewpoint { host, .. }) => {
            text!("crew-host-flies", host = host.name(), vehicles = vehicles)
        }
        None => text!("crew-you-fly", vehicles = vehicles),
    }
}

impl Departure {
    fn text(self, who: &Person) -> Text {
        match self {
            Self::Left => text!("crew-left", who = who.name()),
            Self::Lost => text!("crew-left-lost", who = who.name()),
            Self::Silent => text!("crew-left-silent", who = who.name()),
        }
    }
}

impl Role {
    /// The role in a word.
    pub fn text(self) -> Text {
        match self {
            Self::Pilot => text!("crew-role-pilot"),
            Self::Sensors => text!("crew-role-sensors"),
            Self::Safety => text!("crew-role-safety"),
            Self::Observer => text!("crew-role-observer"),
        }
    }
}
