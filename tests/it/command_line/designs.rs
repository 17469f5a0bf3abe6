//! Missions flown with drones of the workshop.

use super::*;

const RUN: [&str; 5] = ["run", "01", "--pilot", "01-air-sample", "--json"];

#[test]
fn a_mission_is_flown_with_a_design_by_name_or_file() {
    let folder = folder_with(&[("mine.toml", include_str!("../../../designs/starter.toml"))]);
    let document = |more: &[&str]| {
        let output = sortie_in(folder.path(), &[&RUN[..], &["--no-timing"], more].concat());
        assert!(output.status.success(), "{}", text(&output.stderr));
        text(&output.stdout)
    };
    let own = document(&[]);
    let by_name = document(&["--design", "starter"]);
    assert_eq!(by_name, document(&["--design", "mine.toml"]));
    assert_ne!(own, by_name, "another drone flies otherwise");
}

#[test]
fn a_design_that_cannot_fly_a_mission_is_refused_with_what_and_where() {
    let faulty = include_str!("../../../designs/starter.toml");
    let motors = faulty.replace("motor = \"m2212_920\"\n", "");
    let unknown = faulty.replace("m2212_920", "m2212_921");
    let folder = folder_with(&[("bare.toml", &motors), ("odd.toml", &unknown)]);
    for (designs, said) in [
        (
            &["--design", "bare.toml"][..],
            "01-air-sample: Starter 450: ",
        ),
        (&["--design", "odd.toml"], "odd.toml:4:"),
        (&["--design", "nobody"], "nobody"),
        (&["--design", "starter,scout"], "1 seat"),
        (&["--design", "starter", "--frame", "any.json"], "--frame"),
    ] {
        let output = sortie_in(folder.path(), &[&RUN[..], designs].concat());
        assert_eq!(output.status.code(), Some(2), "{designs:?}");
        assert!(
            text(&output.stderr).contains(said),
            "{}",
            text(&output.stderr)
        );
    }
}

#[test]
fn what_a_mission_needs_is_told_beside_what_a_design_has() {
    let fits = sortie(&["workshop", "fit", "starter", "01"]);
    let told = text(&fits.stdout);
    assert!(fits.status.success() && told.contains("seats 1"), "{told}");
    let mut needs = told.lines().skip(1).take_while(|line| !line.is_empty());
    assert!(needs.all(|line| line.starts_with("  + ")), "{told}");
    assert!(told.ends_with("none: it can fly\n"), "{told}");
    let lacks = sortie(&["workshop", "fit", "starter", "05"]);
    let told = text(&lacks.stdout);
    assert_eq!(lacks.status.code(), Some(1), "{told}");
    assert!(told.contains("  x thermal camera 160x120"), "{told}");
}

#[test]
fn the_fit_of_a_design_names_its_own_faults() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("bare.toml");
    let starter = include_str!("../../../designs/starter.toml");
    let bare: Vec<&str> = starter
        .lines()
        .filter(|line| !line.contains("propeller"))
        .collect();
    fs::write(&file, bare.join("\n")).expect("written");
    let output = sortie(&["workshop", "fit", &file.display().to_string(), "01"]);
    let told = text(&output.stdout);
    assert_eq!(output.status.code(), Some(1), "{told}");
    let fault = told.lines().last().unwrap_or_default();
    assert!(
        fault.starts_with("  x ") && fault.contains("propellers"),
        "{told}"
    );
}

#[test]
fn robots_and_boats_are_shown_fitted_exported_and_driven() {
    let folder = tempfile::tempdir().expect("a folder");
    let said = |arguments: &[&str]| {
        let output = sortie_in(folder.path(), arguments);
        assert!(output.status.success(), "{}", text(&output.stderr));
        text(&output.stdout)
    };
    let shown = said(&["workshop", "show", "sapper"]);
    for word in ["chassis", "driving time", "slope", "none: it can drive"] {
        assert!(shown.contains(word), "{word}: {shown}");
    }
    let json = said(&["workshop", "show", "lifeboat", "--json"]);
    let shown: serde_json::Value = serde_json::from_str(&json).expect("a document");
    assert_eq!(shown["kind"], "boat");
    assert!(
        shown["figures"]["drive_time_s"].as_f64() > Some(600.0),
        "{json}"
    );
    let compared = said(&["workshop", "compare", "starter", "sapper"]);
    assert!(compared.contains("hover time") && compared.contains("driving time"));
    said(&["workshop", "export", "sapper"]);
    let written = std::fs::read_to_string(folder.path().join("sapper-930.parm"));
    let written = written.expect("it is written");
    for name in [
        "CRUISE_SPEED",
        "WP_SPEED",
        "BATT_CAPACITY",
        "SERVO3_MAX",
        "SIM_BATT_CAP_AH",
    ] {
        assert_eq!(
            written.lines().filter(|it| it.starts_with(name)).count(),
            1,
            "{written}"
        );
    }
    assert!(!folder.path().join("sapper-930.json").exists());
    let flown = [
        "run",
        "17",
        "--pilot",
        "17-boat-rescue",
        "--json",
        "--design",
        "lifeboat",
    ];
    let report: serde_json::Value = serde_json::from_str(&said(&flown)).expect("a document");
    assert_eq!(report["passed"], true, "{report}");
}

#[test]
fn a_robot_for_a_drone_and_a_drone_for_a_boat_are_refused() {
    for (arguments, said) in [
        (
            [
                "run",
                "01",
                "--pilot",
                "01-air-sample",
                "--design",
                "sapper",
            ],
            "ground robot",
        ),
        (
            [
                "run",
                "18",
                "--pilot",
                "18-robot-lane",
                "--design",
                "lifeboat",
            ],
            "drone, ground robot",
        ),
    ] {
        let output = sortie(&arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        assert!(
            text(&output.stderr).contains(said),
            "{}",
            text(&output.stderr)
        );
    }
    let fits = sortie(&["workshop", "fit", "starter", "18"]);
    assert!(
        text(&fits.stdout).contains("kind of vehicle"),
        "{}",
        text(&fits.stdout)
    );
}
