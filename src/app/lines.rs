//! Lines that stand in files: macros and keys. Whether they can be given shows only in flight, but whether anybody
//! could ever understand them is plain at once.

use std::collections::BTreeMap;

use super::console::{self, CONSOLE_VERBS, Names};
use crate::diagnostic::Diagnostic;
use crate::language::{self, Context};
use crate::vehicle::{VehicleClass, VehicleId};

/// Checks a line of the command language or of the console. Groups and places may have any name, because nobody
/// knows yet which there will be.
///
/// # Errors
/// The first fault, with its place in the line.
pub fn check(line: &str, themes: &[String]) -> Result<(), Diagnostic> {
    let words: Vec<&str> = line.split_whitespace().collect();
    // Missions and macros may be anybody's: which there are shows only in flight.
    if matches!(words.as_slice(), ["fly" | "macro", _]) {
        return Ok(());
    }
    let names = Names {
        themes,
        missions: &[],
        macros: &BTreeMap::new(),
        groups: &BTreeMap::new(),
    };
    if let Some(own) = console::parse(line, &names) {
        return own.map(|_| ());
    }
    let words = words.into_iter();
    let groups = words.filter_map(|word| word.strip_prefix('@'));
    let groups: BTreeMap<String, Vec<VehicleId>> =
        groups.map(|name| (name.to_owned(), vec![1])).collect();
    let context = Context {
        groups: &groups,
        places: None,
        class: VehicleClass::Other,
        ..Context::default()
    };
    language::parse(line, &context).map(|_| ())
}

/// Checks the beginning of a line, which is to be completed by hand: its verb has to exist.
///
/// # Errors
/// There is no such verb; the place is its own.
pub fn check_beginning(line: &str) -> Result<(), Diagnostic> {
    let mut words = line.split_whitespace();
    let known = |word: &str| {
        language::verb(word).is_some() || CONSOLE_VERBS.iter().any(|verb| verb.name == word)
    };
    // A target may stand before it.
    if line.is_empty() || words.by_ref().take(2).any(known) {
        return Ok(());
    }
    // The grammar says it best.
    check(line, &[])
}
