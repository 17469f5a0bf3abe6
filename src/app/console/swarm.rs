//! The console's own lines about the table and its alerts.

use crate::alert::AlertKind;
use crate::config::{Column, TableSort};
use crate::diagnostic::Diagnostic;
use crate::language::Word;
use crate::text;

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

/// By number where no column is named.
pub(super) fn sort(column: Option<&Word<'_>>) -> Result<SwarmLine, Diagnostic> {
    let Some(word) = column else {
        return Ok(SwarmLine::Sort(TableSort::BY_ID));
    };
    let sort = TableSort::read(word.text).map_err(|fault| placed(fault, word))?;
    Ok(SwarmLine::Sort(sort))
}

pub(super) fn filter(words: &str) -> SwarmLine {
    let words: Vec<&str> = words.split_whitespace().collect();
    SwarmLine::Filter(words.join(" "))
}

pub(super) fn columns(words: &[Word<'_>]) -> Result<SwarmLine, Diagnostic> {
    let column = |word: &Word<'_>| Column::read(word.text).map_err(|fault| placed(fault, word));
    let columns: Result<Vec<Column>, Diagnostic> = words.iter().map(column).collect();
    columns.map(SwarmLine::Columns)
}

pub(super) fn ungroup(name: &str) -> SwarmLine {
    SwarmLine::Ungroup(name.trim_start_matches('@').to_owned())
}

pub(super) fn mute(word: Option<&Word<'_>>) -> Result<SwarmLine, Diagnostic> {
    Ok(SwarmLine::Mute(word.map(kind).transpose()?))
}

pub(super) fn unmute(word: Option<&Word<'_>>) -> Result<SwarmLine, Diagnostic> {
    Ok(SwarmLine::Unmute(word.map(kind).transpose()?))
}

/// A kind or vehicles; the worst where nothing is named.
pub(super) fn acknowledge(word: Option<&Word<'_>>) -> Result<SwarmLine, Diagnostic> {
    let Some(word) = word else {
        return Ok(SwarmLine::AcknowledgeWorst);
    };
    if names_vehicles(word) {
        return Ok(SwarmLine::AcknowledgeOf(word.text.to_owned()));
    }
    let kind = kind(word).map_err(|fault| Diagnostic {
        message: text!("alert-no-kind-or-vehicle", word = word.text),
        ..fault
    })?;
    Ok(SwarmLine::AcknowledgeKind(kind))
}

/// Whether a word is meant as vehicles, whether they are there or not.
fn names_vehicles(word: &Word<'_>) -> bool {
    matches!(word.text, "none" | "filter" | "invert") || word.is_targets()
}

fn kind(word: &Word<'_>) -> Result<AlertKind, Diagnostic> {
    AlertKind::read(word.text).map_err(|fault| placed(fault, word))
}

fn placed(fault: Diagnostic, word: &Word<'_>) -> Diagnostic {
    Diagnostic {
        span: word.span.clone(),
        ..fault
    }
}
