//! Names in lines, from lists that the console provides.

use std::fmt;

use crate::text;
use crate::text::Text;

/// The lists of names that the console provides.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum NameList {
    /// The rooms of the console.
    Room,
    /// The themes, including those from files.
    Theme,
    /// The missions, by id.
    Mission,
    /// The injects that an instructor may trigger in the current mission.
    Inject,
    /// Macros in the settings.
    Macro,
    /// The drafts of plans that are open.
    Draft,
    /// The parameters of the item under the cursor in the room of plans.
    ItemField,
    /// The files of plans in the folder that is being typed.
    PlanFile,
    /// The seats of the class, with `@`, and `@all`.
    Seat,
    /// The injects that the missions of the seats permit.
    SeatInject,
    /// The situations of the seats, by number, and by name if it is one word.
    Situation,
    /// The lessons of the desk; a path is valid, too.
    Lesson,
    /// The exams that the desk can hold; a path is valid, too.
    Exam,
    /// The trainees of the class, by user name.
    Trainee,
    /// The rubrics with which the desk grades flights.
    Rubric,
    /// Everybody on the crew, by name.
    Crew,
}

/// A name that a line may contain.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Named {
    /// The name as it is typed.
    pub name: String,
    pub meaning: Text,
}

/// The current content of a list.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Listed {
    /// Not known yet: every name is accepted.
    Anything,
    /// One of these names.
    Names(Vec<Named>),
    /// No name is valid now, for this reason.
    Nothing(Text),
}

/// Access to the lists.
pub trait Names: fmt::Debug {
    /// The current content of a list.
    fn listed(&self, list: NameList) -> Listed;

    /// What is documented about a parameter with this value; empty if nothing is.
    fn about_parameter(&self, _name: &str, _value: f64) -> String {
        String::new()
    }
}

/// Lists with unknown content.
#[derive(Debug, Clone, Copy)]
pub struct UnknownNames;

impl Names for UnknownNames {
    fn listed(&self, _: NameList) -> Listed {
        Listed::Anything
    }
}

impl Listed {
    /// The names; empty if every name is accepted.
    pub(super) fn names(self) -> Vec<Named> {
        match self {
            Self::Names(names) => names,
            Self::Anything | Self::Nothing(_) => Vec::new(),
        }
    }

    /// The name that a word means, in the list's spelling.
    ///
    /// # Errors
    /// No name matches, or none is valid now.
    pub(super) fn meant(self, list: NameList, written: &str) -> Result<String, Text> {
        let unknown = || text!("grammar-no-name", word = written);
        let names = match self {
            // A word without the sign is the next argument.
            Self::Anything if list == NameList::Seat && !written.starts_with('@') => {
                return Err(unknown());
            }
            Self::Anything => return Ok(written.to_owned()),
            Self::Nothing(why) => return Err(why),
            Self::Names(names) => names,
        };
        let words: Vec<&str> = names.iter().map(|named| named.name.as_str()).collect();
        let found = match list {
            NameList::Mission => mission_meant(written, &words),
            NameList::Room
            | NameList::Theme
            | NameList::Inject
            | NameList::Macro
            | NameList::Draft
            | NameList::ItemField
            | NameList::PlanFile
            | NameList::Seat
            | NameList::SeatInject
            | NameList::Situation
            | NameList::Crew
            | NameList::Rubric => words.iter().copied().find(|word| *word == written),
            NameList::Lesson | NameList::Exam if written.contains(['/', '.']) => {
                return Ok(written.to_owned());
            }
            NameList::Lesson | NameList::Exam => {
                words.iter().copied().find(|word| *word == written)
            }
            NameList::Trainee => {
                let name = written.trim_start_matches('@');
                words.iter().copied().find(|word| *word == name)
            }
        };
        found.map(str::to_owned).ok_or_else(unknown)
    }
}

/// The mission that a word means, by id: an exact match, otherwise the first with that number, otherwise the only one
/// with that prefix.
pub fn mission_meant<'a>(written: &str, ids: &[&'a str]) -> Option<&'a str> {
    let by_number = format!("{written}-");
    let mut beginning = ids
        .iter()
        .filter(|id| !written.is_empty() && id.starts_with(written));
    let only = beginning.next().filter(|_| beginning.next().is_none());
    let called = ids.iter().find(|id| **id == written);
    let numbered = ids.iter().find(|id| id.starts_with(&by_number));
    called.or(numbered).or(only).copied()
}
