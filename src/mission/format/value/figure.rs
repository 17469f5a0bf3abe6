//! Single figures: numbers in a unit, lengths of time, whole numbers, and flags.

use std::time::Duration;

use toml::Spanned;
use toml::de::DeValue;

use super::FileValue;
use crate::mission::format::LONGEST_S;
use crate::mission::format::description::FileShape;
use crate::mission::format::draft::Draft;
use crate::mission::format::faults::not_between;
use crate::text;

#[derive(Debug, Clone, Copy)]
pub(in crate::mission) struct NumberValue {
    pub(super) low: f64,
    pub(super) high: f64,
    pub(super) unit: &'static str,
}

/// A number in a range, with its unit; NaN is never valid.
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
        let message = not_between(name, &(self.low..=self.high), number);
        draft.faults.add(place, message);
        None
    }

    fn show(&self, number: &f64) -> String {
        number.to_string()
    }
}

#[derive(Debug, Clone, Copy)]
pub(in crate::mission) struct SecondsValue(NumberValue);

/// A duration, written in seconds.
pub(in crate::mission) const fn seconds(low: f64, high: f64) -> SecondsValue {
    SecondsValue(number(low, high, "s"))
}

/// Any duration up to a day.
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

#[derive(Debug, Clone, Copy)]
pub(in crate::mission) struct WholeValue {
    low: u32,
    high: u32,
    unit: &'static str,
}

/// A whole number in a range; `unit` names the items that it counts.
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
            // The unit is a word of the reference, which is English; the name says what is counted.
            let (low, high) = (self.low, self.high);
            let message = text!(
                "fault-between",
                name = name,
                low = low.to_string(),
                high = high.to_string()
            );
            draft.faults.add(place, message);
        }
        good.then_some(number)
    }

    fn show(&self, number: &u32) -> String {
        number.to_string()
    }
}

/// A unit with the space that separates it from its number.
pub(in crate::mission::format) fn spaced(unit: &str) -> String {
    match unit {
        "" => String::new(),
        unit => format!(" {unit}"),
    }
}

#[derive(Debug, Clone, Copy)]
pub(in crate::mission) struct FlagValue;

/// A flag, written `true` or `false`.
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
