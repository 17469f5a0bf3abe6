//! A drone built in the workshop, part by part, as a trainee would.

use sortie::app::action::Step;
use sortie::app::room::workshop::Bench;
use sortie::campaign::{CareerStanding, PartState};
use sortie::store::{self, Profiles};
use sortie::workshop::{Air, Design, part};

use crate::terminal::Terminal;

/// Starter parts in the order of the slots, with their names in the workshop.
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

/// The keys from the current part down to another one of the list; moves the cursor of a bench in the same way.
fn way(bench: &mut Bench, part: &str) -> String {
    let mut all = bench.candidates().iter();
    let at = all.position(|candidate| candidate.part.id == part);
    let at = at.expect("it is listed");
    for _ in 0..at {
        bench.move_part(Step::Down, Air::default());
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
    terminal.press("n").see("New design").see("still missing");
    let mut bench = Bench::default();
    bench.open(Design::new("New design"), None, Air::default());
    for (part, name) in PARTS {
        let keys = way(&mut bench, part);
        terminal.press("\r").press(&keys).see(name).press("\r");
    }
    terminal.see("none: it can fly").see("17.2 min");

    // The mission requires a sensor, which costs flight time.
    terminal.press("vvv").see("── First flight").press("]");
    terminal.see("── Air sample").see("× vapour detector");
    bench.move_row(Step::Last, Air::default());
    let keys = way(&mut bench, "s_voc");
    terminal.press("\u{1b}[F\t").see("payload: hover time");
    terminal.press(&keys).see("vapour detector:").press("\r");
    terminal.press("\t").see("✓ vapour detector").press("v");
    terminal.see("15.9 min").see("problems");

    terminal.press("s").see("save the design as");
    terminal.press("\u{15}First\r").see("saved: First");
    terminal.press("o").see("yours").press("\u{1b}");
    terminal
        .see("━━ First ━━")
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

/// The keys that lead to a part of the list, from anywhere in it.
fn keys_to(bench: &Bench, part: &str) -> String {
    let mut all = bench.candidates().iter();
    let at = all.position(|candidate| candidate.part.id == part);
    format!("\u{1b}[H{}", "j".repeat(at.expect("it is listed")))
}

#[test]
fn a_built_drone_flies_a_mission_that_pays_for_a_better_battery() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let (profiles, _) = Profiles::open(folder.path()).expect("they open");
    let profile = profiles.create("Olena", "2026-11-21T00:00:00Z");
    let profile = profile.expect("nobody has the name");
    let data = folder.path().to_str().expect("a plain path");
    let mut terminal = Terminal::start(&["--data", data, "--speedup", "4"], 80, 24);
    terminal.see("500 cr").press("W").see("Starter 450");
    terminal.press("f").see("lent by the mission");
    terminal
        .press("*")
        .see("1018 cr")
        .press("g")
        .see("before takeoff");

    terminal.press("F").see("ready").command("all guided");
    // Idle motors are disarmed after 10 s of simulated time, so the takeoff follows arming at once.
    terminal.see("GUIDED").command("all arm").see("1 armed");
    terminal.command("all takeoff 20");
    terminal.press("B").see("armed after").see("10/10 s");
    for (gate, passed) in [("gate1", "1/3"), ("gate2", "2/3"), ("gate3", "3/3")] {
        terminal.command(&format!("all goto {gate} up 20"));
        terminal.see(&format!("{passed} gates"));
    }
    terminal.command("all rtl").see("PASSED").see("credits +");
    terminal.see("new mission: Air sample").see("n next");

    // The reward buys a larger battery, and the drone on the bench shows it.
    terminal.press("h").see("licence 2").press("W");
    terminal
        .see("the fleet for")
        .press("\u{1b}")
        .see("17.2 min");
    terminal.press("\u{1b}[Hjjjj\t").see("battery: hover time");
    let starter = include_str!("../../../designs/starter.toml");
    let starter = Design::from_toml(starter).expect("it is good");
    let mut bench = Bench::default();
    bench.open(starter, None, Air::default());
    (0..4).for_each(|_| bench.move_row(Step::Down, Air::default()));
    let keys = keys_to(&bench, "b3s5100hv");
    terminal.press(&keys).see("buys the right").press("b");
    terminal
        .see("left")
        .press("y")
        .see_no_more("buys the right");
    // An Enter right after the answer would count as part of it.
    terminal
        .press("\u{1b}[B\u{1b}[A\r")
        .see("on board")
        .press("\t");
    terminal.see("LiPo 3S 5.1 Ah").see_no_more("17.2 min");
    terminal.press("\u{3}").press("y");
    assert_eq!(terminal.end(), 0);

    let history = profiles.history(&profile).expect("it can be read");
    let standing = CareerStanding::of(&history);
    assert!(standing.has_passed("00-first-flight"));
    let course = store::course();
    let battery = part("b3s5100hv").expect("a part");
    assert_eq!(standing.part_state(battery, &course), PartState::Owned);
}
