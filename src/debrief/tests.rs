use super::layout::right;
use super::*;
use crate::ledger::RowState;
use crate::mission::fake::{Pilot, do_nothing, fly_the_cells};
use crate::pilot_in_command::Person;
use crate::scoring::{FlightOutcome, Medal, TruthReport, UseReport};
use crate::text::Language;
use crate::text::said::without_words;

mod crew;

fn bad_flight() -> Report {
    let mut pilot = Pilot::new(1);
    pilot.tick();
    pilot.command("1 arm", RowState::Refused);
    pilot.tick();
    pilot.command(
        &format!("1 takeoff 20.{}", "0".repeat(280)),
        RowState::Refused,
    );
    pilot.take_off(80.0);
    pilot.goto(-45.0, 0.0, 5.0);
    pilot.set_armed(false);
    pilot.tick();
    pilot.report()
}

#[test]
fn no_line_is_wider_than_the_page_in_any_language() {
    for language in Language::ALL {
        for (_, report) in flights() {
            let text = text(&report, &Locale::new(language));
            for line in text.lines() {
                assert!(line.width() <= WIDTH, "{line}");
            }
        }
    }
}

#[test]
fn wide_and_combining_letters_leave_the_columns_straight() {
    for (words, fitted) in [
        ("дім", "дім  "),
        ("日本", "日本 "),
        ("日本語", "日本~"),
        ("дiм за лісом", "дiм ~"),
        ("и\u{306}о\u{301}", "и\u{306}о\u{301}   "),
    ] {
        assert_eq!(fit(words, 5), fitted);
        assert_eq!(fit(words, 5).width(), 5, "{words}");
    }
    assert_eq!(right("日本", 5), " 日本");
    assert_eq!(pieces("日本語", 3), ["日", "本", "語"]);
}

#[test]
fn the_components_add_up_to_the_score() {
    for report in [
        fly_the_cells(1).report(),
        do_nothing().report(),
        bad_flight(),
    ] {
        let sum: f64 = report
            .components
            .iter()
            .map(|component| component.points)
            .sum();
        assert!(
            (sum * report.hint_factor - f64::from(report.score)).abs() <= 0.5 + 1e-6,
            "{sum} {}",
            report.score
        );
    }
}

#[test]
fn every_rule_broken_and_every_rejection_stands_in_the_timeline() {
    let text = text(&bad_flight(), &Locale::default());
    for words in [
        "r 1 arm: refused",
        "x vehicle 1: above 60 m",
        "x vehicle 1: outside the fence \"fence\"",
        "x vehicle 1: motors stopped",
    ] {
        assert!(text.contains(words), "{words} is missing:\n{text}");
    }
}

#[test]
fn the_timeline_of_a_busy_flight_shows_its_commands() {
    let mut pilot = Pilot::new(1);
    pilot.tick();
    for _ in 0..9 {
        for _ in 0..5 {
            pilot.command("1 guided", RowState::Done);
        }
        pilot.wait(2.0);
        pilot.command("1 arm", RowState::Refused);
        pilot.wait(2.0);
    }
    let mut report = pilot.report();
    assert_eq!(report.ledger.len(), 54);
    let commands = |strip: &[Option<StripCell>]| -> String {
        let cells = strip.iter().flatten();
        let cells = cells.filter(|cell| cell.mark == TimelineMark::Command);
        cells.map(|cell| cell.letter()).collect()
    };
    assert_eq!(commands(&strip(&report, 60)), "5".repeat(9));
    let alone = text(&report, &Locale::default());
    assert!(alone.contains("> 5 commands until "), "{alone}");
    assert!(!alone.contains("1 guided: effect seen"), "{alone}");
    assert!(!alone.contains(" by "), "{alone}");

    for (entry, name) in report.ledger.iter_mut().zip(["vera", "anna", "vera"]) {
        entry.by = Some(Person::named(name));
    }
    let crew = text(&report, &Locale::default());
    assert!(crew.contains("(1 by anna, 2 by vera)"), "{crew}");
    assert_eq!(crew.matches(" by ").count(), 2, "{crew}");
}

#[test]
fn every_end_of_a_flight_is_named_at_the_top() {
    let mut report = do_nothing().report();
    for (outcome, words) in [
        (FlightOutcome::Passed, ["PASSED", "ПРОЙДЕНО"]),
        (FlightOutcome::Failed, ["FAILED", "НЕ ПРОЙДЕНО"]),
        (FlightOutcome::TimedOut, ["TIMED OUT", "ЧАС ВИЙШОВ"]),
        (FlightOutcome::Abandoned, ["ABANDONED", "ПРИПИНЕНО"]),
        (FlightOutcome::Flying, ["NOT FINISHED", "НЕ ЗАВЕРШЕНО"]),
    ] {
        report.outcome = outcome;
        for (language, word) in Language::ALL.into_iter().zip(words) {
            let text = text(&report, &Locale::new(language));
            let head = text.lines().nth(1).expect("a head");
            assert!(head.contains(&format!("   {word} ")), "{word}: {head}");
        }
    }
}

/// *Good* lists only actions; the objectives appear only if all of them were met.
#[test]
fn praise_is_for_what_was_done() {
    let good = |report: &Report| {
        let text = text(report, &Locale::default());
        let line = text.lines().find(|line| line.starts_with("  good "));
        line.map(str::to_owned)
    };
    let all_met = good(&fly_the_cells(1).report()).expect("it was good");
    assert!(all_met.contains("all 4 objectives met"), "{all_met}");
    for (name, mut report) in flights() {
        for component in &mut report.components {
            component.value = 1.0;
        }
        let is_all_met = report.objectives.iter().all(|it| it.met);
        let line = good(&report).unwrap_or_default();
        assert!(is_all_met || !line.contains("objective"), "{name}: {line}");
        for component in &mut report.components {
            component.value = 0.9;
        }
        assert_eq!(good(&report), None, "{name}");
    }
}

#[test]
fn improvements_stand_by_their_gain() {
    let report = bad_flight();
    assert!(!report.improvements.is_empty());
    assert!(
        report
            .improvements
            .is_sorted_by(|a, b| a.points >= b.points)
    );
}

#[test]
fn without_gold_the_page_says_what_gold_needs_though_no_points_are_left() {
    let mut report = fly_the_cells(1).report();
    report.improvements.clear();
    report.passed = true;
    let shown = |report: &Report| text(report, &Locale::default());
    report.medal = Some(Medal::Gold);
    report.gold_missing.clear();
    assert!(shown(&report).contains("Nothing left to gain."));
    report.medal = Some(Medal::Silver);
    report.gold_missing = vec!["close >= 2".into()];
    let page = shown(&report);
    assert!(!page.contains("Nothing left to gain."), "{page}");
    assert!(
        page.contains("No more points to gain; gold needs close >= 2.")
            && page.contains("Next try: gold needs close >= 2."),
        "{page}"
    );
}

#[test]
fn foreign_text_cannot_break_the_page() {
    let mut report = do_nothing().report();
    report.events[0].text = "a\u{1b}[2Jb\nc".into();
    assert!(!text(&report, &Locale::default()).contains('\u{1b}'));
}

/// A flight that lands late, with an empty battery, off the pad, after a forced arm.
fn late_flight() -> Report {
    let mut pilot = Pilot::new(2);
    pilot.command("1 long COMPONENT_ARM_DISARM 1 2989", RowState::Done);
    pilot.command("1 kill", RowState::TimedOut);
    pilot.command("1 rtl", RowState::Done);
    pilot.command("1 rtl", RowState::Done);
    pilot.take_off(20.0);
    pilot.goto(40.0, -20.0, 5.0);
    pilot.wait(6.0);
    pilot.hear("Battery 1 is low 10.70V used 341 mAh");
    pilot.hear("GCS Failsafe");
    pilot.wait(330.0);
    pilot.goto(7.0, 0.0, 5.0);
    pilot.land();
    pilot.report()
}

fn hard_landing() -> Report {
    let mut pilot = Pilot::new(3);
    pilot.take_off(20.0);
    pilot.hear("Battery 1 is critical 9.60V used 554 mAh");
    pilot.wait(1.0);
    pilot.hear("SIM Hit ground at 13.6 m/s");
    pilot.wait(1.0);
    pilot.report()
}

fn flights() -> [(&'static str, Report); 5] {
    [
        ("good", fly_the_cells(1).report()),
        ("idle", do_nothing().report()),
        ("bad", bad_flight()),
        ("late", late_flight()),
        ("hard", hard_landing()),
    ]
}

#[test]
fn programs_read_the_same_english_words_whatever_people_read() {
    for (name, mut report) in flights() {
        // The report has thousands of lines of object positions, so one short flight is enough to show the format.
        if name != "hard" {
            report.truth = TruthReport::default();
        }
        let json = serde_json::to_string_pretty(&report).expect("plain data");
        insta::assert_snapshot!(format!("json_{name}"), json);
    }
}

#[test]
fn debriefs_of_flights_that_went_wrong_read_like_this() {
    for (name, report) in flights() {
        for (language, code) in [
            (Language::English, "english"),
            (Language::Ukrainian, "ukrainian"),
        ] {
            let text = text(&report, &Locale::new(language));
            insta::assert_snapshot!(format!("{code}_{name}"), text);
        }
    }
}

#[test]
fn a_score_does_not_depend_on_the_words() {
    let decided = || flights().map(|(_, report)| report);
    assert_eq!(without_words(decided), decided());
}

#[test]
fn the_structure_of_a_debrief_does_not_depend_on_the_words() {
    let structure = || flights().map(|(_, report)| timeline::marks(&report));
    assert_eq!(without_words(structure), structure());
}

#[test]
fn every_line_says_what_it_tells_in_any_language() {
    for language in Language::ALL {
        let report = bad_flight();
        let lines = lines_with(&report, &DebriefCareer::default(), &Locale::new(language));
        let tone = |wanted| lines.iter().filter(move |line| line.tone == wanted).count();
        assert!(lines[..4].iter().all(|line| line.tone == DebriefTone::Head));
        // Every line that begins with capitals is a section title, and no other line has that tone.
        let capitals = |line: &&DebriefLine| {
            let mut letters = line.text.strip_prefix(' ').unwrap_or_default().chars();
            letters.next().is_some_and(char::is_uppercase)
                && letters.next().is_some_and(char::is_uppercase)
        };
        let named = lines.iter().filter(capitals);
        assert!(named.clone().count() >= 5, "{language:?}");
        assert!(
            named.clone().all(|line| line.tone == DebriefTone::Heading),
            "{language:?}"
        );
        let missed = report
            .objectives
            .iter()
            .filter(|it| !it.met && it.mandatory);
        assert!(tone(DebriefTone::Bad) >= missed.count());
        assert!(tone(DebriefTone::Event(TimelineMark::Rule)) > 0);
        let text: Vec<String> = lines.into_iter().map(|line| line.text).collect();
        let locale = Locale::new(language);
        assert_eq!(text.join("\n") + "\n", super::text(&report, &locale));
    }
}

#[test]
fn a_narrow_explanation_has_the_same_words() {
    for language in Language::ALL {
        let locale = Locale::new(language);
        let words = |width: usize| -> Vec<String> {
            let lines = explanation(&do_nothing().report(), &locale, width);
            assert!(
                lines.iter().all(|it| it.text.width() <= width),
                "{lines:#?}"
            );
            let words = lines.iter().flat_map(|it| it.text.split_whitespace());
            words.map(str::to_owned).collect()
        };
        assert_eq!(words(78), words(WIDTH));
    }
}
