//! The check of a macro before its first line is given.

use std::collections::BTreeSet;
use std::ops::Range;

use crate::app::State;
use crate::diagnostic::Diagnostic;
use crate::language::{self, Channel, ConsoleLine, Context, Groups, Meaning, Targets};
use crate::text;
use crate::vehicle::VehicleClass;

/// A line of a macro, with the macro's name and the line's number for faults.
#[derive(Clone, Copy)]
struct MacroLine<'a> {
    name: &'a str,
    /// The number of the line, from 1.
    number: usize,
    line: &'a str,
}

impl MacroLine<'_> {
    /// A fault of the line, placed at the macro's call.
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

/// Checks the lines of a macro before the first one is given, so that no fault appears after other
/// lines have been sent. The effect of earlier lines is not known yet, so groups that they define
/// count as all vehicles, and the selection is not checked. Nothing is checked after a line that
/// starts another session.
///
/// # Errors
/// The first fault, placed at `at`, the call of the macro.
pub fn check(state: &State, name: &str, at: Range<usize>) -> Result<(), Diagnostic> {
    let mut groups = state.session.choice.groups.clone();
    let mut seen = BTreeSet::new();
    // A stack: its last element is the next line.
    let mut left: Vec<MacroLine<'_>> = Vec::new();
    let mut called = Some(name);
    loop {
        // A macro that calls itself is stopped when it runs.
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

fn lines_backwards<'a>(state: &'a State, name: &'a str) -> impl Iterator<Item = MacroLine<'a>> {
    let lines = state.config.macros.get(name).map_or(&[][..], Vec::as_slice);
    let numbered = lines.iter().enumerate().rev();
    numbered.map(move |(at, line)| MacroLine {
        name,
        number: at + 1,
        line,
    })
}

/// Checks those parts of a line that do not depend on earlier lines; returns the line if it is for
/// the console itself.
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
