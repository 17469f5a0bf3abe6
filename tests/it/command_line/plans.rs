//! `sortie plan`: checks, conversions and rehearsals of files.

use std::fs;

use super::{folder_with, sortie_in, text};

/// A waypoint file: takeoff, a place north and one east of home, return.
fn waypoints(home: (f64, f64), places: [(f64, f64); 2]) -> String {
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

fn good() -> String {
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
    // `sortie check` knows the files as well.
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
    // Nothing is lost without a word.
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
fn a_rehearsal_finds_the_vehicles_that_meet_and_a_proposal_keeps_them_apart() {
    // Two ways that cross half-way.
    let one = waypoints((50.4501, 30.5234), [(50.4510, 30.5248), (50.4510, 30.5248)]);
    let two = waypoints((50.4501, 30.5248), [(50.4510, 30.5234), (50.4510, 30.5234)]);
    let folder = folder_with(&[("one.waypoints", &one), ("two.waypoints", &two)]);
    let run = |arguments: &[&str]| sortie_in(folder.path(), arguments);
    let output = run(&[
        "plan",
        "rehearse",
        "one.waypoints",
        "two.waypoints",
        "--json",
    ]);
    assert_eq!(output.status.code(), Some(1), "{}", text(&output.stderr));
    let found: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
    assert_eq!(found["vehicles"][1]["vehicle"], 2);
    assert_eq!(found["closest"][0]["conflict"], true, "{found}");
    let alone = run(&["plan", "rehearse", "one.waypoints", "--wind", "5,270"]);
    assert_eq!(alone.status.code(), Some(0), "{}", text(&alone.stdout));
    assert!(
        text(&alone.stdout).contains("landed"),
        "{}",
        text(&alone.stdout)
    );
    let apart = run(&[
        "plan",
        "deconflict",
        "one.waypoints",
        "two.waypoints",
        "--write",
        "apart",
    ]);
    assert_eq!(apart.status.code(), Some(0), "{}", text(&apart.stdout));
    assert!(
        folder.path().join("apart/two.waypoints").is_file(),
        "{}",
        text(&apart.stdout)
    );
    assert!(!folder.path().join("apart/one.waypoints").exists());
}
