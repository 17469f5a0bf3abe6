//! The JSON schema (draft 2020-12) of mission files, for editors.
//!
//! Names of kinds, sensors, radios, faults and the like come from the tables that the reader uses; keys are described
//! in `keys` and `kinds`, and tests hold them against what the reader accepts. Where a rule is beyond a schema (names
//! that refer to something, sums, one value above another), [`Mission::parse`](super::Mission::parse) has the last word.

use serde_json::{Map, Value, json};

use super::event::expression;
use super::event::fault::FaultKind;
use super::event::standard::Standard;
use super::event::weather::Element;
use super::file::{POINT_RANGE, action_keys, zone_kinds};
use super::hazard;
use super::objective;
use super::radio::Model;
use super::sensor::SENSORS;

mod keys;
mod kinds;
mod objectives;
#[cfg(test)]
mod tests;

use keys::{Is, Key, may, need};

/// The keys of one kind of a section.
type Kind = (&'static str, &'static [Key]);

/// The schema as text.
pub fn schema() -> String {
    let mut root = table(keys::HEAD.iter().chain(keys::SECTIONS));
    let sections = [
        ("zones", kinded(zone_kinds(), keys::ZONE, kinds::ZONES)),
        (
            "hazards",
            kinded(names(hazard::KINDS), keys::KINDED, kinds::HAZARDS),
        ),
        (
            "objectives",
            kinded(
                names(objective::KINDS),
                keys::OBJECTIVE,
                objectives::OBJECTIVES,
            ),
        ),
        ("events", events()),
    ];
    if let Some(Value::Object(properties)) = root.get_mut("properties") {
        for (name, items) in sections {
            let section = json!({ "type": "array", "items": items });
            properties.insert(name.to_owned(), section);
        }
    }
    root.insert(
        "$schema".to_owned(),
        json!("https://json-schema.org/draft/2020-12/schema"),
    );
    root.insert("title".to_owned(), json!("A mission of sortie"));
    format!("{:#}", Value::Object(root))
}

fn names<T>(kinds: &[(&'static str, T)]) -> impl Iterator<Item = &'static str> {
    kinds.iter().map(|(name, _)| *name)
}

/// A table with these keys and no others.
fn table<'a>(keys: impl Iterator<Item = &'a Key>) -> Map<String, Value> {
    let (mut properties, mut required) = (Map::new(), Vec::new());
    for key in keys {
        let mut value = key.is.schema();
        value.insert("description".to_owned(), json!(key.about));
        properties.insert(key.name.to_owned(), Value::Object(value));
        if key.needed {
            required.push(key.name);
        }
    }
    let mut table = Map::new();
    table.insert("type".to_owned(), json!("object"));
    table.insert("properties".to_owned(), Value::Object(properties));
    table.insert("required".to_owned(), json!(required));
    table.insert("additionalProperties".to_owned(), json!(false));
    table
}

/// One of several kinds of tables, told by `kind`.
fn kinded(
    names: impl Iterator<Item = &'static str>,
    common: &'static [Key],
    kinds: &[Kind],
) -> Value {
    let of = |name: &str| {
        let own = kinds.iter().find(|(kind, _)| *kind == name);
        let own = own.map_or(&[][..], |(_, keys)| *keys);
        let mut table = table(common.iter().chain(own));
        if let Some(Value::Object(properties)) = table.get_mut("properties") {
            properties.insert("kind".to_owned(), json!({ "const": name }));
        }
        Value::Object(table)
    };
    json!({ "oneOf": names.map(of).collect::<Vec<_>>() })
}

/// Events, whose actions are told by the key that only they have.
fn events() -> Value {
    let action = |name: &str| {
        let found = kinds::ACTIONS.iter().find(|(action, _)| *action == name);
        Value::Object(table(found.map_or(&[][..], |(_, keys)| *keys).iter()))
    };
    let actions: Vec<Value> = action_keys().into_iter().map(action).collect();
    let mut event = table(keys::EVENT.iter());
    if let Some(Value::Object(properties)) = event.get_mut("properties") {
        let about = "what happens";
        let list = json!({ "type": "array", "items": { "oneOf": actions }, "description": about });
        properties.insert("do".to_owned(), list);
    }
    Value::Object(event)
}

impl Is {
    fn schema(&self) -> Map<String, Value> {
        let value = match self {
            Self::Number(low, high) => {
                json!({ "type": "number", "minimum": low, "maximum": high })
            }
            Self::Whole(low, high) => {
                json!({ "type": "integer", "minimum": low, "maximum": high })
            }
            Self::Flag => json!({ "type": "boolean" }),
            Self::Text => json!({ "type": "string" }),
            Self::Condition => {
                let most = expression::LONGEST;
                json!({ "type": "string", "maxLength": most })
            }
            Self::Point => numbers(2, -POINT_RANGE, POINT_RANGE),
            Self::Gate => numbers(3, -POINT_RANGE, POINT_RANGE),
            Self::Area => numbers(4, -POINT_RANGE, POINT_RANGE),
            Self::Span => numbers(2, -1000.0, 1000.0),
            Self::Word(words) => json!({ "enum": words }),
            Self::Sensor => one_of(SENSORS.iter().map(|sensor| sensor.id)),
            Self::Radio => one_of(Model::all().map(|model| model.id)),
            Self::Threat => one_of(Standard::names().into_iter()),
            Self::Fault => one_of(FaultKind::ALL.iter().map(|(name, ..)| *name)),
            Self::Weather => one_of(Element::ALL.iter().map(|(name, ..)| *name)),
            Self::Vehicle => json!({ "type": ["integer", "string"] }),
            Self::List(of) => json!({ "type": "array", "items": of.schema() }),
            Self::Map(of) => json!({ "type": "object", "additionalProperties": of.schema() }),
            Self::Table(keys) => Value::Object(table(keys.iter())),
        };
        match value {
            Value::Object(map) => map,
            _ => Map::new(),
        }
    }
}

fn one_of(words: impl Iterator<Item = &'static str>) -> Value {
    json!({ "enum": words.collect::<Vec<_>>() })
}

/// A list of so many numbers.
fn numbers(count: usize, low: f64, high: f64) -> Value {
    json!({
        "type": "array", "minItems": count, "maxItems": count,
        "items": { "type": "number", "minimum": low, "maximum": high },
    })
}
