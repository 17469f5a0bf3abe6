//! How far two graders of the same flights agree.

use std::collections::BTreeMap;

use serde::Serialize;

use super::{GradeSheet, Mark};
use crate::text::rounded;

/// The difference of two marks from which both graders should talk about it.
const FAR_APART: u8 = 2;

/// An element of a flight that was graded.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Serialize)]
pub struct GradedElement {
    /// The trainee's user name.
    pub user: String,
    /// The name of the record.
    pub record: String,
    /// The id of the element.
    pub element: String,
}

/// The marks of a grader that count; `None` for an element that was not observed.
pub type GraderMarks = BTreeMap<GradedElement, Option<Mark>>;

/// How far two graders agree, over the elements that both have graded in the same flights.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct Agreement {
    /// The number of elements to which both have given a mark.
    pub marks: usize,
    /// How many of these marks are equal.
    pub equal: usize,
    /// How many differ by at most one step.
    pub within_one: usize,
    /// The second grader's mean minus that of the first; 0 without marks.
    pub mean_difference: f64,
    /// Cohen's kappa with quadratic weights: 1 for full agreement, 0 for that of chance; `None` without marks, or if
    /// both graders give one and the same mark.
    pub kappa: Option<f64>,
    /// The number of elements that only one of them has observed.
    pub observed_by_one: usize,
    /// Marks that are two steps apart or more, the farthest first.
    pub far_apart: Vec<Disagreement>,
}

/// Two marks for the same element.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Disagreement {
    #[serde(flatten)]
    pub graded: GradedElement,
    /// The mark of the first grader.
    pub first: Mark,
    /// The mark of the second grader.
    pub second: Mark,
}

/// The marks on a sheet for a flight; those that lack a required reason are left out.
pub fn marks_of<'a>(
    user: &'a str,
    record: &'a str,
    sheet: &'a GradeSheet,
) -> impl Iterator<Item = (GradedElement, Option<Mark>)> + 'a {
    let counted = sheet
        .grades
        .iter()
        .filter(|(_, grade)| !grade.lacks_reason());
    counted.map(move |(element, grade)| {
        let graded = GradedElement {
            user: user.to_owned(),
            record: record.to_owned(),
            element: element.clone(),
        };
        (graded, grade.mark)
    })
}

/// Compares the marks of two graders for the same elements of the same flights.
pub fn agreement(first: &GraderMarks, second: &GraderMarks) -> Agreement {
    let both = first
        .iter()
        .filter_map(|(graded, one)| Some((graded, *one, *second.get(graded)?)));
    let mut pairs = Vec::new();
    let mut found = Agreement::default();
    for (graded, one, other) in both {
        match (one, other) {
            (Some(one), Some(other)) => pairs.push(Disagreement {
                graded: graded.clone(),
                first: one,
                second: other,
            }),
            (None, None) => {}
            (Some(_), None) | (None, Some(_)) => found.observed_by_one += 1,
        }
    }
    found.marks = pairs.len();
    found.equal = pairs.iter().filter(|it| it.steps() == 0).count();
    found.within_one = pairs.iter().filter(|it| it.steps() <= 1).count();
    let means =
        [Disagreement::first_number, Disagreement::second_number].map(|it| mean(&pairs, it));
    found.mean_difference = rounded(means[1] - means[0], 2);
    found.kappa = kappa(&pairs).map(|kappa| rounded(kappa, 2));
    pairs.retain(|it| it.steps() >= FAR_APART);
    pairs.sort_by_key(|it| std::cmp::Reverse(it.steps()));
    found.far_apart = pairs;
    found
}

impl Disagreement {
    /// How many steps the marks are apart.
    fn steps(&self) -> u8 {
        self.first.number().abs_diff(self.second.number())
    }

    fn first_number(&self) -> f64 {
        f64::from(self.first.number())
    }

    fn second_number(&self) -> f64 {
        f64::from(self.second.number())
    }
}

fn mean(pairs: &[Disagreement], number: impl Fn(&Disagreement) -> f64) -> f64 {
    if pairs.is_empty() {
        return 0.0;
    }
    pairs.iter().map(number).sum::<f64>() / pairs.len() as f64
}

/// Cohen's kappa with quadratic weights (J. Cohen, "Weighted kappa", Psychological Bulletin 70, 1968): one minus the
/// mean squared difference, as a share of that between all marks of one grader and all of the other.
fn kappa(pairs: &[Disagreement]) -> Option<f64> {
    let square = |steps: u8| f64::from(u16::from(steps) * u16::from(steps));
    let seen = mean(pairs, |it| square(it.steps()));
    let by_chance = mean(pairs, |one| {
        mean(pairs, |other| {
            square(one.first.number().abs_diff(other.second.number()))
        })
    });
    (by_chance > 0.0).then(|| 1.0 - seen / by_chance)
}

#[cfg(test)]
mod tests;
