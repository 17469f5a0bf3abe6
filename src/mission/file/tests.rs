//! Tests that the guide contains the generated reference, and every name that a mission may use.

use std::collections::BTreeSet;

use super::*;
use crate::mission::event::expression::{FUNCTIONS, field_names};
use crate::mission::event::fault::FaultKind;
use crate::mission::event::standard::Standard;
use crate::mission::event::weather::Element;
use crate::mission::format::{FileShape, FileTableDescription};
use crate::mission::radio::Model;
use crate::mission::sensor::SENSORS;

const GUIDE: &str = include_str!("../../../docs/missions.md");

#[test]
fn the_guide_has_the_reference_of_the_format() {
    let (_, rest) = GUIDE
        .split_once("<!-- reference begins")
        .expect("it begins");
    let (_, rest) = rest.split_once("-->").expect("the mark is whole");
    let (written, _) = rest.split_once("<!-- reference ends -->").expect("it ends");
    assert!(
        written.trim() == reference().trim(),
        "put what `sortie check --reference` prints between the marks of docs/missions.md"
    );
}

/// The words of the guide in backticks.
fn code(text: &str) -> BTreeSet<&str> {
    let parts = text.split('`').skip(1).step_by(2);
    let word = |c: char| !(c.is_alphanumeric() || matches!(c, '_' | '-' | '.'));
    let words = parts.flat_map(|part| part.split(word));
    words.map(|word| word.trim_matches('.')).collect()
}

#[test]
fn the_guide_has_every_name_that_a_mission_may_use() {
    let mut wanted: BTreeSet<&str> = SENSORS.iter().map(|sensor| sensor.id).collect();
    wanted.extend(Model::all().map(|model| model.id));
    wanted.extend(Standard::names());
    wanted.extend(FaultKind::ALL.iter().map(|(name, ..)| *name));
    wanted.extend(Element::names());
    wanted.extend(FUNCTIONS.iter().map(|function| function.name));
    wanted.extend(field_names());
    let words = code(GUIDE);
    let missing: Vec<_> = wanted.difference(&words).collect();
    assert!(missing.is_empty(), "the guide is missing {missing:?}");
}

/// All keys of a table and of its inner tables.
fn described(table: &FileTableDescription, found: &mut Vec<(String, &'static str)>) {
    let own = table.kinds.iter().flat_map(|kind| &kind.own.keys);
    for key in table.keys.iter().chain(own) {
        found.push((key.name.clone(), key.about));
        let mut shape = &key.shape;
        while let FileShape::List(of, ..) = shape {
            shape = of;
        }
        if let FileShape::Table(inner) = shape {
            described(inner, found);
        }
    }
}

#[test]
fn every_key_says_what_it_means() {
    let mut keys = Vec::new();
    described(&describe(mission), &mut keys);
    assert!(keys.len() > 150, "{} keys", keys.len());
    let silent: Vec<_> = keys.iter().filter(|(_, about)| about.is_empty()).collect();
    assert!(silent.is_empty(), "{silent:?}");
}

#[test]
fn a_misspelt_key_that_is_needed_is_one_fault() {
    let good = include_str!("../../../tests/data/good_mission.toml");
    let source = good.replace("max_vehicles = 1", "max_vehicle = 1");
    let faults = read(&source).expect_err("a key is misspelt");
    let messages: Vec<String> = faults
        .iter()
        .map(|fault| fault.message.to_string())
        .collect();
    assert_eq!(messages.len(), 1, "{messages:?}");
    assert!(messages[0].starts_with("unknown field `max_vehicle`"));
}

#[test]
fn all_faults_of_a_table_are_told_at_once() {
    let good = include_str!("../../../tests/data/good_mission.toml");
    let source = good
        .replace("dwell = 5", "dwell = -5\ncolour = 3")
        .replace("max_speed", "#");
    let faults = read(&source).expect_err("three keys are wrong");
    let messages: Vec<String> = faults
        .iter()
        .map(|fault| fault.message.to_string())
        .collect();
    assert_eq!(messages.len(), 3, "{messages:?}");
}
