//! `standoff`: keep the right distance from a structure while near it.
//!
//! Only the time within `near` of the structure counts. A minimum amount of it is required, so that staying away does
//! not meet the objective.

use std::time::Duration;

use super::{
    DemandedTime, Demands, FINAL_AFTER, ObjectiveDetails, ObjectiveKind, ObjectiveScene,
    ObjectiveStanding, Tracker,
};
use crate::mission::TICK;
use crate::mission::craft::Craft;
use crate::mission::format::{
    BetterMeasure, FileTable, KindOf, LONGEST_S, ObjectiveTarget, number, rising, seconds,
};
use crate::mission::skill::Skill;
use crate::mission::world::World;
use crate::text;

#[derive(Debug, Clone)]
struct Standoff {
    hazard: usize,
    range_m: [f64; 2],
    near_m: f64,
    least: Duration,
    target: ObjectiveTarget,
    /// The time near the structure; then the time at the right distance, and too close.
    near: Duration,
    kept: Duration,
    too_near: Duration,
}

pub(super) const KIND: KindOf<Box<dyn ObjectiveKind>> = KindOf {
    name: "standoff",
    about: "met when vehicles have kept the right distance for the share `target` of their time near the line",
    read,
};

fn read(table: &mut FileTable<'_>) -> Option<Box<dyn ObjectiveKind>> {
    let hazard = table.need_hazard("hazard", "a power line");
    let range = rising("[nearest, farthest]", number(0.0, 1000.0, "m"));
    let range_m = table.need("range", range, "the right distance, at most `near`");
    let near_m = table.need(
        "near",
        number(1.0, 1000.0, "m"),
        "distance within which time counts",
    );
    let time = seconds(1.0, LONGEST_S);
    let least = table.need("time", time, "minimum time within `near`");
    let target = table.need_target([0.01, 1.0], BetterMeasure::Higher);
    let (range_m, near_m) = (range_m?, near_m?);
    if range_m[1] > near_m {
        table.fault_of("range", text!("fault-range"));
    }
    Some(Box::new(Standoff {
        hazard: hazard?,
        range_m,
        near_m,
        least: least?,
        target: target?,
        near: Duration::ZERO,
        kept: Duration::ZERO,
        too_near: Duration::ZERO,
    }))
}

impl ObjectiveKind for Standoff {
    fn skill(&self, _: usize) -> Option<Skill> {
        Some(Skill::K3)
    }

    fn demands(&self) -> Demands<'_> {
        Demands {
            times: vec![DemandedTime {
                key: "time",
                time: self.least,
            }],
            ..Demands::default()
        }
    }

    fn start(&self, _: &World) -> Box<dyn Tracker> {
        Box::new(self.clone())
    }
}

impl Standoff {
    fn count(&mut self, distance_m: f64) {
        let [nearest, farthest] = self.range_m;
        if distance_m > self.near_m {
            return;
        }
        self.near += TICK;
        if distance_m < nearest {
            self.too_near += TICK;
        } else if distance_m <= farthest {
            self.kept += TICK;
        }
    }

    /// Whether vehicles have been near the structure, and all of them have landed since, to stay.
    fn is_given_up(&self, scene: &ObjectiveScene<'_>) -> bool {
        let is_down = |craft: &Craft| {
            craft.lost || (craft.is_down() && (scene.over || craft.down_for >= FINAL_AFTER))
        };
        !self.near.is_zero() && scene.vehicles.iter().all(is_down)
    }

    /// The share of time at the right distance; if the required time is not reached, the missing
    /// part counts as spent at a wrong distance.
    fn share(&self) -> f64 {
        self.kept.as_secs_f64() / self.near.max(self.least).as_secs_f64()
    }
}

impl Tracker for Standoff {
    fn step(&mut self, scene: &ObjectiveScene<'_>) {
        let Some(structure) = scene.world.field(self.hazard) else {
            return;
        };
        for craft in scene.vehicles.iter().filter(|craft| craft.can_see()) {
            let distance_m = craft
                .at
                .and_then(|at| structure.distance_m(at, craft.height_m));
            if let Some(distance_m) = distance_m {
                self.count(distance_m);
            }
        }
    }

    fn standing(&self, scene: &ObjectiveScene<'_>) -> ObjectiveStanding {
        let share = self.share();
        ObjectiveStanding {
            fraction: self.target.credit(share),
            measure: share,
            met: share >= self.target.met_at,
            settled: self.near >= self.least || self.is_given_up(scene),
            landing: false,
        }
    }

    fn details(&self, _: &ObjectiveScene<'_>) -> ObjectiveDetails {
        let [nearest, farthest] = self.range_m.map(|metres| format!("{metres:.0}"));
        let percent = |share: f64| format!("{:.0}", share * 100.0);
        let seconds = |time: Duration| format!("{:.0}", time.as_secs_f64());
        ObjectiveDetails {
            product: None,
            result: text!(
                "standoff-result",
                share = percent(self.share()),
                near = seconds(self.near),
                close = self.too_near.as_secs_f64().round() as u64,
            ),
            outlook: None,
            target: text!(
                "standoff-target",
                share = percent(self.target.met_at),
                nearest = nearest.clone(),
                farthest = farthest.clone(),
            ),
            advice: text!(
                "standoff-advice",
                nearest = nearest,
                farthest = farthest,
                least = seconds(self.least),
                close = self.too_near.as_secs_f64().round() as u64,
            ),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn after(distances_m: &[(f64, u32)]) -> Standoff {
        let mut standoff = Standoff {
            hazard: 0,
            range_m: [5.0, 12.0],
            near_m: 30.0,
            least: Duration::from_secs(60),
            target: ObjectiveTarget {
                met_at: 0.9,
                partial_from: 0.5,
            },
            near: Duration::ZERO,
            kept: Duration::ZERO,
            too_near: Duration::ZERO,
        };
        for &(distance_m, seconds) in distances_m {
            (0..seconds * 10).for_each(|_| standoff.count(distance_m));
        }
        standoff
    }

    #[test]
    fn time_at_the_right_distance_counts_against_all_time_near_the_structure() {
        for (flown, share) in [
            (vec![(8.0, 90), (4.0, 10)], 0.9),
            (vec![(8.0, 90), (20.0, 30), (31.0, 500)], 0.75),
            (vec![(5.0, 30), (12.0, 30)], 1.0),
        ] {
            let standoff = after(&flown);
            assert!((standoff.share() - share).abs() < 1e-9, "{flown:?}");
        }
    }

    #[test]
    fn staying_away_is_no_way_to_keep_the_distance() {
        assert!(after(&[(100.0, 500)]).share() < 1e-9);
        assert!((after(&[(8.0, 15)]).share() - 0.25).abs() < 1e-9);
    }
}
