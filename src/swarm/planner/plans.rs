//! The plan of each manoeuvre for its vehicles.

use glam::{DVec2, DVec3};

use super::{FORMATION_SPACING_M, Made, Planner, SQUARE_TURNS};
use crate::commands::{Datum, FarEnd, Ground, Pattern, Shape};
use crate::geo::Outline;
use crate::ledger::RowState;
use crate::plan::generate::USUAL_SECTOR_M;
use crate::plan::pattern::{self, NoLanes};
use crate::swarm::act::places::{is_staggered, members, route, share_lanes, take_places};
use crate::swarm::act::{ActiveManoeuvre, Chain, Tail, Work};
use crate::swarm::geometry::{assign, spread};
use crate::swarm::lanes::Lane;
use crate::swarm::march::March;
use crate::swarm::transit::MARGIN_M;
use crate::text;
use crate::text::Text;
use crate::vehicle::VehicleId;

/// The parts of lanes outside an area are reported only if they are at least this long in total, in
/// metres.
const LEAST_GAP_M: f64 = 1.0;

impl Planner<'_> {
    pub(super) fn survey(
        &mut self,
        ground: &Ground,
        spacing_m: Option<f64>,
        up_m: f64,
        course_deg: Option<f64>,
    ) -> Made {
        let spacing_m = self.line_spacing(spacing_m, up_m);
        let corners = self.corners(ground)?;
        let lanes = self.cover(&corners, spacing_m, course_deg)?;
        let gaps_m = pattern::gaps_m(&lanes, &corners);
        if gaps_m >= LEAST_GAP_M {
            let metres = format!("{gaps_m:.0}");
            self.remarks.push(text!("swarm-gaps", metres = metres));
        }
        let mut act = self.act(Work::Courses { lanes: true });
        act.members = members(&self.team, up_m);
        if !share_lanes(&mut act, &lanes, &self.view) {
            return Err(text!("swarm-no-way"));
        }
        let idle: Vec<VehicleId> = self.team().into_iter().filter(|id| !act.has(*id)).collect();
        for id in idle {
            let why = text!(
                "swarm-no-line",
                lines = lanes.len(),
                vehicles = self.team.len()
            );
            self.tell(id, RowState::NoEffect, Some(why));
        }
        if is_staggered(&lanes, self.view.rules) && act.members.len() > 1 {
            let metres = format!("{:.1}", self.view.rules.clearance().above_m);
            self.remarks.push(text!("swarm-staggered", metres = metres));
        }
        Ok(act)
    }

    /// The lanes over an area; with another course if that is the only way to get enough lanes for
    /// all vehicles.
    fn cover(
        &self,
        corners: &[DVec2],
        spacing_m: f64,
        course_deg: Option<f64>,
    ) -> Result<Vec<Lane>, Text> {
        let cover = |course_deg| {
            pattern::lanes(corners, spacing_m, course_deg).map_err(|why| match why {
                NoLanes::Empty => text!("swarm-no-area"),
                NoLanes::TooMany(most) => text!("swarm-too-many-lines", most = most),
            })
        };
        let lanes = cover(course_deg)?;
        if lanes.len() >= self.team.len() || course_deg.is_some() {
            return Ok(lanes);
        }
        let along = lanes.first().map_or(DVec2::X, |lane| lane.to - lane.from);
        let across = cover(Some(along.perp().to_angle().to_degrees()))?;
        Ok(if across.len() > lanes.len() {
            across
        } else {
            lanes
        })
    }

    fn corners(&self, ground: &Ground) -> Result<Vec<DVec2>, Text> {
        Ok(match ground {
            Ground::Outline(outline) => {
                let corners = outline.corners().into_iter();
                corners.map(|corner| self.site.flat(corner)).collect()
            }
            Ground::Between(from, to) => {
                let (from, to) = (self.spot(*from)?, self.spot(*to)?);
                vec![from, DVec2::new(to.x, from.y), to, DVec2::new(from.x, to.y)]
            }
            Ground::Around { centre, radius_m } => {
                let centre = self.site.place(self.spot(*centre)?);
                let circle = Outline::Circle {
                    centre,
                    radius_m: *radius_m,
                };
                let corners = circle.corners().into_iter();
                corners.map(|corner| self.site.flat(corner)).collect()
            }
        })
    }

    pub(super) fn formation(
        &mut self,
        shape: Shape,
        spacing_m: Option<f64>,
        up_m: f64,
        face_deg: Option<f64>,
    ) -> Made {
        let least = self.view.rules.separation_m + MARGIN_M;
        let spacing_m = self.roomy(spacing_m.unwrap_or(FORMATION_SPACING_M.max(least)))?;
        let (first, at) = self.team[0];
        let heading = self
            .view
            .vehicles
            .get(&first)
            .and_then(|vehicle| vehicle.heading_deg());
        let facing_deg = face_deg.unwrap_or(f64::from(heading.unwrap_or_default()));
        let anchor = at.truncate().extend(up_m);
        let mut march = March::new(shape, spacing_m, anchor, facing_deg);
        march.keeps_facing = face_deg.is_some();
        let mut act = self.act(Work::Formation(march));
        act.members = members(&self.team, up_m);
        if take_places(&mut act, &self.view) {
            Ok(act)
        } else {
            Err(text!("swarm-no-way"))
        }
    }

    pub(super) fn follow(&mut self, leader: VehicleId, distance_m: f64, up_m: Option<f64>) -> Made {
        let distance_m = self.roomy(distance_m)?;
        let gone = || text!("swarm-not-there", vehicle = leader);
        let vehicle = self.view.vehicles.get(&leader).ok_or_else(gone)?;
        let ahead = self.site.point(vehicle).ok_or_else(gone)?;
        // The nearest vehicle follows first.
        self.team
            .sort_by(|a, b| a.1.distance(ahead).total_cmp(&b.1.distance(ahead)));
        let step_m = self.view.rules.clearance().above_m;
        let mut act = self.act(Work::Follow(Tail {
            leader,
            distance_m,
            up_m,
            step_m,
            places: Vec::new(),
        }));
        act.members = members(&self.team, 0.0);
        let lowest = up_m.unwrap_or(ahead.z + step_m);
        for (index, member) in act.members.iter_mut().enumerate() {
            // Each member begins right above or below its position.
            member.to = member
                .from
                .truncate()
                .extend(lowest + step_m * index as f64);
            member.layer_m = member.to.z;
        }
        Ok(act)
    }

    pub(super) fn spread(&mut self, spacing_m: f64) -> Made {
        let spacing_m = self.roomy(spacing_m)?;
        let flat: Vec<DVec2> = self.team.iter().map(|(_, at)| at.truncate()).collect();
        let ends = spread(&flat, spacing_m);
        let mut act = self.act(Work::Courses { lanes: false });
        act.members = members(&self.team, 0.0);
        for (member, end) in act.members.iter_mut().zip(ends) {
            member.to = end.extend(member.from.z);
        }
        self.routed(act)
    }

    pub(super) fn search(
        &mut self,
        pattern: Pattern,
        datum: Datum,
        radius_m: Option<f64>,
        spacing_m: Option<f64>,
        up_m: f64,
    ) -> Made {
        let centre = self.spot(datum)?;
        let count = self.team.len();
        let ways = match pattern {
            Pattern::Square => {
                let spacing_m = self.line_spacing(spacing_m, up_m);
                let radius_m = radius_m.unwrap_or(spacing_m * SQUARE_TURNS);
                pattern::pieces(&pattern::square(spacing_m, radius_m), count)
            }
            Pattern::Sector => {
                let radius_m = radius_m.unwrap_or(USUAL_SECTOR_M);
                let turn = |index: usize| 60.0 * index as f64 / count as f64;
                (0..count)
                    .map(|index| pattern::sector(radius_m, turn(index)))
                    .collect()
            }
        };
        // A lower vehicle stays lower, so that no vehicle has to climb or descend past another.
        self.team
            .sort_by(|a, b| a.1.z.total_cmp(&b.1.z).then(a.0.cmp(&b.0)));
        let step_m = self.view.rules.clearance().above_m;
        let mut act = self.act(Work::Courses { lanes: false });
        act.members = members(&self.team, up_m);
        for (index, (member, way)) in act.members.iter_mut().zip(ways).enumerate() {
            let level = up_m + step_m * index as f64;
            let points = way.into_iter().map(|point| (centre + point).extend(level));
            member.course = points.collect();
            member.to = member.course.first().copied().unwrap_or(member.from);
        }
        self.routed(act)
    }

    pub(super) fn chain(&mut self, to: FarEnd, up_m: f64) -> Made {
        let (home, end) = (self.home()?, self.far_end(to)?);
        let count = self.team.len() as f64 + 1.0;
        let shares: Vec<f64> = (1..=self.team.len()).map(|at| at as f64 / count).collect();
        let places: Vec<DVec2> = shares.iter().map(|&share| home.lerp(end, share)).collect();
        self.roomy((end - home).length() / count)?;
        let flat: Vec<DVec2> = self.team.iter().map(|(_, at)| at.truncate()).collect();
        let (chosen, _) = assign(&places, &flat);
        let team: Vec<(VehicleId, DVec3)> = chosen.iter().map(|&index| self.team[index]).collect();
        let mut act = self.act(match to {
            FarEnd::Place(_) => Work::Courses { lanes: false },
            FarEnd::Vehicle(to) => Work::Chain(Chain {
                from: home.extend(up_m),
                to,
                shares,
                places: Vec::new(),
            }),
        });
        act.members = members(&team, up_m);
        for (member, place) in act.members.iter_mut().zip(places) {
            member.to = place.extend(up_m);
        }
        self.routed(act)
    }

    fn home(&self) -> Result<DVec2, Text> {
        let home = self
            .team
            .iter()
            .find_map(|(id, _)| self.view.vehicles.get(id)?.home);
        home.map(|home| self.site.flat(home.at_point))
            .ok_or_else(|| text!("swarm-no-home"))
    }

    fn far_end(&self, to: FarEnd) -> Result<DVec2, Text> {
        match to {
            FarEnd::Place(place) => self.spot(place),
            FarEnd::Vehicle(id) => {
                let at = self
                    .view
                    .vehicles
                    .get(&id)
                    .and_then(|it| self.site.point(it));
                at.map(DVec3::truncate)
                    .ok_or_else(|| text!("swarm-not-there", vehicle = id))
            }
        }
    }

    fn routed(&self, mut act: ActiveManoeuvre) -> Made {
        if route(&mut act, &self.view) {
            Ok(act)
        } else {
            Err(text!("swarm-no-way"))
        }
    }
}
