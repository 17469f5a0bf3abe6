//! The pilot in command of each vehicle: the one person whose commands it gets.
//!
//! The user of a console flies all of its vehicles, unless another person is in command of some. Whoever commands, each
//! command says for whom ([`Order::by`](crate::commands::Order)), and those for anybody but the pilot in command are
//! refused. A change of the pilot in command stops nothing: the vehicle goes on with what it does.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

use serde::{Deserialize, Serialize};

use crate::text;
use crate::text::Text;
use crate::vehicle_id::VehicleId;
use crate::verb::CrewDuty;

/// A person other than the user of this console: an instructor, or a person on the crew.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(from = "WrittenPerson", into = "WrittenPerson")]
pub struct Person {
    name: String,
    is_instructor: bool,
}

/// A person as records have it.
#[derive(Serialize, Deserialize)]
#[serde(untagged)]
enum WrittenPerson {
    Crew(String),
    Instructor { instructor: String },
}

impl From<WrittenPerson> for Person {
    fn from(written: WrittenPerson) -> Self {
        match written {
            WrittenPerson::Crew(name) => Self::named(name),
            WrittenPerson::Instructor { instructor } => Self::instructor(instructor),
        }
    }
}

impl From<Person> for WrittenPerson {
    fn from(person: Person) -> Self {
        let Person {
            name,
            is_instructor,
        } = person;
        if is_instructor {
            Self::Instructor { instructor: name }
        } else {
            Self::Crew(name)
        }
    }
}

impl Person {
    /// A person on the crew, whose commands are judged.
    pub fn named(name: impl Into<String>) -> Self {
        Self {
            name: name.into(),
            is_instructor: false,
        }
    }

    /// An instructor, whose commands are not judged: the score is the trainee's.
    pub fn instructor(name: impl Into<String>) -> Self {
        Self {
            name: name.into(),
            is_instructor: true,
        }
    }

    /// The user name, as the ledger and the refusals show it.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// A line that a person has given, or the user of the console (`None`); that of a person begins with the name.
    pub fn said(by: Option<&Self>, line: Text) -> Text {
        match by {
            Some(person) => text!("ledger-by", person = person.name(), line = line),
            None => line,
        }
    }

    /// Whether it is an instructor.
    pub fn is_instructor(&self) -> bool {
        self.is_instructor
    }
}

impl fmt::Display for Person {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.name.fmt(f)
    }
}

/// Who flies each vehicle.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct PilotsInCommand {
    /// The vehicles that somebody else than usual flies; `None` for the user of the console.
    flown: BTreeMap<VehicleId, Option<Person>>,
    /// Who flies all others; `None` for the user of the console.
    usual: Option<Person>,
    /// The user of the console, as others know them; `None` if nobody needs to.
    user: Option<Person>,
    /// The persons of a crew who may give orders of a duty to every vehicle.
    on_duty: BTreeMap<Person, CrewDuty>,
}

impl PilotsInCommand {
    /// The vehicles of everybody else, while `host` flies all others.
    ///
    /// This is how a member of a crew sees the host's: the vehicles of `own` are those of the user of the console.
    pub fn seen_by(own: &Person, host: &Person, flown: &[(Person, Vec<VehicleId>)]) -> Self {
        let mut pilots = Self {
            usual: Some(host.clone()),
            ..Self::default()
        };
        for (person, vehicles) in flown {
            let pilot = (person != own).then(|| person.clone());
            let taken = vehicles.iter().map(|&vehicle| (vehicle, pilot.clone()));
            pilots.flown.extend(taken);
        }
        pilots
    }

    /// No vehicle is flown by anybody but the user of the console, whom others know by this name.
    pub fn of_user(user: Person) -> Self {
        Self {
            user: Some(user),
            ..Self::default()
        }
    }

    /// Makes a person the pilot in command of vehicles.
    pub fn take_over(&mut self, vehicles: &[VehicleId], person: &Person) {
        let taken = vehicles
            .iter()
            .map(|&vehicle| (vehicle, Some(person.clone())));
        self.flown.extend(taken);
    }

    /// Hands the vehicles of a person back to whoever flies them usually. Vehicles of others stay with them.
    pub fn hand_back(&mut self, vehicles: &[VehicleId], person: &Person) {
        self.flown
            .retain(|vehicle, pilot| pilot.as_ref() != Some(person) || !vehicles.contains(vehicle));
    }

    /// Lets a person give orders of a duty to every vehicle, whoever flies it.
    pub fn put_on_duty(&mut self, person: &Person, duty: CrewDuty) {
        self.on_duty.insert(person.clone(), duty);
    }

    /// Ends a person's duty.
    pub fn relieve(&mut self, person: &Person) {
        self.on_duty.remove(person);
    }

    /// The pilot in command of a vehicle; `None` if it is the user of the console.
    pub fn of(&self, vehicle: VehicleId) -> Option<&Person> {
        let flown = self.flown.get(&vehicle);
        flown.map_or(self.usual.as_ref(), Option::as_ref)
    }

    /// The vehicles that a person flies, by number, except for those that the person flies usually.
    pub fn flown_by(&self, person: &Person) -> Vec<VehicleId> {
        self.flown_by_one(Some(person))
    }

    /// At a member of a crew: the vehicles that the user of the console flies, by number. `None` at a console whose user
    /// flies everything that nobody else does.
    pub fn own(&self) -> Option<Vec<VehicleId>> {
        self.usual.as_ref().map(|_| self.flown_by_one(None))
    }

    fn flown_by_one(&self, person: Option<&Person>) -> Vec<VehicleId> {
        let flown = self.flown.iter();
        let theirs = flown.filter(|(_, pilot)| pilot.as_ref() == person);
        theirs.map(|(&vehicle, _)| vehicle).collect()
    }

    /// The others who fly something, each with the vehicles; without those that somebody flies usually.
    pub fn others(&self) -> BTreeMap<&Person, Vec<VehicleId>> {
        let mut others: BTreeMap<&Person, Vec<VehicleId>> = BTreeMap::new();
        for (&vehicle, pilot) in &self.flown {
            if let Some(pilot) = pilot {
                others.entry(pilot).or_default().push(vehicle);
            }
        }
        others
    }

    /// Whether several people fly vehicles, or one person flies those of another's console.
    pub fn are_several(&self) -> bool {
        self.usual.is_some() || self.flown.values().any(Option::is_some)
    }

    /// The names of all others who fly vehicles, in alphabetical order.
    pub fn names(&self) -> BTreeSet<&str> {
        let all = self.flown.values().flatten().chain(&self.usual);
        all.map(Person::name).collect()
    }

    /// Why a vehicle gets no command from a person, or from the user of the console (`None`); `None` if it does.
    pub fn refusal(&self, vehicle: VehicleId, by: Option<&Person>, duty: CrewDuty) -> Option<Text> {
        let is_on_duty = |person| self.on_duty.get(person) == Some(&duty);
        match (self.of(vehicle), by) {
            (pilot, by) if pilot == by => return None,
            (_, Some(by)) if is_on_duty(by) => return None,
            _ => {}
        }
        Some(match self.of(vehicle).or(self.user.as_ref()) {
            Some(pilot) => text!("pilot-other", pilot = pilot.name(), vehicle = vehicle),
            None => text!("pilot-user", vehicle = vehicle),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn records_tell_instructors_from_the_crew() {
        let people = [Person::named("anna"), Person::instructor("petro")];
        let written = serde_json::to_string(&people).expect("plain data");
        assert_eq!(written, r#"["anna",{"instructor":"petro"}]"#);
        let back: [Person; 2] = serde_json::from_str(&written).expect("what was written");
        assert_eq!(back, people);
    }

    #[test]
    fn a_vehicle_gets_commands_from_its_pilot_only() {
        let (petro, olena) = (Person::named("petro"), Person::named("olena"));
        let mut pilots = PilotsInCommand::default();
        assert_eq!(pilots.refusal(3, None, CrewDuty::Flying), None);
        let refused = pilots
            .refusal(3, Some(&petro), CrewDuty::Flying)
            .expect("it is refused");
        assert_eq!(refused.to_string(), "vehicle 3 is not taken over");
        pilots.take_over(&[3, 4], &petro);
        assert_eq!(pilots.refusal(3, Some(&petro), CrewDuty::Flying), None);
        for by in [None, Some(&olena)] {
            let refused = pilots
                .refusal(3, by, CrewDuty::Flying)
                .expect("it is refused");
            assert_eq!(refused.to_string(), "petro flies 3", "{by:?}");
        }
        assert_eq!(pilots.refusal(1, None, CrewDuty::Flying), None);
    }

    #[test]
    fn orders_of_a_duty_reach_every_vehicle() {
        let (olena, anna) = (Person::named("olena"), Person::named("anna"));
        let mut pilots = PilotsInCommand::default();
        pilots.take_over(&[1], &anna);
        pilots.put_on_duty(&olena, CrewDuty::Safety);
        for vehicle in [1, 2] {
            let refusal = |duty| pilots.refusal(vehicle, Some(&olena), duty);
            assert_eq!(refusal(CrewDuty::Safety), None);
            assert!(refusal(CrewDuty::Flying).is_some());
            assert!(refusal(CrewDuty::Sensors).is_some());
        }
        pilots.relieve(&olena);
        let refused = pilots.refusal(1, Some(&olena), CrewDuty::Safety);
        assert!(refused.is_some());
    }

    #[test]
    fn a_member_sees_the_own_vehicles_as_a_user_does() {
        let [anna, bohdan, olena] = ["anna", "bohdan", "olena"].map(Person::named);
        let flown = [(anna.clone(), vec![1, 2]), (olena.clone(), vec![4])];
        let seen = PilotsInCommand::seen_by(&anna, &bohdan, &flown);
        assert_eq!(
            [1, 2, 3, 4].map(|id| seen.of(id)),
            [None, None, Some(&bohdan), Some(&olena)]
        );
        assert_eq!(seen.own(), Some(vec![1, 2]));
        assert_eq!(PilotsInCommand::default().own(), None);
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
