//! A row of the verb table.

use super::argument::{Argument, Arguments, Kind, Problem};
use super::console::ConsoleLine;
use super::wait::Wait;
use crate::commands::Act;
use crate::text::Text;
use crate::verb::Verb;

/// A row of the table: a verb and its grammar. The message `verb-NAME` says what it does.
#[derive(Debug, Clone, Copy)]
pub struct VerbRow {
    /// What holds for all its orders.
    pub verb: Verb,
    /// Where it may be said.
    pub scope: Scope,
    /// Other words for it.
    pub aliases: &'static [&'static str],
    /// Lines that use it.
    pub examples: &'static [&'static str],
    /// The ways to say it.
    pub forms: &'static [Form],
}

/// Where a verb may be said.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scope {
    /// On the command line and in scripts, to vehicles.
    Everywhere,
    /// Only where lines are given one after the other, which it holds up: in scripts and through a pipe. Its targets may
    /// follow it.
    Scripts,
    /// To the console, with or without a screen.
    Console,
    /// To the console; without a screen it does nothing.
    Screen,
    /// Only to the console without a screen: the rooms of a screen show the same.
    Plain,
}

impl Scope {
    /// Whether a verb of this scope may be said there.
    pub fn includes(self, channel: Channel) -> bool {
        match self {
            Self::Everywhere => true,
            Self::Scripts => channel != Channel::Screen,
            Self::Console | Self::Screen => channel != Channel::Script,
            Self::Plain => channel == Channel::Plain,
        }
    }

    /// Whether it is said to vehicles, so that a line may name them.
    pub fn takes_targets(self) -> bool {
        match self {
            Self::Everywhere | Self::Scripts => true,
            Self::Console | Self::Screen | Self::Plain => false,
        }
    }
}

/// Where a line comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Channel {
    /// The command line of the console, its keys and macros.
    Screen,
    /// The input of the console without a screen.
    Plain,
    /// The lines of a script.
    Script,
}

/// One way to say a verb: its arguments, and what is built of them.
#[derive(Debug, Clone, Copy)]
pub struct Form {
    /// In order. Values without a keyword come in this order; those with one come in any.
    pub arguments: &'static [Argument],
    /// The verb that this form means, where it is not that of the row.
    pub(super) means: Option<&'static Verb>,
    /// Whether another verb says the same, so that its lines need not be offered twice.
    pub(super) is_shortcut: bool,
    pub(super) build: fn(&Arguments) -> Result<Meaning, Problem>,
}

/// What a line asks for.
#[derive(Debug, Clone, PartialEq)]
pub enum Meaning {
    /// Its targets shall do something.
    Act(Act),
    /// A script is to hold until something is true of all targets.
    Wait(Wait),
    /// The console shall do something.
    Console(ConsoleLine),
}

impl VerbRow {
    /// How it is called.
    pub fn name(&self) -> &'static str {
        self.verb.name
    }

    /// Whether it is called that.
    pub fn is_called(&self, word: &str) -> bool {
        self.name().eq_ignore_ascii_case(word)
            || self
                .aliases
                .iter()
                .any(|alias| alias.eq_ignore_ascii_case(word))
    }

    /// What it does, in one line.
    pub fn summary(&self) -> Text {
        Text::new(format!("verb-{}", self.name()), Vec::new())
    }

    /// How to say it, a line per form: "takeoff ALTITUDE".
    pub fn usage(&self) -> Vec<String> {
        self.forms
            .iter()
            .map(|form| form.usage(self.name(), None))
            .collect()
    }

    /// Whether one of its arguments is the name of a parameter.
    pub fn names_parameters(&self) -> bool {
        let mut arguments = self.forms.iter().flat_map(|form| form.arguments);
        arguments.any(|argument| argument.kind == Kind::Parameter)
    }

    /// Its verb, and those of the forms that mean another one.
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

    /// The same, but it means another verb than that of its row.
    pub(super) const fn meaning(self, verb: &'static Verb) -> Self {
        Self {
            means: Some(verb),
            ..self
        }
    }

    /// The same, but another verb says it, too.
    pub(super) const fn shortcut(self) -> Self {
        Self {
            is_shortcut: true,
            ..self
        }
    }

    /// How to say it; the argument at `marked` stands between ‹ and ›.
    pub(super) fn usage(&self, verb: &str, marked: Option<&Argument>) -> String {
        let mut usage = verb.to_owned();
        for argument in self.arguments {
            let text = argument.usage();
            let (open, close) = if marked.is_some_and(|marked| std::ptr::eq(marked, argument)) {
                ("‹", "›")
            } else if argument.optional {
                ("[", "]")
            } else {
                ("", "")
            };
            usage.extend([" ", open, &text, close]);
        }
        usage
    }
}
