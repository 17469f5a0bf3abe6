//! The layers of the architecture, read from the sources: dependencies point down only, and within a module or a crate
//! they make no cycles, at any depth.

use std::collections::{BTreeMap, BTreeSet};

use sortie::app::room::Room;
use sources::{ModuleSource, blanked, modules, paths, uses, without_tests};

mod sources;

/// Libraries of the workspace: pure, and below every module of the program.
const LIBRARIES: &[&[&str]] = &[&["class", "geo", "plan", "wire", "sim", "rehearsal"]];
/// Pure modules of the program, lowest first: each may use those before it (and those of its own line).
const PURE: &[&[&str]] = &[
    &["hash", "text", "verb"],
    &["vehicle_id"],
    &["class_text", "pilot_in_command"],
    &["crew"],
    &["diagnostic", "alert", "config"],
    &["preflight", "draft"],
    &["parameters", "workshop"],
    &["inspector", "metadata", "signing"],
    &["doctor"],
    &["vehicle"],
    &["notice", "ledger", "moment"],
    &["dataflash"],
    &["commands", "messages", "forward"],
    &["language"],
    &["session", "swarm"],
    &["record"],
    &["sitl"],
    &["fidelity", "mission", "scoring", "debrief"],
    &["campaign", "comparison", "review"],
    &["exam_seal"],
    &["class_results", "lesson_plan"],
    &["exam_plan", "grading"],
    &["operator"],
    &["exercise"],
];
/// Modules with input and output: they may use pure ones, and those before them.
const IO: &[&[&str]] = &[&["store"], &["link"], &["fleet", "hangar", "carrier"]];
/// The shell, lowest first.
const SHELL: &[&[&str]] = &[
    &["app"],
    &["api", "replay"],
    &["ui"],
    &["terminal"],
    &["shell"],
    &["cli"],
];

/// Items that pure modules must not use: time and randomness are arguments, files and sockets belong elsewhere.
const IMPURE: &[&str] = &[
    "tokio",
    "ratatui",
    "crossterm",
    "std::fs",
    "std::net",
    "std::thread",
    "std::process",
    "std::env",
    "Instant",
    "SystemTime",
    "rand::rng",
];

/// The code of each top-level module of the program, and of each other crate of the workspace, by file. Crates are
/// re-exported as modules, under their names without `sortie_`.
fn top_level() -> BTreeMap<String, Vec<ModuleSource>> {
    let mut found: BTreeMap<String, Vec<ModuleSource>> = BTreeMap::new();
    for module in modules() {
        let top = match module.path.first() {
            Some(first) if module.package == "sortie" => first.as_str(),
            Some(_) | None => module.package.trim_start_matches("sortie_"),
        };
        found.entry(top.to_owned()).or_default().push(module);
    }
    // Under the program's own name, only the list of modules in `lib.rs` remains.
    found.remove("sortie");
    found
}

/// The top-level modules that a module's code names.
fn used_by(module: &ModuleSource) -> BTreeSet<String> {
    let paths = paths(&module.code, &["crate"]).into_iter();
    paths.filter_map(|path| path.into_iter().nth(1)).collect()
}

fn is_word(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

fn level(layers: &[&[&str]], module: &str) -> Option<usize> {
    layers.iter().position(|line| line.contains(&module))
}

fn all() -> Vec<&'static [&'static str]> {
    [LIBRARIES, PURE, IO, SHELL].concat()
}

fn is_pure(module: &str) -> bool {
    level(LIBRARIES, module).is_some() || level(PURE, module).is_some()
}

fn allowed(user: &str, used: &str) -> bool {
    let is_downwards = level(&all(), user) >= level(&all(), used);
    // A screen uses the state, not the layers behind it; the state does not use its display.
    let is_bypass = ["app", "ui"].contains(&user) && level(IO, used).is_some();
    is_downwards && !is_bypass
}

#[test]
fn dependencies_point_down() {
    let mut faults = Vec::new();
    for (name, modules) in top_level() {
        // The dependencies of a library are in its manifest, and the compiler enforces them.
        if level(LIBRARIES, &name).is_some() {
            continue;
        }
        assert!(
            level(&all(), &name).is_some(),
            "{name} has no layer: add it to this test"
        );
        for module in modules {
            for used in used_by(&module) {
                if used != name && level(&all(), &used).is_some() && !allowed(&name, &used) {
                    faults.push(format!("{}: {name} uses {used}", module.file));
                }
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn the_parts_of_a_module_depend_on_each_other_one_way_only() {
    let mut faults = Vec::new();
    for (parent, uses) in uses(&modules()) {
        let in_cycle = uses
            .iter()
            .filter(|((user, used), _)| reaches(&uses, used, user));
        faults.extend(
            in_cycle.map(|((user, used), file)| format!("{parent}: {user} -> {used} ({file})")),
        );
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

/// Whether one part uses another, directly or through other parts.
fn reaches(uses: &BTreeMap<(String, String), String>, from: &str, to: &str) -> bool {
    let mut seen = BTreeSet::from([from]);
    let mut left = vec![from];
    while let Some(part) = left.pop() {
        if part == to {
            return true;
        }
        let next = uses.keys().filter(|(user, _)| user == part);
        left.extend(
            next.map(|(_, used)| used.as_str())
                .filter(|used| seen.insert(used)),
        );
    }
    false
}

#[test]
fn the_code_map_names_every_module() {
    let root = include_str!("../../src/lib.rs");
    for module in top_level().keys() {
        assert!(root.contains(&format!("[`{module}`]")), "{module}");
    }
}

#[test]
fn pure_modules_touch_neither_clock_nor_world() {
    let mut faults = Vec::new();
    for (name, modules) in top_level() {
        if !is_pure(&name) {
            continue;
        }
        for module in modules {
            let code = &module.code;
            for impure in IMPURE {
                let touched = code.match_indices(impure).any(|(at, _)| {
                    !code[..at].ends_with(is_word)
                        && !code[at + impure.len()..].starts_with(is_word)
                });
                if touched {
                    faults.push(format!("{}: {impure}", module.file));
                }
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn input_and_output_know_nothing_of_the_screen() {
    for (name, modules) in top_level() {
        if level(IO, &name).is_some() {
            for module in modules {
                for screen in ["ratatui::", "crossterm::"] {
                    assert!(!module.code.contains(screen), "{}: {screen}", module.file);
                }
            }
        }
    }
}

#[test]
fn screens_see_only_the_state_of_the_app() {
    for module in top_level().remove("ui").unwrap_or_default() {
        for path in paths(&module.code, &["crate"]) {
            if let [_, first, part, ..] = path.as_slice()
                && first == "app"
            {
                let seen = [
                    "State",
                    "state",
                    "room",
                    "room_list",
                    "action",
                    "keymap",
                    "console",
                ]
                .contains(&part.as_str());
                assert!(seen, "{}: app::{part}", module.file);
            }
        }
    }
}

/// The parts of the state, apart from those of the rooms.
const STATE_PARTS: &[(&str, &str)] = &[
    ("src/app/state.rs", "State"),
    ("src/app/state/flight_view.rs", "FlightView"),
    ("src/app/state/overlay.rs", "Palette"),
    ("src/app/state/overlay.rs", "Confirm"),
    ("src/app/state/overlay.rs", "Prompt"),
    ("src/app/state/notices.rs", "NoticeLog"),
    ("src/app/state/active_alerts.rs", "ActiveAlerts"),
    ("src/app/state/hangar.rs", "Hangar"),
    ("src/app/room.rs", "Rooms"),
];

/// With private fields, the compiler ensures that only `app` changes the state.
#[test]
fn the_fields_of_the_state_are_private_to_the_app() {
    let app = top_level().remove("app").unwrap_or_default();
    let rooms = state_of_rooms();
    assert_eq!(rooms.len(), Room::ALL.len());
    let others = STATE_PARTS
        .iter()
        .map(|(file, name)| ((*file).to_owned(), *name));
    for (file, name) in others.chain(rooms) {
        let module = app.iter().find(|it| it.file == file).expect(&file);
        let declaration = format!("pub struct {name}");
        let mut after_name = module.code.split(&declaration).skip(1);
        let rest = after_name.find(|it| !it.starts_with(is_word)).expect(name);
        let (fields, _) = rest.split_once('}').expect(name);
        assert!(
            !fields.contains(" pub "),
            "{file}: {name} has a public field"
        );
    }
}

/// The file and the type of each room's state, from the lines of the list of rooms:
/// `Map, map, "map", 'M', map::Map;`.
fn state_of_rooms() -> Vec<(String, &'static str)> {
    let list = include_str!("../../src/app/room_list.rs").lines();
    let read = |line: &'static str| {
        let columns: Vec<&str> = line.trim().strip_suffix(';')?.split(", ").collect();
        let [_, module, _, key, _, model] = columns[..] else {
            return None;
        };
        let name = model.rsplit("::").next()?.trim_end_matches('>');
        let file = format!("src/app/room/{module}.rs");
        key.starts_with('\'').then_some((file, name))
    };
    list.filter_map(read).collect()
}

/// [`sortie::app::App`] owns the state; the effects that its update returns must not get lost.
#[test]
fn only_the_queue_of_the_console_updates_the_state() {
    // The benchmark of drawing carries out no effects.
    let known = ["src/cli/bench/frame.rs", "src/shell/effects.rs"];
    let of_program = modules().into_iter().filter(|it| it.package == "sortie");
    let callers = of_program.filter(|it| it.code.contains("app.update("));
    let files: BTreeSet<String> = callers.map(|it| it.file).collect();
    assert_eq!(files, known.map(str::to_owned).into());
}

#[test]
fn the_reader_of_paths_sees_nested_groups() {
    let code = "use crate::{geo::LatLon, wire};\nuse crate::a::{b::{c, d::E}, self as f};\n\
                let x = crate::link::open(); my_crate::no();";
    let found: Vec<String> = paths(code, &["crate"])
        .iter()
        .map(|path| path.join("::"))
        .collect();
    assert_eq!(
        found,
        [
            "crate::geo::LatLon",
            "crate::wire",
            "crate::a::b::c",
            "crate::a::b::d::E",
            "crate::a::self",
            "crate::link::open",
        ]
    );
}

#[test]
fn the_reader_leaves_out_comments_literals_and_tests() {
    let code = "// crate::a\nlet b = \"crate::b \\\" crate::b\"; let c: &'c str = r#\"crate::c\"#; let d = '\"';\n\
                #[cfg(test)]\nmod tests {\n    use crate::e;\n    mod inner {}\n}\n\
                #[cfg(test)]\npub(crate) mod fake;\nuse crate::f;";
    let (code, modules) = without_tests(&blanked(code));
    assert_eq!(modules, ["fake"]);
    let found = paths(&code, &["crate"]);
    assert_eq!(found, [["crate", "f"]], "{code}");
}
