//! `sortie plan`: checks, conversions and rehearsals of files.

use std::fs;

use super::{folder_with, sortie_in, text};

/// A waypoint file: takeoff, a place north and one east of home, return.
pub(super) fn waypoints(home: (f64, f64), places: [(f64, f64); 2]) -> String {
    let [(lat1, lon1), (lat2, lon2)] = places;
    format!(
        "QGC WPL 110\n\
         0\t1\t0\t16\t0\t0\t0\t0\t{}\t{}\t170\t1\n\
         1\t0\t3\t22\t0\t0\t0\t0\t0\t0\t20\t1\n\
         2\t0\t3\t16\t0\t0\t0\t0\t{lat1}\t{lon1}\t20\t1\n\
         3\t0\t3\t16\t0\t0\t0\t0\t{lat2}\t{lon2}\t20\t1\n\
         4\t0\t3\t20\t0\t0\t0\t0\t0\t0\t0\t1\n",
        home.0, home.1
    )
}

pub(super) fn good() -> String {
    waypoints((50.4501, 30.5234), [(50.4511, 30.5234), (50.4511, 30.5248)])
}

#[test]
fn a_faulty_plan_is_pointed_at_in_both_languages() {
    let unknown = good().replace("3\t0\t3\t16", "3\t0\t12\t16");
    let folder = folder_with(&[
        ("good.waypoints", &good()),
        ("frame.waypoints", &unknown),
        (
            "torn.waypoints",
            &good().replace("\t50.4511\t30.5248", "\tnorth"),
        ),
    ]);
    let check = |arguments: &[&str]| sortie_in(folder.path(), arguments);
    let output = check(&["plan", "check", "good.waypoints"]);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    assert!(
        text(&output.stdout).contains("4 items"),
        "{}",
        text(&output.stdout)
    );
    // `sortie check` accepts the files as well.
    for arguments in [
        ["plan", "check", "frame.waypoints"].as_slice(),
        &["check", "frame.waypoints"],
    ] {
        let output = check(arguments);
        let said = text(&output.stdout);
        assert_eq!(output.status.code(), Some(1), "{said}");
        assert!(
            said.contains("frame.waypoints:5:1: plan, item 3: the vehicle refuses the frame"),
            "{said}"
        );
    }
    let output = check(&["check", "torn.waypoints"]);
    let said = text(&output.stdout);
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert!(
        said.contains("torn.waypoints:5:1: 11 fields, expected 12"),
        "{said}"
    );
    let output = check(&["plan", "check", "frame.waypoints", "--lang", "uk"]);
    assert!(
        text(&output.stdout).contains("план, пункт 3: апарат відхиляє"),
        "{}",
        text(&output.stdout)
    );
}

/// A value that does not fit into the vehicle's storage is flown as a different one.
#[test]
fn a_value_that_the_vehicle_would_store_as_another_one_is_an_error() {
    let wait = good().replace("2\t0\t3\t16\t0", "2\t0\t3\t19\t-5");
    let turns = good().replace("2\t0\t3\t16\t0\t0\t0", "2\t0\t3\t18\t300\t0\t3000");
    let folder = folder_with(&[
        (
            "hold.waypoints",
            &good().replace("3\t16\t0", "3\t16\t70000"),
        ),
        ("wait.waypoints", &wait),
        ("turns.waypoints", &turns),
    ]);
    for (file, faults) in [
        (
            "hold.waypoints",
            vec!["`hold` of NAV_WAYPOINT is 70000 s; the vehicle would store 4464 s"],
        ),
        (
            "wait.waypoints",
            vec!["`time` of NAV_LOITER_TIME is -5 s; the vehicle would store 65531 s"],
        ),
        (
            "turns.waypoints",
            vec![
                "`turns` of NAV_LOITER_TURNS is 300; the vehicle would store 255",
                "`radius` of NAV_LOITER_TURNS is 3000 m; the vehicle would store 2550 m",
            ],
        ),
    ] {
        for arguments in [["plan", "check", file].as_slice(), &["check", file]] {
            let output = sortie_in(folder.path(), arguments);
            let said = text(&output.stdout);
            assert_eq!(output.status.code(), Some(1), "{said}");
            for fault in &faults {
                let line = format!("{file}:4:1: plan, item 2: {fault}");
                assert!(said.contains(&line), "{said}");
            }
        }
    }
}

#[test]
fn a_plan_goes_through_every_format_and_back() {
    let folder = folder_with(&[("a.waypoints", &good())]);
    let convert = |from: &str, to: &str, more: &[&str]| {
        let arguments = [&["plan", "convert", from, to], more].concat();
        sortie_in(folder.path(), &arguments)
    };
    for (from, to) in [
        ("a.waypoints", "b.plan"),
        ("b.plan", "c.kml"),
        ("c.kml", "d.geojson"),
        ("d.geojson", "e.waypoints"),
    ] {
        let output = convert(from, to, &[]);
        assert_eq!(
            output.status.code(),
            Some(0),
            "{to}: {}",
            text(&output.stderr)
        );
    }
    let read = |name| fs::read_to_string(folder.path().join(name)).expect("written");
    let back = convert("a.waypoints", "f.waypoints", &[]);
    assert_eq!(back.status.code(), Some(0));
    assert_eq!(read("e.waypoints"), read("f.waypoints"));
    // A file that exists is kept.
    assert_eq!(convert("a.waypoints", "b.plan", &[]).status.code(), Some(2));
    assert_eq!(
        convert("a.waypoints", "b.plan", &["--force"]).status.code(),
        Some(0)
    );
    // Nothing is lost silently.
    fs::write(
        folder.path().join("rally.rally"),
        "RALLY 50.45\t30.52\t40\t20\t0\t0\n",
    )
    .expect("written");
    let lost = convert("rally.rally", "g.waypoints", &[]);
    assert_eq!(lost.status.code(), Some(2));
    assert!(
        text(&lost.stderr).contains("rally points"),
        "{}",
        text(&lost.stderr)
    );
}

#[test]
fn lanes_closer_than_the_limit_of_a_rehearsal_are_refused_at_once() {
    let folder = tempfile::tempdir().expect("a folder");
    let points = "50.4512,30.5240 50.4525,30.5245";
    let line = [
        "plan",
        "line",
        "--points",
        points,
        "--home",
        HOME,
        "--vehicles",
        "3",
    ];
    let made = |spacing| {
        sortie_in(
            folder.path(),
            &[&line[..], &["--spacing", spacing]].concat(),
        )
    };
    let narrow = made("4");
    assert_eq!(narrow.status.code(), Some(2));
    let said = text(&narrow.stderr);
    assert!(said.contains("6 m or more"), "{said}");
    assert_eq!(made("6").status.code(), Some(0));
}

/// An area of about 330 m by 390 m with a bay, in front of the homes.
const FIELD: &str = r#"{"type": "Polygon", "coordinates": [[[30.5234, 50.4511], [30.5280, 50.4511], [30.5265, 50.4525],
                        [30.5280, 50.4545], [30.5234, 50.4545], [30.5234, 50.4511]]]}"#;
const HOME: &str = "50.4505,30.5240,170";

#[test]
fn an_area_becomes_a_plan_for_each_vehicle_that_can_be_rehearsed() {
    let folder = folder_with(&[("field.geojson", FIELD)]);
    let run = |arguments: &[&str]| sortie_in(folder.path(), arguments);
    let survey = [
        "plan",
        "survey",
        "field.geojson",
        "--home",
        HOME,
        "--vehicles",
        "3",
        "--spacing",
        "30",
    ];
    let shown = run(&survey);
    let said = text(&shown.stdout);
    assert_eq!(
        shown.status.code(),
        Some(0),
        "{said}{}",
        text(&shown.stderr)
    );
    assert!(
        said.contains("part-3.plan") && said.contains("times the smallest"),
        "{said}"
    );
    assert!(!folder.path().join("part-1.plan").exists());
    let written = run(&[&survey[..], &["--write", "out/v{id}.waypoints"]].concat());
    assert_eq!(written.status.code(), Some(0), "{}", text(&written.stdout));
    let again = run(&[&survey[..], &["--write", "out/v{id}.waypoints"]].concat());
    assert_eq!(again.status.code(), Some(2), "files that exist are kept");
    let files = ["out/v1.waypoints", "out/v2.waypoints", "out/v3.waypoints"];
    let flown = run(&[&["plan", "rehearse"], &files[..]].concat());
    assert_eq!(flown.status.code(), Some(0), "{}", text(&flown.stdout));
    let checked = run(&[&["plan", "check"], &files[..]].concat());
    assert_eq!(checked.status.code(), Some(0), "{}", text(&checked.stdout));
}

/// An area to stay out of is a hole of the survey, and a part of each plan: the check finds no leg that crosses it.
#[test]
fn a_survey_leads_around_the_holes_of_its_area() {
    let field = r#"{"type": "Polygon", "coordinates": [
        [[30.5220, 50.4508], [30.5260, 50.4508], [30.5260, 50.4528], [30.5220, 50.4528]],
        [[30.5236, 50.4515], [30.5244, 50.4515], [30.5244, 50.4521], [30.5236, 50.4521]]]}"#;
    let folder = folder_with(&[("field.geojson", field)]);
    let survey = ["plan", "survey", "field.geojson", "--home", HOME];
    let more = ["--vehicles", "3", "--spacing", "20", "--write", "out"];
    let made = sortie_in(folder.path(), &[&survey[..], &more[..]].concat());
    assert_eq!(made.status.code(), Some(0), "{}", text(&made.stdout));
    let part = folder.path().join("out/part-1.plan");
    let written = fs::read_to_string(part).expect("a plan");
    assert!(written.contains("\"inclusion\": false"), "{written}");
    let parts = ["out/part-1.plan", "out/part-2.plan", "out/part-3.plan"];
    let checked = sortie_in(folder.path(), &[&["plan", "check"], &parts[..]].concat());
    assert_eq!(checked.status.code(), Some(0), "{}", text(&checked.stdout));
}

#[test]
fn searches_lines_and_orbits_are_planned_from_places() {
    let folder = folder_with(&[("field.geojson", FIELD)]);
    let run = |arguments: &[&str]| {
        let all = [&["plan"], arguments, &["--home", HOME, "--vehicles", "2"]].concat();
        sortie_in(folder.path(), &all)
    };
    let line = "50.4512,30.5240 50.4525,30.5245 50.4535,30.5225";
    for arguments in [
        ["search", "square", "--datum", "50.452,30.5234"].as_slice(),
        &[
            "search",
            "sector",
            "--datum",
            "50.452,30.5234",
            "--radius",
            "60",
        ],
        &["search", "creeping", "field.geojson", "--spacing", "40"],
        &["line", "--points", line],
        &["orbit", "--datum", "50.452,30.5234", "--turns", "1"],
    ] {
        let output = run(arguments);
        let said = text(&output.stdout);
        assert_eq!(
            output.status.code(),
            Some(0),
            "{arguments:?}: {said}{}",
            text(&output.stderr)
        );
        assert!(said.contains("landed"), "{said}");
    }
    for (arguments, wanted) in [
        (
            ["survey", "--points", "50.45,30.52 50.45,30.52"].as_slice(),
            "no extent",
        ),
        (&["line", "field.geojson"], "no line"),
        (&["orbit"], "--datum"),
    ] {
        let output = run(arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        assert!(
            text(&output.stderr).contains(wanted),
            "{}",
            text(&output.stderr)
        );
    }
}

#[test]
fn plans_are_compared_with_the_ground() {
    // Ground at 170 m, except for a hill of 100 m in the north.
    let side = 1201;
    let height = |row: usize| {
        if row < side * 11 / 20 - 59 {
            270_i16
        } else {
            170
        }
    };
    let ground: Vec<u8> = (0..side)
        .flat_map(|row| std::iter::repeat_n(height(row).to_be_bytes(), side))
        .flatten()
        .collect();
    let far = good().replace("50.4511\t30.5248", "50.5350\t30.5248");
    let folder = folder_with(&[("near.waypoints", &good()), ("far.waypoints", &far)]);
    fs::create_dir(folder.path().join("srtm")).expect("a folder");
    fs::write(folder.path().join("srtm/N50E030.hgt"), &ground).expect("written");
    let check = |arguments: &[&str]| {
        let all = [&["plan", "check"], arguments, &["--terrain", "srtm"]].concat();
        sortie_in(folder.path(), &all)
    };
    let near = check(&["near.waypoints"]);
    let said = text(&near.stdout);
    assert_eq!(near.status.code(), Some(0), "{said}");
    assert!(said.contains("lowest height above ground: 20 m"), "{said}");
    let low = check(&["near.waypoints", "--clearance", "25"]);
    assert_eq!(low.status.code(), Some(1), "{}", text(&low.stdout));
    let hill = check(&["far.waypoints"]);
    let said = text(&hill.stdout);
    assert_eq!(hill.status.code(), Some(1), "{said}");
    assert!(
        said.contains("far.waypoints:5:1") && said.contains("into the ground"),
        "{said}"
    );
    let flown = [
        "plan",
        "rehearse",
        "near.waypoints",
        "--terrain",
        "srtm",
        "--clearance",
        "25",
    ];
    let flown = sortie_in(folder.path(), &flown);
    assert_eq!(flown.status.code(), Some(1), "{}", text(&flown.stdout));
    assert!(
        text(&flown.stderr).contains("above the ground"),
        "{}",
        text(&flown.stderr)
    );
    fs::write(folder.path().join("srtm/N50E030.hgt"), &ground[1..]).expect("written");
    let broken = check(&["near.waypoints"]);
    assert_eq!(broken.status.code(), Some(2), "{}", text(&broken.stdout));
}
