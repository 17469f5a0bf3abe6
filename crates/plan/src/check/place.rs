//! The places of a plan: fences, heights, distances.

use sortie_geo::LatLon;

use super::{
    BrokenArea, CheckOptions, Finding, FindingKind, Height, RallyFault, VehicleKind, plan_finding,
};
use crate::areas::{AreaShape, Fence, FenceArea};
use crate::{Document, HeightFrame, Home, Item, ListKind, command};

/// A distance from home that small vehicles do not reach, in metres.
pub const FAR_M: f64 = 50_000.0;

pub(super) fn check(
    document: &Document,
    vehicle: VehicleKind,
    options: &CheckOptions,
    findings: &mut Vec<Finding>,
) {
    check_heights(document, vehicle, options, findings);
    let home = document.home.map(|home| LatLon::from_e7(home.x, home.y));
    let fence = Fence::check(&document.fence).unwrap_or_default();
    let first = document
        .plan
        .iter()
        .chain(&document.rally)
        .find_map(place_of);
    let Some(origin) = home.or(first) else {
        return;
    };
    let field = FenceField::around(origin, &fence);
    let home_m = home.map(|_| [0.0; 2]);
    let at_home = home_m.and_then(|home_m| field.broken(home_m));
    findings.extend(at_home.map(|area| Finding {
        list: ListKind::Fence,
        item: None,
        kind: FindingKind::HomeBreaksFence(area),
    }));
    field.check_rally(document, options, findings);
    field.check_plan(&document.plan, home_m, options, findings);
}

/// The areas of a fence, in metres north and east of an origin.
struct FenceField {
    origin: LatLon,
    areas: Vec<FenceArea<[f64; 2]>>,
}

impl FenceField {
    fn around(origin: LatLon, fence: &Fence) -> Self {
        let metres = |point: &LatLon| <[f64; 2]>::from(origin.offset_to(*point));
        Self {
            origin,
            areas: fence.areas.iter().map(|area| area.map(metres)).collect(),
        }
    }

    fn metres(&self, point: LatLon) -> [f64; 2] {
        self.origin.offset_to(point).into()
    }

    /// The area that a point breaks, if any.
    fn broken(&self, point: [f64; 2]) -> Option<BrokenArea> {
        let area = self
            .areas
            .iter()
            .position(|area| area.is_broken_at(point))?;
        let is_exclusion = !self.areas[area].keeps_in;
        Some(BrokenArea { area, is_exclusion })
    }

    fn check_rally(
        &self,
        document: &Document,
        options: &CheckOptions,
        findings: &mut Vec<Finding>,
    ) {
        for (index, item) in document.rally.iter().enumerate() {
            let fault = rally_fault(item, document.home, options);
            let point = item.point();
            let outside = self.broken(self.metres(point)).map(RallyFault::Area);
            let fault = outside.or(fault).filter(|_| point.is_valid());
            findings.extend(fault.map(|fault| Finding {
                list: ListKind::Rally,
                item: Some(index),
                kind: FindingKind::RallyIgnored(fault),
            }));
        }
    }

    /// Checks the places and legs of a plan that begins at home, if home is known.
    fn check_plan(
        &self,
        plan: &[Item],
        home_m: Option<[f64; 2]>,
        options: &CheckOptions,
        findings: &mut Vec<Finding>,
    ) {
        let mut before = home_m;
        for (index, item) in plan.iter().enumerate() {
            let Some(point) = place_of(item) else {
                before = before.filter(|_| item.command != command::RETURN_TO_LAUNCH);
                continue;
            };
            let here = self.metres(point);
            let mut add = |kind| findings.push(plan_finding(index, kind));
            if home_m.is_some() {
                check_distance(here, options, &mut add);
            }
            if !command::is_flown_to(item.command) {
                continue;
            }
            if let Some(kind) = self.leg_finding(before, here) {
                add(kind);
            }
            before = Some(here);
        }
    }

    /// The fault of a leg: its end breaks an area, or the way there does.
    fn leg_finding(&self, before: Option<[f64; 2]>, here: [f64; 2]) -> Option<FindingKind> {
        if let Some(area) = self.broken(here) {
            return Some(FindingKind::BreaksFence(area));
        }
        let before = before.filter(|&before| self.broken(before).is_none())?;
        let mut areas = self.areas.iter();
        let area = areas.position(|area| is_crossed(area, before, here))?;
        Some(FindingKind::LegBreaksFence { area })
    }
}

fn rally_fault(item: &Item, home: Option<Home>, options: &CheckOptions) -> Option<RallyFault> {
    let home = home?;
    let distance_m = LatLon::from_e7(home.x, home.y).distance_m(item.point()) as f32;
    if let Some(most_m) = options.radius_m.filter(|most_m| distance_m > *most_m) {
        return Some(RallyFault::Radius { distance_m, most_m });
    }
    let height = Height {
        metres: item.z,
        frame: item.height_frame(),
    };
    let height_m = above_home(height, Some(home))?;
    let most_m = options.ceiling_m.filter(|most_m| height_m > *most_m)?;
    Some(RallyFault::Ceiling { height_m, most_m })
}

fn place_of(item: &Item) -> Option<LatLon> {
    let point = item.point();
    let is_set = command::has_place(item.command) && (item.x, item.y) != (0, 0);
    (is_set && point.is_valid()).then_some(point)
}

fn check_distance(here: [f64; 2], options: &CheckOptions, add: &mut impl FnMut(FindingKind)) {
    let distance_m = length(here);
    if let Some(most_m) = options
        .radius_m
        .filter(|most_m| distance_m > f64::from(*most_m))
    {
        let distance_m = distance_m as f32;
        add(FindingKind::BeyondRadius { distance_m, most_m });
    }
    if distance_m > FAR_M {
        let distance_m = distance_m as f32;
        add(FindingKind::FarAway { distance_m });
    }
}

fn length([north, east]: [f64; 2]) -> f64 {
    (north * north + east * east).sqrt()
}

/// Whether a straight leg between two allowed points leaves an inclusion area or enters an exclusion area.
pub(crate) fn is_crossed(area: &FenceArea<[f64; 2]>, from: [f64; 2], to: [f64; 2]) -> bool {
    match &area.shape {
        AreaShape::Polygon(corners) => {
            let mut last = corners.last().copied();
            corners.iter().any(|corner| {
                let edge = last.replace(*corner);
                edge.is_some_and(|edge| crosses([from, to], [edge, *corner]))
            })
        }
        // A straight line between two points inside a circle never leaves it.
        AreaShape::Circle { .. } if area.keeps_in => false,
        AreaShape::Circle { centre, radius_m } => nearest_m(*centre, from, to) < *radius_m,
    }
}

fn crosses([a, b]: [[f64; 2]; 2], [c, d]: [[f64; 2]; 2]) -> bool {
    let side = |from: [f64; 2], to: [f64; 2], point: [f64; 2]| {
        (to[0] - from[0]) * (point[1] - from[1]) - (to[1] - from[1]) * (point[0] - from[0])
    };
    side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) < 0.0
}

fn nearest_m(point: [f64; 2], from: [f64; 2], to: [f64; 2]) -> f64 {
    let leg = [to[0] - from[0], to[1] - from[1]];
    let way = [point[0] - from[0], point[1] - from[1]];
    let square = leg[0] * leg[0] + leg[1] * leg[1];
    let share = if square > 0.0 {
        ((way[0] * leg[0] + way[1] * leg[1]) / square).clamp(0.0, 1.0)
    } else {
        0.0
    };
    length([way[0] - share * leg[0], way[1] - share * leg[1]])
}

fn check_heights(
    document: &Document,
    vehicle: VehicleKind,
    options: &CheckOptions,
    findings: &mut Vec<Finding>,
) {
    if !vehicle.flies_above_ground() {
        return;
    }
    let mut before: Option<Height> = None;
    for (index, item) in document.plan.iter().enumerate() {
        if !command::is_flown_to(item.command) || !item.z.is_finite() {
            continue;
        }
        let mut add = |kind| findings.push(plan_finding(index, kind));
        let here = Height {
            metres: item.z,
            frame: item.height_frame(),
        };
        if here.frame == HeightFrame::Terrain && !options.has_terrain {
            add(FindingKind::NoTerrain);
        }
        // A landing has no height of its own.
        if matches!(item.command, command::LAND | command::VTOL_LAND) {
            continue;
        }
        let above_home_m = above_home(here, document.home);
        if let Some(height_m) = above_home_m {
            if let Some(most_m) = options.ceiling_m.filter(|most_m| height_m > *most_m) {
                add(FindingKind::AboveCeiling { height_m, most_m });
            }
            // Zero means the vehicle's current height.
            let is_unset = item.z == 0.0 && !command::is_takeoff(item.command);
            if height_m <= 0.0 && !is_unset {
                let may_slope = options.may_slope;
                add(FindingKind::LowHeight {
                    height_m,
                    may_slope,
                });
            }
        }
        if let Some(before) = before.filter(|before| before.frame != here.frame) {
            let earlier = above_home(before, document.home);
            add(FindingKind::MixedFrames {
                before,
                here,
                above_home_m: earlier.zip(above_home_m).map(<[f32; 2]>::from),
            });
        }
        before = Some(here);
    }
}

/// A height above home in metres, if it can be computed without the height of the ground.
fn above_home(height: Height, home: Option<Home>) -> Option<f32> {
    match height.frame {
        HeightFrame::Home => Some(height.metres),
        HeightFrame::SeaLevel => home.map(|home| height.metres - home.z),
        HeightFrame::Terrain | HeightFrame::Other => None,
    }
}
