//! Parses a line into a statement.

use std::ops::Range;

use super::argument::Kind;
use super::console::ConsoleLine;
use super::fault::fault;
use super::form::fit;
use super::head::{Head, end_of, head};
use super::lexer::{Word, field_texts, words};
use super::table::arguments_of;
use super::verb::{Form, Meaning, Scope};
use super::{Context, Statement};
use crate::diagnostic::Diagnostic;
use crate::draft::EditPart;

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
            Meaning::Act(_) | Meaning::Wait(_) => normalised(&head, form, rest),
            Meaning::Console(_) => words.first().map_or("", |word| word.tail).to_owned(),
        },
        scope: head.row.scope,
        verb: form.means.unwrap_or(&head.row.verb),
        targets: head.targets,
        meaning,
    })
}

/// Builds the meaning of a line, and returns it with the matching form.
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
                    Err(problem.at(argument.unwrap_or_else(|| end_of(all))))
                }
            };
        }
        fits.push(fit);
    }
    Err(fault(head.row, &fits, rest, all, context))
}

/// The position of a part of a change in a line about a draft; `None` if the line does not contain
/// the part.
pub fn draft_part(line: &str, part: EditPart, context: &Context) -> Option<Range<usize>> {
    let words = words(line);
    let head = head(&words, context).ok()?;
    let mut fits = head.row.forms.iter();
    let fit = fits.find_map(|form| {
        let fit = fit(form, &words[head.len..], context);
        fit.complete.then_some(fit)
    })?;
    let mut names = arguments_of(part).iter();
    names.find_map(|name| fit.arguments.span(name))
}

/// The free texts in a line, which may be in any language: a name, a remark, or the texts of a message's fields.
pub fn free_texts(line: &str, context: &Context) -> Vec<Range<usize>> {
    let words = words(line);
    let Ok(head) = head(&words, context) else {
        return Vec::new();
    };
    if head.row.takes(Kind::Fields) {
        return field_texts(line);
    }
    let of_form = |form: &'static Form| {
        let fit = fit(form, &words[head.len..], context);
        let mut free = form.arguments.iter().filter(|it| it.is_free_text());
        free.find_map(|argument| {
            let span = fit.arguments.span(argument.name)?;
            let mut inside = words.iter().filter(|word| span.contains(&word.span.start));
            let first = inside.nth(usize::from(!argument.keyword.is_empty()))?;
            Some(first.span.start..span.end)
        })
    };
    let mut forms = head.row.forms.iter();
    forms.find_map(of_form).into_iter().collect()
}

/// The line in its canonical spelling. The fields of a message stay as typed, because blanks in a text count.
fn normalised(head: &Head, form: &Form, rest: &[Word]) -> String {
    let targets = head.targets.to_string();
    let mut parts: Vec<&str> = vec![&targets, &head.said];
    if head.row.scope == Scope::Scripts {
        parts.swap(0, 1);
    }
    let mut arguments = form.arguments.iter();
    let fields = arguments.position(|argument| argument.kind == Kind::Fields);
    let (words, fields) = rest.split_at(fields.unwrap_or(rest.len()).min(rest.len()));
    parts.extend(words.iter().map(|word| word.text));
    parts.extend(fields.first().map(|first| first.tail));
    parts.retain(|part| !part.is_empty());
    parts.join(" ")
}
