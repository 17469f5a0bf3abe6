//! Parses a line into a statement.

use std::ops::Range;

use super::argument::Kind;
use super::console::ConsoleLine;
use super::form::{Expected, Fit, Misfit, fit};
use super::lexer::{Word, words};
use super::modes::{mode_named, mode_names};
use super::names::Listed;
use super::table::{row, rows};
use super::verb::{Channel, Form, Meaning, Scope, VerbRow};
use super::{Context, Statement, Targets};
use crate::diagnostic::Diagnostic;
use crate::text;
use crate::text::Text;

/// The beginning of a line: everything before the arguments.
pub(super) struct Head {
    pub targets: Targets,
    pub row: &'static VerbRow,
    /// The verb as typed: its name, or the name of a mode.
    pub said: String,
    /// The number of words before the arguments; a mode in place of `mode MODE` is an argument.
    pub len: usize,
}

/// Reads a line.
///
/// # Errors
/// The first fault, with its position in the line.
pub fn parse(line: &str, context: &Context) -> Result<Statement, Diagnostic> {
    let words = words(line);
    let head = head(&words, context)?;
    let rest = &words[head.len..];
    let (mut meaning, form) = understand(&head, rest, &words, context)?;
    if let Meaning::Console(ConsoleLine::Carried { targets, .. }) = &mut meaning {
        targets.clone_from(&head.targets);
    }
    Ok(Statement {
        line: match meaning {
            Meaning::Act(_) | Meaning::Wait(_) => normalised(&head, rest),
            Meaning::Console(_) => words.first().map_or("", |word| word.tail).to_owned(),
        },
        scope: head.row.scope,
        verb: form.means.unwrap_or(&head.row.verb),
        targets: head.targets,
        meaning,
    })
}

/// The verb of a line, after optional targets.
///
/// # Errors
/// The verb is missing or not allowed there, or the targets are wrong.
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
            .with_help(text!("grammar-say-it-as", usage = usages(found))));
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

/// The fault of a verb that is not allowed there.
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

/// Builds the meaning with the matching form, and returns its index.
pub(super) fn understand(
    head: &Head,
    rest: &[Word],
    all: &[Word],
    context: &Context,
) -> Result<(Meaning, &'static Form), Diagnostic> {
    let mut fits = Vec::new();
    for form in head.row.forms {
        let fit = fit(form, rest, context);
        if fit.complete {
            return match (form.build)(&fit.arguments) {
                Ok(meaning) => Ok((meaning, form)),
                Err(problem) => {
                    let argument = fit.arguments.span(problem.argument);
                    let span = argument.unwrap_or_else(|| end_of(all));
                    Err(Diagnostic::new(span, problem.message))
                }
            };
        }
        fits.push(fit);
    }
    Err(fault(head.row, &fits, rest, all, context))
}

/// The fault, according to the form that matches best.
fn fault(
    row: &'static VerbRow,
    fits: &[Fit],
    rest: &[Word],
    all: &[Word],
    context: &Context,
) -> Diagnostic {
    let progress = |fit: &Fit| match &fit.misfit {
        Some(misfit) => (misfit.word, misfit.specific),
        None => (rest.len(), false),
    };
    let furthest = fits.iter().map(progress).max().unwrap_or((0, false));
    let (forms, closest): (Vec<usize>, Vec<&Fit>) = fits
        .iter()
        .enumerate()
        .filter(|(_, fit)| progress(fit) == furthest)
        .unzip();
    let Some(word) = rest.get(furthest.0) else {
        let expected = closest.iter().flat_map(|fit| fit.expected.iter());
        // After its keyword, even an optional argument needs its value.
        let needed = |item: &Expected| match item {
            Expected::Keyword(argument) => !argument.optional,
            Expected::Value(argument) => !argument.optional || !argument.keyword.is_empty(),
        };
        let missing = list(expected.copied().filter(needed));
        let example = example_of(row, &forms);
        let mut expected = closest.iter().flat_map(|fit| fit.expected.iter());
        let needs = || text!("grammar-needs", verb = row.name(), missing = missing);
        let why_not = expected.find_map(|item| unavailable(*item, context));
        let message = why_not.unwrap_or_else(needs);
        return Diagnostic::new(end_of(all), message)
            .with_help(text!("grammar-for-example", line = example));
    };
    let misfits: Vec<&Misfit> = closest
        .iter()
        .filter_map(|fit| fit.misfit.as_ref())
        .collect();
    misfit_fault(row, word, &misfits, context)
}

/// Why no name is valid where one is expected.
fn unavailable(expected: Expected, context: &Context) -> Option<Text> {
    let Kind::Name(list) = expected.argument().kind else {
        return None;
    };
    match context.names.listed(list) {
        Listed::Nothing(why) => Some(why),
        Listed::Anything | Listed::Names(_) => None,
    }
}

/// The usages of a verb: "`ack` or `ack KIND`".
fn usages(row: &VerbRow) -> Text {
    let usages = row.usage().into_iter();
    either(usages.map(|usage| format!("`{usage}`").into()).collect())
}

/// An example of one of these forms of a verb, otherwise the verb's first example.
fn example_of(row: &'static VerbRow, forms: &[usize]) -> &'static str {
    let context = Context {
        channel: Channel::Plain,
        ..Context::default()
    };
    let shows = |example: &&&str| {
        let words = words(example);
        head(&words, &context).is_ok_and(|head| {
            let rest = &words[head.len..];
            let complete = |form| fit(form, rest, &context).complete;
            let form = row.forms.iter().position(complete);
            form.is_some_and(|form| forms.contains(&form))
        })
    };
    let example = row.examples.iter().find(shows);
    example
        .or(row.examples.first())
        .copied()
        .unwrap_or(row.name())
}

fn misfit_fault(row: &VerbRow, word: &Word, misfits: &[&Misfit], context: &Context) -> Diagnostic {
    let span = word.span.clone();
    let expected = || {
        misfits
            .iter()
            .flat_map(|misfit| misfit.expected.iter().copied())
    };
    let message = match misfits {
        [misfit, ..] if misfit.specific || misfits.len() == 1 => misfit.message.clone(),
        _ => None,
    };
    if expected().next().is_none() {
        let message = text!("grammar-too-much", word = word.text);
        return Diagnostic::new(span, message)
            .with_help(text!("grammar-say-it-as", usage = usages(row)));
    }
    let what = list(expected());
    let specific = misfits.iter().any(|misfit| misfit.specific);
    let names: Vec<String> = expected()
        .flat_map(|item| names_of(item, context))
        .collect();
    let says_what = message.is_none() || specific;
    let message = message.unwrap_or_else(|| {
        text!(
            "grammar-does-not-fit",
            word = word.text,
            expected = what.clone()
        )
    });
    let fault =
        Diagnostic::new(span, message).with_nearest(word.text, names.iter().map(String::as_str));
    match fault.help {
        None if !says_what => fault.with_help(
            there_are(&names, misfits)
                .unwrap_or_else(|| text!("grammar-expected", expected = what)),
        ),
        _ => fault,
    }
}

/// A list of the valid names, if only a name from a list was possible.
fn there_are(names: &[String], misfits: &[&Misfit]) -> Option<Text> {
    let mut expected = misfits.iter().flat_map(|misfit| misfit.expected.iter());
    let is_name = |item: &Expected| matches!(item.argument().kind, Kind::Name(_));
    expected.all(is_name).then(|| match names {
        [] => text!("grammar-none-there"),
        names => text!("grammar-there-are", names = names.join(", ")),
    })
}

/// The words that are possible for an expected argument.
fn names_of(expected: Expected, context: &Context) -> Vec<String> {
    match expected {
        Expected::Keyword(argument) => vec![argument.keyword.to_owned()],
        Expected::Value(argument) => match argument.kind {
            Kind::Flag => Vec::new(),
            kind => kind
                .names(context)
                .into_iter()
                .map(|(name, _)| name)
                .collect(),
        },
    }
}

/// "A, B or C", each once.
fn list(expected: impl Iterator<Item = Expected>) -> Text {
    let mut texts: Vec<Text> = Vec::new();
    for text in expected.map(Expected::describe) {
        if !texts.contains(&text) {
            texts.push(text);
        }
    }
    match texts.as_slice() {
        [] => text!("grammar-nothing-more"),
        [only] => only.clone(),
        [others @ .., last] => text!(
            "grammar-or",
            others = Text::joined(", ", others.to_vec()),
            last = last
        ),
    }
}

/// "A or B or C".
fn either(texts: Vec<Text>) -> Text {
    let mut texts = texts.into_iter();
    let first = texts.next().unwrap_or_default();
    texts.fold(first, |all, text| {
        text!("grammar-or", others = all, last = text)
    })
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
fn end_of(words: &[Word]) -> Range<usize> {
    let end = words.last().map_or(0, |word| word.span.end);
    end..end
}

/// The line in its canonical spelling.
fn normalised(head: &Head, rest: &[Word]) -> String {
    let targets = head.targets.to_string();
    let mut parts: Vec<&str> = vec![&targets, &head.said];
    if head.row.scope == Scope::Scripts {
        parts.swap(0, 1);
    }
    parts.extend(rest.iter().map(|word| word.text));
    parts.retain(|part| !part.is_empty());
    parts.join(" ")
}
