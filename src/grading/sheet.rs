//! The grades that one grader gives a flight.

use std::collections::BTreeMap;
use std::time::Duration;

use serde::{Deserialize, Serialize};

use super::{Rubric, RubricElement};

/// A grade on the scale of five steps: 1 very poor, 2 poor, 3 acceptable, 4 good, 5 very good.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(try_from = "u8", into = "u8")]
pub struct Mark(u8);

impl Mark {
    /// Whether the mark needs a reason: a text or a bookmark.
    pub fn is_extreme(self) -> bool {
        matches!(self.0, 1 | 5)
    }

    /// The number, 1 to 5.
    pub fn number(self) -> u8 {
        self.0
    }
}

impl TryFrom<u8> for Mark {
    type Error = &'static str;

    fn try_from(number: u8) -> Result<Self, Self::Error> {
        if (1..=5).contains(&number) {
            Ok(Self(number))
        } else {
            Err("a mark is a number from 1 to 5")
        }
    }
}

impl From<Mark> for u8 {
    fn from(mark: Mark) -> Self {
        mark.0
    }
}

/// The grade of one element.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Grade {
    /// The mark; `None` if the element was not observed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mark: Option<Mark>,
    /// The grader's reason in words; may be empty.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub text: String,
    /// The bookmarks to which the grade refers: their times in the record, in milliseconds.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub bookmarks_ms: Vec<u64>,
}

impl Grade {
    /// Refers to a bookmark at this time in the record, or no longer refers to it.
    pub fn cite(&mut self, recorded: Duration) {
        let at_ms = milliseconds(recorded);
        if self.cites(recorded) {
            self.bookmarks_ms.retain(|it| *it != at_ms);
        } else {
            self.bookmarks_ms.push(at_ms);
            self.bookmarks_ms.sort_unstable();
        }
    }

    /// Whether it refers to a bookmark at this time in the record.
    pub fn cites(&self, recorded: Duration) -> bool {
        self.bookmarks_ms.contains(&milliseconds(recorded))
    }

    /// Whether the mark needs a reason that it does not have.
    pub fn lacks_reason(&self) -> bool {
        let is_extreme = self.mark.is_some_and(Mark::is_extreme);
        is_extreme && self.text.trim().is_empty() && self.bookmarks_ms.is_empty()
    }

    /// The mark that counts: one without a required reason does not.
    pub fn counted_mark(&self) -> Option<Mark> {
        self.mark.filter(|_| !self.lacks_reason())
    }
}

/// The grades that a grader gives a flight.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct GradeSheet {
    /// The name of the rubric.
    pub rubric: String,
    /// The name of the grader.
    pub grader: String,
    /// The grades by element; an element without a grade is open.
    #[serde(default)]
    pub grades: BTreeMap<String, Grade>,
}

impl GradeSheet {
    /// A sheet on which all elements are open.
    pub fn new(rubric: &Rubric, grader: &str) -> Self {
        Self {
            rubric: rubric.name.clone(),
            grader: grader.to_owned(),
            grades: BTreeMap::new(),
        }
    }

    /// Sets the mark of an element; `None` if it was not observed.
    pub fn rate(&mut self, element: &str, mark: Option<Mark>) {
        self.grades.entry(element.to_owned()).or_default().mark = mark;
    }

    /// Removes the grade of an element, with its text and its bookmarks.
    pub fn clear(&mut self, element: &str) {
        self.grades.remove(element);
    }

    /// The grade of an element that has one.
    pub fn grade_mut(&mut self, element: &str) -> Option<&mut Grade> {
        self.grades.get_mut(element)
    }

    /// The elements that are open: without a grade, or without a required reason.
    pub fn open<'a>(&'a self, rubric: &'a Rubric) -> impl Iterator<Item = &'a RubricElement> {
        let is_open = |element: &&RubricElement| {
            let grade = self.grades.get(&element.id);
            grade.is_none_or(Grade::lacks_reason)
        };
        rubric.elements().filter(is_open)
    }

    /// The mean of the marks of these elements that count; `None` without any.
    pub fn mean<'a>(&self, elements: impl IntoIterator<Item = &'a RubricElement>) -> Option<f64> {
        let marks: Vec<f64> = elements
            .into_iter()
            .filter_map(|element| self.grades.get(&element.id)?.counted_mark())
            .map(|mark| f64::from(mark.number()))
            .collect();
        (!marks.is_empty()).then(|| marks.iter().sum::<f64>() / marks.len() as f64)
    }
}

fn milliseconds(time: Duration) -> u64 {
    u64::try_from(time.as_millis()).unwrap_or(u64::MAX)
}

#[cfg(test)]
mod tests;
