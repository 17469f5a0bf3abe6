//! A line typed in the Ukrainian keyboard layout, and its reading by the Latin letters on its keys.

use super::{offer, order};
use crate::app::State;
use crate::app::keymap::latin_line;
use crate::diagnostic::Diagnostic;
use crate::language::{self, Completion};

/// The line as its keys read in Latin letters; `None` if it counts as typed: it is valid, or its keys make no more
/// sense. Free texts in it stay as typed.
pub fn in_latin(state: &State, line: &str) -> Option<String> {
    let read = with_free_texts(state, line, &latin_line(line)?);
    if read == line {
        return None;
    }
    let Err(fault) = order::read(state, line) else {
        return None;
    };
    let is_meant = match order::read(state, &read) {
        Ok(_) => true,
        Err(other) => {
            // Its arguments may follow.
            let is_begun = has_verb(state, &read) && !has_verb(state, line);
            let is_better =
                || is_better_fault(line, &fault, &read, &other) || begins_an_offer(state, &read);
            is_begun || (!has_offers(state, line) && is_better())
        }
    };
    is_meant.then_some(read)
}

/// A fault of a line as it is read, at the same characters of the line as typed.
pub fn in_typed(fault: Diagnostic, read: &str, typed: &str) -> Diagnostic {
    let place = |at: usize| {
        let count = read.get(..at).unwrap_or(read).chars().count();
        let letter = typed.char_indices().nth(count);
        letter.map_or(typed.len(), |(at, _)| at)
    };
    Diagnostic {
        span: place(fault.span.start)..place(fault.span.end),
        ..fault
    }
}

/// The reading of a line, with the free texts in it as typed.
fn with_free_texts(state: &State, typed: &str, read: &str) -> String {
    let texts = state.with_context(|context| language::free_texts(read, context));
    let letters = read.char_indices().zip(typed.chars());
    letters
        .map(|((at, letter), typed)| {
            let is_free = texts.iter().any(|text| text.contains(&at));
            if is_free { typed } else { letter }
        })
        .collect()
}

fn has_verb(state: &State, line: &str) -> bool {
    let said = state.with_context(|context| language::said(line, context));
    said.is_ok()
}

/// Whether something is offered for the line, except for lines that only contain its letters.
fn has_offers(state: &State, line: &str) -> bool {
    !completions(state, line).is_empty() || offer::is_near(state, line)
}

/// Whether the line is the beginning of something that is offered for it.
fn begins_an_offer(state: &State, line: &str) -> bool {
    let begins = |completion: &Completion| {
        let written = line.get(completion.replaces.clone()).unwrap_or_default();
        let offered = completion.text.to_lowercase();
        offered.starts_with(&written.to_lowercase())
    };
    completions(state, line).iter().any(begins) || offer::is_near(state, line)
}

fn completions(state: &State, line: &str) -> Vec<Completion> {
    state.with_context(|context| language::complete(line, line.len(), context))
}

/// Whether the fault of the reading comes after more right words than that of the line as typed, or alone has advice.
fn is_better_fault(line: &str, fault: &Diagnostic, read: &str, other: &Diagnostic) -> bool {
    let place = |line: &str, fault: &Diagnostic| {
        let before = line.get(..fault.span.start).unwrap_or(line);
        before.chars().count()
    };
    let is_later = place(read, other) > place(line, fault);
    let is_advised = other.help.is_some() && fault.help.is_none();
    is_later || is_advised
}
