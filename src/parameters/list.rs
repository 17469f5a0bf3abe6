//! The parameters of one vehicle, collected from the messages that are heard.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::{ParameterEncoding, ParameterType, is_same};

/// The maximum number of parameters kept: no vehicle has more, so further names are noise.
const MOST_PARAMETERS: usize = 10_000;
/// The name under which PX4 sends a checksum of its parameters; it is not a parameter.
const HASH: &str = "_HASH_CHECK";

/// One parameter as last heard.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ListedParameter {
    /// The value. A number, even if the vehicle sends the bytes of integers.
    pub value: f64,
    /// The value when the parameter was first heard.
    pub original: f64,
    /// The type in which the vehicle stores the value.
    pub kind: ParameterType,
    /// Its index in the vehicle's list, if the vehicle has sent one.
    pub index: Option<u16>,
}

impl ListedParameter {
    /// Whether it has changed since it was first heard.
    pub fn is_changed(&self) -> bool {
        !is_same(self.value, self.original)
    }
}

/// The content of a `PARAM_VALUE`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HeardParameter<'a> {
    pub name: &'a str,
    pub value: f64,
    /// The type in which the value is stored.
    pub kind: ParameterType,
    /// How the vehicle sends and takes values.
    pub encoding: ParameterEncoding,
    /// The index in the list; `None` if the value was sent on its own.
    pub index: Option<u16>,
    /// The number of parameters of the vehicle.
    pub count: u16,
}

/// The parameters of a vehicle that have been heard, by name.
#[derive(Debug, Clone, Default)]
pub struct ParameterList {
    // Names are shared, so that a copy of the list copies no text.
    by_name: BTreeMap<Arc<str>, ListedParameter>,
    count: Option<u16>,
    /// Which indices of the list have been heard.
    seen: Vec<bool>,
    received: u16,
    passed: u64,
    /// The length of the list according to a value that was sent on its own.
    announced: Option<u16>,
    revision: u64,
    /// How the vehicle sends and takes values.
    encoding: ParameterEncoding,
    /// The defaults by name, if the vehicle has told them.
    defaults: Arc<BTreeMap<String, f64>>,
}

impl ParameterList {
    /// The default of a parameter, if the vehicle has told it.
    pub fn default_of(&self, name: &str) -> Option<f64> {
        self.defaults.get(name).copied()
    }

    /// The default of a parameter that has another value; `None` also without a known default.
    pub fn other_default(&self, name: &str) -> Option<f64> {
        let value = self.get(name)?.value;
        self.default_of(name)
            .filter(|default| !is_same(*default, value))
    }

    /// How the vehicle sends and takes values, as far as it has sent any.
    pub fn encoding(&self) -> ParameterEncoding {
        self.encoding
    }

    /// Whether the vehicle has told its defaults.
    pub fn has_defaults(&self) -> bool {
        !self.defaults.is_empty()
    }

    /// Stores the defaults of all parameters.
    pub fn note_defaults(&mut self, defaults: BTreeMap<String, f64>) {
        self.defaults = Arc::new(defaults);
        self.revision += 1;
    }

    /// The parameter with that name (upper case, as the vehicle spells it).
    pub fn get(&self, name: &str) -> Option<&ListedParameter> {
        self.by_name.get(name)
    }

    /// All heard parameters, in order of their names.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = (&str, &ListedParameter)> {
        self.by_name
            .iter()
            .map(|(name, parameter)| (name.as_ref(), parameter))
    }

    /// The number of heard parameters.
    pub fn len(&self) -> usize {
        self.by_name.len()
    }

    /// Whether no parameter has been heard.
    pub fn is_empty(&self) -> bool {
        self.by_name.is_empty()
    }

    /// The number of the vehicle's parameters, once known.
    pub fn count(&self) -> Option<u16> {
        self.count
    }

    /// The number of list indices that have been heard.
    pub fn received(&self) -> u16 {
        self.received
    }

    /// The number of values heard with an index, repeats included.
    pub fn passed(&self) -> u64 {
        self.passed
    }

    /// Whether every index of the list has been heard.
    pub fn is_complete(&self) -> bool {
        self.count.is_some_and(|count| count > 0) && self.received == self.seen.len() as u16
    }

    /// Whether the number of parameters has changed since the list was sent: some parameters appear
    /// only after others are enabled.
    pub fn is_outdated(&self) -> bool {
        self.announced.is_some() && self.announced != self.count
    }

    /// Indices of the list that have not been heard yet, in order. Empty until the length is known.
    pub fn missing(&self) -> impl Iterator<Item = u16> + '_ {
        (0..)
            .zip(&self.seen)
            .filter(|(_, seen)| !**seen)
            .map(|(index, _)| index)
    }

    /// A number that changes whenever the list does.
    pub fn revision(&self) -> u64 {
        self.revision
    }

    /// Forgets which indices have been heard, but keeps the values: the list is about to be sent again.
    pub fn expect_again(&mut self) {
        self.seen.fill(false);
        self.received = 0;
        self.announced = None;
        self.revision += 1;
    }

    pub fn forget(&mut self) {
        *self = Self {
            revision: self.revision + 1,
            ..Self::default()
        };
    }

    /// Stores a parameter value that a vehicle sent.
    pub fn note(&mut self, heard: &HeardParameter<'_>) {
        if heard.name == HASH {
            return;
        }
        self.encoding = heard.encoding;
        self.note_place(heard);
        if let Some(known) = self.by_name.get_mut(heard.name) {
            let index = heard.index.or(known.index);
            // Compared by bits, since NaN is never equal to itself.
            let is_news = known.value.to_bits() != heard.value.to_bits()
                || (known.kind, known.index) != (heard.kind, index);
            self.revision += u64::from(is_news);
            *known = ListedParameter {
                value: heard.value,
                original: known.original,
                kind: heard.kind,
                index,
            };
        } else if self.by_name.len() < MOST_PARAMETERS {
            let parameter = ListedParameter {
                value: heard.value,
                original: heard.value,
                kind: heard.kind,
                index: heard.index,
            };
            self.by_name.insert(heard.name.into(), parameter);
            self.revision += 1;
        }
    }

    /// Notes the index of a value. A different count means a different list, so the indices heard so far no longer
    /// count. A value sent on its own is not proof: a list that is just arriving may still have the old numbering.
    fn note_place(&mut self, heard: &HeardParameter<'_>) {
        let Some(index) = heard.index else {
            self.announced = Some(heard.count);
            if self.received == 0 && self.count != Some(heard.count) {
                self.renumber(heard.count);
            }
            return;
        };
        self.passed += 1;
        if self.count != Some(heard.count) {
            self.renumber(heard.count);
        }
        if let Some(seen) = self.seen.get_mut(usize::from(index))
            && !*seen
        {
            *seen = true;
            self.received += 1;
            self.revision += 1;
        }
    }

    fn renumber(&mut self, count: u16) {
        self.count = Some(count);
        self.seen.clear();
        self.seen.resize(usize::from(count), false);
        self.received = 0;
        self.revision += 1;
        for parameter in self.by_name.values_mut() {
            parameter.index = None;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn heard(name: &str, value: f64, index: Option<u16>, count: u16) -> HeardParameter<'_> {
        HeardParameter {
            name,
            value,
            kind: ParameterType::Real32,
            encoding: ParameterEncoding::Converted,
            index,
            count,
        }
    }

    #[test]
    fn a_list_is_complete_once_every_place_has_passed() {
        let mut list = ParameterList::default();
        list.note(&heard("B", 2.0, Some(1), 2));
        assert!(!list.is_complete());
        list.note(&heard("B", 2.0, Some(1), 2));
        assert_eq!((list.received(), list.is_complete()), (1, false));
        list.note(&heard("A", 1.0, Some(0), 2));
        assert!(list.is_complete());
        assert_eq!(list.iter().map(|(name, _)| name).collect::<String>(), "AB");
    }

    #[test]
    fn the_first_value_is_what_changes_are_counted_from() {
        let mut list = ParameterList::default();
        list.note(&heard("A", 1.0, Some(0), 1));
        list.note(&heard("A", 5.0, None, 1));
        let changed = *list.get("A").expect("heard");
        assert!(changed.is_changed());
        assert_eq!(changed.index, Some(0));
        list.note(&heard("A", 1.0, None, 1));
        assert!(!list.get("A").expect("heard").is_changed());
    }

    #[test]
    fn a_value_sent_for_itself_does_not_upset_the_list_that_is_coming() {
        let mut list = ParameterList::default();
        list.note(&heard("A", 1.0, Some(0), 2));
        list.note(&heard("STAT_RUNTIME", 9.0, None, 3));
        list.note(&heard("B", 1.0, Some(1), 2));
        assert!(list.is_complete());
        assert!(list.is_outdated());
        list.note(&heard("A", 1.0, Some(0), 3));
        assert_eq!((list.received(), list.is_outdated()), (1, false));
    }

    #[test]
    fn places_beyond_the_list_and_checksums_are_no_parameters_of_it() {
        let mut list = ParameterList::default();
        list.note(&heard("A", 1.0, Some(7), 2));
        list.note(&heard(HASH, 1.0, None, 2));
        assert_eq!((list.received(), list.len()), (0, 1));
        list.note(&heard("A", 1.0, Some(0), 0));
        assert!(!list.is_complete(), "an empty list is none");
    }

    #[test]
    fn only_news_moves_the_revision() {
        let mut list = ParameterList::default();
        list.note(&heard("A", f64::NAN, Some(0), 1));
        let before = list.revision();
        list.note(&heard("A", 1.0, Some(0), 1));
        let after = list.revision();
        assert!(after > before);
        list.note(&heard("A", 1.0, Some(0), 1));
        assert_eq!(list.revision(), after);
    }
}
