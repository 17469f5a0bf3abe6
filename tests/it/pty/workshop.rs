//! A drone is built in the workshop, part by part, as a trainee would.

use sortie::store::Profiles;
use sortie::workshop::{Air, Design};

use crate::terminal::Terminal;

/// The parts that everybody owns, in the order of the slots, by what the workshop says of them.
const PARTS: [&str; 9] = [
    "quad 450 mm, nylon arms: 282 g",
    "motor 2212, 920 rpm/V: 57 g",
    "10x4.5 in, plastic: 11 g",
    "30 A, 4S: 27 g",
    "LiPo 3S 5 Ah, 30C: 390 g",
    "small autopilot: 8 g",
    "satellite receiver and compass: 32 g",
    "up to 6S, 60 A: 20 g",
    "telemetry 868/915 MHz, 100 mW: 15 g",
];

/// The screen without its first line, which has a clock.
fn body(screen: &str) -> String {
    screen.lines().skip(1).collect()
}

/// Moves down the list of parts to one, and puts it in.
fn put_in(terminal: &mut Terminal, part: &str) {
    let words = |screen: &str| screen.split_whitespace().collect::<Vec<_>>().join(" ");
    for _ in 0..40 {
        if words(&terminal.contents()).contains(part) {
            terminal.press("\r");
            return;
        }
        let before = body(&terminal.contents());
        terminal
            .press("j")
            .wait("the next part", |screen| body(screen) != before);
    }
    panic!("there is no {part} on:\n{}", terminal.contents());
}

#[test]
fn a_drone_is_built_from_nothing_for_a_mission_and_saved() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let (profiles, _) = Profiles::open(folder.path()).expect("they open");
    let profile = profiles.create("Olena", "2026-11-21T00:00:00Z");
    let profile = profile.expect("nobody has the name");
    let data = folder.path().to_str().expect("a plain path");
    let mut terminal = Terminal::start(&["--data", data], 80, 24);
    terminal.see("HOME").press("W").see("Starter 450");
    terminal.press("n").see("New drone").see("still missing");
    for part in PARTS {
        let before = body(&terminal.contents());
        terminal
            .press("\r")
            .wait("the parts", |screen| body(screen) != before);
        put_in(&mut terminal, part);
        terminal.see("New drone");
    }
    terminal.see("nothing: it flies").see("17.2 min");

    // The mission wants a sensor, which costs time in the air.
    terminal
        .press("vvv")
        .see("seats 1")
        .see("x vapour detector");
    terminal.press("\u{1b}[F\t").see("payload: hover time");
    put_in(&mut terminal, "vapour detector: 60 g");
    terminal.see("✓ vapour detector").press("\tv");
    terminal.see("15.9 min").see("what speaks against it");

    terminal.press("s").see("keep the design as");
    terminal.press("\u{15}First\r").see("kept: First");
    terminal.press("o").see("yours").press("\u{1b}");
    terminal
        .see("── First ──")
        .press("\u{1b}")
        .see("HOME")
        .press("q");
    assert_eq!(terminal.end(), 0);
    let designs = profiles.designs(&profile).expect("they can be read");
    let starter = include_str!("../../../designs/starter.toml");
    let starter = Design::from_toml(starter).expect("it is good");
    assert_eq!(designs, [starter.named("First").expect("a name")]);
    assert!(designs[0].is_airworthy(Air::default()));
}
