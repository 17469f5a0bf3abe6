//! The beginning of a line: its targets and its verb.

use std::ops::Range;

use super::lexer::{Word, words};
use super::modes::{mode_named, mode_names};
use super::table::{row, rows};
use super::verb::{Scope, VerbRow};
use super::{Context, Targets};
use crate::diagnostic::Diagnostic;
use crate::text;
use crate::text::Text;

/// The beginning of a line: everything before the arguments.
pub(super) struct Head {
    pub targets: Targets,
    pub row: &'static VerbRow,
    /// The verb as typed: its name, or the name of a mode.
    pub said: String,
    /// The number of words before the arguments. A mode's name that stands in place of `mode MODE`
    /// counts as an argument.
    pub len: usize,
}

/// The verb of a line, after optional targets.
///
/// # Errors
/// The verb is missing or not allowed in lines from this source, or the targets are wrong.
pub fn said(line: &str, context: &Context) -> Result<&'static VerbRow, Diagnostic> {
    head(&words(line), context).map(|head| head.row)
}

/// Reads targets and verb.
///
/// # Errors
/// They are missing or wrong.
pub(super) fn head(words: &[Word], context: &Context) -> Result<Head, Diagnostic> {
    let mut at = 0;
    let mut targets = Targets::Selection;
    if let Some(word) = words.first()
        && word.is_targets()
    {
        targets = Targets::read(word, context)?;
        at = 1;
    }
    let Some(word) = words.get(at) else {
        let end = end_of(words);
        return Err(Diagnostic::new(end, text!("grammar-no-command"))
            .with_help(text!("grammar-no-command-help")));
    };
    let Some(found) = row(word.text) else {
        // A mode's name alone changes to it.
        return match (mode_named(word.text, context), row("mode")) {
            (Some(_), Some(mode)) => Ok(Head {
                targets,
                row: mode,
                said: String::new(),
                len: at,
            }),
            _ => Err(unknown_verb(word, context)),
        };
    };
    if !found.scope.includes(context.channel) {
        return Err(out_of_place(word, found.scope));
    }
    if at > 0 && !found.scope.takes_targets() {
        let message = text!("grammar-no-targets-here", verb = found.name());
        return Err(Diagnostic::new(words[0].span.clone(), message)
            .with_help(text!("grammar-say-it-as", usage = found.usages())));
    }
    let mut head = Head {
        targets,
        row: found,
        said: found.name().to_owned(),
        len: at + 1,
    };
    if found.scope == Scope::Scripts {
        targets_after(&mut head, words, context)?;
    }
    Ok(head)
}

/// The fault of a verb that is not allowed in lines from this source.
fn out_of_place(word: &Word, scope: Scope) -> Diagnostic {
    let fault = |message: Text| Diagnostic::new(word.span.clone(), message);
    match scope {
        Scope::Scripts => fault(text!("order-wait")).with_help(text!("order-wait-help")),
        Scope::Plain => fault(text!("grammar-only-plain", verb = word.text)),
        Scope::Everywhere | Scope::Console | Scope::Screen => {
            fault(text!("grammar-only-console", verb = word.text))
        }
    }
}

/// Reads targets after `wait`.
fn targets_after(head: &mut Head, words: &[Word], context: &Context) -> Result<(), Diagnostic> {
    let left = words.len() - head.len;
    let Some(word) = words.get(head.len) else {
        return Ok(());
    };
    if !targets_of_wait(word, left) {
        return Ok(());
    }
    if head.targets != Targets::Selection {
        let message = text!("grammar-targets-twice");
        return Err(Diagnostic::new(word.span.clone(), message));
    }
    head.targets = Targets::read(word, context)?;
    head.len += 1;
    Ok(())
}

/// Whether a word after `wait` is a target: `wait 5` is a time, `wait 5 armed` waits for vehicle 5, and `wait 5s` is
/// always a time.
fn targets_of_wait(word: &Word, left: usize) -> bool {
    let numbers = word
        .text
        .bytes()
        .all(|byte| byte.is_ascii_digit() || byte == b'-' || byte == b',');
    word.is_targets()
        && (!word.text.starts_with(|c: char| c.is_ascii_digit()) || numbers && left > 1)
}

fn unknown_verb(word: &Word, context: &Context) -> Diagnostic {
    let fault = Diagnostic::new(
        word.span.clone(),
        text!("grammar-unknown-command", word = word.text),
    );
    let sayable = rows().filter(|row| row.scope.includes(context.channel));
    let names =
        sayable.flat_map(|row| std::iter::once(row.name()).chain(row.aliases.iter().copied()));
    fault.with_nearest(word.text, names.chain(mode_names(context)))
}

/// The position after the last word.
pub(super) fn end_of(words: &[Word]) -> Range<usize> {
    let end = words.last().map_or(0, |word| word.span.end);
    end..end
}
