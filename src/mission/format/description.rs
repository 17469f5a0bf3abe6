//! The content of a mission file's table, as its reader requests it.

/// The keys of a table.
#[derive(Debug, Clone, Default, PartialEq)]
pub(in crate::mission) struct FileTableDescription {
    pub keys: Vec<FileKey>,
    /// The kinds of the table, if any.
    pub kinds: Vec<KindDescription>,
    /// Whether the key `kind` distinguishes them; otherwise each kind has a key named after it.
    pub by_kind_key: bool,
}

impl FileTableDescription {
    /// Whether the table contains every requested key, as a common key or as a key of a kind.
    pub(super) fn has_all<'a>(&self, mut asked: impl Iterator<Item = &'a str>) -> bool {
        let of_kinds = self.kinds.iter().flat_map(|kind| &kind.own.keys);
        let known: Vec<&str> = self
            .keys
            .iter()
            .chain(of_kinds)
            .map(|key| key.name.as_str())
            .collect();
        asked.all(|name| known.contains(&name) || (self.by_kind_key && name == "kind"))
    }
}

/// One of the kinds of a table, with the keys that only it has.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::mission) struct KindDescription {
    pub name: &'static str,
    /// Its meaning, for authors of missions.
    pub about: &'static str,
    pub own: FileTableDescription,
}

/// A key of a table.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::mission) struct FileKey {
    pub name: String,
    pub shape: FileShape,
    pub presence: Presence,
    /// Its meaning, for authors of missions.
    pub about: &'static str,
}

/// Whether a key is required.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::mission) enum Presence {
    Needed,
    Optional,
    /// The value used if the key is missing.
    Default(String),
}

/// The form of a key's value.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::mission) enum FileShape {
    /// Minimum, maximum and unit.
    Number(f64, f64, &'static str),
    Whole(u32, u32, &'static str),
    Flag,
    /// Text: its form, and its maximum length in bytes.
    Text(&'static str, Option<usize>),
    /// A fixed count of numbers, each in a range, with their form.
    Numbers {
        count: usize,
        low: f64,
        high: f64,
        unit: &'static str,
        form: &'static str,
    },
    Words(Vec<&'static str>),
    /// One of a set of names: the kind of item that they refer to, and the names.
    Named(&'static str, Vec<&'static str>),
    NumberOrWord(&'static str),
    /// A list: the form of its items, and the minimum and maximum count.
    List(Box<FileShape>, usize, usize),
    /// A map with keys that the author chooses: what the keys refer to, and the form of the values.
    Map(&'static str, Box<FileShape>),
    Table(FileTableDescription),
}
