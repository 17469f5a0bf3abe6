//! Configuration, keymaps and themes from the user's point of view.

use std::fs;
use std::os::unix::fs::PermissionsExt as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

mod administrator;
mod bad_files;
mod closed;
mod languages;

use crate::terminal::{Terminal, home_variables, program};

/// A home folder with these files in its configuration folder.
fn home(files: &[(&str, &str)]) -> tempfile::TempDir {
    let home = tempfile::tempdir().expect("a temporary folder");
    for (name, content) in files {
        let path = file(home.path(), name);
        fs::create_dir_all(path.parent().expect("a folder")).expect("created");
        fs::write(path, content).expect("written");
    }
    home
}

fn file(home: &Path, name: &str) -> PathBuf {
    home.join("config/sortie").join(name)
}

fn sortie(home: &Path, variables: &[(&str, &str)], arguments: &[&str]) -> Output {
    let program = program();
    Command::new(&program[0])
        .args(&program[1..])
        .args(arguments)
        .envs(home_variables(home))
        .env("NO_COLOR", "1")
        .envs(variables.iter().copied())
        .output()
        .expect("the program runs")
}

fn console(home: &Path, variables: &[(&str, &str)], arguments: &[&str]) -> Terminal {
    let own = home_variables(home);
    let own = own
        .iter()
        .map(|(name, path)| (*name, path.to_str().expect("plain")));
    let all: Vec<(&str, &str)> = own.chain(variables.iter().copied()).collect();
    Terminal::start_with(arguments, 120, 40, &all)
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// The line that `sortie config` prints for a setting.
fn line_of<'a>(printed: &'a str, key: &str) -> &'a str {
    let mut lines = printed.lines();
    lines
        .find(|line| line.starts_with(&format!("{key} = ")))
        .unwrap_or_else(|| panic!("no {key} in\n{printed}"))
}

#[test]
fn a_value_comes_from_the_flag_then_the_environment_then_the_file() {
    let home = home(&[
        (
            "config.toml",
            "theme = \"light\"\nfps = 20\n\n[alerts]\nbell = false\n",
        ),
        ("themes/mine.toml", "inherits = \"dark\"\n"),
    ]);
    let variables = [
        ("SORTIE_FPS", "5"),
        ("SORTIE_THEME", "monochrome"),
        ("LANG", "uk_UA.UTF-8"),
    ];
    let output = sortie(home.path(), &variables, &["config", "--theme", "mine"]);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let printed = text(&output.stdout);
    let path = file(home.path(), "config.toml");
    let path = path.display();
    let expected = [
        ("theme", "theme = \"mine\" # flag --theme".to_owned()),
        ("fps", "fps = 5 # environment SORTIE_FPS".to_owned()),
        ("lang", "lang = \"uk\" # environment LANG".to_owned()),
        ("bell", format!("bell = false # {path}:5")),
        ("mouse", "mouse = false # default".to_owned()),
    ];
    for (key, line) in expected {
        assert_eq!(line_of(&printed, key), line);
    }
    // By POSIX the first variable decides, even if it names an unsupported language.
    let variables = [("LC_ALL", "C"), ("LANG", "uk_UA.UTF-8")];
    let printed = sortie(home.path(), &variables, &["config"]).stdout;
    assert!(text(&printed).contains("# lang is not set\n"));
}

#[test]
fn what_is_printed_is_a_configuration_that_says_the_same() {
    let home = home(&[(
        "config.toml",
        "symbols = \"ascii\"\n[table]\ncolumns = [\"id\"]\n[macros]\nup = [\"all guided\", \"all takeoff 20\"]\n",
    )]);
    let printed = sortie(home.path(), &[], &["config"]).stdout;
    let copy = file(home.path(), "copy.toml");
    fs::write(&copy, &printed).expect("written");
    let copy = copy.to_str().expect("plain");
    let checked = sortie(home.path(), &[], &["check", copy]);
    assert_eq!(text(&checked.stdout), format!("{copy}: good\n"));
    let again = sortie(home.path(), &[], &["config", "--config", copy]).stdout;
    let values =
        |bytes: &[u8]| -> toml::Table { toml::from_str(&text(bytes)).expect("it is TOML") };
    assert_eq!(values(&again), values(&printed));
}

#[test]
fn the_keys_that_are_printed_are_a_keymap_that_says_the_same() {
    let home = home(&[("keymap.toml", "[anywhere]\nf5 = \"all rtl\"\n")]);
    let printed = text(&sortie(home.path(), &[], &["config", "--keys"]).stdout);
    let copy = file(home.path(), "copy.toml");
    fs::write(&copy, &printed).expect("written");
    let copy = copy.to_str().expect("plain");
    let checked = sortie(home.path(), &[], &["check", copy]);
    assert_eq!(text(&checked.stdout), format!("{copy}: good\n"));
    let again = sortie(
        home.path(),
        &[("SORTIE_KEYMAP", copy)],
        &["config", "--keys"],
    );
    assert_eq!(text(&again.stdout), printed);
    let rows = printed.lines().filter(|line| line.starts_with('"'));
    assert_eq!(rows.count(), 1, "{printed}");
}

#[test]
fn a_faulty_file_is_told_and_the_rest_of_it_counts() {
    let home = home(&[
        ("config.toml", "fps = 20\nthem = \"light\"\n"),
        ("keymap.toml", "[fyl]\nx = \"invert\"\n"),
    ]);
    let output = sortie(home.path(), &[], &["config"]);
    assert_eq!(output.status.code(), Some(2));
    let (printed, said) = (text(&output.stdout), text(&output.stderr));
    assert!(
        line_of(&printed, "fps").starts_with("fps = 20 # "),
        "{printed}"
    );
    assert!(said.contains("config.toml:2:1"), "{said}");
    assert!(said.contains("keymap.toml:1:2"), "{said}");
    let mut terminal = console(home.path(), &[], &["fly"]);
    terminal
        .see("config.toml:2:1: unknown setting")
        .command("quit");
    assert_eq!(terminal.end(), 0);
}

type Pairs<'a> = &'a [(&'a str, &'a str)];

#[test]
fn what_is_named_has_to_be_there_and_right() {
    let home = home(&[("wrong.toml", "fps = 0\n")]);
    let wrong = file(home.path(), "wrong.toml");
    let wrong = wrong.to_str().expect("plain");
    let cases: &[(Pairs<'_>, &[&str], &str)] = &[
        (&[], &["--config", wrong], "wrong.toml:1:7"),
        (&[("SORTIE_CONFIG", wrong)], &[], "wrong.toml:1:7"),
        (&[], &["--config", "nowhere.toml"], "nowhere.toml"),
        (&[("SORTIE_KEYMAP", "nowhere.toml")], &[], "nowhere.toml"),
        (
            &[("SORTIE_FPS", "many")],
            &[],
            "`SORTIE_FPS` must be a whole number",
        ),
        (
            &[],
            &["--fps", "0"],
            "`--fps` must be a whole number from 1 to 60, not `0`",
        ),
        (&[], &["--theme", "drak"], "did you mean `dark`?"),
        (
            &[],
            &["--lang", "de"],
            "`--lang` must be one of en, uk, not `de`",
        ),
        (&[], &["--log-level", "sortie=loud"], "unknown log levels"),
    ];
    for (variables, flags, expected) in cases {
        let arguments = [flags, &["run", "01", "--pilot", "01-air-sample"][..]].concat();
        let output = sortie(home.path(), variables, &arguments);
        let said = text(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{said}");
        assert!(said.contains(expected), "{said}");
        assert!(output.stdout.is_empty(), "nothing was flown");
    }
}

#[test]
fn the_log_has_the_levels_that_were_asked_for() {
    let home = home(&[(
        "config.toml",
        "[log]\nfile = \"sortie.log\"\nlevel = \"off\"\n",
    )]);
    let log = home.path().join("state/sortie/sortie.log");
    let run = ["run", "01", "--pilot", "missions/pilots/01-naive.pilot"];
    sortie(home.path(), &[], &run);
    assert_eq!(
        fs::read_to_string(&log).expect("it is in the folder of the state"),
        ""
    );
    sortie(home.path(), &[("SORTIE_LOG", "info")], &run);
    assert!(fs::read_to_string(&log).expect("there").contains("INFO"));
}

#[test]
fn paths_are_those_of_the_variables() {
    let home = home(&[]);
    let printed = text(&sortie(home.path(), &[], &["config", "--paths"]).stdout);
    let paths: toml::Table = toml::from_str(&printed).expect("it is TOML");
    let base = home.path().to_str().expect("plain");
    let expected = [
        ("config_file", "config/sortie/config.toml"),
        ("data", "data/sortie"),
        ("history", "state/sortie/history"),
    ];
    for (name, path) in expected {
        assert_eq!(
            paths[name].as_str(),
            Some(format!("{base}/{path}").as_str())
        );
    }
}

#[test]
fn of_thousands_of_faults_in_the_settings_fifty_are_told() {
    let faults: Vec<String> = (0..3000).map(|at| format!("wrong{at} = 1")).collect();
    let home = home(&[("config.toml", &faults.join("\n"))]);
    let said = text(&sortie(home.path(), &[], &["config"]).stderr);
    assert_eq!(said.matches("config.toml:").count(), 50, "{said}");
    assert!(said.contains("and 2950 more faults"), "{said}");
}

#[test]
fn a_shell_is_given_completions_and_a_manual_page() {
    let home = home(&[]);
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let script = text(&sortie(home.path(), &[], &["completions", shell]).stdout);
        assert!(
            script.contains("log-level") && script.contains("connect"),
            "{shell}"
        );
    }
    let page = text(&sortie(home.path(), &[], &["man"]).stdout);
    assert!(page.contains("\n.TH sortie 1 "), "{page}");
    assert!(
        page.contains("takeoff") && page.contains("\\-\\-theme"),
        "{page}"
    );
    let version = text(&sortie(home.path(), &[], &["--version"]).stdout);
    let words: Vec<&str> = version.split_whitespace().collect();
    assert_eq!(words[..2], ["sortie", env!("CARGO_PKG_VERSION")]);
    if let [commit, date] = words[2..] {
        let is_hexadecimal = |c: char| c.is_ascii_hexdigit();
        let commit = commit.strip_prefix('(').expect("a bracket");
        assert!(
            commit.len() >= 7 && commit.chars().all(is_hexadecimal),
            "{version}"
        );
        assert_eq!(date.len(), "2026-11-21)".len(), "{version}");
    }
}

#[test]
fn two_missions_with_one_id_are_told() {
    let mission = fs::read_to_string("missions/01-air-sample.toml").expect("it is there");
    let home = home(&[("missions/99-copy.toml", &mission)]);
    let output = sortie(
        home.path(),
        &[],
        &[
            "run",
            "01-air-sample",
            "--pilot",
            "missions/pilots/01-naive.pilot",
        ],
    );
    let said = text(&output.stderr);
    let expected = "two missions have the id `01-air-sample`: 01-air-sample.toml is used, ";
    assert!(
        said.contains(expected) && said.contains("99-copy.toml is ignored"),
        "{said}"
    );
    let mut terminal = console(home.path(), &[], &[]);
    terminal.see("two missions have the id").press("q");
    assert_eq!(terminal.end(), 0);
}

#[test]
fn keys_of_ones_own_give_lines_and_are_in_the_help() {
    let home = home(&[(
        "keymap.toml",
        "[anywhere]\nf5 = \"all guided\"\nctrl-t = \"all takeoff ...\"\nf6 = \"all kill\"\n\
         [fly]\na = \"select-all\"\n",
    )]);
    let mut terminal = console(home.path(), &[], &["fly", "--speedup", "5"]);
    terminal.see("4 vehicles");
    terminal
        .press("\u{1b}[15~")
        .see("all guided  4 vehicles: 4 effect seen");
    terminal.press("\u{14}").see("all takeoff").press("\u{1b}");
    terminal.see_no_more("all takeoff");
    // A dangerous line needs a confirmation, even from a bound key.
    terminal
        .press("\u{1b}[17~")
        .see("KILL")
        .press("\u{1b}")
        .see("nothing was done");
    terminal.press("a").see("selected 4: 1-4");
    terminal
        .press("?")
        .see("F5")
        .press("\u{1b}")
        .see_no_more("F5");
    terminal.command("quit");
    assert_eq!(terminal.end(), 0);
}

#[test]
fn a_theme_of_ones_own_colours_the_console() {
    let home = home(&[
        ("config.toml", "theme = \"mine\"\n"),
        ("themes/mine.toml", "inherits = \"base\"\n"),
        (
            "themes/base.toml",
            "inherits = \"dark\"\n[roles]\ntext = { fg = \"#0b1c2d\", bg = \"#fedcba\" }\n",
        ),
        (
            "themes/other.toml",
            "inherits = \"dark\"\n[roles]\ntext = { fg = \"#0b1c2d\", bg = \"#abcdef\" }\n",
        ),
    ]);
    let mut terminal = console(home.path(), &[("COLORTERM", "truecolor")], &["fly"]);
    terminal.see("4 vehicles");
    assert!(terminal.raw().contains("48;2;254;220;186"));
    assert!(!terminal.raw().contains("48;2;171;205;239"));
    terminal.command("theme other").see_no_more("theme other");
    terminal.command("quit");
    assert_eq!(terminal.end(), 0);
    assert!(terminal.raw().contains("48;2;171;205;239"));
}

#[test]
fn lines_come_back_in_the_next_session() {
    let home = home(&[]);
    let mut first = console(home.path(), &[], &["fly"]);
    first
        .see("4 vehicles")
        .command("select 2-3")
        .see("selected 2: 2-3")
        .command("quit");
    assert_eq!(first.end(), 0);
    let history = home.path().join("state/sortie/history");
    let mode = fs::metadata(&history)
        .expect("it is kept")
        .permissions()
        .mode();
    assert_eq!(mode & 0o777, 0o600);
    let mut second = console(home.path(), &[], &["fly"]);
    second.see("4 vehicles").press(":").see("command");
    // The newest line is the one that ended the session.
    second.press("\u{1b}[A\u{1b}[A").see("select 2-3");
    second.press("\r").see("selected 2: 2-3").command("quit");
    assert_eq!(second.end(), 0);
}

#[test]
fn the_language_is_that_of_the_shell_unless_a_flag_says_otherwise() {
    let home = home(&[]);
    let ukrainian = [("LANG", "uk_UA.UTF-8")];
    let mut terminal = console(home.path(), &ukrainian, &[]);
    terminal.see("ПОЧАТОК").press("q");
    assert_eq!(terminal.end(), 0);
    let mut terminal = console(home.path(), &ukrainian, &["--lang", "en"]);
    terminal.see("HOME").press("q");
    assert_eq!(terminal.end(), 0);
}
