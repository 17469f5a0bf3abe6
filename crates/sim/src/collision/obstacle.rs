//! Obstacles: buildings, masts, trees.

use glam::{DVec2, DVec3};

use super::from_start;
use crate::Start;
use sortie_geo::LatLon;
use sortie_geo::maths;

/// The side of the cells in which obstacles are looked up, in metres.
const CELL_M: f64 = 16.0;
/// An obstacle that covers more cells than this is checked everywhere.
const CELLS_MAX: f64 = 4096.0;

/// A building, mast or other fixed body that vehicles can hit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Obstacle {
    /// The position of its base's centre.
    pub placement: Placement,
    /// The outline from above, around that position.
    pub shape: Shape,
    /// The height of the obstacle, in metres.
    pub height_m: f64,
}

/// The position of the centre of an obstacle's base.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Placement {
    /// Metres north, east and down from the start of the first vehicle.
    Ned([f64; 3]),
    /// A place on the earth.
    Global {
        /// Latitude and longitude in degrees.
        at: LatLon,
        /// Metres above mean sea level.
        altitude_amsl_m: f64,
    },
}

/// The outline of an obstacle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Shape {
    /// A rectangle: the obstacle is a box.
    Box {
        /// The length of the box, in metres.
        length_m: f64,
        /// The width of the box, in metres.
        width_m: f64,
        /// The direction of its length, degrees clockwise from north.
        heading_deg: f64,
    },
    /// A circle: the obstacle is an upright cylinder.
    Cylinder {
        /// The radius of the cylinder, in metres.
        radius_m: f64,
    },
}

/// The contact of a sphere with a solid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Contact {
    /// The unit vector from the solid to the sphere.
    pub(super) outwards: DVec3,
    pub(super) depth_m: f64,
}

/// An obstacle in the frame of the world.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Solid {
    number: usize,
    foot_m: DVec3,
    height_m: f64,
    outline: ObstacleOutline,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum ObstacleOutline {
    /// Half the length and half the width, and the direction of the length.
    Box(DVec2, DVec2),
    Cylinder(f64),
}

/// All obstacles, by the cells of the ground that they cover.
#[derive(Debug, Clone, Default)]
pub(super) struct Obstacles {
    solids: Vec<Solid>,
    /// Cells of the grid with the solid in each, sorted.
    cells: Vec<((i32, i32), usize)>,
    /// Obstacles that cover too many cells, and are checked everywhere.
    everywhere: Vec<usize>,
}

impl Obstacles {
    /// Sorts the obstacles into cells, leaving out obstacles that have no size or are not on the
    /// earth.
    pub(super) fn new(origin: Option<Start>, obstacles: &[Obstacle], reach_m: f64) -> Self {
        let mut all = Self::default();
        let Some(origin) = origin else {
            return all;
        };
        for (number, obstacle) in obstacles.iter().enumerate() {
            if let Some(solid) = solid(number, obstacle, origin) {
                all.add(solid, reach_m);
            }
        }
        all.cells.sort_unstable();
        all
    }

    pub(super) fn is_empty(&self) -> bool {
        self.solids.is_empty()
    }

    /// The obstacle that a sphere penetrates deepest, by its index in the configuration; `None` if
    /// it touches none.
    pub(super) fn touched(&self, centre: DVec3, radius_m: f64) -> Option<(usize, Contact)> {
        let here = (cell(centre.x), cell(centre.y));
        let first = self.cells.partition_point(|(cell, _)| *cell < here);
        let near = self.cells[first..]
            .iter()
            .take_while(|(cell, _)| *cell == here)
            .map(|(_, solid)| solid);
        near.chain(&self.everywhere)
            .filter_map(|&place| {
                let solid = self.solids.get(place)?;
                Some((solid.number, solid.touch(centre, radius_m)?))
            })
            .max_by(|(_, a), (_, b)| a.depth_m.total_cmp(&b.depth_m))
    }

    fn add(&mut self, solid: Solid, reach_m: f64) {
        let around_m = reach_m
            + match solid.outline {
                ObstacleOutline::Box(half, _) => half.length(),
                ObstacleOutline::Cylinder(radius_m) => radius_m,
            };
        let place = self.solids.len();
        self.solids.push(solid);
        if maths::powi(2.0 * around_m / CELL_M + 1.0, 2) > CELLS_MAX {
            self.everywhere.push(place);
            return;
        }
        let foot = solid.foot_m;
        for north in cell(foot.x - around_m)..=cell(foot.x + around_m) {
            for east in cell(foot.y - around_m)..=cell(foot.y + around_m) {
                self.cells.push(((north, east), place));
            }
        }
    }
}

impl Solid {
    fn touch(&self, centre: DVec3, radius_m: f64) -> Option<Contact> {
        let offset = centre - self.foot_m;
        let up_m = -offset.z;
        if up_m > self.height_m + radius_m || up_m < -radius_m {
            return None;
        }
        // In the solid's own frame: along, across and up from the centre of its base.
        let along = match self.outline {
            ObstacleOutline::Box(_, along) => along,
            ObstacleOutline::Cylinder(_) => DVec2::X,
        };
        let flat = offset.truncate();
        let own = DVec2::new(flat.dot(along), along.perp_dot(flat));
        let (level, top) = match self.outline {
            ObstacleOutline::Box(half, _) => {
                (own.clamp(-half, half), up_m.clamp(0.0, self.height_m))
            }
            ObstacleOutline::Cylinder(most) => {
                (own.clamp_length_max(most), up_m.clamp(0.0, self.height_m))
            }
        };
        let out = (own - level).extend(up_m - top);
        let distance_m = out.length();
        let (outwards, depth_m) = if distance_m > 1e-9 {
            (out / distance_m, radius_m - distance_m)
        } else {
            let (outwards, inside_m) = self.way_out(own, up_m);
            (outwards, radius_m + inside_m)
        };
        let world = along * outwards.x + along.perp() * outwards.y;
        (depth_m > 0.0).then_some(Contact {
            outwards: world.extend(-outwards.z),
            depth_m,
        })
    }

    /// The direction of the shortest way out from inside, never downwards, and its length in
    /// metres.
    fn way_out(&self, own: DVec2, up_m: f64) -> (DVec3, f64) {
        let side = match self.outline {
            ObstacleOutline::Cylinder(radius_m) => {
                let outwards = own.try_normalize().unwrap_or(DVec2::X);
                (outwards.extend(0.0), radius_m - own.length())
            }
            ObstacleOutline::Box(half, _) => {
                let left = half - own.abs();
                if left.x < left.y {
                    (DVec3::X * own.x.signum(), left.x)
                } else {
                    (DVec3::Y * own.y.signum(), left.y)
                }
            }
        };
        let top = (DVec3::Z, self.height_m - up_m);
        if top.1 < side.1 { top } else { side }
    }
}

fn solid(number: usize, obstacle: &Obstacle, origin: Start) -> Option<Solid> {
    let foot_m = match obstacle.placement {
        Placement::Ned(place) => DVec3::from_array(place),
        Placement::Global {
            at,
            altitude_amsl_m,
        } => {
            if !at.is_valid() {
                return None;
            }
            from_start(origin, at, altitude_amsl_m)
        }
    };
    let (outline, sizes) = match obstacle.shape {
        Shape::Box {
            length_m,
            width_m,
            heading_deg,
        } => {
            let along = DVec2::from_angle(heading_deg.to_radians());
            let half = DVec2::new(length_m, width_m) * 0.5;
            if !along.is_finite() {
                return None;
            }
            (ObstacleOutline::Box(half, along), half)
        }
        Shape::Cylinder { radius_m } => {
            (ObstacleOutline::Cylinder(radius_m), DVec2::splat(radius_m))
        }
    };
    let sizes = sizes.extend(obstacle.height_m);
    let sound = foot_m.is_finite() && sizes.is_finite() && sizes.min_element() > 0.0;
    sound.then_some(Solid {
        number,
        foot_m,
        height_m: obstacle.height_m,
        outline,
    })
}

fn cell(metres: f64) -> i32 {
    (metres / CELL_M).floor() as i32
}
