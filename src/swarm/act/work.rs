//! The work of a manoeuvre once all vehicles are in place, and its progress.

use glam::DVec3;

use super::{ActiveManoeuvre, IN_PLACE_M, Member, Phase, StepOutcome, Work, WorldView, is_reached};
use crate::ledger::{RowState, RowUpdate};
use crate::swarm::geometry::MovingPoint;
use crate::swarm::site::moving;
use crate::text::Text;
use crate::vehicle::VehicleId;

/// A row of vehicles that follow another one.
#[derive(Debug, Clone)]
pub(in crate::swarm) struct Tail {
    pub leader: VehicleId,
    pub distance_m: f64,
    /// The height of the first follower above home; `None` if heights are relative to the leader.
    pub up_m: Option<f64>,
    /// The difference in height between one follower and the next.
    pub step_m: f64,
    /// The place of each member, with its velocity.
    pub places: Vec<MovingPoint>,
}

/// A chain of vehicles between home and another vehicle.
#[derive(Debug, Clone)]
pub(in crate::swarm) struct Chain {
    pub from: DVec3,
    pub to: VehicleId,
    /// Each member's share of the distance from home.
    pub shares: Vec<f64>,
    pub places: Vec<MovingPoint>,
}

impl ActiveManoeuvre {
    /// A working member's setpoint, and its velocity.
    pub(super) fn work_aim(&self, member: &Member, index: usize) -> MovingPoint {
        let stand = MovingPoint::still(member.to);
        match &self.work {
            Work::Courses { .. } => {
                let point = member.course.get(member.next).or(member.course.last());
                point.copied().map_or(stand, MovingPoint::still)
            }
            Work::Formation(march) => march.place(index),
            Work::Follow(tail) => tail.places.get(index).copied().unwrap_or(stand),
            Work::Chain(chain) => chain.places.get(index).copied().unwrap_or(stand),
        }
    }

    pub(super) fn work(&mut self, view: &WorldView<'_>) {
        if self.phase < Phase::Work {
            return;
        }
        let points: Vec<Option<DVec3>> = self
            .members
            .iter()
            .map(|member| self.point(member.id, view))
            .collect();
        let heard_at = |id: VehicleId| {
            let vehicle = view.vehicles.get(&id).filter(|it| !it.link.lost)?;
            moving(&self.site, vehicle)
        };
        match &mut self.work {
            Work::Courses { .. } => {
                for (member, at) in self.members.iter_mut().zip(points) {
                    let aim = member.course.get(member.next);
                    if at.zip(aim).is_some_and(|(at, &aim)| is_reached(at, aim)) {
                        member.next += 1;
                    }
                }
            }
            Work::Formation(march) => {
                let places = (0..points.len()).map(|index| march.place(index).at);
                let lag_m = points
                    .iter()
                    .zip(places)
                    .filter_map(|(at, place)| Some((*at)?.distance(place)))
                    .fold(0.0, f64::max);
                march.step(view.now, lag_m);
            }
            Work::Follow(tail) => {
                if let Some(leader) = heard_at(tail.leader) {
                    tail.follow(leader, &points);
                }
            }
            Work::Chain(chain) => {
                if let Some(end) = heard_at(chain.to) {
                    chain.stretch(end, &points);
                }
            }
        }
    }

    /// Reports the progress of each member.
    pub(super) fn tell(&mut self, view: &WorldView<'_>, outcome: &mut StepOutcome) {
        let all_in_place = self.phase == Phase::Work
            && self.members.iter().enumerate().all(|(index, member)| {
                let place = self.aim(member, index).at;
                let at = self.point(member.id, view);
                at.is_some_and(|at| at.distance(place) <= IN_PLACE_M)
            });
        for index in 0..self.members.len() {
            let member = &self.members[index];
            let Some(at) = self.point(member.id, view) else {
                continue;
            };
            let left_m = member.left_m(self.phase, at);
            let is_done = match self.work {
                Work::Courses { .. } => {
                    self.phase == Phase::Work && member.next >= member.course.len()
                }
                Work::Formation(_) | Work::Follow(_) | Work::Chain(_) => all_in_place,
            };
            // A course counts from its first line: the path to that line is not part of the work.
            let counts = self.phase == Phase::Work || !matches!(self.work, Work::Courses { .. });
            let standing = &mut self.members[index].standing;
            if counts && let Some(state) = standing.news(left_m, is_done) {
                outcome.rows.push(self.row(index, state, view));
            }
        }
        self.tell_move(all_in_place, view, outcome);
        if matches!(self.work, Work::Courses { .. }) {
            // Members that are done are free for other tasks.
            self.members.retain(|member| !member.standing.is_done);
        }
    }

    fn row(&self, index: usize, state: RowState, view: &WorldView<'_>) -> RowUpdate {
        RowUpdate {
            entry: self.entry,
            vehicle: self.members[index].id,
            state,
            tries: 1,
            at: view.now,
            explanation: None,
        }
    }

    fn tell_move(&mut self, all_in_place: bool, view: &WorldView<'_>, outcome: &mut StepOutcome) {
        let (Work::Formation(march), Some(moving)) = (&self.work, &mut self.moving) else {
            return;
        };
        let Some(goal) = march.goal else {
            if all_in_place {
                self.end_move(RowState::Done, None, view.now, &mut outcome.rows);
            }
            return;
        };
        let flown = 1.0 - march.anchor.distance(goal) / moving.way_m.max(1.0);
        let percent = (flown * 100.0).clamp(0.0, 99.0) as u8;
        if percent > moving.percent {
            moving.percent = percent;
            outcome
                .rows
                .extend(moving.who.iter().map(|&vehicle| RowUpdate {
                    entry: moving.entry,
                    vehicle,
                    state: RowState::InProgress(percent),
                    tries: 1,
                    at: view.now,
                    explanation: None,
                }));
        }
    }

    /// Ends the rows of members that were to move with the formation.
    pub(super) fn end_move(
        &mut self,
        state: RowState,
        why: Option<&Text>,
        at: std::time::Duration,
        rows: &mut Vec<RowUpdate>,
    ) {
        let Some(moving) = self.moving.take() else {
            return;
        };
        rows.extend(moving.who.iter().map(|&vehicle| RowUpdate {
            entry: moving.entry,
            vehicle,
            state,
            tries: 1,
            at,
            explanation: why.cloned(),
        }));
    }
}

impl Tail {
    /// Moves the followers as if on a rope: they do not swing out when the leader turns, and a
    /// follower closer than the rope's length backs away. A step in height keeps them apart where
    /// the leader turns back.
    pub fn follow(&mut self, leader: MovingPoint, points: &[Option<DVec3>]) {
        let mut ahead = leader;
        for (index, at) in points.iter().enumerate() {
            let known = self.places.get(index).map(|place| place.at);
            let from = known.or(*at).unwrap_or(ahead.at);
            let rope = (from - ahead.at).truncate();
            let direction = rope.try_normalize().unwrap_or(glam::DVec2::NEG_X);
            let level = match self.up_m {
                Some(up_m) => up_m + self.step_m * index as f64,
                None => leader.at.z + self.step_m * (index + 1) as f64,
            };
            let place = (ahead.at.truncate() + direction * self.distance_m).extend(level);
            // A rope transmits only the velocity along it.
            let pull = direction * ahead.velocity_m_s.truncate().dot(direction);
            let climb_m_s = if self.up_m.is_none() {
                leader.velocity_m_s.z
            } else {
                0.0
            };
            ahead = MovingPoint {
                at: place,
                velocity_m_s: pull.extend(climb_m_s),
            };
            match self.places.get_mut(index) {
                Some(known) => *known = ahead,
                None => self.places.push(ahead),
            }
        }
    }
}

impl Chain {
    fn stretch(&mut self, end: MovingPoint, points: &[Option<DVec3>]) {
        let way = (end.at - self.from).truncate();
        let places = self
            .shares
            .iter()
            .zip(points)
            .map(|(&share, _)| MovingPoint {
                at: (self.from.truncate() + way * share).extend(self.from.z),
                velocity_m_s: (end.velocity_m_s.truncate() * share).extend(0.0),
            });
        self.places = places.collect();
    }
}
