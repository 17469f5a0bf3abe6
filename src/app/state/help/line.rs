//! The lines of the help and their widths: usages, explanations and notes are wrapped so that none is cut.
//!
//! They are apart because every part of the help writes such lines, and only this one measures them.

use unicode_width::UnicodeWidthStr as _;

use crate::language::VerbRow;
use crate::text::Locale;

/// The maximum number of columns of a usage with an explanation beside it.
pub const SHORT_USAGE: usize = 22;

/// The maximum number of columns of an explanation beside a usage.
pub(super) const SHORT_SUMMARY: usize = 49;
/// The width of a usage that has a line to itself.
const USAGE_WIDTH: usize = 64;
/// The maximum number of columns of a note.
pub(super) const NOTE_WIDTH: usize = 66;

/// One line of the help.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum HelpLine {
    Title(String),
    /// A key or a command, and its effect.
    Entry(String, String),
    /// An explanation below an entry.
    Note(String),
    /// A form of a verb, below its entry.
    Usage(String),
    Blank,
}

/// A verb with its summary beside its usage; the summary is below if either is long. A verb with several forms has its
/// summary before them.
pub(super) fn explained(row: &VerbRow, locale: &Locale) -> Vec<HelpLine> {
    let summary = locale.text(&row.summary());
    let usages = row.usage();
    let beside = |what: &str| {
        let fits = what.width() <= SHORT_USAGE && summary.width() <= SHORT_SUMMARY;
        fits.then(|| HelpLine::Entry(what.to_owned(), summary.clone()))
    };
    if let [usage] = usages.as_slice() {
        return beside(usage).map_or_else(
            || {
                let mut lines: Vec<HelpLine> =
                    row.usage_parts().flat_map(|parts| alone(&parts)).collect();
                lines.extend(notes(&summary));
                lines
            },
            |line| vec![line],
        );
    }
    let mut lines = beside(row.name()).map_or_else(
        || {
            let name = HelpLine::Entry(row.name().to_owned(), String::new());
            std::iter::once(name).chain(notes(&summary)).collect()
        },
        |line| vec![line],
    );
    let forms = row.usage_parts().flat_map(|parts| usage_lines(&parts));
    lines.extend(forms.map(HelpLine::Usage));
    lines
}

/// A usage without a summary.
fn alone(parts: &[String]) -> Vec<HelpLine> {
    let lines = usage_lines(parts).into_iter();
    lines
        .map(|line| HelpLine::Entry(line, String::new()))
        .collect()
}

/// The lines of a usage. A keyword and its value stay on one line; a list of choices that is too long for one is broken
/// after a `|`.
fn usage_lines(parts: &[String]) -> Vec<String> {
    let words = parts.iter().flat_map(|part| {
        let fits = part.width() <= USAGE_WIDTH;
        let choices = (!fits).then(|| part.split_inclusive('|'));
        let whole = fits.then_some(part.as_str());
        choices.into_iter().flatten().chain(whole)
    });
    let lines = filled(words, USAGE_WIDTH);
    let indents = std::iter::once("").chain(std::iter::repeat("    "));
    indents
        .zip(lines)
        .map(|(indent, line)| format!("{indent}{line}"))
        .collect()
}

/// A text wrapped to the width of notes.
pub(super) fn notes(text: &str) -> Vec<HelpLine> {
    let lines = filled(text.split_whitespace(), NOTE_WIDTH);
    lines.into_iter().map(HelpLine::Note).collect()
}

/// Words joined into lines of at most `width` columns, by a blank unless they are choices of one list; a word longer
/// than that has a line to itself.
fn filled<'a>(words: impl Iterator<Item = &'a str>, width: usize) -> Vec<String> {
    let mut lines = vec![String::new()];
    for word in words {
        match lines.last_mut() {
            Some(line) => {
                let joint = if line.is_empty() || line.ends_with('|') {
                    ""
                } else {
                    " "
                };
                if line.is_empty() || line.width() + joint.width() + word.width() <= width {
                    line.extend([joint, word]);
                } else {
                    lines.push(word.to_owned());
                }
            }
            None => lines.push(word.to_owned()),
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::language::rows;
    use crate::text::Language;

    #[test]
    fn a_keyword_and_its_value_are_on_the_same_line() {
        let survey = rows().find(|row| row.name() == "survey").expect("a verb");
        let lines = explained(survey, &Locale::new(Language::English));
        let entries: Vec<&str> = lines
            .iter()
            .filter_map(|line| match line {
                HelpLine::Entry(usage, _) | HelpLine::Usage(usage) => Some(usage.as_str()),
                HelpLine::Title(_) | HelpLine::Note(_) | HelpLine::Blank => None,
            })
            .collect();
        assert!(
            entries.iter().any(|it| it.starts_with("    ")),
            "{entries:?}"
        );
        for entry in entries {
            let open = entry.matches('[').count();
            assert_eq!(open, entry.matches(']').count(), "{entry}");
            assert!(entry.width() <= USAGE_WIDTH + 4, "{entry}");
        }
    }

    #[test]
    fn a_verb_with_many_forms_is_described_before_them() {
        let plan = rows().find(|row| row.name() == "plan").expect("a verb");
        let locale = Locale::new(Language::English);
        let lines = explained(plan, &locale);
        let first_form = lines
            .iter()
            .position(|line| matches!(line, HelpLine::Usage(_)));
        let before = &lines[..first_form.expect("a form")];
        let words = before.iter().map(|line| match line {
            HelpLine::Entry(_, text) | HelpLine::Note(text) => text.as_str(),
            HelpLine::Title(_) | HelpLine::Usage(_) | HelpLine::Blank => "",
        });
        let described = words.collect::<Vec<_>>().join(" ");
        assert_eq!(described.trim(), locale.text(&plan.summary()));
    }

    #[test]
    fn a_shortcut_of_another_form_is_not_listed() {
        let plan = rows().find(|row| row.name() == "plan").expect("a verb");
        let lines = explained(plan, &Locale::new(Language::English)).into_iter();
        let usages: Vec<HelpLine> = lines
            .filter(|line| matches!(line, HelpLine::Usage(usage) if usage.contains("resume")))
            .collect();
        assert_eq!(
            usages,
            [HelpLine::Usage("plan resume [from ITEM]".to_owned())]
        );
    }

    #[test]
    fn a_long_list_of_choices_is_broken_between_two() {
        let choice = ["bookmark", "refusal", "alert"].join("|").repeat(3);
        let lines = alone(&["seek".to_owned(), format!("[{choice}]")]);
        let texts: Vec<&str> = lines
            .iter()
            .map(|line| match line {
                HelpLine::Entry(usage, _) => usage.as_str(),
                other => panic!("{other:?}"),
            })
            .collect();
        assert!(
            texts.len() > 1 && texts[0].starts_with("seek [bookmark|"),
            "{texts:?}"
        );
        for (at, text) in texts.iter().enumerate() {
            assert!(text.width() <= USAGE_WIDTH + 4, "{text}");
            assert!(at + 1 == texts.len() || text.ends_with('|'), "{text}");
        }
    }
}
