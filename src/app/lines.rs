//! Lines that stand in files: macros and keys. Whether they can be given shows only in flight, but whether anybody
//! could ever understand them is plain at once.

use std::collections::BTreeMap;

use super::console::{self, CONSOLE_VERBS, Names};
use crate::diagnostic::Diagnostic;
use crate::language::{self, Context, Groups, Meaning, Scope, Word, words};
use crate::text;
use crate::vehicle::VehicleClass;

/// Checks a line of the command language or of the console. Groups and places may have any name, because nobody
/// knows yet which there will be.
///
/// # Errors
/// The first fault, with its place in the line.
pub fn check(line: &str, themes: &[String]) -> Result<(), Diagnostic> {
    let words: Vec<&str> = line.split_whitespace().collect();
    // Missions and macros may be anybody's: which there are shows only in flight.
    if matches!(words.as_slice(), ["fly" | "macro" | "inject", _]) {
        return Ok(());
    }
    let names = Names {
        themes,
        missions: &[],
        injects: None,
        macros: &BTreeMap::new(),
        groups: &BTreeMap::new(),
    };
    if let Some(own) = console::parse(line, &names) {
        return own.map(|_| ());
    }
    let named = words.iter().filter_map(|word| word.strip_prefix('@'));
    let groups: Groups = named.map(|name| (name.to_owned(), vec![1])).collect();
    let context = Context {
        groups: &groups,
        places: None,
        areas: None,
        class: VehicleClass::Other,
        ..Context::default()
    };
    match language::parse(line, &context)?.meaning {
        Meaning::Act(_) => Ok(()),
        Meaning::Wait(_) => Err(only_in_scripts(line)),
    }
}

/// What is wrong with a line that says a verb of pilot scripts.
pub fn only_in_scripts(line: &str) -> Diagnostic {
    let said = words(line).into_iter().find(is_for_scripts);
    let span = said.map_or(0..line.len(), |word| word.span);
    Diagnostic::new(span, text!("order-wait")).with_help(text!("order-wait-help"))
}

fn is_for_scripts(word: &Word<'_>) -> bool {
    language::row(word.text).is_some_and(|row| row.scope == Scope::Scripts)
}

/// Checks the beginning of a line, which is to be completed by hand: its verb has to exist.
///
/// # Errors
/// There is no such verb, or only for pilot scripts; the place is its own.
pub fn check_beginning(line: &str) -> Result<(), Diagnostic> {
    let words = words(line);
    let is_known = |word: &Word<'_>| {
        let mut own = CONSOLE_VERBS.iter();
        language::row(word.text).is_some() || own.any(|verb| verb.name == word.text)
    };
    // A target may stand before it.
    let mut first = words.iter().take(2);
    if first.clone().any(is_for_scripts) {
        return Err(only_in_scripts(line));
    }
    if line.is_empty() || first.any(is_known) {
        return Ok(());
    }
    // The grammar says it best.
    check(line, &[])
}
