//! The console's own lines about the table and its alerts.

use std::ops::Range;

use crate::alert::AlertKind;
use crate::config::{Column, TableSort};
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
    Sort(TableSort),
    /// Show only what fits; everything if empty.
    Filter(String),
    /// Show these columns; as many as fit if empty.
    Columns(Vec<Column>),
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
            None => TableSort::BY_ID,
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

/// The words that may follow a verb, for completion.
pub fn choices(verb: SwarmVerb) -> Vec<&'static str> {
    match verb {
        SwarmVerb::Sort | SwarmVerb::Columns => Column::NAMES.to_vec(),
        SwarmVerb::Mute | SwarmVerb::Unmute | SwarmVerb::Acknowledge => AlertKind::NAMES.to_vec(),
        SwarmVerb::Filter | SwarmVerb::Ungroup => Vec::new(),
    }
}

/// Whether a word is meant as vehicles, whether they are there or not.
fn names_vehicles(word: &str) -> bool {
    matches!(word, "all" | "none" | "filter" | "invert")
        || word.starts_with(|c: char| c == '@' || c.is_ascii_digit())
}

fn columns(words: &Words<'_>) -> Result<Vec<Column>, Diagnostic> {
    words.iter().map(column).collect()
}

fn column((word, span): &(&str, Range<usize>)) -> Result<Column, Diagnostic> {
    Column::read(word).map_err(|fault| placed(fault, span))
}

fn sort((word, span): &(&str, Range<usize>)) -> Result<TableSort, Diagnostic> {
    TableSort::read(word).map_err(|fault| placed(fault, span))
}

fn kind((word, span): &(&str, Range<usize>)) -> Result<AlertKind, Diagnostic> {
    AlertKind::read(word).map_err(|fault| placed(fault, span))
}

fn placed(fault: Diagnostic, span: &Range<usize>) -> Diagnostic {
    Diagnostic {
        span: span.clone(),
        ..fault
    }
}
