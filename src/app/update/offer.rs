//! Whole lines that the command line offers: whatever the console can do, and what was given before.

use std::cmp::Reverse;

use nucleo_matcher::pattern::{CaseMatching, Normalization, Pattern};
use nucleo_matcher::{Config, Matcher, Utf32Str};

use crate::app::State;
use crate::language::{self, Completion};
use crate::text;
use crate::text::Text;

/// Lines offered at most.
const SHOWN: usize = 100;
/// Vehicles offered at most.
const VEHICLES_SHOWN: usize = 20;

/// The lines in which everything that is written occurs, in the line itself or in what it means, best first.
pub fn lines(state: &State, written: &str) -> Vec<Completion> {
    let mut all = state.with_context(language::lines);
    all.extend(vehicles(state, written));
    let given_before = state.history.iter().rev();
    all.extend(given_before.map(|line| (line.clone(), text!("palette-given-before"))));
    let pattern = Pattern::parse(written.trim(), CaseMatching::Ignore, Normalization::Smart);
    let mut matcher = Matcher::new(Config::DEFAULT);
    let mut buffer = Vec::new();
    let mut scored: Vec<(u32, (String, Text))> = all
        .into_iter()
        .filter_map(|(line, hint)| {
            let synonyms = synonyms(&line).map(|words| state.locale.text(&words));
            let hint_words = state.locale.text(&hint);
            let searched = format!("{line} {hint_words} {}", synonyms.unwrap_or_default());
            let score = pattern.score(Utf32Str::new(&searched, &mut buffer), &mut matcher)?;
            Some((score, (line, hint)))
        })
        .collect();
    scored.sort_by_key(|(score, _)| Reverse(*score));
    let shown = scored.into_iter().take(SHOWN);
    shown
        .map(|(_, (text, hint))| Completion {
            text,
            hint,
            replaces: 0..written.len(),
        })
        .collect()
}

/// What people also call the verb that a line begins with, in the language of the screens.
fn synonyms(line: &str) -> Option<Text> {
    let verb = language::row(line.split(' ').next()?)?.name();
    Some(match verb {
        "arm" => text!("words-arm"),
        "disarm" => text!("words-disarm"),
        "kill" => text!("words-kill"),
        "takeoff" => text!("words-takeoff"),
        "land" => text!("words-land"),
        "rtl" => text!("words-rtl"),
        "hold" => text!("words-hold"),
        "goto" => text!("words-goto"),
        "altitude" => text!("words-altitude"),
        "speed" => text!("words-speed"),
        "survey" => text!("words-survey"),
        "formation" => text!("words-formation"),
        "mark" => text!("words-mark"),
        "hint" => text!("words-hint"),
        _ => return None,
    })
}

/// Vehicles and groups, to be selected.
fn vehicles(state: &State, written: &str) -> Vec<(String, Text)> {
    let mut found = Vec::new();
    for name in state.session.groups.keys() {
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
