//! The truth that the debrief reveals, and that an instructor sees before.

use super::Flight;
use crate::mission::Point;
use crate::mission::ground_truth::{ObjectClass, TruthShape};
use crate::mission::objective::{NEXT_PLACE, Sought, Tracker};
use crate::mission::report::{Mark, distance_m};
use crate::mission::survey::Survey;
use crate::mission::zone::ZoneKind;
use crate::scoring::{
    MarkReport, ObjectKind, ObjectReport, SquareReport, TrackReport, TruthReport,
};
use crate::text::rounded;

/// A report of an object that the mission does not require counts as correct within this distance of the object.
const UNASKED_WITHIN_M: f64 = 15.0;
/// The strength of burnt ground, beside 1 for burning ground.
const BURNT: f64 = 0.4;
impl Flight {
    /// The truth at the current mission time. Before the debrief, only an instructor may see it.
    pub fn truth_report(&self) -> TruthReport {
        let mut truth = TruthReport {
            pads: self
                .mission
                .seats
                .pads
                .iter()
                .map(|&pad| tenths(pad))
                .collect(),
            fences: self.fences(),
            gates: self.gates(),
            wires: self.wires(),
            ..TruthReport::default()
        };
        let mut found = vec![false; self.search.marks().len()];
        for (hazard, piece) in self.world.truth() {
            let sought = self.sought(hazard);
            match piece.shape {
                TruthShape::Square(side_m, strength) => truth.squares.push(SquareReport {
                    at: tenths(piece.at),
                    side_m: rounded(side_m, 1),
                    strength: rounded(strength.clamp(0.0, 1.0), 2),
                    is_fire: false,
                }),
                TruthShape::Fire(side_m, burns) => truth.squares.push(SquareReport {
                    at: tenths(piece.at),
                    side_m: rounded(side_m, 1),
                    strength: if burns { 1.0 } else { BURNT },
                    is_fire: true,
                }),
                TruthShape::Object(class, present) => {
                    let hits: Vec<usize> = self
                        .search
                        .marks()
                        .iter()
                        .enumerate()
                        .filter(|(_, mark)| is_meant(mark, class, piece.at, sought))
                        .map(|(index, _)| index)
                        .collect();
                    for &index in &hits {
                        found[index] = true;
                    }
                    truth.objects.push(ObjectReport {
                        at: tenths(piece.at),
                        kind: class.kind().map_or(ObjectKind::Decoy, ObjectKind::Find),
                        present,
                        found: !hits.is_empty(),
                        sought: sought.is_some(),
                    });
                }
            }
        }
        let marks = self.search.marks().iter().zip(found);
        truth.marks = marks
            .map(|(mark, right)| mark_report(mark, right))
            .collect();
        truth.gaps = self.gaps();
        truth.tracks = self.track_reports();
        truth
    }

    fn fences(&self) -> Vec<Vec<Point>> {
        let zones = self.mission.site.zones.iter();
        let fences = zones.filter(|zone| matches!(zone.kind, ZoneKind::Geofence { .. }));
        let corners = fences.map(|zone| zone.shape.corners());
        corners
            .map(|corners| corners.into_iter().map(tenths).collect())
            .collect()
    }

    fn gates(&self) -> Vec<Point> {
        let places = self.goals.trackers().flat_map(Tracker::places);
        let gates = places.filter(|(name, _)| name != NEXT_PLACE);
        gates.map(|(_, at)| tenths(at)).collect()
    }

    fn wires(&self) -> Vec<Vec<Point>> {
        let hazards = self.mission.site.hazards.iter();
        let lines = hazards.map(|hazard| hazard.pylons());
        let wires = lines.filter(|pylons| !pylons.is_empty());
        wires
            .map(|pylons| pylons.iter().copied().map(tenths).collect())
            .collect()
    }

    fn track_reports(&self) -> Vec<TrackReport> {
        let crafts = self.crafts.iter().zip(self.tracks.all());
        let flown = crafts.filter(|(_, track)| !track.is_empty());
        let report = |(craft, track): (&super::Craft, &Vec<Point>)| TrackReport {
            vehicle: craft.id,
            points: track.iter().map(|&at| tenths(at)).collect(),
        };
        flown.map(report).collect()
    }

    /// Of the reports that the objectives require for a hazard, the one with the greatest permitted
    /// distance from the object; `None` if they require none.
    fn sought(&self, hazard: usize) -> Option<Sought> {
        let sought = self
            .mission
            .objectives
            .iter()
            .filter_map(|objective| objective.kind.sought());
        let of_hazard = sought.filter(|sought| sought.hazard == hazard);
        of_hazard.max_by(|a, b| a.within_m.total_cmp(&b.within_m))
    }

    /// The ground not covered, and the cells not sampled.
    fn gaps(&self) -> Vec<SquareReport> {
        let gap = |at: Point, side_m: f64| SquareReport {
            at: tenths(at),
            side_m: rounded(side_m, 1),
            strength: 0.0,
            is_fire: false,
        };
        let of = |survey: &Survey| {
            let cells = survey.plan.cells.iter().enumerate();
            let open = cells.filter(|(index, _)| !survey.is_sampled(*index));
            let side_m = survey.plan.side_m;
            let open = open.map(|(_, cell)| gap(cell.centre, side_m));
            open.collect::<Vec<_>>()
        };
        let cells = self.surveys.all().iter().flat_map(of);
        let unseen = self.goals.trackers().flat_map(Tracker::gaps);
        cells
            .chain(unseen.map(|it| gap(it.at, it.side_m)))
            .collect()
    }
}

/// Whether a report is about this object: close enough, and of its kind if the report gives one.
fn is_meant(mark: &Mark, class: ObjectClass, at: Point, sought: Option<Sought>) -> bool {
    let within_m = sought.map_or(UNASKED_WITHIN_M, |sought| sought.within_m);
    let same = class
        .kind()
        .is_some_and(|kind| mark.kind.is_none_or(|said| said == kind));
    same && distance_m(mark.at, at) <= within_m
}

fn mark_report(mark: &Mark, right: bool) -> MarkReport {
    MarkReport {
        at: tenths(mark.at),
        kind: mark.kind,
        right,
    }
}

fn tenths(at: Point) -> Point {
    at.map(|axis| rounded(axis, 1))
}
