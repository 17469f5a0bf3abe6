//! The campaign on the screen: the map on the home screen, the trainee's progress, and the reward of a flight.

use sortie::app::event::{CareerEvent, SessionEvent};
use sortie::app::state::{Activity, Career};
use sortie::campaign::Stake;
use sortie::campaign::{CareerStanding, Reward};
use sortie::config::Symbols;
use sortie::scoring::MissionFile;
use sortie::text::Language;

use super::SIZES;
use super::map::{drawn, resized};
use crate::fixtures;
use crate::fixtures::career::{
    campaign, career, flight, history, newcomer, nobody, opened, trained_by,
};
use crate::harness::Console;

/// A function that makes a console for a snapshot.
type Made = fn() -> Console;

fn at(console: Console, size: (u16, u16)) -> String {
    let console = resized(console, size);
    drawn(&console, Symbols::Braille, Language::English, size)
}

/// The home screen with the cursor on a mission.
fn on_mission(career: Career, mission: &str) -> Console {
    moved_to(trained_by(career), mission)
}

fn moved_to(mut console: Console, mission: &str) -> Console {
    console.press("home");
    for _ in 0..20 {
        let shown = sortie::app::room::home::under_cursor(console.state());
        if shown.is_some_and(|shown| shown.id == mission) {
            return console;
        }
        console.press("j");
    }
    panic!("{mission} is not on the home screen");
}

#[test]
fn home_says_why_a_mission_of_ones_own_is_practice() {
    let (mut missions, _) = campaign();
    let own = missions.iter_mut().find(|it| it.id == "01-air-sample");
    own.expect("it is one of the campaign").file = MissionFile::Own;
    let console = Console::set_up(|setup| setup.missions = missions);
    let console = moved_to(opened(console, career()), "01-air-sample");
    let shown = at(console, (200, 50));
    assert!(
        shown.contains("practice only: the mission is not"),
        "{shown}"
    );
    assert!(shown.contains("no credits"), "{shown}");
}

#[test]
fn the_home_screen_is_the_map_of_a_career() {
    for (width, height) in SIZES {
        let size = (width, height);
        let made: [(&str, Made); 5] = [
            ("nobody", nobody),
            ("newcomer", || trained_by(newcomer())),
            ("next", || trained_by(career())),
            ("locked", || on_mission(career(), "09-fire-attack")),
            ("passed", || on_mission(career(), "01-air-sample")),
        ];
        for (name, console) in made {
            let console = console();
            let name = format!("career_home_{name}_{width}x{height}");
            insta::assert_snapshot!(name, at(console, size));
        }
    }
    let size = (80, 24);
    let console = resized(on_mission(career(), "01-air-sample"), size);
    let ukrainian = drawn(&console, Symbols::Braille, Language::Ukrainian, size);
    insta::assert_snapshot!("career_home_uk_80x24", ukrainian);
    let ascii = drawn(&console, Symbols::Ascii, Language::English, size);
    insta::assert_snapshot!("career_home_ascii_80x24", ascii);
}

#[test]
fn own_progress_is_shown_pane_by_pane_or_at_once() {
    let mut console = trained_by(career());
    console.press("T");
    insta::assert_snapshot!("standing_200x50", at(console, (200, 50)));
    let size = (80, 24);
    for (name, tabs) in [("skills", 0), ("scores", 1), ("wealth", 2)] {
        let mut console = resized(trained_by(career()), size);
        console.press("T");
        for _ in 0..tabs {
            console.press("tab");
        }
        console.press("j").press("j");
        let english = drawn(&console, Symbols::Braille, Language::English, size);
        insta::assert_snapshot!(format!("standing_{name}_80x24"), english);
        let ukrainian = drawn(&console, Symbols::Braille, Language::Ukrainian, size);
        insta::assert_snapshot!(format!("standing_{name}_uk_80x24"), ukrainian);
        let ascii = drawn(&console, Symbols::Ascii, Language::English, size);
        insta::assert_snapshot!(format!("standing_{name}_ascii_80x24"), ascii);
    }
}

#[test]
fn own_progress_before_the_first_flight_and_of_nobody() {
    let mut console = trained_by(newcomer());
    console.press("T");
    insta::assert_snapshot!("standing_newcomer_80x24", at(console, (80, 24)));
    let mut console = nobody();
    console.press("T");
    let text = at(console, (80, 24));
    assert!(text.contains("Guests have no progress"), "{text}");
}

#[test]
fn who_trains_here_is_chosen_from_a_list() {
    let mut console = resized(trained_by(career()), (80, 24));
    console.press("u").press("j");
    insta::assert_snapshot!("profiles_80x24", at(console, (80, 24)));
    let mut console = resized(trained_by(career()), (80, 24));
    console.press("u").press("j").press("j").press("enter");
    insta::assert_snapshot!("profile_name_80x24", at(console, (80, 24)));
}

#[test]
fn the_debrief_tells_what_the_flight_has_brought() {
    let (_, course) = campaign();
    let before = CareerStanding::of(&history()[..4]);
    let entry = history()[5].clone();
    let after = CareerStanding::of(history()[..4].iter().chain([&entry]));
    let sortie::campaign::CareerEntry::Flight(flown) = &entry else {
        panic!("it is a flight")
    };
    let reward = Reward::between(&before, &after, &course, flown);
    let mut console = trained_by(career());
    console.start(Activity::Mission {
        id: "01-air-sample".to_owned(),
        title: "Air sample".into(),
        stake: Stake::Graded,
    });
    console.hear(SessionEvent::MissionEnded(Box::new(fixtures::report())));
    assert!(!at_end(&console).contains("CAREER"));
    console.hear(CareerEvent::Rewarded(Box::new(reward)));
    let mut console = resized(console, (80, 50));
    console.at(5);
    let text = drawn(&console, Symbols::Braille, Language::English, (80, 50));
    insta::assert_snapshot!("debrief_career_80x50", text);
    // The keys that move between sections reach the career.
    let mut console = resized(console, (80, 24));
    for _ in 0..2 {
        console.press("tab");
    }
    let text = drawn(&console, Symbols::Braille, Language::English, (80, 24));
    assert!(text.contains(" CAREER"), "{text}");
}

fn at_end(console: &Console) -> String {
    console.screen(80, 50)
}

#[test]
fn the_brief_says_what_the_mission_means_to_the_career() {
    let mut console = on_mission(career(), "09-fire-attack");
    console.press("B");
    let text = at(console, (80, 50));
    for line in ["for your career", "locked: pass Fire watch", "trains"] {
        assert!(text.contains(line), "{line}: {text}");
    }
}

#[test]
fn many_flights_fit() {
    let mut career = career();
    let many = (0..300).map(|at| {
        let score = (at * 37 % 1000) as u16;
        flight("00-first-flight", 0, score, &[])
    });
    career = Career {
        day: career.day,
        ..Career::new("oksana", many.collect(), career.course)
    };
    for size in [(80, 24), (97, 33), (200, 50), (300, 100)] {
        for tabs in 0..3 {
            let mut console = resized(trained_by(career.clone()), size);
            console.press("T");
            for _ in 0..tabs {
                console.press("tab");
            }
            let text = drawn(&console, Symbols::Block, Language::English, size);
            assert!(text.contains("300 flights"), "{text}");
        }
    }
}
