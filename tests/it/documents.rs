//! README and documents name only existing things: files, headings, rooms, subcommands, options, verbs, settings and
//! variables, checked against the program's own tables.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use clap::CommandFactory as _;
use clap::error::ErrorKind;
use sortie::app::state::Room;
use sortie::cli::CliArguments;
use sortie::config::SETTINGS;
use sortie::language;
use sortie::text::Locale;
use sortie::workshop::{Design, PartSlot};

mod markdown;

use markdown::{Document, Fence};

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

fn documents() -> Vec<Document> {
    let folder = fs::read_dir(root().join("docs")).expect("the documents");
    let mut paths: Vec<PathBuf> = folder.flatten().map(|entry| entry.path()).collect();
    paths.retain(|path| path.extension().is_some_and(|ending| ending == "md"));
    paths.push(root().join("README.md"));
    paths.sort();
    paths.into_iter().map(Document::read).collect()
}

fn document(name: &str) -> Document {
    Document::read(root().join(name))
}

/// Checks all documents; fails with the faults of all of them, if there are any.
fn all_are_right(check: impl Fn(&Document) -> Vec<String>) {
    let wrong: Vec<String> = documents()
        .iter()
        .flat_map(|document| {
            let faults = check(document).into_iter();
            faults.map(|fault| format!("{}: {fault}", document.path.display()))
        })
        .collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

fn broken(document: &Document, link: &str) -> Option<String> {
    let (file, anchor) = link.split_once('#').unwrap_or((link, ""));
    let folder = document.path.parent().unwrap_or(Path::new(""));
    let target = match file {
        "" => document.path.clone(),
        file => folder.join(file),
    };
    if !target.exists() {
        return Some(format!("{link}: no such file"));
    }
    let is_there = anchor.is_empty() || Document::read(target).anchors().contains(anchor);
    (!is_there).then(|| format!("{link}: no such heading"))
}

#[test]
fn links_lead_to_files_and_headings() {
    all_are_right(|document| {
        let links = document.links().into_iter();
        let inner = links.filter(|link| !link.contains("://"));
        inner.filter_map(|link| broken(document, &link)).collect()
    });
}

/// The fault of a command line that begins with `sortie`: an unknown subcommand, option or choice.
/// Placeholders and later parts of a shell line are not checked.
fn unknown_to_the_program(line: &str) -> Option<String> {
    let words = line
        .split_whitespace()
        .take_while(|word| !word.starts_with(['|', '>', '<', '#', '&']));
    let error = CliArguments::command().try_get_matches_from(words).err()?;
    let is_wrong = matches!(
        error.kind(),
        ErrorKind::UnknownArgument | ErrorKind::InvalidSubcommand | ErrorKind::InvalidValue
    );
    is_wrong.then(|| format!("{line}: {}", error.kind()))
}

#[test]
fn command_lines_are_understood() {
    all_are_right(|document| {
        let fences = document.fences("sh");
        let lines = fences.iter().flat_map(|fence| fence.text.lines());
        let lines = lines.map(|line| line.trim_start_matches("target/release/").to_owned());
        let all = lines.chain(document.spans());
        let ours = all.filter(|line| line.split(' ').next() == Some("sortie"));
        ours.filter_map(|line| unknown_to_the_program(&line))
            .collect()
    });
}

/// Every option of the program and of its subcommands.
fn options(command: &clap::Command) -> BTreeSet<String> {
    let own = command.get_arguments().filter_map(clap::Arg::get_long);
    let mut all: BTreeSet<String> = own.map(|name| format!("--{name}")).collect();
    all.insert("--help".to_owned());
    for below in command.get_subcommands() {
        all.extend(options(below));
    }
    all
}

#[test]
fn options_exist() {
    let known = options(&CliArguments::command());
    all_are_right(|document| {
        let spans = document.spans().into_iter();
        let options = spans.filter(|span| span.starts_with("--"));
        options
            .filter(|span| {
                let name = span.split([' ', '=']).next().unwrap_or_default();
                !known.contains(name)
            })
            .collect()
    });
}

/// Whether a line of the console begins with a verb or a mode's name, with or without targets before it.
fn begins_with_a_verb(line: &str) -> bool {
    let mut words = language::words(line).into_iter();
    let word = words.find(|word| !word.is_targets());
    word.is_some_and(|word| {
        let name = word.text.to_lowercase();
        language::row(&name).is_some()
            || language::said(&name, &language::Context::default()).is_ok()
    })
}

/// The console's lines in a document: those in its tables of commands, and those that begin with a colon.
fn console_lines(document: &Document) -> Vec<String> {
    let rows = document.rows_below("command").into_iter();
    let lines = rows.filter(|row| !row[0].starts_with("sortie"));
    let fences = document.fences("");
    let typed = fences.iter().flat_map(|fence| fence.text.lines());
    let typed = typed.filter_map(|line| line.strip_prefix(':'));
    lines.flatten().chain(typed.map(str::to_owned)).collect()
}

#[test]
fn verbs_exist() {
    let lines: usize = documents().iter().map(|it| console_lines(it).len()).sum();
    assert!(lines > 40, "only {lines} lines found");
    all_are_right(|document| {
        let lines = console_lines(document).into_iter();
        lines.filter(|line| !begins_with_a_verb(line)).collect()
    });
}

#[test]
fn every_verb_is_in_the_guides() {
    let guides = ["commands", "console", "replay", "scripting"];
    let texts = guides.map(|name| document(&format!("docs/{name}.md")).text);
    let code = texts
        .iter()
        .flat_map(|text| text.split('`').skip(1).step_by(2));
    let named: BTreeSet<&str> = code.flat_map(str::split_whitespace).collect();
    let unnamed = language::rows().filter(|row| !named.iter().any(|word| row.is_called(word)));
    let unnamed: Vec<_> = unnamed.map(|row| row.verb.name).collect();
    assert_eq!(unnamed, [""; 0]);
}

#[test]
fn every_room_has_a_row() {
    let locale = Locale::default();
    let rows = document("docs/console.md").rows();
    for room in Room::ALL {
        let key = room.key().to_string();
        let title = locale.text(&room.title());
        let row = rows
            .iter()
            .find(|row| row.starts_with(&format!("| `{key}`")));
        let row = row.unwrap_or_else(|| panic!("no row for the key {key}"));
        let name = row.split('|').nth(2).unwrap_or_default().trim();
        assert!(name.eq_ignore_ascii_case(&title), "{name}, not {title}");
    }
}

fn variables(text: &str) -> BTreeSet<String> {
    let pieces = text.split(|c: char| !(c.is_ascii_uppercase() || c == '_'));
    let ours = pieces.filter(|piece| piece.starts_with("SORTIE_"));
    ours.map(str::to_owned).collect()
}

#[test]
fn variables_exist() {
    let sources = markdown::sources(&[root().join("src"), root().join("tests")]);
    all_are_right(|document| {
        let named = variables(&document.text).into_iter();
        let is_known = |name: &String| {
            let mut settings = SETTINGS.iter();
            settings.any(|setting| setting.variable == Some(name))
                || sources.contains(&format!("\"{name}\""))
        };
        named.filter(|name| !is_known(name)).collect()
    });
}

/// The examples of settings, keys and themes pass `sortie check`, which checks every name.
#[test]
fn examples_of_the_configuration_are_valid() {
    let folder = tempfile::tempdir().expect("a folder");
    let fences = document("docs/configuration.md").fences("toml");
    assert_eq!(fences.len(), 3, "settings, keys, a theme");
    let names = ["config.toml", "keymap.toml", "themes/harbour.toml"];
    let settings = folder.path().join("sortie");
    fs::create_dir_all(settings.join("themes")).expect("a folder");
    let mut check = Command::new(env!("CARGO_BIN_EXE_sortie"));
    check.env("XDG_CONFIG_HOME", folder.path()).arg("check");
    for (Fence { text, .. }, name) in fences.iter().zip(names) {
        let path = settings.join(name);
        fs::write(&path, text).expect("a file");
        check.arg(path);
    }
    let output = check.output().expect("it runs");
    let said = String::from_utf8_lossy(&output.stdout);
    assert!(output.status.success(), "{said}");
}

/// The example of a design is read, and the table below it has a row for each of its keys.
#[test]
fn the_example_of_a_design_is_valid_and_its_table_complete() {
    let text = document("docs/workshop.md");
    let fences = text.fences("toml");
    let [example] = &fences[..] else {
        panic!("one example, not {}", fences.len());
    };
    let design = Design::from_toml(&example.text).expect("no faults");
    let written = design.to_toml();
    assert_eq!(written.trim_end(), example.text.trim_end());
    let head = "| key | value | meaning |\n| --- | --- | --- |\n";
    let (_, table) = text.text.split_once(head).expect("the table");
    let rows = table.lines().take_while(|line| line.starts_with('|'));
    let keys: Vec<&str> = rows.filter_map(|row| row.split('`').nth(1)).collect();
    let slots = PartSlot::ALL.map(PartSlot::key);
    let expected: Vec<&str> = ["schema", "name"].into_iter().chain(slots).collect();
    assert_eq!(keys, expected);
}

#[test]
fn the_table_of_the_simulator_lists_what_it_has() {
    use sortie_sim::{Chassis, Inventory, VehicleKind};
    let text = fs::read_to_string(root().join("docs/simulator.md")).expect("the document");
    let rover = Inventory::of(VehicleKind::Rover(Chassis::Ackermann));
    for (head, inventory) in [
        (
            "| what | names |\n| --- | --- |\n",
            Inventory::read().to_string(),
        ),
        ("| of a rover | names |\n| --- | --- |\n", rover.conduct()),
    ] {
        let (_, table) = text.split_once(head).expect("the table");
        let rows: Vec<_> = table
            .lines()
            .take_while(|line| line.starts_with('|'))
            .collect();
        let expected: Vec<_> = inventory.lines().collect();
        assert_eq!(
            rows, expected,
            "take the rows of `cargo run -p sortie-sim --example inventory`"
        );
    }
}
