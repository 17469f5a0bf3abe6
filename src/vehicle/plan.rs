//! The lists on board a vehicle: its plan, its fence and its rally points, each a separate list in the mission
//! protocol (`MAV_MISSION_TYPE`).

use std::sync::Arc;

use mavlink::dialects::ardupilotmega::{MavCmd, MavFrame};

use crate::geo::LatLon;

/// The items that fences and rally points consist of.
mod command {
    use super::MavCmd;

    pub const FENCE_RETURN_POINT: u16 = MavCmd::MAV_CMD_NAV_FENCE_RETURN_POINT as u16;
    pub const FENCE_POLYGON_INCLUSION: u16 =
        MavCmd::MAV_CMD_NAV_FENCE_POLYGON_VERTEX_INCLUSION as u16;
    pub const FENCE_POLYGON_EXCLUSION: u16 =
        MavCmd::MAV_CMD_NAV_FENCE_POLYGON_VERTEX_EXCLUSION as u16;
    pub const FENCE_CIRCLE_INCLUSION: u16 = MavCmd::MAV_CMD_NAV_FENCE_CIRCLE_INCLUSION as u16;
    pub const FENCE_CIRCLE_EXCLUSION: u16 = MavCmd::MAV_CMD_NAV_FENCE_CIRCLE_EXCLUSION as u16;
    pub const RALLY_POINT: u16 = MavCmd::MAV_CMD_NAV_RALLY_POINT as u16;
    pub const TAKEOFF: u16 = MavCmd::MAV_CMD_NAV_TAKEOFF as u16;
    pub const VTOL_TAKEOFF: u16 = MavCmd::MAV_CMD_NAV_VTOL_TAKEOFF as u16;
    #[expect(deprecated, reason = "plans may still have it")]
    pub const ROI: u16 = MavCmd::MAV_CMD_NAV_ROI as u16;
    #[expect(deprecated, reason = "plans may still have it")]
    pub const SET_ROI: u16 = MavCmd::MAV_CMD_DO_SET_ROI as u16;
    /// The last one that the vehicle flies to; higher numbers only name a place.
    pub const LAST_FLOWN: u16 = MavCmd::MAV_CMD_NAV_PAYLOAD_PLACE as u16;
}

/// Commands of a plan whose x and y are a place: the navigation commands with one, the regions of interest,
/// setting home, and the start of a landing sequence. Source: MAVLink's `MAV_CMD`, `hasLocation`.
const WITH_PLACE: &[u16] = &[
    MavCmd::MAV_CMD_NAV_WAYPOINT as u16,
    MavCmd::MAV_CMD_NAV_LOITER_UNLIM as u16,
    MavCmd::MAV_CMD_NAV_LOITER_TURNS as u16,
    MavCmd::MAV_CMD_NAV_LOITER_TIME as u16,
    MavCmd::MAV_CMD_NAV_LAND as u16,
    MavCmd::MAV_CMD_NAV_TAKEOFF as u16,
    MavCmd::MAV_CMD_NAV_FOLLOW as u16,
    MavCmd::MAV_CMD_NAV_LOITER_TO_ALT as u16,
    MavCmd::MAV_CMD_NAV_ARC_WAYPOINT as u16,
    command::ROI,
    MavCmd::MAV_CMD_NAV_SPLINE_WAYPOINT as u16,
    MavCmd::MAV_CMD_NAV_VTOL_TAKEOFF as u16,
    MavCmd::MAV_CMD_NAV_VTOL_LAND as u16,
    MavCmd::MAV_CMD_NAV_PAYLOAD_PLACE as u16,
    MavCmd::MAV_CMD_DO_SET_HOME as u16,
    MavCmd::MAV_CMD_DO_LAND_START as u16,
    MavCmd::MAV_CMD_DO_SET_ROI_LOCATION as u16,
    command::SET_ROI,
];

/// The kind of list.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum PlanKind {
    /// The plan that the mode AUTO flies.
    Plan,
    /// The areas in which the vehicle may or may not fly.
    Fence,
    /// Places other than home where RTL may end.
    Rally,
}

impl PlanKind {
    /// All of them, in the order of `MAV_MISSION_TYPE`.
    pub const ALL: [Self; 3] = [Self::Plan, Self::Fence, Self::Rally];
}

/// The lists of a vehicle. Cheap to clone: the items are shared.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Plans {
    /// The plan that the mode AUTO flies.
    pub plan: Stored<Plan>,
    /// The areas in which the vehicle may or may not fly.
    pub fence: Stored<FencePlan>,
    /// Places other than home where RTL may end.
    pub rally: Stored<RallyPlan>,
}

/// One list, with the content that has been read.
#[derive(Debug, Clone, Default)]
pub struct Stored<T> {
    /// The last content that was read; it stays while a newer version is being read.
    pub content: Option<Arc<T>>,
    /// The state of the download.
    pub transfer: Transfer,
}

/// The state of the download of a list.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Transfer {
    #[default]
    Unasked,
    Coming {
        /// The number of items received so far.
        received: u16,
        /// The number of items, once known.
        total: Option<u16>,
    },
    /// The list is complete.
    Done,
    /// The vehicle has no such list.
    Unsupported,
    /// Failed; requested again later.
    Failed,
}

/// Parameters may be NaN ("not set"), which is not equal to itself. This comparison makes a list always equal to
/// itself.
impl<T: PartialEq> PartialEq for Stored<T> {
    fn eq(&self, other: &Self) -> bool {
        let same = match (&self.content, &other.content) {
            (Some(mine), Some(others)) => Arc::ptr_eq(mine, others) || mine == others,
            (None, None) => true,
            _ => false,
        };
        same && self.transfer == other.transfer
    }
}

/// The reference of a height.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum HeightFrame {
    /// Heights above mean sea level.
    SeaLevel,
    Home,
    /// Heights above the ground below.
    Terrain,
    /// Another reference, or an item without a place (`MAV_FRAME_MISSION`, local frames).
    Other,
}

impl HeightFrame {
    /// The reference of a `MAV_FRAME` by its number.
    #[expect(
        deprecated,
        reason = "older autopilots name the _INT spelling of a frame"
    )]
    pub fn from_wire(frame: u8) -> Self {
        const NAMED: [(MavFrame, HeightFrame); 6] = [
            (MavFrame::MAV_FRAME_GLOBAL, HeightFrame::SeaLevel),
            (MavFrame::MAV_FRAME_GLOBAL_INT, HeightFrame::SeaLevel),
            (MavFrame::MAV_FRAME_GLOBAL_RELATIVE_ALT, HeightFrame::Home),
            (
                MavFrame::MAV_FRAME_GLOBAL_RELATIVE_ALT_INT,
                HeightFrame::Home,
            ),
            (MavFrame::MAV_FRAME_GLOBAL_TERRAIN_ALT, HeightFrame::Terrain),
            (
                MavFrame::MAV_FRAME_GLOBAL_TERRAIN_ALT_INT,
                HeightFrame::Terrain,
            ),
        ];
        let named = NAMED.iter().find(|(wire, _)| *wire as u8 == frame);
        named.map_or(Self::Other, |(_, origin)| *origin)
    }
}

/// One item of a list, as `MISSION_ITEM_INT` carries it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlanItem {
    /// Its number, from 0.
    pub seq: u16,
    /// The number of a `MAV_CMD`, even if this program does not know it.
    pub command: u16,
    /// The reference of its height.
    pub frame: HeightFrame,
    /// Its first four parameters, whose meaning depends on the command.
    pub params: [f32; 4],
    /// x and y as a place; `None` for commands without a place, and if both are 0 ("here").
    pub at_point: Option<LatLon>,
    /// z in metres, if it is a finite number.
    pub altitude_m: Option<f32>,
}

impl PlanItem {
    /// Whether the vehicle flies to its place, so that it belongs to the path.
    pub fn is_waypoint(&self) -> bool {
        self.at_point.is_some()
            && self.command <= command::LAST_FLOWN
            && self.command != command::ROI
    }

    /// Whether it is a takeoff, which has a height even without a place.
    pub fn is_takeoff(&self) -> bool {
        matches!(self.command, command::TAKEOFF | command::VTOL_TAKEOFF)
    }

    /// Whether commands of that number have a place.
    pub fn has_place(command: u16) -> bool {
        let fence_or_rally = command::FENCE_RETURN_POINT..=command::RALLY_POINT;
        WITH_PLACE.contains(&command) || fence_or_rally.contains(&command)
    }
}

/// The plan that the mode AUTO flies.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Plan {
    /// The items in order; the number of an item is its index.
    pub items: Vec<PlanItem>,
    /// Whether item 0 is home and not part of the flight, as with ArduPilot.
    pub home_first: bool,
}

impl Plan {
    /// The items after home.
    pub fn flown(&self) -> &[PlanItem] {
        let skip = usize::from(self.home_first).min(self.items.len());
        &self.items[skip..]
    }

    /// The places that the vehicle flies to, in order, without home.
    pub fn path(&self) -> impl Iterator<Item = (&PlanItem, LatLon)> {
        let waypoints = self.flown().iter().filter(|item| item.is_waypoint());
        waypoints.filter_map(|item| Some((item, item.at_point?)))
    }
}

/// A fence of areas. The simple fence by parameters (`FENCE_RADIUS`, `FENCE_ALT_MAX`) is not in it.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct FencePlan {
    /// The areas, in order.
    pub areas: Vec<FenceArea>,
    /// The return point after a breach, if the fence has one.
    pub return_point: Option<LatLon>,
}

/// One area of a fence.
#[derive(Debug, Clone, PartialEq)]
pub struct FenceArea {
    pub shape: FenceShape,
    /// Whether the vehicle must stay inside it; otherwise outside.
    pub inclusion: bool,
}

/// The border of an area.
#[derive(Debug, Clone, PartialEq)]
pub enum FenceShape {
    /// Corners in order; the last is joined to the first.
    Polygon(Vec<LatLon>),
    /// A circle: all points at a distance from its centre.
    Circle { center: LatLon, radius_m: f32 },
}

impl FencePlan {
    /// The fence of these items. Items without a place, circles without a radius, and commands that belong to no fence
    /// are left out. Parameter 1 of each corner is the number of the polygon's corners.
    pub fn from_items(items: &[PlanItem]) -> Self {
        let mut fence = Self::default();
        let mut corners: Vec<LatLon> = Vec::new();
        for item in items {
            let Some(at_point) = item.at_point else {
                continue;
            };
            let inclusion = matches!(
                item.command,
                command::FENCE_POLYGON_INCLUSION | command::FENCE_CIRCLE_INCLUSION
            );
            match item.command {
                command::FENCE_RETURN_POINT => fence.return_point = Some(at_point),
                command::FENCE_POLYGON_INCLUSION | command::FENCE_POLYGON_EXCLUSION => {
                    corners.push(at_point);
                    if corners.len() >= corner_count(item.params[0]) {
                        let shape = FenceShape::Polygon(std::mem::take(&mut corners));
                        fence.areas.push(FenceArea { shape, inclusion });
                    }
                }
                command::FENCE_CIRCLE_INCLUSION | command::FENCE_CIRCLE_EXCLUSION
                    if item.params[0] > 0.0 =>
                {
                    let shape = FenceShape::Circle {
                        center: at_point,
                        radius_m: item.params[0],
                    };
                    fence.areas.push(FenceArea { shape, inclusion });
                }
                _ => {}
            }
        }
        fence
    }
}

/// The number of a polygon's corners, raised to at least three.
fn corner_count(said: f32) -> usize {
    (said as usize).max(3)
}

#[derive(Debug, Clone, PartialEq, Default)]
pub struct RallyPlan {
    /// The points, in order.
    pub points: Vec<RallyPoint>,
}

/// A place where RTL may end.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RallyPoint {
    pub at_point: LatLon,
    /// The height in metres above the reference of `frame`.
    pub altitude_m: Option<f32>,
    /// The reference of its height.
    pub frame: HeightFrame,
}

impl RallyPlan {
    /// The rally points among these items.
    pub fn from_items(items: &[PlanItem]) -> Self {
        let rally = items
            .iter()
            .filter(|item| item.command == command::RALLY_POINT);
        let points = rally.filter_map(|item| {
            Some(RallyPoint {
                at_point: item.at_point?,
                altitude_m: item.altitude_m,
                frame: item.frame,
            })
        });
        Self {
            points: points.collect(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn item(command: u16, param1: f32, east: f64) -> PlanItem {
        PlanItem {
            seq: 0,
            command,
            frame: HeightFrame::Home,
            params: [param1, 0.0, 0.0, f32::NAN],
            at_point: Some(LatLon::new(50.0, 30.0 + east)),
            altitude_m: Some(20.0),
        }
    }

    #[test]
    fn a_fence_is_put_together_from_its_corners_and_circles() {
        let corner = |east| item(command::FENCE_POLYGON_INCLUSION, 3.0, east);
        let mut items: Vec<PlanItem> = [0.0, 0.1, 0.2].map(corner).to_vec();
        items.push(item(command::FENCE_CIRCLE_EXCLUSION, 25.0, 0.3));
        items.push(item(command::FENCE_CIRCLE_EXCLUSION, -1.0, 0.4));
        items.push(item(command::FENCE_RETURN_POINT, 0.0, 0.5));
        items.extend([0.6, 0.7, 0.8].map(|east| item(command::FENCE_POLYGON_EXCLUSION, 3.0, east)));
        let fence = FencePlan::from_items(&items);
        let inclusions: Vec<bool> = fence.areas.iter().map(|area| area.inclusion).collect();
        assert_eq!(inclusions, [true, false, false]);
        assert!(
            matches!(&fence.areas[0].shape, FenceShape::Polygon(corners) if corners.len() == 3)
        );
        assert!(
            matches!(fence.areas[1].shape, FenceShape::Circle { radius_m, .. } if (radius_m - 25.0).abs() < 1e-6)
        );
        assert_eq!(fence.return_point, items[5].at_point);
    }

    #[test]
    fn a_polygon_that_is_cut_short_is_no_area() {
        let items = [0.0, 0.1].map(|east| item(command::FENCE_POLYGON_INCLUSION, 2.0, east));
        assert_eq!(FencePlan::from_items(&items), FencePlan::default());
    }

    #[test]
    fn the_path_leaves_out_home_and_what_is_not_flown_to() {
        let plan = Plan {
            items: vec![
                item(16, 0.0, 0.0),
                item(22, 0.0, 0.1),
                item(201, 0.0, 0.2),
                item(16, 0.0, 0.3),
            ],
            home_first: true,
        };
        let commands: Vec<u16> = plan.path().map(|(item, _)| item.command).collect();
        assert_eq!(commands, [22, 16]);
        assert_eq!(plan.flown().len(), 3);
        assert!(Plan::default().flown().is_empty());
    }

    #[test]
    fn a_list_equals_itself_in_spite_of_parameters_that_are_not_set() {
        let plan = Plan {
            items: vec![item(16, 0.0, 0.0)],
            home_first: false,
        };
        let stored = Stored {
            content: Some(Arc::new(plan)),
            transfer: Transfer::Done,
        };
        assert_eq!(stored, stored.clone());
    }
}
