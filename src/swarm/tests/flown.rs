//! Manoeuvres and their paths in flight.

use super::*;
use crate::geo::maths;
use crate::ledger::LedgerEntry;
use crate::pilot_in_command::Person;

/// The tolerance for GPS, wind and control errors.
const NOISE_M: f64 = 0.6;

#[test]
fn four_share_a_survey_and_cover_every_point_of_it() {
    let mut stage = Stage::flying(4, 10.0);
    stage.say("all survey lane spacing 12 up 25");
    let mut trails: Vec<[f64; 3]> = Vec::new();
    let done = stage.watch(400.0, |stage| {
        trails.extend((1..=4).map(|id| stage.place(id)));
        stage.is_done("survey")
    });
    println!(
        "{:?} after {:?}, nearest {:.2} m",
        stage.rows("survey"),
        stage.now(),
        stage.nearest_m
    );
    assert!(done);
    let working: Vec<&[f64; 3]> = trails
        .iter()
        .filter(|at| (at[2] - 25.0).abs() < 2.0)
        .collect();
    for north in (22..=138).step_by(4) {
        for east in (2..=58).step_by(4) {
            let (north, east) = (f64::from(north), f64::from(east));
            let distance = |at: &&[f64; 3]| maths::hypot(at[0] - north, at[1] - east);
            let nearest = working.iter().map(distance).fold(f64::INFINITY, f64::min);
            assert!(nearest <= 6.0 + NOISE_M, "{north} {east}: {nearest}");
        }
    }
    assert!(stage.nearest_m >= 5.0, "{}", stage.nearest_m);
}

#[test]
fn a_wedge_keeps_its_shape_while_its_leader_goes_somewhere() {
    let mut stage = Stage::flying(5, 8.0);
    stage.say("all formation wedge spacing 10");
    assert!(
        stage.watch(90.0, |stage| stage.is_done("formation")),
        "{:?}",
        stage.rows("formation")
    );
    stage.run(3.0);
    stage.say("1 goto n 150 e 0 up 30");
    stage.run(0.5);
    let leads = stage.rows("goto").into_iter().map(|(_, _, why)| why);
    assert_eq!(leads.collect::<Vec<_>>(), ["leads the formation"]);
    let mut worst: f64 = 0.0;
    let arrived = stage.watch(120.0, |stage| {
        for (a, b) in [(1, 2), (1, 3), (1, 4), (1, 5)] {
            let (a, b) = (stage.place(a), stage.place(b));
            worst = worst.max((a[2] - b[2]).abs());
        }
        stage.is_done("goto")
    });
    println!(
        "after {:?}, nearest {:.2} m, heights differ by {worst:.2} m",
        stage.now(),
        stage.nearest_m
    );
    assert!(arrived, "{:?}", stage.rows("goto"));
    let leader = stage.place(1);
    assert!(
        (leader[0] - 150.0).abs() < 1.5 && (leader[2] - 30.0).abs() < 1.0,
        "{leader:?}"
    );
    assert!(stage.nearest_m >= 6.0, "{}", stage.nearest_m);
    assert!(worst < 1.5, "{worst}");
}

#[test]
fn a_formation_leaves_behind_the_vehicles_that_the_giver_of_the_order_does_not_fly() {
    for line in ["1 goto n 80 e 0", "1 altitude 30", "1 speed 3"] {
        let mut stage = Stage::flying(3, 8.0);
        stage.say("all formation column spacing 10");
        assert!(stage.watch(90.0, |stage| stage.is_done("formation")));
        let anna = Person::named("anna");
        stage.pilots.take_over(&[2], &anna);
        stage.run(2.0);
        let before = stage.place(2);
        stage.say(line);
        stage.run(1.0);
        let formation = |entry: &&LedgerEntry| entry.verb.name == "formation";
        let formation = stage.ledger.entries().find(formation);
        let ended = formation.map(|it| it.rows.iter().map(|row| row.ended_by.is_some()).collect());
        assert_eq!(ended, Some(vec![false, true, false]), "{line}");
        let said = "2: leaves formation: anna flies 2".to_owned();
        assert!(stage.notices.contains(&said), "{:?}", stage.notices);
        stage.run(20.0);
        let moved = stage.place(2);
        let moved_m = maths::hypot(moved[0] - before[0], moved[1] - before[1]);
        assert!(moved_m < 3.0, "{line}: {before:?} {moved:?}");
        assert!((moved[2] - before[2]).abs() < 1.5, "{line}");
        assert!(stage.nearest_m >= 5.0, "{line}: {}", stage.nearest_m);
    }
}

#[test]
fn who_closes_up_is_flown_by_the_pilot_of_the_leader_that_dropped_out() {
    for ours in [true, false] {
        let mut stage = Stage::flying(4, 8.0);
        stage.say("all formation wedge spacing 10");
        assert!(stage.watch(90.0, |stage| stage.is_done("formation")));
        let anna = Person::named("anna");
        let theirs: &[VehicleId] = if ours { &[3] } else { &[1, 2, 3, 4] };
        stage.pilots.take_over(theirs, &anna);
        stage.run(2.0);
        let before = stage.place(3);
        stage.say("1 land");
        stage.run(25.0);
        let after = stage.place(3);
        let moved_m = maths::hypot(after[0] - before[0], after[1] - before[1]);
        let said = "3: leaves formation: anna flies 3".to_owned();
        // The others have closed up behind the second one.
        assert!([2, 4].iter().all(|&id| stage.conductor.has(id)));
        assert_eq!(stage.conductor.has(3), !ours);
        assert_eq!(stage.notices.contains(&said), ours, "{:?}", stage.notices);
        assert_eq!(moved_m < 3.0, ours, "{before:?} {after:?}");
        assert!(stage.nearest_m >= 5.0, "{}", stage.nearest_m);
    }
}

#[test]
fn a_formation_goes_as_fast_as_its_leader_was_told_to() {
    for (told, fastest_m_s) in [("", 5.0), ("all speed 3", 3.0), ("1 speed 8", 8.0)] {
        let mut stage = Stage::flying(3, 8.0);
        if !told.is_empty() {
            stage.say(told);
        }
        stage.say("all formation column spacing 10");
        assert!(stage.watch(90.0, |stage| stage.is_done("formation")));
        stage.say("1 goto n 200 e 0 up 25");
        let mut fastest: f64 = 0.0;
        let arrived = stage.watch(150.0, |stage| {
            let speed_m_s = stage.vehicles[&1].global.map_or(0.0, |global| {
                maths::hypot_f32(global.north_m_s, global.east_m_s)
            });
            fastest = fastest.max(f64::from(speed_m_s));
            stage.is_done("goto")
        });
        assert!(arrived, "{told}: {:?}", stage.rows("goto"));
        assert!((fastest - fastest_m_s).abs() < 0.6, "{told}: {fastest}");
        assert!(stage.nearest_m >= 6.0, "{told}: {}", stage.nearest_m);
    }
}

#[test]
fn a_survey_of_a_concave_area_says_how_much_of_it_lies_outside() {
    let mut stage = Stage::flying(2, 8.0);
    let horseshoe = [
        (20.0, 0.0),
        (80.0, 0.0),
        (80.0, 40.0),
        (60.0, 40.0),
        (60.0, 10.0),
        (40.0, 10.0),
        (40.0, 40.0),
        (20.0, 40.0),
    ];
    let corners = horseshoe.map(|(north_m, east_m)| HOME.moved(north_m, east_m));
    let outline = Outline::Polygon(corners.to_vec());
    stage.areas.insert("bay".to_owned(), outline);
    stage.say("all survey bay spacing 10");
    for (_, state, why) in stage.rows("survey") {
        assert_eq!(state, RowState::InProgress(0));
        assert!(why.contains("60 m of the lines cross gaps"), "{why}");
    }
    stage.say("all survey bay spacing 10 course 90");
    for (_, _, why) in stage.rows("survey") {
        assert!(!why.contains("gaps"), "{why}");
    }
}

#[test]
fn lines_nearer_than_the_separation_are_flown_at_two_heights() {
    let mut stage = Stage::flying(3, 10.0);
    stage.say("all survey n 20 e 0 to n 60 e 24 spacing 4 up 15");
    let rows = stage.rows("survey");
    assert!(rows[0].2.contains("higher"), "{rows:?}");
    let done = stage.watch(300.0, |stage| stage.is_done("survey"));
    println!("two heights: nearest {:.2} m", stage.nearest_m);
    assert!(done, "{:?}", stage.rows("survey"));
    assert!(stage.nearest_m >= 5.0, "{}", stage.nearest_m);
}

#[test]
fn searches_share_a_square_and_turn_their_sectors() {
    for line in [
        "all search square n 60 e 10 spacing 15 radius 40 up 20",
        "all search sector n 60 e 10 radius 40 up 20",
    ] {
        let mut stage = Stage::flying(3, 10.0);
        stage.say(line);
        let mut reached = [0.0f64; 3];
        let done = stage.watch(400.0, |stage| {
            for id in 1..=3 {
                let at = stage.place(id);
                let far = maths::hypot(at[0] - 60.0, at[1] - 10.0);
                reached[usize::from(id) - 1] = reached[usize::from(id) - 1].max(far);
            }
            stage.is_done("search")
        });
        println!(
            "{line}: nearest {:.2} m, reached {reached:?}",
            stage.nearest_m
        );
        assert!(done, "{line}: {:?}", stage.rows("search"));
        assert!(stage.nearest_m >= 5.0, "{line}: {}", stage.nearest_m);
    }
}

#[test]
fn followers_stay_behind_a_leader_that_turns_back_through_them() {
    let mut stage = Stage::flying(4, 8.0);
    stage.say("2-4 follow 1 distance 12");
    assert!(stage.watch(60.0, |stage| stage.is_done("follow")));
    stage.say("1 goto n 120 e 0");
    stage.run(25.0);
    let behind = stage.distance(1, 2);
    assert!((12.0..17.0).contains(&behind), "{behind}");
    stage.say("1 goto n -60 e 20");
    stage.run(40.0);
    println!("follow: nearest {:.2} m", stage.nearest_m);
    assert!(stage.nearest_m >= 5.0, "{}", stage.nearest_m);
    assert!(stage.distance(1, 4) < 50.0);
}

#[test]
fn who_is_spread_has_room_and_a_chain_stands_in_equal_steps() {
    let mut stage = Stage::flying(5, 6.0);
    stage.say("all spread 20");
    assert!(stage.watch(90.0, |stage| stage.is_done("spread")));
    for (a, b) in [(1, 2), (2, 3), (3, 4), (4, 5)] {
        let apart = stage.distance(a, b);
        assert!(apart > 20.0 - 2.5, "{a} {b}: {apart}");
    }
    stage.say("2-4 relay to n 200 e 0 up 30");
    assert!(stage.watch(120.0, |stage| stage.is_done("relay to")));
    let home = stage.place(1)[1];
    let mut north: Vec<f64> = (2..=4).map(|id| stage.place(id)[0]).collect();
    north.sort_by(f64::total_cmp);
    for (at, expected) in north.iter().zip([50.0, 100.0, 150.0]) {
        assert!((at - expected).abs() < 1.5, "{north:?} {home}");
    }
    println!("spread and chain: nearest {:.2} m", stage.nearest_m);
    assert!(stage.nearest_m >= 5.0, "{}", stage.nearest_m);
}

#[test]
fn a_chain_to_a_vehicle_stretches_with_it() {
    let mut stage = Stage::flying(3, 8.0);
    stage.say("1 goto n 60 e 0");
    stage.run(15.0);
    stage.say("2-3 relay to vehicle 1 up 35");
    assert!(
        stage.watch(90.0, |stage| stage.is_done("relay to")),
        "{:?}",
        stage.rows("relay to")
    );
    stage.say("1 goto n 150 e 0");
    stage.run(40.0);
    let mut north = [stage.place(2)[0], stage.place(3)[0]];
    north.sort_by(f64::total_cmp);
    assert!(
        (north[0] - 50.0).abs() < 2.5 && (north[1] - 100.0).abs() < 2.5,
        "{north:?}"
    );
}

#[test]
fn the_lines_of_one_that_leaves_go_to_the_others() {
    let mut stage = Stage::flying(3, 10.0);
    stage.say("all survey lane spacing 12 up 25");
    let mut trails: Vec<[f64; 3]> = Vec::new();
    stage.watch(14.0, |stage| {
        trails.extend([1, 3].map(|id| stage.place(id)));
        false
    });
    stage.say("2 land");
    assert_eq!(stage.rows("survey")[1].1, RowState::Superseded);
    let done = stage.watch(400.0, |stage| {
        trails.extend([1, 3].map(|id| stage.place(id)));
        let rows = stage.rows("survey");
        rows.iter().all(|(_, state, _)| state.is_final())
    });
    let rows = stage.rows("survey");
    assert!(done, "{rows:?}");
    assert_eq!((rows[0].1, rows[2].1), (RowState::Done, RowState::Done));
    // The vehicle that left had finished no line: the others have flown all five.
    for east in [6.0, 18.0, 30.0, 42.0, 54.0] {
        let near = |at: &&[f64; 3]| (at[0] - 80.0).abs() < 3.0 && (at[1] - east).abs() < 1.0;
        assert!(trails.iter().any(|at| near(&at)), "{east}");
    }
    println!("one leaves: nearest {:.2} m", stage.nearest_m);
    assert!(stage.nearest_m >= 5.0, "{}", stage.nearest_m);
}

/// The highest ground speed of vehicle 1 until a command is done, in m/s.
fn fastest_m_s(stage: &mut Stage, verb: &str) -> f32 {
    let mut fastest: f32 = 0.0;
    let done = stage.watch(200.0, |stage| {
        let speed = stage.vehicles[&1].ground_speed_m_s();
        fastest = fastest.max(speed.unwrap_or(0.0));
        stage.is_done(verb)
    });
    assert!(done, "{:?}", stage.rows(verb));
    fastest
}

#[test]
fn a_speed_that_is_set_before_the_first_movement_holds_for_it() {
    let mut stage = Stage::flying(1, 5.0);
    stage.say("all speed 3");
    stage.run(2.0);
    stage.say("all goto n 60 e 0");
    let fastest = fastest_m_s(&mut stage, "goto");
    assert!((2.5..3.4).contains(&fastest), "{fastest} m/s");
}

#[test]
fn a_speed_that_is_set_before_a_survey_holds_for_it() {
    let mut stage = Stage::flying(1, 5.0);
    stage.say("all speed 4");
    stage.run(2.0);
    stage.say("all survey lane spacing 60 up 20");
    let fastest = fastest_m_s(&mut stage, "survey");
    assert!((3.0..4.5).contains(&fastest), "{fastest} m/s");
}

#[test]
fn the_way_to_the_first_line_is_no_part_of_a_survey() {
    let mut stage = Stage::flying(1, 5.0);
    stage.say("all goto n -200 e 0");
    assert!(stage.watch(120.0, |stage| stage.is_done("goto")));
    stage.say("all survey lane spacing 20 up 20");
    stage.watch(120.0, |stage| stage.place(1)[0] > 0.0);
    assert_eq!(stage.rows("survey")[0].1, RowState::InProgress(0));
    assert!(stage.watch(400.0, |stage| stage.is_done("survey")));
}
