//! Texts for faults of files and for notes of readers.

use crate::plan::{ArchiveFault, Expected, FaultKind, NoteKind, Syntax};
use crate::text;
use crate::text::{Text, figure};

pub(super) fn words(kind: &FaultKind) -> Text {
    match kind {
        FaultKind::UnknownFormat => text!("plan-file-unknown"),
        FaultKind::NotText => text!("plan-file-not-text"),
        FaultKind::Version { found, known } => {
            text!("plan-file-version", found = found, known = *known)
        }
        FaultKind::Fields { found, expected } => {
            text!("plan-file-fields", found = *found, expected = *expected)
        }
        FaultKind::NotANumber(written) => text!("plan-file-number", text = written),
        FaultKind::OutOfRange(written) => text!("plan-file-range", text = written),
        FaultKind::Order { found, expected } => {
            text!("plan-file-order", found = *found, expected = *expected)
        }
        FaultKind::Syntax(syntax) => syntax_words(*syntax),
        FaultKind::Xml(error) => text!("plan-file-xml", error = error),
        FaultKind::Missing(name) => text!("plan-file-missing", name = *name),
        FaultKind::Expected(expected) => expected_words(*expected),
        FaultKind::NoEmbeddedItems(name) => text!("plan-file-no-items", kind = name),
        FaultKind::UnknownJump(id) => text!("plan-file-jump", id = *id),
        FaultKind::FewCorners(count) => text!("plan-file-corners", count = *count),
        FaultKind::ShortLine => text!("plan-file-line"),
        FaultKind::TooMany => text!("plan-file-many"),
        FaultKind::Empty => text!("plan-file-empty"),
        FaultKind::Archive(ArchiveFault::Damaged) => text!("plan-file-archive-damaged"),
        FaultKind::Archive(ArchiveFault::NoKml) => text!("plan-file-archive-no-kml"),
        FaultKind::Archive(ArchiveFault::Method) => text!("plan-file-archive-method"),
        FaultKind::Archive(ArchiveFault::TooLarge) => text!("plan-file-archive-large"),
    }
}

fn syntax_words(syntax: Syntax) -> Text {
    match syntax {
        Syntax::End => text!("plan-file-syntax-end"),
        Syntax::Unexpected(character) => {
            text!("plan-file-syntax-unexpected", character = character)
        }
        Syntax::Text => text!("plan-file-syntax-text"),
        Syntax::Trailing => text!("plan-file-syntax-trailing"),
        Syntax::TooDeep => text!("plan-file-syntax-deep"),
    }
}

fn expected_words(expected: Expected) -> Text {
    match expected {
        Expected::Number => text!("plan-file-expected-number"),
        Expected::NumberOrNull => text!("plan-file-expected-number-or-null"),
        Expected::Text => text!("plan-file-expected-text"),
        Expected::Flag => text!("plan-file-expected-flag"),
        Expected::List => text!("plan-file-expected-list"),
        Expected::Object => text!("plan-file-expected-object"),
        Expected::Length(count) => text!("plan-file-expected-length", count = count),
        Expected::Position => text!("plan-file-expected-position"),
        Expected::Word(words) => text!("plan-file-expected-word", words = words),
    }
}

pub fn note(kind: &NoteKind) -> Text {
    match kind {
        NoteKind::HeightAssumed(height_m) => {
            text!("plan-note-height", height = figure(*height_m, 0))
        }
        NoteKind::HomeHeightMissing => text!("plan-note-home-height"),
        NoteKind::FractionLost => text!("plan-note-fraction"),
        NoteKind::LinesJoined(count) => text!("plan-note-lines", count = *count),
    }
}
