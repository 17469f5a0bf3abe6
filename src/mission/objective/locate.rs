//! `locate`: report the position of an object as accurately as it can be estimated from a distance.
//!
//! A report counts only if a sensor has measured something near its place, so that a guess earns nothing. A wrong report
//! that is not withdrawn costs half an object, so that a grid of reports earns nothing either.
//!
//! The accuracy of reports is revealed only after the flight; otherwise reporting would be a way to find out.

use std::collections::BTreeMap;

use super::{
    Demands, Equipment, ObjectiveDetails, ObjectiveKind, ObjectiveScene, ObjectiveStanding, Sought,
    Tracker, Trying, partial_credit,
};
use crate::commands::FindKind;
use crate::mission::Point;
use crate::mission::format::{FileTable, KindOf, number};
use crate::mission::ground_truth::Object;
use crate::mission::report::{Mark, distance_m};
use crate::mission::sensor::Probe;
use crate::mission::skill::Skill;
use crate::mission::world::World;
use crate::scoring::Product;
use crate::text;
use crate::text::Text;
use crate::vehicle::VehicleId;

#[derive(Debug, Clone)]
struct Locate {
    /// The hazard's index in the file.
    hazard: usize,
    within_m: f64,
    partial_to_m: f64,
}

/// The position of an object, and the kind to report it as.
#[derive(Debug, Clone, Copy)]
struct LocateTarget {
    at: Point,
    kind: FindKind,
}

#[derive(Debug, Clone)]
struct LocateTracker {
    plan: Locate,
    wanted: Vec<LocateTarget>,
    /// The places where each vehicle's sensors have measured something.
    measured: BTreeMap<VehicleId, Vec<Point>>,
}

struct LocateReports {
    /// The distance from each object to its nearest report; `None` without a report close enough to count.
    distances_m: Vec<Option<f64>>,
    /// The distance from each object to its nearest report of a measured place, however far.
    nearest_m: Vec<Option<f64>>,
    /// The number of other reports of measured places.
    wrong: usize,
    /// The number of reports of places near which no sensor has measured anything.
    blind: usize,
}

/// The minimum spacing of the places where something was measured, in metres; it keeps long flights cheap.
const MEASURED_APART_M: f64 = 1.0;

pub(super) const KIND: KindOf<Box<dyn ObjectiveKind>> = KindOf {
    name: "locate",
    about: "met when each source or leak has been reported near enough to its position, with at most one wrong report for each. A report counts only if a sensor has measured something within `partial_to` of its place, and each wrong report costs half an object; `unmark` withdraws a report. The result is shown after the flight. Its reports are a product",
    read,
};

fn read(table: &mut FileTable<'_>) -> Option<Box<dyn ObjectiveKind>> {
    let hazard = table.need_hazard("of", "hazard whose sources are to be located");
    let within = number(0.1, 10_000.0, "m");
    let within_m = table.need("within", within, "maximum distance of a correct report");
    let partial_to_m = table.need("partial_to", within, "distance at which points end");
    if partial_to_m <= within_m && partial_to_m.is_some() {
        table.fault_of("partial_to", text!("fault-partial-to"));
    }
    Some(Box::new(Locate {
        hazard: hazard?,
        within_m: within_m?,
        partial_to_m: partial_to_m?,
    }))
}

impl ObjectiveKind for Locate {
    fn skill(&self, _: usize) -> Option<Skill> {
        Some(Skill::K7)
    }

    fn trying(&self) -> Trying {
        Trying::Report
    }

    fn demands(&self) -> Demands<'_> {
        Demands::equipment(Equipment::Probe)
    }

    fn sought(&self) -> Option<Sought> {
        Some(Sought {
            hazard: self.hazard,
            within_m: self.within_m,
        })
    }

    fn start(&self, world: &World) -> Box<dyn Tracker> {
        let objects = world
            .field(self.hazard)
            .map_or(&[][..], |field| field.objects());
        let wanted = |object: &Object| {
            let kind = object.class.kind().filter(|_| object.present)?;
            Some(LocateTarget {
                at: object.at,
                kind,
            })
        };
        Box::new(LocateTracker {
            wanted: objects.iter().filter_map(wanted).collect(),
            plan: self.clone(),
            measured: BTreeMap::new(),
        })
    }
}

impl LocateTracker {
    fn reports<'a>(&'a self, marks: &'a [Mark]) -> impl Iterator<Item = &'a Mark> {
        marks.iter().filter(|mark| {
            let named = |wanted: &LocateTarget| mark.kind.is_none_or(|kind| kind == wanted.kind);
            self.wanted.iter().any(named)
        })
    }

    /// Whether a sensor has measured something near a report's place.
    fn is_measured(&self, mark: &Mark) -> bool {
        let mut places = self.measured.values().flatten();
        places.any(|&place| distance_m(place, mark.at) <= self.plan.partial_to_m)
    }

    fn found(&self, marks: &[Mark]) -> LocateReports {
        let (measured, blind): (Vec<&Mark>, Vec<&Mark>) =
            self.reports(marks).partition(|mark| self.is_measured(mark));
        let nearest = |wanted: &LocateTarget| {
            let distances = measured.iter().map(|mark| distance_m(mark.at, wanted.at));
            distances.min_by(f64::total_cmp)
        };
        let nearest_m: Vec<Option<f64>> = self.wanted.iter().map(nearest).collect();
        let counts = |nearest: &Option<f64>| nearest.filter(|it| *it <= self.plan.partial_to_m);
        let distances_m: Vec<Option<f64>> = nearest_m.iter().map(counts).collect();
        let right = distances_m.iter().flatten().count();
        LocateReports {
            wrong: measured.len().saturating_sub(right),
            blind: blind.len(),
            distances_m,
            nearest_m,
        }
    }

    /// The reports as they count now: none of them before the end of the flight.
    fn judged(&self, scene: &ObjectiveScene<'_>) -> LocateReports {
        self.found(if scene.over { scene.marks } else { &[] })
    }

    fn is_settled(&self, scene: &ObjectiveScene<'_>) -> bool {
        self.reports(scene.marks).count() >= self.wanted.len()
    }

    fn fraction(&self, found: &LocateReports) -> f64 {
        let (far, near) = (self.plan.partial_to_m, self.plan.within_m);
        let credit = |distance: &Option<f64>| {
            distance.map_or(0.0, |distance| partial_credit(distance, far, near))
        };
        let sum: f64 = found.distances_m.iter().map(credit).sum();
        let cost = 0.5 * found.all_wrong() as f64;
        (sum - cost).max(0.0) / self.wanted.len().max(1) as f64
    }

    fn words(found: &LocateReports) -> Text {
        let one = |distance: &Option<f64>| match distance {
            // Rounded up: a report that is too far away never looks close enough.
            Some(distance) => {
                let shown = (distance * 10.0).ceil() / 10.0;
                text!("locate-off", distance = format!("{shown:.1}"))
            }
            None => text!("locate-missed"),
        };
        let mut words: Vec<Text> = found.nearest_m.iter().map(one).collect();
        let wrong = found.wrong.saturating_sub(found.far_off());
        if wrong > 0 {
            words.push(text!("locate-wrong", count = wrong));
        }
        if found.blind > 0 {
            words.push(text!("locate-blind", count = found.blind));
        }
        Text::joined(", ", words)
    }
}

impl LocateReports {
    /// The number of objects whose nearest report is too far away to count.
    fn far_off(&self) -> usize {
        let pairs = self.nearest_m.iter().zip(&self.distances_m);
        pairs
            .filter(|(nearest, counted)| nearest.is_some() && counted.is_none())
            .count()
    }

    /// The number of all reports that are not right.
    fn all_wrong(&self) -> usize {
        self.wrong + self.blind
    }
}

impl Tracker for LocateTracker {
    fn step(&mut self, scene: &ObjectiveScene<'_>) {
        for craft in scene.vehicles {
            let has_signal = craft.can_see() && craft.probes.iter().any(Probe::has_signal);
            let Some(at) = craft.at.filter(|_| has_signal) else {
                continue;
            };
            let measured = self.measured.entry(craft.id).or_default();
            let last = measured.last();
            if last.is_none_or(|&last| distance_m(last, at) >= MEASURED_APART_M) {
                measured.push(at);
            }
        }
    }

    fn standing(&self, scene: &ObjectiveScene<'_>) -> ObjectiveStanding {
        let found = self.judged(scene);
        let near = |distance: &&Option<f64>| {
            distance.is_some_and(|distance| distance <= self.plan.within_m)
        };
        let (located, wanted) = (
            found.distances_m.iter().filter(near).count(),
            self.wanted.len(),
        );
        ObjectiveStanding {
            fraction: self.fraction(&found),
            measure: located as f64,
            met: located == wanted && wanted > 0 && found.all_wrong() <= wanted,
            settled: self.is_settled(scene),
            landing: false,
        }
    }

    fn details(&self, scene: &ObjectiveScene<'_>) -> ObjectiveDetails {
        let found = self.judged(scene);
        let wanted = self.wanted.len();
        let result = if scene.over {
            Self::words(&found)
        } else {
            let reports = self.reports(scene.marks).count();
            text!("locate-reports", count = reports)
        };
        ObjectiveDetails {
            product: Some(Product {
                quality: self.fraction(&found),
                words: result.clone(),
                advice: text!("locate-quality"),
                is_measured: false,
            }),
            result,
            outlook: None,
            target: text!(
                "locate-target",
                count = wanted,
                within = format!("{:.0}", self.plan.within_m)
            ),
            advice: text!("locate-advice"),
        }
    }
}
