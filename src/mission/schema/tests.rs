//! The schema's and the guide's keys are those that the reader accepts.

use std::collections::BTreeSet;

use super::*;
use crate::mission::Mission;
use crate::mission::event::expression::{FUNCTIONS, field_names};
use crate::mission::file::{HEAD, SECTIONS};
use crate::scoring::Component;

const GUIDE: &str = include_str!("../../../docs/missions.md");
/// A key that no table has; tables are read in the order of the alphabet, so it comes first.
const NONE: &str = "0zz";
/// What has to be good before the reader looks at the rest.
const GROUND: &str = "[sim]\ntime_limit = 60\norigin = { lat = 0, lon = 0, alt = 0 }\n\
    [fleet]\nmax_vehicles = 1\npads = [[0, 0]]\n";

/// All tables of kinds.
const ALL_KINDS: [(&str, &[Kind]); 4] = [
    ("zones", kinds::ZONES),
    ("hazards", kinds::HAZARDS),
    ("objectives", objectives::OBJECTIVES),
    ("actions", kinds::ACTIONS),
];

/// The keys that the reader says it knows, where a table has one that it does not.
fn accepted(source: &str) -> BTreeSet<String> {
    let faults = Mission::parse(source).expect_err("an unknown key");
    let messages = faults.iter().map(|fault| fault.message.to_string());
    let mut found = messages.filter(|message| message.contains(NONE));
    let message = found
        .next()
        .unwrap_or_else(|| panic!("no unknown key in {source}"));
    let quoted = message.split('`').skip(1).step_by(2);
    let keys = quoted.filter(|word| *word != NONE).map(str::to_owned);
    keys.collect()
}

fn described(keys: &[Key]) -> BTreeSet<String> {
    keys.iter().map(|key| key.name.to_owned()).collect()
}

/// The tables within a table, each with what has to be written to reach it.
fn inner(keys: &'static [Key]) -> impl Iterator<Item = (&'static str, &'static [Key], bool)> {
    keys.iter().filter_map(|key| match &key.is {
        Is::Table(inner) => Some((key.name, *inner, false)),
        Is::List(Is::Table(inner)) => Some((key.name, *inner, true)),
        _ => None,
    })
}

/// Checks a table and all in it; `write` makes a file of what stands in the table.
fn compare(keys: &'static [Key], not_own: &[&str], write: &dyn Fn(&str) -> String) {
    let source = write(&format!("{NONE} = 1"));
    let mut expected = described(keys);
    expected.retain(|key| !not_own.contains(&key.as_str()));
    assert_eq!(accepted(&source), expected, "{source}");
    for (name, inner, is_list) in inner(keys).filter(|(.., keys, _)| !keys.is_empty()) {
        let nested = |content: &str| {
            write(&if is_list {
                format!("{name} = [{{ {content} }}]")
            } else {
                format!("{name} = {{ {content} }}")
            })
        };
        compare(inner, &[], &nested);
    }
}

#[test]
fn sections_have_the_keys_that_the_reader_accepts() {
    assert_eq!(described(keys::HEAD), HEAD.map(str::to_owned).into());
    assert_eq!(
        described(keys::SECTIONS),
        SECTIONS.map(str::to_owned).into()
    );
    let by_kind = ["zones", "hazards", "objectives", "events"];
    for (name, keys, is_list) in inner(keys::SECTIONS).filter(|(name, ..)| !by_kind.contains(name))
    {
        let brackets = if is_list { ["[[", "]]"] } else { ["[", "]"] };
        compare(keys, &[], &|content| {
            let ground = if ["sim", "fleet"].contains(&name) {
                ""
            } else {
                GROUND
            };
            format!("{ground}{}{name}{}\n{content}\n", brackets[0], brackets[1])
        });
    }
    compare(keys::EVENT, &["do"], &|content| {
        format!("[[events]]\n{content}\n")
    });
}

#[test]
fn kinds_have_the_keys_that_the_reader_accepts() {
    for (section, kinds) in ALL_KINDS {
        for (kind, keys) in kinds {
            // A task zone has no keys of its own, which the reader says without naming any.
            compare(keys, &[], &|content| match section {
                "actions" => {
                    format!(
                        "[[events]]\nid = \"a\"\nat = 1\ndo = [{{ {content}, {kind} = \"a\" }}]\n"
                    )
                }
                "zones" => format!(
                    "[[zones]]\nid = \"a\"\nkind = \"{kind}\"\ncenter = [0, 0]\nradius = 1\n{content}\n"
                ),
                _ => format!("[[{section}]]\nid = \"a\"\nkind = \"{kind}\"\n{content}\n"),
            });
        }
    }
}

#[test]
fn every_kind_of_the_reader_is_described() {
    let known: [(&str, BTreeSet<&str>); 4] = [
        ("zones", zone_kinds().collect()),
        ("hazards", names(hazard::KINDS).collect()),
        ("objectives", names(objective::KINDS).collect()),
        ("actions", action_keys().into_iter().collect()),
    ];
    for ((name, known), (section, kinds)) in known.into_iter().zip(ALL_KINDS) {
        assert_eq!(name, section);
        assert_eq!(
            kinds.iter().map(|(kind, _)| *kind).collect::<BTreeSet<_>>(),
            known
        );
    }
}

/// The words of the guide that stand between backquotes and in examples.
fn code(text: &str) -> BTreeSet<&str> {
    let parts = text.split('`').skip(1).step_by(2);
    let word = |c: char| !(c.is_alphanumeric() || matches!(c, '_' | '-' | '.'));
    let words = parts.flat_map(|part| part.split(word));
    words.map(|word| word.trim_matches('.')).collect()
}

/// What the guide says of one kind: its row of a table, or its paragraphs.
fn about(kind: &str) -> String {
    let row = GUIDE
        .lines()
        .filter(|line| line.starts_with(&format!("| `{kind}`")));
    let paragraphs = GUIDE.split("\n**`").skip(1);
    let mut of_kind = paragraphs.filter(|text| text.starts_with(&format!("{kind}`**")));
    let paragraph = of_kind.next().map(|text| format!("`{text}"));
    row.map(str::to_owned).chain(paragraph).collect()
}

#[test]
fn the_guide_describes_every_kind_with_its_keys() {
    for (section, kinds) in ALL_KINDS {
        for (kind, keys) in kinds {
            let text = about(kind);
            assert!(!text.is_empty(), "the guide is missing {section} `{kind}`");
            let words = code(&text);
            let translated = |key: &&Key| !key.name.ends_with("_uk");
            for key in keys.iter().filter(translated) {
                assert!(
                    words.contains(key.name),
                    "{section} `{kind}`: `{}` is missing",
                    key.name
                );
            }
        }
    }
}

fn all_keys(keys: &'static [Key], found: &mut BTreeSet<&'static str>) {
    found.extend(keys.iter().map(|key| key.name));
    for (_, inner, _) in inner(keys) {
        all_keys(inner, found);
    }
}

#[test]
fn the_guide_has_every_name_that_a_mission_may_use() {
    let mut wanted = BTreeSet::new();
    all_keys(keys::HEAD, &mut wanted);
    all_keys(keys::SECTIONS, &mut wanted);
    for (_, kinds) in ALL_KINDS {
        for (_, keys) in kinds {
            all_keys(keys, &mut wanted);
        }
    }
    wanted.extend(SENSORS.iter().map(|sensor| sensor.id));
    wanted.extend(Model::all().map(|model| model.id));
    wanted.extend(Standard::names());
    wanted.extend(FaultKind::ALL.iter().map(|(name, ..)| *name));
    wanted.extend(Element::ALL.iter().map(|(name, ..)| *name));
    wanted.extend(FUNCTIONS.iter().map(|function| function.name));
    wanted.extend(field_names());
    wanted.extend(Component::ALL.map(Component::name));
    let words = code(GUIDE);
    let missing: Vec<_> = wanted
        .iter()
        .filter(|name| !words.contains(**name))
        .collect();
    assert!(missing.is_empty(), "the guide is missing {missing:?}");
}
