use super::*;

fn needs(source: &str) -> Vec<Need> {
    Mission::parse(source).expect("it is good").needs()
}

fn design(source: &str) -> Design {
    Design::from_toml(source).expect("a good design")
}

fn starter() -> Design {
    design(include_str!("../../../designs/starter.toml"))
}

const AIR: &str = include_str!("../../../missions/01-air-sample.toml");
const FLOOD: &str = include_str!("../../../missions/11-flood-search.toml");
const RELAY: &str = include_str!("../../../missions/12-relay-chain.toml");
const ROBOT: &str = include_str!("../../../missions/18-robot-lane.toml");

#[test]
fn seats_that_need_the_same_are_together() {
    let needs = needs(FLOOD);
    let seats: Vec<&[VehicleId]> = needs.iter().map(|need| &need.seats[..]).collect();
    assert_eq!(seats, [&[1, 2, 3][..], &[4][..]]);
    assert_eq!(needs[0].sensors, ["s_rgbg"]);
    assert_eq!(needs[0].loads, [("s_drop", 1), ("s_med", 2)]);
    assert_eq!(needs[1].loads, [("s_drop", 1), ("s_node", 2)]);
}

#[test]
fn the_starter_drone_fits_the_first_mission_in_every_line() {
    let needs = needs(AIR);
    let lines = needs[0].fit(&starter());
    assert!(
        lines.iter().all(|line| line.met && !line.is_block),
        "{lines:#?}"
    );
    // The distance from the pad to the farthest corner of the yard.
    assert!(
        (50.0..150.0).contains(&needs[0].far_m),
        "{}",
        needs[0].far_m
    );
    assert!((needs[0].reach_m / needs[0].far_m - 1.3).abs() < 1e-9);
}

#[test]
fn what_is_missing_on_board_stands_in_the_way() {
    let need = &needs(FLOOD)[0];
    let unmet = |design: &Design| -> Vec<(String, bool)> {
        let lines = need.fit(design).into_iter().filter(|line| !line.met);
        lines
            .map(|line| (line.what.to_string(), line.is_block))
            .collect()
    };
    let names = |design: &Design| {
        unmet(design)
            .into_iter()
            .map(|(what, _)| what)
            .collect::<Vec<_>>()
    };
    let blocked = unmet(&starter());
    for wanted in ["camera on a gimbal", "dropper", "rescue kit"] {
        assert!(
            blocked.contains(&(wanted.to_owned(), true)),
            "{wanted}: {blocked:?}"
        );
    }
    let with = |design: Design, id| design.with(part(id).expect("a part"));
    let searcher = design(include_str!("../../../designs/searcher.toml"))
        .without(part("s_thdual").expect("a part"));
    let searcher = with(searcher, "s_rgbg");
    assert_eq!(
        unmet(&searcher),
        [("rescue kit".to_owned(), false)],
        "one of two"
    );
    let both = names(&with(searcher, "s_med"));
    assert!(!both.contains(&"rescue kit".to_owned()), "{both:?}");
}

#[test]
fn a_need_follows_the_wind_the_budget_and_the_missing_parts() {
    let mut mission = Mission::parse(RELAY).expect("it is good");
    // An event raises the wind from 3 to 7 m/s.
    assert!(mission.needs()[0].wind_m_s >= 7.0);
    mission.seats.outlay.budget = Some(starter().credits() * mission.seats.count as u32 - 4);
    let need = &mission.needs()[0];
    let cost = |design: &Design| {
        let last = need.fit(design).pop().expect("the cost");
        (last.what.to_string(), last.met, last.is_block)
    };
    assert_eq!(
        cost(&starter()),
        ("cost of a drone, cr".to_owned(), false, false)
    );
    let cheaper = starter().without(part("s_voc").expect("a part"));
    assert!(cost(&cheaper).1);
    let bare = starter().without(part("r_sik915").expect("a part"));
    let radio = need.fit(&bare).into_iter().find(|line| line.is_block);
    assert_eq!(
        radio.map(|line| line.has.to_string()),
        Some("none".to_owned())
    );
}

/// An equal share once called every robot too dear, though the fleet kept within its budget.
#[test]
fn each_seat_gets_the_share_of_the_budget_that_its_kind_needs() {
    let mut mission = Mission::parse(ROBOT).expect("it is good");
    let shares = |mission: &Mission| -> Vec<(DesignKind, u32)> {
        let needs = mission.needs();
        let share = |need: &Need| Some((need.kind, need.credits?));
        needs.iter().filter_map(share).collect()
    };
    let least: Vec<u32> = price::least(&mission).collect();
    mission.seats.outlay.budget = Some(2 * least.iter().sum::<u32>());
    let kinds = mission.seat_kinds();
    for (kind, share) in shares(&mission) {
        let seat = kinds.iter().position(|it| *it == kind).expect("a seat");
        assert_eq!(share, 2 * least[seat], "{kind:?}");
    }
    assert_eq!(shares(&mission).len(), 2, "drones and robots");
}

#[test]
fn a_stronger_wind_shortens_the_radius_until_it_stands_in_the_way() {
    let mut mission = Mission::parse(AIR).expect("it is good");
    let radius = |mission: &Mission| {
        let lines = mission.needs()[0].fit(&starter());
        let radius = lines
            .into_iter()
            .find(|line| line.what.to_string().starts_with("radius"));
        radius.expect("a radius")
    };
    assert!(radius(&mission).met);
    mission.site.weather.wind.speed_m_s = 20.0;
    let beaten = radius(&mission);
    assert!(!beaten.met && beaten.is_block, "{beaten:?}");
    assert_eq!(beaten.has.to_string(), "0 m");
}
