//! Mission files: the shipped ones are valid, faulty ones are refused with position and reason.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use sortie::mission::{Mission, Unlock};
use sortie::scoring::Medal;
use sortie::text::{Language, Locale};

mod basics;
mod faults;
mod guide;
mod mutants;

/// The refusal of each file in `tests/data/bad_missions`: one fault each, without consequential
/// faults.
const REFUSALS: &[&str] = &[
    "bad-id.toml:2:6: a mission's id is 1 to 40 lower-case letters, digits and `-`",
    "callsign-empty.toml:53:36: a callsign is 1 to 8 characters",
    "callsign.toml:53:34: only an aircraft has a callsign, not the person",
    "checked-nothing.toml:49:1: `checked` needs `dwell` or `crossings`, or every report would count",
    "duplicate-id.toml:41:6: the id `cells` is used twice",
    "far-point.toml:19:10: `source` must lie within 20000 m of the origin, as [east, north]",
    "gate-form.toml:50:18: a gate reads `NAME >= NUMBER`, with `>=`, `<=` or `==`",
    "gate-name.toml:50:18: unknown name `safty` in `gold_requires` (did you mean `safety`?)",
    "hazard-kind.toml:18:8: unknown hazard kind `vulcano`; known: ..",
    "heights.toml:36:11: `heights` must be a list of two ascending numbers, 0 to 1000 m",
    "infinite.toml:21:8: `rate` must lie between 0.000001 and 1000000, not inf",
    "latitude.toml:9:18: `lat` must lie between -85 and 85, not 95",
    "medals.toml:50:10: medals must rise from bronze to gold, up to 1000",
    "missing-field.toml:1:1: missing field `brief`",
    "missing-section.toml:1:1: the section `scoring` is missing",
    "nan.toml:11:18: `speed` must lie between 0 and 60, not NaN",
    "no-cell.toml:33:8: no cell of this size has its centre in the zone",
    "nothing-mandatory.toml:27:1: at least one objective must be `mandatory`, or the mission can never be passed",
    "objective-kind.toml:30:8: unknown objective kind `sample_cell`; known: .. (did you mean `sample_cells`?)",
    "pads.toml:25:8: 2 vehicles need 2 pads, not 1",
    "par-above-limit.toml:50:16: the par time must be shorter than `time_limit`",
    "partial-reversed.toml:47:16: `partial_from` must be above `target`: less is better here",
    "sensor-not-fitted.toml:32:10: unknown sensor of the fleet `s_pm25`; known: ..",
    "stability.toml:22:13: unknown value `G`; known: ..",
    "syntax.toml:8:14: one `=` too many",
    "target-above-cells.toml:37:10: `target` must lie between 1 and the 9 cells of the zone",
    "time-limit.toml:8:14: `time_limit` must lie between 10 and 86400, not 1e300",
    "too-many-cells.toml:33:8: 1000 x 1000 cells are more than 10000; make `cell` larger",
    "two-corners.toml:15:11: `polygon` must have 3 to 1000 entries",
    "two-shapes.toml:12:1: a zone has either `polygon`, or `center` and `radius`",
    "unknown-field.toml:8:1: unknown field `time_limt`; known: .. (did you mean `time_limit`?)",
    "unknown-key.toml:4:1: unknown key `titel` (did you mean `title`?)",
    "unknown-section.toml:10:2: unknown key `wether` (did you mean `weather`?)",
    "unknown-sensor.toml:26:12: unknown sensor `s_vox`; known: .. (did you mean `s_voc`?)",
    "unknown-survey.toml:44:6: unknown earlier sample_cells objective `cell`; known: .. (did you mean `cells`?)",
    "unknown-zone.toml:31:8: unknown task zone `yrad`; known: .. (did you mean `yard`?)",
    "weights.toml:50:11: the weights must sum to 1, not 0.900",
    "wrong-schema.toml:1:10: this program reads schema 1 only",
    "wrong-type.toml:8:14: expected a number, not the text \"8 min\"",
    "zone-kind.toml:14:8: unknown zone kind `tusk`; known: .. (did you mean `task`?)",
];

fn folder(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(name)
}

fn faults(path: &Path) -> Vec<String> {
    let source = std::fs::read_to_string(path).expect("the file is there");
    let name = path
        .file_name()
        .expect("a file")
        .to_string_lossy()
        .into_owned();
    match Mission::parse(&source) {
        Ok(_) => Vec::new(),
        Err(faults) => faults
            .iter()
            .map(|fault| without_list(&fault.one_line(&name, &source)))
            .collect(),
    }
}

/// A line without the list of known names, which grows as kinds are added.
fn without_list(line: &str) -> String {
    let Some((start, list)) = line.split_once("; known: ") else {
        return line.to_owned();
    };
    let help = list.find(" (did you mean").map_or("", |at| &list[at..]);
    format!("{start}; known: ..{help}")
}

fn toml_files(folder: &Path) -> BTreeSet<PathBuf> {
    let entries = std::fs::read_dir(folder).expect("the folder is there");
    let paths = entries.map(|entry| entry.expect("readable").path());
    paths
        .filter(|path| {
            path.extension()
                .is_some_and(|extension| extension == "toml")
        })
        .collect()
}

#[test]
fn bad_missions_are_refused_with_the_place_and_the_reason() {
    let found: Vec<String> = toml_files(&folder("tests/data/bad_missions"))
        .iter()
        .flat_map(|path| faults(path))
        .collect();
    for (found, expected) in found.iter().zip(REFUSALS) {
        assert_eq!(found, expected);
    }
    assert_eq!(found.len(), REFUSALS.len());
}

#[test]
fn the_file_that_the_bad_ones_are_made_from_is_good() {
    assert_eq!(
        faults(&folder("tests/data/good_mission.toml")),
        Vec::<String>::new()
    );
}

fn noted(source: &str) -> Vec<String> {
    let mission = Mission::parse(source).expect("no faults");
    let notes = mission.file.untranslated.iter();
    notes.map(|note| note.one_line("m.toml", source)).collect()
}

#[test]
fn shipped_missions_speak_both_languages_and_what_is_left_out_is_named() {
    let source = std::fs::read_to_string(folder("missions/01-air-sample.toml")).expect("there");
    assert_eq!(noted(&source), Vec::<String>::new());
    let ukrainian = Locale::new(Language::Ukrainian);
    let listing = Mission::parse(&source).expect("no faults").listing();
    assert_eq!(ukrainian.text(&listing.title), "Проба повітря");
    let without: Vec<&str> = source
        .lines()
        .filter(|line| !line.starts_with("title_uk = \"карта газу"))
        .collect();
    let without = without.join("\n");
    let notes = noted(&without);
    assert_eq!(notes.len(), 1, "{notes:?}");
    assert!(notes[0].contains("no `title_uk`"), "{notes:?}");
    let listing = Mission::parse(&without).expect("no faults").listing();
    assert_eq!(
        ukrainian.text(&listing.objectives[1].title),
        "gas map at 20 m"
    );
}

#[test]
fn a_mission_in_english_only_is_good_and_gets_one_note() {
    let source = std::fs::read_to_string(folder("tests/data/good_mission.toml")).expect("there");
    let notes = noted(&source);
    assert_eq!(notes.len(), 1, "{notes:?}");
    assert!(notes[0].contains("in English only"), "{notes:?}");
}

#[test]
fn faults_of_translations_are_named_at_their_place() {
    let source = std::fs::read_to_string(folder("tests/data/good_mission.toml")).expect("there");
    let title = source
        .lines()
        .position(|line| line.starts_with("title"))
        .expect("a title");
    let with = |line: &str| {
        let mut lines: Vec<&str> = source.lines().collect();
        lines.insert(title + 1, line);
        let source = lines.join("\n");
        let faults = Mission::parse(&source).expect_err("a fault");
        let faults: Vec<String> = faults
            .iter()
            .map(|fault| fault.one_line("m.toml", &source))
            .collect();
        faults.join("; ")
    };
    let place = format!("m.toml:{}:", title + 2);
    for (line, fault) in [
        ("title_uk = 3", "expected text in quotes, not `3`"),
        ("title_ua = \"x\"", "did you mean `title_uk`?"),
        ("brief_uk = \" \"", "`brief_uk` is empty"),
    ] {
        let found = with(line);
        assert!(
            found.starts_with(&place) && found.contains(fault),
            "{found}"
        );
    }
}

#[test]
fn shipped_missions_are_good_and_named_like_their_files() {
    for path in toml_files(&folder("missions")) {
        assert_eq!(faults(&path), Vec::<String>::new());
        let source = std::fs::read_to_string(&path).expect("read before");
        let mission = Mission::parse(&source).expect("no faults");
        assert_eq!(
            path.file_stem().and_then(|stem| stem.to_str()),
            Some(mission.id.as_str())
        );
    }
}

/// Independent faults do not hide each other.
#[test]
fn all_faults_of_a_file_are_reported_at_once() {
    let source =
        std::fs::read_to_string(folder("tests/data/good_mission.toml")).expect("it is there");
    let broken = source
        .replace("time_limit = 480", "time_limit = 0")
        .replace("rate = 20", "rate = -1")
        .replace("dwell = 5", "dwel = 5");
    let faults = Mission::parse(&broken).expect_err("three faults");
    let lines: Vec<usize> = faults
        .iter()
        .map(|fault| fault.line_column(&broken).0)
        .collect();
    assert_eq!(lines, [8, 21, 34]);
}

/// The shipped missions and drills, by file name.
fn shipped() -> Vec<(String, String)> {
    let paths = toml_files(&folder("missions")).into_iter();
    let paths = paths.chain(toml_files(&folder("missions/drills")));
    let read = |path: PathBuf| {
        let name = path.file_stem().expect("a file").to_string_lossy();
        let source = std::fs::read_to_string(&path).expect("it is there");
        (name.into_owned(), source)
    };
    paths.map(read).collect()
}

#[test]
fn shipped_missions_and_drills_make_sense_and_name_missions_that_exist() {
    let known: BTreeSet<String> = shipped().into_iter().map(|(name, _)| name).collect();
    let mut wrong = Vec::new();
    for (name, source) in shipped() {
        let mission = Mission::parse(&source).unwrap_or_else(|faults| panic!("{name}: {faults:?}"));
        let faults = mission.check().into_iter();
        let faults = faults.chain(mission.unknown_missions(&known));
        wrong.extend(faults.map(|fault| fault.one_line(&name, &source)));
        assert_eq!(
            mission.summary.drill_of.is_some(),
            name.starts_with('d'),
            "{name}"
        );
        assert_eq!(Mission::id_of(&source), Some(name));
    }
    assert_eq!(wrong, Vec::<String>::new());
}

#[test]
fn a_mission_that_others_name_and_nobody_has_is_a_fault_at_its_place() {
    let source = std::fs::read_to_string(folder("tests/data/good_mission.toml")).expect("there");
    let source = source.replace(
        "[sim]",
        "[requires]\nmissions = [\"00-first-fligt\"]\nmedals = { nobody = \"gold\" }\n[sim]",
    );
    let known = BTreeSet::from(["00-first-flight".to_owned()]);
    let faults = Mission::parse(&source)
        .expect("good")
        .unknown_missions(&known);
    let lines: Vec<String> = faults
        .iter()
        .map(|fault| fault.one_line("m", &source))
        .collect();
    assert!(
        lines[0].ends_with("unknown mission `00-first-fligt` (did you mean `00-first-flight`?)"),
        "{lines:?}"
    );
    assert!(lines[1].ends_with("unknown mission `nobody`"), "{lines:?}");
}

#[test]
fn what_a_mission_asks_of_a_career_and_gives_to_it_is_read() {
    let source = std::fs::read_to_string(folder("tests/data/good_mission.toml")).expect("there");
    let listing = Mission::parse(&source).expect("good").listing();
    assert!(listing.pausable && listing.outlay.budget.is_none());
    let source = source.replace(
        "[fleet]",
        "[requires]\nmissions = [\"a\"]\nmedals = { b = \"silver\" }\nskills = { K6 = 0.6 }\n\
         [rewards]\ncredits = 900\nunlock = [\"part:s_gpr\", \"mission:c\", \"threat:gust\"]\n\
         [rules]\npause = false\n[fleet]\nbudget = 9000\nloaner = [\"scout-450\"]",
    );
    let listing = Mission::parse(&source).expect("good").listing();
    assert!(!listing.pausable);
    assert_eq!(listing.outlay.budget, Some(9000));
    assert_eq!(listing.outlay.loaners, ["scout-450"]);
    assert_eq!(listing.requires.missions, ["a"]);
    assert_eq!(listing.requires.medals["b"], Medal::Silver);
    assert!((listing.requires.skills["K6"] - 0.6).abs() < 1e-9);
    assert_eq!((listing.rewards.credits, listing.rewards.xp_tier), (900, 0));
    let unlock = [
        Unlock::Part("s_gpr".to_owned()),
        Unlock::Mission("c".to_owned()),
        Unlock::Threat("gust".to_owned()),
    ];
    assert_eq!(listing.rewards.unlock, unlock);
}

#[test]
fn what_a_mission_lists_has_its_gates() {
    for (id, count) in [("00-first-flight", 3), ("02-formation", 3)] {
        let path = format!("missions/{id}.toml");
        let source = std::fs::read_to_string(path).expect("it ships");
        let listing = Mission::parse(&source).expect("it is good").listing();
        let gates = (1..=count).map(|number| format!("gate{number}"));
        for gate in gates {
            assert!(listing.places.contains_key(&gate), "{id}: {gate}");
        }
    }
}

/// The battery charge that a brief states, in percent, in English or Ukrainian.
fn battery_in(brief: &str) -> Option<f64> {
    let brief = brief.split_whitespace().collect::<Vec<_>>().join(" ");
    let number = |text: &str| text.split(' ').next_back().and_then(|it| it.parse().ok());
    if let Some((before, _)) = brief.split_once(" % battery") {
        return number(before);
    }
    let (_, after) = brief.split_once("із зарядом ")?;
    let (before, _) = after.split_once(" %")?;
    number(before)
}

#[test]
fn the_battery_in_a_brief_is_the_one_that_the_rules_require() {
    let ukrainian = Locale::new(Language::Ukrainian);
    let mut named = 0;
    let folders = ["missions", "missions/drills"].map(folder);
    for path in folders.iter().flat_map(|it| toml_files(it)) {
        let source = std::fs::read_to_string(&path).expect("readable");
        let mission = Mission::parse(&source).expect("no faults");
        let brief = mission.listing().brief;
        let mut lines = source.lines();
        let required: f64 = lines
            .find_map(|line| line.strip_prefix("land_reserve_pct = ")?.parse().ok())
            .expect("a reserve");
        for text in [brief.to_string(), ukrainian.text(&brief)] {
            let Some(percent) = battery_in(&text) else {
                continue;
            };
            named += 1;
            assert!(
                (percent - required).abs() < 0.01,
                "{}: {text}",
                path.display()
            );
        }
    }
    assert!(named >= 20, "{named}");
}
