//! A table of a mission file, as its reader sees it.

use std::ops::Range;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::description::{FileKey, FileTableDescription, KindDescription, Presence};
use super::draft::Draft;
use super::name_kind::NameKind;
use super::value::{self, FileValue};
use crate::diagnostic::{Diagnostic, nearest};
use crate::text;
use crate::text::Text;

/// Reads one table, or describes it. It must request all of its keys before it fails because of a missing one.
pub(in crate::mission) type Reader<T> = fn(&mut FileTable<'_>) -> Option<T>;

/// A kind of table, listed in its section.
#[derive(Debug)]
pub(in crate::mission) struct KindOf<T> {
    pub name: &'static str,
    /// Its meaning, for authors of missions.
    pub about: &'static str,
    /// Reads the keys of this kind.
    pub read: Reader<T>,
}

/// The description of a reader's table.
pub(in crate::mission) fn describe<T>(reader: Reader<T>) -> FileTableDescription {
    FileTable::describe(reader, &mut Draft::default())
}

/// A table that is being read, or described.
#[derive(Debug)]
pub(in crate::mission) struct FileTable<'a> {
    content: TableContent<'a>,
    place: Range<usize>,
    asked: Vec<AskedKey>,
    /// The faults of required keys that are missing.
    missing: Vec<(String, Diagnostic)>,
    /// Whether it is the whole file, whose keys are too many to name in a fault.
    is_root: bool,
    id: String,
    draft: &'a mut Draft,
}

#[derive(Debug)]
pub(super) struct AskedKey {
    pub name: String,
    /// The position of its value, if it has one.
    place: Option<Range<usize>>,
    is_wrong: bool,
}

#[derive(Debug)]
enum TableContent<'a> {
    /// The keys not read yet.
    Written(DeTable<'a>),
    /// The remaining keys are ignored, because the table cannot be understood.
    Abandoned,
    Described(FileTableDescription),
}

impl FileTable<'_> {
    /// Reads a table; unread keys are faults.
    pub fn read<T>(
        reader: Reader<T>,
        written: Spanned<DeValue<'_>>,
        draft: &mut Draft,
    ) -> Option<T> {
        let place = written.span();
        let DeValue::Table(values) = written.into_inner() else {
            draft.faults.add(place, text!("fault-table-needed"));
            return None;
        };
        FileTable::read_as(reader, Spanned::new(place, values), false, draft)
    }

    /// Reads a whole file.
    pub fn read_root<T>(
        reader: Reader<T>,
        root: Spanned<DeTable<'_>>,
        draft: &mut Draft,
    ) -> Option<T> {
        FileTable::read_as(reader, root, true, draft)
    }

    fn read_as<T>(
        reader: Reader<T>,
        written: Spanned<DeTable<'_>>,
        is_root: bool,
        draft: &mut Draft,
    ) -> Option<T> {
        let place = written.span();
        let content = TableContent::Written(written.into_inner());
        let mut table = FileTable::new(content, place, draft);
        table.is_root = is_root;
        let value = reader(&mut table);
        // Only keys that are requested in every case can be described.
        debug_assert!(
            value.is_none()
                || describe(reader).has_all(table.asked.iter().map(|key| key.name.as_str()))
        );
        table.finish();
        value
    }

    /// Runs the reader without values and collects its requests.
    pub fn describe<T>(reader: Reader<T>, draft: &mut Draft) -> FileTableDescription {
        let content = TableContent::Described(FileTableDescription::default());
        let mut table = FileTable::new(content, 0..0, draft);
        // The table is empty, so the reader returns no value, and only its requests matter.
        drop(reader(&mut table));
        match table.content {
            TableContent::Described(description) => description,
            TableContent::Written(_) | TableContent::Abandoned => FileTableDescription::default(),
        }
    }

    fn new<'b>(
        content: TableContent<'b>,
        place: Range<usize>,
        draft: &'b mut Draft,
    ) -> FileTable<'b> {
        FileTable {
            content,
            place,
            asked: Vec::new(),
            missing: Vec::new(),
            is_root: false,
            id: String::new(),
            draft,
        }
    }

    /// The results of earlier sections.
    pub fn draft(&mut self) -> &mut Draft {
        self.draft
    }

    /// The table's own id.
    pub fn own_id(&self) -> String {
        self.id.clone()
    }

    /// The value of a required key; `None` if it is missing or invalid, which is a fault.
    #[expect(
        clippy::needless_pass_by_value,
        reason = "a form is written where its key is asked for"
    )]
    pub fn need<V: FileValue>(
        &mut self,
        name: &str,
        value: V,
        about: &'static str,
    ) -> Option<V::Out> {
        self.ask(name, &value, Presence::Needed, about)
    }

    /// The value of an optional key; `None` if it is missing, or if it is invalid, which is a
    /// fault.
    #[expect(
        clippy::needless_pass_by_value,
        reason = "a form is written where its key is asked for"
    )]
    pub fn may<V: FileValue>(
        &mut self,
        name: &str,
        value: V,
        about: &'static str,
    ) -> Option<V::Out> {
        self.ask(name, &value, Presence::Optional, about)
    }

    /// The value of an optional key; the default if it is missing, or if it is invalid, which is a
    /// fault.
    #[expect(
        clippy::needless_pass_by_value,
        reason = "a form is written where its key is asked for"
    )]
    pub fn or<V: FileValue>(
        &mut self,
        name: &str,
        value: V,
        default: V::Out,
        about: &'static str,
    ) -> V::Out {
        let shown = Presence::Default(value.show(&default));
        self.ask(name, &value, shown, about).unwrap_or(default)
    }

    fn ask<V: FileValue>(
        &mut self,
        name: &str,
        value: &V,
        presence: Presence,
        about: &'static str,
    ) -> Option<V::Out> {
        let written = match &mut self.content {
            TableContent::Written(values) => values.remove(name),
            TableContent::Abandoned => None,
            TableContent::Described(description) => {
                description.keys.push(FileKey {
                    name: name.to_owned(),
                    shape: value.shape(),
                    presence,
                    about,
                });
                return None;
            }
        };
        let place = written.as_ref().map(Spanned::span);
        let read = written.map(|written| value.read(name, written, self.draft));
        self.asked.push(AskedKey {
            name: name.to_owned(),
            place,
            is_wrong: matches!(read, Some(None)),
        });
        if read.is_none() && presence == Presence::Needed {
            let fault = if value.is_section() && self.is_root {
                Diagnostic::new(0..0, text!("fault-section-missing", name = name))
            } else {
                Diagnostic::new(self.place.clone(), text!("fault-key-missing", name = name))
            };
            self.missing.push((name.to_owned(), fault));
        }
        read.flatten()
    }

    /// The id of a table, which must be unique in its section.
    pub fn need_id(&mut self, section: &'static str) -> Option<()> {
        let written = self.need("id", value::id(), "name by which other tables refer to it")?;
        self.draft.add_id(section, &written);
        self.id = written.into_inner();
        Some(())
    }

    /// A required text, with its translation under the same key with the suffix `_uk`.
    pub fn need_text(&mut self, name: &str, about: &'static str) -> Option<Text> {
        let english = self.need(name, value::text(""), about);
        self.translated(name, english)
    }

    /// An optional text, with its translation.
    pub fn may_text(&mut self, name: &str, about: &'static str) -> Option<Text> {
        let english = self.may(name, value::text(""), about);
        self.translated(name, english)
    }

    fn translated(&mut self, name: &str, english: Option<Spanned<String>>) -> Option<Text> {
        let key = format!("{name}_uk");
        let ukrainian = self.may(&key, value::text(""), "the same in Ukrainian");
        Some(self.draft.faults.translated(english?, ukrainian, &key))
    }

    /// The kind of the table, by its key `kind`, and the value read from the keys of this kind.
    pub fn need_kind<T>(
        &mut self,
        named: NameKind,
        kinds: &'static [KindOf<T>],
    ) -> Option<(&'static str, T)> {
        let names = || kinds.iter().map(|kind| kind.name);
        if self.describe_kinds(kinds, true) {
            return None;
        }
        let Some(written) = self.need("kind", value::text(""), "") else {
            self.abandon();
            return None;
        };
        let Some(kind) = kinds.iter().find(|kind| kind.name == written.get_ref()) else {
            let known: Vec<&str> = names().collect();
            self.draft.faults.unknown(named, &written, &known);
            self.abandon();
            return None;
        };
        Some((kind.name, (kind.read)(self)?))
    }

    /// The value of a table whose kind is given by one of its keys.
    pub fn need_one_of<T>(&mut self, what: Text, kinds: &'static [KindOf<T>]) -> Option<T> {
        if self.describe_kinds(kinds, false) {
            return None;
        }
        let found = kinds.iter().find(|kind| self.is_written(kind.name));
        if found.is_none() {
            let known: Vec<&str> = kinds.iter().map(|kind| kind.name).collect();
            let fault = text!("fault-one-of", what = what, known = known.join(", "));
            self.fault(fault);
            self.abandon();
        }
        (found?.read)(self)
    }

    /// Adds the kinds to the description if the table is being described; returns whether it is.
    fn describe_kinds<T>(&mut self, kinds: &'static [KindOf<T>], by_kind_key: bool) -> bool {
        let TableContent::Described(description) = &mut self.content else {
            return false;
        };
        let of = |kind: &KindOf<T>| KindDescription {
            name: kind.name,
            about: kind.about,
            own: FileTable::describe(kind.read, &mut Draft::default()),
        };
        description.kinds = kinds.iter().map(of).collect();
        description.by_kind_key = by_kind_key;
        true
    }

    /// Whether a key has a value, valid or not.
    pub fn is_written(&self, name: &str) -> bool {
        let mut asked = self.asked.iter();
        let is_left = match &self.content {
            TableContent::Written(values) => values.contains_key(name),
            TableContent::Abandoned | TableContent::Described(_) => false,
        };
        is_left || asked.any(|asked| asked.name == name && asked.place.is_some())
    }

    /// Whether a requested value is invalid.
    pub fn has_wrong(&self) -> bool {
        self.asked.iter().any(|asked| asked.is_wrong)
    }

    /// Adds a fault for the whole table.
    pub fn fault(&mut self, message: impl Into<Text>) {
        self.draft.faults.add(self.place.clone(), message);
    }

    /// Adds a fault for a requested key, at its value if it has one.
    pub fn fault_of(&mut self, name: &str, message: impl Into<Text>) {
        let place = self.place_of(name);
        self.draft.faults.add(place, message);
    }

    /// The position of a requested key's value; the table's position if it has none.
    pub fn place_of(&self, name: &str) -> Range<usize> {
        let mut asked = self.asked.iter();
        let found = asked.find(|asked| asked.name == name);
        let place = found.and_then(|asked| asked.place.clone());
        place.unwrap_or_else(|| self.place.clone())
    }

    /// Suppresses further faults, because the rest of the table cannot be understood.
    fn abandon(&mut self) {
        self.content = TableContent::Abandoned;
    }

    /// Adds faults for missing and unknown keys. A misspelt key counts as a single fault.
    fn finish(self) {
        let TableContent::Written(left) = &self.content else {
            return;
        };
        let known: Vec<&str> = self.asked.iter().map(|asked| asked.name.as_str()).collect();
        let mut misspelt = Vec::new();
        for (key, _) in left {
            let name = key.get_ref().as_ref();
            let message = match known.as_slice() {
                _ if self.is_root => text!("fault-key-unknown", name = name),
                [] => text!("fault-key-none", name = name),
                known => {
                    let known = known.join(", ");
                    text!("fault-key-unexpected", name = name, known = known)
                }
            };
            misspelt.extend(nearest(name, known.iter().copied()).map(str::to_owned));
            let fault = Diagnostic::new(key.span(), message);
            self.draft.faults.push(match name.len() {
                // One-letter names are all equally similar.
                1 => fault,
                _ => fault.with_nearest(name, known.iter().copied()),
            });
        }
        for (name, fault) in self.missing {
            if !misspelt.contains(&name) {
                self.draft.faults.push(fault);
            }
        }
    }
}
