//! `detect`: report objects at their positions, without false alarms.
//!
//! A report within the radius of an object of its kind that no other report has found is a hit; every other report is a
//! false alarm, and so is a guess: a report of a place where no detector has found anything. With precision `P` and recall `R`, `F = (1 + beta^2) P R / (beta^2 P + R)`: with a beta of 2, a missed
//! mine costs far more than a false alarm. Only the first reports up to a budget count as hits, so that reporting
//! everything earns nothing. A mission may raise the cost of wrong reports if a close look would have shown the error:
//! each then costs `false_cost` finds.
//!
//! Which reports are correct is revealed only after the flight; otherwise reporting would be a way to find out.

use std::collections::BTreeSet;

use super::{
    Demands, Equipment, FINAL_AFTER, ObjectiveDetails, ObjectiveKind, ObjectiveScene,
    ObjectiveStanding, Sought, Tracker, Trying,
};
use crate::mission::format::{BetterMeasure, FileTable, KindOf, ObjectiveTarget, number};
use crate::mission::ground_truth::Object;
use crate::mission::hazard::Field;
use crate::mission::report::{Mark, distance_m};
use crate::mission::skill::Skill;
use crate::mission::world::World;
use crate::scoring::Product;
use crate::text;
use crate::text::Text;

/// How many reports count, as a multiple of the number of objects.
const BUDGET: f64 = 3.0;
/// How far a report may be from the find that it is about, as a multiple of the radius of a correct report.
const CONTACT_RADII: f64 = 2.0;

#[derive(Debug, Clone)]
struct Detect {
    hazard: usize,
    beta: f64,
    radius_m: f64,
    budget: f64,
    false_cost: f64,
    target: ObjectiveTarget,
}

/// The tally of the reports.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct DetectTally {
    pub there: usize,
    pub found: usize,
    /// Reports of a place without an object of that kind, and blind reports.
    pub false_alarms: usize,
    /// Reports of a place where no detector has found anything.
    pub blind: usize,
    /// Reports of objects reported before, and correct reports beyond the budget.
    pub repeated: usize,
}

pub(super) const KIND: KindOf<Box<dyn ObjectiveKind>> = KindOf {
    name: "detect",
    about: "met when the F-measure of the reports, less the cost of wrong ones, reaches the target. A report counts only near a contact. It is scored at the end of the flight, which comes at the earliest 20 s after the last report. Its reports are a product",
    read,
};

fn read(table: &mut FileTable<'_>) -> Option<Box<dyn ObjectiveKind>> {
    let hazard = table.need_hazard("hazard", "hazard whose objects are to be reported");
    let beta = table.need(
        "beta",
        number(0.1, 10.0, ""),
        "2: a miss is much worse than a false alarm; 1: both are equally bad",
    );
    let radius = number(0.1, 1000.0, "m");
    let radius_m = table.need("radius", radius, "maximum distance of a correct report");
    let budget = table.or(
        "budget",
        number(1.0, 100.0, ""),
        BUDGET,
        "number of reports that count, for each object",
    );
    let false_cost = table.or(
        "false_cost",
        number(0.0, 10.0, ""),
        0.0,
        "cost of a false report, as a number of finds",
    );
    let target = table.need_target([0.01, 1.0], BetterMeasure::Higher);
    Some(Box::new(Detect {
        hazard: hazard?,
        beta: beta?,
        radius_m: radius_m?,
        budget,
        false_cost,
        target: target?,
    }))
}

impl ObjectiveKind for Detect {
    fn skill(&self, _: usize) -> Option<Skill> {
        Some(Skill::K7)
    }

    fn trying(&self) -> Trying {
        Trying::Report
    }

    fn demands(&self) -> Demands<'_> {
        Demands::equipment(Equipment::Detector)
    }

    fn sought(&self) -> Option<Sought> {
        Some(Sought {
            hazard: self.hazard,
            within_m: self.radius_m,
        })
    }

    fn start(&self, _: &World) -> Box<dyn Tracker> {
        Box::new(self.clone())
    }
}

impl Tracker for Detect {
    fn standing(&self, scene: &ObjectiveScene<'_>) -> ObjectiveStanding {
        let score = self.counted(scene).worth(self.beta, self.false_cost);
        ObjectiveStanding {
            fraction: self.target.credit(score),
            measure: score,
            met: score >= self.target.met_at,
            settled: scene.over || Self::is_final(scene),
            landing: false,
        }
    }

    fn details(&self, scene: &ObjectiveScene<'_>) -> ObjectiveDetails {
        let tally = self.counted(scene);
        let score = tally.worth(self.beta, self.false_cost);
        let [precision, recall] = tally.precision_and_recall();
        ObjectiveDetails {
            product: Some(Product {
                quality: score,
                words: text!(
                    "detect-quality",
                    recall = format!("{recall:.2}"),
                    precision = format!("{precision:.2}")
                ),
                advice: if tally.has_no_reports() {
                    text!("detect-quality-none")
                } else {
                    text!("detect-quality-advice")
                },
                is_measured: true,
            }),
            result: self.result(tally, score),
            outlook: Some(text!("detect-outlook", count = scene.marks.len())),
            target: self.target_text(),
            advice: tally.advice(),
        }
    }
}

impl Detect {
    fn result(&self, tally: DetectTally, score: f64) -> Text {
        let cost = tally.cost(self.false_cost);
        if cost > 0.0 {
            return text!(
                "detect-result-cost",
                beta = format!("{:.0}", self.beta),
                score = format!("{score:.2}"),
                measure = format!("{:.2}", tally.f_beta(self.beta)),
                cost = format!("{cost:.2}"),
                found = tally.found,
                there = tally.there,
                wrong = tally.false_alarms,
                repeated = tally.repeated,
            );
        }
        text!(
            "detect-result",
            beta = format!("{:.0}", self.beta),
            score = format!("{score:.2}"),
            found = tally.found,
            there = tally.there,
            wrong = tally.false_alarms,
            repeated = tally.repeated,
        )
    }

    fn target_text(&self) -> Text {
        let (beta, target) = (
            format!("{:.0}", self.beta),
            format!("{:.2}", self.target.met_at),
        );
        let radius = format!("{:.1}", self.radius_m);
        if self.false_cost > 0.0 {
            let cost = format!("{:.1}", self.false_cost);
            text!(
                "detect-target-cost",
                beta = beta,
                target = target,
                radius = radius,
                cost = cost
            )
        } else {
            text!(
                "detect-target",
                beta = beta,
                target = target,
                radius = radius
            )
        }
    }

    /// Whether all vehicles are down, and there has been no report for a while.
    fn is_final(scene: &ObjectiveScene<'_>) -> bool {
        let last = scene.marks.iter().map(|mark| mark.when).max();
        let quiet = last.is_some_and(|last| scene.now.saturating_sub(last) >= FINAL_AFTER);
        quiet
            && scene
                .vehicles
                .iter()
                .all(|craft| craft.lost || craft.is_down())
    }

    /// The reports as they count now: none of them before the end of the flight.
    fn counted(&self, scene: &ObjectiveScene<'_>) -> DetectTally {
        let objects = scene.world.field(self.hazard).map(Field::objects);
        let counted = if scene.over { scene.marks } else { &[] };
        let is_blind = |mark: &Mark| {
            let mut contacts = scene.contacts.iter();
            let near_m = CONTACT_RADII * self.radius_m;
            !contacts.any(|contact| distance_m(contact.at, mark.at) <= near_m)
        };
        self.tally(objects.unwrap_or_default(), counted, is_blind)
    }

    /// Matches each report, in order, with the nearest unreported object of its kind within the
    /// radius.
    fn tally(
        &self,
        objects: &[Object],
        marks: &[Mark],
        is_blind: impl Fn(&Mark) -> bool,
    ) -> DetectTally {
        let sought: Vec<&Object> = objects
            .iter()
            .filter(|object| object.class.kind().is_some())
            .collect();
        let mut found = BTreeSet::new();
        let (mut repeated, mut wrong, mut blind) = (0, 0, 0);
        let kinds: BTreeSet<_> = sought
            .iter()
            .filter_map(|object| object.class.kind())
            .collect();
        let about = |mark: &&Mark| mark.kind.is_none_or(|kind| kinds.contains(&kind));
        let budget = (self.budget * sought.len() as f64).floor() as usize;
        for (order, mark) in marks.iter().filter(about).enumerate() {
            if is_blind(mark) {
                blind += 1;
                continue;
            }
            let near = sought.iter().enumerate().filter_map(|(index, object)| {
                let same = mark.kind.is_none() || mark.kind == object.class.kind();
                let distance = distance_m(mark.at, object.at);
                (same && distance <= self.radius_m).then_some((index, distance))
            });
            let near: Vec<(usize, f64)> = near.collect();
            let open = near.iter().filter(|(index, _)| !found.contains(index));
            match open.min_by(|a, b| a.1.total_cmp(&b.1)) {
                Some(&(index, _)) if order < budget => {
                    found.insert(index);
                }
                _ if near.is_empty() => wrong += 1,
                _ => repeated += 1,
            }
        }
        DetectTally {
            there: sought.len(),
            found: found.len(),
            false_alarms: wrong + blind,
            blind,
            repeated,
        }
    }
}

impl DetectTally {
    /// The share of reports that are correct, and the share of objects reported.
    fn precision_and_recall(self) -> [f64; 2] {
        let share = |of: usize| match of {
            0 => 0.0,
            of => self.found as f64 / of as f64,
        };
        [
            share(self.found + self.false_alarms + self.repeated),
            share(self.there),
        ]
    }

    /// `(1 + beta^2) P R / (beta^2 P + R)`.
    fn f_beta(self, beta: f64) -> f64 {
        let [precision, recall] = self.precision_and_recall();
        let square = beta * beta;
        let below = square * precision + recall;
        if below > 0.0 {
            (1.0 + square) * precision * recall / below
        } else {
            0.0
        }
    }

    /// The cost of the false alarms, as a share of the objects: each costs as much as `false_cost`
    /// finds.
    fn cost(self, false_cost: f64) -> f64 {
        false_cost * self.false_alarms as f64 / self.there.max(1) as f64
    }

    /// The F-measure, less the cost of the wrong reports.
    fn worth(self, beta: f64, false_cost: f64) -> f64 {
        (self.f_beta(beta) - self.cost(false_cost)).max(0.0)
    }

    fn has_no_reports(self) -> bool {
        self.found + self.false_alarms + self.repeated + self.blind == 0
    }

    fn advice(self) -> Text {
        let missed = self.there.saturating_sub(self.found);
        let wrong = self.false_alarms + self.repeated;
        if self.has_no_reports() {
            text!("detect-advice-none")
        } else if self.blind > 0 {
            text!("detect-advice-blind", count = self.blind)
        } else if missed > 0 {
            text!("detect-advice-missed", missed = missed, wrong = wrong)
        } else {
            text!("detect-advice-wrong", wrong = wrong)
        }
    }
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::*;
    use crate::commands::FindKind;
    use crate::mission::Point;
    use crate::mission::ground_truth::ObjectClass;

    const DETECT: Detect = Detect {
        hazard: 0,
        beta: 2.0,
        radius_m: 1.0,
        budget: 3.0,
        false_cost: 0.0,
        target: ObjectiveTarget {
            met_at: 0.8,
            partial_from: 0.3,
        },
    };

    fn mines() -> Vec<Object> {
        let mut objects: Vec<Object> = (0..4)
            .map(|index| Object::new(ObjectClass::MetalMine, [f64::from(index) * 10.0, 0.0]))
            .collect();
        objects.push(Object::new(ObjectClass::Clutter, [5.0, 5.0]));
        objects
    }

    fn mark(at: Point, kind: Option<FindKind>) -> Mark {
        Mark {
            at,
            kind,
            by: 1,
            when: Duration::ZERO,
        }
    }

    fn tally(marks: &[(Point, Option<FindKind>)]) -> DetectTally {
        let marks: Vec<Mark> = marks.iter().map(|&(at, kind)| mark(at, kind)).collect();
        DETECT.tally(&mines(), &marks, |_| false)
    }

    #[test]
    fn reports_are_hits_false_alarms_or_repetitions() {
        let mine = Some(FindKind::Mine);
        let counted = tally(&[
            ([0.0, 0.9], mine),
            ([0.0, 0.1], None),
            ([10.0, 1.1], mine),
            ([5.0, 5.0], mine),
            ([20.0, 0.0], Some(FindKind::Person)),
            ([30.0, 0.0], None),
        ]);
        let expected = DetectTally {
            there: 4,
            found: 2,
            false_alarms: 2,
            blind: 0,
            repeated: 1,
        };
        assert_eq!(counted, expected);
    }

    #[test]
    fn the_score_is_the_f_measure() {
        for (found, wrong, beta, score) in [
            // Precision 1, recall 1/2; precision 1/2, recall 1/2; precision 4/5, recall 1.
            (2, 0, 1.0, 2.0 / 3.0),
            (2, 0, 2.0, 5.0 * 0.5 / 4.5),
            (2, 2, 2.0, 0.5),
            (4, 1, 2.0, 5.0 * 0.8 / 4.2),
            (0, 3, 2.0, 0.0),
            (4, 0, 2.0, 1.0),
        ] {
            let tally = DetectTally {
                there: 4,
                found,
                false_alarms: wrong,
                blind: 0,
                repeated: 0,
            };
            assert!(
                (tally.f_beta(beta) - score).abs() < 1e-12,
                "{found} {wrong}"
            );
        }
    }

    #[test]
    fn a_wrong_report_costs_more_than_a_right_one_brings_where_the_mission_says_so() {
        let tally = |found, false_alarms| DetectTally {
            there: 4,
            found,
            false_alarms,
            blind: 0,
            repeated: 0,
        };
        let worth = |found, wrong| tally(found, wrong).worth(2.0, 1.5);
        assert!(worth(4, 0) > 0.99);
        assert!(worth(3, 0) > worth(4, 1), "{} {}", worth(3, 0), worth(4, 1));
        assert!(worth(3, 5).abs() < 1e-12);
    }

    #[test]
    fn reporting_everything_is_worth_little() {
        let everywhere: Vec<(Point, Option<FindKind>)> = (0..40)
            .rev()
            .map(|step| ([f64::from(step), 0.0], None))
            .collect();
        let counted = tally(&everywhere);
        // The reports on the way from 39 m down use up the budget of twelve at 28 m.
        assert_eq!(counted.found, 1);
        assert!(counted.f_beta(2.0) < 0.15);
    }
}
