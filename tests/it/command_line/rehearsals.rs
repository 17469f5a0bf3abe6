//! `sortie plan rehearse` and `sortie plan deconflict`.

use std::fs;

use super::plans::{good, waypoints};
use super::{folder_with, sortie_in, text};

#[test]
fn a_rehearsal_finds_the_vehicles_that_meet_and_a_proposal_keeps_them_apart() {
    // Two paths that cross half-way.
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
    let said = text(&apart.stdout);
    assert!(said.contains("even if one is 3 s late"), "{said}");
    // A complete set is written, which can be rehearsed as it is.
    let both = ["apart/one.waypoints", "apart/two.waypoints"];
    for file in both {
        assert!(folder.path().join(file).is_file(), "{file}: {said}");
    }
    let flown = run(&[&["plan", "rehearse"], &both[..]].concat());
    let said = text(&flown.stdout);
    assert_eq!(flown.status.code(), Some(0), "{said}");
    assert!(!said.contains("s late"), "{said}");
}

#[test]
fn a_vehicle_that_leaves_its_plan_is_said_to_with_the_name_of_the_mode() {
    let far = waypoints((50.4501, 30.5234), [(50.4510, 30.5248), (50.4519, 30.5262)]);
    let folder = folder_with(&[("far.waypoints", &far)]);
    let fence = [
        "FENCE_ENABLE=1",
        "FENCE_TYPE=2",
        "FENCE_RADIUS=100",
        "FENCE_ACTION=2",
    ];
    let parameters = fence.map(|it| ["--param", it]).concat();
    let rehearse = [&["plan", "rehearse", "far.waypoints"], &parameters[..]].concat();
    let flown = sortie_in(folder.path(), &rehearse);
    let said = text(&flown.stdout);
    assert_eq!(flown.status.code(), Some(1), "{said}");
    assert!(said.contains("left its plan for LAND"), "{said}");
    assert!(said.contains("breached at"), "{said}");
}

/// A plan into the ground and a plan without an end fail; heights above terrain need the ground.
#[test]
fn rehearsals_fail_for_plans_that_do_not_land() {
    let low = good().replace("50.4511\t30.5248\t20", "50.4511\t30.5248\t-110");
    let lines = good();
    let lines = lines.trim_end().lines().collect::<Vec<_>>();
    let open = lines[..lines.len() - 1].join("\n");
    let follows = good().replace("\t3\t16\t", "\t10\t16\t");
    assert!(low != good() && follows != good());
    let files = [
        ("low.waypoints", low.as_str()),
        ("open.waypoints", &open),
        ("follows.waypoints", &follows),
    ];
    let folder = folder_with(&files);
    let rehearse = |file| {
        let output = sortie_in(folder.path(), &["plan", "rehearse", file, "--json"]);
        let said = format!("{}{}", text(&output.stdout), text(&output.stderr));
        (output.status.code(), said)
    };
    for (file, ending) in [("low.waypoints", "crashed"), ("open.waypoints", "in_air")] {
        let (code, said) = rehearse(file);
        assert_eq!(code, Some(1), "{said}");
        assert!(
            said.contains(&format!("\"ending\": \"{ending}\"")),
            "{said}"
        );
    }
    let (code, said) = rehearse("follows.waypoints");
    assert_eq!(code, Some(0), "{said}");
    assert!(
        said.contains("ground is level") && said.contains("--terrain"),
        "{said}"
    );
    let checked = sortie_in(folder.path(), &["plan", "check", "low.waypoints"]);
    assert_eq!(checked.status.code(), Some(1), "{}", text(&checked.stdout));
}

/// A rehearsal is a recording like that of a flight: replays and exports read it.
#[test]
fn a_rehearsal_is_written_as_a_recording() {
    let folder = folder_with(&[("one.waypoints", &good()), ("two.waypoints", &good())]);
    let run = |arguments: &[&str]| sortie_in(folder.path(), arguments);
    let files = ["plan", "rehearse", "one.waypoints", "two.waypoints"];
    let recorded = [&files[..], &["--tlog", "flown.tlog"]].concat();
    let flown = run(&recorded);
    assert_eq!(flown.status.code(), run(&files).status.code());
    let again = run(&recorded);
    assert_eq!(again.status.code(), Some(2), "a file that exists is kept");
    let export = ["records", "export", "flown.tlog", "--format", "csv"];
    let exported = run(&[&export[..], &["--output", "tables"]].concat());
    assert_eq!(
        exported.status.code(),
        Some(0),
        "{}",
        text(&exported.stderr)
    );
    let tables = fs::read_dir(folder.path().join("tables")).expect("a folder");
    let names: Vec<String> = tables
        .map(|it| {
            it.expect("a file")
                .file_name()
                .to_string_lossy()
                .into_owned()
        })
        .collect();
    let has = |wanted: &str| names.iter().any(|name| name.contains(wanted));
    assert!(
        has("GLOBAL_POSITION_INT") && has("MISSION_CURRENT"),
        "{names:?}"
    );
}
