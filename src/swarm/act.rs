//! A manoeuvre under way.

use std::time::Duration;

use glam::{DVec2, DVec3};

use super::geometry::MovingPoint;
use super::guard::is_in_the_way;
use super::lanes::Lane;
use super::march::March;
use super::site::{Site, moving};
use super::{FormationGoal, Ordered, Path, Rules, StepOutcome};
use crate::commands::Setpoint;
use crate::ledger::{EntryId, RowState, RowUpdate};
use crate::notice::Notice;
use crate::pilot_in_command::PilotsInCommand;
use crate::session::Steering;
use crate::text;
use crate::text::Text;
use crate::vehicle::{Severity, Vehicle, VehicleId, Vehicles};
use crate::verb::Verb;

mod fate;
mod member;
pub(super) mod places;
mod work;

pub(super) use member::{Member, Phase};
pub(super) use work::{Chain, Tail};

/// The interval at which a fixed setpoint is repeated, in case one was lost.
const STANDING_EVERY: Duration = Duration::from_secs(1);
/// The interval between moving setpoints (ArduCopter stops 3 s after the last one, `GUID_TIMEOUT`).
const MOVING_EVERY: Duration = Duration::from_millis(200);
/// A setpoint slower than this counts as fixed.
const STANDING_M_S: f64 = 0.05;
/// A setpoint that has moved this far counts as a new one.
const SAME_POINT_M: f64 = 0.2;
/// The horizontal and vertical distances at which a point counts as reached.
const REACHED_ASIDE_M: f64 = 0.8;
const REACHED_ABOVE_M: f64 = 0.7;
/// The distance at which a vehicle of a moving formation counts as in its place.
const IN_PLACE_M: f64 = 2.0;

/// The time, the vehicles with their pilots, and the rules for one step of a manoeuvre.
#[derive(Debug, Clone, Copy)]
pub(super) struct WorldView<'a> {
    pub now: Duration,
    pub vehicles: &'a Vehicles,
    pub pilots: &'a PilotsInCommand,
    pub rules: Rules,
}

/// The work once all members are in place.
#[derive(Debug, Clone)]
pub(super) enum Work {
    /// Each member flies its course and is done at its end. Lanes are pairs of points, and other
    /// members can take them over.
    Courses {
        /// Whether the courses are lanes.
        lanes: bool,
    },
    /// All members keep their places in a formation.
    Formation(March),
    /// Each member follows the vehicle ahead of it.
    Follow(Tail),
    /// Each member keeps its place between home and a vehicle.
    Chain(Chain),
}

/// A formation's order to move.
#[derive(Debug, Clone)]
struct Move {
    entry: EntryId,
    who: Vec<VehicleId>,
    way_m: f64,
    percent: u8,
}

/// A manoeuvre under way.
#[derive(Debug, Clone)]
pub(super) struct ActiveManoeuvre {
    pub entry: EntryId,
    pub verb: &'static Verb,
    pub site: Site,
    pub members: Vec<Member>,
    pub phase: Phase,
    pub work: Work,
    moving: Option<Move>,
}

impl ActiveManoeuvre {
    pub fn new(entry: EntryId, verb: &'static Verb, site: Site, work: Work) -> Self {
        Self {
            entry,
            verb,
            site,
            members: Vec::new(),
            phase: Phase::Rise,
            work,
            moving: None,
        }
    }

    pub fn has(&self, vehicle: VehicleId) -> bool {
        self.members.iter().any(|member| member.id == vehicle)
    }

    pub fn is_over(&self) -> bool {
        self.members.is_empty()
    }

    pub fn is_formation(&self) -> bool {
        matches!(self.work, Work::Formation(_))
    }

    /// The first vehicle of a formation; `None` for other manoeuvres.
    pub fn leader(&self) -> Option<VehicleId> {
        let first = self.members.first()?.id;
        self.is_formation().then_some(first)
    }

    /// Sets a formation's speed to that commanded to its leader.
    pub fn pace(&mut self, vehicles: &Vehicles) {
        let leader = self.leader().and_then(|leader| vehicles.get(&leader));
        if let Work::Formation(march) = &mut self.work {
            march.pace(leader.and_then(|leader| leader.asked_speeds.ground_m_s()));
        }
    }

    pub fn step(&mut self, view: &WorldView<'_>, outcome: &mut StepOutcome) {
        self.drop_unfit(view, outcome);
        self.move_on(view);
        self.work(view);
        self.steer(view, outcome);
        self.tell(view, outcome);
    }

    /// Begins the next phase when all members have finished this one.
    fn move_on(&mut self, view: &WorldView<'_>) {
        let there = |member: &Member| {
            let aim = self.aim(member, 0).at;
            let at = self.point(member.id, view);
            at.is_some_and(|at| is_reached(at, aim))
        };
        if self.phase < Phase::Work && self.members.iter().all(there) {
            self.phase = self.phase.next();
        }
    }

    /// A member's setpoint, and its velocity.
    fn aim(&self, member: &Member, index: usize) -> MovingPoint {
        let point = match self.phase {
            Phase::Rise => member.from.truncate().extend(member.layer_m),
            Phase::Cross => member.to.truncate().extend(member.layer_m),
            Phase::Sink => member.to,
            Phase::Work => return self.work_aim(member, index),
        };
        MovingPoint::still(point)
    }

    fn point(&self, id: VehicleId, view: &WorldView<'_>) -> Option<DVec3> {
        self.site.point(view.vehicles.get(&id)?)
    }

    fn steer(&mut self, view: &WorldView<'_>, outcome: &mut StepOutcome) {
        for index in 0..self.members.len() {
            let member = &self.members[index];
            let aim = self.aim(member, index);
            let (id, before) = (member.id, member.standing.waits);
            let obstacle = self.obstacle(id, aim.at, view);
            let waits = obstacle.map(|(at, other)| match before {
                Some((stand, _)) => (stand, other),
                None => (at, other),
            });
            if let (Some((_, other)), None) = (waits, before) {
                let text = text!("swarm-waits", verb = self.verb.name, other = other);
                outcome
                    .notices
                    .push(Notice::about(id, view.now, Severity::Notice, text));
            }
            let goal = waits.map_or(aim, |(stand, _)| MovingPoint::still(stand));
            self.members[index].standing.waits = waits;
            let is_moving = goal.velocity_m_s.length() > STANDING_M_S;
            if self.members[index]
                .standing
                .is_due(goal.at, is_moving, view.now)
            {
                let velocity_m_s = is_moving.then_some(goal.velocity_m_s);
                outcome
                    .steering
                    .push((id, self.steering(goal.at, velocity_m_s)));
            }
        }
    }

    fn steering(&self, point: DVec3, speed: Option<DVec3>) -> Steering {
        Steering {
            verb: self.verb,
            setpoint: Setpoint {
                at_point: self.site.place(point.truncate()),
                altitude_m: point.z,
                velocity_m_s: speed.map(|speed| [speed.x, speed.y, -speed.z]),
            },
        }
    }

    /// A vehicle outside the manoeuvre that is in a member's way, with the member's position.
    fn obstacle(
        &self,
        id: VehicleId,
        aim: DVec3,
        view: &WorldView<'_>,
    ) -> Option<(DVec3, VehicleId)> {
        let me = view.vehicles.get(&id)?;
        let own = moving(&self.site, me)?;
        let in_the_way = |other: &Vehicle| {
            let separation_m = view.rules.separation_m + 1.0;
            moving(&self.site, other)
                .is_some_and(|other| is_in_the_way(own, aim, other, separation_m))
        };
        let mut others = view.vehicles.values();
        others
            .find(|other| other.airborne() && !self.has(other.id) && in_the_way(other))
            .map(|other| (own.at, other.id))
    }

    /// Last setpoints for members that must stay where they are.
    pub fn stops(&self, ids: &[VehicleId], vehicles: &Vehicles) -> Vec<(VehicleId, Steering)> {
        let members = self
            .members
            .iter()
            .filter(|member| ids.contains(&member.id));
        let stop = |member: &Member| {
            let at = self.site.point(vehicles.get(&member.id)?)?;
            Some((member.id, self.steering(at, None)))
        };
        members.filter_map(stop).collect()
    }

    /// Moves a formation if its leader is among the targets of the order. Returns the targets that
    /// move along, and begins their rows.
    pub fn lead(
        &mut self,
        to: FormationGoal,
        ordered: Ordered<'_>,
        now: Duration,
        rows: &mut Vec<RowUpdate>,
    ) -> Vec<VehicleId> {
        let leader = self
            .leader()
            .filter(|leader| ordered.targets.contains(leader));
        let spot = self.site.flat(to.place);
        let (Some(leader), true, Work::Formation(march)) =
            (leader, to.place.is_valid(), &mut self.work)
        else {
            return Vec::new();
        };
        let goal = spot.extend(to.altitude_m.unwrap_or(march.anchor.z));
        march.goal = Some(goal);
        let way_m = march.anchor.distance(goal);
        let targets = ordered.targets.iter().copied();
        let who: Vec<VehicleId> = targets.filter(|id| self.has(*id)).collect();
        let by = text!("outcome-superseded", by = ordered.verb.name);
        self.end_move(RowState::Superseded, Some(&by), now, rows);
        rows.extend(who.iter().map(|&vehicle| RowUpdate {
            entry: ordered.entry,
            vehicle,
            state: RowState::InProgress(0),
            tries: 1,
            at: now,
            explanation: Some(move_remark(vehicle, leader)),
        }));
        self.moving = Some(Move {
            entry: ordered.entry,
            who: who.clone(),
            way_m,
            percent: 0,
        });
        who
    }

    pub fn paths(&self) -> Vec<Path> {
        let path = |(index, member): (usize, &Member)| {
            let place = |point: &DVec3| self.site.place(point.truncate());
            let mut points = Vec::new();
            if self.phase < Phase::Work {
                points.push(place(&member.to));
            }
            if let (Phase::Work, false) = (self.phase, matches!(self.work, Work::Courses { .. })) {
                points.push(place(&self.aim(member, index).at));
            }
            points.extend(member.course.iter().skip(member.next).map(place));
            Path {
                vehicle: member.id,
                points,
            }
        };
        self.members.iter().enumerate().map(path).collect()
    }

    fn lanes_left(&self) -> Vec<Lane> {
        let lanes = self.members.iter().flat_map(|member| {
            let first = member.next / 2;
            let pairs = member.course.chunks_exact(2).skip(first);
            pairs.map(|pair| Lane {
                from: pair[0].truncate(),
                to: pair[1].truncate(),
            })
        });
        let mut lanes: Vec<Lane> = lanes.collect();
        let across = lanes.first().map_or(DVec2::X, |lane| {
            (lane.to - lane.from)
                .try_normalize()
                .unwrap_or(DVec2::X)
                .perp()
        });
        let along = -across.perp();
        for lane in &mut lanes {
            // All lanes in one direction again, as at the start of a survey.
            if (lane.to - lane.from).dot(along) < 0.0 {
                (lane.from, lane.to) = (lane.to, lane.from);
            }
        }
        lanes.sort_by(|a, b| a.from.dot(across).total_cmp(&b.from.dot(across)));
        lanes
    }
}

fn move_remark(vehicle: VehicleId, leader: VehicleId) -> Text {
    if vehicle == leader {
        text!("swarm-leads")
    } else {
        text!("swarm-goes-along", leader = leader)
    }
}

fn is_reached(at: DVec3, aim: DVec3) -> bool {
    at.truncate().distance(aim.truncate()) <= REACHED_ASIDE_M
        && (at.z - aim.z).abs() <= REACHED_ABOVE_M
}
