//! Movers: people, aircraft, and other operators' drones.

use std::time::Duration;

use rand::RngExt as _;
use rand_chacha::ChaCha8Rng;

use crate::geo::maths;
use crate::mission::Point;
use crate::mission::report::distance_m;

/// A person, an aircraft or a drone that an event adds.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Spawn {
    /// Its id in conditions.
    pub id: String,
    pub kind: MoverKind,
    /// The callsign of an aircraft.
    pub callsign: String,
    /// Its path: it moves from point to point and disappears after the last.
    pub path: Vec<Point>,
    pub speed_m_s: f64,
    pub height_m: f64,
    /// The distance that vehicles must keep from the mover.
    pub keep_out_m: f64,
    /// The maximum by which the seed shifts the whole path, on each axis.
    pub jitter_m: f64,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MoverKind {
    Person,
    Aircraft,
    /// A drone that is not part of the mission.
    Intruder,
}

/// A mover on its path.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Mover {
    pub id: String,
    pub kind: MoverKind,
    pub callsign: String,
    pub at: Point,
    pub height_m: f64,
    /// Its velocity in m/s, north and east.
    pub velocity_m_s: [f64; 2],
    pub keep_out_m: f64,
    path: Vec<Point>,
    speed_m_s: f64,
    since: Duration,
}

impl Mover {
    /// A mover at the first point of its path.
    pub fn new(spawn: &Spawn, now: Duration, random: &mut ChaCha8Rng) -> Self {
        let mut drawn = || random.random_range(-1.0..=1.0) * spawn.jitter_m;
        let shift = [drawn(), drawn()];
        let moved = |point: &Point| [point[0] + shift[0], point[1] + shift[1]];
        let path: Vec<Point> = spawn.path.iter().map(moved).collect();
        Self {
            id: spawn.id.clone(),
            kind: spawn.kind,
            callsign: spawn.callsign.clone(),
            at: path.first().copied().unwrap_or_default(),
            height_m: spawn.height_m,
            velocity_m_s: [0.0; 2],
            keep_out_m: spawn.keep_out_m,
            path,
            speed_m_s: spawn.speed_m_s,
            since: now,
        }
    }

    /// Advances to a mission time; false once it has reached the end of its path.
    pub fn step(&mut self, now: Duration) -> bool {
        let mut left_m = now.saturating_sub(self.since).as_secs_f64() * self.speed_m_s;
        for leg in self.path.windows(2) {
            let length_m = distance_m(leg[0], leg[1]);
            if left_m < length_m {
                let share = left_m / length_m;
                let along = |axis: usize| leg[0][axis] + (leg[1][axis] - leg[0][axis]) * share;
                self.at = [along(0), along(1)];
                let ahead = |axis: usize| (leg[1][axis] - leg[0][axis]) / length_m * self.speed_m_s;
                self.velocity_m_s = [ahead(1), ahead(0)];
                return true;
            }
            left_m -= length_m;
        }
        self.at = self.path.last().copied().unwrap_or(self.at);
        false
    }

    /// The mover's distance from a place, in metres: horizontal for a person, in three dimensions
    /// for an aircraft or an intruder.
    pub fn distance_m(&self, [east_m, north_m, up_m]: [f64; 3]) -> f64 {
        let flat = distance_m(self.at, [east_m, north_m]);
        match self.kind {
            MoverKind::Person => flat,
            MoverKind::Aircraft | MoverKind::Intruder => maths::hypot(flat, up_m - self.height_m),
        }
    }
}
