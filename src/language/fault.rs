//! The faults of lines whose words match no form of their verb.

use super::Context;
use super::argument::Kind;
use super::form::{Expected, Fit, Misfit, fit};
use super::head::{end_of, head};
use super::lexer::{Word, words};
use super::names::Listed;
use super::read::number_length;
use super::verb::{Channel, Form, VerbRow, either};
use crate::diagnostic::{Diagnostic, near};
use crate::plan::field;
use crate::text;
use crate::text::Text;

/// The fault, according to the form that matches best.
pub(super) fn fault(
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
    let meant = Meant {
        row,
        forms: forms.iter().map(|form| &row.forms[*form]).collect(),
    };
    let Some(word) = rest.get(furthest.0) else {
        let message = incomplete(&meant, &closest, rest, context);
        return Diagnostic::new(end_of(all), message)
            .with_help(text!("grammar-for-example", line = meant.example()));
    };
    let misfits: Vec<&Misfit> = closest
        .iter()
        .filter_map(|fit| fit.misfit.as_ref())
        .collect();
    misfit_fault(&meant, word, &misfits, context)
}

/// The fault of a place that has a latitude but no longitude; `None` if that is not the fault.
fn no_longitude(closest: &[&Fit], rest: &[Word]) -> Option<Text> {
    let mut begun = closest.iter().filter_map(|fit| fit.begun);
    let is_half = begun.any(|argument| argument.kind == Kind::Point);
    let latitude = rest.last().filter(|word| number_length(word.text) > 0)?;
    is_half.then(|| text!("grammar-no-longitude", latitude = latitude.text))
}

/// Why no name is valid where one is expected; `None` if names are valid, or if none is expected.
fn unavailable(expected: Expected, context: &Context) -> Option<Text> {
    let Kind::Name(list) = expected.argument().kind else {
        return None;
    };
    match context.names.listed(list) {
        Listed::Nothing(why) => Some(why),
        Listed::Anything | Listed::Names(_) => None,
    }
}

/// The forms of a verb that a faulty line is closest to.
struct Meant {
    row: &'static VerbRow,
    forms: Vec<&'static Form>,
}

impl Meant {
    /// The verb with the words that these forms begin with, as far as the line has them: `plan goto`.
    fn subject(&self, rest: &[Word]) -> String {
        let beginning = self.forms.first().into_iter().flat_map(|it| it.beginning());
        let written = beginning.zip(rest).take_while(|(said, word)| word.is(said));
        let said = written.map(|(said, _)| said);
        let words: Vec<&str> = std::iter::once(self.row.name()).chain(said).collect();
        words.join(" ")
    }

    fn usages(&self) -> Text {
        let name = self.row.name();
        let usages = self.forms.iter().map(|form| form.usage(name, None));
        either(usages.map(|usage| format!("`{usage}`").into()).collect())
    }

    /// An example of one of these forms, otherwise the verb's first example.
    fn example(&self) -> &'static str {
        let row = self.row;
        let context = Context {
            places: None,
            areas: None,
            channel: Channel::Plain,
            ..Context::default()
        };
        let shows = |example: &&&str| {
            let words = words(example);
            head(&words, &context).is_ok_and(|head| {
                let rest = &words[head.len..];
                let complete = |form: &&'static Form| fit(form, rest, &context).complete;
                let form = row.forms.iter().find(complete);
                form.is_some_and(|form| self.forms.iter().any(|it| std::ptr::eq(*it, form)))
            })
        };
        let example = row.examples.iter().find(shows);
        example
            .or(row.examples.first())
            .copied()
            .unwrap_or(row.name())
    }
}

/// The fault of a line that ends too early: the missing words, or why there is no name for them.
fn incomplete(meant: &Meant, closest: &[&Fit], rest: &[Word], context: &Context) -> Text {
    if let Some(longitude) = no_longitude(closest, rest) {
        return longitude;
    }
    let expected = || closest.iter().flat_map(|fit| fit.expected.iter().copied());
    if let Some(why_not) = expected().find_map(|item| unavailable(item, context)) {
        return why_not;
    }
    // After its keyword, even an optional argument needs its value.
    let needed = |item: &Expected| match item {
        Expected::Keyword(argument) => !argument.optional,
        Expected::Value(argument) => !argument.optional || !argument.keyword.is_empty(),
    };
    text!(
        "grammar-needs",
        verb = meant.subject(rest),
        missing = list(expected().filter(needed))
    )
}

fn misfit_fault(meant: &Meant, word: &Word, misfits: &[&Misfit], context: &Context) -> Diagnostic {
    let span = word.span.clone();
    let expected = || {
        let all = misfits.iter();
        all.flat_map(|misfit| misfit.expected.iter().copied())
    };
    if expected().next().is_none() {
        let message = text!("grammar-too-much", word = word.text);
        return Diagnostic::new(span, message)
            .with_help(text!("grammar-say-it-as", usage = meant.usages()));
    }
    if let Some(why_not) = no_names(expected(), word, context) {
        return Diagnostic::new(span, why_not);
    }
    let names: Vec<String> = expected()
        .flat_map(|item| names_of(item, context))
        .collect();
    let what = list(expected());
    let specific = misfits.iter().any(|misfit| misfit.specific);
    let own = match misfits {
        [misfit, ..] if misfit.specific || misfits.len() == 1 => misfit.message.clone(),
        _ => None,
    };
    let says_what = own.is_none() || specific;
    let does_not_fit = || {
        let expected = what.clone();
        text!(
            "grammar-does-not-fit",
            word = word.text,
            expected = expected
        )
    };
    let fault = Diagnostic::new(span, own.unwrap_or_else(does_not_fit));
    let takes_command = expected().any(|item| item.argument().kind == Kind::PlanCommand);
    if takes_command && number_length(word.text) == 0 {
        return fault.with_help(near_commands(word.text, &names));
    }
    let nearest = fault.with_nearest(word.text, names.iter().map(String::as_str));
    if says_what || nearest.help.is_some() {
        return nearest;
    }
    let listed = there_are(&names, misfits);
    nearest.with_help(listed.unwrap_or_else(|| text!("grammar-expected", expected = what)))
}

/// Why no name is valid instead of a word, if a name is needed there; `None` for a word that may be meant as the name of a
/// seat before it.
fn no_names(
    expected: impl Iterator<Item = Expected>,
    word: &Word,
    context: &Context,
) -> Option<Text> {
    let needed = expected.filter(|item| !item.argument().optional);
    let reasons: Vec<Option<Text>> = needed.map(|item| unavailable(item, context)).collect();
    let all: Option<Vec<Text>> = reasons.into_iter().collect();
    let is_seat = word.text.starts_with('@');
    all?.into_iter().next().filter(|_| !is_seat)
}

/// The maximum number of words of plan commands that a fault names.
const MOST_WORDS: usize = 12;

/// The plan commands with names similar to a word, and where to find them all.
fn near_commands(word: &str, names: &[String]) -> Text {
    let names = near(word, names.iter().map(String::as_str)).into_iter();
    let quoted: Vec<Text> = names.map(|name| format!("`{name}`").into()).collect();
    let meant =
        (!quoted.is_empty()).then(|| text!("grammar-did-you-mean-any", names = either(quoted)));
    let words: Vec<&str> = field::short_plan_words().take(MOST_WORDS).collect();
    let words = words.join(", ");
    let list = text!("grammar-plan-commands", words = words);
    Text::joined(" ", meant.into_iter().chain([list]).collect())
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
