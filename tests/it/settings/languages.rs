//! The language of faults, and what happens if it cannot be shown.

use super::*;

const UKRAINIAN: [(&str, &str); 1] = [("SORTIE_LANG", "uk")];

#[test]
fn a_language_that_the_locale_cannot_show_is_told() {
    let home = home(&[("config.toml", "lang = \"uk\"\n")]);
    let ascii = [("LANG", "C")];
    let doctor = text(&sortie(home.path(), &ascii, &["doctor"]).stdout);
    let told = "drawn in ASCII, and English is used instead of uk";
    assert!(doctor.contains(told), "{doctor}");
    let notice = "English is used instead of uk";
    let listed = sortie(home.path(), &ascii, &["records", "list", "--lang", "uk"]);
    assert!(
        text(&listed.stderr).contains(notice),
        "{}",
        text(&listed.stderr)
    );
    let listed = sortie(home.path(), &ascii, &["records", "list"]);
    assert!(
        !text(&listed.stderr).contains(notice),
        "it was not asked for"
    );
    let mut terminal = console(home.path(), &ascii, &[]);
    terminal.see(notice).command("quit");
    assert_eq!(terminal.end(), 0);
    let utf8 = text(&sortie(home.path(), &[], &["doctor"]).stdout);
    assert!(!utf8.contains(notice), "{utf8}");
}

#[test]
fn faults_are_in_the_language_of_the_reader() {
    let mission = fs::read_to_string("missions/00-first-flight.toml").expect("it ships");
    let faulty = mission.replacen("title =", "titel =", 1);
    let home = home(&[("missions/51-fault.toml", &faulty)]);
    fs::write(home.path().join("file"), "").expect("written");
    let log = home.path().join("file/log").display().to_string();
    let cases: [(&[&str], &str); 7] = [
        (&["run", "51-fault", "--pilot", "00"], "51-fault.toml"),
        (&["run", "nosuch", "--pilot", "00"], "`nosuch`"),
        (&["run", "00", "--pilot", "nosuch"], "`nosuch`"),
        (&["config", "--theme", "nosuch"], "невідома тема `nosuch`"),
        (&["config", "--lang", "nosuch"], "--lang"),
        (
            &["check", "nosuch.xyz"],
            "не вдається визначити вид nosuch.xyz",
        ),
        (&["config", "--log", &log], "не вдається записати журнал"),
    ];
    for (arguments, part) in cases {
        let output = sortie(home.path(), &UKRAINIAN, arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        let said = text(&output.stderr);
        let is_ukrainian = said.chars().any(|c| ('а'..='я').contains(&c));
        assert!(said.contains(part) && is_ukrainian, "{arguments:?}: {said}");
    }
}

#[test]
fn the_console_shows_the_path_of_the_faulty_file() {
    let home = home(&[]);
    let path = home.path().join("etc/sortie/config.toml");
    fs::create_dir_all(path.parent().expect("a folder")).expect("created");
    fs::write(&path, "fps = \"x\"\n").expect("written");
    let mut terminal = console(home.path(), &[], &[]);
    terminal.see("etc/sortie/config.toml:1").command("quit");
    assert_eq!(terminal.end(), 0);
}
