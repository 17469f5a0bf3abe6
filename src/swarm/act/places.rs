//! The assignment of places to vehicles, and their paths there.

use glam::{DVec2, DVec3};

use super::{ActiveManoeuvre, Member, Phase, Work, WorldView};
use crate::swarm::Rules;
use crate::swarm::geometry::{assign, length_m};
use crate::swarm::lanes::{Lane, Start, shares};
use crate::swarm::transit::{Leg, are_apart, heights};
use crate::vehicle::VehicleId;

/// Members at their current positions, to change only their height.
pub(in crate::swarm) fn members(team: &[(VehicleId, DVec3)], up_m: f64) -> Vec<Member> {
    let member = |&(id, at): &(VehicleId, DVec3)| Member::new(id, at, at.truncate().extend(up_m));
    team.iter().map(member).collect()
}

/// Whether lines are so close that neighbours must fly at different heights.
pub(in crate::swarm) fn is_staggered(lanes: &[Lane], rules: Rules) -> bool {
    let apart = |pair: &[Lane]| {
        let direction = |lane: &Lane| (lane.to - lane.from).try_normalize();
        let along = direction(&pair[0]).or_else(|| direction(&pair[1]));
        (pair[1].from - pair[0].from)
            .perp_dot(along.unwrap_or(DVec2::X))
            .abs()
    };
    let nearest = lanes.windows(2).map(apart).fold(f64::INFINITY, f64::min);
    nearest < rules.clearance().aside_m
}

/// Assigns adjacent lanes to the members, from the side and the end with the shortest total path.
/// Members without a lane leave. Returns `false` if there is no safe path.
pub(in crate::swarm) fn share_lanes(
    act: &mut ActiveManoeuvre,
    lanes: &[Lane],
    view: &WorldView<'_>,
) -> bool {
    let heights = act.members.iter().map(|member| member.to.z);
    let up_m = heights.fold(f64::INFINITY, f64::min);
    see(act, view);
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
    let above_m = if is_staggered(lanes, view.rules) {
        view.rules.clearance().above_m
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
    route(act, view)
}

/// Assigns places in the formation, the first one to the first member. Returns `false` if there is
/// no safe path.
pub(in crate::swarm) fn take_places(act: &mut ActiveManoeuvre, view: &WorldView<'_>) -> bool {
    see(act, view);
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
    route(act, view)
}

/// Updates the members' positions.
fn see(act: &mut ActiveManoeuvre, view: &WorldView<'_>) {
    for member in &mut act.members {
        let vehicle = view.vehicles.get(&member.id);
        if let Some(at) = vehicle.and_then(|vehicle| act.site.point(vehicle)) {
            member.from = at;
        }
    }
}

/// Finds heights at which all members can fly to the start of their work. Returns `false` if there
/// are none.
pub(in crate::swarm) fn route(act: &mut ActiveManoeuvre, view: &WorldView<'_>) -> bool {
    let leg = |member: &Member| Leg {
        from: member.from,
        to: member.to,
    };
    let legs: Vec<Leg> = act.members.iter().map(leg).collect();
    let outside = view
        .vehicles
        .values()
        .filter(|it| !act.has(it.id) && it.airborne());
    let others: Vec<DVec3> = outside.filter_map(|it| act.site.point(it)).collect();
    let clearance = view.rules.clearance();
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
