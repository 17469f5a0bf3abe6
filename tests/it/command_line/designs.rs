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
    assert!(
        told.lines().skip(1).all(|line| line.starts_with("  + ")),
        "{told}"
    );
    let lacks = sortie(&["workshop", "fit", "starter", "05"]);
    let told = text(&lacks.stdout);
    assert_eq!(lacks.status.code(), Some(1), "{told}");
    assert!(told.contains("  x thermal camera 160x120"), "{told}");
}
