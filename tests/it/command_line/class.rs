//! The results of a class on the command line.

use super::*;

/// A folder with the data of an instructor: in the class 9-A, two users have handed in the same flight by script.
fn class_folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let run = ["run", "00", "--pilot", "00", "--record", "rec", "--json"];
    let output = sortie_in(folder.path(), &run);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let record = fs::read_dir(folder.path().join("rec"))
        .expect("recorded")
        .flatten()
        .map(|entry| entry.path())
        .find(|path| path.to_string_lossy().ends_with(".run.jsonl"))
        .expect("the run");
    let name = record.file_name().expect("a name").to_string_lossy();
    for user in ["anna", "=cmd"] {
        let own = folder.path().join("sortie/classes/9-A").join(user);
        fs::create_dir_all(&own).expect("created");
        fs::copy(&record, own.join(&*name)).expect("copied");
        let submission = name.replace(".run.jsonl", ".submission.json");
        fs::write(own.join(submission), "{}").expect("written");
    }
    folder
}

/// The configuration may be the administrator's, and meant for others.
#[test]
fn a_class_in_the_configuration_that_cannot_be_joined_is_only_reported() {
    let configuration = "[class]\njoin = \"nowhere.join\"\n";
    let folder = folder_with(&[("sortie/config.toml", configuration)]);
    let fly = ["fly", "--plain", "--vehicles", "1"];
    let output = sortie_in(folder.path(), &fly);
    let said = text(&output.stdout) + &text(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{said}");
    assert!(
        said.contains("`class.join` in the configuration cannot be used"),
        "{said}"
    );
    let named = [&fly[..], &["--class", "nowhere.join"]].concat();
    let output = sortie_in(folder.path(), &named);
    assert_eq!(output.status.code(), Some(2), "{}", text(&output.stderr));
}

#[test]
fn a_new_class_does_not_get_the_name_of_one_that_has_records() {
    let folder = class_folder();
    let output = sortie_in(folder.path(), &["class", "new", "9-A"]);
    let said = text(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{said}");
    assert!(
        said.contains("sortie/classes/9-A has records of an earlier class 9-A"),
        "{said}"
    );
}

#[test]
fn a_class_is_reported_and_exported_and_no_file_is_replaced() {
    let folder = class_folder();
    let sortie = |arguments: &[&str]| sortie_in(folder.path(), arguments);
    let report = sortie(&["class", "report", "9-A"]);
    assert_eq!(report.status.code(), Some(0), "{}", text(&report.stderr));
    assert!(text(&report.stdout).contains("Class 9-A: 2 trainees"));
    let document = sortie(&["class", "report", "9-A", "--json"]);
    let document: serde_json::Value = serde_json::from_slice(&document.stdout).expect("JSON");
    assert_eq!(document["trainees"][1]["user"], "anna");
    assert_eq!(document["trainees"][1]["practice"], 1, "a script flew it");

    let export = ["class", "export", "9-A", "--output", "out", "--format"];
    let xapi = [&export[..], &["xapi"]].concat();
    assert_eq!(sortie(&xapi).status.code(), Some(0));
    let written = fs::read_to_string(folder.path().join("out")).expect("written");
    assert_eq!(written.lines().count(), 2);
    assert!(written.contains("http://adlnet.gov/expapi/verbs/completed"));
    for format in ["xapi", "csv", "moodle", "md"] {
        let again = sortie(&[&export[..], &[format]].concat());
        assert_eq!(again.status.code(), Some(1), "{format}");
        assert!(text(&again.stderr).contains("already exists"));
    }
    let kept = fs::read_to_string(folder.path().join("out")).expect("still there");
    assert_eq!(kept, written);

    let grades = [
        "class", "export", "9-A", "--output", "-", "--format", "moodle",
    ];
    assert_eq!(
        text(&sortie(&grades).stdout),
        "username\r\n'=cmd\r\nanna\r\n"
    );
    let pages = [
        "class", "export", "9-A", "--output", "pages", "--format", "md",
    ];
    assert_eq!(sortie(&pages).status.code(), Some(0));
    let page = fs::read_to_string(folder.path().join("pages/anna.md")).expect("a page");
    assert!(page.starts_with("# anna\n"), "{page}");
    // Its skills are "not tried", which needs a reason.
    let (_, uncounted) = page
        .split_once("## Flights that do not count")
        .expect("a section");
    let row = uncounted
        .lines()
        .find(|line| line.contains("00-first-flight"));
    assert!(
        row.is_some_and(|row| row.contains("flown for practice")),
        "{page}"
    );
}

#[test]
fn a_class_without_records_is_refused_and_others_are_named() {
    let folder = folder_with(&[("sortie/classes/9-A/anna/x", "")]);
    let output = sortie_in(folder.path(), &["class", "report", "9-B"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(
        text(&output.stderr).contains("9-A"),
        "{}",
        text(&output.stderr)
    );
    let wrong = [
        "class", "export", "9-A", "--format", "xapi", "--output", "-",
    ];
    let wrong = [&wrong[..], &["--home-page", "lab"]].concat();
    assert_eq!(sortie_in(folder.path(), &wrong).status.code(), Some(2));
}

#[test]
fn the_lessons_are_listed_and_those_with_faults_named() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let listed = sortie_in(folder.path(), &["class", "lessons"]);
    let found = text(&listed.stdout);
    assert_eq!(listed.status.code(), Some(0), "{found}");
    for name in ["alerts-under-load", "exam-day", "first-lesson"] {
        assert!(found.contains(&format!("{name}: ")), "{found}");
    }
    let own = folder.path().join("sortie/lessons");
    fs::create_dir_all(&own).expect("created");
    fs::write(own.join("mine.toml"), "schema = 1\n").expect("written");
    let listed = sortie_in(folder.path(), &["class", "lessons"]);
    assert_eq!(listed.status.code(), Some(1));
    let said = text(&listed.stderr);
    assert!(said.contains("mine.toml:1:1: "), "{said}");
}

/// The grades of a grader for the flight of anna.
fn grades_of(grader: &str, marks: [(&str, u8); 3]) -> String {
    let grades = marks
        .map(|(element, mark)| format!("[grades.{element}]\nmark = {mark}\ntext = \"=seen\"\n"));
    let grades = grades.concat();
    format!("rubric = \"notechs\"\ngrader = \"{grader}\"\n{grades}")
}

#[test]
fn grades_are_shown_compared_and_exported_and_the_score_stays() {
    let folder = class_folder();
    let own = folder.path().join("sortie/classes/9-A/anna");
    let names = fs::read_dir(&own).expect("there").flatten();
    let record = names
        .map(|it| it.file_name().to_string_lossy().into_owned())
        .find_map(|name| name.strip_suffix(".run.jsonl").map(str::to_owned))
        .expect("a record");
    let sortie = |arguments: &[&str]| sortie_in(folder.path(), arguments);
    let none = sortie(&["class", "grades", "9-A"]);
    assert!(text(&none.stdout).contains("No flight of the class has been graded"));
    let before = text(&sortie(&["class", "report", "9-A"]).stdout);

    let petra = [("planning", 5), ("standards", 3), ("workload", 2)];
    let petro = [("planning", 2), ("standards", 3), ("choice", 4)];
    for (grader, marks) in [("petra", petra), ("petro", petro)] {
        let path = own.join(format!("{record}.grades.notechs.{grader}.toml"));
        fs::write(path, grades_of(grader, marks)).expect("written");
    }
    let shown = sortie(&["class", "grades", "9-A"]);
    let shown = text(&shown.stdout);
    assert!(
        shown.contains("petra and petro: 2 ratings by both, 1 equal"),
        "{shown}"
    );
    assert!(shown.contains("Plans and coordinates: 5 and 2"), "{shown}");
    let document = sortie(&["class", "grades", "9-A", "--json"]);
    let document: serde_json::Value = serde_json::from_slice(&document.stdout).expect("JSON");
    assert_eq!(document["agreement"][0]["mean_difference"], -1.5);
    assert_eq!(document["sheets"][1]["grades"]["choice"]["mark"], 4);

    let table = [
        "class", "export", "9-A", "--output", "-", "--format", "grades",
    ];
    let table = text(&sortie(&table).stdout);
    assert_eq!(table.lines().count(), 7, "{table}");
    assert!(table.contains("'=seen"), "no formulas: {table}");
    let after = text(&sortie(&["class", "report", "9-A"]).stdout);
    assert_eq!(before, after, "grades change no score");

    fs::write(
        own.join(format!("{record}.grades.notechs.ivan.toml")),
        "mark = 9",
    )
    .expect("written");
    let broken = sortie(&["class", "grades", "9-A"]);
    assert_eq!(broken.status.code(), Some(1));
    assert!(text(&broken.stderr).contains("cannot be read"));
}

#[test]
fn the_rubrics_are_listed_and_checked() {
    let folder = folder_with(&[("sortie/rubrics/mine.toml", "schema = 1\n")]);
    let listed = sortie_in(folder.path(), &["class", "rubrics"]);
    assert_eq!(listed.status.code(), Some(1));
    assert!(text(&listed.stderr).contains("mine.toml:1:1"));
    assert!(text(&listed.stdout).contains("notechs: Non-technical skills"));
    let rubric = include_str!("../../../rubrics/notechs.toml");
    let files = [("own.toml", rubric.replace("\"idle\"", "\"idel\""))];
    let [(name, content)] = &files;
    fs::write(folder.path().join(name), content).expect("written");
    let checked = sortie_in(folder.path(), &["check", name]);
    assert_eq!(checked.status.code(), Some(1));
    let said = text(&checked.stdout) + &text(&checked.stderr);
    assert!(
        said.contains("own.toml:47:13") && said.contains("idle"),
        "{said}"
    );
}

#[test]
fn a_class_of_simulated_seats_is_measured() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let bench = [
        "bench",
        "class",
        "--simulated",
        "--seats",
        "2",
        "--seconds",
        "4",
        "--json",
    ];
    let output = sortie_in(folder.path(), &bench);
    let said = text(&output.stderr);
    let cost: serde_json::Value =
        serde_json::from_slice(&output.stdout).unwrap_or_else(|_| panic!("no document: {said}"));
    assert_eq!(cost["carrier"], "unix");
    // Two rounds, each with an order to two seats and one command; a busy machine may be late with them.
    for (delays, expected) in [("order", 4), ("board", 2)] {
        let part = |name: &str| cost[delays][name].as_u64();
        let all = part("count").zip(part("lost")).map(|(a, b)| a + b);
        assert_eq!(all, Some(expected), "{cost}");
    }
    assert!(cost["traffic_bytes_per_s"].as_f64() > Some(0.0), "{cost}");
}
