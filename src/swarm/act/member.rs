//! One vehicle's part in a manoeuvre.

use std::time::Duration;

use glam::DVec3;

use super::{MOVING_EVERY, SAME_POINT_M, STANDING_EVERY};
use crate::ledger::RowState;
use crate::swarm::geometry::length_m;
use crate::vehicle::VehicleId;

#[derive(Debug, Clone)]
pub(in crate::swarm) struct Member {
    pub id: VehicleId,
    /// The position at the start.
    pub from: DVec3,
    /// The height at which the vehicle crosses, in metres.
    pub layer_m: f64,
    /// The position where the work begins.
    pub to: DVec3,
    /// The path to fly during the work.
    pub course: Vec<DVec3>,
    /// The index of the next point of the course.
    pub next: usize,
    pub standing: Standing,
}

/// The state of a member: its row, its last setpoint, and whether it is lost or waits.
#[derive(Debug, Clone, Default)]
pub(in crate::swarm) struct Standing {
    /// The longest remaining distance so far.
    pub most_m: f64,
    pub percent: u8,
    /// Whether the member's row has ended.
    pub is_done: bool,
    pub(super) told: Option<(Duration, DVec3)>,
    pub(super) lost_since: Option<Duration>,
    /// The position where the member waits, and the vehicle that it waits for.
    pub(super) waits: Option<(DVec3, VehicleId)>,
}

impl Member {
    pub fn new(id: VehicleId, from: DVec3, to: DVec3) -> Self {
        Self {
            id,
            from,
            layer_m: to.z,
            to,
            course: Vec::new(),
            next: 0,
            standing: Standing::default(),
        }
    }

    /// The remaining distance from a position.
    pub(super) fn left_m(&self, phase: Phase, at: DVec3) -> f64 {
        let layer = |point: DVec3| point.truncate().extend(self.layer_m);
        let mut points = vec![at];
        if phase <= Phase::Rise {
            points.push(layer(self.from));
        }
        if phase <= Phase::Cross {
            points.push(layer(self.to));
        }
        if phase <= Phase::Sink {
            points.push(self.to);
        }
        points.extend(self.course.iter().skip(self.next));
        length_m(&points)
    }
}

/// The phase of a manoeuvre.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(in crate::swarm) enum Phase {
    /// Each member climbs or descends to its height in place.
    Rise,
    /// Each member crosses at its height.
    Cross,
    /// Each member climbs or descends to the height where its work begins.
    Sink,
    Work,
}

impl Phase {
    pub(super) fn next(self) -> Self {
        match self {
            Self::Rise => Self::Cross,
            Self::Cross => Self::Sink,
            Self::Sink | Self::Work => Self::Work,
        }
    }
}

impl Standing {
    /// Whether a setpoint must be sent (again).
    pub(super) fn is_due(&mut self, point: DVec3, is_moving: bool, now: Duration) -> bool {
        let every = if is_moving {
            MOVING_EVERY
        } else {
            STANDING_EVERY
        };
        let is_due = self.told.is_none_or(|(at, told)| {
            let is_new = !is_moving && told.distance(point) > SAME_POINT_M;
            is_new || now.saturating_sub(at) >= every
        });
        if is_due {
            self.told = Some((now, point));
        }
        is_due
    }

    /// The row's new state, if it has changed.
    pub(super) fn news(&mut self, left_m: f64, is_done: bool) -> Option<RowState> {
        if self.is_done {
            return None;
        }
        if is_done {
            self.is_done = true;
            return Some(RowState::Done);
        }
        self.most_m = self.most_m.max(left_m);
        let flown = 1.0 - left_m / self.most_m.max(1.0);
        let percent = (flown * 100.0).clamp(0.0, 99.0) as u8;
        let is_more = percent > self.percent;
        self.percent = self.percent.max(percent);
        is_more.then_some(RowState::InProgress(percent))
    }
}
