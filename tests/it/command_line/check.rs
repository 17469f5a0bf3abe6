//! `sortie check`: files and folders, scripts beside their missions.

use std::fs;

use super::{folder_with, sortie, sortie_in, text};

#[test]
fn a_wrong_field_is_pointed_at_with_exit_code_2() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("wrong.toml");
    let mission = fs::read_to_string("missions/01-air-sample.toml").expect("it is there");
    fs::write(&path, mission.replace("time_limit", "time_limt")).expect("written");
    let path = path.to_str().expect("a plain path");
    let output = sortie(&["run", path, "--pilot", "01-air-sample"]);
    assert_eq!(output.status.code(), Some(2));
    let said = text(&output.stderr);
    assert!(
        said.contains("time_limt") && said.contains("time_limit"),
        "{said}"
    );
    assert!(said.contains("wrong.toml:"), "{said}");
    let checked = sortie(&["check", path]);
    assert_eq!(checked.status.code(), Some(1));
    assert!(
        text(&checked.stdout).contains("wrong.toml:"),
        "{}",
        text(&checked.stdout)
    );
}

#[test]
fn a_script_may_name_places_that_only_its_mission_knows() {
    let folder = folder_with(&[
        (
            "good.pilot",
            "all goto pad\nall goto A1 up 20\nall home B2 180\n",
        ),
        ("bad.pilot", "all goto A1 sideways 20\n"),
    ]);
    let check = |name| sortie(&["check", folder.path().join(name).to_str().expect("plain")]);
    let good = check("good.pilot");
    assert_eq!(good.status.code(), Some(0), "{}", text(&good.stdout));
    let bad = check("bad.pilot");
    assert_eq!(bad.status.code(), Some(1), "{}", text(&bad.stdout));
    assert!(
        text(&bad.stdout).contains("sideways"),
        "{}",
        text(&bad.stdout)
    );
}

#[test]
fn a_script_that_belongs_to_a_mission_is_checked_with_its_places_and_vehicles() {
    let mission = include_str!("../../../missions/01-air-sample.toml");
    let wrong = "all goto mastt\n9 arm\n";
    let folder = folder_with(&[
        ("missions/01-air-sample.toml", mission),
        ("missions/pilots/01-mine.pilot", wrong),
        ("elsewhere/any.pilot", wrong),
    ]);
    let path = |name: &str| folder.path().join(name).display().to_string();
    let any = path("elsewhere/any.pilot");
    let whole = path("missions");
    for arguments in [
        vec![whole.as_str()],
        vec![&path("missions/pilots/01-mine.pilot")],
        vec![&path("missions/01-air-sample.toml"), &any],
    ] {
        let arguments = [vec!["check"], arguments].concat();
        let checked = sortie(&arguments);
        let said = text(&checked.stdout);
        assert_eq!(checked.status.code(), Some(1), "{said}");
        assert!(
            said.contains("pilot:1:10: ") && said.contains("mastt"),
            "{said}"
        );
        assert!(said.contains("pilot:2:1: "), "{said}");
    }
}

#[test]
fn one_unreadable_file_does_not_hide_the_others() {
    let folder = folder_with(&[("bad.pilot", "all fly\n"), ("good.pilot", "all arm\n")]);
    let path = |name| folder.path().join(name).display().to_string();
    let output = sortie(&[
        "check",
        &path("nowhere.toml"),
        &path("bad.pilot"),
        &path("good.pilot"),
    ]);
    let (said, found) = (text(&output.stderr), text(&output.stdout));
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert!(said.contains("nowhere.toml"), "{said}");
    assert!(found.contains("bad.pilot:1:5"), "{found}");
    assert!(found.contains("good.pilot: good"), "{found}");
}

#[test]
fn files_are_checked_in_the_language_of_the_user() {
    let folder = folder_with(&[("bad.pilot", "all foo\n"), ("good.pilot", "all arm\n")]);
    let path = folder.path().to_str().expect("plain");
    let checked = sortie(&["check", path, "--lang", "uk"]);
    let found = text(&checked.stdout);
    assert!(found.contains("bad.pilot:1:5: невідома команда"), "{found}");
    assert!(found.contains("good.pilot: помилок немає"), "{found}");
}

#[test]
fn faults_of_missions_are_in_the_language_of_the_user() {
    let checked = sortie(&["check", "tests/data/bad_missions", "--lang", "uk"]);
    let found = text(&checked.stdout);
    assert!(found.contains("bad-id.toml:2:6: id завдання"), "{found}");
    for english in [" must ", "unknown ", "missing ", "more than"] {
        assert!(!found.contains(english), "{english}: {found}");
    }
}

/// Replacements that break the first mission, each in another way.
const BREAKS: [(&str, &str); 20] = [
    ("tier = 0", "tier = = 0"),
    ("tier = 0", "tier = \"easy\""),
    ("tier = 0", "tier = easy"),
    ("tier = 0", "tier = 0.5.1"),
    ("tags = [\"basics\"]", "tags = [\"basics\""),
    ("tags = [\"basics\"]", "tags = 3"),
    ("[sim]", "[sim"),
    ("time_limit = 300", "time_limit = []"),
    ("origin = {", "origin = [1, 2] #"),
    ("kind = \"geofence\"", "kind = \"fnce\""),
    ("kind = \"arm_time\"", "kind = \"arm\""),
    ("pads = [[0, 0]]", "pads = [[0, \"x\"]]"),
    ("max_vehicles = 1", "max_vehicles.x = 1"),
    ("credits = 200", "credits = -5"),
    ("within = 60", "within = true"),
    ("until = \"met('hover')\"", "until = \"met('hovr')\""),
    ("until = \"met('hover')\"", "until = \"t > \""),
    ("until = \"met('hover')\"", "until = \"vehicle(9).armed\""),
    (
        "until = \"met('hover')\"",
        "until = \"mode_any([LNAD]) or x\"",
    ),
    ("until = \"met('hover')\"", "until = \"t + 'a' > 3\""),
];

#[test]
fn no_english_is_left_in_ukrainian_faults_of_a_mission() {
    let mission = include_str!("../../../missions/00-first-flight.toml");
    let folder = tempfile::tempdir().expect("a temporary folder");
    for (number, (good, bad)) in BREAKS.iter().enumerate() {
        let broken = mission.replacen(good, bad, 1);
        assert_ne!(broken, mission, "{good}");
        fs::write(folder.path().join(format!("{number}.toml")), broken).expect("written");
    }
    let path = folder.path().display().to_string();
    let checked = sortie(&["check", &path, "--lang", "uk"]);
    let found = text(&checked.stdout);
    for (number, broken) in BREAKS.iter().enumerate() {
        let place = format!("{path}/{number}.toml:");
        let lines: Vec<&str> = found.lines().filter(|it| it.starts_with(&place)).collect();
        // One fault each, without others that follow from it.
        assert_eq!(lines.len(), 1, "{broken:?}: {lines:#?}");
        // What is typed or listed is the same in every language.
        let said = lines[0][place.len()..].split("; відомі:").next();
        let said: String = said
            .unwrap_or_default()
            .split(['`', '"'])
            .step_by(2)
            .collect();
        let mut words = said.split(|c: char| !c.is_alphabetic());
        let english = words.find(|word| word.len() > 2 && word.is_ascii() && *word != "TOML");
        assert_eq!(english, None, "{}", lines[0]);
    }
}

#[test]
fn an_error_of_the_syntax_is_shown_with_its_place_in_the_line() {
    let folder = folder_with(&[
        ("designs/lab.toml", "schema = 1\nname = = 3\n"),
        ("themes/lab.toml", "inherits = dark\n"),
    ]);
    let checked = sortie(&["check", folder.path().to_str().expect("plain")]);
    let found = text(&checked.stdout);
    let lines: Vec<&str> = found.lines().collect();
    assert!(
        lines[0].ends_with("designs/lab.toml:2:8: one `=` too many"),
        "{found}"
    );
    assert_eq!(lines[1..3], ["  name = = 3", "         ^"], "{found}");
    assert!(
        lines[3].contains("themes/lab.toml:1:12: expected a value"),
        "{found}"
    );
    assert_eq!(
        lines[4..],
        ["  inherits = dark", "             ^"],
        "{found}"
    );
}

#[test]
fn a_folder_does_not_hide_the_mission_of_the_same_name() {
    let folder = folder_with(&[("01/notes.txt", "mine")]);
    let output = sortie_in(folder.path(), &["run", "01", "--pilot", "nobody"]);
    let said = text(&output.stderr);
    assert!(said.contains("no pilot script `nobody`"), "{said}");
}

#[test]
fn a_folder_is_checked_with_all_that_lies_below_it() {
    let folder = folder_with(&[
        ("good.pilot", "all arm\n"),
        ("drills/bad.pilot", "all fly\n"),
        ("drills/deeper/bad.toml", "schema = 1\nid = \"x\"\n"),
        ("notes.txt", "mine"),
    ]);
    let path = folder.path().to_str().expect("plain");
    let checked = sortie(&["check", path]);
    let found = text(&checked.stdout);
    assert_eq!(checked.status.code(), Some(1), "{found}");
    for line in ["good.pilot: good", "bad.pilot:1:5", "bad.toml:1:1"] {
        assert!(found.contains(line), "{line}: {found}");
    }
    assert!(!found.contains("notes.txt"), "{found}");
    let good = sortie(&["check", "missions/drills"]);
    let found = text(&good.stdout);
    assert_eq!(good.status.code(), Some(0), "{found}");
    assert_eq!(found.lines().count(), 21, "{found}");
}

#[test]
fn a_faulty_design_has_faults_of_a_design_and_an_unknown_file_says_so() {
    let folder = folder_with(&[
        (
            "lab.toml",
            "schema = 1\nname = \"Lab\"\n[parts]\nframe = \"x\"\n",
        ),
        ("odd.toml", "id = \"lab\"\ntitle = \"Lab\"\n[parts]\n"),
    ]);
    let checked = sortie(&["check", folder.path().to_str().expect("plain")]);
    let found = text(&checked.stdout);
    assert_eq!(checked.status.code(), Some(1), "{found}");
    assert!(
        found.contains("lab.toml:3:2: unknown key `parts`"),
        "{found}"
    );
    assert!(
        found.contains("odd.toml:1:1: unknown kind of file"),
        "{found}"
    );
    assert!(!found.contains("objectives` is missing"), "{found}");
}

/// A file with settings of the class was once read as a keymap of the room of that name.
#[test]
fn a_file_of_settings_is_known_by_its_tables() {
    let folder = folder_with(&[
        ("config2.toml", "[class]\ntake_over = true\n"),
        ("keys2.toml", "[class]\nz = \"freeze\"\n"),
    ]);
    let checked = sortie(&["check", folder.path().to_str().expect("plain")]);
    let found = text(&checked.stdout);
    assert!(found.contains("config2.toml: good"), "{found}");
    assert!(found.contains("keys2.toml:2:"), "a keymap: {found}");
}

#[test]
fn the_second_mission_with_an_id_is_a_fault_and_a_replacement_is_none() {
    let mission = include_str!("../../../missions/01-air-sample.toml");
    let folder = folder_with(&[
        ("a/01-air-sample.toml", mission),
        ("b/01-air-sample.toml", mission),
        ("b/copy.toml", mission),
    ]);
    let checked = sortie(&["check", folder.path().to_str().expect("plain")]);
    let found = text(&checked.stdout);
    assert_eq!(checked.status.code(), Some(1), "{found}");
    let faults: Vec<&str> = found.lines().filter(|it| it.contains("already")).collect();
    assert_eq!(faults.len(), 1, "{found}");
    assert!(faults[0].contains("copy.toml:3:6: the mission "), "{found}");
    assert!(
        faults[0].contains("a/01-air-sample.toml has the id"),
        "{found}"
    );
}

#[test]
fn a_mission_with_the_id_of_a_shipped_one_is_noted() {
    let mission = include_str!("../../../missions/01-air-sample.toml");
    let notes = "id = \"01-air-sample\"\n";
    let folder = folder_with(&[("mine.toml", mission), ("notes.toml", notes)]);
    let path = |name: &str| folder.path().join(name).display().to_string();
    let checked = sortie(&["check", &path("mine.toml")]);
    let found = text(&checked.stdout);
    assert_eq!(checked.status.code(), Some(0), "{found}");
    assert!(
        found.contains("mine.toml:3:6: the mission 01-air-sample.toml has the id"),
        "{found}"
    );
    assert!(found.contains("mine.toml: good"), "{found}");
    // Another kind of file with this id is no mission.
    let checked = sortie(&["check", &path("notes.toml"), &path("mine.toml")]);
    let found = text(&checked.stdout);
    assert!(!found.contains("already"), "{found}");
}

#[test]
fn a_mission_that_cannot_be_read_is_named_with_the_reason() {
    let folder = folder_with(&[("sortie/missions/pilots/none", "")]);
    let missions = folder.path().join("sortie/missions");
    std::os::unix::fs::symlink("/nowhere/53.toml", missions.join("53-gone.toml")).expect("linked");
    fs::write(missions.join("54-odd.toml"), [0xFF, 0xFE]).expect("written");
    let run = |name| {
        let output = sortie_in(folder.path(), &["run", name, "--pilot", "00"]);
        text(&output.stderr)
    };
    let gone = run("53");
    assert!(
        gone.contains("53-gone.toml is a link to /nowhere/53.toml, which"),
        "{gone}"
    );
    let odd = run("54");
    assert!(
        odd.contains("54-odd.toml") && !odd.contains("no mission"),
        "{odd}"
    );
    let path = missions.join("53-gone.toml");
    let checked = sortie(&["check", path.to_str().expect("plain")]);
    let said = text(&checked.stderr);
    assert!(said.contains("is a link to /nowhere/53.toml"), "{said}");
}

#[test]
fn everything_that_ships_is_good() {
    let mut files: Vec<String> = Vec::new();
    for folder in ["missions", "missions/pilots", "themes"] {
        let entries = fs::read_dir(folder).expect("the folder is there").flatten();
        files.extend(
            entries
                // The schema beside the missions is not a file to check.
                .filter(|entry| {
                    entry
                        .path()
                        .extension()
                        .is_some_and(|ending| ending != "json")
                })
                .map(|entry| entry.path().display().to_string()),
        );
    }
    let mut arguments = vec!["check"];
    arguments.extend(files.iter().map(String::as_str));
    let output = sortie(&arguments);
    assert_eq!(
        output.status.code(),
        Some(0),
        "{}{}",
        text(&output.stdout),
        text(&output.stderr)
    );
}

#[test]
fn a_lesson_plan_is_known_by_its_keys_and_checked_with_missions_beside_it() {
    let mission = include_str!("../../../missions/01-air-sample.toml");
    let own = mission.replace("id = \"01-air-sample\"", "id = \"50-own\"");
    let lesson = |mission: &str, then: &str| {
        format!(
            "schema = 1\ntitle = \"A\"\nabout = \"B\"\n[[steps]]\nid = \"a\"\ntext = \"T\"\n\
             do = [\"fly {mission}\"]\nthen = \"{then}\"\n"
        )
    };
    let folder = folder_with(&[
        ("50-own.toml", own.as_str()),
        ("good.toml", lesson("50-own", "end").as_str()),
        ("bad.toml", lesson("51-none", "b").as_str()),
    ]);
    let checked = sortie(&["check", folder.path().to_str().expect("plain")]);
    let found = text(&checked.stdout);
    assert_eq!(checked.status.code(), Some(1), "{found}");
    assert!(found.contains("good.toml: good"), "{found}");
    assert!(
        found.contains("good.toml:2:9: in English only") && found.contains("not a fault"),
        "{found}"
    );
    assert!(
        found.contains("bad.toml:7:7: there is no mission `51-none`"),
        "{found}"
    );
    assert!(
        found.contains("bad.toml:8:8: there is no step `b`"),
        "{found}"
    );
}

#[test]
fn an_exam_is_known_by_its_keys_and_flies_missions_of_the_course() {
    let exam = |mission: &str, more: &str| {
        format!(
            "schema = 1\ntitle = \"A\"\nabout = \"B\"\n[[missions]]\nmission = \"{mission}\"\n\
             tries = 2\nminutes = 10\n{more}"
        )
    };
    let folder = folder_with(&[
        ("good.toml", exam("00", "").as_str()),
        ("bad.toml", exam("51-none", "").as_str()),
        ("hints.toml", exam("00", "hints = true\n").as_str()),
    ]);
    let checked = sortie(&["check", folder.path().to_str().expect("plain")]);
    let found = text(&checked.stdout);
    assert_eq!(checked.status.code(), Some(1), "{found}");
    assert!(found.contains("good.toml: good"), "{found}");
    assert!(
        found.contains("bad.toml:5:11: no mission of the course is called “51-none”"),
        "{found}"
    );
    assert!(found.contains("hints.toml:8:1"), "{found}");
}
