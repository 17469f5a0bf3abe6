//! Lines that stand in files: macros and keys. Whether they can be given shows only in flight, but whether anybody
//! could ever understand them is plain at once.

use super::room_list::Room;
use crate::diagnostic::Diagnostic;
use crate::language::{self, Channel, Context, Groups, Listed, NameList, Named, Names};
use crate::text;
use crate::vehicle::VehicleClass;

/// What may stand in a file's line: themes are known, missions, macros and injects may be anybody's.
#[derive(Debug)]
struct NamesInFiles<'a> {
    themes: &'a [String],
}

impl Names for NamesInFiles<'_> {
    fn listed(&self, list: NameList) -> Listed {
        match list {
            NameList::Room => Room::listed(),
            NameList::Theme => themes(self.themes),
            NameList::Mission | NameList::Inject | NameList::Macro => Listed::Anything,
        }
    }
}

/// These themes, as words of a line.
pub fn themes(names: &[String]) -> Listed {
    let named = |name: &String| Named {
        name: name.clone(),
        meaning: text!("console-kind-theme"),
    };
    Listed::Names(names.iter().map(named).collect())
}

/// Runs `work` with what is known where a line stands in a file: groups and places may have any name, because
/// those of the session are not known yet.
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
/// The first fault, with its place in the line.
pub fn check(line: &str, themes: &[String]) -> Result<(), Diagnostic> {
    in_file(line, themes, |context| {
        language::parse(line, context).map(drop)
    })
}

/// Checks the beginning of a line, which is to be completed by hand: its verb has to exist.
///
/// # Errors
/// There is no such verb, or not on the command line; the place is its own.
pub fn check_beginning(line: &str) -> Result<(), Diagnostic> {
    if line.is_empty() {
        return Ok(());
    }
    in_file(line, &[], |context| language::said(line, context).map(drop))
}
