//! Vehicles that touch each other or an obstacle.
//!
//! After every step of the world, its vehicles are put into a grid, so the cost grows linearly with
//! their number, not quadratically. Vehicles are spheres. The result depends only on the state
//! after the step, not on the order of processing.

mod grid;
mod obstacle;
#[cfg(test)]
mod tests;

use std::time::Duration;

use glam::DVec3;

use self::grid::CollisionGrid;
use self::obstacle::{Contact, Obstacles};
pub use self::obstacle::{Obstacle, Placement, Shape};
use super::Start;
use super::autopilot::Autopilot;
use super::body::Body;
use sortie_geo::LatLon;

/// Up to this many bodies, checking every pair is faster than a grid.
const FEW: usize = 16;
/// The largest radius of a vehicle, in metres; larger ones are reduced to it.
const RADIUS_MAX_M: f64 = 5.0;
const RESTITUTION: f64 = 0.3;
/// A vehicle that descends on an obstacle at less than this speed, in m/s, lands on it undamaged.
const LANDING_M_S: f64 = 1.0;
/// The minimum vertical component of the surface normal for such a landing.
const LANDING_SLOPE: f64 = 0.7;

/// A collision that caused damage.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Collision {
    /// Simulated time since the world began.
    pub at: Duration,
    /// The vehicle, from 0; the first one of two vehicles.
    pub vehicle: usize,
    /// The object that the vehicle hit: an obstacle or another vehicle.
    pub with: Met,
    /// The position of the vehicle.
    pub place: LatLon,
    /// The vehicle's altitude, metres above mean sea level.
    pub altitude_amsl_m: f64,
    /// The relative speed, in metres per second.
    pub speed_m_s: f64,
}

/// The object that a vehicle collided with.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Met {
    /// Another vehicle, counted from 0.
    Vehicle(usize),
    /// An obstacle, counted from 0 in the order of the configuration.
    Obstacle(usize),
}

/// The effect of a collision on a vehicle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Hit {
    pub(super) vehicle: usize,
    pub(super) change_m_s: DVec3,
    /// The shift out of the obstacle, in metres.
    pub(super) shift_m: DVec3,
    pub(super) breaks: bool,
}

/// A vehicle's sphere, in the frame of the world.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Ball {
    centre_m: DVec3,
    velocity_m_s: DVec3,
    radius_m: f64,
    mass_kg: f64,
    in_air: bool,
    wrecked: bool,
}

impl Ball {
    fn touches(&self, other: &Self) -> bool {
        let reach_m = self.radius_m + other.radius_m;
        self.centre_m.distance_squared(other.centre_m) < reach_m * reach_m
    }
}

/// What stays the same about a vehicle: kept here, so that the check after each step reads only its moving body.
#[derive(Debug, Clone)]
struct VehicleFrame {
    start: Start,
    /// The start, relative to the first vehicle's.
    offset_m: DVec3,
    radius_m: f64,
    mass_kg: f64,
}

/// The collisions of a world.
#[derive(Debug, Clone, Default)]
pub(super) struct Collisions {
    obstacles: Obstacles,
    frames: Vec<VehicleFrame>,
    balls: Vec<Ball>,
    grid: CollisionGrid,
    pairs: Vec<(u32, u32)>,
    hits: Vec<Hit>,
    events: Vec<Collision>,
}

impl Collisions {
    /// No vehicles yet; obstacles may be placed relative to the world's origin.
    pub(super) fn new(origin: Option<Start>, obstacles: &[Obstacle]) -> Self {
        Self {
            obstacles: Obstacles::new(origin, obstacles, RADIUS_MAX_M),
            frames: Vec::new(),
            ..Self::default()
        }
    }

    /// The collisions so far, in order.
    pub(super) fn events(&self) -> &[Collision] {
        &self.events
    }

    /// Checks all vehicles after a step; returns the effects by vehicle.
    pub(super) fn find<'a>(
        &mut self,
        now: Duration,
        vehicles: impl ExactSizeIterator<Item = &'a Autopilot>,
    ) -> &[Hit] {
        self.hits.clear();
        if vehicles.len() < 2 && self.obstacles.is_empty() {
            return &self.hits;
        }
        self.balls.clear();
        let mut flying = false;
        for (vehicle, autopilot) in vehicles.enumerate() {
            let ball = self.ball(vehicle, autopilot);
            flying |= ball.in_air;
            self.balls.push(ball);
        }
        if flying {
            self.meet(now);
        }
        &self.hits
    }

    fn ball(&mut self, vehicle: usize, autopilot: &Autopilot) -> Ball {
        if vehicle == self.frames.len() {
            let frame = self.frame(autopilot);
            self.frames.push(frame);
        }
        let frame = &self.frames[vehicle];
        let body = &autopilot.vehicle.plant.body;
        Ball {
            centre_m: frame.offset_m + body.position_m - DVec3::Z * frame.radius_m,
            velocity_m_s: body.velocity_m_s,
            radius_m: frame.radius_m,
            mass_kg: frame.mass_kg,
            in_air: !body.on_ground,
            wrecked: body.wrecked,
        }
    }

    fn frame(&self, autopilot: &Autopilot) -> VehicleFrame {
        let airframe = &autopilot.vehicle.plant.airframe;
        let start = autopilot.vehicle.datum.start;
        let origin = self.frames.first().map_or(start, |first| first.start);
        VehicleFrame {
            start,
            offset_m: from_start(origin, start.at, start.altitude_amsl_m),
            radius_m: (0.5 * airframe.size_m()).min(RADIUS_MAX_M),
            mass_kg: airframe.mass_kg(),
        }
    }

    fn meet(&mut self, now: Duration) {
        self.find_pairs();
        let pairs = std::mem::take(&mut self.pairs);
        for &(first, second) in &pairs {
            self.meet_vehicle(now, first as usize, second as usize);
        }
        self.pairs = pairs;
        if !self.obstacles.is_empty() {
            for vehicle in 0..self.balls.len() {
                self.meet_obstacles(now, vehicle);
            }
        }
    }

    /// The pairs that touch, at least one of them in the air, in ascending order.
    fn find_pairs(&mut self) {
        let (balls, pairs) = (&self.balls, &mut self.pairs);
        pairs.clear();
        if balls.len() <= FEW {
            for (second, other) in balls.iter().enumerate() {
                for (first, ball) in balls[..second].iter().enumerate() {
                    if (ball.in_air || other.in_air) && ball.touches(other) {
                        pairs.push((first as u32, second as u32));
                    }
                }
            }
            pairs.sort_unstable();
            return;
        }
        self.grid.fill(balls.iter().map(|ball| ball.centre_m));
        let largest_m = balls
            .iter()
            .fold(0.0, |most: f64, ball| most.max(ball.radius_m));
        for (first, ball) in balls.iter().enumerate().filter(|(_, ball)| ball.in_air) {
            self.grid
                .near(ball.centre_m, ball.radius_m + largest_m, |second| {
                    let other = &balls[second];
                    // If both are in the air, the one with the lower number finds the pair.
                    if second == first || (other.in_air && second < first) {
                        return;
                    }
                    if ball.touches(other) {
                        pairs.push((first.min(second) as u32, first.max(second) as u32));
                    }
                });
        }
        pairs.sort_unstable();
    }

    fn meet_vehicle(&mut self, now: Duration, first: usize, second: usize) {
        let (one, two) = (self.balls[first], self.balls[second]);
        let between = one.centre_m - two.centre_m;
        let apart = between.try_normalize().unwrap_or(DVec3::NEG_Z);
        let approach = two.velocity_m_s - one.velocity_m_s;
        let closing_m_s = approach.dot(apart);
        if closing_m_s <= 0.0 {
            return;
        }
        let push = apart * (closing_m_s * (1.0 + RESTITUTION) / (one.mass_kg + two.mass_kg));
        for (vehicle, change_m_s) in [(first, push * two.mass_kg), (second, -push * one.mass_kg)] {
            self.hits.push(Hit {
                vehicle,
                change_m_s,
                shift_m: DVec3::ZERO,
                breaks: true,
            });
        }
        if !(one.wrecked && two.wrecked) {
            self.note(now, first, Met::Vehicle(second), approach.length());
        }
    }

    fn meet_obstacles(&mut self, now: Duration, vehicle: usize) {
        let ball = self.balls[vehicle];
        if !ball.in_air {
            return;
        }
        let Some((obstacle, Contact { outwards, depth_m })) =
            self.obstacles.touched(ball.centre_m, ball.radius_m)
        else {
            return;
        };
        let closing_m_s = -ball.velocity_m_s.dot(outwards);
        let stands = closing_m_s < LANDING_M_S && outwards.z < -LANDING_SLOPE;
        let bounce = if stands { 0.0 } else { RESTITUTION };
        self.hits.push(Hit {
            vehicle,
            change_m_s: outwards * (closing_m_s.max(0.0) * (1.0 + bounce)),
            shift_m: outwards * depth_m,
            breaks: !stands,
        });
        if !stands && !ball.wrecked {
            let speed_m_s = ball.velocity_m_s.length();
            self.note(now, vehicle, Met::Obstacle(obstacle), speed_m_s);
        }
    }

    fn note(&mut self, at: Duration, vehicle: usize, with: Met, speed_m_s: f64) {
        let VehicleFrame {
            start, offset_m, ..
        } = self.frames[vehicle];
        let ball = self.balls[vehicle];
        let own = ball.centre_m + DVec3::Z * ball.radius_m - offset_m;
        self.events.push(Collision {
            at,
            vehicle,
            with,
            place: start.at.moved(own.x, own.y),
            altitude_amsl_m: start.altitude_amsl_m - own.z,
            speed_m_s,
        });
    }
}

impl Body {
    pub(super) fn take(&mut self, hit: &Hit) {
        self.position_m += hit.shift_m;
        if hit.breaks {
            self.hit(hit.change_m_s);
        } else {
            self.velocity_m_s += hit.change_m_s;
        }
    }
}

/// A place in metres north, east and down from a start.
fn from_start(start: Start, at: LatLon, altitude_amsl_m: f64) -> DVec3 {
    let (north, east) = start.at.offset_to(at);
    DVec3::new(north, east, start.altitude_amsl_m - altitude_amsl_m)
}
