//! Names that only the console knows, as words of lines.

use std::fmt;

use crate::text;
use crate::text::Text;

/// A list of names.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum NameList {
    /// The rooms of the console.
    Room,
    /// Themes, those of files too.
    Theme,
    /// The missions, by id.
    Mission,
    /// What an instructor may have happen in the mission under way.
    Inject,
    /// Macros of the settings.
    Macro,
}

/// A name that may stand in a line.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Named {
    /// The name as it is typed.
    pub name: String,
    /// What it stands for.
    pub meaning: Text,
}

/// What a list holds now.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Listed {
    /// Not known yet: every name is accepted.
    Anything,
    /// One of these names.
    Names(Vec<Named>),
    /// Nothing can be named now, for this reason.
    Nothing(Text),
}

/// Tells what the lists hold.
pub trait Names: fmt::Debug {
    /// What a list holds now.
    fn listed(&self, list: NameList) -> Listed;
}

/// Lists of which nothing is known.
#[derive(Debug, Clone, Copy)]
pub struct UnknownNames;

impl Names for UnknownNames {
    fn listed(&self, _: NameList) -> Listed {
        Listed::Anything
    }
}

impl Listed {
    /// The names; none where every name will do.
    pub(super) fn names(self) -> Vec<Named> {
        match self {
            Self::Names(names) => names,
            Self::Anything | Self::Nothing(_) => Vec::new(),
        }
    }

    /// The name that a word means, as the list spells it.
    ///
    /// # Errors
    /// No name is meant, or none can be now.
    pub(super) fn meant(self, list: NameList, written: &str) -> Result<String, Text> {
        let names = match self {
            Self::Anything => return Ok(written.to_owned()),
            Self::Nothing(why) => return Err(why),
            Self::Names(names) => names,
        };
        let words: Vec<&str> = names.iter().map(|named| named.name.as_str()).collect();
        let found = match list {
            NameList::Mission => mission_meant(written, &words),
            NameList::Room | NameList::Theme | NameList::Inject | NameList::Macro => {
                words.iter().copied().find(|word| *word == written)
            }
        };
        let unknown = || text!("grammar-no-name", word = written);
        found.map(str::to_owned).ok_or_else(unknown)
    }
}

/// Which of the missions, by id, a word means: the one that is called so, else the first of that number, else the
/// only one that begins so.
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
