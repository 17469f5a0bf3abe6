//! The known state of the lists on board a vehicle, as part of its model: their items and the progress of transfer.
//! `session` reads and writes them; each is a separate list in the mission protocol (`MAV_MISSION_TYPE`).

use std::sync::Arc;

use mavlink::dialects::ardupilotmega::MavCmd;

use crate::geo::LatLon;
use crate::plan::command::{is_flown_to, is_jump, is_navigation};
use crate::plan::{HeightFrame, Item};

/// The commands of the items in fences and rally points.
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
    /// The download failed; the list is requested again later.
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

/// The plan that the mode AUTO flies.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Plan {
    /// The items in order; the number of an item is its index.
    pub items: Vec<Item>,
    /// Whether item 0 is home and not part of the flight, as with ArduPilot.
    pub home_first: bool,
}

impl Plan {
    /// The items after home.
    pub fn flown(&self) -> &[Item] {
        let skip = usize::from(self.home_first).min(self.items.len());
        &self.items[skip..]
    }

    /// Whether a jump decides where the plan continues from an item: a jump comes before the next
    /// navigation command.
    pub fn jumps_from(&self, item: u16) -> bool {
        let ahead = self.items.iter().skip(usize::from(item));
        let mut decisive = ahead.filter(|it| is_jump(it.command) || is_navigation(it.command));
        decisive.next().is_some_and(|it| is_jump(it.command))
    }

    /// Whether the plan begins with a takeoff without a place; the path then starts at home.
    pub fn takes_off_in_place(&self) -> bool {
        let mut flown = self.flown().iter();
        let first = flown.find(|item| is_flown_to(item.command));
        first.is_some_and(|item| item.is_takeoff() && item.place().is_none())
    }

    /// The items that the vehicle flies to, by number, with their places, without home.
    pub fn path(&self) -> impl Iterator<Item = (usize, LatLon)> {
        let items = self.items.iter().enumerate();
        let flown = items.skip(usize::from(self.home_first));
        flown
            .filter(|(_, item)| item.is_waypoint())
            .filter_map(|(number, item)| Some((number, item.place()?)))
    }
}

/// A fence of areas. The simple fence by parameters (`FENCE_RADIUS`, `FENCE_ALT_MAX`) is not part
/// of it.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct FencePlan {
    /// The items, as they are on board.
    pub items: Vec<Item>,
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
    /// A circle, by its centre and its radius.
    Circle { center: LatLon, radius_m: f32 },
}

impl FencePlan {
    /// The fence of these items. Items without a place, circles without a radius, and commands that belong to no fence
    /// are left out. Parameter 1 of each corner is the number of the polygon's corners.
    pub fn from_items(items: Vec<Item>) -> Self {
        let mut fence = Self::default();
        let mut corners: Vec<LatLon> = Vec::new();
        for item in &items {
            let Some(at_point) = item.place() else {
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
        fence.items = items;
        fence
    }
}

/// The number of a polygon's corners, raised to at least three.
fn corner_count(said: f32) -> usize {
    (said as usize).max(3)
}

#[derive(Debug, Clone, PartialEq, Default)]
pub struct RallyPlan {
    /// The items, as they are on board.
    pub items: Vec<Item>,
    /// The points, in order.
    pub points: Vec<RallyPoint>,
}

/// A place where RTL may end.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RallyPoint {
    pub at_point: LatLon,
    /// The height in metres above the reference of `frame`.
    pub altitude_m: Option<f32>,
    /// The reference of the height.
    pub frame: HeightFrame,
}

impl RallyPlan {
    /// The rally points among these items.
    pub fn from_items(items: Vec<Item>) -> Self {
        let rally = items
            .iter()
            .filter(|item| item.command == command::RALLY_POINT);
        let points = rally.filter_map(|item| {
            Some(RallyPoint {
                at_point: item.place()?,
                altitude_m: item.altitude_m(),
                frame: item.height_frame(),
            })
        });
        Self {
            points: points.collect(),
            items,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn item(command: u16, param1: f32, east: f64) -> Item {
        let (x, y) = LatLon::new(50.0, 30.0 + east).to_e7();
        Item {
            command,
            frame: 3,
            auto_continue: true,
            params: [param1, 0.0, 0.0, f32::NAN],
            x,
            y,
            z: 20.0,
        }
    }

    #[test]
    fn a_fence_is_put_together_from_its_corners_and_circles() {
        let corner = |east| item(command::FENCE_POLYGON_INCLUSION, 3.0, east);
        let mut items: Vec<Item> = [0.0, 0.1, 0.2].map(corner).to_vec();
        items.push(item(command::FENCE_CIRCLE_EXCLUSION, 25.0, 0.3));
        items.push(item(command::FENCE_CIRCLE_EXCLUSION, -1.0, 0.4));
        items.push(item(command::FENCE_RETURN_POINT, 0.0, 0.5));
        items.extend([0.6, 0.7, 0.8].map(|east| item(command::FENCE_POLYGON_EXCLUSION, 3.0, east)));
        let fence = FencePlan::from_items(items.clone());
        let inclusions: Vec<bool> = fence.areas.iter().map(|area| area.inclusion).collect();
        assert_eq!(inclusions, [true, false, false]);
        assert!(
            matches!(&fence.areas[0].shape, FenceShape::Polygon(corners) if corners.len() == 3)
        );
        assert!(
            matches!(fence.areas[1].shape, FenceShape::Circle { radius_m, .. } if (radius_m - 25.0).abs() < 1e-6)
        );
        assert_eq!(fence.return_point, items[5].place());
    }

    #[test]
    fn a_polygon_that_is_cut_short_is_no_area() {
        let items = [0.0, 0.1].map(|east| item(command::FENCE_POLYGON_INCLUSION, 2.0, east));
        assert!(FencePlan::from_items(items.to_vec()).areas.is_empty());
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
        let commands: Vec<u16> = plan.path().map(|(at, _)| plan.items[at].command).collect();
        assert_eq!(commands, [22, 16]);
        assert_eq!(plan.flown().len(), 3);
        assert!(Plan::default().flown().is_empty());
    }

    #[test]
    fn only_a_takeoff_without_a_place_is_in_place() {
        let takeoff = Item {
            x: 0,
            y: 0,
            ..item(22, 0.0, 0.0)
        };
        let first = |first: Item| Plan {
            items: vec![item(16, 0.0, 0.0), first, item(16, 0.0, 0.3)],
            home_first: true,
        };
        assert!(first(takeoff).takes_off_in_place());
        assert!(!first(item(22, 0.0, 0.1)).takes_off_in_place());
        assert!(!first(item(16, 0.0, 0.1)).takes_off_in_place());
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
