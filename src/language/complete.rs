//! Completion: the possible next words of a line.

use std::cmp::Reverse;
use std::ops::Range;

use nucleo_matcher::pattern::{AtomKind, CaseMatching, Normalization, Pattern};
use nucleo_matcher::{Config, Matcher, Utf32Str};

use super::argument::{Argument, Kind};
use super::fields::FieldWords;
use super::form::{Expected, Fit, fit};
use super::head::{Head, head};
use super::lexer::{Word, comment_start, words};
use super::modes::{mode_names, mode_warning};
use super::verb::{Form, Scope, VerbRow};
use super::{Context, Targets, rows};
use crate::text;
use crate::text::Text;

const SHOWN: usize = 200;

/// A possible word at the cursor.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Completion {
    /// The word to insert.
    pub text: String,
    pub hint: Text,
    /// The bytes of the line that the word replaces; empty where a new word begins.
    pub replaces: Range<usize>,
}

/// The possible words at the cursor (in bytes of the line), best first: prefix matches, with common words first, then
/// matches of a later part. If there are neither, matching is fuzzy: `tko` finds `takeoff`. Numbers cannot be
/// completed; [`hint`] describes them.
pub fn complete(line: &str, cursor: usize, context: &Context) -> Vec<Completion> {
    let cursor = floor_boundary(line, cursor);
    if comment_start(line).is_some_and(|at| at < cursor) {
        return Vec::new();
    }
    let mut before = words(&line[..cursor]);
    let partial = before.pop_if(|word| word.span.end == cursor);
    let replaces = partial.as_ref().map_or(cursor..cursor, |word| {
        let end = words(line)
            .into_iter()
            .find(|whole| whole.span.contains(&word.span.start))
            .map_or(cursor, |whole| whole.span.end);
        word.span.start..end
    });
    let written = partial.map_or("", |word| word.text);
    let of_fields = head(&before, context)
        .ok()
        .and_then(|head| Some(FieldWords::of(&head, &before)?.candidates(written)));
    let mut possible = of_fields.unwrap_or_else(|| candidates(&before, context));
    if written.starts_with('@') {
        possible.extend(last_seats(&before, context));
    }
    ranked(possible, written)
        .into_iter()
        .take(SHOWN)
        .map(|(text, hint)| Completion {
            text,
            hint,
            replaces: replaces.clone(),
        })
        .collect()
}

/// The beginning of the file name at the cursor, if a plan's file is possible there.
pub fn file_begun<'a>(line: &'a str, cursor: usize, context: &Context) -> Option<&'a str> {
    let cursor = floor_boundary(line, cursor);
    let mut before = words(&line[..cursor]);
    let partial = before.pop_if(|word| word.span.end == cursor);
    let written = partial.map_or("", |word| word.text);
    let head = head(&before, context).ok()?;
    let rest = &before[head.len..];
    let takes_file = |form: &&'static Form| {
        let expected = fit(form, rest, context).expected.into_iter();
        expected
            .filter_map(|it| match it {
                Expected::Value(argument) => Some(argument.kind),
                Expected::Keyword(_) => None,
            })
            .any(|kind| kind == Kind::PlanFile)
    };
    let mut forms = head.row.forms.iter();
    forms.any(|form| takes_file(&form)).then_some(written)
}

/// A hint for the next word. If the line fits one form of the verb, the hint is that form with the
/// next argument between ‹ and › and its meaning: "takeoff ‹ALTITUDE›: height above home, 0.5 to
/// 1000 m". If several forms fit, it lists the possible next arguments. If the line is complete, it
/// is the meaning of the form or, for a form without a word of its own, of the verb. `None` without
/// a verb, and after a fault.
pub fn hint(line: &str, context: &Context) -> Option<Text> {
    let words = words(line);
    let head = head(&words, context).ok()?;
    if let Some(hint) = FieldWords::of(&head, &words).and_then(|fields| fields.hint()) {
        return Some(hint);
    }
    let rest = &words[head.len..];
    let row = head.row;
    let fitting: Vec<(&Form, Option<&'static Argument>)> = row
        .forms
        .iter()
        .map(|form| (form, fit(form, rest, context)))
        .filter(|(_, fit)| fit.misfit.is_none())
        .map(|(form, fit)| (form, next_argument(&fit)))
        .collect();
    let name = row.name();
    match fitting.as_slice() {
        [] => None,
        [(form, None)] => Some(meaning(row, form)),
        [(form, Some(next))] => {
            let usage = form.usage(name, Some(next));
            Some(described(usage.into(), next.explained()))
        }
        several => {
            let next: Vec<String> = several
                .iter()
                .filter_map(|(_, next)| next.map(Argument::usage))
                .collect();
            if next.is_empty() {
                return several.first().map(|(form, _)| meaning(row, form));
            }
            Some(format!("{name} ‹{}›", next.join(" | ")).into())
        }
    }
}

/// The usage and the meaning of a form that begins with a word of its own; of other forms, the meaning of the verb.
fn meaning(row: &VerbRow, form: &Form) -> Text {
    let said = form.beginning().last();
    let mut own = form.arguments.iter();
    let word = own.find(|argument| Some(argument.keyword) == said && !argument.help.is_empty());
    match word {
        Some(word) => described(form.usage(row.name(), None).into(), word.meaning()),
        None => described(row.name().into(), row.summary()),
    }
}

/// The row of a line's verb, even if its targets or arguments are wrong.
pub fn begun(line: &str) -> Option<&'static VerbRow> {
    verb_of(&words(line)).map(|(_, row)| row)
}

fn verb_of(words: &[Word]) -> Option<(usize, &'static VerbRow)> {
    let mut first = words.iter().enumerate().take(2);
    first.find_map(|(at, word)| Some((at, super::row(word.text)?)))
}

/// The usages of a line's verb, even if its targets or arguments are wrong: the usages of the forms
/// whose first words the line contains.
pub fn usages_begun(line: &str) -> Option<Text> {
    let words = words(line);
    let (at, row) = verb_of(&words)?;
    let rest = &words[at + 1..];
    let said = |form: &Form| {
        let beginning = form.beginning().zip(rest);
        beginning.take_while(|(said, word)| word.is(said)).count()
    };
    let most = row.forms.iter().map(said).max().unwrap_or(0);
    let meant = row.forms.iter().filter(|form| said(form) == most);
    let usages = meant.map(|form| form.usage(row.name(), None));
    Some(usages.collect::<Vec<_>>().join(" | ").into())
}

/// All lines to the console that can be listed in full, with their meaning: those without arguments, and those
/// whose arguments are all words of a list.
pub fn lines(context: &Context) -> Vec<(String, Text)> {
    let own =
        rows().filter(|row| !row.scope.takes_targets() && row.scope.includes(context.channel));
    let of_row = |row: &'static VerbRow| {
        let listed = row.forms.iter().filter(|form| !form.is_shortcut);
        listed.flat_map(move |form| lines_of(row, form, context))
    };
    own.flat_map(of_row).collect()
}

/// The verbs for vehicles, with their meaning.
pub fn vehicle_verbs(context: &Context) -> Vec<(String, Text)> {
    let for_vehicles =
        rows().filter(|row| row.scope.takes_targets() && row.scope.includes(context.channel));
    for_vehicles
        .map(|row| (row.name().to_owned(), row.summary()))
        .collect()
}

fn lines_of(row: &VerbRow, form: &'static Form, context: &Context) -> Vec<(String, Text)> {
    match form.arguments {
        [] => vec![(row.name().to_owned(), row.summary())],
        [argument] => {
            let mut start = row.name().to_owned();
            let listed = if argument.kind == Kind::Flag {
                vec![(argument.keyword.to_owned(), argument.meaning())]
            } else {
                if !argument.keyword.is_empty() {
                    start.extend([" ", argument.keyword]);
                }
                names(Expected::Value(argument), context)
            };
            let values = listed.into_iter();
            values
                .map(|(word, meaning)| (format!("{start} {word}"), meaning))
                .collect()
        }
        // Lines with several arguments are not listed.
        [_, _, ..] => Vec::new(),
    }
}

/// A word with its meaning, if it has one.
fn described(word: Text, meaning: Text) -> Text {
    let parts = [word, meaning].into_iter();
    Text::joined(": ", parts.filter(|part| !part.is_empty()).collect())
}

/// The next argument: the first required one, otherwise the first optional one.
fn next_argument(fit: &Fit) -> Option<&'static Argument> {
    fit.expected
        .iter()
        .map(|expected| expected.argument())
        .find(|argument| !argument.optional)
        .or_else(|| fit.expected.first().map(|expected| expected.argument()))
}

/// Everything that could follow these words, with its meaning.
fn candidates(before: &[Word], context: &Context) -> Vec<(String, Text)> {
    match before {
        [] => {
            // The most common meaning comes first: verbs, then `all`, then modes, then single vehicles.
            let mut all = verb_names(|row| row.scope.includes(context.channel));
            let mut targets = target_names(context);
            all.extend(targets.drain(..1));
            all.extend(modes_as_verbs(context));
            all.extend(targets);
            all
        }
        [word] if word.is_targets() => match Targets::read(word, context) {
            Ok(_) => {
                let is_to_vehicles = |row: &VerbRow| {
                    row.scope.includes(context.channel) && row.scope.takes_targets()
                };
                let mut all = verb_names(is_to_vehicles);
                all.extend(modes_as_verbs(context));
                all
            }
            Err(_) => Vec::new(),
        },
        words => match head(words, context) {
            Ok(head) => following(&head, words, context),
            Err(_) => Vec::new(),
        },
    }
}

fn following(head: &Head, words: &[Word], context: &Context) -> Vec<(String, Text)> {
    let rest = &words[head.len..];
    let mut all: Vec<(String, Text)> = Vec::new();
    let waits =
        head.row.scope == Scope::Scripts && head.targets == Targets::Selection && rest.is_empty();
    if waits {
        all.extend(target_names(context));
    }
    for form in head.row.forms {
        let fit = fit(form, rest, context);
        for expected in fit.expected {
            for candidate in names(expected, context) {
                if !all.iter().any(|(known, _)| *known == candidate.0) {
                    all.push(candidate);
                }
            }
        }
    }
    all
}

/// The seats that may be the last word after these words, if the line has none yet.
fn last_seats(words: &[Word], context: &Context) -> Vec<(String, Text)> {
    let Ok(head) = head(words, context) else {
        return Vec::new();
    };
    let mut forms = head.row.forms.iter();
    let seat = forms.find_map(|form| {
        let seat = form.arguments.iter().find(|it| it.is_seat())?;
        let fit = fit(form, &words[head.len..], context);
        let is_expected = fit.expected.iter().any(|it| it.argument() == seat);
        (fit.complete && !is_expected && fit.arguments.span(seat.name).is_none()).then_some(seat)
    });
    seat.map_or_else(Vec::new, |seat| names(Expected::Value(seat), context))
}

fn names(expected: Expected, context: &Context) -> Vec<(String, Text)> {
    match expected {
        Expected::Keyword(argument) => {
            let hint = match argument.kind {
                Kind::Flag => argument.meaning(),
                _ => described(argument.usage().into(), argument.explained()),
            };
            vec![(argument.keyword.to_owned(), hint)]
        }
        Expected::Value(argument) => {
            let mut names = argument.kind.names(context);
            for (_, hint) in &mut names {
                if hint.is_empty() {
                    *hint = argument.meaning();
                }
            }
            names
        }
    }
}

fn verb_names(fits: impl Fn(&VerbRow) -> bool) -> Vec<(String, Text)> {
    let explained = |row: &VerbRow| {
        // The usage of a verb without arguments is its name: once is enough. Many forms would hide the summary.
        let hint = match row.usage().as_slice() {
            [usage] if usage == row.name() => row.summary(),
            [usage] => described(usage.as_str().into(), row.summary()),
            usages => described(row.summary(), usages.join(" | ").into()),
        };
        (row.name().to_owned(), hint)
    };
    rows().filter(|row| fits(row)).map(explained).collect()
}

/// The modes whose name alone is a command to change to them, because it is not the name of a verb.
fn modes_as_verbs(context: &Context) -> Vec<(String, Text)> {
    let described = |mode: &str| {
        let mut hint = vec![text!("grammar-change-mode", mode = mode)];
        hint.extend(mode_warning(mode, context));
        (mode.to_ascii_lowercase(), Text::joined("; ", hint))
    };
    mode_names(context)
        .into_iter()
        .map(described)
        .filter(|(name, _)| super::row(name).is_none())
        .collect()
}

/// Every target, `all` first.
fn target_names(context: &Context) -> Vec<(String, Text)> {
    let mut names = vec![("all".to_owned(), text!("grammar-every-vehicle"))];
    for (group, ids) in context.groups {
        names.push((
            format!("@{group}"),
            Targets::Ids(ids.clone()).to_string().into(),
        ));
    }
    for id in context.vehicles {
        names.push((id.to_string(), text!("grammar-vehicle")));
    }
    names
}

/// How a word matches the text, best first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Match {
    /// The word begins with the text.
    Beginning,
    /// A part after a `_` begins with the text.
    Part,
    /// The word contains the letters, scattered.
    Scattered,
}

impl Match {
    fn of(text: &str, written: &str) -> Self {
        let (text, written) = (text.to_lowercase(), written.to_lowercase());
        if text.starts_with(&written) {
            Self::Beginning
        } else if text.split('_').any(|part| part.starts_with(&written)) {
            Self::Part
        } else {
            Self::Scattered
        }
    }
}

/// The matching words, best first; for an empty text, all words in their order. Prefix matches keep their order. If
/// there are any, scattered letters do not count: `al` never means `interval`.
fn ranked(candidates: Vec<(String, Text)>, written: &str) -> Vec<(String, Text)> {
    if written.is_empty() {
        return candidates;
    }
    let pattern = Pattern::new(
        written,
        CaseMatching::Ignore,
        Normalization::Smart,
        AtomKind::Fuzzy,
    );
    let mut matcher = Matcher::new(Config::DEFAULT);
    let mut buffer = Vec::new();
    let mut scored: Vec<(Match, u32, (String, Text))> = candidates
        .into_iter()
        .filter_map(|candidate| {
            let score = pattern.score(Utf32Str::new(&candidate.0, &mut buffer), &mut matcher)?;
            Some((Match::of(&candidate.0, written), score, candidate))
        })
        .collect();
    // A single letter matches nearly everything.
    let is_letter = written.chars().nth(1).is_none();
    if is_letter || scored.iter().any(|(how, ..)| *how == Match::Beginning) {
        scored.retain(|(how, ..)| *how != Match::Scattered);
    }
    // Of equally good matches, the shorter one is closer.
    scored.sort_by_key(|(how, score, (text, _))| match how {
        Match::Beginning => (*how, Reverse(0), 0),
        Match::Part | Match::Scattered => (*how, Reverse(*score), text.len()),
    });
    scored
        .into_iter()
        .map(|(.., candidate)| candidate)
        .collect()
}

fn floor_boundary(line: &str, at: usize) -> usize {
    let mut at = at.min(line.len());
    while !line.is_char_boundary(at) {
        at -= 1;
    }
    at
}

#[cfg(test)]
mod tests;
