//! `coverage`: pass over a zone with suitable sensors, low and slow enough for them to work.
//!
//! Cells count as swept once the strip of a working sensor has passed over their centre. The result also gives the
//! coverage of search theory, `C = W L / A` (strip width times path length over area), and the share that a random
//! search of that coverage would find, `1 - e^-C` (Koopman 1980): the difference is the gain from flying lines.

use toml::Spanned;

use super::{
    Demands, GroundPatch, ObjectiveDetails, ObjectiveKind, ObjectiveScene, ObjectiveStanding,
    Tracker,
};
use crate::geo::maths;
use crate::mission::craft::Craft;
use crate::mission::format::{BetterMeasure, FileTable, KindOf, ObjectiveTarget, flag, number};
use crate::mission::sensor::Sensor;
use crate::mission::skill::Skill;
use crate::mission::weather::Light;
use crate::mission::world::World;
use crate::mission::zone::{Shape, Zone};
use crate::mission::{Point, TICK};
use crate::text;

mod gaps;

/// With this coverage or more, gaps come from the distance between lines, not from a flight that was too short.
const MUCH_COVERAGE: f64 = 0.5;
const MOST_CELLS: f64 = 40_000.0;

#[derive(Debug, Clone)]
struct Coverage {
    zone: Zone,
    grid: CoverageGrid,
    sensors: Vec<&'static Sensor>,
    target: ObjectiveTarget,
    /// Whether only vehicles that fly a plan sweep cells.
    by_plan: bool,
}

/// A zone in square cells; cells with their centre outside are left out.
#[derive(Debug, Clone)]
struct CoverageGrid {
    shape: Shape,
    corner: Point,
    side_m: f64,
    columns: usize,
    /// Whether each cell is swept, row by row; `None` outside the zone.
    cells: Vec<Option<bool>>,
}

#[derive(Debug, Clone)]
struct Sweep {
    grid: CoverageGrid,
    sensors: Vec<&'static Sensor>,
    target: ObjectiveTarget,
    by_plan: bool,
    /// The area that strips have passed over within the zone, counting repeats.
    passed_m2: f64,
}

pub(super) const KIND: KindOf<Box<dyn ObjectiveKind>> = KindOf {
    name: "coverage",
    about: "met when the sensors have swept the share `target` of the cells; a sensor sweeps a cell where it has at least half of its best probability of detection",
    read,
};

fn read(table: &mut FileTable<'_>) -> Option<Box<dyn ObjectiveKind>> {
    let zone = table.need_task_zone();
    let sensors = table.need_sensors("sensors that find things; the fleet must carry them");
    let cell = number(0.2, 1000.0, "m");
    let side_m = table.need("cell", cell, "side of a cell");
    let target = table.need_target([0.01, 1.0], BetterMeasure::Higher);
    let by_plan = table.or(
        "by_plan",
        flag(),
        false,
        "`true`: cells count only if the vehicle flies a plan in AUTO",
    );
    let zone = zone?;
    Some(Box::new(Coverage {
        sensors: detectors(table, sensors?),
        grid: grid(table, &zone.shape, side_m?)?,
        zone,
        target: target?,
        by_plan,
    }))
}

fn detectors(
    table: &mut FileTable<'_>,
    sensors: Vec<Spanned<&'static Sensor>>,
) -> Vec<&'static Sensor> {
    for sensor in &sensors {
        if sensor.get_ref().detector().is_none() {
            let id = sensor.get_ref().id;
            let fault = text!("fault-no-sweep", sensor = id);
            table.draft().faults.add(sensor.span(), fault);
        }
    }
    sensors.into_iter().map(Spanned::into_inner).collect()
}

fn grid(table: &mut FileTable<'_>, shape: &Shape, side_m: f64) -> Option<CoverageGrid> {
    let (low, high) = shape.bounds();
    if (high[0] - low[0]) * (high[1] - low[1]) > MOST_CELLS * side_m * side_m {
        let fault = text!("fault-cells-most", most = MOST_CELLS.to_string());
        table.fault_of("cell", fault);
        return None;
    }
    let grid = CoverageGrid::new(shape, side_m);
    if grid.count() == 0 {
        table.fault_of("cell", text!("fault-cells-none"));
    }
    Some(grid)
}

impl CoverageGrid {
    fn new(shape: &Shape, side_m: f64) -> Self {
        let (low, high) = shape.bounds();
        let count = |axis: usize| ((high[axis] - low[axis]) / side_m).round().max(1.0) as usize;
        let (columns, rows) = (count(0), count(1));
        let mut grid = Self {
            shape: shape.clone(),
            corner: low,
            side_m,
            columns,
            cells: Vec::new(),
        };
        let inside = |index| shape.contains(grid.middle(index)).then_some(false);
        grid.cells = (0..columns * rows).map(inside).collect();
        grid
    }

    fn middle(&self, index: usize) -> Point {
        let (column, row) = (index % self.columns, index / self.columns);
        [
            self.corner[0] + (column as f64 + 0.5) * self.side_m,
            self.corner[1] + (row as f64 + 0.5) * self.side_m,
        ]
    }

    /// The cells whose centre may lie within a distance of a point.
    fn around(&self, at: Point, reach_m: f64) -> impl Iterator<Item = usize> + use<> {
        let rows = self.cells.len() / self.columns;
        let range = |axis: usize, count: usize| {
            let cell = |edge: f64| ((edge - self.corner[axis]) / self.side_m).floor();
            let first = cell(at[axis] - reach_m).clamp(0.0, count as f64) as usize;
            let last = (cell(at[axis] + reach_m) + 1.0).clamp(0.0, count as f64) as usize;
            first..last
        };
        let (columns, all) = (range(0, self.columns), self.columns);
        range(1, rows).flat_map(move |row| columns.clone().map(move |column| row * all + column))
    }

    fn count(&self) -> usize {
        self.cells.iter().flatten().count()
    }

    fn swept(&self) -> f64 {
        let swept = self.cells.iter().flatten().filter(|swept| **swept).count();
        swept as f64 / self.count().max(1) as f64
    }

    fn area_m2(&self) -> f64 {
        self.count() as f64 * self.side_m * self.side_m
    }
}

impl ObjectiveKind for Coverage {
    fn skill(&self, _: usize) -> Option<Skill> {
        Some(if self.by_plan { Skill::K13 } else { Skill::K6 })
    }

    fn demands(&self) -> Demands<'_> {
        Demands {
            zone: Some(&self.zone),
            ..Demands::default()
        }
    }

    fn start(&self, _: &World) -> Box<dyn Tracker> {
        Box::new(Sweep {
            grid: self.grid.clone(),
            sensors: self.sensors.clone(),
            target: self.target,
            by_plan: self.by_plan,
            passed_m2: 0.0,
        })
    }
}

impl Sweep {
    fn pass(&mut self, craft: &Craft, light: Light) {
        let counts = craft.can_see() && (craft.flies_plan() || !self.by_plan);
        let Some(at) = craft.at.filter(|_| counts) else {
            return;
        };
        let carried = |sensor: &&&'static Sensor| craft.sensors.iter().any(|s| s.id == sensor.id);
        let working: Vec<_> = self
            .sensors
            .iter()
            .filter(carried)
            .filter_map(|sensor| sensor.detector())
            .filter(|spec| spec.works(craft.height_m, craft.speed_m_s, light))
            .collect();
        for &spec in &working {
            for index in self.grid.around(at, spec.strip_reach_m(craft.height_m)) {
                let [east, north] = self.grid.middle(index);
                let offset_m = craft.course.offset_m([east - at[0], north - at[1]]);
                if let Some(Some(swept)) = self.grid.cells.get_mut(index) {
                    *swept |= spec.covers(offset_m, craft.height_m);
                }
            }
        }
        let widest = working.iter().map(|spec| spec.swath_m(craft.height_m));
        if self.grid.shape.contains(at) {
            let way_m = craft.speed_m_s * TICK.as_secs_f64();
            self.passed_m2 += widest.fold(0.0, f64::max) * way_m;
        }
    }

    /// `C = W L / A`.
    fn coverage(&self) -> f64 {
        self.passed_m2 / self.grid.area_m2().max(1e-9)
    }
}

impl Tracker for Sweep {
    fn step(&mut self, scene: &ObjectiveScene<'_>) {
        for craft in scene.vehicles {
            self.pass(craft, scene.world.weather.light);
        }
    }

    fn gaps(&self) -> Vec<GroundPatch> {
        gaps::gaps(&self.grid)
    }

    fn swept(&self) -> Vec<GroundPatch> {
        gaps::swept(&self.grid)
    }

    fn standing(&self, _: &ObjectiveScene<'_>) -> ObjectiveStanding {
        let swept = self.grid.swept();
        let met = swept >= self.target.met_at;
        ObjectiveStanding {
            fraction: self.target.credit(swept),
            measure: swept,
            met,
            settled: met,
            landing: false,
        }
    }

    fn details(&self, _: &ObjectiveScene<'_>) -> ObjectiveDetails {
        let (swept, coverage) = (self.grid.swept(), self.coverage());
        let percent = |share: f64| format!("{:.0}", share * 100.0);
        ObjectiveDetails {
            product: None,
            result: text!(
                "coverage-result",
                swept = percent(swept),
                random = percent(random_search(coverage)),
            ),
            outlook: Some(text!("coverage-outlook", swept = percent(swept))),
            target: text!("coverage-target", target = percent(self.target.met_at)),
            advice: if coverage < MUCH_COVERAGE {
                text!("coverage-advice-lines")
            } else {
                text!(
                    "coverage-advice",
                    left = percent(1.0 - swept),
                    coverage = format!("{coverage:.2}"),
                )
            },
        }
    }
}

/// The share that a random search of this coverage finds: `1 - e^-C`.
fn random_search(coverage: f64) -> f64 {
    1.0 - maths::exp(-coverage)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sweep() -> Sweep {
        let shape = Shape::Polygon(vec![[0.0, 0.0], [40.0, 0.0], [40.0, 20.0], [0.0, 20.0]]);
        Sweep {
            grid: CoverageGrid::new(&shape, 1.0),
            sensors: Sensor::by_id("s_mag").into_iter().collect(),
            target: ObjectiveTarget {
                met_at: 0.9,
                partial_from: 0.5,
            },
            by_plan: false,
            passed_m2: 0.0,
        }
    }

    /// Flies a line north through the zone.
    fn line(sweep: &mut Sweep, east_m: f64, height_m: f64, speed_m_s: f64) {
        let sensors: Vec<_> = Sensor::by_id("s_mag").into_iter().collect();
        let mut craft = Craft::new(1, &sensors, 1);
        (craft.heard, craft.under_way) = (true, true);
        (craft.height_m, craft.speed_m_s) = (height_m, speed_m_s);
        let step_m = speed_m_s * TICK.as_secs_f64();
        for step in 0..(22.0 / step_m) as u32 {
            craft.at = Some([east_m, f64::from(step) * step_m - 1.0]);
            sweep.pass(&craft, Light::Day);
        }
    }

    #[test]
    fn lines_at_the_swath_sweep_all_of_it_and_others_leave_gaps() {
        let mut dense = sweep();
        for index in 0..20 {
            line(&mut dense, f64::from(index) * 2.0 + 1.0, 1.5, 2.0);
        }
        assert!(
            (dense.grid.swept() - 1.0).abs() < 1e-9,
            "{}",
            dense.grid.swept()
        );
        // The strip is as wide as the line spacing: every square metre is covered once.
        assert!(
            (dense.coverage() - 1.0).abs() < 0.02,
            "{}",
            dense.coverage()
        );
        let mut wide = sweep();
        for index in 0..10 {
            line(&mut wide, f64::from(index) * 4.0 + 1.0, 1.5, 2.0);
        }
        assert!(
            (wide.grid.swept() - 0.5).abs() < 1e-9,
            "{}",
            wide.grid.swept()
        );
        assert!((wide.coverage() - 0.5).abs() < 0.01);
        assert!((random_search(wide.coverage()) - 0.393).abs() < 0.01);
    }

    #[test]
    fn too_high_and_too_fast_sweep_nothing() {
        for (height_m, speed_m_s) in [(4.0, 2.0), (1.5, 6.0)] {
            let mut sweep = sweep();
            line(&mut sweep, 10.0, height_m, speed_m_s);
            assert!(sweep.grid.swept() < 1e-9, "{height_m} m, {speed_m_s} m/s");
            assert!(sweep.coverage() < 1e-9);
        }
    }

    #[test]
    fn by_plan_counts_only_what_a_plan_has_swept() {
        let swept = |in_auto: bool| {
            let mut sweep = Sweep {
                by_plan: true,
                ..sweep()
            };
            let sensors: Vec<_> = Sensor::by_id("s_mag").into_iter().collect();
            let mut craft = Craft::new(1, &sensors, 1);
            (craft.heard, craft.under_way, craft.in_auto) = (true, true, in_auto);
            (craft.height_m, craft.speed_m_s) = (1.5, 2.0);
            craft.at = Some([10.0, 10.0]);
            sweep.pass(&craft, Light::Day);
            sweep.grid.swept() > 0.0
        };
        assert!(swept(true) && !swept(false));
    }
}
