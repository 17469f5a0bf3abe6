//! A drone is built in the workshop, part by part, as a trainee would.

use sortie::app::action::Step;
use sortie::app::room::workshop::Bench;
use sortie::store::Profiles;
use sortie::workshop::{Air, Design};

use crate::terminal::Terminal;

/// The parts of a drone that everybody owns, in the order of the slots, with how the workshop calls them.
const PARTS: [(&str, &str); 9] = [
    ("fr_450q", "quad 450 mm, nylon arms:"),
    ("m2212_920", "motor 2212, 920 rpm/V:"),
    ("p10x4.5p", "10x4.5 in, plastic:"),
    ("e30opto", "30 A, 4S:"),
    ("b3s5000", "LiPo 3S 5 Ah, 30C:"),
    ("fc_h7", "small autopilot:"),
    ("gps_m8n", "satellite receiver and compass:"),
    ("pm_02", "up to 6S, 60 A:"),
    ("r_sik915", "telemetry 868/915 MHz, 100 mW:"),
];

/// How many keys lead down to a part of the list; puts it into a bench that goes the same way.
fn way(bench: &mut Bench, part: &str) -> String {
    let mut all = bench.candidates().iter();
    let at = all.position(|candidate| candidate.part.id == part);
    let at = at.expect("it is listed");
    for _ in 0..at {
        bench.move_part(Step::Down);
    }
    bench.put_in(Air::default());
    bench.move_to_empty(Air::default());
    "j".repeat(at)
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
    let mut bench = Bench::default();
    bench.open(Design::new("New drone"), None, Air::default());
    for (part, name) in PARTS {
        let keys = way(&mut bench, part);
        terminal.press("\r").press(&keys).see(name).press("\r");
    }
    terminal.see("nothing: it flies").see("17.2 min");

    // The mission wants a sensor, which costs time in the air.
    terminal.press("vvv").see("── First flight").press("]");
    terminal.see("── Air sample").see("x vapour detector");
    bench.move_row(Step::Last, Air::default());
    let keys = way(&mut bench, "s_voc");
    terminal.press("\u{1b}[F\t").see("payload: hover time");
    terminal.press(&keys).see("vapour detector:").press("\r");
    terminal.press("\t").see("✓ vapour detector").press("v");
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
