//! Plans with and without faults.

use proptest::prelude::*;

use super::*;
use crate::class::{Deed, StepStart, StepTarget};

const SHIPPED: [(&str, &str); 3] = [
    (
        "first-lesson",
        include_str!("../../lessons/first-lesson.toml"),
    ),
    (
        "alerts-under-load",
        include_str!("../../lessons/alerts-under-load.toml"),
    ),
    ("exam-day", include_str!("../../lessons/exam-day.toml")),
];

fn missions() -> LessonMissions {
    LessonMissions::of([
        include_str!("../../missions/00-first-flight.toml"),
        include_str!("../../missions/01-air-sample.toml"),
        include_str!("../../missions/04-line-inspection.toml"),
        include_str!("../../missions/12-relay-chain.toml"),
    ])
}

fn parse_for(source: &str, language: Language) -> Result<Lesson, Vec<Diagnostic>> {
    let setting = LessonSetting {
        missions: &missions(),
        locale: &Locale::new(language),
    };
    Lesson::parse("lesson", source, &setting)
}

fn parse(source: &str) -> Result<Lesson, Vec<Diagnostic>> {
    parse_for(source, Language::English)
}

/// A plan whose only step follows the head.
fn plan(steps: &str) -> String {
    format!("schema = 1\ntitle = \"A\"\nabout = \"B\"\n{steps}")
}

/// The faults of a plan, as lines.
fn faults(steps: &str) -> Vec<String> {
    let source = plan(steps);
    let faults = parse(&source).expect_err("it has faults");
    let line = |fault: &Diagnostic| fault.one_line("x", &source);
    faults.iter().map(line).collect()
}

#[test]
fn the_shipped_lessons_are_good_in_both_languages() {
    for (name, source) in SHIPPED {
        for language in Language::ALL {
            let lesson = parse_for(source, language).unwrap_or_else(|faults| {
                let lines = faults.iter().map(|it| it.one_line(name, source));
                panic!("{}", lines.collect::<Vec<_>>().join("\n"))
            });
            assert_eq!(lesson.untranslated, [], "{name}");
            assert!(lesson.plan.steps.len() > 5, "{name}");
        }
    }
}

#[test]
fn the_example_of_the_guide_is_good() {
    let guide = include_str!("../../docs/lessons.md");
    let (_, after) = guide.split_once("```toml\n").expect("an example");
    let (example, _) = after.split_once("```").expect("its end");
    let lesson = parse(example).expect("it is good");
    assert_eq!(lesson.plan.steps.len(), 5);
}

#[test]
fn a_step_has_its_start_its_orders_and_what_follows() {
    let source = plan(
        r#"
[[steps]]
id = "brief"
when = "manual"
text = "Say hello."
message = "Hello"
message_uk = "Вітаю"
do = ["fly 00", "mark a text, with a comma"]
[[steps]]
id = "up"
text = "Watch."
when = "airborne > 0"
within = 60
otherwise = "brief"
together = true
then = "end"
"#,
    );
    let lesson = parse(&source).expect("it is good");
    let [brief, up] = lesson.plan.steps.as_slice() else {
        panic!("two steps");
    };
    assert_eq!(brief.start, StepStart::Instructor);
    assert_eq!((&brief.mission, brief.then), (&None, StepTarget::Step(1)));
    let mission = "00-first-flight".into();
    let exam = false;
    assert_eq!(
        brief.deeds,
        [
            Deed::Fly {
                mission,
                exam,
                hold: false
            },
            Deed::Mark {
                text: "a text, with a comma".into()
            },
            Deed::Message {
                text: "Hello".into()
            },
        ]
    );
    assert_eq!(up.start, StepStart::When("airborne > 0".into()));
    assert_eq!(up.mission, Some("00-first-flight".into()));
    assert!(up.together && up.then == StepTarget::End);
    let limit = up.limit.expect("a limit");
    assert_eq!(limit.within.as_secs(), 60);
    assert_eq!(limit.otherwise, StepTarget::Step(0));
    let ukrainian = parse_for(&source, Language::Ukrainian).expect("it is good");
    let text = "Вітаю".into();
    assert_eq!(ukrainian.plan.steps[0].deeds[2], Deed::Message { text });
}

#[test]
fn each_fault_has_its_place_and_what_to_do() {
    let fly = "[[steps]]\nid = \"a\"\ntext = \"T\"\ndo = [\"fly 12\"]\n";
    for (steps, expected) in [
        (
            "[[steps]]\nid = \"a\"\ntext = \"T\"\nthen = \"bb\"\n".to_owned(),
            "x:7:8: there is no step `bb` (the steps are: a, end)",
        ),
        (
            "[[steps]]\nid = \"a\"\ntext = \"T\"\ndo = [\"messge hi\"]\n".to_owned(),
            "x:7:8: ",
        ),
        (
            "[[steps]]\nid = \"a\"\ntext = \"T\"\ndo = [\"watch\"]\n".to_owned(),
            "x:7:8: not an order to a seat",
        ),
        (
            "[[steps]]\nid = \"a\"\ntext = \"T\"\nwhen = \"t > 5\"\n".to_owned(),
            "x:7:9: no mission is flown before this step",
        ),
        (
            "[[steps]]\nid = \"a\"\ntext = \"T\"\ndo = [\"fly 99\"]\n".to_owned(),
            "x:7:7: there is no mission `99`; the missions are: 00-first-flight, ",
        ),
        (
            format!("{fly}[[steps]]\nid = \"b\"\ntext = \"T\"\nwhen = \"met('gates')\"\n"),
            "x:11:13: ",
        ),
        (
            format!("{fly}[[steps]]\nid = \"b\"\ntext = \"T\"\nwhen = \"ower\"\n"),
            "x:11:9: `ower` is neither `manual`, `started`, `over` or `passed` nor a condition (did you mean `over`?)",
        ),
        (
            format!("{fly}[[steps]]\nid = \"b\"\ntext = \"T\"\ndo = [\"inject rain\"]\n"),
            "x:11:7: the mission 12-relay-chain does not permit the inject `rain`; it permits: gust, ",
        ),
        (
            format!("{fly}[[steps]]\nid = \"b\"\ntext = \"T\"\nwhen = \"over\"\nthen = \"b\"\n"),
            "x:9:6: nothing leads from the step `b` to the end of the lesson",
        ),
        (
            "[[steps]]\nid = \"a\"\ntext = \"T\"\nthen = \"a\"\n".to_owned(),
            "x:7:8: the steps go round from `a` to `a` without waiting",
        ),
        (
            "[[steps]]\nid = \"a\"\ntext = \"T\"\nthen = \"end\"\n[[steps]]\nid = \"b\"\ntext = \"T\"\n"
                .to_owned(),
            "x:9:6: nothing leads to the step `b`",
        ),
        (
            "[[steps]]\nid = \"a\"\ntext = \"T\"\nwhen = \"manual\"\nwithin = 5\n".to_owned(),
            "x:8:10: `within` needs `otherwise`",
        ),
        (
            "[[steps]]\nid = \"a\"\ntext = \"T\"\ndo = [\"fly 04 exam\", \"hint\"]\n".to_owned(),
            "x:7:22: not permitted in exams",
        ),
        (
            "[[steps]]\nid = \"a\"\ntext = \"T\"\nwhenn = \"manual\"\n".to_owned(),
            "x:7:1: unknown field `whenn`; known: id, ",
        ),
    ] {
        let found = faults(&steps);
        assert!(
            found.iter().any(|line| line.starts_with(expected)),
            "{expected}\n{found:?}"
        );
    }
}

/// A change to a text.
#[derive(Debug, Clone)]
enum Mutation {
    Remove(usize, usize),
    Insert(usize, String),
    Double(usize),
}

fn mutations() -> impl Strategy<Value = Vec<Mutation>> {
    let words = prop_oneof![
        Just("\""),
        Just("'"),
        Just("["),
        Just("]"),
        Just("\n[[steps]]\n"),
        Just("="),
        Just("\\u0000"),
        Just("then = \"end\"\n"),
        Just("я"),
        Just("within = 1\n"),
        Just("#"),
        Just("fly "),
        Just(" exam"),
        Just("inject gust when "),
        Just("@all "),
        Just("((((((((("),
        Just("999999999999"),
        Just("\t"),
    ];
    let one = prop_oneof![
        (any::<usize>(), 1..40_usize).prop_map(|(at, count)| Mutation::Remove(at, count)),
        (any::<usize>(), words).prop_map(|(at, word)| Mutation::Insert(at, word.to_owned())),
        any::<usize>().prop_map(Mutation::Double),
    ];
    prop::collection::vec(one, 1..6)
}

fn mutated(source: &str, mutations: &[Mutation]) -> String {
    let mut letters: Vec<char> = source.chars().collect();
    for mutation in mutations {
        let len = letters.len().max(1);
        match mutation {
            Mutation::Remove(at, count) => {
                let at = at % len;
                letters.drain(at.min(letters.len())..(at + count).min(letters.len()));
            }
            Mutation::Insert(at, word) => {
                let at = (at % len).min(letters.len());
                letters.splice(at..at, word.chars());
            }
            Mutation::Double(at) => {
                let text: String = letters.iter().collect();
                let mut lines: Vec<&str> = text.lines().collect();
                let at = at % lines.len().max(1);
                if let Some(line) = lines.get(at).copied() {
                    lines.insert(at, line);
                }
                letters = lines.join("\n").chars().collect();
            }
        }
    }
    letters.into_iter().collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn a_mutated_plan_is_read_or_refused_with_places(which in 0..3_usize, changes in mutations()) {
        let source = mutated(SHIPPED[which].1, &changes);
        match parse(&source) {
            Ok(lesson) => prop_assert!(lesson.plan.steps.len() == lesson.notes.len()),
            Err(faults) => {
                prop_assert!(!faults.is_empty());
                for fault in faults {
                    prop_assert!(fault.span.start <= source.len(), "{fault:?}");
                    let line = fault.one_line("x", &source);
                    prop_assert!(line.starts_with("x:"), "{line}");
                }
            }
        }
    }
}
