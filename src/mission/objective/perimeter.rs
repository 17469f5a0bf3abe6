//! `perimeter`: map the ground that burns or has burnt, at given times.
//!
//! The view of a thermal camera is mapped automatically: ground in view as it is now, all other ground as last seen. At
//! each of the given times, the map is compared with the truth: the area burnt in both, divided by the area burnt in
//! either (intersection over union).

use std::time::Duration;

use super::{
    GroundPatch, ObjectiveDetails, ObjectiveKind, ObjectiveScene, ObjectiveStanding, Tracker,
};
use crate::mission::format::{
    FileTable, KindOf, LONGEST_S, ObjectiveTarget, list, number, seconds,
};
use crate::mission::hazard::{Fire, FireGrid};
use crate::mission::report::distance_m;
use crate::mission::sensor::Sensor;
use crate::mission::skill::Skill;
use crate::mission::world::World;
use crate::scoring::Product;
use crate::text;
use crate::text::Text;

#[derive(Debug, Clone)]
struct Perimeter {
    /// The hazard's index in the file.
    hazard: usize,
    sensor: &'static Sensor,
    times: Vec<Duration>,
    target: ObjectiveTarget,
}

#[derive(Debug, Clone)]
struct PerimeterTracker {
    plan: Perimeter,
    /// Whether each cell had burnt when last seen.
    seen: Vec<bool>,
    /// The agreement of the map at the times so far, 0 to 1.
    fits: Vec<f64>,
}

pub(super) const KIND: KindOf<Box<dyn ObjectiveKind>> = KindOf {
    name: "perimeter",
    about: "met when the map of burnt ground, drawn from what the camera saw, matches the truth at the given times: intersection over union, averaged over all times. Its map is a product",
    read,
};

fn read(table: &mut FileTable<'_>) -> Option<Box<dyn ObjectiveKind>> {
    let hazard = table.need_hazard("of", "a fire");
    let sensor = table.need_sensor("sensor", "a camera");
    let times = table.need(
        "times",
        list(seconds(1.0, LONGEST_S), 1, 1000),
        "mission times, in ascending order",
    );
    let share = number(0.01, 1.0, "");
    let met_at = table.need("target", share, "result that earns all points");
    let partial_from = table.or(
        "partial_from",
        number(0.0, 1.0, ""),
        0.0,
        "result at which points begin",
    );
    if met_at.is_some_and(|met_at| partial_from >= met_at) {
        table.fault_of("target", text!("fault-target-from-zero"));
    }
    let times = times?;
    if !times.is_sorted_by(|a, b| a < b) {
        table.fault_of("times", text!("fault-times"));
    }
    let sensor = sensor?;
    if sensor.swath_m(1.0).is_none() {
        table.fault_of("sensor", text!("fault-camera"));
    }
    Some(Box::new(Perimeter {
        hazard: hazard?,
        sensor,
        times,
        target: ObjectiveTarget {
            met_at: met_at?,
            partial_from,
        },
    }))
}

impl ObjectiveKind for Perimeter {
    fn skill(&self, _: usize) -> Option<Skill> {
        Some(Skill::K6)
    }

    fn start(&self, world: &World) -> Box<dyn Tracker> {
        let cells = self.grid(world).map_or(0, FireGrid::len);
        Box::new(PerimeterTracker {
            plan: self.clone(),
            seen: vec![false; cells],
            fits: Vec::new(),
        })
    }
}

impl Perimeter {
    fn grid<'a>(&self, world: &'a World) -> Option<&'a FireGrid> {
        world.field(self.hazard)?.fire().map(Fire::grid)
    }
}

impl PerimeterTracker {
    /// Maps the ground below the vehicles.
    fn look(&mut self, scene: &ObjectiveScene<'_>, grid: &FireGrid) {
        let flying = scene.vehicles.iter();
        for craft in flying.filter(|craft| craft.heard && craft.under_way && !craft.lost) {
            let swath_m = self.plan.sensor.swath_m(craft.height_m);
            let (Some(at), Some(swath_m)) = (craft.at, swath_m) else {
                continue;
            };
            let reach_m = swath_m / 2.0;
            for index in grid.around(at, reach_m) {
                if distance_m(grid.centre(index), at) <= reach_m {
                    self.seen[index] = grid.has_burnt(index);
                }
            }
        }
    }

    fn fit(&self, grid: &FireGrid) -> f64 {
        let (mut both, mut either) = (0_u32, 0_u32);
        for (index, &seen) in self.seen.iter().enumerate() {
            let burnt = grid.has_burnt(index);
            both += u32::from(seen && burnt);
            either += u32::from(seen || burnt);
        }
        if either == 0 {
            return 1.0;
        }
        f64::from(both) / f64::from(either)
    }

    fn sum(&self) -> f64 {
        // An empty sum is negative zero, which would be printed as `-0`.
        0.0 + self.fits.iter().sum::<f64>()
    }

    fn words(&self) -> Text {
        let fits = self.fits.iter().map(|fit| format!("{fit:.2}"));
        let words: Vec<String> = fits.collect();
        if words.is_empty() {
            text!("perimeter-none")
        } else {
            words.join(" ").into()
        }
    }

    /// The time left until the next comparison, as text; `None` after the last one.
    fn next(&self, now: Duration) -> Option<Text> {
        let next = self.plan.times.get(self.fits.len())?;
        let left = next.saturating_sub(now).as_secs();
        Some(text!("perimeter-next", seconds = left))
    }
}

impl Tracker for PerimeterTracker {
    fn step(&mut self, scene: &ObjectiveScene<'_>) {
        let Some(grid) = self.plan.grid(scene.world) else {
            return;
        };
        // Half a second of flight covers less than a cell.
        if scene.now.as_millis().is_multiple_of(500) {
            self.look(scene, grid);
        }
        let due = self.plan.times.get(self.fits.len());
        if due.is_some_and(|&due| scene.now >= due) {
            self.fits.push(self.fit(grid));
        }
    }

    fn mapped(&self, world: &World) -> Vec<GroundPatch> {
        let Some(grid) = self.plan.grid(world) else {
            return Vec::new();
        };
        let seen = self.seen.iter().enumerate().filter(|(_, burnt)| **burnt);
        let patch = |(index, _)| GroundPatch {
            at: grid.centre(index),
            side_m: grid.side_m,
        };
        seen.map(patch).collect()
    }

    fn standing(&self, _: &ObjectiveScene<'_>) -> ObjectiveStanding {
        let (all, target) = (self.plan.times.len(), self.plan.target);
        let mean = self.sum() / self.fits.len().max(1) as f64;
        let settled = self.fits.len() == all;
        let credit = |fit: &f64| target.credit(*fit);
        let credits: f64 = 0.0 + self.fits.iter().map(credit).sum::<f64>();
        ObjectiveStanding {
            fraction: credits / all.max(1) as f64,
            measure: mean,
            met: settled && mean >= target.met_at,
            settled,
            landing: false,
        }
    }

    fn is_out_of_reach(&self, _: &ObjectiveScene<'_>) -> bool {
        // Each map still to come fits perfectly at best.
        let missing = self.plan.times.len() - self.fits.len();
        let best = self.fits.iter().sum::<f64>() + missing as f64;
        best < self.plan.target.met_at * self.plan.times.len() as f64
    }

    fn details(&self, scene: &ObjectiveScene<'_>) -> ObjectiveDetails {
        let times = self.plan.times.iter();
        let times: Vec<String> = times.map(|time| time.as_secs().to_string()).collect();
        ObjectiveDetails {
            product: Some(Product {
                quality: self.sum() / times.len().max(1) as f64,
                words: self.words(),
                advice: text!("perimeter-quality"),
                is_measured: true,
            }),
            result: self.words(),
            outlook: self.next(scene.now),
            target: text!(
                "perimeter-target",
                fit = format!("{:.2}", self.plan.target.met_at),
                times = times.join(", ")
            ),
            advice: text!("perimeter-advice"),
        }
    }
}
