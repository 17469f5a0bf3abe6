use proptest::prelude::*;

use super::protocol::{Confirmed, HostMessage, MemberMessage, SaidLine};
use super::*;
use crate::class::protocol::{line, read};
use crate::language::verb;

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
        crew.begin(posts, &mut pilots);
        let now = NOW;
        Self { crew, pilots, now }
    }

    fn join(
        &mut self,
        number: u64,
        user: &str,
        role: Option<Role>,
    ) -> Result<CrewChange, CrewFault> {
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
        self.crew.leave(ConnectionId(number), &mut self.pilots)
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
fn members_of_one_user_have_names_of_their_own() {
    let mut flying = Flying::new(Vec::new());
    for (number, user) in [(1, "anna"), (2, "anna"), (3, "bohdan"), (4, "anna")] {
        flying.join(number, user, None).expect("there is room");
    }
    let names = flying.crew.members().map(|it| it.person.name().to_owned());
    let names: Vec<_> = names.collect();
    assert_eq!(names, ["anna", "anna#2", "bohdan#2", "anna#3"]);
    assert_eq!(flying.join(1, "petro", None), Err(CrewFault::JoinedTwice));
}

#[test]
fn one_user_does_not_take_all_places() {
    let mut flying = Flying::new(Vec::new());
    for number in 0..4 {
        flying.join(number, "anna", None).expect("there is room");
    }
    assert_eq!(flying.join(4, "anna", None), Err(CrewFault::ManyOfUser));
    flying.join(4, "petro", None).expect("there is room");
    // The host's own user does no harm to others.
    for number in 5..10 {
        flying.join(number, "bohdan", None).expect("there is room");
    }
}

#[test]
fn the_role_of_a_post_ends_with_its_mission() {
    let mut flying = Flying::new(vec![post(Role::Safety, &[]), post(Role::Sensors, &[])]);
    flying.join(1, "anna", None).expect("there is room");
    let wanted = Some(Role::Sensors);
    flying.join(2, "olena", wanted).expect("there is room");
    flying.crew.begin(Vec::new(), &mut flying.pilots);
    let roles: Vec<_> = flying.crew.members().map(|it| it.role).collect();
    assert_eq!(roles, [Role::Pilot, Role::Sensors]);
    let refusal = |by, duty| flying.pilots.refusal(1, Some(&Person::named(by)), duty);
    assert!(refusal("anna", CrewDuty::Safety).is_some());
    assert!(refusal("olena", CrewDuty::Sensors).is_none());
}

#[test]
fn posts_of_the_mission_give_roles_and_vehicles() {
    let mut flying = Flying::new(vec![
        post(Role::Pilot, &[1, 2]),
        post(Role::Safety, &[]),
        post(Role::Pilot, &[3]),
    ]);
    flying.join(1, "anna", None).expect("there is room");
    flying
        .join(2, "olena", Some(Role::Pilot))
        .expect("there is room");
    flying.join(3, "petro", None).expect("there is room");
    flying.join(4, "iryna", None).expect("there is room");
    let roles: Vec<_> = flying.crew.members().map(|it| it.role).collect();
    assert_eq!(roles, [Role::Pilot, Role::Pilot, Role::Safety, Role::Pilot]);
    let pilots = VEHICLES.map(|id| flying.pilot(id).to_owned());
    assert_eq!(pilots, ["anna", "anna", "olena", "bohdan"]);
    // Who leaves makes the place free.
    let left = flying.leave(1).expect("a member");
    let CrewChange::Left { vehicles, .. } = left else {
        panic!("{left:?}");
    };
    assert_eq!(vehicles, [1, 2]);
    flying.join(5, "taras", None).expect("there is room");
    assert_eq!(flying.pilot(1), "taras");
}

#[test]
fn vehicles_change_hands_only_when_both_agree() {
    let mut flying = Flying::new(Vec::new());
    flying.join(1, "anna", None).expect("there is room");
    flying
        .join(2, "olena", Some(Role::Safety))
        .expect("there is room");
    assert_eq!(
        flying.act("anna", &offer(1, "bohdan")),
        Err(CrewFault::NotYours(vec![1]))
    );
    assert_eq!(
        flying.act("bohdan", &offer(1, "bohdan")),
        Err(CrewFault::Oneself)
    );
    let nobody = CrewFault::Nobody("petro".to_owned());
    assert_eq!(flying.act("bohdan", &offer(1, "petro")), Err(nobody));
    let no_pilot = CrewFault::NoPilot("olena".to_owned());
    assert_eq!(
        flying.act("bohdan", &offer(1, "olena")),
        Err(no_pilot.clone())
    );
    assert_eq!(flying.act("olena", &ask(&[1])), Err(no_pilot));
    assert_eq!(
        flying.act("bohdan", &offer(9, "anna")),
        Err(CrewFault::NoVehicle)
    );
    assert_eq!(
        flying.act("anna", &CrewDeed::Accept),
        Err(CrewFault::NothingProposed)
    );

    flying.act("bohdan", &offer(1, "anna")).expect("proposed");
    assert_eq!(flying.pilot(1), "bohdan", "it is only a proposal");
    assert_eq!(
        flying.act("olena", &CrewDeed::Accept),
        Err(CrewFault::NothingProposed)
    );
    flying.act("anna", &CrewDeed::Accept).expect("accepted");
    assert_eq!(flying.pilot(1), "anna");

    flying.act("bohdan", &ask(&[1])).expect("proposed");
    flying.act("anna", &CrewDeed::Decline).expect("declined");
    assert_eq!(flying.pilot(1), "anna");
    flying.act("bohdan", &ask(&[1])).expect("proposed");
    flying.act("anna", &CrewDeed::Accept).expect("accepted");
    assert_eq!(flying.pilot(1), "bohdan");
    flying.act("bohdan", &offer(2, "anna")).expect("proposed");
    flying.act("anna", &CrewDeed::Accept).expect("accepted");
    assert_eq!(
        flying.act("anna", &ask(&[1, 2])),
        Err(CrewFault::YoursAlready(vec![2]))
    );
}

#[test]
fn a_proposal_ends_after_a_minute_and_with_another_pilot() {
    let mut flying = Flying::new(Vec::new());
    flying.join(1, "anna", None).expect("there is room");
    flying.join(2, "petro", None).expect("there is room");
    flying.act("bohdan", &offer(1, "anna")).expect("proposed");
    flying.act("bohdan", &offer(1, "petro")).expect("proposed");
    flying.act("petro", &CrewDeed::Accept).expect("accepted");
    assert_eq!(
        flying.act("anna", &CrewDeed::Accept),
        Err(CrewFault::NothingProposed)
    );
    flying.act("bohdan", &offer(2, "anna")).expect("proposed");
    flying.now += Duration::from_secs(60);
    assert_eq!(
        flying.act("anna", &CrewDeed::Accept),
        Err(CrewFault::Overtaken)
    );
    flying.act("bohdan", &offer(2, "anna")).expect("proposed");
    flying.now += Duration::from_secs(61);
    let ended = flying.crew.settle(&flying.pilots, flying.now);
    assert_eq!(ended.len(), 1);
    assert!(flying.crew.proposals().is_empty());
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
fn while_the_host_is_stopped_nobody_is_silent_and_no_proposal_ends() {
    let mut flying = Flying::new(Vec::new());
    flying.join(1, "anna", None).expect("there is room");
    flying.act("bohdan", &offer(1, "anna")).expect("proposed");
    let s = Duration::from_secs;
    for seconds in 0..5 {
        flying.crew.look(NOW + s(seconds));
    }
    flying.now = NOW + s(4 + 300);
    flying.crew.look(flying.now);
    assert!(flying.crew.silent(flying.now).is_empty());
    assert!(flying.crew.settle(&flying.pilots, flying.now).is_empty());
    flying.act("anna", &CrewDeed::Accept).expect("accepted");
    // Silence counts on from there.
    for seconds in 1..=6 {
        flying.crew.look(flying.now + s(seconds));
    }
    assert_eq!(flying.crew.silent(flying.now + s(6)), [ConnectionId(1)]);
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
    });
    let expected = "{\"say\":{\"id\":7,\"line\":\"3 takeoff 20\",\"confirmed\":\"nothing\"}}\n";
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
        Just(CrewDeed::Accept),
        Just(CrewDeed::Accept),
        Just(CrewDeed::Decline),
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
                    flying.crew.begin(posts, &mut flying.pilots);
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
