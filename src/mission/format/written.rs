//! Positions of the values in a mission file, for faults that are found only after the whole file
//! has been read.

use std::collections::BTreeMap;
use std::ops::Range;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// The position of a value in a file, and of its parts.
#[derive(Debug, Default)]
pub(in crate::mission) struct WrittenValue {
    /// The position of the value.
    pub span: Range<usize>,
    /// The position of its key; empty for items of an array.
    pub key: Range<usize>,
    keys: BTreeMap<String, Self>,
    items: Vec<Self>,
}

impl WrittenValue {
    /// The positions of all values of a file.
    pub fn of_file(root: &Spanned<DeTable<'_>>) -> Self {
        Self {
            span: root.span(),
            keys: keys(root.get_ref()),
            ..Self::default()
        }
    }

    fn of(value: &Spanned<DeValue<'_>>, key: Range<usize>) -> Self {
        let (keys, items) = match value.get_ref() {
            DeValue::Table(table) => (keys(table), Vec::new()),
            DeValue::Array(array) => {
                let items = array.iter().map(|item| Self::of(item, Range::default()));
                (BTreeMap::new(), items.collect())
            }
            DeValue::String(_)
            | DeValue::Integer(_)
            | DeValue::Float(_)
            | DeValue::Boolean(_)
            | DeValue::Datetime(_) => Default::default(),
        };
        Self {
            span: value.span(),
            key,
            keys,
            items,
        }
    }

    /// The value of a key, if present.
    pub fn get(&self, key: &str) -> Option<&Self> {
        self.keys.get(key)
    }

    /// The items of an array; empty for other values.
    pub fn items(&self) -> &[Self] {
        &self.items
    }

    /// The items of the array under a key.
    pub fn items_of(&self, key: &str) -> &[Self] {
        self.get(key).map_or(&[], Self::items)
    }

    /// The position of a key's value; the position of the whole table if the key is missing.
    pub fn span_of(&self, key: &str) -> Range<usize> {
        self.get(key).unwrap_or(self).span.clone()
    }

    /// The position of an item of a key's array; the position of the key's value if it is not an array.
    pub fn span_of_item(&self, key: &str, index: usize) -> Range<usize> {
        let item = self.items_of(key).get(index);
        item.map_or_else(|| self.span_of(key), |item| item.span.clone())
    }
}

fn keys(table: &DeTable<'_>) -> BTreeMap<String, WrittenValue> {
    let written = table.iter().map(|(key, value)| {
        let name = key.get_ref().as_ref().to_owned();
        (name, WrittenValue::of(value, key.span()))
    });
    written.collect()
}
