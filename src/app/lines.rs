//! Lines that stand in files: macros and keys. Whether they can be given shows only in flight, but whether anybody
//! could ever understand them is plain at once.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

use super::State;
use super::console::{self, CONSOLE_VERBS, ConsoleLine, Names};
use super::state::Groups;
use crate::diagnostic::Diagnostic;
use crate::language::{self, Context, Meaning, Scope, Targets, Word, words};
use crate::text;
use crate::vehicle::{VehicleClass, VehicleId};

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
    let words = words.into_iter();
    let groups = words.filter_map(|word| word.strip_prefix('@'));
    let groups: BTreeMap<String, Vec<VehicleId>> =
        groups.map(|name| (name.to_owned(), vec![1])).collect();
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

/// Checks the lines of a macro before the first one is given, so that none of them is wrong after others have been
/// sent. What an earlier line changes is not known yet: groups that it names count as every vehicle, and so does
/// the selection. Behind a line that starts another session nothing is known.
///
/// # Errors
/// What is wrong with the first line that is; the place is the whole of `at`, the line that gives the macro.
pub fn check_macro(state: &State, name: &str, at: Range<usize>) -> Result<(), Diagnostic> {
    let mut groups = state.session.groups.clone();
    let mut seen = BTreeSet::new();
    let mut left: Vec<(&str, usize, &str)> = Vec::new();
    let mut next = Some(name);
    loop {
        // One that calls itself is stopped when it is given.
        if let Some(name) = next.take().filter(|name| seen.insert(*name)) {
            let lines = state.config.macros.get(name).map_or(&[][..], Vec::as_slice);
            let lines = lines.iter().enumerate().rev();
            left.extend(lines.map(|(at, line)| (name, at + 1, line.as_str())));
        }
        let Some((name, number, line)) = left.pop() else {
            return Ok(());
        };
        let own = check_now(state, line, &groups).map_err(|fault| {
            let text = text!(
                "macro-line",
                name = name,
                number = number,
                line = line,
                fault = fault.message
            );
            Diagnostic {
                span: at.clone(),
                message: text,
                help: fault.help,
            }
        })?;
        match own {
            Some(ConsoleLine::Fly(_) | ConsoleLine::Connect(_)) => return Ok(()),
            Some(ConsoleLine::Group { name, .. }) => {
                groups.insert(name, state.session.vehicles.keys().copied().collect());
            }
            Some(ConsoleLine::Macro(name)) => {
                next = state
                    .config
                    .macros
                    .get_key_value(&name)
                    .map(|(name, _)| name.as_str());
            }
            _ => {}
        }
    }
}

/// Checks a line as far as it does not depend on those before it; gives it back if it is the console's own.
fn check_now(
    state: &State,
    line: &str,
    groups: &Groups,
) -> Result<Option<ConsoleLine>, Diagnostic> {
    if let Some(own) = console::parse(line, &state.names()) {
        return own.map(Some);
    }
    state.with_context(|context| {
        let context = Context {
            groups,
            class: VehicleClass::Other,
            parameters: None,
            ..*context
        };
        let statement = language::parse(line, &context)?;
        if let Meaning::Wait(_) = statement.meaning {
            return Err(only_in_scripts(line));
        }
        if statement.targets != Targets::Selection {
            let targets = statement.targets.resolve(&[], &context);
            targets.map_err(|text| Diagnostic::new(0..line.len(), text))?;
        }
        Ok(None)
    })
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
