//! The movement of a formation as one rigid body.
//!
//! Its first place moves along a straight path, and all other places with it, so vehicles in their
//! places keep their distances. Unless its heading is fixed, the formation first turns onto the
//! course, no faster than its outermost place can follow; then it accelerates, moves and brakes. It
//! waits for a member that falls behind.

use std::f64::consts::PI;
use std::time::Duration;

use glam::{DVec2, DVec3};

use super::geometry::MovingPoint;
use super::slots::slots;
use crate::commands::Shape;
use crate::geo::maths;

/// The default speed of a formation, within the capability of every common multirotor.
const SPEED_M_S: f64 = 5.0;
/// Vertical speeds, below the autopilots' default limits (ArduCopter: 2.5 up, 1.5 down).
const CLIMB_M_S: f64 = 1.2;
const ACCELERATION_M_S2: f64 = 1.0;
/// The greatest speed of the outermost place while the formation turns.
const TURN_M_S: f64 = 3.0;
const TURN_MOST_RAD_S: f64 = 0.5;
/// A member this far from its place slows the formation down; [`LAG_RANGE_M`] further, it stops the formation.
const LAG_M: f64 = 2.5;
const LAG_RANGE_M: f64 = 4.0;
/// A path shorter than this needs no turn.
const NO_TURN_M: f64 = 2.0;
/// Courses with a smaller difference count as the same.
const SAME_COURSE_RAD: f64 = 0.01;
/// Longer intervals between two steps are shortened to this, so that the places do not get too far
/// ahead of the vehicles.
const LONGEST_STEP_S: f64 = 0.5;

/// A formation, and its current position.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct March {
    pub shape: Shape,
    pub spacing_m: f64,
    /// Whether the formation keeps its heading.
    pub keeps_facing: bool,
    /// The formation's heading, in radians clockwise from north.
    pub facing_rad: f64,
    /// The position of the formation's first place.
    pub anchor: DVec3,
    /// The destination of the first place.
    pub goal: Option<DVec3>,
    speed_m_s: f64,
    velocity: DVec3,
    turn_rad_s: f64,
    slots: Vec<DVec2>,
    stepped: Option<Duration>,
}

impl March {
    pub fn new(shape: Shape, spacing_m: f64, anchor: DVec3, facing_deg: f64) -> Self {
        Self {
            shape,
            spacing_m,
            keeps_facing: false,
            facing_rad: facing_deg.to_radians(),
            anchor,
            goal: None,
            speed_m_s: SPEED_M_S,
            velocity: DVec3::ZERO,
            turn_rad_s: 0.0,
            slots: Vec::new(),
            stepped: None,
        }
    }

    /// Sets the speed to that commanded to the leader; `None` sets the default.
    pub fn pace(&mut self, asked_m_s: Option<f64>) {
        self.speed_m_s = asked_m_s.unwrap_or(SPEED_M_S);
    }

    /// Assigns the places: `order` gives each vehicle's place.
    pub fn seat(&mut self, order: &[usize]) {
        let all = slots(self.shape, order.len(), self.spacing_m);
        self.slots = order.iter().map(|&slot| all[slot]).collect();
        self.halt();
    }

    fn halt(&mut self) {
        (self.velocity, self.turn_rad_s) = (DVec3::ZERO, 0.0);
        self.stepped = None;
    }

    /// All places of the shape, before their assignment.
    pub fn places(&self, count: usize) -> Vec<DVec3> {
        let slots = slots(self.shape, count, self.spacing_m);
        slots.into_iter().map(|slot| self.at(slot)).collect()
    }

    /// A vehicle's place, and its velocity.
    pub fn place(&self, index: usize) -> MovingPoint {
        let slot = self.slots.get(index).copied().unwrap_or_default();
        let arm = DVec2::from_angle(self.facing_rad).rotate(slot);
        let swing = arm.perp() * self.turn_rad_s;
        MovingPoint {
            at: self.at(slot),
            velocity_m_s: self.velocity + swing.extend(0.0),
        }
    }

    fn at(&self, slot: DVec2) -> DVec3 {
        let arm = DVec2::from_angle(self.facing_rad).rotate(slot);
        self.anchor + arm.extend(0.0)
    }

    /// Advances by one step; `lag_m` is the greatest distance of a member from its place.
    pub fn step(&mut self, now: Duration, lag_m: f64) {
        let before = self.stepped.replace(now).unwrap_or(now);
        let step_s = now.saturating_sub(before).as_secs_f64().min(LONGEST_STEP_S);
        let Some(goal) = self.goal else {
            self.velocity = DVec3::ZERO;
            self.turn_rad_s = 0.0;
            return;
        };
        let pace = (1.0 - (lag_m - LAG_M) / LAG_RANGE_M).clamp(0.0, 1.0);
        if !self.turn(goal, step_s, pace) {
            self.advance(goal, step_s, pace);
        }
    }

    /// Turns onto the course; returns `false` once that is done.
    fn turn(&mut self, goal: DVec3, step_s: f64, pace: f64) -> bool {
        let way = (goal - self.anchor).truncate();
        let wanted = maths::atan2(way.y, way.x);
        let off = (wanted - self.facing_rad + PI).rem_euclid(2.0 * PI) - PI;
        let is_there = off.abs() < SAME_COURSE_RAD;
        if self.keeps_facing || is_there || way.length() < NO_TURN_M {
            self.turn_rad_s = 0.0;
            return false;
        }
        let reach_m = self
            .slots
            .iter()
            .map(|slot| slot.length())
            .fold(1.0, f64::max);
        let rate = (TURN_M_S / reach_m).min(TURN_MOST_RAD_S) * pace;
        let turned = off.clamp(-rate * step_s, rate * step_s);
        self.facing_rad += turned;
        self.turn_rad_s = rate.copysign(off);
        self.velocity = DVec3::ZERO;
        true
    }

    fn advance(&mut self, goal: DVec3, step_s: f64, pace: f64) {
        let way = goal - self.anchor;
        let left_m = way.length();
        let direction = way.normalize_or_zero();
        let climbs = CLIMB_M_S / direction.z.abs().max(1e-6);
        let brakes = (2.0 * ACCELERATION_M_S2 * left_m).sqrt();
        let faster = self.velocity.length() + ACCELERATION_M_S2 * step_s;
        let speed = faster.min(self.speed_m_s.min(climbs) * pace).min(brakes);
        // Braking alone would never end: the last centimetres are flown in one step.
        if left_m <= (speed * step_s).max(0.05) {
            self.anchor = goal;
            self.goal = None;
            self.velocity = DVec3::ZERO;
        } else {
            self.anchor += direction * speed * step_s;
            self.velocity = direction * speed;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn march(shape: Shape) -> March {
        let mut march = March::new(shape, 10.0, DVec3::new(0.0, 0.0, 20.0), 0.0);
        march.seat(&[0, 1, 2, 3, 4]);
        march
    }

    /// Steps ten times a second until the formation stops; returns the time.
    fn go(march: &mut March, mut look: impl FnMut(&March)) -> f64 {
        for step in 0..10_000u64 {
            march.step(Duration::from_millis(step * 100), 0.0);
            look(march);
            if march.goal.is_none() {
                return step as f64 / 10.0;
            }
        }
        panic!("never there");
    }

    #[test]
    fn a_formation_keeps_its_distances_while_it_turns_and_moves() {
        for shape in [Shape::Line, Shape::Wedge, Shape::Circle] {
            let mut march = march(shape);
            march.goal = Some(DVec3::new(-80.0, 60.0, 30.0));
            let apart = |march: &March, a, b| march.place(a).at.distance(march.place(b).at);
            let at_first = apart(&march, 1, 4);
            go(&mut march, |march| {
                assert!((apart(march, 1, 4) - at_first).abs() < 1e-9);
            });
            assert!((march.place(0).at - DVec3::new(-80.0, 60.0, 30.0)).length() < 1e-9);
        }
    }

    /// 100 m at 5 m/s takes 20 s; accelerating and braking with 1 m/s² add 5 s.
    #[test]
    fn a_way_takes_as_long_as_speed_and_acceleration_say() {
        let mut march = march(Shape::Column);
        march.goal = Some(DVec3::new(100.0, 0.0, 20.0));
        let took_s = go(&mut march, |_| {});
        assert!((24.5..26.5).contains(&took_s), "{took_s}");
    }

    #[test]
    fn the_speed_of_a_place_is_how_fast_it_moves() {
        let mut march = march(Shape::Line);
        march.goal = Some(DVec3::new(0.0, 90.0, 20.0));
        let mut before: Option<[MovingPoint; 2]> = None;
        let mut fastest = 0.0f64;
        go(&mut march, |march| {
            let places = [march.place(1), march.place(4)];
            if let Some(before) = before {
                for (then, now) in before.iter().zip(places) {
                    let moved = (now.at - then.at) / 0.1;
                    fastest = fastest.max(moved.length());
                    assert!((moved - now.velocity_m_s).length() < 1.0, "{moved} {now:?}");
                }
            }
            before = Some(places);
        });
        assert!(fastest <= SPEED_M_S + 1e-6, "{fastest}");
    }

    #[test]
    fn a_formation_that_faces_one_way_does_not_turn_and_one_that_lags_stands() {
        let mut march = march(Shape::Line);
        march.keeps_facing = true;
        march.goal = Some(DVec3::new(0.0, 50.0, 20.0));
        go(&mut march, |march| assert!(march.facing_rad.abs() < 1e-9));
        march.goal = Some(DVec3::new(50.0, 50.0, 20.0));
        let before = march.anchor;
        for step in 0..100u64 {
            march.step(Duration::from_millis(step * 100), LAG_M + LAG_RANGE_M);
        }
        assert_eq!(march.anchor, before);
    }
}
