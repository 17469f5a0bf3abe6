//! `line`: a power line on pylons, with defects on its wire and stains that look like defects.
//!
//! The wire hangs in catenaries: `y = a (cosh(x / a) - cosh(L / 2a))` below the pylons' tops, where the sag `a (cosh(L
//! / 2a) - 1)` belongs to a span of the line's mean length; all spans have the same tension, so the same `a`.

use rand::RngExt;
use rand_chacha::ChaCha8Rng;

use super::placing::revealed;
use super::{Field, Hazard, Object, ObjectClass, TruthPiece};
use crate::geo::maths;
use crate::mission::Point;
use crate::mission::format::{FileTable, KindOf, list, not_between, number, point, whole};
use crate::mission::report::distance_m;
use crate::mission::weather::Weather;
use crate::text;

const MOST_PYLONS: usize = 100;
const MOST_DEFECTS: u32 = 200;
/// The spacing of the points on the wire to which distances are measured.
const STEP_M: f64 = 1.0;

#[derive(Debug, Clone)]
struct PowerLine {
    wire: Wire,
    defects: usize,
    stains: usize,
    gap_m: f64,
}

#[derive(Debug, Clone, PartialEq)]
struct Wire {
    pylons: Vec<Point>,
    height_m: f64,
    /// The catenary's parameter; infinite for a straight wire.
    parameter_m: f64,
}

#[derive(Debug, Clone)]
struct Strung {
    objects: Vec<Object>,
    points: Vec<(Point, f64)>,
}

pub(super) const KIND: KindOf<Box<dyn Hazard>> = KindOf {
    name: "line",
    about: "a power line between pylons, with defects and harmless stains on its wire; the map shows the line from the start",
    read,
};

fn read(table: &mut FileTable<'_>) -> Option<Box<dyn Hazard>> {
    let pylons = table.need(
        "pylons",
        list(point(), 2, MOST_PYLONS),
        "positions, at least 5 m apart",
    );
    let height_m = table.need("height", number(2.0, 200.0, "m"), "height of the pylons");
    let sag_m = table.need(
        "sag",
        number(0.0, 200.0, "m"),
        "sag of a span of mean length, less than `height`",
    );
    let defects = table.need("defects", whole(1, MOST_DEFECTS, ""), "number of defects");
    let stains_form = whole(0, MOST_DEFECTS, "");
    let stains = table.or(
        "stains",
        stains_form,
        0,
        "stains that look like defects from a distance",
    );
    let gap_m = table.need(
        "min_gap",
        number(0.0, 1000.0, "m"),
        "minimum distance between defects and stains; together they may take up half of the line",
    );
    let (pylons, height_m, sag_m) = (pylons?, height_m?, sag_m?);
    let mut spans = pylons.windows(2);
    if !spans.all(|pair| distance_m(pair[0], pair[1]) >= 5.0) {
        let fault = text!("fault-pylons", most = MOST_PYLONS);
        table.fault_of("pylons", fault);
        return None;
    }
    if sag_m > height_m {
        table.fault_of("sag", not_between("sag", &(0.0..=height_m), sag_m));
    }
    let (defects, gap_m) = (defects?, gap_m?);
    let wire = Wire::new(pylons, height_m, sag_m);
    // Half of the length must stay free; otherwise random placement finds no room.
    if f64::from(defects + stains) * gap_m > wire.length_m() / 2.0 {
        table.fault_of("min_gap", text!("fault-line-short"));
    }
    Some(Box::new(PowerLine {
        wire,
        defects: defects as usize,
        stains: stains as usize,
        gap_m,
    }))
}

impl Wire {
    fn new(pylons: Vec<Point>, height_m: f64, sag_m: f64) -> Self {
        let spans = pylons.len().saturating_sub(1).max(1) as f64;
        let mut wire = Self {
            pylons,
            height_m,
            parameter_m: f64::INFINITY,
        };
        wire.parameter_m = parameter_m(wire.length_m() / spans, sag_m);
        wire
    }

    /// Length of the line on the ground.
    fn length_m(&self) -> f64 {
        let spans = self.pylons.windows(2);
        spans.map(|pair| distance_m(pair[0], pair[1])).sum()
    }

    /// The wire's position, its height in metres and its direction in degrees, at a distance along
    /// the line.
    fn at(&self, along_m: f64) -> (Point, f64, f64) {
        let (mut left_m, mut last) = (along_m, ([0.0; 2], self.height_m, 0.0));
        for pair in self.pylons.windows(2) {
            let (from, to) = (pair[0], pair[1]);
            let span_m = distance_m(from, to);
            let x_m = left_m.clamp(0.0, span_m);
            let share = x_m / span_m;
            let place = [0, 1].map(|axis| from[axis] + (to[axis] - from[axis]) * share);
            let drop_m = drop_m(self.parameter_m, span_m, x_m);
            let axis_deg = maths::atan2(to[0] - from[0], to[1] - from[1]).to_degrees();
            last = (place, self.height_m - drop_m, axis_deg);
            if left_m <= span_m {
                break;
            }
            left_m -= span_m;
        }
        last
    }
}

/// The sag of a wire below its ends, at `x_m` along a span.
fn drop_m(parameter_m: f64, span_m: f64, x_m: f64) -> f64 {
    if !parameter_m.is_finite() {
        return 0.0;
    }
    let end = maths::cosh(span_m / 2.0 / parameter_m);
    parameter_m * (end - maths::cosh((x_m - span_m / 2.0) / parameter_m))
}

/// The parameter of the catenary with a sag in a span: `a (cosh(L / 2a) - 1) = sag`, by bisection.
fn parameter_m(span_m: f64, sag_m: f64) -> f64 {
    if sag_m <= 1e-6 * span_m {
        return f64::INFINITY;
    }
    // Logarithms of the bounds: an almost vertical wire, and an almost level one.
    let (mut low, mut high) = (maths::ln(span_m / 1000.0), maths::ln(span_m * 1e7));
    for _ in 0..80 {
        let middle = f64::midpoint(low, high);
        if drop_m(maths::exp(middle), span_m, span_m / 2.0) > sag_m {
            low = middle;
        } else {
            high = middle;
        }
    }
    maths::exp(low)
}

impl Hazard for PowerLine {
    fn pylons(&self) -> &[Point] {
        &self.wire.pylons
    }

    fn release(&self, _: &Weather, mut random: ChaCha8Rng) -> Box<dyn Field> {
        let length_m = self.wire.length_m();
        let mut places: Vec<f64> = Vec::new();
        for _ in 0..self.defects + self.stains {
            let mut tries = (0..400).map(|_| length_m * random.random::<f64>());
            let lonely = |along: &f64| places.iter().all(|p| (p - along).abs() >= self.gap_m);
            places.extend(tries.find(lonely));
        }
        let hang = |(index, along_m): (usize, f64)| {
            let (at, height_m, axis_deg) = self.wire.at(along_m);
            let class = if index < self.defects {
                ObjectClass::Defect
            } else {
                ObjectClass::Clutter
            };
            Object {
                height_m,
                axis_deg: Some(axis_deg),
                ..Object::new(class, at)
            }
        };
        let steps = (length_m / STEP_M).ceil() as u32;
        let point = |step: u32| {
            let (at, height_m, _) = self.wire.at(f64::from(step) * length_m / f64::from(steps));
            (at, height_m)
        };
        Box::new(Strung {
            objects: places.into_iter().enumerate().map(hang).collect(),
            points: (0..=steps).map(point).collect(),
        })
    }
}

impl Field for Strung {
    fn objects(&self) -> &[Object] {
        &self.objects
    }

    fn distance_m(&self, at: Point, height_m: f64) -> Option<f64> {
        let squares = self.points.iter().map(|&([east_m, north_m], wire_m)| {
            let (east, north, up) = (east_m - at[0], north_m - at[1], wire_m - height_m);
            east * east + north * north + up * up
        });
        squares.min_by(f64::total_cmp).map(f64::sqrt)
    }

    fn truth(&self) -> Vec<TruthPiece> {
        revealed(&self.objects)
    }
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;

    use super::*;

    #[test]
    fn the_wire_hangs_in_a_catenary_with_the_sag_of_the_span() {
        for (span_m, sag_m) in [(100.0, 2.0), (60.0, 20.0), (300.0, 9.0)] {
            let a = parameter_m(span_m, sag_m);
            assert!(
                (drop_m(a, span_m, span_m / 2.0) - sag_m).abs() < 1e-6,
                "{span_m} {sag_m}"
            );
            assert!(drop_m(a, span_m, 0.0).abs() < 1e-9);
            // A catenary's slope is sinh(x / a).
            let slope = (drop_m(a, span_m, 0.001) - drop_m(a, span_m, 0.0)) / 0.001;
            assert!((slope - maths::sinh(span_m / 2.0 / a)).abs() < 1e-3 * slope.max(1.0));
        }
        // A flat catenary is a parabola: a = L^2 / (8 sag); a quarter of the way along, it has three quarters of the
        // sag.
        let a = parameter_m(100.0, 0.5);
        assert!((a / 2500.0 - 1.0).abs() < 1e-3);
        assert!((drop_m(a, 100.0, 25.0) - 0.375).abs() < 1e-3);
        assert!(drop_m(parameter_m(100.0, 0.0), 100.0, 50.0).abs() < 1e-12);
    }

    #[test]
    fn defects_hang_on_the_wire_with_the_gap_and_know_its_direction() {
        let wire = Wire::new(vec![[0.0, 0.0], [80.0, 0.0], [80.0, 90.0]], 20.0, 3.0);
        let line = PowerLine {
            wire,
            defects: 4,
            stains: 2,
            gap_m: 10.0,
        };
        for seed in 0..30 {
            let field = line.release(&Weather::CALM, ChaCha8Rng::seed_from_u64(seed));
            assert_eq!(field.objects().len(), 6);
            for object in field.objects() {
                assert!((16.0..=20.0).contains(&object.height_m));
                let to_wire = field.distance_m(object.at, object.height_m);
                assert!(
                    to_wire.is_some_and(|distance| distance < 0.6),
                    "{to_wire:?}"
                );
                let axis = if object.at[1] < 1e-9 { 90.0 } else { 0.0 };
                let known = object.axis_deg.map_or(f64::NAN, |deg| deg - axis);
                assert!(known.abs() < 1e-9, "{object:?}");
            }
        }
        let field = line.release(&Weather::CALM, ChaCha8Rng::seed_from_u64(1));
        let beside = field.distance_m([40.0, 8.0], 17.0);
        assert!(
            beside.is_some_and(|distance| (distance - 8.0).abs() < 0.1),
            "{beside:?}"
        );
    }
}
