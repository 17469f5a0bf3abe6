//! Who is on the crew, and the posts of missions.

use super::*;

#[test]
fn members_of_one_user_have_names_of_their_own() {
    let mut flying = Flying::new(Vec::new());
    for (number, user) in [(1, "anna"), (2, "anna"), (3, "bohdan"), (4, "anna")] {
        flying.join(number, user, None).expect("there is room");
    }
    let names = flying.crew.members().map(|it| it.person.name().to_owned());
    let names: Vec<_> = names.collect();
    assert_eq!(names, ["anna", "anna#2", "bohdan#2", "anna#3"]);
    // One connection is one member.
    assert_eq!(flying.join(1, "petro", None), Err(CrewDenial::NoHello));
}

#[test]
fn one_user_has_at_most_four_consoles_on_the_crew() {
    let mut flying = Flying::new(Vec::new());
    for (user, first) in [("anna", 0), ("bohdan", 10)] {
        for number in first..first + 4 {
            flying.join(number, user, None).expect("there is room");
        }
        let denied = flying.join(first + 4, user, None);
        assert_eq!(denied, Err(CrewDenial::FullForUser), "{user}");
    }
    flying.join(4, "petro", None).expect("there is room");
    // Once one of them has ended, there is room again.
    flying.leave(0);
    flying.join(5, "anna", None).expect("there is room");
}

#[test]
fn a_crew_has_at_most_sixteen_members() {
    let mut flying = Flying::new(Vec::new());
    for number in 0..16 {
        let user = format!("u{number}");
        flying.join(number, &user, None).expect("there is room");
    }
    assert_eq!(flying.join(16, "anna", None), Err(CrewDenial::Full));
}

#[test]
fn the_role_of_a_post_ends_with_its_mission() {
    let mut flying = Flying::new(vec![post(Role::Safety, &[]), post(Role::Sensors, &[])]);
    flying.join(1, "anna", None).expect("there is room");
    let wanted = Some(Role::Sensors);
    flying.join(2, "olena", wanted).expect("there is room");
    flying
        .crew
        .begin(Vec::new(), &mut flying.pilots, flying.now);
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
    // Who leaves makes the place free, after a while.
    let left = flying.leave(1).expect("a member");
    let CrewChange::Left { vehicles, .. } = left else {
        panic!("{left:?}");
    };
    assert_eq!(vehicles, [1, 2]);
    flying.now += Duration::from_secs(60);
    flying.join(5, "taras", None).expect("there is room");
    assert_eq!(flying.pilot(1), "taras");
}

#[test]
fn a_post_is_kept_for_the_user_whose_console_was_killed() {
    let mut flying = Flying::new(vec![post(Role::Pilot, &[1, 2]), post(Role::Safety, &[])]);
    flying.join(1, "anna", None).expect("there is room");
    flying.leave(1);
    flying.now += Duration::from_secs(59);
    flying.join(2, "taras", None).expect("there is room");
    assert_eq!(flying.pilot(1), "bohdan", "taras gets the other post");
    flying.join(3, "anna", None).expect("there is room");
    assert_eq!(flying.pilot(1), "anna");
    // Who asks for the role gets it all the same.
    flying.leave(3);
    flying
        .join(4, "olena", Some(Role::Pilot))
        .expect("there is room");
    assert_eq!(flying.pilot(1), "olena");
    flying.join(5, "anna", None).expect("there is room");
    assert_eq!(flying.pilot(1), "olena");
}

#[test]
fn who_comes_back_is_announced_with_the_vehicles() {
    let mut flying = Flying::new(vec![post(Role::Pilot, &[3, 4]), post(Role::Safety, &[])]);
    let said = |change: Result<CrewChange, CrewDenial>| {
        let text = change.expect("there is room").text(None);
        text.map(|it| it.to_string()).unwrap_or_default()
    };
    let joined = said(flying.join(1, "dora", None));
    assert_eq!(joined, "dora joins the crew: pilot of 3-4");
    flying.leave(1);
    let again = said(flying.join(2, "dora", None));
    assert_eq!(again, joined);
    let other = said(flying.join(3, "olena", None));
    assert_eq!(other, "olena joins the crew: safety");
}

#[test]
fn who_has_a_post_keeps_it_when_the_mission_begins_again() {
    let posts = vec![post(Role::Pilot, &[1, 2]), post(Role::Pilot, &[3])];
    let mut flying = Flying::new(posts.clone());
    flying.join(1, "anna", None).expect("there is room");
    flying.join(2, "olena", None).expect("there is room");
    flying.leave(1);
    flying.join(3, "anna", None).expect("there is room");
    flying.crew.begin(posts, &mut flying.pilots, flying.now);
    assert_eq!((flying.pilot(1), flying.pilot(3)), ("anna", "olena"));
}
