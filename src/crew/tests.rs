//! The roles, the lines between host and members, and what holds whatever happens.

use proptest::prelude::*;

use super::protocol::{Confirmed, HostMessage, MemberMessage, SaidLine};
use super::*;
use crate::class::protocol::{line, read};
use crate::language::verb;

mod handover;
mod members;

const NOW: Duration = Duration::from_secs(100);
const VEHICLES: [VehicleId; 4] = [1, 2, 3, 4];

/// A crew in flight.
struct Flying {
    crew: Crew,
    pilots: PilotsInCommand,
    now: Duration,
}

impl Flying {
    fn new(posts: Vec<Post>) -> Self {
        let mut crew = Crew::new("alpha", Person::named("bohdan"));
        let mut pilots = PilotsInCommand::default();
        crew.begin(posts, &mut pilots, NOW);
        let now = NOW;
        Self { crew, pilots, now }
    }

    fn join(
        &mut self,
        number: u64,
        user: &str,
        role: Option<Role>,
    ) -> Result<CrewChange, CrewDenial> {
        let joining = Joining {
            connection: ConnectionId(number),
            user,
            role,
        };
        self.crew.join(joining, &mut self.pilots, self.now)
    }

    fn act(&mut self, who: &str, deed: &CrewDeed) -> Result<DeedOutcome, CrewFault> {
        let mut scene = CrewScene {
            vehicles: &VEHICLES,
            pilots: &mut self.pilots,
            now: self.now,
        };
        self.crew.act(&Person::named(who), deed, &mut scene)
    }

    fn leave(&mut self, number: u64) -> Option<CrewChange> {
        self.crew.leave(
            ConnectionId(number),
            Departure::Left,
            &mut self.pilots,
            self.now,
        )
    }

    fn pilot(&self, vehicle: VehicleId) -> &str {
        self.crew.pilot(vehicle, &self.pilots).name()
    }
}

fn offer(vehicle: VehicleId, to: &str) -> CrewDeed {
    CrewDeed::Offer {
        vehicles: vec![vehicle],
        to: to.to_owned(),
    }
}

/// Accepts the only proposal.
fn accept() -> CrewDeed {
    CrewDeed::Accept(ProposalChoice::default())
}

/// Declines the only proposal.
fn decline() -> CrewDeed {
    CrewDeed::Decline(ProposalChoice::default())
}

fn ask(vehicles: &[VehicleId]) -> CrewDeed {
    CrewDeed::Ask {
        vehicles: vehicles.to_vec(),
    }
}

fn post(role: Role, vehicles: &[VehicleId]) -> Post {
    Post {
        role,
        vehicles: vehicles.to_vec(),
    }
}

#[test]
fn who_says_nothing_for_ten_seconds_is_silent() {
    let mut flying = Flying::new(Vec::new());
    flying.join(1, "anna", None).expect("there is room");
    let later = NOW + Duration::from_secs(9);
    assert!(flying.crew.silent(later).is_empty());
    flying.crew.hear(ConnectionId(1), later);
    assert!(flying.crew.silent(NOW + Duration::from_secs(18)).is_empty());
    let silent = flying.crew.silent(NOW + Duration::from_secs(19));
    assert_eq!(silent, [ConnectionId(1)]);
}

#[test]
fn each_role_has_its_verbs() {
    let open = |role: Role, name: &str| role.may_say(verb(name).expect("a verb"));
    for (name, [pilot, sensors, safety]) in [
        ("goto", [true, false, false]),
        ("param", [true, false, false]),
        ("mark", [true, true, false]),
        ("spray", [true, true, false]),
        ("roi", [true, true, false]),
        ("hint", [true, true, false]),
        ("predict", [false, false, false]),
        ("rtl", [true, false, true]),
        ("hold", [true, false, true]),
        ("kill", [true, false, true]),
        ("arm", [true, false, false]),
    ] {
        assert_eq!(open(Role::Pilot, name), pilot, "{name}");
        assert_eq!(open(Role::Sensors, name), sensors, "{name}");
        assert_eq!(open(Role::Safety, name), safety, "{name}");
        assert!(!open(Role::Observer, name), "{name}");
    }
}

#[test]
fn lines_between_host_and_members_are_short_and_have_no_control_characters() {
    let said = |text: &str| SaidLine::try_from(text.to_owned());
    let line_of = line(&MemberMessage::Say {
        id: 7,
        line: said("3 takeoff 20").expect("a command"),
        confirmed: Confirmed::Nothing,
        given_ms: Some(81_000),
    });
    let expected = "{\"say\":{\"id\":7,\"line\":\"3 takeoff 20\",\"confirmed\":\"nothing\",\"given_ms\":81000}}\n";
    assert_eq!(line_of, expected);
    assert!(said(&"x".repeat(1001)).is_err());
    assert!(said("3 land\n1 kill").is_err());
    let long = format!(
        "{{\"say\":{{\"id\":7,\"line\":\"{}\",\"confirmed\":\"nothing\"}}}}",
        "x".repeat(2000)
    );
    assert!(read::<MemberMessage>(long.as_bytes()).is_err());
    // Nothing leads out of the folder of copies.
    let record = |name: &str| read::<HostMessage>(format!("{{\"record\":\"{name}\"}}").as_bytes());
    assert!(record("2026-11-27_06_1").is_ok());
    for name in ["../a", "/etc/a", ".a", "a/b", ""] {
        assert!(record(name).is_err(), "{name}");
    }
}

/// Something that happens to a crew.
#[derive(Debug, Clone)]
enum Step {
    Join(u64, Option<Role>),
    Leave(u64),
    Act(usize, CrewDeed),
    Begin(bool),
    Later(u64),
}

fn deed() -> impl Strategy<Value = CrewDeed> {
    let names = prop::sample::select(vec!["bohdan", "anna", "anna#2", "anna#3"]);
    let vehicles = prop::collection::vec(0..6u16, 0..3);
    prop_oneof![
        (vehicles.clone(), names).prop_map(|(vehicles, to)| CrewDeed::Offer {
            vehicles,
            to: to.to_owned(),
        }),
        vehicles.prop_map(|vehicles| CrewDeed::Ask { vehicles }),
        Just(accept()),
        Just(accept()),
        Just(decline()),
    ]
}

fn step() -> impl Strategy<Value = Step> {
    let role = prop::option::of(prop::sample::select(Role::ALL.to_vec()));
    prop_oneof![
        (0..4u64, role).prop_map(|(number, role)| Step::Join(number, role)),
        (0..4u64).prop_map(Step::Leave),
        (0..4usize, deed()).prop_map(|(who, deed)| Step::Act(who, deed)),
        (0..4usize, deed()).prop_map(|(who, deed)| Step::Act(who, deed)),
        any::<bool>().prop_map(Step::Begin),
        (1..40u64).prop_map(Step::Later),
    ]
}

proptest! {
    #[test]
    fn every_vehicle_always_has_one_pilot_who_is_here(steps in prop::collection::vec(step(), 0..60)) {
        let mut flying = Flying::new(Vec::new());
        for step in steps {
            match step {
                Step::Join(number, role) => drop(flying.join(number, "anna", role)),
                Step::Leave(number) => drop(flying.leave(number)),
                Step::Act(who, deed) => {
                    let names = ["bohdan", "anna", "anna#2", "anna#3"];
                    drop(flying.act(names[who], &deed));
                }
                Step::Begin(has_posts) => {
                    let posts = vec![post(Role::Pilot, &[1, 2]), post(Role::Safety, &[])];
                    let posts = if has_posts { posts } else { Vec::new() };
                    flying.crew.begin(posts, &mut flying.pilots, flying.now);
                }
                Step::Later(seconds) => {
                    flying.now += Duration::from_secs(seconds);
                    drop(flying.crew.settle(&flying.pilots, flying.now));
                }
            }
            for vehicle in VEHICLES {
                let pilot = flying.pilot(vehicle);
                let is_host = pilot == "bohdan";
                let mut members = flying.crew.members();
                let is_pilot = members.any(|it| it.person.name() == pilot && it.role == Role::Pilot);
                prop_assert!(is_host || is_pilot, "{} flies {}", pilot, vehicle);
                let accepted = |by: &str| {
                    let by = Person::named(by);
                    let by = (by != *flying.crew.host()).then_some(&by);
                    flying.pilots.refusal(vehicle, by, CrewDuty::Flying).is_none()
                };
                let names = flying.crew.members().map(|it| it.person.name().to_owned());
                let everybody: Vec<_> = std::iter::once("bohdan".to_owned()).chain(names).collect();
                let pilots = everybody.iter().filter(|name| accepted(name)).count();
                prop_assert_eq!(pilots, 1, "of vehicle {}", vehicle);
            }
        }
    }
}
