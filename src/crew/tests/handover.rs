//! Vehicles change hands.

use super::*;

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
        flying.act("anna", &accept()),
        Err(CrewFault::NothingProposed)
    );

    flying.act("bohdan", &offer(1, "anna")).expect("proposed");
    assert_eq!(flying.pilot(1), "bohdan", "it is only a proposal");
    assert_eq!(
        flying.act("olena", &accept()),
        Err(CrewFault::NothingProposed)
    );
    flying.act("anna", &accept()).expect("accepted");
    assert_eq!(flying.pilot(1), "anna");

    flying.act("bohdan", &ask(&[1])).expect("proposed");
    flying.act("anna", &decline()).expect("declined");
    assert_eq!(flying.pilot(1), "anna");
    flying.act("bohdan", &ask(&[1])).expect("proposed");
    flying.act("anna", &accept()).expect("accepted");
    assert_eq!(flying.pilot(1), "bohdan");
    flying.act("bohdan", &offer(2, "anna")).expect("proposed");
    flying.act("anna", &accept()).expect("accepted");
    assert_eq!(
        flying.act("anna", &ask(&[1, 2])),
        Err(CrewFault::YoursAlready(vec![2]))
    );
}

#[test]
fn equal_proposals_of_both_sides_need_no_answer() {
    let mut flying = Flying::new(Vec::new());
    flying.join(1, "anna", None).expect("there is room");
    flying.act("bohdan", &offer(1, "anna")).expect("proposed");
    let both = flying.act("anna", &ask(&[1]));
    assert!(matches!(both, Ok(DeedOutcome::Changed(_))), "{both:?}");
    assert_eq!(flying.pilot(1), "anna");
    assert_eq!(flying.crew.proposals(), []);
    // The other way round, and not with other vehicles.
    flying.act("bohdan", &ask(&[1])).expect("proposed");
    let back = flying.act("anna", &offer(1, "bohdan"));
    assert!(matches!(back, Ok(DeedOutcome::Changed(_))), "{back:?}");
    assert_eq!(flying.pilot(1), "bohdan");
    flying.act("bohdan", &offer(1, "anna")).expect("proposed");
    let other = flying.act("anna", &ask(&[1, 2]));
    assert!(matches!(other, Ok(DeedOutcome::Proposed(_))), "{other:?}");
    // An offer that has ended is none.
    flying.now += Duration::from_secs(60);
    let late = flying.act("anna", &ask(&[1]));
    assert!(matches!(late, Ok(DeedOutcome::Proposed(_))), "{late:?}");
}

#[test]
fn several_proposals_wait_beside_each_other_and_the_answer_names_one() {
    let mut flying = Flying::new(Vec::new());
    flying.join(1, "anna", None).expect("there is room");
    flying.join(2, "petro", None).expect("there is room");
    let from = |vehicles: &[VehicleId], from: Option<&str>| ProposalChoice {
        vehicles: vehicles.to_vec(),
        from: from.map(str::to_owned),
    };
    for vehicle in [3, 4] {
        let offered = flying.act("bohdan", &offer(vehicle, "anna"));
        offered.expect("proposed");
    }
    let fault = flying.act("anna", &accept()).expect_err("it is ambiguous");
    let listed = "several proposals wait: bohdan offers 3; bohdan offers 4: say which, as in `crew accept 3` or `crew accept 3 from NAME`";
    assert_eq!(fault.text().to_string(), listed);
    let other = CrewDeed::Accept(from(&[2], None));
    let fault = flying.act("anna", &other).expect_err("it is another one");
    let listed = "no such proposal; these wait: bohdan offers 3; bohdan offers 4";
    assert_eq!(fault.text().to_string(), listed);
    let third = CrewDeed::Accept(from(&[3], None));
    flying.act("anna", &third).expect("accepted");
    assert_eq!((flying.pilot(3), flying.pilot(4)), ("anna", "bohdan"));
    // With one left, nothing has to be named.
    flying.act("anna", &accept()).expect("accepted");
    assert_eq!(flying.pilot(4), "anna");
    // Two ask for the same vehicle.
    for who in ["bohdan", "petro"] {
        flying.act(who, &ask(&[3])).expect("proposed");
    }
    let both = CrewDeed::Decline(from(&[3], None));
    let fault = flying.act("anna", &both).expect_err("it is ambiguous");
    assert!(matches!(fault, CrewFault::SeveralProposals(open) if open.len() == 2));
    let petro = CrewDeed::Accept(from(&[3], Some("petro")));
    flying.act("anna", &petro).expect("accepted");
    assert_eq!(flying.pilot(3), "petro");
}

#[test]
fn a_repeated_proposal_is_one_and_nobody_makes_any_number_of_them() {
    let mut flying = Flying::new(Vec::new());
    flying.join(1, "anna", None).expect("there is room");
    for _ in 0..3 {
        flying.act("bohdan", &offer(1, "anna")).expect("proposed");
    }
    assert_eq!(flying.crew.proposals().len(), 1);
    let pairs = [[1, 2], [1, 3], [1, 4], [2, 3], [2, 4], [3, 4]];
    for pair in pairs {
        flying.act("anna", &ask(&pair)).expect("proposed");
    }
    // Asking for the first one would accept the offer.
    for vehicle in [2, 3] {
        flying.act("anna", &ask(&[vehicle])).expect("proposed");
    }
    let last = flying.act("anna", &ask(&[4]));
    assert_eq!(last, Err(CrewFault::ManyProposals));
}

#[test]
fn a_proposal_ends_after_a_minute_and_with_another_pilot() {
    let mut flying = Flying::new(Vec::new());
    flying.join(1, "anna", None).expect("there is room");
    flying.join(2, "petro", None).expect("there is room");
    flying.act("bohdan", &offer(1, "anna")).expect("proposed");
    flying.act("bohdan", &offer(1, "petro")).expect("proposed");
    flying.act("petro", &accept()).expect("accepted");
    assert_eq!(
        flying.act("anna", &accept()),
        Err(CrewFault::NothingProposed)
    );
    flying.act("bohdan", &offer(2, "anna")).expect("proposed");
    flying.now += Duration::from_secs(60);
    assert_eq!(flying.act("anna", &accept()), Err(CrewFault::Overtaken));
    flying.act("bohdan", &offer(2, "anna")).expect("proposed");
    flying.now += Duration::from_secs(61);
    let ended = flying.crew.settle(&flying.pilots, flying.now);
    assert_eq!(ended.len(), 1);
    assert!(flying.crew.proposals().is_empty());
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
    flying.act("anna", &accept()).expect("accepted");
    // Silence counts on from there.
    for seconds in 1..=6 {
        flying.crew.look(flying.now + s(seconds));
    }
    assert_eq!(flying.crew.silent(flying.now + s(6)), [ConnectionId(1)]);
}
