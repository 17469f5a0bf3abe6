//! The probability that a detector finds an object in view.
//!
//! Mines, per pass: best probability of the sensor for the class, times `exp(-(max(0, h - h0) / hs)^2)`, times
//! `1 / (1 + exp((v - v0) / (0.15 v0)))`, times `L(2 x / W)` with `L(u) = 1` up to 0.8 and falling to 0 at 1.
//!
//! Pictures, per look of 2 s: Johnson's criteria in the form of the targeting task performance metric. A pixel on the
//! ground is `2 h tan(FOV / 2) / px`; cycles over the target are `N = d_c / (2 pixel)`, with `d_c` the root of its
//! area; `P = x^E / (1 + x^E)`, `x = N / N50`, `E = 2.7 + 0.7 x`, where `N50` is 0.75 to detect and 3 to recognise.
//! This is reduced by contrast, by cover, by smoke, and by the objects that the observer misses.

use super::detector::{Band, Camera, DetectorSpec, Ground, MineSpec};
use crate::commands::FindKind;
use crate::geo::maths;
use crate::mission::ground_truth::{Object, ObjectClass};
use crate::mission::weather::Light;

/// Cycles over a target for 50 % detection, and for 50 % recognition.
const DETECT_CYCLES: f64 = 0.75;
const RECOGNISE_CYCLES: f64 = 3.0;
/// Root of the area of a person lying down.
const PERSON_M: f64 = 0.75;
/// The share of visible objects that the recognition on board notices.
const NOTICED: f64 = 0.9;
/// The time of one independent look at a picture, and of one look in an inspection.
const LOOK_S: f64 = 2.0;
const INSPECTION_S: f64 = 4.0;
/// The greatest angle between the view of a defect and the normal of its line.
const VIEW_ANGLE_DEG: f64 = 35.0;
/// The multiple of `N50` at which 90 % of objects are recognised.
const NINE_IN_TEN: f64 = 1.77;
/// Extinction of far infrared in smoke, as a share of that of light: the exponent of the transmission (Beer-Lambert).
const SMOKE_IN_INFRARED: f64 = 0.1;

/// A detector and an object at one moment.
#[derive(Debug, Clone, Copy)]
pub(crate) struct View<'a> {
    pub object: &'a Object,
    /// The offset of the object from the vehicle, across and along its course.
    pub offset_m: [f64; 2],
    /// The same offset, east and north.
    pub toward_m: [f64; 2],
    /// The vehicle's height above the origin, and its speed.
    pub height_m: f64,
    pub speed_m_s: f64,
    pub light: Light,
    /// The share of light that passes the smoke, 0 to 1.
    pub clarity: f64,
}

/// The result of a look.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Look {
    /// The probability of noticing the object, for each pass or each look.
    pub chance: f64,
    /// The probability of recognising a noticed object as harmless, if it is harmless.
    pub told_apart: f64,
    /// Length of one independent look; `None` if a whole pass is one look.
    pub every_s: Option<f64>,
    /// The kind that the object is taken for.
    pub taken_for: FindKind,
    /// Standard deviation of the object's reported position, on each axis.
    pub error_m: f64,
    /// Sightings within this distance belong to one object.
    pub merge_within_m: f64,
}

impl DetectorSpec {
    /// The possible result of a look at an object; `None` if the detector cannot see it.
    pub fn look(&self, view: &View<'_>) -> Option<Look> {
        let look = match self {
            Self::Ground(ground) => ground.look(view),
            Self::Camera(camera) => camera.look(view),
        };
        look.filter(|look| view.object.present && look.chance > 0.0)
    }

    /// The number of false alarms for mines or people, per square metre swept at a height.
    pub fn false_alarms_per_m2(&self, taken_for: FindKind, height_m: f64, light: Light) -> f64 {
        match (taken_for, self) {
            (FindKind::Mine, Self::Ground(ground)) => {
                ground.mines.false_alarms_per_m2 * ground.mines.nearness(height_m)
            }
            (FindKind::Mine, Self::Camera(camera)) => camera.mines.as_ref().map_or(0.0, |mines| {
                let visible = camera.mine_light(light);
                mines.false_alarms_per_m2 * visible * mines.nearness(height_m)
            }),
            (FindKind::Person, Self::Camera(_)) => FALSE_PERSONS_PER_M2,
            _ => 0.0,
        }
    }
}

impl DetectorSpec {
    /// A look at a false contact; `None` if the sensor cannot check it. The absence of a person is
    /// recognised with the same probability as the presence of one.
    pub fn look_at_nothing(
        &self,
        taken_for: FindKind,
        offset_m: [f64; 2],
        height_m: f64,
        light: Light,
    ) -> Option<Look> {
        let Self::Camera(camera) = self else {
            return None;
        };
        if taken_for != FindKind::Person || !camera.shows(offset_m, height_m) {
            return None;
        }
        let cycles = PERSON_M / (2.0 * camera.pixel_m(height_m));
        let told = task_performance(cycles / RECOGNISE_CYCLES);
        Some(Look {
            chance: 0.0,
            told_apart: told * camera.contrast(light) * NOTICED,
            every_s: Some(LOOK_S),
            taken_for,
            error_m: 0.0,
            merge_within_m: 1.0,
        })
    }
}

/// False alarms for people from warm stones and stumps: one per ten hectares.
const FALSE_PERSONS_PER_M2: f64 = 1e-5;

impl Ground {
    fn look(&self, view: &View<'_>) -> Option<Look> {
        let lateral = lateral(2.0 * view.offset_m[0].abs() / self.swath_m);
        // The sensor head is as long as it is wide.
        if view.offset_m[1].abs() > self.swath_m / 2.0 {
            return None;
        }
        let look = self.mines.look(view)?;
        Some(Look {
            chance: look.chance * lateral,
            ..look
        })
    }
}

impl MineSpec {
    fn look(&self, view: &View<'_>) -> Option<Look> {
        let class = match view.object.class {
            ObjectClass::MetalMine => 0,
            ObjectClass::MinimumMetalMine => 1,
            ObjectClass::SurfaceMine => 2,
            ObjectClass::Clutter if view.object.axis_deg.is_none() => 3,
            ObjectClass::Clutter
            | ObjectClass::Person
            | ObjectClass::Animal
            | ObjectClass::Fire
            | ObjectClass::Defect
            | ObjectClass::Leak
            | ObjectClass::Source => return None,
        };
        Some(Look {
            chance: self.best[class] * self.left(view.height_m, view.speed_m_s),
            told_apart: 0.0,
            every_s: None,
            taken_for: FindKind::Mine,
            error_m: 0.25,
            merge_within_m: 1.5,
        })
    }

    /// The share of the probabilities that remains at a height in metres and a speed in m/s, 0 to
    /// 1.
    pub(super) fn left(&self, height_m: f64, speed_m_s: f64) -> f64 {
        let over = (speed_m_s - self.speed_m_s) / (0.15 * self.speed_m_s);
        self.nearness(height_m) / (1.0 + maths::exp(over))
    }

    /// The share of the probabilities that remains at a height, 0 to 1.
    fn nearness(&self, height_m: f64) -> f64 {
        let above = (height_m - self.height_m).max(0.0);
        maths::exp(-maths::powi(above / self.height_scale_m, 2))
    }
}

impl Camera {
    fn look(&self, view: &View<'_>) -> Option<Look> {
        if let Some(axis_deg) = view.object.axis_deg {
            return self.inspect(view, axis_deg);
        }
        if !self.shows(view.offset_m, view.height_m) {
            return None;
        }
        let clear = self.transmission(view) * (1.0 - view.object.cover) * NOTICED;
        let (size_m, taken_for) = match view.object.class {
            ObjectClass::Person => (PERSON_M, FindKind::Person),
            ObjectClass::Animal => (0.6, FindKind::Person),
            ObjectClass::Fire => (1.0, FindKind::Fire),
            ObjectClass::MetalMine
            | ObjectClass::MinimumMetalMine
            | ObjectClass::SurfaceMine
            | ObjectClass::Clutter
            | ObjectClass::Defect
            | ObjectClass::Leak
            | ObjectClass::Source => return self.look_for_mines(view),
        };
        let cycles = size_m / (2.0 * self.pixel_m(view.height_m));
        let contrast = match view.object.class {
            ObjectClass::Fire => 1.0,
            ObjectClass::MetalMine
            | ObjectClass::MinimumMetalMine
            | ObjectClass::SurfaceMine
            | ObjectClass::Clutter
            | ObjectClass::Person
            | ObjectClass::Animal
            | ObjectClass::Defect
            | ObjectClass::Leak
            | ObjectClass::Source => self.contrast(view.light),
        };
        Some(Look {
            chance: task_performance(cycles / DETECT_CYCLES) * contrast * clear,
            told_apart: task_performance(cycles / RECOGNISE_CYCLES),
            every_s: Some(LOOK_S),
            taken_for,
            error_m: 1.0 + 0.02 * view.height_m,
            merge_within_m: 10.0,
        })
    }

    /// Whether an offset across and along the course is in the picture.
    fn shows(&self, offset_m: [f64; 2], height_m: f64) -> bool {
        let footprint_m = self.footprint_m(height_m);
        let mut axes = offset_m.iter().zip(footprint_m);
        axes.all(|(offset_m, length_m)| offset_m.abs() <= length_m / 2.0)
    }

    fn look_for_mines(&self, view: &View<'_>) -> Option<Look> {
        let look = self.mines.as_ref()?.look(view)?;
        let clear = self.transmission(view) * (1.0 - view.object.cover);
        Some(Look {
            chance: look.chance * self.mine_light(view.light) * clear,
            error_m: 0.4,
            ..look
        })
    }

    fn inspect(&self, view: &View<'_>, axis_deg: f64) -> Option<Look> {
        let reach_m = self.inspects_to_m?;
        let [east, north] = view.toward_m;
        let distance_m = maths::hypot(
            maths::hypot(east, north),
            view.object.height_m - view.height_m,
        );
        let (sin, cos) = maths::sin_cos(axis_deg.to_radians());
        // The line's direction is (sin, cos), its horizontal normal (cos, -sin).
        let square_m = (east * cos - north * sin).abs();
        if square_m < distance_m * maths::cos(VIEW_ANGLE_DEG.to_radians()) {
            return None;
        }
        let told = task_performance(NINE_IN_TEN * reach_m / distance_m.max(1.0));
        let clear = self.transmission(view) * (1.0 - view.object.cover) * NOTICED;
        Some(Look {
            chance: told * clear * self.contrast(view.light),
            // At half the distance, stains and old repairs are distinguished from defects with the same probability.
            told_apart: task_performance(NINE_IN_TEN * reach_m / (2.0 * distance_m.max(1.0))),
            every_s: Some(INSPECTION_S),
            taken_for: FindKind::Defect,
            error_m: 0.5,
            merge_within_m: 4.0,
        })
    }

    /// Whether a look from a height finds at least half of all people in the open.
    pub(super) fn shows_persons(&self, height_m: f64, light: Light) -> bool {
        let cycles = PERSON_M / (2.0 * self.pixel_m(height_m));
        task_performance(cycles / DETECT_CYCLES) * self.contrast(light) >= 0.5
    }

    fn contrast(&self, light: Light) -> f64 {
        match (self.band, light) {
            (Band::Visible, Light::Day) | (Band::Thermal, Light::Night) => 1.0,
            (Band::Thermal, Light::Dawn) => 0.9,
            (Band::Visible, Light::Dawn) => 0.6,
            (Band::Thermal, Light::Day) => 0.4,
            (Band::Visible, Light::Night) => 0.05,
        }
    }

    /// The visibility of mines in a light: to a thermal camera, disturbed soil is visible only at dawn and dusk.
    fn mine_light(&self, light: Light) -> f64 {
        match (self.band, light) {
            (Band::Thermal, Light::Day | Light::Night) => 0.0,
            (Band::Thermal, Light::Dawn) => 1.0,
            (Band::Visible, _) => self.contrast(light),
        }
    }

    /// The share of this band's light that passes the smoke, 0 to 1.
    fn transmission(&self, view: &View<'_>) -> f64 {
        match self.band {
            Band::Visible => view.clarity,
            Band::Thermal => maths::powf(view.clarity, SMOKE_IN_INFRARED),
        }
    }
}

/// `x^E / (1 + x^E)`, `E = 2.7 + 0.7 x`.
fn task_performance(x: f64) -> f64 {
    let power = maths::powf(x, 2.7 + 0.7 * x);
    if power.is_finite() {
        power / (1.0 + power)
    } else {
        1.0
    }
}

/// The factor for the lateral offset: 1 up to 0.8, then falling to 0 at 1.
fn lateral(u: f64) -> f64 {
    ((1.0 - u) / 0.2).clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests;
