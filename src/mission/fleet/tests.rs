use super::*;
use crate::workshop::part;

fn mission(budget: Option<u32>) -> Mission {
    let source = include_str!("../../../missions/12-relay-chain.toml");
    let mut mission = Mission::parse(source).expect("it is good");
    mission.outlay.budget = budget;
    mission
}

fn design(source: &str) -> Design {
    Design::from_toml(source).expect("a good design")
}

fn starter() -> Design {
    design(include_str!("../../../designs/starter.toml"))
}

fn relay() -> Design {
    design(include_str!("../../../designs/relay.toml"))
}

#[test]
fn the_last_design_flies_in_all_seats_that_follow() {
    let seats = mission(None).vehicles;
    assert!(seats > 2, "{seats}");
    let flown = mission(None).with_fleet(vec![starter(), relay()]);
    let flown = flown.expect("they may fly");
    let names: Vec<&str> = flown.fleet().iter().map(|it| it.name.as_str()).collect();
    assert_eq!(names.len(), seats);
    assert_eq!(names[0], "Starter 450");
    assert!(names[1..].iter().all(|name| *name == "Relay 750"));
    assert_eq!(flown.enlarged(seats + 2).fleet().len(), seats + 2);
    let own = mission(None).with_fleet(Vec::new());
    assert!(own.expect("its own drones").fleet().is_empty());
}

#[test]
fn a_fleet_is_refused_with_every_reason_in_words() {
    let seats = mission(None).vehicles;
    let cost = starter().credits() * seats as u32;
    let refused = |budget, fleet: Vec<Design>| {
        let faults = mission(budget).with_fleet(fleet).expect_err("refused");
        let words = faults.iter().map(ToString::to_string);
        words.collect::<Vec<_>>().join("\n")
    };
    let many = refused(None, vec![starter(); seats + 1]);
    assert!(many.contains(&format!("{} designs", seats + 1)), "{many}");
    let dear = refused(Some(cost - 10), vec![starter()]);
    assert!(
        dear.contains(&format!("costs {cost} cr, 10 cr more")),
        "{dear}"
    );
    assert!(mission(Some(cost)).with_fleet(vec![starter()]).is_ok());
    let bare = starter().without(part("m2212_920").expect("a part"));
    let both = refused(Some(10), vec![starter(), bare]);
    assert!(both.contains("Starter 450: "), "{both}");
    assert_eq!(both.lines().count(), 2, "{both}");
}
