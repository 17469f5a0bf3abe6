//! The truth of one flight: the weather, the hazards, and the objects. Until the debrief, trainees see it only through
//! sensors.

use std::collections::BTreeSet;
use std::time::Duration;

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

use super::board::PlanFault;
use super::ground_truth::{Load, LoadEffect, MinePassed, Object, Passage, Quantity, TruthPiece};
use super::hazard::{Field, Hazard};
use super::weather::Weather;
use super::{Mission, Point};
use crate::commands::FindKind;
use crate::geo::maths;
use crate::hash::fnv1a;

const COLUMN_SLICES: u32 = 8;
/// The extinction of light per gram of smoke (Mulholland and Croarkin 2000, for flaming fires).
const SMOKE_EXTINCTION_M2_G: f64 = 8.7;

/// The world of one flight.
#[derive(Debug, Clone)]
pub(crate) struct World {
    /// The current weather; events change it.
    pub weather: Weather,
    fields: Vec<Box<dyn Field>>,
    /// The kinds to report, each with its hazard.
    sought: BTreeSet<(FindKind, usize)>,
    /// The fault of the plan that each vehicle carries at the start, by seat; empty without such plans.
    pub plan_faults: Vec<Option<PlanFault>>,
    seed: u64,
}

impl World {
    /// The world at the start; the seed determines all random values.
    pub fn new(mission: &Mission, seed: u64) -> Self {
        // Streams from 0 upwards belong to the sensors, so the hazards count down from the last one.
        let release = |(hazard, stream): (&dyn Hazard, u64)| {
            let mut random = ChaCha8Rng::seed_from_u64(seed);
            random.set_stream(stream);
            hazard.release(&mission.site.weather, random)
        };
        let hazards = mission.site.hazards.iter().map(AsRef::as_ref);
        let fields: Vec<Box<dyn Field>> = hazards.zip((0..=u64::MAX).rev()).map(release).collect();
        let numbered = fields.iter().enumerate();
        let objects = numbered.flat_map(|(hazard, field)| {
            let of_field = field.objects().iter();
            of_field.map(move |object| (hazard, object))
        });
        Self {
            seed,
            weather: mission.site.weather,
            plan_faults: mission.board.drawn(seed),
            sought: objects
                .filter_map(|(hazard, object)| Some((object.class.kind()?, hazard)))
                .collect(),
            fields,
        }
    }

    /// A world with these objects, for tests.
    #[cfg(test)]
    pub fn of_objects(weather: Weather, objects: Vec<Object>) -> Self {
        #[derive(Debug, Clone)]
        struct Lying(Vec<Object>);
        impl Field for Lying {
            fn objects(&self) -> &[Object] {
                &self.0
            }
        }
        Self {
            seed: 0,
            weather,
            plan_faults: Vec::new(),
            sought: objects
                .iter()
                .filter_map(|object| Some((object.class.kind()?, 0)))
                .collect(),
            fields: vec![Box::new(Lying(objects))],
        }
    }

    /// The random stream of an objective: the same for the same seed and name.
    pub fn random(&self, objective: &str) -> ChaCha8Rng {
        // A stream that neither sensors nor hazards use.
        let mut random = ChaCha8Rng::seed_from_u64(self.seed);
        random.set_stream(1 << 62 | fnv1a(objective.as_bytes()) >> 2);
        random
    }

    /// Advances by a [`TICK`](super::TICK); `now` is mission time at its end.
    pub fn step(&mut self, now: Duration) {
        for field in &mut self.fields {
            field.step(now, &self.weather);
        }
    }

    /// The amount of a quantity at a point and a height above the origin, summed over all hazards.
    pub fn amount(&self, quantity: Quantity, at: Point, height_m: f64) -> f64 {
        self.fields
            .iter()
            .map(|field| field.amount(quantity, at, height_m))
            .sum()
    }

    /// The integral of a quantity along a vertical beam from a point down to the ground, per square
    /// metre.
    pub fn column(&self, quantity: Quantity, at: Point, height_m: f64) -> f64 {
        let slice_m = height_m.max(0.0) / f64::from(COLUMN_SLICES);
        let middle = |slice: u32| (f64::from(slice) + 0.5) * slice_m;
        let amounts = (0..COLUMN_SLICES).map(|slice| self.amount(quantity, at, middle(slice)));
        amounts.sum::<f64>() * slice_m
    }

    /// The share of a picture's contrast left by the smoke below a camera, 0 to 1.
    pub fn clear_view(&self, at: Point, height_m: f64) -> f64 {
        let smoke_g_m2 = self.column(Quantity::Particles, at, height_m) * 1e-6;
        maths::exp(-SMOKE_EXTINCTION_M2_G * smoke_g_m2)
    }

    /// Lets a ground robot pass a point; returns what that does to a mine there, if there is one.
    pub fn pass(&mut self, robot: Passage) -> Option<MinePassed> {
        self.fields.iter_mut().find_map(|field| field.pass(robot))
    }

    /// All objects, by hazard in file order.
    pub fn objects(&self) -> impl Iterator<Item = (ObjectId, &Object)> {
        self.fields.iter().enumerate().flat_map(|(hazard, field)| {
            let objects = field.objects().iter().enumerate();
            objects.map(move |(index, object)| (ObjectId { hazard, index }, object))
        })
    }

    /// The kinds of object to report for a hazard; see
    /// [`Deed::KINDS`](crate::commands::Deed::KINDS) for their names.
    pub fn kinds(&self, hazard: usize) -> impl Iterator<Item = FindKind> {
        let of_it = self.sought.iter().filter(move |(_, of)| *of == hazard);
        of_it.map(|(kind, _)| *kind)
    }

    /// Whether a kind may have to be reported at a point: a hazard that had such objects at the start may have one
    /// there.
    pub fn seeks(&self, kind: FindKind, at: Point) -> bool {
        let here = |hazard: usize| self.field(hazard).is_some_and(|it| it.may_lie_at(at));
        let mut sought = self.sought.iter();
        sought.any(|&(known, hazard)| known == kind && here(hazard))
    }

    /// The hazard with this index in the file.
    pub fn field(&self, hazard: usize) -> Option<&dyn Field> {
        self.fields.get(hazard).map(AsRef::as_ref)
    }

    /// The pieces of truth that the debrief shows, each with its hazard's index in the file.
    pub fn truth(&self) -> impl Iterator<Item = (usize, TruthPiece)> + '_ {
        let fields = self.fields.iter().enumerate();
        fields.flat_map(|(hazard, field)| field.truth().into_iter().map(move |t| (hazard, t)))
    }

    /// Applies a load that lands at a point to every hazard that it affects.
    pub fn affect(&mut self, load: Load, at: Point) -> Vec<LoadEffect> {
        let fields = self.fields.iter_mut();
        fields.filter_map(|field| field.affect(load, at)).collect()
    }
}

/// Identifies an object of a world.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct ObjectId {
    /// Its hazard's index in the file, from 0.
    pub hazard: usize,
    /// Its index among the hazard's objects.
    pub index: usize,
}
