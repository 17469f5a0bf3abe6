//! Whole lines that the command line offers: all commands, and the history.

use std::cmp::Reverse;

use nucleo_matcher::pattern::{CaseMatching, Normalization, Pattern};
use nucleo_matcher::{Config, Matcher, Utf32Str};

use crate::app::State;
use crate::app::room::Room;
use crate::language::{self, Completion, Kind, LineNeeds, NameList};
use crate::text;
use crate::text::{Locale, Text};

/// The maximum number of lines offered.
const SHOWN: usize = 100;
/// If fewer letters than this are typed, only the words of the lines are searched, not their
/// meaning.
const FEW: usize = 3;
const VEHICLES_SHOWN: usize = 20;

/// How well a line matches the text, best first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Nearness {
    /// The line begins with the text.
    Line,
    /// Every word of the text is the beginning of a word of the line.
    Words,
    /// Every word of the text is the beginning of a word of the line or of its meaning.
    Meaning,
    /// The letters occur in the line in order, but not together.
    Scattered,
}

impl Nearness {
    fn of(line: &str, meaning: &str, written: &str) -> Self {
        let [line, meaning, written] = [line, meaning, written].map(str::to_lowercase);
        let words = || written.split_whitespace();
        let begins_one = |text: &str, word: &str| {
            let mut parts = text.split(|c: char| c.is_whitespace() || "-_(:,;`".contains(c));
            parts.any(|part| part.starts_with(word))
        };
        if line.starts_with(&written) {
            Self::Line
        } else if words().all(|word| begins_one(&line, word)) {
            Self::Words
        } else if words().all(|word| begins_one(&line, word) || begins_one(&meaning, word)) {
            Self::Meaning
        } else {
            Self::Scattered
        }
    }
}

/// A line with its meaning, and how well it matches the text.
type Scored = (Nearness, u32, (String, Text));

/// The lines that match the text, in the line itself or in its meaning. Fewer than `FEW` letters
/// would match nearly everywhere, so they are compared only with the beginnings of the line's
/// words. More letters are also compared with the meaning. Scattered letters never count for the
/// verbs of vehicles.
fn scored(state: &State, written: &str) -> Vec<Scored> {
    let mut all = state.with_context(language::lines);
    if state.replay.is_none() {
        all.retain(|(line, _)| !needs_replay(state, line));
    }
    all.retain(|(line, _)| state.may_write(line));
    let mut verbs = state.with_context(language::vehicle_verbs);
    verbs.retain(|(verb, _)| state.may_write(verb));
    all.extend(verbs.clone());
    all.extend(vehicles(state, written));
    let given_before = state.typing.history.iter().rev();
    all.extend(given_before.map(|line| (line.clone(), text!("palette-given-before"))));
    let wanted = written.trim();
    let farthest = match wanted.chars().count() {
        0..FEW => Nearness::Words,
        _ => Nearness::Scattered,
    };
    let pattern = Pattern::parse(wanted, CaseMatching::Ignore, Normalization::Smart);
    let mut matcher = Matcher::new(Config::DEFAULT);
    let mut buffer = Vec::new();
    all.into_iter()
        .filter_map(|(line, hint)| {
            let synonyms = synonyms(&line, &state.locale);
            let hint_words = state.locale.text(&hint);
            let meaning = format!("{hint_words} {}", synonyms.unwrap_or_default());
            let near = Nearness::of(&line, &meaning, wanted);
            // Letters scattered over a sentence mean nothing.
            let searched = match near {
                Nearness::Scattered => line.clone(),
                Nearness::Line | Nearness::Words | Nearness::Meaning => format!("{line} {meaning}"),
            };
            let score = pattern.score(Utf32Str::new(&searched, &mut buffer), &mut matcher)?;
            // Completion finds verbs by scattered letters.
            let is_verb = || verbs.iter().any(|(verb, _)| *verb == line);
            let is_meant = near != Nearness::Scattered || !is_verb();
            (near <= farthest && is_meant).then_some((near, score, (line, hint)))
        })
        .collect()
}

/// Whether the text matches a line better than by scattered letters.
pub fn is_near(state: &State, written: &str) -> bool {
    let scored = scored(state, written);
    scored.iter().any(|(near, ..)| *near != Nearness::Scattered)
}

/// The lines that match the text, best first. Scattered letters count only if there is no better
/// match.
pub fn lines(state: &State, written: &str) -> Vec<Completion> {
    let mut scored = scored(state, written);
    let is_exact = language::row(written.trim()).is_some();
    if is_exact || scored.iter().any(|(near, ..)| *near != Nearness::Scattered) {
        scored.retain(|(near, ..)| *near != Nearness::Scattered);
    }
    scored.sort_by_key(|(near, score, _)| (*near, Reverse(*score)));
    let shown = scored.into_iter().take(SHOWN);
    shown
        .map(|(.., (text, hint))| Completion {
            text,
            hint,
            replaces: 0..written.len(),
        })
        .collect()
}

/// Whether a line has an effect only in a replay.
fn needs_replay(state: &State, line: &str) -> bool {
    let read = state.with_context(|context| language::parse(line, context));
    read.is_ok_and(|statement| match statement.meaning {
        language::Meaning::Console(own) => own.needs() == LineNeeds::Replay,
        language::Meaning::Act(_) | language::Meaning::Wait(_) => false,
    })
}

/// Synonyms of a line's verb, or the title of the room that the line opens, in the screen's
/// language.
fn synonyms(line: &str, locale: &Locale) -> Option<String> {
    let mut words = line.split(' ');
    let row = language::row(words.next()?)?;
    if row.takes(Kind::Name(NameList::Room)) {
        return Some(locale.text(&Room::named(words.next()?)?.title()));
    }
    row.synonyms(locale)
}

/// Vehicles and groups to select.
fn vehicles(state: &State, written: &str) -> Vec<(String, Text)> {
    let mut found = Vec::new();
    for name in state.session.choice.groups.keys() {
        found.push((format!("select @{name}"), text!("palette-selects")));
    }
    let ids = state.session.vehicles.keys().map(ToString::to_string);
    let named = ids.filter(|id| written.split_whitespace().any(|word| id.starts_with(word)));
    found.extend(
        named
            .take(VEHICLES_SHOWN)
            .map(|id| (format!("select {id}"), text!("palette-selects"))),
    );
    found
}
