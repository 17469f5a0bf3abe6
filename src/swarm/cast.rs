//! From what was asked to who flies what.

use std::time::Duration;

use glam::{DVec2, DVec3};

use super::act::{Act, Chain, Member, Phase, Scene, Tail, Work};
use super::geometry::{assign, length_m, spread};
use super::lanes::{self, Lane, NoLanes, Start, shares};
use super::march::March;
use super::pattern;
use super::site::Site;
use super::transit::{Clearance, Leg, are_apart, heights};
use super::{Call, Rules, Vehicles};
use crate::commands::{Datum, FarEnd, Ground, Manoeuvre, Pattern, Shape, ready_for};
use crate::ledger::{RowState, RowUpdate};
use crate::text;
use crate::text::Text;
use crate::vehicle::{Vehicle, VehicleId};

/// What is added to the separation on the ground, and in height: nobody flies exactly where it is told to.
const MARGIN_M: f64 = 1.0;
const MARGIN_ABOVE_M: f64 = 1.5;
/// Between two lines where neither the line nor the mission says how wide.
const USUAL_SPACING_M: f64 = 20.0;
/// A sensor that sees less than this tells nothing about lines.
const LEAST_SPACING_M: f64 = 1.0;
/// Between neighbours of a formation.
const FORMATION_SPACING_M: f64 = 10.0;
const SECTOR_RADIUS_M: f64 = 100.0;
/// An expanding square reaches so many spacings out.
const SQUARE_TURNS: f64 = 5.0;

impl Rules {
    fn clearance(self) -> Clearance {
        Clearance {
            aside_m: self.separation_m + MARGIN_M,
            above_m: self.separation_m + MARGIN_ABOVE_M,
        }
    }
}

/// Those who are asked to do something together.
pub(super) struct Cast<'a> {
    rules: Rules,
    vehicles: &'a Vehicles,
    now: Duration,
    call: Call<'a>,
    /// Who can take part, with where it is.
    team: Vec<(VehicleId, DVec3)>,
    site: Site,
    /// What to say in the rows of those that take part.
    remarks: Vec<Text>,
    pub rows: Vec<RowUpdate>,
}

type Made = Result<Act, Text>;

impl<'a> Cast<'a> {
    pub fn new(rules: Rules, vehicles: &'a Vehicles, now: Duration, call: Call<'a>) -> Self {
        let mut globals = call
            .targets
            .iter()
            .filter_map(|id| vehicles.get(id)?.global);
        let origin = globals.next().map(|global| global.at_point);
        Self {
            rules,
            vehicles,
            now,
            call,
            team: Vec::new(),
            site: Site::new(origin.unwrap_or(crate::geo::LatLon::new(0.0, 0.0))),
            remarks: Vec::new(),
            rows: Vec::new(),
        }
    }

    /// Finds out who can take part and refuses the others.
    pub fn audition(&mut self) {
        let verb = self.call.manoeuvre.name();
        for &id in self.call.targets {
            let fitness = match self.vehicles.get(&id) {
                None => Err(text!("refused-not-heard")),
                Some(_) if self.is_its_own_goal(id) => Err(text!("swarm-its-own-goal")),
                Some(vehicle) => ready_for(verb, vehicle),
            };
            let vehicle = self.vehicles.get(&id);
            let at = vehicle.and_then(|vehicle| self.site.point(vehicle));
            match (fitness, at) {
                (Ok(()), Some(at)) => self.team.push((id, at)),
                (Ok(()), None) => {}
                (Err(reason), _) => self.tell(id, RowState::Refused, Some(reason)),
            }
        }
    }

    fn is_its_own_goal(&self, id: VehicleId) -> bool {
        match *self.call.manoeuvre {
            Manoeuvre::Follow { leader, .. } => leader == id,
            Manoeuvre::Chain {
                to: FarEnd::Vehicle(to),
                ..
            } => to == id,
            _ => false,
        }
    }

    /// Who can take part.
    pub fn team(&self) -> Vec<VehicleId> {
        self.team.iter().map(|(id, _)| *id).collect()
    }

    fn tell(&mut self, vehicle: VehicleId, state: RowState, explanation: Option<Text>) {
        self.rows.push(RowUpdate {
            entry: self.call.entry,
            vehicle,
            state,
            tries: 1,
            at: self.now,
            explanation,
        });
    }

    /// Plans it; `None` when nobody can do it, and the rows say why.
    pub fn make(&mut self) -> Option<Act> {
        if self.team.is_empty() {
            return None;
        }
        match self.plan() {
            Ok(act) => {
                let remark = (!self.remarks.is_empty())
                    .then(|| Text::joined("; ", std::mem::take(&mut self.remarks)));
                for member in &act.members {
                    self.tell(member.id, RowState::InProgress(0), remark.clone());
                }
                Some(act)
            }
            Err(reason) => {
                for id in self.team() {
                    self.tell(id, RowState::Refused, Some(reason.clone()));
                }
                None
            }
        }
    }

    fn plan(&mut self) -> Made {
        match self.call.manoeuvre {
            Manoeuvre::Survey {
                ground,
                spacing_m,
                up_m,
                course_deg,
            } => self.survey(ground, *spacing_m, self.height(*up_m), *course_deg),
            &Manoeuvre::Formation {
                shape,
                spacing_m,
                up_m,
                face_deg,
            } => self.formation(shape, spacing_m, self.height(up_m), face_deg),
            &Manoeuvre::Follow {
                leader,
                distance_m,
                up_m,
            } => self.follow(leader, distance_m, up_m),
            &Manoeuvre::Spread { spacing_m } => self.spread(spacing_m),
            &Manoeuvre::Search {
                pattern,
                datum,
                radius_m,
                spacing_m,
                up_m,
            } => self.search((pattern, datum), radius_m, spacing_m, self.height(up_m)),
            &Manoeuvre::Chain { to, up_m } => self.chain(to, self.height(up_m)),
            Manoeuvre::Disband => Err(text!("swarm-no-formation")),
        }
    }

    fn act(&self, work: Work) -> Act {
        let name = self.call.manoeuvre.name();
        Act::new(self.call.entry, name, self.site, work)
    }

    fn scene(&self) -> Scene<'a> {
        Scene {
            now: self.now,
            vehicles: self.vehicles,
            rules: self.rules,
        }
    }

    /// The height that was asked for, or that of the first.
    fn height(&self, up_m: Option<f64>) -> f64 {
        up_m.unwrap_or_else(|| self.team.first().map_or(0.0, |(_, at)| at.z))
    }

    fn spot(&self, spot: Datum) -> Result<DVec2, Text> {
        let first = self.team.first().and_then(|(id, _)| self.vehicles.get(id));
        let found = first.and_then(|first| self.site.spot(spot, first));
        found.ok_or_else(|| text!("refused-no-position"))
    }

    /// Between two lines flown at a height.
    fn line_spacing(&mut self, spacing_m: Option<f64>, up_m: f64) -> f64 {
        spacing_m.unwrap_or_else(|| {
            let swath = self.rules.swath.map(|swath| swath.width_m(up_m));
            let swath = swath.filter(|metres| *metres >= LEAST_SPACING_M);
            let metres = swath.unwrap_or(USUAL_SPACING_M);
            let figure = format!("{metres:.1}");
            self.remarks.push(match swath {
                Some(_) => text!("swarm-swath-spacing", metres = figure),
                None => text!("swarm-usual-spacing", metres = figure),
            });
            metres
        })
    }

    /// Neighbours may not be told to come too near to each other.
    fn roomy(&self, spacing_m: f64) -> Result<f64, Text> {
        let separation_m = self.rules.separation_m;
        let least = separation_m + MARGIN_M;
        if spacing_m + 1e-9 < least && self.team.len() > 1 {
            return Err(text!(
                "swarm-too-near",
                spacing = format!("{spacing_m:.1}"),
                least = format!("{least:.1}"),
                separation = format!("{separation_m:.1}")
            ));
        }
        Ok(spacing_m)
    }

    fn survey(
        &mut self,
        ground: &Ground,
        spacing_m: Option<f64>,
        up_m: f64,
        course_deg: Option<f64>,
    ) -> Made {
        let spacing_m = self.line_spacing(spacing_m, up_m);
        let corners = self.corners(ground)?;
        let cover = |course_deg| {
            lanes::lanes(&corners, spacing_m, course_deg).map_err(|why| match why {
                NoLanes::Empty => text!("swarm-no-area"),
                NoLanes::TooMany(most) => text!("swarm-too-many-lines", most = most),
            })
        };
        let mut lanes = cover(course_deg)?;
        if lanes.len() < self.team.len() && course_deg.is_none() {
            // The other way round there may be enough for everybody.
            let along = lanes.first().map_or(DVec2::X, |lane| lane.to - lane.from);
            let across = cover(Some(along.perp().to_angle().to_degrees()))?;
            if across.len() > lanes.len() {
                lanes = across;
            }
        }
        let mut act = self.act(Work::Courses { lanes: true });
        act.members = members(&self.team, up_m);
        if !share_lanes(&mut act, &lanes, &self.scene()) {
            return Err(text!("swarm-no-way"));
        }
        let idle: Vec<VehicleId> = self.team().into_iter().filter(|id| !act.has(*id)).collect();
        for id in idle {
            self.tell(id, RowState::Done, Some(text!("swarm-nothing-left")));
        }
        if is_staggered(&lanes, self.rules) && act.members.len() > 1 {
            let metres = format!("{:.1}", self.rules.clearance().above_m);
            self.remarks.push(text!("swarm-staggered", metres = metres));
        }
        Ok(act)
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
                let circle = crate::geo::Outline::Circle {
                    centre,
                    radius_m: *radius_m,
                };
                let corners = circle.corners().into_iter();
                corners.map(|corner| self.site.flat(corner)).collect()
            }
        })
    }

    fn formation(
        &mut self,
        shape: Shape,
        spacing_m: Option<f64>,
        up_m: f64,
        face_deg: Option<f64>,
    ) -> Made {
        let least = self.rules.separation_m + MARGIN_M;
        let spacing_m = spacing_m.unwrap_or(FORMATION_SPACING_M.max(least));
        let spacing_m = self.roomy(spacing_m)?;
        let (first, at) = self.team[0];
        let heading = self.vehicles.get(&first).and_then(Vehicle::heading_deg);
        let facing_deg = face_deg.unwrap_or(f64::from(heading.unwrap_or_default()));
        let anchor = at.truncate().extend(up_m);
        let mut march = March::new(shape, spacing_m, anchor, facing_deg);
        march.keeps_facing = face_deg.is_some();
        let mut act = self.act(Work::Formation(march));
        act.members = members(&self.team, up_m);
        if take_places(&mut act, &self.scene()) {
            Ok(act)
        } else {
            Err(text!("swarm-no-way"))
        }
    }

    fn follow(&mut self, leader: VehicleId, distance_m: f64, up_m: Option<f64>) -> Made {
        let distance_m = self.roomy(distance_m)?;
        let gone = || text!("swarm-not-there", vehicle = leader);
        let ahead = self.vehicles.get(&leader).ok_or_else(gone)?;
        let ahead = self.site.point(ahead).ok_or_else(gone)?;
        // The nearest one follows first.
        self.team
            .sort_by(|a, b| a.1.distance(ahead).total_cmp(&b.1.distance(ahead)));
        let step_m = self.rules.clearance().above_m;
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
            // Everybody begins right above or below where it is.
            member.to = member
                .from
                .truncate()
                .extend(lowest + step_m * index as f64);
            member.layer_m = member.to.z;
        }
        Ok(act)
    }

    fn spread(&mut self, spacing_m: f64) -> Made {
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

    fn search(
        &mut self,
        (pattern, datum): (Pattern, Datum),
        radius_m: Option<f64>,
        spacing_m: Option<f64>,
        up_m: f64,
    ) -> Made {
        let datum = self.spot(datum)?;
        let count = self.team.len();
        let ways = match pattern {
            Pattern::Square => {
                let spacing_m = self.line_spacing(spacing_m, up_m);
                let radius_m = radius_m.unwrap_or(spacing_m * SQUARE_TURNS);
                pattern::pieces(&pattern::square(spacing_m, radius_m), count)
            }
            Pattern::Sector => {
                let radius_m = radius_m.unwrap_or(SECTOR_RADIUS_M);
                let turn = |index: usize| 60.0 * index as f64 / count as f64;
                (0..count)
                    .map(|index| pattern::sector(radius_m, turn(index)))
                    .collect()
            }
        };
        // Who is lower stays lower: nobody has to pass another one in height.
        self.team
            .sort_by(|a, b| a.1.z.total_cmp(&b.1.z).then(a.0.cmp(&b.0)));
        let step_m = self.rules.clearance().above_m;
        let mut act = self.act(Work::Courses { lanes: false });
        act.members = members(&self.team, up_m);
        for (index, (member, way)) in act.members.iter_mut().zip(ways).enumerate() {
            let level = up_m + step_m * index as f64;
            let points = way.into_iter().map(|point| (datum + point).extend(level));
            member.course = points.collect();
            member.to = member.course.first().copied().unwrap_or(member.from);
        }
        self.routed(act)
    }

    fn chain(&mut self, to: FarEnd, up_m: f64) -> Made {
        let homes = self
            .team
            .iter()
            .filter_map(|(id, _)| self.vehicles.get(id)?.home);
        let home = homes.map(|home| self.site.flat(home.at_point)).next();
        let home = home.ok_or_else(|| text!("swarm-no-home"))?;
        let end = match to {
            FarEnd::Place(spot) => self.spot(spot)?,
            FarEnd::Vehicle(id) => {
                let end = self.vehicles.get(&id).and_then(|it| self.site.point(it));
                end.ok_or_else(|| text!("swarm-not-there", vehicle = id))?
                    .truncate()
            }
        };
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

    fn routed(&self, mut act: Act) -> Made {
        if route(&mut act, &self.scene()) {
            Ok(act)
        } else {
            Err(text!("swarm-no-way"))
        }
    }
}

/// Everybody where it is, to stay on the spot at a height.
fn members(team: &[(VehicleId, DVec3)], up_m: f64) -> Vec<Member> {
    let member = |&(id, at): &(VehicleId, DVec3)| Member::new(id, at, at.truncate().extend(up_m));
    team.iter().map(member).collect()
}

/// Whether neighbouring lines are so near that neighbours have to fly at different heights.
fn is_staggered(lanes: &[Lane], rules: Rules) -> bool {
    let apart = |pair: &[Lane]| {
        let along = (pair[0].to - pair[0].from).try_normalize();
        let along = along.or((pair[1].to - pair[1].from).try_normalize());
        (pair[1].from - pair[0].from)
            .perp_dot(along.unwrap_or(DVec2::X))
            .abs()
    };
    let nearest = lanes.windows(2).map(apart).fold(f64::INFINITY, f64::min);
    nearest < rules.clearance().aside_m
}

/// Gives the lanes to the members: neighbouring ones to each, begun from the side and the end from which all together
/// have the shortest way. Who gets none leaves. False if there is no safe way.
pub(super) fn share_lanes(act: &mut Act, lanes: &[Lane], scene: &Scene<'_>) -> bool {
    let up_m = act.members.iter().map(|member| member.to.z);
    let up_m = up_m.fold(f64::INFINITY, f64::min);
    see(act, scene);
    let count = act.members.len().min(lanes.len());
    let shares = shares(lanes, count);
    let flat: Vec<DVec2> = act.members.iter().map(|it| it.from.truncate()).collect();
    let tries = Start::ALL.map(|start| {
        let ordered: Vec<Vec<Lane>> = shares.iter().map(|share| start.order(share)).collect();
        let entries: Vec<DVec2> = ordered.iter().map(|share| share[0].from).collect();
        let (chosen, cost) = assign(&entries, &flat);
        (cost, chosen, ordered)
    });
    let Some((_, chosen, ordered)) = tries.into_iter().min_by(|a, b| a.0.total_cmp(&b.0)) else {
        return false;
    };
    let above_m = if is_staggered(lanes, scene.rules) {
        scene.rules.clearance().above_m
    } else {
        0.0
    };
    let team = std::mem::take(&mut act.members);
    for (index, (member, share)) in chosen.into_iter().zip(ordered).enumerate() {
        let level = up_m + above_m * (index % 2) as f64;
        let ends = share.iter().flat_map(|lane| [lane.from, lane.to]);
        let course: Vec<DVec3> = ends.map(|end| end.extend(level)).collect();
        act.members.push(Member {
            to: course[0],
            course,
            next: 0,
            ..team[member].clone()
        });
    }
    route(act, scene)
}

/// Gives the members places in their formation, the first the first one. False if there is no safe way.
pub(super) fn take_places(act: &mut Act, scene: &Scene<'_>) -> bool {
    see(act, scene);
    let Work::Formation(march) = &mut act.work else {
        return false;
    };
    let places = march.places(act.members.len());
    let flat =
        |points: &[DVec3]| -> Vec<DVec2> { points.iter().map(|point| point.truncate()).collect() };
    let others: Vec<DVec2> = act.members[1..]
        .iter()
        .map(|it| it.from.truncate())
        .collect();
    let (chosen, _) = assign(&flat(&places[1..]), &others);
    let mut order = vec![0; places.len()];
    for (slot, other) in chosen.into_iter().enumerate() {
        order[other + 1] = slot + 1;
    }
    march.seat(&order);
    for (member, &slot) in act.members.iter_mut().zip(&order) {
        member.to = places[slot];
    }
    route(act, scene)
}

/// Takes note of where everybody is now.
fn see(act: &mut Act, scene: &Scene<'_>) {
    for member in &mut act.members {
        let vehicle = scene.vehicles.get(&member.id);
        if let Some(at) = vehicle.and_then(|vehicle| act.site.point(vehicle)) {
            member.from = at;
        }
    }
}

/// Finds heights at which everybody can go from where it is to where its work begins. False if there are none.
fn route(act: &mut Act, scene: &Scene<'_>) -> bool {
    let leg = |member: &Member| Leg {
        from: member.from,
        to: member.to,
    };
    let legs: Vec<Leg> = act.members.iter().map(leg).collect();
    let outside = scene
        .vehicles
        .values()
        .filter(|it| !act.has(it.id) && it.airborne());
    let others: Vec<DVec3> = outside.filter_map(|it| act.site.point(it)).collect();
    let clearance = scene.rules.clearance();
    if are_apart(&legs, &others, clearance) {
        act.phase = Phase::Sink;
        for member in &mut act.members {
            member.layer_m = member.to.z;
        }
        return true;
    }
    let Some(heights) = heights(&legs, &others, clearance) else {
        return false;
    };
    act.phase = Phase::Rise;
    for (member, height_m) in act.members.iter_mut().zip(heights) {
        member.layer_m = height_m;
        let way = [member.from, member.from.truncate().extend(height_m)];
        member.standing.most_m = member.standing.most_m.max(length_m(&way));
    }
    true
}
