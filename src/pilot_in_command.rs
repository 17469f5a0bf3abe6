//! The pilot in command of each vehicle: the one person whose commands it gets.
//!
//! The user of a console flies all of its vehicles, unless another person is in command of some. Whoever commands, each
//! command says for whom ([`Order::by`](crate::commands::Order)), and those for anybody but the pilot in command are
//! refused. A change of the pilot in command stops nothing: the vehicle goes on with what it does.

use std::collections::BTreeMap;
use std::fmt;

use serde::{Deserialize, Serialize};

use crate::text;
use crate::text::Text;
use crate::vehicle_id::VehicleId;

/// A person other than the user of this console, by name.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Person(String);

impl Person {
    /// A person with this name.
    pub fn named(name: impl Into<String>) -> Self {
        Self(name.into())
    }

    /// The user name, as the ledger and the refusals show it.
    pub fn name(&self) -> &str {
        &self.0
    }
}

impl fmt::Display for Person {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

/// The vehicles that other persons fly.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct PilotsInCommand(BTreeMap<VehicleId, Person>);

impl PilotsInCommand {
    /// Makes a person the pilot in command of vehicles.
    pub fn take_over(&mut self, vehicles: &[VehicleId], person: &Person) {
        let taken = vehicles.iter().map(|&vehicle| (vehicle, person.clone()));
        self.0.extend(taken);
    }

    /// Hands the vehicles of a person back to the user of the console. Vehicles of others stay with them.
    pub fn hand_back(&mut self, vehicles: &[VehicleId], person: &Person) {
        self.0
            .retain(|vehicle, pilot| pilot != person || !vehicles.contains(vehicle));
    }

    /// The pilot in command of a vehicle; `None` if it is the user of the console.
    pub fn of(&self, vehicle: VehicleId) -> Option<&Person> {
        self.0.get(&vehicle)
    }

    /// The vehicles that a person flies, by number.
    pub fn flown_by(&self, person: &Person) -> Vec<VehicleId> {
        let own = self.0.iter().filter(|(_, pilot)| *pilot == person);
        own.map(|(&vehicle, _)| vehicle).collect()
    }

    /// The others who fly something, each with the vehicles.
    pub fn others(&self) -> BTreeMap<&Person, Vec<VehicleId>> {
        let mut others: BTreeMap<&Person, Vec<VehicleId>> = BTreeMap::new();
        for (&vehicle, pilot) in &self.0 {
            others.entry(pilot).or_default().push(vehicle);
        }
        others
    }

    /// Why a vehicle gets no command from a person, or from the user of the console (`None`); `None` if it does.
    pub fn refusal(&self, vehicle: VehicleId, by: Option<&Person>) -> Option<Text> {
        match (self.of(vehicle), by) {
            (pilot, by) if pilot == by => None,
            (Some(pilot), _) => Some(text!(
                "pilot-other",
                pilot = pilot.name(),
                vehicle = vehicle
            )),
            (None, _) => Some(text!("pilot-user", vehicle = vehicle)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_vehicle_gets_commands_from_its_pilot_only() {
        let (petro, olena) = (Person::named("petro"), Person::named("olena"));
        let mut pilots = PilotsInCommand::default();
        assert_eq!(pilots.refusal(3, None), None);
        let refused = pilots.refusal(3, Some(&petro)).expect("it is refused");
        assert_eq!(refused.to_string(), "vehicle 3 is not taken over");
        pilots.take_over(&[3, 4], &petro);
        assert_eq!(pilots.refusal(3, Some(&petro)), None);
        for by in [None, Some(&olena)] {
            let refused = pilots.refusal(3, by).expect("it is refused");
            assert_eq!(refused.to_string(), "petro flies 3", "{by:?}");
        }
        assert_eq!(pilots.refusal(1, None), None);
    }

    #[test]
    fn a_person_hands_back_only_what_that_person_flies() {
        let (petro, olena) = (Person::named("petro"), Person::named("olena"));
        let mut pilots = PilotsInCommand::default();
        pilots.take_over(&[1, 2, 3], &petro);
        pilots.take_over(&[3], &olena);
        assert_eq!(pilots.of(3), Some(&olena), "the last one flies it");
        pilots.hand_back(&[2, 3, 9], &petro);
        assert_eq!(pilots.flown_by(&petro), [1]);
        assert_eq!(pilots.of(3), Some(&olena));
        let others: Vec<_> = pilots.others().into_iter().collect();
        assert_eq!(others, [(&olena, vec![3]), (&petro, vec![1])]);
    }
}
