//! Composite values: lists, maps, tables with a reader of their own, and sections of such tables.

use crate::text;
use std::borrow::Cow;

use toml::Spanned;
use toml::de::DeValue;

use super::description::FileShape;
use super::draft::Draft;
use super::table::{FileTable, Reader, describe};
use super::value::FileValue;

#[derive(Debug, Clone, Copy)]
pub(in crate::mission) struct ListValue<V> {
    of: V,
    least: usize,
    most: usize,
}

/// A list with the minimum and the maximum count.
pub(in crate::mission) const fn list<V>(of: V, least: usize, most: usize) -> ListValue<V> {
    ListValue { of, least, most }
}

impl<V: FileValue> FileValue for ListValue<V> {
    type Out = Vec<V::Out>;

    fn shape(&self) -> FileShape {
        FileShape::List(Box::new(self.of.shape()), self.least, self.most)
    }

    fn read(
        &self,
        name: &str,
        written: Spanned<DeValue<'_>>,
        draft: &mut Draft,
    ) -> Option<Vec<V::Out>> {
        let place = written.span();
        let DeValue::Array(items) = written.into_inner() else {
            draft.faults.add(place, text!("fault-list", name = name));
            return None;
        };
        if !(self.least..=self.most).contains(&items.len()) {
            let (least, most) = (self.least, self.most);
            let fault = match least {
                0 => text!("fault-list-most", name = name, most = most),
                _ if most == usize::MAX => text!("fault-list-one", name = name),
                _ => text!("fault-list-count", name = name, least = least, most = most),
            };
            draft.faults.add(place, fault);
            return None;
        }
        let items = items.into_iter();
        let all = items.filter_map(|item| self.of.read(name, item, draft));
        Some(all.collect())
    }
}

#[derive(Debug, Clone, Copy)]
pub(in crate::mission) struct MapValue<V> {
    names: &'static str,
    of: V,
}

/// A map with keys that the author chooses; `names` describes what the keys refer to.
pub(in crate::mission) const fn map<V>(names: &'static str, of: V) -> MapValue<V> {
    MapValue { names, of }
}

impl<V: FileValue> FileValue for MapValue<V> {
    type Out = Vec<(Spanned<String>, V::Out)>;

    fn shape(&self) -> FileShape {
        FileShape::Map(self.names, Box::new(self.of.shape()))
    }

    fn read(
        &self,
        name: &str,
        written: Spanned<DeValue<'_>>,
        draft: &mut Draft,
    ) -> Option<Self::Out> {
        let place = written.span();
        let DeValue::Table(values) = written.into_inner() else {
            draft.faults.add(place, text!("fault-table", name = name));
            return None;
        };
        let read = |(key, value): (Spanned<Cow<'_, str>>, Spanned<DeValue<'_>>)| {
            let named = Spanned::new(key.span(), key.into_inner().into_owned());
            let value = self.of.read(named.get_ref(), value, draft)?;
            Some((named, value))
        };
        Some(values.into_iter().filter_map(read).collect())
    }
}

#[derive(Debug, Clone, Copy)]
pub(in crate::mission) struct TableValue<T>(Reader<T>);

/// A table with a reader of its own.
pub(in crate::mission) const fn table<T>(reader: Reader<T>) -> TableValue<T> {
    TableValue(reader)
}

impl<T> FileValue for TableValue<T> {
    type Out = T;

    fn shape(&self) -> FileShape {
        FileShape::Table(describe(self.0))
    }

    fn read(&self, _: &str, written: Spanned<DeValue<'_>>, draft: &mut Draft) -> Option<T> {
        FileTable::read(self.0, written, draft)
    }

    fn is_section(&self) -> bool {
        true
    }
}

#[derive(Debug, Clone, Copy)]
pub(in crate::mission) struct TablesValue<T> {
    reader: Reader<T>,
    most: usize,
}

/// A section with at most `most` tables.
pub(in crate::mission) const fn tables<T>(reader: Reader<T>, most: usize) -> TablesValue<T> {
    TablesValue { reader, most }
}

impl<T> FileValue for TablesValue<T> {
    type Out = Vec<T>;

    fn shape(&self) -> FileShape {
        let table = FileShape::Table(describe(self.reader));
        FileShape::List(Box::new(table), 0, self.most)
    }

    fn read(&self, name: &str, written: Spanned<DeValue<'_>>, draft: &mut Draft) -> Option<Vec<T>> {
        let place = written.span();
        let DeValue::Array(items) = written.into_inner() else {
            let fault = text!("fault-tables", name = name);
            draft.faults.add(place, fault);
            return None;
        };
        if let Some(beyond) = items.get(self.most) {
            let (most, count) = (self.most, items.len());
            let fault = text!("fault-too-many", most = most, count = count);
            draft.faults.add(beyond.span(), fault);
        }
        let items = items.into_iter().take(self.most);
        let all = items.filter_map(|item| FileTable::read(self.reader, item, draft));
        Some(all.collect())
    }

    fn is_section(&self) -> bool {
        true
    }
}
