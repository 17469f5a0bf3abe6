//! A row of the verb table.

use std::fmt;
use std::time::Duration;

use super::argument::{Argument, Arguments, Problem};
use super::wait::Wait;
use crate::commands::{Command, Deed, Manoeuvre};
use crate::text::Text;

/// One verb: everything that the program knows about it. The message `verb-NAME` says what it does.
#[derive(Clone, Copy)]
pub struct Verb {
    /// Its name.
    pub name: &'static str,
    /// Other words for it.
    pub aliases: &'static [&'static str],
    /// Lines that use it.
    pub examples: &'static [&'static str],
    /// The ways to say it.
    pub forms: &'static [Form],
    /// Whether it asks before it goes out.
    pub danger: Danger,
    /// How often and until when it is sent again.
    pub retry: Retry,
}

/// One way to say a verb: its arguments, and what is built of them.
#[derive(Clone, Copy)]
pub struct Form {
    /// In order. Values without a keyword come in this order; those with one come in any.
    pub arguments: &'static [Argument],
    /// Builds the meaning.
    pub(super) build: fn(&Arguments) -> Result<Meaning, Problem>,
}

/// What a form builds.
pub(super) enum Meaning {
    Command(Command),
    Deed(Deed),
    Manoeuvre(Manoeuvre),
    Wait(Wait),
}

/// Whether a command asks before it goes out.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Danger {
    /// It goes out at once.
    None,
    /// It names its targets and asks for a second key.
    Confirm,
}

/// When a command without an answer is sent again. A command that arrives late can do harm, so no try goes
/// out after the deadline.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Retry {
    /// Tries at most, the first included.
    pub tries: u8,
    /// The time between two.
    pub every: Duration,
    /// When to give up, counted from the first.
    pub deadline: Duration,
}

impl Retry {
    pub(super) const fn new(tries: u8, every_ms: u64, deadline_ms: u64) -> Self {
        Self {
            tries,
            every: Duration::from_millis(every_ms),
            deadline: Duration::from_millis(deadline_ms),
        }
    }
}

impl Verb {
    /// Whether it is called that.
    pub fn is_called(&self, word: &str) -> bool {
        self.name.eq_ignore_ascii_case(word)
            || self
                .aliases
                .iter()
                .any(|alias| alias.eq_ignore_ascii_case(word))
    }

    /// What it does, in one line.
    pub fn summary(&self) -> Text {
        Text::new(format!("verb-{}", self.name), Vec::new())
    }

    /// How to say it, a line per form: "takeoff ALTITUDE".
    pub fn usage(&self) -> Vec<String> {
        self.forms
            .iter()
            .map(|form| form.usage(self.name, None))
            .collect()
    }
}

impl Form {
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

impl PartialEq for Verb {
    /// Names are unique in the table.
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

impl Eq for Verb {}

impl fmt::Debug for Verb {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("Verb").field(&self.name).finish()
    }
}
