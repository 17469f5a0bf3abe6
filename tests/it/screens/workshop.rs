//! The workshop: bench, designs, comparison and fleet.

use std::sync::Arc;

use ratatui::Terminal;
use ratatui::backend::TestBackend;
use sortie::app::event::CareerEvent;
use sortie::app::state::Career;
use sortie::campaign::MissionCourse;
use sortie::config::Symbols;
use sortie::text::{Language, Locale};
use sortie::ui::{self, Look, Role};
use sortie::workshop::{Design, DesignKind, Measure};

use super::{SIZES, draw_at_some_sizes};
use crate::harness::Console;

fn design(source: &str) -> Design {
    Design::from_toml(source).expect("it is good")
}

/// A console at the bench, with a career that owns few parts and has two designs.
fn workshop(language: Language) -> Console {
    let scout = design(include_str!("../../../designs/scout.toml"));
    let starter = design(include_str!("../../../designs/starter.toml"));
    let mut career = Career::new("Olena", Vec::new(), MissionCourse::default());
    career.designs = vec![starter.named("Mine").expect("a name")];
    let mut console = Console::set_up(|setup| {
        setup.locale = Arc::new(Locale::new(language));
        setup.stock = vec![scout, starter];
    });
    console.hear(CareerEvent::Career(Some(Box::new(career))));
    console.press("W");
    console
}

/// A console with the cursor on one of the batteries, which is being examined.
fn looking(language: Language) -> Console {
    let mut console = workshop(language);
    for _ in 0..4 {
        console.press("j");
    }
    console.press("tab").press("j");
    console
}

fn check(name: &str, console: &Console) {
    for (width, height) in SIZES {
        let name = format!("workshop_{name}_{width}x{height}");
        insta::assert_snapshot!(name, console.screen(width, height));
    }
}

#[test]
fn the_bench_with_its_slots() {
    check("slots", &workshop(Language::English));
}

#[test]
fn the_parts_say_what_they_would_change() {
    for language in Language::ALL {
        let console = looking(language);
        check(&format!("parts_{}", language.code()), &console);
    }
}

/// At 80x24, the figures once touched their names.
#[test]
fn figures_stand_apart_from_their_names_which_are_whole() {
    for language in [Language::English, Language::Ukrainian] {
        let locale = Locale::new(language);
        let text = looking(language).screen(80, 24);
        for measure in Measure::of_kind(DesignKind::Drone) {
            let name = locale.text(&measure.name());
            let whole = text.lines().any(|line| line.contains(&format!("{name} ")));
            assert!(whole, "{name}: {text}");
        }
    }
}

#[test]
fn the_curve_says_that_it_is_that_of_the_marked_part() {
    let mut console = looking(Language::English);
    console.press("v");
    insta::assert_snapshot!("workshop_marked_curve_80x24", console.screen(80, 24));
    let words = |console: &Console| -> String {
        let text = console.screen(200, 50);
        let right = text
            .lines()
            .map(|line| line.chars().skip(144).collect::<String>());
        let words: Vec<String> = right.collect();
        let words = words.join(" ");
        words.split_whitespace().collect::<Vec<_>>().join(" ")
    };
    console.press("up");
    let text = words(&console);
    assert!(
        text.contains("as built: best endurance at 6.0 m/s"),
        "{text}"
    );
    console.press("end");
    let text = words(&console);
    let reason =
        "no curve with the marked part, Li-ion 6S 12 Ah, 3C: the battery has 6 cells; the motor";
    assert!(
        text.contains("as built: best endurance at 6.0 m/s"),
        "{text}"
    );
    assert!(text.contains(reason), "{text}");
}

#[test]
fn a_design_from_nothing_says_what_is_missing_and_what_does_not_fit() {
    let mut console = workshop(Language::English);
    console.press("n").press("tab").press("down").press("down");
    console
        .press("enter")
        .press("tab")
        .press("down")
        .press("down");
    console.press("tab").press("end");
    check("new", &console);
}

/// The list of problems once ended where the screen does, without a sign.
#[test]
fn problems_that_do_not_fit_are_counted() {
    let mut console = workshop(Language::English);
    console.press("n").press("tab").press("end").press("enter");
    let screen = console.screen(80, 24);
    let whole = console.screen(80, 50);
    assert!(!whole.contains(" more"), "{whole}");
    insta::assert_snapshot!("workshop_more_problems_80x24", screen);
}

#[test]
fn a_proposed_name_is_in_the_prompt_and_typing_replaces_it() {
    let mut console = workshop(Language::English);
    console.press("s");
    let prompt = |console: &Console| {
        let screen = console.screen(80, 24);
        let mut lines = screen.lines();
        let line = lines.find(|line| line.trim_start_matches(['│', ' ']).starts_with(": "));
        line.unwrap_or(&screen).to_owned()
    };
    assert!(prompt(&console).contains(": Mine"), "{}", prompt(&console));
    console.write("Scout 2");
    let typed = prompt(&console);
    assert!(
        typed.contains(": Scout 2") && !typed.contains("Mine"),
        "{typed}"
    );
}

/// A part that does not fit is muted, with a cross, and its reason is shown below in the colour of
/// danger.
#[test]
fn parts_that_do_not_fit_look_so() {
    let mut console = looking(Language::English);
    console.press("end");
    let look = Look::default();
    let mut terminal = Terminal::new(TestBackend::new(200, 50)).expect("a test terminal");
    terminal
        .draw(|frame| ui::draw(console.state(), &look, frame))
        .expect("a test terminal");
    let cells = &terminal.backend().buffer().content;
    let in_role = |role: Role| {
        let colour = look.style(role).fg;
        let cells = cells.iter().filter(|cell| Some(cell.fg) == colour);
        cells.map(ratatui::buffer::Cell::symbol).collect::<String>()
    };
    let muted = in_role(Role::Muted);
    assert!(muted.contains("× LiPo 6S 5 Ah, 45C"), "{muted}");
    let danger = in_role(Role::Danger);
    assert!(
        danger.contains("does not fit: the battery has 6 cells"),
        "{danger}"
    );
    // Without room for the reason, no figure shows an improvement.
    let narrow = console.screen(80, 24);
    let row = narrow
        .lines()
        .find(|line| line.contains("× LiPo 6S 5"))
        .unwrap_or_else(|| panic!("{narrow}"));
    // The pane beside the list shows the part under the cursor.
    let listed: String = row.chars().take(36).collect();
    assert!(!listed.contains(['▲', '▼', '+']), "{narrow}");
}

#[test]
fn charts_take_turns() {
    let mut console = workshop(Language::English);
    for name in ["polar", "payload", "mission"] {
        console.press("v");
        let name = format!("workshop_{name}_80x24");
        insta::assert_snapshot!(name, console.screen(80, 24));
    }
}

#[test]
fn designs_a_comparison_and_a_fleet() {
    for language in Language::ALL {
        let code = language.code();
        let mut console = workshop(language);
        check(&format!("designs_{code}"), console.press("o"));
        check(&format!("compare_{code}"), console.press("j").press("d"));
        console.press("esc").press("f");
        check(&format!("fleet_lent_{code}"), &console);
        check(&format!("fleet_{code}"), console.press("enter"));
    }
}

#[test]
fn plain_characters_say_the_same() {
    let console = looking(Language::English);
    let mut terminal = Terminal::new(TestBackend::new(80, 24)).expect("a test terminal");
    let look = Look {
        symbols: Symbols::Ascii,
        ..Look::default()
    };
    terminal
        .draw(|frame| ui::draw(console.state(), &look, frame))
        .expect("a test terminal");
    let cells = terminal.backend().buffer().content.chunks(80);
    let line = |row: &[ratatui::buffer::Cell]| -> String {
        row.iter().map(ratatui::buffer::Cell::symbol).collect()
    };
    let lines: Vec<String> = cells.map(|row| line(row).trim_end().to_owned()).collect();
    let screen = lines.join("\n");
    assert!(screen.is_ascii());
    insta::assert_snapshot!("workshop_ascii_80x24", screen);
}

#[test]
fn no_size_of_terminal_panics_in_the_workshop() {
    let mut consoles = vec![workshop(Language::English), looking(Language::Ukrainian)];
    for keys in [["o", "j"], ["f", "*"], ["d", "d"], ["v", "v"], ["n", "v"]] {
        let mut console = workshop(Language::Ukrainian);
        console.press(keys[0]).press(keys[1]);
        consoles.push(console);
    }
    let widths = [80, 81, 97, 120, 149, 150, 160, 200, 250];
    draw_at_some_sizes(&consoles, &widths, &[24, 25, 33, 36, 37, 50, 80]);
}

/// A console with a robot or boat on the bench.
fn driven(source: &str, language: Language) -> Console {
    let built = design(source);
    let mut console = Console::set_up(|setup| {
        setup.locale = Arc::new(Locale::new(language));
        setup.stock = vec![built];
    });
    console.press("W").press("o").press("enter");
    console
}

#[test]
fn robots_and_boats_have_slots_figures_and_curves_of_their_own() {
    let sapper = include_str!("../../../designs/sapper.toml");
    let lifeboat = include_str!("../../../designs/lifeboat.toml");
    for language in Language::ALL {
        let console = driven(sapper, language);
        check(&format!("robot_{}", language.code()), &console);
    }
    let mut console = driven(lifeboat, Language::English);
    console.press("j").press("tab").press("j");
    check("boat_parts", &console);
    console.press("v");
    insta::assert_snapshot!("workshop_boat_polar_80x24", console.screen(80, 24));
    console.press("v");
    insta::assert_snapshot!("workshop_boat_payload_80x24", console.screen(80, 24));
}
