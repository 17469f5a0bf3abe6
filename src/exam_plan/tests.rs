use super::*;
use crate::store;

const GOOD: &str = r#"
schema = 1
title = "T"
title_uk = "Т"
about = "A"
about_uk = "А"
layout = "same"
opens = 2026-12-01T09:00:00+02:00
closes = 2026-12-01T08:30:00Z

[[missions]]
mission = "00"
tries = 2
minutes = 15
"#;

fn faults(from: &str, to: &str) -> Vec<String> {
    assert!(GOOD.contains(from), "{from}");
    let text = GOOD.replace(from, to);
    let parsed = ExamFile::parse("exam", &text, &store::course());
    let faults = parsed.expect_err("it has a fault");
    let words = faults.iter().map(|fault| fault.message.to_string());
    words.collect()
}

#[test]
fn an_exam_has_missions_of_the_course_and_a_window_in_universal_time() {
    let exam = ExamFile::parse("exam", GOOD, &store::course()).expect("it is good");
    let plan = &exam.plan;
    assert_eq!(plan.layout, ExamLayout::Same);
    assert_eq!(plan.missions[0].mission.as_str(), "00-first-flight");
    assert_eq!(plan.missions[0].limit, Duration::from_secs(900));
    assert_eq!(plan.opens, Some(1_796_108_400));
    assert_eq!(plan.closes, plan.opens.map(|opens| opens + 90 * 60));
    assert_eq!(exam.untranslated, []);
}

#[test]
fn the_shipped_exams_are_good() {
    for source in store::exams() {
        let parsed = ExamFile::parse(source.stem(), &source.text, &store::course());
        let exam = parsed.unwrap_or_else(|faults| panic!("{}: {faults:?}", source.name));
        assert_eq!(exam.untranslated, [], "{}", source.name);
    }
}

#[test]
fn every_fault_is_named() {
    for (from, to, expected) in [
        ("schema = 1", "schema = 2", "unknown schema 2"),
        ("\"same\"", "\"other\"", "the layout is “own” or “same”"),
        ("+02:00", "", "an offset from UTC are needed"),
        (
            "closes = 2026-12-01T08",
            "closes = 2026-12-01T06",
            "would close before",
        ),
        (
            "\"00\"",
            "\"77-none\"",
            "no mission of the course is called “77-none”",
        ),
        (
            "tries = 2",
            "tries = 0",
            "`tries` is a number from 1 to 10, not 0",
        ),
        (
            "minutes = 15",
            "minutes = 900",
            "`minutes` is a number from 1 to 240",
        ),
        ("minutes = 15", "minutes = 15\nhints = true", "hints"),
        ("tries = 2\n", "", "tries"),
    ] {
        let found = faults(from, to);
        assert!(
            found.iter().any(|it| it.contains(expected)),
            "{expected}: {found:?}"
        );
    }
    let twice =
        format!("{GOOD}\n[[missions]]\nmission = \"00-first-flight\"\ntries = 1\nminutes = 5\n");
    let parsed = ExamFile::parse("exam", &twice, &store::course());
    let faults = parsed.expect_err("twice");
    assert!(
        faults[0]
            .message
            .to_string()
            .contains("in the exam already")
    );
}
