use sortie_geo::LatLon;

use crate::{command, frame};

/// The kind of a list: each is uploaded, downloaded and cleared separately.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum ListKind {
    /// The items that the mode AUTO flies.
    Plan,
    /// The areas in which the vehicle may or may not fly.
    Fence,
    /// Places other than home where RTL may end.
    Rally,
}

impl ListKind {
    /// All kinds of lists, in the order of `MAV_MISSION_TYPE`.
    pub const ALL: [Self; 3] = [Self::Plan, Self::Fence, Self::Rally];

    /// The list with this number in `MAV_MISSION_TYPE`, if there is one.
    pub fn numbered(number: u8) -> Option<Self> {
        Self::ALL.get(usize::from(number)).copied()
    }

    /// The list's name in commands and texts.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Plan => "plan",
            Self::Fence => "fence",
            Self::Rally => "rally",
        }
    }

    /// The list's number in `MAV_MISSION_TYPE`.
    pub const fn number(self) -> u8 {
        self as u8
    }
}

/// An item of a list, with all fields of `MISSION_ITEM_INT` except its number, which is its place in the list.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Item {
    /// The number of a `MAV_CMD`, which may be missing from the dialect.
    pub command: u16,
    /// The number of a `MAV_FRAME`. The `_INT` variant of a frame has a different number, but the
    /// same reference.
    pub frame: u8,
    /// Whether the vehicle continues with the next item on its own.
    pub auto_continue: bool,
    /// The first four parameters of the command; NaN means "not set".
    pub params: [f32; 4],
    /// Latitude in 1e-7 degrees if the command has a place, otherwise the fifth parameter.
    pub x: i32,
    /// Longitude in 1e-7 degrees if the command has a place, otherwise the sixth parameter.
    pub y: i32,
    /// Altitude in metres above the reference of the frame, or the seventh parameter.
    pub z: f32,
}

/// The level that an altitude is measured from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum HeightFrame {
    /// Above mean sea level.
    SeaLevel,
    /// Above the home position.
    Home,
    /// Above the ground below.
    Terrain,
    /// Another reference, or none (`MAV_FRAME_MISSION`, local frames).
    Other,
}

impl HeightFrame {
    /// The reference of a `MAV_FRAME`, given by its number. Older autopilots use the `_INT` variants.
    pub const fn of(frame: u8) -> Self {
        match frame {
            frame::SEA_LEVEL | 5 => Self::SeaLevel,
            frame::ABOVE_HOME | 6 => Self::Home,
            frame::ABOVE_TERRAIN | 11 => Self::Terrain,
            _ => Self::Other,
        }
    }
}

impl Item {
    /// An item of a fence without a height; `size` is the radius of a circle or the number of a polygon's corners, and
    /// the place is in 1e-7 degrees.
    pub(crate) fn of_fence(command: u16, size: f32, x: i32, y: i32) -> Self {
        Self {
            command,
            frame: frame::SEA_LEVEL,
            auto_continue: true,
            params: [size, 0.0, 0.0, 0.0],
            x,
            y,
            z: 0.0,
        }
    }

    /// The level that the item's altitude is measured from.
    pub const fn height_frame(&self) -> HeightFrame {
        HeightFrame::of(self.frame)
    }

    /// Whether the vehicle flies to the item at a height above the ground.
    pub fn is_above_terrain(&self) -> bool {
        command::is_flown_to(self.command) && self.height_frame() == HeightFrame::Terrain
    }

    /// The item's x and y as a point, whether or not the command has a place.
    pub fn point(&self) -> LatLon {
        LatLon::from_e7(self.x, self.y)
    }
}
