//! Plans for several vehicles from a task: to survey an area, to search, to follow a line, to circle a place.
//!
//! Each vehicle takes off, crosses to its part at a height of its own, flies the part, and returns at the same height
//! to land at home. Parts are cut so that the vehicle that uses the most energy uses as little as possible ([`Pace`]).
//!
//! Within the module, x is metres to the north of the first vehicle's home, y to the east.
//!
//! # How the parts fit
//! - The work: `sweep` (lines over an area), `along` (lanes along a line), `around` (patterns around a place);
//!   `source` makes the task from the shapes of a document.
//! - Which vehicle gets it: `share` divides it by energy, `tour` orders the lines, `layers` chooses the crossing
//!   heights, `field` finds ways inside the fence. `compose` writes the plans.

use glam::DVec2;
use sortie_geo::LatLon;

use crate::effort::{Effort, Pace};
use crate::pattern::NoLanes;
use crate::{Document, Home, Item};

mod along;
mod around;
mod compose;
mod field;
mod layers;
mod share;
pub mod source;
mod sweep;
#[cfg(test)]
mod tests;
mod tour;

use compose::compose;
use field::Field;

/// The distance between two lines, in metres, if neither the task nor a sensor sets one.
pub const USUAL_SPACING_M: f64 = 20.0;
/// The default length of a leg of a sector search, in metres.
pub const USUAL_SECTOR_M: f64 = 100.0;
/// The default number of turns of an orbit.
pub const USUAL_TURNS: u8 = 2;
/// The default height above home, in metres.
pub const USUAL_HEIGHT_M: f64 = 30.0;

/// The joint task of the vehicles.
#[derive(Debug, Clone, PartialEq)]
pub enum Task {
    /// Parallel lines over an area.
    Survey {
        /// The outline; further rings are holes.
        rings: Vec<Vec<LatLon>>,
        /// The largest distance between lines, in metres.
        spacing_m: f64,
        /// The direction of the lines.
        course: Course,
    },
    /// An expanding square from a datum (IAMSAR), in pieces.
    Square {
        /// The most probable position of the search object.
        datum: LatLon,
        /// The distance between the turns, in metres.
        spacing_m: f64,
        /// The distance from the datum to the last turn, in metres.
        radius_m: f64,
    },
    /// A sector search around a datum (IAMSAR); each vehicle flies all of it, rotated and at a height of its own.
    Sector {
        /// The most probable position of the search object.
        datum: LatLon,
        /// The length of a leg, in metres.
        radius_m: f64,
    },
    /// One lane for each vehicle, side by side along a line.
    Line {
        /// The places of the line.
        points: Vec<LatLon>,
        /// The distance between lanes, in metres.
        spacing_m: f64,
    },
    /// Circles around a place, evenly spaced and each at a height of its own.
    Orbit {
        /// The centre of the circles.
        centre: LatLon,
        /// The radius of the circles, in metres.
        radius_m: f64,
        /// The number of turns.
        turns: u8,
    },
}

/// The direction of parallel lines.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Course {
    /// The direction that takes the least energy.
    #[default]
    Best,
    /// Along the longer side (IAMSAR: parallel sweep).
    Long,
    /// Along the shorter side (IAMSAR: creeping line).
    Short,
    /// Degrees clockwise from north.
    Degrees(f64),
}

/// How the vehicles fly.
#[derive(Debug, Clone, PartialEq)]
pub struct Manner {
    /// The height of the work above the first vehicle's home, in metres.
    pub height_m: f64,
    /// The difference between the heights of vehicles that could meet, in metres.
    pub layer_m: f64,
    /// The speed in m/s, if it is not the vehicle's own.
    pub speed_m_s: Option<f64>,
    /// The fence that the vehicles must not leave.
    pub fence: Vec<Item>,
}

/// Why no plans can be generated.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum GenerateError {
    /// There is no vehicle to make a plan for.
    #[error("no vehicle")]
    NoVehicle,
    /// The area has no extent, or the line no length.
    #[error("the area has no extent")]
    Empty,
    /// The area needs more lines than this maximum.
    #[error("more than {0} lines")]
    TooMany(usize),
    /// The lanes of several vehicles are closer together than this, in metres.
    #[error("lanes closer than {0} m")]
    TooNarrow(u32),
    /// The fence is not valid.
    #[error("the fence is not valid")]
    Fence,
    /// The fence leaves nothing of the area, or the pattern breaks it.
    #[error("the pattern crosses the fence")]
    OutsideFence,
    /// No path inside the fence leads from the home of this vehicle (counted from 0) to its part.
    #[error("no way inside the fence for vehicle {0}")]
    NoWay(usize),
}

impl From<NoLanes> for GenerateError {
    fn from(why: NoLanes) -> Self {
        match why {
            NoLanes::Empty => Self::Empty,
            NoLanes::TooMany(most) => Self::TooMany(most),
        }
    }
}

/// The plan of one vehicle.
#[derive(Debug, Clone, PartialEq)]
pub struct Part {
    /// The vehicle, counted from 0.
    pub vehicle: usize,
    /// The vehicle's plan, home and fence.
    pub document: Document,
    /// The distance over the ground from takeoff to landing, in metres.
    pub length_m: f64,
    /// The vehicle's estimated time and energy.
    pub effort: Effort,
    /// The height at which the vehicle crosses, above the first vehicle's home, in metres.
    pub layer_m: f64,
}

/// Why a vehicle has no part.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Idle {
    /// The fence leaves no path from the vehicle's home to the work.
    NoWay,
    /// The vehicle is so far away that its flight there and back takes more energy than any of the
    /// other flights.
    Far,
    /// With the help of this vehicle, the one that uses the most energy would not use noticeably
    /// less.
    Spare,
}

impl Idle {
    /// All reasons, in the order in which they are listed.
    pub const ALL: [Self; 3] = [Self::NoWay, Self::Far, Self::Spare];
}

/// The plans of all vehicles that have a part.
#[derive(Debug, Clone, PartialEq)]
pub struct Generated {
    /// The plans, in the order of the vehicles.
    pub parts: Vec<Part>,
    /// The vehicles without a part, counted from 0, with the reason for each.
    pub idle: Vec<(usize, Idle)>,
    /// The share of the area that is not covered because of the fence, from 0 to 1.
    pub uncovered: f64,
}

impl Generated {
    /// The largest energy of a vehicle as a multiple of the smallest.
    pub fn imbalance(&self) -> f64 {
        let efforts = self.parts.iter().map(|part| part.effort.hover_s);
        let (least, most) = efforts.fold((f64::INFINITY, 0.0f64), |(least, most), it| {
            (least.min(it), most.max(it))
        });
        if least > 0.0 && most > 0.0 {
            most / least
        } else {
            1.0
        }
    }
}

/// A task in the plane.
struct Scene {
    origin: LatLon,
    homes: Vec<DVec2>,
    field: Field,
    pace: Pace,
}

impl Scene {
    fn new(team: &[Home], manner: &Manner) -> Result<Self, GenerateError> {
        let place = |home: &Home| LatLon::from_e7(home.x, home.y);
        let origin = team.first().map(place).ok_or(GenerateError::NoVehicle)?;
        let field = Field::new(&manner.fence, origin)?;
        let usual = Pace::default();
        Ok(Self {
            origin,
            homes: team.iter().map(|home| flat(origin, place(home))).collect(),
            field,
            pace: Pace {
                speed_m_s: manner.speed_m_s.unwrap_or(usual.speed_m_s),
                ..usual
            },
        })
    }

    fn flat(&self, place: LatLon) -> DVec2 {
        flat(self.origin, place)
    }

    fn flat_rings(&self, rings: &[Vec<LatLon>]) -> Vec<Vec<DVec2>> {
        let flat = |ring: &Vec<LatLon>| ring.iter().map(|at| self.flat(*at)).collect();
        rings.iter().map(flat).collect()
    }
}

fn flat(origin: LatLon, place: LatLon) -> DVec2 {
    let (north_m, east_m) = origin.offset_to(place);
    DVec2::new(north_m, east_m)
}

/// The work of one vehicle at one height.
#[derive(Debug, Clone, PartialEq)]
struct Work {
    vehicle: usize,
    points: Vec<DVec2>,
    height_m: f64,
    /// The height at which the vehicle crosses, in metres.
    layer_m: f64,
    circle: Option<Circle>,
}

/// Turns around a place that begin and end at the work's only point.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Circle {
    centre: DVec2,
    radius_m: f64,
    turns: u8,
}

/// Generates plans for the vehicles at these homes.
///
/// # Errors
/// See [`GenerateError`].
pub fn generate(task: &Task, team: &[Home], manner: &Manner) -> Result<Generated, GenerateError> {
    let scene = Scene::new(team, manner)?;
    let works = match task {
        Task::Survey {
            rings,
            spacing_m,
            course,
        } => {
            let lines = sweep::lines(&scene, &scene.flat_rings(rings), *spacing_m, *course)?;
            return shared(&scene, team, manner, &lines, *spacing_m);
        }
        Task::Square {
            datum,
            spacing_m,
            radius_m,
        } => {
            let datum = scene.flat(*datum);
            let lines = around::square(&scene.field, datum, *spacing_m, *radius_m)?;
            return shared(&scene, team, manner, &lines, *spacing_m);
        }
        Task::Sector { datum, radius_m } => {
            around::sectors(&scene, manner, scene.flat(*datum), *radius_m)
        }
        Task::Line { points, spacing_m } => {
            let points: Vec<DVec2> = points.iter().map(|at| scene.flat(*at)).collect();
            along::lanes(&scene, manner, &points, *spacing_m)?
        }
        Task::Orbit {
            centre,
            radius_m,
            turns,
        } => {
            let circle = Circle {
                centre: scene.flat(*centre),
                radius_m: *radius_m,
                turns: *turns,
            };
            around::orbits(&scene, manner, circle)
        }
    };
    checked(&scene, team, manner, &works)
}

/// Plans for lines that are divided among the vehicles.
fn shared(
    scene: &Scene,
    team: &[Home],
    manner: &Manner,
    lines: &sweep::Lines,
    spacing_m: f64,
) -> Result<Generated, GenerateError> {
    let shares = share::works(scene, manner, &lines.ways, spacing_m)?;
    Ok(Generated {
        parts: compose(scene, team, manner, &shares.works)?,
        idle: shares.idle,
        uncovered: lines.uncovered,
    })
}

/// Plans for a pattern that must lie completely inside the fence.
fn checked(
    scene: &Scene,
    team: &[Home],
    manner: &Manner,
    works: &[Work],
) -> Result<Generated, GenerateError> {
    if !works.iter().all(|work| scene.field.holds_work(work)) {
        return Err(GenerateError::OutsideFence);
    }
    Ok(Generated {
        parts: compose(scene, team, manner, works)?,
        idle: Vec::new(),
        uncovered: 0.0,
    })
}
