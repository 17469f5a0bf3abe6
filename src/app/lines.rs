//! Commands in files: macros and keys. Whether they can be run depends on the flight, but their syntax can be
//! checked at once.

use super::room_list::Room;
use crate::diagnostic::Diagnostic;
use crate::language::{self, Channel, Context, Groups, Listed, NameList, Named, Names};
use crate::text;
use crate::vehicle::VehicleClass;

/// The names that a command in a file may use: themes must exist; missions, macros and injects may
/// have any name.
#[derive(Debug)]
struct NamesInFiles<'a> {
    themes: &'a [String],
}

impl Names for NamesInFiles<'_> {
    fn listed(&self, list: NameList) -> Listed {
        match list {
            NameList::Room => Room::listed(),
            NameList::Theme => themes(self.themes),
            NameList::Mission
            | NameList::Inject
            | NameList::Macro
            | NameList::Draft
            | NameList::ItemField
            | NameList::PlanFile
            | NameList::Seat
            | NameList::SeatInject
            | NameList::Situation
            | NameList::Lesson
            | NameList::Exam
            | NameList::Trainee
            | NameList::Rubric
            | NameList::Crew => Listed::Anything,
        }
    }
}

/// The themes as completions.
pub fn themes(names: &[String]) -> Listed {
    let named = |name: &String| Named {
        name: name.clone(),
        meaning: text!("console-kind-theme"),
    };
    Listed::Names(names.iter().map(named).collect())
}

/// Runs `work` with the context of a line in a file: groups and places may have any name, because the session is not
/// known yet.
fn in_file<T>(line: &str, themes: &[String], work: impl FnOnce(&Context<'_>) -> T) -> T {
    let words = line.split_whitespace();
    let named = words.filter_map(|word| word.strip_prefix('@'));
    let groups: Groups = named.map(|name| (name.to_owned(), vec![1])).collect();
    work(&Context {
        groups: &groups,
        places: None,
        areas: None,
        class: VehicleClass::Other,
        names: &NamesInFiles { themes },
        channel: Channel::Screen,
        ..Context::default()
    })
}

/// Checks a line of the command language.
///
/// # Errors
/// The first fault, with its position in the line.
pub fn check(line: &str, themes: &[String]) -> Result<(), Diagnostic> {
    in_file(line, themes, |context| {
        language::parse(line, context).map(drop)
    })
}

/// Checks the beginning of a line that the user will complete: its verb must exist.
///
/// # Errors
/// The verb is unknown or not allowed on the command line; the diagnostic contains its position.
pub fn check_beginning(line: &str) -> Result<(), Diagnostic> {
    if line.is_empty() {
        return Ok(());
    }
    in_file(line, &[], |context| language::said(line, context).map(drop))
}
