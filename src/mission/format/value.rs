//! What may stand after a key of a mission file: how each sort of value is read, checked and described.

use std::borrow::Cow;
use std::time::Duration;

use toml::Spanned;
use toml::de::DeValue;

use super::description::{FileShape, describe};
use super::draft::Draft;
use super::table::{FileTable, Reader};
use super::{LONGEST_S, POINT_RANGE};
use crate::diagnostic::Diagnostic;
use crate::mission::Point;

/// A sort of value.
pub(in crate::mission) trait FileValue {
    /// What a value is read to.
    type Out;

    /// How it is described.
    fn shape(&self) -> FileShape;

    /// Reads a value of the key `name`; `None` where it is wrong, which is a fault.
    fn read(
        &self,
        name: &str,
        written: Spanned<DeValue<'_>>,
        draft: &mut Draft,
    ) -> Option<Self::Out>;

    /// How a default is shown.
    fn show(&self, _: &Self::Out) -> String {
        "none".to_owned()
    }

    /// Whether it is a section of a file.
    fn is_section(&self) -> bool {
        false
    }
}

/// The names that could have been meant, in words.
pub(super) fn expected(names: &[&str]) -> String {
    match names {
        [] => "there are no fields".to_owned(),
        [one] => format!("expected `{one}`"),
        [one, other] => format!("expected `{one}` or `{other}`"),
        _ => format!("expected one of `{}`", names.join("`, `")),
    }
}

/// See [`number`].
#[derive(Debug, Clone, Copy)]
pub(in crate::mission) struct NumberValue {
    low: f64,
    high: f64,
    unit: &'static str,
}

/// A number from one to another, in a unit; NaN never lies between.
pub(in crate::mission) const fn number(low: f64, high: f64, unit: &'static str) -> NumberValue {
    NumberValue { low, high, unit }
}

impl FileValue for NumberValue {
    type Out = f64;

    fn shape(&self) -> FileShape {
        FileShape::Number(self.low, self.high, self.unit)
    }

    fn read(&self, name: &str, written: Spanned<DeValue<'_>>, draft: &mut Draft) -> Option<f64> {
        let place = written.span();
        let number: f64 = draft.faults.read(written)?;
        if (self.low..=self.high).contains(&number) {
            return Some(number);
        }
        let shown = if number.abs() < 1e9 {
            number.to_string()
        } else {
            format!("{number:e}")
        };
        let (low, high) = (self.low, self.high);
        let message = format!("`{name}` must lie between {low} and {high}, not {shown}");
        draft.faults.add(place, message);
        None
    }

    fn show(&self, number: &f64) -> String {
        number.to_string()
    }
}

/// See [`seconds`].
#[derive(Debug, Clone, Copy)]
pub(in crate::mission) struct SecondsValue(NumberValue);

/// A length of time, written in seconds.
pub(in crate::mission) const fn seconds(low: f64, high: f64) -> SecondsValue {
    SecondsValue(number(low, high, "s"))
}

/// Any length of time up to a day.
pub(in crate::mission) const fn time() -> SecondsValue {
    seconds(0.0, LONGEST_S)
}

impl FileValue for SecondsValue {
    type Out = Duration;

    fn shape(&self) -> FileShape {
        self.0.shape()
    }

    fn read(
        &self,
        name: &str,
        written: Spanned<DeValue<'_>>,
        draft: &mut Draft,
    ) -> Option<Duration> {
        Duration::try_from_secs_f64(self.0.read(name, written, draft)?).ok()
    }

    fn show(&self, time: &Duration) -> String {
        time.as_secs_f64().to_string()
    }
}

/// See [`whole`].
#[derive(Debug, Clone, Copy)]
pub(in crate::mission) struct WholeValue {
    low: u32,
    high: u32,
    unit: &'static str,
}

/// A whole number from one to another, of something.
pub(in crate::mission) const fn whole(low: u32, high: u32, unit: &'static str) -> WholeValue {
    WholeValue { low, high, unit }
}

impl FileValue for WholeValue {
    type Out = u32;

    fn shape(&self) -> FileShape {
        FileShape::Whole(self.low, self.high, self.unit)
    }

    fn read(&self, name: &str, written: Spanned<DeValue<'_>>, draft: &mut Draft) -> Option<u32> {
        let place = written.span();
        let number: u32 = draft.faults.read(written)?;
        let good = (self.low..=self.high).contains(&number);
        if !good {
            let unit = spaced(self.unit);
            let (low, high) = (self.low, self.high);
            let message = format!("`{name}` must lie between {low} and {high}{unit}");
            draft.faults.add(place, message);
        }
        good.then_some(number)
    }

    fn show(&self, number: &u32) -> String {
        number.to_string()
    }
}

/// A unit after its number.
pub(super) fn spaced(unit: &str) -> String {
    match unit {
        "" => String::new(),
        unit => format!(" {unit}"),
    }
}

/// See [`flag`].
#[derive(Debug, Clone, Copy)]
pub(in crate::mission) struct FlagValue;

pub(in crate::mission) const fn flag() -> FlagValue {
    FlagValue
}

impl FileValue for FlagValue {
    type Out = bool;

    fn shape(&self) -> FileShape {
        FileShape::Flag
    }

    fn read(&self, _: &str, written: Spanned<DeValue<'_>>, draft: &mut Draft) -> Option<bool> {
        draft.faults.read(written)
    }

    fn show(&self, flag: &bool) -> String {
        flag.to_string()
    }
}

/// See [`text`].
#[derive(Debug, Clone, Copy)]
pub(in crate::mission) struct TextValue {
    form: &'static str,
    rule: Option<TextRule>,
}

/// What a text must be, and the fault of one that is not.
type TextRule = (fn(&str) -> bool, &'static str);

/// Any text; what it is, where that is not plain.
pub(in crate::mission) const fn text(form: &'static str) -> TextValue {
    TextValue { form, rule: None }
}

/// A text that keeps a rule, which its fault says.
pub(in crate::mission) const fn text_by(
    form: &'static str,
    rule: fn(&str) -> bool,
    fault: &'static str,
) -> TextValue {
    TextValue {
        form,
        rule: Some((rule, fault)),
    }
}

/// The id of a table.
pub(in crate::mission) const fn id() -> TextValue {
    text_by(
        "1 to 32 letters, digits, `-` and `_`",
        is_id,
        "an id is 1 to 32 letters, digits, `-` and `_`",
    )
}

fn is_id(id: &str) -> bool {
    let plain = |c: char| c.is_ascii_alphanumeric() || c == '-' || c == '_';
    (1..=32).contains(&id.len()) && id.chars().all(plain)
}

impl FileValue for TextValue {
    type Out = Spanned<String>;

    fn shape(&self) -> FileShape {
        FileShape::Text(self.form, None)
    }

    fn read(
        &self,
        _: &str,
        written: Spanned<DeValue<'_>>,
        draft: &mut Draft,
    ) -> Option<Spanned<String>> {
        let place = written.span();
        let text = Spanned::new(place.clone(), draft.faults.read::<String>(written)?);
        match self.rule {
            Some((rule, fault)) if !rule(text.get_ref()) => {
                draft.faults.add(place, fault);
                None
            }
            _ => Some(text),
        }
    }
}

/// See [`word`].
#[derive(Debug, Clone, Copy)]
pub(in crate::mission) struct WordValue<T: 'static>(&'static [(&'static str, T)]);

/// One of a few words.
pub(in crate::mission) const fn word<T>(words: &'static [(&'static str, T)]) -> WordValue<T> {
    WordValue(words)
}

impl<T: Copy + PartialEq> FileValue for WordValue<T> {
    type Out = T;

    fn shape(&self) -> FileShape {
        FileShape::Words(self.0.iter().map(|(word, _)| *word).collect())
    }

    fn read(&self, _: &str, written: Spanned<DeValue<'_>>, draft: &mut Draft) -> Option<T> {
        let place = written.span();
        let word: String = draft.faults.read(written)?;
        let found = self.0.iter().find(|(known, _)| *known == word);
        if found.is_none() {
            let known: Vec<&str> = self.0.iter().map(|(known, _)| *known).collect();
            let message = format!("unknown variant `{word}`, {}", expected(&known));
            let fault = Diagnostic::new(place, message);
            draft.faults.push(match word.len() {
                // Of words of one letter, all are equally close.
                0 | 1 => fault,
                _ => fault.with_nearest(&word, known),
            });
        }
        found.map(|(_, meant)| *meant)
    }

    fn show(&self, meant: &T) -> String {
        let found = self.0.iter().find(|(_, known)| known == meant);
        found.map_or_else(String::new, |(word, _)| format!("`{word}`"))
    }
}

/// See [`named`].
#[derive(Debug, Clone, Copy)]
pub(in crate::mission) struct NamedValue<T> {
    what: &'static str,
    names: fn() -> Vec<&'static str>,
    find: fn(&str) -> Option<T>,
}

/// Something by its name, which is one of many; the names, and how one is found.
pub(in crate::mission) const fn named<T>(
    what: &'static str,
    names: fn() -> Vec<&'static str>,
    find: fn(&str) -> Option<T>,
) -> NamedValue<T> {
    NamedValue { what, names, find }
}

impl<T> FileValue for NamedValue<T> {
    type Out = T;

    fn shape(&self) -> FileShape {
        FileShape::Named(self.what, (self.names)())
    }

    fn read(&self, _: &str, written: Spanned<DeValue<'_>>, draft: &mut Draft) -> Option<T> {
        let place = written.span();
        let name = Spanned::new(place, draft.faults.read::<String>(written)?);
        let found = (self.find)(name.get_ref());
        if found.is_none() {
            draft.faults.unknown(self.what, &name, &(self.names)());
        }
        found
    }
}

/// See [`point`], [`gate`] and [`area`].
#[derive(Debug, Clone, Copy)]
pub(in crate::mission) struct PointsValue<const N: usize> {
    form: &'static str,
    is_good: fn([f64; N]) -> bool,
    /// The fault of another, by the key's name.
    fault: fn(&str) -> String,
}

pub(in crate::mission) const fn point() -> PointsValue<2> {
    PointsValue {
        form: "[east, north]",
        is_good: |point: Point| point.iter().all(|&axis| is_near(axis)),
        fault: |name| {
            format!("`{name}` must lie within {POINT_RANGE} m of the origin, as [east, north]")
        },
    }
}

/// A point in the air.
pub(in crate::mission) const fn gate() -> PointsValue<3> {
    PointsValue {
        form: "[east, north, up]",
        is_good: |[east_m, north_m, up_m]| {
            is_near(east_m) && is_near(north_m) && (0.0..=1000.0).contains(&up_m)
        },
        fault: |_| {
            format!(
                "a gate is [east, north, up]: within {POINT_RANGE} m of the origin, 0 to 1000 m high"
            )
        },
    }
}

pub(in crate::mission) const fn area() -> PointsValue<4> {
    PointsValue {
        form: "[west, south, east, north]",
        is_good: |sides| sides.iter().all(|&side| is_near(side)),
        fault: |name| {
            format!("`{name}` is [west, south, east, north], within {POINT_RANGE} m of the origin")
        },
    }
}

fn is_near(axis_m: f64) -> bool {
    (-POINT_RANGE..=POINT_RANGE).contains(&axis_m)
}

impl<const N: usize> FileValue for PointsValue<N>
where
    [f64; N]: for<'de> serde::Deserialize<'de>,
{
    type Out = [f64; N];

    fn shape(&self) -> FileShape {
        FileShape::Numbers {
            count: N,
            low: -POINT_RANGE,
            high: POINT_RANGE,
            unit: "m",
            form: self.form,
        }
    }

    fn read(
        &self,
        name: &str,
        written: Spanned<DeValue<'_>>,
        draft: &mut Draft,
    ) -> Option<[f64; N]> {
        let place = written.span();
        let point: [f64; N] = draft.faults.read(written)?;
        let good = (self.is_good)(point);
        if !good {
            draft.faults.add(place, (self.fault)(name));
        }
        good.then_some(point)
    }
}

/// See [`rising`] and [`spread`].
#[derive(Debug, Clone, Copy)]
pub(in crate::mission) struct PairValue {
    form: &'static str,
    bounds: NumberValue,
    may_be_equal: bool,
}

/// Two numbers within bounds, the second above the first.
pub(in crate::mission) const fn rising(form: &'static str, bounds: NumberValue) -> PairValue {
    PairValue {
        form,
        bounds,
        may_be_equal: false,
    }
}

/// Two numbers within bounds, the second not below the first.
pub(in crate::mission) const fn spread(form: &'static str, bounds: NumberValue) -> PairValue {
    PairValue {
        form,
        bounds,
        may_be_equal: true,
    }
}

/// Heights from the lowest to the highest.
pub(in crate::mission) const fn heights() -> PairValue {
    rising("[low, high]", number(0.0, 1000.0, "m"))
}

impl FileValue for PairValue {
    type Out = [f64; 2];

    fn shape(&self) -> FileShape {
        FileShape::Numbers {
            count: 2,
            low: self.bounds.low,
            high: self.bounds.high,
            unit: self.bounds.unit,
            form: self.form,
        }
    }

    fn read(
        &self,
        name: &str,
        written: Spanned<DeValue<'_>>,
        draft: &mut Draft,
    ) -> Option<[f64; 2]> {
        let place = written.span();
        let [first, second]: [f64; 2] = draft.faults.read(written)?;
        let NumberValue { low, high, unit } = self.bounds;
        let ordered = first < second || (self.may_be_equal && first <= second);
        let good = low <= first && ordered && second <= high;
        if !good {
            let (form, unit) = (self.form, spaced(unit));
            let fault = format!("`{name}` must be {form}, {low} to {high}{unit}");
            draft.faults.add(place, fault);
        }
        good.then_some([first, second])
    }
}

/// See [`list`].
#[derive(Debug, Clone, Copy)]
pub(in crate::mission) struct ListValue<V> {
    of: V,
    least: usize,
    most: usize,
}

/// At least and at most so many values.
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
            draft.faults.add(place, format!("`{name}` must be a list"));
            return None;
        };
        if !(self.least..=self.most).contains(&items.len()) {
            let (least, most) = (self.least, self.most);
            let fault = match least {
                0 => format!("`{name}` may have {most} entries"),
                _ if most == usize::MAX => format!("`{name}` must have an entry"),
                _ => format!("`{name}` must have {least} to {most} entries"),
            };
            draft.faults.add(place, fault);
            return None;
        }
        let items = items.into_iter();
        let all = items.filter_map(|item| self.of.read(name, item, draft));
        Some(all.collect())
    }
}

/// See [`map`].
#[derive(Debug, Clone, Copy)]
pub(in crate::mission) struct MapValue<V> {
    names: &'static str,
    of: V,
}

/// Values by names that the writer chooses; what they name.
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
            draft.faults.add(place, format!("`{name}` must be a table"));
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

/// See [`table`].
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

/// See [`tables`].
#[derive(Debug, Clone, Copy)]
pub(in crate::mission) struct TablesValue<T> {
    reader: Reader<T>,
    most: usize,
}

/// A section with at most so many tables.
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
            let fault = format!("an array of tables is needed here, as in [[{name}]]");
            draft.faults.add(place, fault);
            return None;
        };
        if let Some(beyond) = items.get(self.most) {
            let (most, count) = (self.most, items.len());
            let fault = format!("a mission has {most} of these at most, not {count}");
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
