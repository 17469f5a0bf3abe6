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
            Some((word, span)) => {
                Sort::named(word).ok_or_else(|| no_column(word.trim_start_matches('-'), span))?
            }
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
            Some((word, _)) => match AlertKind::named(word) {
                Some(kind) => SwarmLine::AcknowledgeKind(kind),
                None => SwarmLine::AcknowledgeOf((*word).to_owned()),
            },
        },
    })
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

fn columns(words: &Words<'_>) -> Result<Vec<String>, Diagnostic> {
    let name = |(word, span): &(&str, Range<usize>)| match Column::named(word) {
        Some(_) => Ok((*word).to_owned()),
        None => Err(no_column(word, span)),
    };
    words.iter().map(name).collect()
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
