//! Matches the words of a line with the forms of a verb.

use super::Context;
use super::argument::{Argument, Arguments, Kind, Value};
use super::lexer::Word;
use super::read::Misread;
use super::verb::Form;
use crate::text::Text;

/// The extent to which the words of a line match a form.
pub(super) struct Fit {
    pub arguments: Arguments,
    /// The arguments that may follow the last word.
    pub expected: Vec<Expected>,
    /// The argument that is incomplete: only its first words are there.
    pub begun: Option<&'static Argument>,
    /// Whether every required argument is there.
    pub complete: bool,
    /// The first word that does not match.
    pub misfit: Option<Misfit>,
}

/// A word that does not match.
pub(super) struct Misfit {
    pub word: usize,
    /// Whether the word is of the right kind and only its value is invalid.
    pub specific: bool,
    /// The fault, if only one kind was possible.
    pub message: Option<Text>,
    /// The arguments that were expected instead.
    pub expected: Vec<Expected>,
}

/// A word that may come next.
#[derive(Clone, Copy)]
pub(super) enum Expected {
    /// The keyword of this argument.
    Keyword(&'static Argument),
    /// The value of this argument.
    Value(&'static Argument),
}

impl Expected {
    /// The word that an argument begins with.
    fn first(argument: &'static Argument) -> Self {
        if argument.keyword.is_empty() {
            Self::Value(argument)
        } else {
            Self::Keyword(argument)
        }
    }

    pub fn argument(self) -> &'static Argument {
        match self {
            Self::Keyword(argument) | Self::Value(argument) => argument,
        }
    }

    /// A description of the word for an error or a hint: "`up`" or "ALTITUDE (height above home,
    /// 0.5 to 1000 m)".
    pub fn describe(self) -> Text {
        match self {
            Self::Keyword(argument) => format!("`{}`", argument.keyword).into(),
            Self::Value(argument) => {
                let explained = argument.explained();
                let name = argument.placeholder();
                if explained.is_empty() {
                    name.into()
                } else {
                    Text::joined("", vec![name.into(), " (".into(), explained, ")".into()])
                }
            }
        }
    }
}

struct FormReader<'a> {
    form: &'static Form,
    context: &'a Context<'a>,
    filled: Vec<bool>,
    arguments: Arguments,
}

enum FormStep {
    Took(usize),
    Unfinished(&'static Argument),
    Misfit(Misfit),
}

fn is_seat_word(word: &Word) -> bool {
    word.text.starts_with('@')
}

/// Matches words with a form as far as possible.
pub(super) fn fit(form: &'static Form, words: &[Word], context: &Context) -> Fit {
    let mut reader = FormReader {
        form,
        context,
        filled: vec![false; form.arguments.len()],
        arguments: Arguments::default(),
    };
    let rest = reader.take_last_seat(words);
    let words = rest.as_deref().unwrap_or(words);
    let mut at = 0;
    while at < words.len() {
        match reader.step(&words[at..]) {
            FormStep::Took(count) => at += count,
            FormStep::Unfinished(argument) => {
                let fit = reader.end(vec![Expected::Value(argument)], false, None);
                return Fit {
                    begun: Some(argument),
                    ..fit
                };
            }
            FormStep::Misfit(mut misfit) => {
                misfit.word += at;
                return reader.end(Vec::new(), false, Some(misfit));
            }
        }
    }
    let complete = reader
        .form
        .arguments
        .iter()
        .zip(&reader.filled)
        .all(|(argument, filled)| argument.optional || *filled);
    let expected = reader.expected();
    reader.end(expected, complete, None)
}

impl FormReader<'_> {
    fn end(self, expected: Vec<Expected>, complete: bool, misfit: Option<Misfit>) -> Fit {
        Fit {
            arguments: self.arguments,
            expected,
            begun: None,
            complete,
            misfit,
        }
    }

    /// Takes a seat that is the last word instead of the first one after the form's own words; returns the words before
    /// it. After a seat at the beginning, the rest of the line may be a text with any words.
    fn take_last_seat<'w>(&mut self, words: &[Word<'w>]) -> Option<Vec<Word<'w>>> {
        let arguments = self.form.arguments;
        let index = arguments.iter().position(Argument::is_seat)?;
        let (last, before) = words.split_last()?;
        let is_first = before.get(index).is_none_or(is_seat_word);
        if is_first || !is_seat_word(last) {
            return None;
        }
        let (seat, _) = arguments[index]
            .kind
            .read(std::slice::from_ref(last), self.context)
            .ok()?;
        self.fill(index, seat, std::slice::from_ref(last), 1);
        let cut = |word: &Word<'w>| Word {
            tail: word.tail[..last.span.start - word.span.start].trim_end(),
            ..word.clone()
        };
        Some(before.iter().map(cut).collect())
    }

    /// The indices of the arguments that may come now: all up to and including the first one that
    /// must precede the others.
    fn open(&self) -> Vec<usize> {
        let mut open = Vec::new();
        let arguments = self.form.arguments.iter().enumerate();
        let is_value = |argument: &Argument| argument.keyword.is_empty();
        // Values keep their order: after a later one, an earlier one is no longer possible.
        let last = arguments
            .clone()
            .filter(|(index, argument)| self.filled[*index] && is_value(argument))
            .map(|(index, _)| index)
            .next_back();
        for (index, argument) in arguments {
            if self.filled[index] && !argument.repeated {
                continue;
            }
            if is_value(argument) && !argument.repeated && last.is_some_and(|last| index < last) {
                continue;
            }
            open.push(index);
            let in_order = argument.keyword.is_empty() || argument.kind == Kind::Flag;
            if in_order && !argument.optional {
                break;
            }
        }
        open
    }

    fn expected(&self) -> Vec<Expected> {
        let mut value_seen = false;
        self.open()
            .into_iter()
            .map(|index| &self.form.arguments[index])
            .filter(|argument| {
                // Of several optional values in a row, the first one is used first.
                let again = argument.keyword.is_empty() && argument.optional && value_seen;
                value_seen |= argument.keyword.is_empty();
                !again
            })
            .map(Expected::first)
            .collect()
    }

    fn step(&mut self, words: &[Word]) -> FormStep {
        let open = self.open();
        let arguments = self.form.arguments;
        let keyed = open.iter().copied().find(|&index| {
            !arguments[index].keyword.is_empty() && words[0].is(arguments[index].keyword)
        });
        match keyed {
            Some(index) if arguments[index].kind == Kind::Flag => {
                self.fill(index, Value::Flag, words, 1);
                FormStep::Took(1)
            }
            Some(index) => self.keyed(index, words),
            None => self.positional(&open, words),
        }
    }

    fn keyed(&mut self, index: usize, words: &[Word]) -> FormStep {
        let argument = &self.form.arguments[index];
        match argument.kind.read(&words[1..], self.context) {
            Ok((value, count)) => {
                self.fill(index, value, words, count + 1);
                FormStep::Took(count + 1)
            }
            Err(Misread::Incomplete) => FormStep::Unfinished(argument),
            Err(Misread::Wrong { word, message, .. }) => FormStep::Misfit(Misfit {
                word: word + 1,
                specific: true,
                message: Some(argument.about(message)),
                expected: vec![Expected::Value(argument)],
            }),
        }
    }

    fn positional(&mut self, open: &[usize], words: &[Word]) -> FormStep {
        let mut misfit = Misfit {
            word: 0,
            specific: false,
            message: None,
            expected: self.distinct(open),
        };
        for &index in open {
            let argument = &self.form.arguments[index];
            if !argument.keyword.is_empty() {
                continue;
            }
            match argument.kind.read(words, self.context) {
                Ok((value, count)) => {
                    self.fill(index, value, words, count);
                    return FormStep::Took(count);
                }
                Err(Misread::Incomplete) => return FormStep::Unfinished(argument),
                Err(Misread::Wrong {
                    word,
                    specific,
                    message,
                }) => {
                    let further = (word, specific) > (misfit.word, misfit.specific);
                    if further || misfit.message.is_none() && misfit.expected.len() == 1 {
                        (misfit.word, misfit.specific) = (word, specific);
                        misfit.message = Some(argument.about(message));
                    }
                }
            }
        }
        FormStep::Misfit(misfit)
    }

    /// The words that may come next for these arguments. Of several values of the same kind, only
    /// the first counts.
    fn distinct(&self, open: &[usize]) -> Vec<Expected> {
        let mut kinds = Vec::new();
        let mut is_new = |argument: &&Argument| {
            let is_new = !argument.keyword.is_empty() || !kinds.contains(&argument.kind);
            kinds.push(argument.kind);
            is_new
        };
        let arguments = open.iter().map(|index| &self.form.arguments[*index]);
        let distinct = arguments.filter(|it| is_new(it));
        distinct.map(Expected::first).collect()
    }

    fn fill(&mut self, index: usize, value: Value, words: &[Word], count: usize) {
        let start = words[0].span.start;
        let end = words[count - 1].span.end;
        self.filled[index] = true;
        self.arguments
            .insert(self.form.arguments[index].name, value, start..end);
    }
}
