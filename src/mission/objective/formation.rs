//! `formation`: the centre of all vehicles passes through gates while each keeps its distance from its nearest
//! neighbour.

use super::route::GateRoute;
use super::{Demands, ObjectiveDetails, ObjectiveKind, ObjectiveScene, ObjectiveStanding, Tracker};
use crate::geo::maths;
use crate::mission::craft::Craft;
use crate::mission::format::{BetterMeasure, FileTable, KindOf, ObjectiveTarget, number, rising};
use crate::mission::skill::Skill;
use crate::mission::world::World;
use crate::mission::{Point, TICK};
use crate::text;

#[derive(Debug, Clone)]
struct FormationObjective {
    id: String,
    route: GateRoute,
    keep: Keep,
}

#[derive(Debug, Clone)]
struct Keep {
    spacing_m: [f64; 2],
    target: ObjectiveTarget,
}

#[derive(Debug, Clone)]
struct FormationTracker {
    gates: Vec<[f64; 3]>,
    radius_m: f64,
    keep: Keep,
    passed: usize,
    /// The time from the first gate to the last, and the part of it in formation.
    under_way_s: f64,
    kept_s: f64,
}

pub(super) const KIND: KindOf<Box<dyn ObjectiveKind>> = KindOf {
    name: "formation",
    about: "met when the centre of all vehicles has passed the gates in order, and each vehicle has kept its distance to the nearest other for the share `target` of the time",
    read,
};

fn read(table: &mut FileTable<'_>) -> Option<Box<dyn ObjectiveKind>> {
    let route = GateRoute::need(table);
    let spacing_m = table.need(
        "spacing",
        rising("[least, most]", number(0.5, 1000.0, "m")),
        "distance to the nearest other vehicle",
    );
    let target = table.need_target([0.01, 1.0], BetterMeasure::Higher);
    if table.draft().pads.len() == 1 {
        table.fault(text!("fault-formation"));
    }
    Some(Box::new(FormationObjective {
        id: table.own_id(),
        route: route?,
        keep: Keep {
            spacing_m: spacing_m?,
            target: target?,
        },
    }))
}

impl ObjectiveKind for FormationObjective {
    fn skill(&self, vehicles: usize) -> Option<Skill> {
        (vehicles > 1).then_some(Skill::K10)
    }

    fn demands(&self) -> Demands<'_> {
        Demands {
            route: Some(&self.route),
            ..Demands::default()
        }
    }

    fn start(&self, world: &World) -> Box<dyn Tracker> {
        Box::new(FormationTracker {
            gates: self.route.drawn(world, &self.id),
            radius_m: self.route.radius_m,
            keep: self.keep.clone(),
            passed: 0,
            under_way_s: 0.0,
            kept_s: 0.0,
        })
    }

    fn place_names(&self) -> Vec<String> {
        self.route.names()
    }
}

fn position(craft: &Craft) -> Option<[f64; 3]> {
    let [east_m, north_m] = craft.at.filter(|_| craft.under_way && !craft.lost)?;
    Some([east_m, north_m, craft.height_m])
}

/// The distance over ground: vehicles that fly one above the other are in no formation.
fn distance_m(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    maths::hypot(a[0] - b[0], a[1] - b[1])
}

impl FormationTracker {
    /// Whether every vehicle's nearest neighbour is at the right distance.
    fn is_kept(&self, all: &[[f64; 3]]) -> bool {
        let [low, high] = self.keep.spacing_m;
        all.iter().enumerate().all(|(own, at)| {
            let others = all.iter().enumerate().filter(|(other, _)| *other != own);
            let nearest = others.map(|(_, other)| distance_m(at, other));
            let nearest_m = nearest.min_by(f64::total_cmp).unwrap_or(f64::INFINITY);
            (low..=high).contains(&nearest_m)
        })
    }

    fn share(&self) -> f64 {
        if self.gates.len() == 1 && self.passed == 1 {
            // With a single gate there is no path on which to keep the formation.
            1.0
        } else if self.under_way_s > 0.0 {
            self.kept_s / self.under_way_s
        } else {
            0.0
        }
    }
}

impl Tracker for FormationTracker {
    fn step(&mut self, scene: &ObjectiveScene<'_>) {
        let all: Vec<[f64; 3]> = scene.vehicles.iter().filter_map(position).collect();
        let whole = all.len() == scene.vehicles.len() && all.len() > 1;
        let Some(gate) = self.gates.get(self.passed) else {
            return;
        };
        if self.passed > 0 {
            let dt_s = TICK.as_secs_f64();
            self.under_way_s += dt_s;
            self.kept_s += if whole && self.is_kept(&all) {
                dt_s
            } else {
                0.0
            };
        }
        let middle = [0, 1, 2]
            .map(|axis| all.iter().map(|at| at[axis]).sum::<f64>() / all.len().max(1) as f64);
        if whole && distance_m(&middle, gate) <= self.radius_m {
            self.passed += 1;
        }
    }

    fn standing(&self, _: &ObjectiveScene<'_>) -> ObjectiveStanding {
        let (share, count) = (self.share(), self.gates.len());
        let through = self.passed == count;
        let kept = self.keep.target.credit(share);
        ObjectiveStanding {
            fraction: kept * self.passed as f64 / count.max(1) as f64,
            measure: share,
            met: through && share >= self.keep.target.met_at,
            settled: through,
            landing: false,
        }
    }

    fn is_out_of_reach(&self, scene: &ObjectiveScene<'_>) -> bool {
        let standing = self.standing(scene);
        standing.settled && !standing.met
    }

    fn details(&self, _: &ObjectiveScene<'_>) -> ObjectiveDetails {
        let count = self.gates.len();
        let [low, high] = self.keep.spacing_m;
        let percent = |share: f64| format!("{:.0}", (share * 100.0).floor());
        ObjectiveDetails {
            product: None,
            result: text!(
                "mission-formation-of",
                percent = percent(self.share()),
                passed = self.passed,
                count = count
            ),
            outlook: None,
            target: text!(
                "mission-formation",
                percent = percent(self.keep.target.met_at),
                count = count
            ),
            advice: text!(
                "mission-formation-advice",
                low = format!("{low:.0}"),
                high = format!("{high:.0}"),
                gate = GateRoute::name(self.passed.min(count.saturating_sub(1)))
            ),
        }
    }

    fn places(&self) -> Vec<(String, Point)> {
        let place =
            |(index, gate): (usize, &[f64; 3])| (GateRoute::name(index), [gate[0], gate[1]]);
        let next = self
            .gates
            .get(self.passed)
            .map(|gate| (super::NEXT_PLACE.to_owned(), [gate[0], gate[1]]));
        self.gates
            .iter()
            .enumerate()
            .map(place)
            .chain(next)
            .collect()
    }
}
