//! Macros, checked before their first line is given.

use std::collections::BTreeSet;
use std::ops::Range;

use crate::app::State;
use crate::diagnostic::Diagnostic;
use crate::language::{self, Channel, ConsoleLine, Context, Groups, Meaning, Targets};
use crate::text;
use crate::vehicle::VehicleClass;

/// A line of a macro.
#[derive(Clone, Copy)]
struct MacroLine<'a> {
    /// What the macro is called.
    name: &'a str,
    /// Which of its lines it is, counted from 1.
    number: usize,
    line: &'a str,
}

impl MacroLine<'_> {
    /// A fault of the line, said of the place that gives the macro.
    fn fault(self, fault: Diagnostic, at: Range<usize>) -> Diagnostic {
        let message = text!(
            "macro-line",
            name = self.name,
            number = self.number,
            line = self.line,
            fault = fault.message
        );
        Diagnostic {
            span: at,
            message,
            help: fault.help,
        }
    }
}

/// Checks the lines of a macro before the first one is given, so that none of them is wrong after others have been
/// sent. What an earlier line changes is not known yet: groups that it names count as every vehicle, and so does
/// the selection. Behind a line that starts another session nothing is known.
///
/// # Errors
/// What is wrong with the first line that is; the place is the whole of `at`, the line that gives the macro.
pub fn check(state: &State, name: &str, at: Range<usize>) -> Result<(), Diagnostic> {
    let mut groups = state.session.groups.clone();
    let mut seen = BTreeSet::new();
    // The next line is the last of these.
    let mut left: Vec<MacroLine<'_>> = Vec::new();
    let mut called = Some(name);
    loop {
        // One that calls itself is stopped when it is given.
        if let Some(name) = called.take().filter(|name| seen.insert(*name)) {
            left.extend(lines_backwards(state, name));
        }
        let Some(line) = left.pop() else {
            return Ok(());
        };
        let own =
            check_now(state, line.line, &groups).map_err(|fault| line.fault(fault, at.clone()))?;
        if let Some(ConsoleLine::Fly(_) | ConsoleLine::FlyFree | ConsoleLine::Connect(_)) = own {
            return Ok(());
        } else if let Some(ConsoleLine::Group { name, .. }) = own {
            groups.insert(name, state.session.vehicles.keys().copied().collect());
        } else if let Some(ConsoleLine::Macro(name)) = own {
            let known = state.config.macros.get_key_value(&name);
            called = known.map(|(name, _)| name.as_str());
        }
    }
}

/// The lines of a macro, the last one first.
fn lines_backwards<'a>(state: &'a State, name: &'a str) -> impl Iterator<Item = MacroLine<'a>> {
    let lines = state.config.macros.get(name).map_or(&[][..], Vec::as_slice);
    let numbered = lines.iter().enumerate().rev();
    numbered.map(move |(at, line)| MacroLine {
        name,
        number: at + 1,
        line,
    })
}

/// Checks a line as far as it does not depend on those before it; gives it back if it is to the console itself.
fn check_now(
    state: &State,
    line: &str,
    groups: &Groups,
) -> Result<Option<ConsoleLine>, Diagnostic> {
    state.with_context(|context| {
        let context = Context {
            groups,
            class: VehicleClass::Other,
            parameters: None,
            channel: Channel::Screen,
            ..*context
        };
        let statement = language::parse(line, &context)?;
        if let Meaning::Console(own) = statement.meaning {
            return Ok(Some(own));
        }
        if statement.targets != Targets::Selection {
            let targets = statement.targets.resolve(&[], &context);
            targets.map_err(|text| Diagnostic::new(0..line.len(), text))?;
        }
        Ok(None)
    })
}
