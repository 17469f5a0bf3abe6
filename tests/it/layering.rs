//! The layers of the architecture, read from the sources: dependencies point down only.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// Libraries of the workspace: pure, and below every module of the program.
const LIBRARIES: &[&[&str]] = &[&["geo", "wire", "sim"]];
/// Pure modules of the program, lowest first: each may use those before it (and those of its own line).
const PURE: &[&[&str]] = &[
    &["text"],
    &["diagnostic", "alert", "config"],
    &["parameters", "workshop"],
    &["inspector"],
    &["doctor"],
    &["vehicle"],
    &["notice", "ledger"],
    &["commands", "messages"],
    &["language"],
    &["session", "swarm"],
    &["sitl"],
    &["fidelity", "mission", "scoring", "debrief"],
    &["campaign"],
    &["exercise"],
];
/// Modules with input and output: they may use pure ones, and those before them.
const IO: &[&[&str]] = &[&["store"], &["link"], &["fleet", "hangar"]];
/// The shell, lowest first.
const SHELL: &[&[&str]] = &[&["app"], &["ui"], &["terminal"], &["console"], &["cli"]];

/// What pure modules must not touch: time and randomness are arguments, files and sockets are elsewhere.
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

fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("src is readable").flatten() {
        let path = entry.path();
        if path.is_dir() {
            sources(&path, found);
        } else if path.extension().is_some_and(|ending| ending == "rs") {
            found.push(path);
        }
    }
}

/// The code of each top-level module and library, comments and tests left out.
fn modules() -> BTreeMap<String, Vec<(PathBuf, String)>> {
    let top = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut modules = in_folder(&top.join("src"));
    for library in LIBRARIES.concat() {
        let folder = top.join("crates").join(library).join("src");
        let files = in_folder(&folder).into_values().flatten();
        let named = files.map(|(file, code)| (Path::new(library).join(file), code));
        modules.insert(library.to_owned(), named.collect());
    }
    modules
}

/// The same of one folder.
fn in_folder(root: &Path) -> BTreeMap<String, Vec<(PathBuf, String)>> {
    let mut files = Vec::new();
    sources(root, &mut files);
    let mut modules: BTreeMap<String, Vec<(PathBuf, String)>> = BTreeMap::new();
    for file in files {
        let inner = file.strip_prefix(root).expect("below src").to_owned();
        if inner.file_stem().is_some_and(|stem| stem == "tests") {
            continue;
        }
        let first = inner.components().next().expect("a name");
        let module = Path::new(first.as_os_str())
            .file_stem()
            .expect("a name")
            .to_string_lossy()
            .into_owned();
        let text = fs::read_to_string(&file).expect("readable");
        let code: Vec<&str> = text
            .split("#[cfg(test)]\nmod tests {")
            .next()
            .unwrap_or_default()
            .lines()
            .filter(|line| !line.trim_start().starts_with("//"))
            .collect();
        modules
            .entry(module)
            .or_default()
            .push((inner, code.join("\n")));
    }
    modules
}

/// The top-level modules that some code names as `crate::NAME`, also in grouped imports.
fn uses(code: &str) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    for (at, _) in code.match_indices("crate::") {
        let rest = &code[at + "crate::".len()..];
        if let Some(group) = rest.strip_prefix('{') {
            let group = group.split('}').next().unwrap_or_default();
            found.extend(group.split(',').map(first_word));
        } else {
            found.insert(first_word(rest));
        }
    }
    found.remove("");
    found
}

fn first_word(text: &str) -> String {
    text.trim_start()
        .chars()
        .take_while(|c| c.is_alphanumeric() || *c == '_')
        .collect()
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
    // A screen sees state, not the machinery behind it; state knows nothing of its looks.
    let is_bypass = ["app", "ui"].contains(&user) && level(IO, used).is_some();
    is_downwards && !is_bypass
}

#[test]
fn dependencies_point_down() {
    let mut faults = Vec::new();
    for (module, files) in modules() {
        // What a library uses is in its manifest: the compiler enforces that.
        if ["main", "lib"].contains(&module.as_str()) || level(LIBRARIES, &module).is_some() {
            continue;
        }
        assert!(
            level(&all(), &module).is_some(),
            "{module} has no layer: add it to this test"
        );
        for (file, code) in files {
            for used in uses(&code) {
                if used != module && level(&all(), &used).is_some() && !allowed(&module, &used) {
                    faults.push(format!("{}: {module} uses {used}", file.display()));
                }
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn pure_modules_touch_neither_clock_nor_world() {
    let mut faults = Vec::new();
    for (module, files) in modules() {
        if !is_pure(&module) {
            continue;
        }
        for (file, code) in files {
            for impure in IMPURE {
                let touched = code.match_indices(impure).any(|(at, _)| {
                    !code[..at].ends_with(|c: char| c.is_alphanumeric() || c == '_')
                        && !code[at + impure.len()..]
                            .starts_with(|c: char| c.is_alphanumeric() || c == '_')
                });
                if touched {
                    faults.push(format!("{}: {impure}", file.display()));
                }
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn input_and_output_know_nothing_of_the_screen() {
    for (module, files) in modules() {
        if level(IO, &module).is_some() {
            for (file, code) in files {
                assert!(!code.contains("ratatui::"), "{}: ratatui", file.display());
                assert!(
                    !code.contains("crossterm::"),
                    "{}: crossterm",
                    file.display()
                );
            }
        }
    }
}

#[test]
fn screens_see_only_the_state_of_the_app() {
    for (file, code) in modules().remove("ui").unwrap_or_default() {
        for (at, _) in code.match_indices("crate::app::") {
            let part = first_word(&code[at + "crate::app::".len()..]);
            let seen = ["state", "room", "keymap", "console"].contains(&part.as_str());
            assert!(seen, "{}: app::{part}", file.display());
        }
    }
}

#[test]
fn the_reader_of_imports_sees_groups_and_paths() {
    let code = "use crate::{geo::LatLon, wire};\nlet x = crate::link::open();";
    let names: Vec<String> = uses(code).into_iter().collect();
    assert_eq!(names, ["geo", "link", "wire"]);
}
