//! Numbers in files: words with their places, and fixed-point coordinates.

use std::ops::Range;

use crate::fault::{Fault, FaultKind};
use crate::{HeightFrame, Item, command};

/// A word of a line with its place in the text.
#[derive(Debug, Clone, Copy)]
pub(super) struct Word<'a> {
    pub(super) text: &'a str,
    pub(super) start: usize,
}

impl Word<'_> {
    pub(super) fn span(&self) -> Range<usize> {
        self.start..self.start + self.text.len()
    }

    pub(super) fn number(&self) -> Result<f64, Fault> {
        let not_a_number = || Fault::new(self.span(), FaultKind::NotANumber(self.text.to_owned()));
        self.text.parse().map_err(|_| not_a_number())
    }

    /// A whole number that fits the type; files may write it as `3.000000`.
    pub(super) fn whole<T: TryFrom<i64>>(&self) -> Result<T, Fault> {
        let number = self.number()?;
        whole(number)
            .ok_or_else(|| Fault::new(self.span(), FaultKind::OutOfRange(self.text.to_owned())))
    }

    /// A coordinate or parameter in units of 10 to the minus `decimals`.
    pub(super) fn fixed(&self, decimals: u32) -> Result<i32, Fault> {
        fixed(self.number()?, decimals)
            .ok_or_else(|| Fault::new(self.span(), FaultKind::OutOfRange(self.text.to_owned())))
    }
}

/// The lines of a text that are neither empty nor comments, each with its words.
pub(super) fn lines(text: &str) -> impl Iterator<Item = Vec<Word<'_>>> {
    let whole = text.split_inclusive('\n').scan(0, |at, line| {
        let start = *at;
        *at += line.len();
        Some((start, line))
    });
    whole
        .map(|(start, line)| words(line, start))
        .filter(|words| {
            let first = words.first();
            first.is_some_and(|word| !word.text.starts_with('#'))
        })
}

/// The words of a text that begins at `start`.
pub(super) fn words(text: &str, start: usize) -> Vec<Word<'_>> {
    let is_gap = |c: char| c.is_whitespace() || c == '\u{feff}';
    let base = text.as_ptr() as usize;
    text.split(is_gap)
        .filter(|word| !word.is_empty())
        .map(|word| Word {
            text: word,
            start: start + (word.as_ptr() as usize - base),
        })
        .collect()
}

pub(super) fn whole<T: TryFrom<i64>>(number: f64) -> Option<T> {
    let fits = number.is_finite() && number.fract() == 0.0 && number.abs() < 1e15;
    fits.then_some(number as i64)
        .and_then(|number| T::try_from(number).ok())
}

/// A number in units of 10 to the minus `decimals`, rounded; `None` if it does not fit. NaN becomes 0, which means
/// "here" in a place.
pub(super) fn fixed(number: f64, decimals: u32) -> Option<i32> {
    if number.is_nan() {
        return Some(0);
    }
    let scaled = (number * f64::from(10_i32.pow(decimals))).round();
    (scaled.abs() <= f64::from(i32::MAX)).then_some(scaled as i32)
}

/// A number in units of 10 to the minus `decimals`, exactly.
pub(super) fn unfixed(value: i32, decimals: u32) -> String {
    if decimals == 0 {
        return value.to_string();
    }
    let unit = 10_u32.pow(decimals);
    let sign = if value < 0 { "-" } else { "" };
    let size = value.unsigned_abs();
    let (whole, part) = (size / unit, size % unit);
    format!("{sign}{whole}.{part:0width$}", width = decimals as usize)
}

/// The number of decimals of x and y, which are degrees, metres of a local frame or plain
/// parameters.
pub(super) fn decimals(command: u16, frame: u8) -> u32 {
    const MISSION: u8 = 2;
    if !command::has_place(command) {
        0
    } else if HeightFrame::of(frame) == HeightFrame::Other && frame != MISSION {
        4
    } else {
        7
    }
}

/// The number of decimals of an item's x and y.
pub(super) fn decimals_of(item: &Item) -> u32 {
    decimals(item.command, item.frame)
}
