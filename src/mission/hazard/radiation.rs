//! Gamma radiation: point sources, attenuated by air and walls.
//!
//! `H = sum G A / r2 exp(-mu r) shield + background`, with no build-up of scattered radiation.

use rand::RngExt;
use rand_chacha::ChaCha8Rng;

use super::{Field, Hazard, Object, ObjectClass, Quantity, TruthPiece, TruthShape};
use crate::geo::maths;
use crate::mission::Point;
use crate::mission::format::{
    FileTable, KindOf, POINT_RANGE, list, number, point, table as table_of, word,
};
use crate::mission::weather::Weather;

const BACKGROUND_USV_H: f64 = 0.1;
/// The minimum distance between a detector and a source.
const NEAREST_M: f64 = 0.5;
/// The maximum number of sources or walls; more would slow a step down.
const MOST_PARTS: usize = 50;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Isotope {
    Caesium137,
    Cobalt60,
}

impl Isotope {
    const WORDS: [(&str, Self); 2] = [("Cs-137", Self::Caesium137), ("Co-60", Self::Cobalt60)];

    /// The dose rate at 1 m in uSv/h per `GBq`, and the attenuation per metre of air.
    fn constants(self) -> (f64, f64) {
        match self {
            Self::Caesium137 => (92.7, 0.0093),
            Self::Cobalt60 => (351.0, 0.0071),
        }
    }
}

#[derive(Debug, Clone, Copy)]
struct GammaSource {
    at: Point,
    height_m: f64,
    isotope: Isotope,
    activity_gbq: f64,
}

#[derive(Debug, Clone, Copy)]
struct Wall {
    from: Point,
    to: Point,
    height_m: f64,
    /// The share of the radiation that passes through it.
    passes: f64,
}

#[derive(Debug, Clone)]
struct RadiationHazard {
    sources: Vec<GammaSource>,
    walls: Vec<Wall>,
    background_usv_h: f64,
    jitter_m: f64,
}

#[derive(Debug, Clone)]
struct RadiationField {
    sources: Vec<GammaSource>,
    walls: Vec<Wall>,
    background_usv_h: f64,
    objects: Vec<Object>,
}

pub(super) const KIND: KindOf<Box<dyn Hazard>> = KindOf {
    name: "radiation",
    about: "gamma sources, which walls can shield",
    read,
};

fn read(table: &mut FileTable<'_>) -> Option<Box<dyn Hazard>> {
    let sources_form = list(table_of(read_source), 1, MOST_PARTS);
    let sources = table.need(
        "sources",
        sources_form,
        "the sources; 1 GBq gives 92.7 (`Cs-137`) or 351 uSv/h (`Co-60`) at 1 m",
    );
    let walls = table.may(
        "walls",
        list(table_of(read_wall), 0, MOST_PARTS),
        "straight, vertical walls",
    );
    let background = number(0.0, 1000.0, "uSv/h");
    let background_usv_h = table.or(
        "background",
        background,
        BACKGROUND_USV_H,
        "dose rate without any source",
    );
    let jitter = number(0.0, POINT_RANGE, "m");
    let jitter_m = table.or(
        "jitter",
        jitter,
        0.0,
        "the seed moves each source by up to this distance",
    );
    Some(Box::new(RadiationHazard {
        sources: sources?,
        walls: walls.unwrap_or_default(),
        background_usv_h,
        jitter_m,
    }))
}

fn read_source(table: &mut FileTable<'_>) -> Option<GammaSource> {
    let at = table.need("at", point(), "position");
    let height_m = table.or(
        "height",
        number(0.0, 500.0, "m"),
        0.0,
        "height of the source",
    );
    let isotope = table.need("isotope", word(&Isotope::WORDS), "isotope of the source");
    let activity_gbq = table.need(
        "activity_gbq",
        number(1e-6, 1e6, "GBq"),
        "activity of the source",
    );
    Some(GammaSource {
        at: at?,
        height_m,
        isotope: isotope?,
        activity_gbq: activity_gbq?,
    })
}

fn read_wall(table: &mut FileTable<'_>) -> Option<Wall> {
    let from = table.need("from", point(), "one end of the wall");
    let to = table.need("to", point(), "other end of the wall");
    let height_m = table.need("height", number(0.1, 500.0, "m"), "height of the wall");
    let passes = table.need(
        "passes",
        number(0.0, 1.0, ""),
        "share of the radiation that gets through",
    );
    Some(Wall {
        from: from?,
        to: to?,
        height_m: height_m?,
        passes: passes?,
    })
}

impl Hazard for RadiationHazard {
    fn release(&self, _: &Weather, mut random: ChaCha8Rng) -> Box<dyn Field> {
        let mut sway = || self.jitter_m * (2.0 * random.random::<f64>() - 1.0);
        let mut sources = self.sources.clone();
        for source in &mut sources {
            source.at = [source.at[0] + sway(), source.at[1] + sway()];
        }
        let object = |source: &GammaSource| Object {
            height_m: source.height_m,
            ..Object::new(ObjectClass::Source, source.at)
        };
        Box::new(RadiationField {
            objects: sources.iter().map(object).collect(),
            sources,
            walls: self.walls.clone(),
            background_usv_h: self.background_usv_h,
        })
    }
}

impl Field for RadiationField {
    fn amount(&self, quantity: Quantity, at: Point, height_m: f64) -> f64 {
        if quantity != Quantity::DoseRate {
            return 0.0;
        }
        let of = |source: &GammaSource| {
            let walls = self.walls.iter();
            let shield: f64 = walls.map(|wall| wall.share(source, at, height_m)).product();
            source.dose_rate_usv_h(at, height_m) * shield
        };
        self.background_usv_h + self.sources.iter().map(of).sum::<f64>()
    }

    fn objects(&self) -> &[Object] {
        &self.objects
    }

    fn truth(&self) -> Vec<TruthPiece> {
        let of = |object: &Object| TruthPiece {
            at: object.at,
            shape: TruthShape::Object(object.class, true),
        };
        self.objects.iter().map(of).collect()
    }
}

impl GammaSource {
    fn dose_rate_usv_h(&self, at: Point, height_m: f64) -> f64 {
        let (per_gbq, absorbed_per_m) = self.isotope.constants();
        let level = maths::hypot(at[0] - self.at[0], at[1] - self.at[1]);
        let r = maths::hypot(level, height_m - self.height_m).max(NEAREST_M);
        per_gbq * self.activity_gbq / (r * r) * maths::exp(-absorbed_per_m * r)
    }
}

impl Wall {
    /// The share of a source's radiation that reaches a point in a straight line.
    fn share(&self, source: &GammaSource, at: Point, height_m: f64) -> f64 {
        let way = [at[0] - source.at[0], at[1] - source.at[1]];
        let along = [self.to[0] - self.from[0], self.to[1] - self.from[1]];
        let cross = way[0] * along[1] - way[1] * along[0];
        if cross.abs() < 1e-9 {
            return 1.0;
        }
        let gap = [self.from[0] - source.at[0], self.from[1] - source.at[1]];
        let on_way = (gap[0] * along[1] - gap[1] * along[0]) / cross;
        let on_wall = (gap[0] * way[1] - gap[1] * way[0]) / cross;
        let crossing_m = source.height_m + on_way * (height_m - source.height_m);
        let hit = (0.0..=1.0).contains(&on_way)
            && (0.0..=1.0).contains(&on_wall)
            && crossing_m <= self.height_m;
        if hit { self.passes } else { 1.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn field(sources: Vec<GammaSource>, walls: Vec<Wall>) -> RadiationField {
        RadiationField {
            sources,
            walls,
            background_usv_h: BACKGROUND_USV_H,
            objects: Vec::new(),
        }
    }

    const CAESIUM: GammaSource = GammaSource {
        at: [0.0, 0.0],
        height_m: 0.0,
        isotope: Isotope::Caesium137,
        activity_gbq: 10.0,
    };

    /// The expected values are `927 / r2 exp(-0.0093 r) + 0.1`, and for cobalt `3510 / r2
    /// exp(-0.0071 r) + 0.1`.
    #[test]
    fn the_dose_rate_falls_with_the_square_of_the_distance_and_in_air() {
        for (isotope, expected) in [
            (Isotope::Caesium137, [35.50, 8.547, 2.024, 0.4994]),
            (Isotope::Cobalt60, [135.6, 32.79, 7.713, 1.751]),
        ] {
            let field = field(vec![GammaSource { isotope, ..CAESIUM }], Vec::new());
            for (r, expected) in [5.0, 10.0, 20.0, 40.0].into_iter().zip(expected) {
                let value = field.amount(Quantity::DoseRate, [r, 0.0], 0.0);
                assert!(
                    (value / expected - 1.0).abs() < 0.002,
                    "{isotope:?} at {r} m: {value} instead of {expected}"
                );
            }
        }
    }

    #[test]
    fn several_sources_add_up_over_one_background() {
        let other = GammaSource {
            at: [30.0, 0.0],
            ..CAESIUM
        };
        let alone =
            |source| field(vec![source], Vec::new()).amount(Quantity::DoseRate, [10.0, 5.0], 12.0);
        let both = field(vec![CAESIUM, other], Vec::new());
        let sum = alone(CAESIUM) + alone(other) - BACKGROUND_USV_H;
        assert!((both.amount(Quantity::DoseRate, [10.0, 5.0], 12.0) - sum).abs() < 1e-9);
        assert!(both.amount(Quantity::Vapour, [10.0, 5.0], 12.0).abs() < 1e-12);
    }

    #[test]
    fn a_wall_shields_what_lies_behind_it_and_not_what_looks_over_it() {
        let wall = Wall {
            from: [5.0, -10.0],
            to: [5.0, 10.0],
            height_m: 4.0,
            passes: 0.1,
        };
        let field = field(vec![CAESIUM], vec![wall]);
        let share = |at: Point, height_m: f64| {
            let seen = field.amount(Quantity::DoseRate, at, height_m) - BACKGROUND_USV_H;
            seen / CAESIUM.dose_rate_usv_h(at, height_m)
        };
        for (at, height_m, expected) in [
            ([10.0, 0.0], 2.0, 0.1),
            ([10.0, 0.0], 20.0, 1.0),
            ([4.0, 0.0], 2.0, 1.0),
            ([-10.0, 0.0], 2.0, 1.0),
            ([10.0, 30.0], 2.0, 1.0),
        ] {
            let value = share(at, height_m);
            assert!(
                (value - expected).abs() < 1e-9,
                "{at:?} {height_m}: {value}"
            );
        }
    }
}
