//! The console's own lines about the table and its alerts.

use std::ops::Range;

use crate::app::state::{AlertKind, Column, Sort};
use crate::diagnostic::Diagnostic;
use crate::text;

/// What a line is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SwarmVerb {
    /// The order of the table.
    Sort,
    /// What is in it.
    Filter,
    /// Its columns.
    Columns,
    /// A group's end.
    Ungroup,
    /// Kinds of alert that stay silent.
    Mute,
    /// Kinds of alert that ring again.
    Unmute,
    /// Taking note of alerts.
    Acknowledge,
}

/// A line about the table or its alerts.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum SwarmLine {
    /// Order by a column.
    Sort(Sort),
    /// Show only what fits; everything if empty.
    Filter(String),
    /// Show these columns; as many as fit if empty.
    Columns(Vec<String>),
    /// Forget a group's name.
    Ungroup(String),
    /// Keep a kind of alert silent; none asks which are.
    Mute(Option<AlertKind>),
    /// Let a kind ring again; none means all.
    Unmute(Option<AlertKind>),
    /// Take note of the worst alerts.
    AcknowledgeWorst,
    /// Take note of all alerts of a kind.
    AcknowledgeKind(AlertKind),
    /// Take note of all alerts of vehicles.
    AcknowledgeOf(String),
}

/// The words of a line after its verb: what is written, and where.
pub type Words<'a> = [(&'a str, Range<usize>)];

/// Reads the words after a verb.
///
/// # Errors
/// A word that names no column or no kind of alert.
pub fn read(verb: SwarmVerb, words: &Words<'_>) -> Result<SwarmLine, Diagnostic> {
    let first = words.first();
    Ok(match verb {
        SwarmVerb::Sort => SwarmLine::Sort(match first {
            Some(word) => sort(word)?,
            None => Sort::BY_ID,
        }),
        SwarmVerb::Filter => {
            let words: Vec<&str> = words.iter().map(|(word, _)| *word).collect();
            SwarmLine::Filter(words.join(" "))
        }
        SwarmVerb::Columns => SwarmLine::Columns(columns(words)?),
        SwarmVerb::Ungroup => {
            let name = first.map_or("", |(word, _)| word);
            SwarmLine::Ungroup(name.trim_start_matches('@').to_owned())
        }
        SwarmVerb::Mute => SwarmLine::Mute(first.map(kind).transpose()?),
        SwarmVerb::Unmute => SwarmLine::Unmute(first.map(kind).transpose()?),
        SwarmVerb::Acknowledge => match first {
            None => SwarmLine::AcknowledgeWorst,
            Some((word, _)) if names_vehicles(word) => SwarmLine::AcknowledgeOf((*word).to_owned()),
            Some(word) => kind(word)
                .map(SwarmLine::AcknowledgeKind)
                .map_err(|fault| Diagnostic {
                    message: text!("alert-no-kind-or-vehicle", word = word.0),
                    ..fault
                })?,
        },
    })
}

/// Checks a word of a setting of the table or of its alerts; other settings have nothing to do with them.
///
/// # Errors
/// It names no column or no kind of alert; the place is the whole word.
pub fn check_setting(setting: &str, word: &str) -> Result<(), Diagnostic> {
    let word = (word, 0..word.len());
    match setting {
        "table.columns" => column(&word).map(drop),
        "table.sort" if !word.0.is_empty() => sort(&word).map(drop),
        "alerts.mute" => kind(&word).map(drop),
        _ => Ok(()),
    }
}

/// The words that may follow a verb, for completion.
pub fn choices(verb: SwarmVerb) -> Vec<&'static str> {
    match verb {
        SwarmVerb::Sort | SwarmVerb::Columns => Column::ALL.iter().map(|(name, _)| *name).collect(),
        SwarmVerb::Mute | SwarmVerb::Unmute | SwarmVerb::Acknowledge => {
            AlertKind::ALL.iter().map(|(name, _)| *name).collect()
        }
        SwarmVerb::Filter | SwarmVerb::Ungroup => Vec::new(),
    }
}

/// Whether a word is meant as vehicles, whether they are there or not.
fn names_vehicles(word: &str) -> bool {
    matches!(word, "all" | "none" | "filter" | "invert")
        || word.starts_with(|c: char| c == '@' || c.is_ascii_digit())
}

fn columns(words: &Words<'_>) -> Result<Vec<String>, Diagnostic> {
    let name = |word: &(&str, Range<usize>)| column(word).map(|column| column.name().to_owned());
    words.iter().map(name).collect()
}

fn column((word, span): &(&str, Range<usize>)) -> Result<Column, Diagnostic> {
    Column::named(word).ok_or_else(|| no_column(word, span))
}

fn sort((word, span): &(&str, Range<usize>)) -> Result<Sort, Diagnostic> {
    Sort::named(word).ok_or_else(|| no_column(word.trim_start_matches('-'), span))
}

fn kind((word, span): &(&str, Range<usize>)) -> Result<AlertKind, Diagnostic> {
    let names = || AlertKind::ALL.iter().map(|(name, _)| *name);
    AlertKind::named(word).ok_or_else(|| {
        let kinds: Vec<&str> = names().collect();
        Diagnostic::new(span.clone(), text!("alert-no-kind", word = *word))
            .with_help(text!("alert-kinds-are", kinds = kinds.join(" ")))
            .with_nearest(word, names())
    })
}

fn no_column(word: &str, span: &Range<usize>) -> Diagnostic {
    let names = Column::ALL.iter().map(|(name, _)| *name);
    Diagnostic::new(span.clone(), text!("fly-no-column", word = word))
        .with_help(text!("fly-columns-are", columns = Column::names()))
        .with_nearest(word, names)
}
