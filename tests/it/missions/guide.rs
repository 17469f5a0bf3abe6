//! The examples of the mission guide are valid, and the JSON schema fits the shipped missions.

use std::process::Command;
use std::sync::Arc;

use serde_json::Value;
use sortie::exercise::Exercise;
use sortie::language::{Context, Script};
use sortie::mission::{Mission, schema};
use toml::Table;

use super::{folder, toml_files};

/// The fenced examples of the guide: their kind and their text.
fn examples() -> Vec<(String, String)> {
    let guide = std::fs::read_to_string(folder("docs/missions.md")).expect("the guide");
    let fences = guide.split("\n```").skip(1).step_by(2);
    let example = |text: &str| {
        let (what, body) = text.split_once('\n').expect("an example has lines");
        (what.to_owned(), format!("{body}\n"))
    };
    fences.map(example).collect()
}

fn of_kind(kind: &str) -> Vec<String> {
    let all = examples().into_iter();
    let of_kind = all.filter(|(what, _)| what == kind);
    of_kind.map(|(_, body)| body).collect()
}

/// Adds a snippet to a mission: tables replace existing ones; entries of arrays are appended,
/// unless their id exists already.
fn add(mission: &mut Table, snippet: &str) {
    let snippet: Table = snippet.parse().expect("TOML");
    for (key, value) in snippet {
        match (mission.get_mut(&key), value) {
            (Some(toml::Value::Array(list)), toml::Value::Array(more)) => {
                let again = |old: &toml::Value| {
                    let id = old.get("id");
                    id.is_some() && more.iter().any(|new| new.get("id") == id)
                };
                list.retain(|old| !again(old));
                list.extend(more);
            }
            (_, value) => {
                mission.insert(key, value);
            }
        }
    }
}

fn parsed(source: &str) -> Mission {
    Mission::parse(source).unwrap_or_else(|faults| {
        let faults = faults.iter().map(|fault| fault.one_line("guide", source));
        panic!("{:#?}\n{source}", faults.collect::<Vec<_>>())
    })
}

#[test]
fn every_example_of_the_guide_is_a_good_mission_or_part_of_one() {
    let whole = of_kind("toml");
    for source in &whole {
        parsed(source);
    }
    let mut mission: Table = whole[0].parse().expect("TOML");
    let snippets = of_kind("toml snippet");
    assert!(snippets.len() > 8, "{} snippets", snippets.len());
    for snippet in snippets {
        add(&mut mission, &snippet);
        parsed(&mission.to_string());
    }
    let schema: Value = serde_json::from_str(&schema()).expect("JSON");
    let mission = serde_json::to_value(&mission).expect("JSON");
    assert_eq!(faults(&mission, &schema, "guide"), [""; 0]);
}

#[test]
fn the_first_pilot_of_the_guide_passes_its_first_mission_and_the_others_are_read() {
    let mission = parsed(&of_kind("toml")[0]);
    let pilots = of_kind("pilot");
    let context = Context {
        places: None,
        areas: None,
        ..Context::default()
    };
    for pilot in &pilots {
        Script::parse(pilot, &context).unwrap_or_else(|faults| panic!("{faults:#?}\n{pilot}"));
    }
    let places = mission.places_to_name();
    let context = Context {
        places: Some(&places),
        vehicles: &[1],
        ..Context::default()
    };
    let script = Script::parse(&pilots[0], &context).expect("a good script");
    let idle = Script::parse("", &context).expect("nothing is wrong with nothing");
    let mission = Arc::new(mission);
    let flown = |script| {
        let mut exercise = Exercise::new(Arc::clone(&mission), 1, script, Vec::new());
        while !exercise.is_over() {
            exercise.step();
        }
        exercise.report()
    };
    // The requirements of `check --fly`.
    let (shown, nothing) = (flown(script), flown(idle));
    assert!(shown.passed && shown.score >= 700, "{}", shown.score);
    assert!(!nothing.passed && nothing.score <= 250, "{}", nothing.score);
}

#[test]
fn the_command_prints_the_schema_that_lies_beside_the_missions() {
    let sortie = Command::new(env!("CARGO_BIN_EXE_sortie"))
        .args(["check", "--schema"])
        .output()
        .expect("it runs");
    let printed = String::from_utf8(sortie.stdout).expect("text");
    let committed = std::fs::read_to_string(folder("missions/schema.json")).expect("it is there");
    let value = |text: &str| serde_json::from_str::<Value>(text).expect("JSON");
    assert!(
        value(&printed) == value(&committed),
        "put it there: sortie check --schema > missions/schema.json"
    );
}

#[test]
fn shipped_missions_and_drills_fit_the_schema() {
    let schema: Value = serde_json::from_str(&schema()).expect("JSON");
    let drills = toml_files(&folder("missions/drills"));
    let all = toml_files(&folder("missions")).into_iter().chain(drills);
    let mut count = 0;
    for path in all {
        let source = std::fs::read_to_string(&path).expect("it is there");
        let mission: Table = source.parse().expect("TOML");
        let mission = serde_json::to_value(&mission).expect("JSON");
        let found = faults(&mission, &schema, &path.display().to_string());
        assert_eq!(found, [""; 0]);
        count += 1;
    }
    assert!(count >= 30, "{count} missions and drills");
}

#[test]
fn the_schema_refuses_what_does_not_fit() {
    let schema: Value = serde_json::from_str(&schema()).expect("JSON");
    let source = of_kind("toml").swap_remove(0);
    for (from, to) in [
        ("time_limit = 180", "time_limit = 5"),
        ("time_limit = 180", "time_limits = 180"),
        ("kind = \"visit\"", "kind = \"visitt\""),
        ("radius = 4", "radius = \"4\""),
        ("dwell = 5", "dwel = 5"),
        ("at = [0, 60]", "at = [0, 60, 1]"),
        ("rev = 1\n", ""),
    ] {
        assert!(source.contains(from), "{from}");
        let mission: Table = source.replacen(from, to, 1).parse().expect("TOML");
        let mission = serde_json::to_value(&mission).expect("JSON");
        assert!(!faults(&mission, &schema, "").is_empty(), "{to}");
    }
}

/// The violations of a schema, for the keywords that the mission schema uses; an unknown keyword is
/// a fault, too.
fn faults(value: &Value, schema: &Value, place: &str) -> Vec<String> {
    let rules = schema.as_object().expect("a schema is an object");
    let found = rules.iter().flat_map(|(rule, wanted)| {
        let fits = match rule.as_str() {
            "$schema" | "title" | "description" | "additionalProperties" => true,
            "type" => match wanted {
                Value::Array(types) => types.iter().any(|one| is(value, one)),
                one => is(value, one),
            },
            "const" => value == wanted,
            "enum" => wanted.as_array().is_some_and(|words| words.contains(value)),
            "minimum" => value.as_f64() >= wanted.as_f64(),
            "maximum" => value.as_f64() <= wanted.as_f64(),
            "minItems" => length(value) >= wanted.as_u64(),
            "maxItems" => length(value) <= wanted.as_u64(),
            "maxLength" => value.as_str().map(|text| text.len() as u64) <= wanted.as_u64(),
            "required" => {
                let mut keys = wanted.as_array().into_iter().flatten();
                keys.all(|key| value.get(key.as_str().unwrap_or_default()).is_some())
            }
            "items" => {
                let items = value.as_array().into_iter().flatten().enumerate();
                let of = |(index, item)| faults(item, wanted, &format!("{place}[{index}]"));
                return items.flat_map(of).collect();
            }
            "properties" => return properties(value, wanted, place),
            "oneOf" => {
                let kinds = wanted.as_array().into_iter().flatten();
                let fitting = kinds.filter(|kind| faults(value, kind, place).is_empty());
                fitting.count() == 1
            }
            _ => false,
        };
        if fits {
            Vec::new()
        } else {
            vec![format!("{place}: {rule} {value}")]
        }
    });
    found.collect()
}

fn is(value: &Value, name: &Value) -> bool {
    match name.as_str() {
        Some("object") => value.is_object(),
        Some("array") => value.is_array(),
        Some("string") => value.is_string(),
        Some("boolean") => value.is_boolean(),
        Some("number") => value.is_number(),
        Some("integer") => value.is_u64() || value.is_i64(),
        _ => false,
    }
}

fn length(value: &Value) -> Option<u64> {
    value.as_array().map(|items| items.len() as u64)
}

/// The violations in the properties of a table; keys that are missing in the schema are faults.
fn properties(value: &Value, known: &Value, place: &str) -> Vec<String> {
    let keys = value.as_object().into_iter().flatten();
    let of = |(key, value): (&String, &Value)| match known.get(key) {
        Some(schema) => faults(value, schema, &format!("{place}.{key}")),
        None => vec![format!("{place}: unknown key {key}")],
    };
    keys.flat_map(of).collect()
}
