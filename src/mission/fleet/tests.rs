use super::*;
use crate::workshop::part;

fn mission(budget: Option<u32>) -> Mission {
    let source = include_str!("../../../missions/12-relay-chain.toml");
    let mut mission = Mission::parse(source).expect("it is good");
    mission.seats.outlay.budget = budget;
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
    let seats = mission(None).seats.count;
    assert!(seats > 2, "{seats}");
    let flown = mission(None)
        .with_fleet(vec![starter(), relay()])
        .expect("they may fly");
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
    let seats = mission(None).seats.count;
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

fn parsed(source: &str) -> Mission {
    Mission::parse(source).expect("it is good")
}

fn carrying(base: &Design, parts: &[&str]) -> Design {
    parts.iter().fold(base.clone(), |design, id| {
        design.with(part(id).expect("a part"))
    })
}

#[test]
fn a_sensor_is_there_only_if_it_is_mounted() {
    let air = || parsed(include_str!("../../../missions/01-air-sample.toml"));
    let sensors = |design: Design| -> Vec<&str> {
        let flown = air().with_fleet(vec![design]).expect("it may fly");
        assert_eq!(flown.seats.sensors, flown.seats.fits[0].sensors);
        flown.seats.sensors.iter().map(|sensor| sensor.id).collect()
    };
    let bare = starter().without(part("s_voc").expect("a part"));
    assert_eq!(sensors(bare.clone()), Vec::<&str>::new());
    let both = carrying(&bare, &["s_rgb", "s_voc"]);
    assert_eq!(
        sensors(both),
        ["s_voc", "s_rgb"],
        "what is asked for is first"
    );
    let asked: Vec<&str> = air().seats.asked[0]
        .sensors
        .iter()
        .map(|it| it.id)
        .collect();
    assert_eq!(asked, ["s_voc"]);
}

#[test]
fn loads_are_the_pieces_that_hang_on_the_dropper() {
    let fire = || {
        let mut mission = parsed(include_str!("../../../missions/09-fire-attack.toml"));
        mission.seats.outlay.budget = None;
        mission
    };
    let big = design(include_str!("../../../designs/deminer.toml"));
    let loads = |parts: &[&str]| {
        let built = carrying(&big, parts);
        let flown = fire().with_fleet(vec![built]).expect("it may fly");
        let loads = flown.seats.fits[0].loads.clone();
        loads.into_iter().collect::<Vec<_>>()
    };
    assert_eq!(loads(&["s_ball"]), [], "nothing holds it");
    assert_eq!(loads(&["s_drop"]), []);
    assert_eq!(
        loads(&["s_drop", "s_ball", "s_ball", "s_med"]),
        [(Load::Ball, 2), (Load::Kit, 1)]
    );
    assert_eq!(loads(&["s_spray"]), [(Load::Spray, TANK_S)]);
}

#[test]
fn each_drone_has_the_radio_that_was_built_in() {
    let source = include_str!("../../../missions/01-air-sample.toml");
    assert!(parsed(source).site.radio.is_none());
    let set = |mut mission: Mission, design: Design| {
        mission.seats.outlay.budget = None;
        let flown = mission.with_fleet(vec![design]).expect("it may fly");
        assert!(flown.site.radio.is_some(), "the ground has its counterpart");
        flown.seats.fits[0].radio.expect("a radio")
    };
    let plain = set(parsed(source), starter());
    assert_eq!((plain.model.id, plain.relays), ("r_sik915", false));
    let mesh = set(parsed(source), relay());
    assert_eq!((mesh.model.id, mesh.relays), ("r_mesh24", true));
    assert!((mesh.gain_dbi - mesh.model.radio.air_dbi - 6.0).abs() < 1e-9);
    // The Wi-Fi radio of that mission relays, also on built drones.
    let wifi = carrying(&starter(), &["r_wifi24"]);
    assert!(set(mission(None), wifi.clone()).relays);
    assert!(!set(parsed(source), wifi).relays);
    assert!(!set(mission(None), starter()).relays);
}

#[test]
fn the_simulator_gets_the_airframe_and_the_parameters_of_the_design() {
    let flown = mission(None).with_fleet(vec![starter(), relay()]);
    let world = flown.expect("they may fly").world(1);
    let masses: Vec<f64> = world.airframes.iter().map(|it| it.mass_kg()).collect();
    assert!((masses[0] - starter().mass_kg()).abs() < 1e-3, "{masses:?}");
    assert!((masses[1] - relay().mass_kg()).abs() < 1e-3, "{masses:?}");
    assert!(Arc::ptr_eq(&world.airframes[1], &world.airframes[2]));
    let capacity = ("BATT_CAPACITY", 5000.0);
    assert!(world.airframes[0].parameters().contains(&capacity));
    assert!(mission(None).world(1).airframes.is_empty());
}

fn lane() -> Mission {
    parsed(include_str!("../../../missions/18-robot-lane.toml"))
}

fn sapper() -> Design {
    design(include_str!("../../../designs/sapper.toml"))
}

fn lifeboat() -> Design {
    design(include_str!("../../../designs/lifeboat.toml"))
}

#[test]
fn seats_take_designs_of_their_kind_and_the_others_keep_the_vehicles_of_the_mission() {
    let names = |fleet: Vec<Design>| -> Vec<Option<String>> {
        let flown = lane().with_fleet(fleet).expect("they may fly");
        let designs = flown.designs().into_iter();
        designs.map(|it| it.map(|it| it.name.clone())).collect()
    };
    let (drone, robot) = (
        Some("Starter 450".to_owned()),
        Some("Sapper 930".to_owned()),
    );
    assert_eq!(names(vec![sapper()]), [None, None, robot.clone()]);
    assert_eq!(names(vec![starter()]), [drone.clone(), drone.clone(), None]);
    let all = [drone.clone(), drone, robot];
    assert_eq!(names(vec![sapper(), starter()]), all);
    let flown = lane().with_fleet(vec![sapper()]).expect("it may drive");
    let fits: Vec<bool> = flown.seats.fits.iter().map(|fit| fit.flail).collect();
    assert_eq!(fits, [false, false, true]);
    let bare = sapper().without(part("s_flail").expect("a part"));
    let flown = lane().with_fleet(vec![bare]).expect("it may drive");
    assert!(!flown.seats.fits[2].flail, "only what is mounted");
    let misfits: Vec<String> = flown.misfits().iter().map(ToString::to_string).collect();
    let lacks = "Sapper 930 cannot do the task of vehicle 3: mine flail: 0, required 1";
    assert_eq!(misfits, [lacks]);
}

/// Records of older programs have a drone's design in the seat of a robot, which the mission drove with its own.
#[test]
fn a_design_of_another_kind_leaves_its_seat_to_the_mission() {
    let flown = lane().flown_by(vec![starter(), relay(), relay()]);
    let kinds = flown.vehicle_kinds();
    assert_eq!((flown.fleet().len(), kinds[2].name()), (2, "rover-skid"));
    assert!(flown.seats.fits[2].flail && flown.designs()[2].is_none());
}

#[test]
fn a_design_without_a_seat_of_its_kind_is_refused_with_the_kinds_that_have_one() {
    let refused = |mission: Mission, fleet| -> String {
        let faults = mission.with_fleet(fleet).expect_err("refused");
        let words = faults.iter().map(ToString::to_string);
        words.collect::<Vec<_>>().join("\n")
    };
    let boat = refused(lane(), vec![lifeboat()]);
    assert!(boat.contains("Lifeboat 120 is a boat"), "{boat}");
    assert!(boat.contains("drone, ground robot"), "{boat}");
    let robot = refused(mission(None), vec![sapper()]);
    assert!(robot.contains("Sapper 930 is a ground robot"), "{robot}");
    let many = refused(lane(), vec![sapper(), sapper()]);
    assert!(many.contains("1 seat for ground robots"), "{many}");
    let mut poor = lane();
    poor.seats.outlay.budget = Some(sapper().credits() - 1);
    assert!(refused(poor, vec![sapper()]).contains("1 cr more"));
}

#[test]
fn the_simulator_gets_the_kind_and_the_gear_of_a_driven_design() {
    let courier = design(include_str!("../../../designs/courier.toml"));
    let world = lane()
        .with_fleet(vec![courier.clone()])
        .expect("it may drive")
        .world(1);
    let kinds: Vec<&str> = world.kinds.iter().map(|kind| kind.name()).collect();
    assert_eq!(
        kinds,
        ["copter", "copter", "rover"],
        "it has steered wheels"
    );
    let gear = world.airframes[2].gear().expect("it drives");
    assert!((gear.mass_kg - courier.mass_kg()).abs() < 1e-9);
    assert!(world.airframes[0].gear().is_none());
}

#[test]
fn needs_of_a_robot_are_those_of_its_task() {
    let needs = lane().needs();
    let robot = needs
        .iter()
        .find(|need| need.kind == DesignKind::Robot)
        .expect("a seat");
    assert_eq!(
        (robot.seats.as_slice(), robot.loads.as_slice()),
        (&[3][..], &[(FLAIL, 1)][..])
    );
    let blocks = |design: &Design| {
        robot
            .fit(design)
            .iter()
            .filter(|line| line.is_block)
            .count()
    };
    assert_eq!(
        (blocks(&sapper()), blocks(&starter()), blocks(&lifeboat())),
        (0, 1, 1)
    );
}
