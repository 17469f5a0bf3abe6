//! A row of the verb table.

use super::argument::{Argument, Arguments, Kind, Problem};
use super::console::ConsoleLine;
use super::wait::Wait;
use crate::commands::Act;
use crate::text;
use crate::text::{Locale, Text};
use crate::verb::Verb;

/// A row of the table: a verb and its grammar. The message `verb-NAME` is its summary; `words-NAME`, if there is one, lists
/// its synonyms.
#[derive(Debug, Clone, Copy)]
pub struct VerbRow {
    /// The properties of its orders.
    pub verb: Verb,
    /// Where the verb is allowed.
    pub scope: Scope,
    pub aliases: &'static [&'static str],
    /// Examples of lines with the verb.
    pub examples: &'static [&'static str],
    pub forms: &'static [Form],
}

/// Where a verb is allowed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scope {
    /// On the command line and in scripts, for vehicles.
    Everywhere,
    /// Only in sequences of lines, which the verb delays: in scripts and through a pipe. Its targets may follow it.
    Scripts,
    /// For the console, with or without a screen.
    Console,
    /// For the console; without a screen it does nothing.
    Screen,
    /// Only for the plain console, because the rooms of a screen show the same.
    Plain,
}

impl Scope {
    /// Whether a verb of this scope is allowed in lines from this source.
    pub fn includes(self, channel: Channel) -> bool {
        match self {
            Self::Everywhere => true,
            Self::Scripts => channel != Channel::Screen,
            Self::Console | Self::Screen => channel != Channel::Script,
            Self::Plain => channel == Channel::Plain,
        }
    }

    /// Whether a verb of this scope is for vehicles, so a line may have targets.
    pub fn takes_targets(self) -> bool {
        match self {
            Self::Everywhere | Self::Scripts => true,
            Self::Console | Self::Screen | Self::Plain => false,
        }
    }
}

/// The source of a line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Channel {
    /// The command line of the console, its keys and macros.
    Screen,
    /// The input of the plain console.
    Plain,
    /// The lines of a script.
    Script,
}

/// One form of a verb: its arguments, and its builder.
#[derive(Debug, Clone, Copy)]
pub struct Form {
    /// The arguments in order. Values without a keyword must follow this order; those with one may come in any order.
    pub arguments: &'static [Argument],
    /// The verb that this form means, if it is not that of the row.
    pub(super) means: Option<&'static Verb>,
    /// Whether another verb or form means the same, so the lines of this form need not be offered as well.
    pub(super) is_shortcut: bool,
    pub(super) build: fn(&Arguments) -> Result<Meaning, Problem>,
}

/// The meaning of a line.
#[derive(Debug, Clone, PartialEq)]
pub enum Meaning {
    /// A command to its targets.
    Act(Act),
    /// A wait until a condition holds for all targets.
    Wait(Wait),
    /// A command to the console.
    Console(ConsoleLine),
}

impl VerbRow {
    pub fn name(&self) -> &'static str {
        self.verb.name
    }

    /// Whether a word is the verb's name or an alias.
    pub fn is_called(&self, word: &str) -> bool {
        self.name().eq_ignore_ascii_case(word)
            || self
                .aliases
                .iter()
                .any(|alias| alias.eq_ignore_ascii_case(word))
    }

    /// The verb's summary in one line.
    pub fn summary(&self) -> Text {
        Text::new(format!("verb-{}", self.name()), Vec::new())
    }

    /// Other words for the verb in a language, if there are any.
    pub fn synonyms(&self, locale: &Locale) -> Option<String> {
        locale.find(&format!("words-{}", self.name()))
    }

    /// The forms that help and messages list: without shortcuts, unless there is nothing else.
    fn listed_forms(&self) -> impl Iterator<Item = &Form> {
        let has_others = self.forms.iter().any(|form| !form.is_shortcut);
        let forms = self.forms.iter();
        forms.filter(move |form| !(form.is_shortcut && has_others))
    }

    /// The verb's usage, a line per form: "takeoff ALTITUDE".
    pub fn usage(&self) -> Vec<String> {
        let forms = self.listed_forms();
        forms.map(|form| form.usage(self.name(), None)).collect()
    }

    /// The usage of each form in parts that belong on one line: the verb, then each argument with its keyword.
    pub fn usage_parts(&self) -> impl Iterator<Item = Vec<String>> {
        let forms = self.listed_forms();
        forms.map(|form| form.usage_parts(self.name(), None))
    }

    /// The verb's usages in a sentence: "`ack` or `ack KIND`".
    pub(super) fn usages(&self) -> Text {
        let usages = self.usage().into_iter();
        either(usages.map(|usage| format!("`{usage}`").into()).collect())
    }

    /// Whether one of the verb's arguments is of a kind.
    pub fn takes(&self, kind: Kind) -> bool {
        let mut arguments = self.forms.iter().flat_map(|form| form.arguments);
        arguments.any(|argument| argument.kind == kind)
    }

    /// The row's verb, and those of forms with another meaning.
    pub(super) fn verbs(&'static self) -> impl Iterator<Item = &'static Verb> {
        let others = self.forms.iter().filter_map(|form| form.means);
        std::iter::once(&self.verb).chain(others)
    }
}

impl Form {
    pub(super) const fn new(
        arguments: &'static [Argument],
        build: fn(&Arguments) -> Result<Meaning, Problem>,
    ) -> Self {
        Self {
            arguments,
            means: None,
            is_shortcut: false,
            build,
        }
    }

    /// The form, with a verb other than that of its row.
    pub(super) const fn meaning(self, verb: &'static Verb) -> Self {
        Self {
            means: Some(verb),
            ..self
        }
    }

    /// The form, as a shortcut of another verb or form.
    pub(super) const fn shortcut(self) -> Self {
        Self {
            is_shortcut: true,
            ..self
        }
    }

    /// The words that the form begins with, before its values: `fence circle` in `draft fence
    /// circle 150`, `open` in `draft open FILE`.
    pub(super) fn beginning(&self) -> impl Iterator<Item = &'static str> {
        let is_only = self.arguments.len() == 1;
        let is_said = move |argument: &&Argument| {
            let is_word = argument.kind == Kind::Flag || is_only && !argument.keyword.is_empty();
            is_word && !argument.optional
        };
        let said = self.arguments.iter().take_while(is_said);
        said.map(|argument| argument.keyword)
    }

    /// The form's usage, with the argument `marked` between ‹ and ›.
    pub(super) fn usage(&self, verb: &str, marked: Option<&Argument>) -> String {
        self.usage_parts(verb, marked).join(" ")
    }

    fn usage_parts(&self, verb: &str, marked: Option<&Argument>) -> Vec<String> {
        let arguments = self.arguments.iter().map(|argument| {
            let text = argument.usage();
            if marked.is_some_and(|marked| std::ptr::eq(marked, argument)) {
                format!("‹{text}›")
            } else if argument.optional {
                format!("[{text}]")
            } else {
                text
            }
        });
        std::iter::once(verb.to_owned()).chain(arguments).collect()
    }
}

/// "A or B or C".
pub(super) fn either(texts: Vec<Text>) -> Text {
    let mut texts = texts.into_iter();
    let first = texts.next().unwrap_or_default();
    texts.fold(first, |all, text| {
        text!("grammar-or", others = all, last = text)
    })
}
