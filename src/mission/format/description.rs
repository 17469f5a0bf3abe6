//! The content of a mission file's table, as its reader asks for it.

use super::draft::Draft;
use super::table::{AskedKey, FileTable, Reader};

/// The keys of a table.
#[derive(Debug, Clone, Default, PartialEq)]
pub(in crate::mission) struct FileTableDescription {
    pub keys: Vec<FileKey>,
    /// The kinds of tables that it may be one of.
    pub kinds: Vec<KindDescription>,
    /// Whether the key `kind` tells them apart; else each has a key that is called after it.
    pub by_kind_key: bool,
}

impl FileTableDescription {
    /// Whether every key that was asked for is in it, as one of all tables or of a kind.
    pub(super) fn has_all(&self, asked: &[AskedKey]) -> bool {
        let of_kinds = self.kinds.iter().flat_map(|kind| &kind.own.keys);
        let known: Vec<&str> = self
            .keys
            .iter()
            .chain(of_kinds)
            .map(|key| key.name.as_str())
            .collect();
        let mut names = asked.iter().map(|asked| asked.name.as_str());
        names.all(|name| known.contains(&name) || (self.by_kind_key && name == "kind"))
    }
}

/// One of the kinds of a table, with the keys that only it has.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::mission) struct KindDescription {
    pub name: &'static str,
    /// What it is, for people who write missions.
    pub about: &'static str,
    pub own: FileTableDescription,
}

/// A key of a table.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::mission) struct FileKey {
    pub name: String,
    pub shape: FileShape,
    pub presence: Presence,
    /// What it means, for people who write missions.
    pub about: &'static str,
}

/// Whether a key has to be there.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::mission) enum Presence {
    Needed,
    Optional,
    /// What counts where it is missing.
    Default(String),
}

/// What may stand after a key.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::mission) enum FileShape {
    /// From the first to the second, in a unit.
    Number(f64, f64, &'static str),
    Whole(u32, u32, &'static str),
    Flag,
    /// Text: how it is written, and its greatest length in bytes.
    Text(&'static str, Option<usize>),
    /// So many numbers, each from one to the other, with how they are written.
    Numbers {
        count: usize,
        low: f64,
        high: f64,
        unit: &'static str,
        form: &'static str,
    },
    Words(Vec<&'static str>),
    /// One of many names, called by what they are.
    Named(&'static str, Vec<&'static str>),
    NumberOrWord(&'static str),
    /// At least and at most so many.
    List(Box<FileShape>, usize, usize),
    /// Values by names that the writer chooses, with what they name.
    Map(&'static str, Box<FileShape>),
    Table(FileTableDescription),
}

/// What a reader asks for.
pub(in crate::mission) fn describe<T>(reader: Reader<T>) -> FileTableDescription {
    FileTable::describe(reader, &mut Draft::default())
}
