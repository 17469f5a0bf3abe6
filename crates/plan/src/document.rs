//! The content of a plan file.

use crate::{Item, ListKind};

/// The lists of one vehicle, and home.
///
/// Items of the plan are numbered from 1, because 0 is home (ArduPilot's count): the jump target 3 is `plan[2]`.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Document {
    /// Where the vehicle is meant to start, if the file states it.
    pub home: Option<Home>,
    /// The items that the mode AUTO flies, without home.
    pub plan: Vec<Item>,
    /// The areas in which the vehicle may or may not fly.
    pub fence: Vec<Item>,
    /// Places other than home where RTL may end.
    pub rally: Vec<Item>,
    /// The ground station's data about the vehicle, if the format stores them.
    pub origin: Option<Origin>,
}

/// The planned home position.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Home {
    /// Latitude in 1e-7 degrees.
    pub x: i32,
    /// Longitude in 1e-7 degrees.
    pub y: i32,
    /// Metres above mean sea level.
    pub z: f32,
}

/// The data about the vehicle in a `.plan` file.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Origin {
    /// The number of a `MAV_AUTOPILOT`.
    pub firmware: u8,
    /// The number of a `MAV_TYPE`.
    pub vehicle: u8,
    /// The cruise speed of a fixed-wing aircraft, in m/s.
    pub cruise_speed_m_s: f32,
    /// The speed of a multicopter, in m/s.
    pub hover_speed_m_s: f32,
}

impl Default for Origin {
    /// A quadcopter with ArduPilot, and QGroundControl's usual speeds.
    fn default() -> Self {
        Self {
            firmware: 3,
            vehicle: 2,
            cruise_speed_m_s: 15.0,
            hover_speed_m_s: 5.0,
        }
    }
}

impl Document {
    /// The items of one list.
    pub fn list(&self, kind: ListKind) -> &Vec<Item> {
        match kind {
            ListKind::Plan => &self.plan,
            ListKind::Fence => &self.fence,
            ListKind::Rally => &self.rally,
        }
    }

    /// The items of one list, for changing them.
    pub fn list_mut(&mut self, kind: ListKind) -> &mut Vec<Item> {
        match kind {
            ListKind::Plan => &mut self.plan,
            ListKind::Fence => &mut self.fence,
            ListKind::Rally => &mut self.rally,
        }
    }

    /// The lists that are not empty.
    pub fn kinds(&self) -> impl Iterator<Item = ListKind> {
        let all = ListKind::ALL.into_iter();
        all.filter(|kind| !self.list(*kind).is_empty())
    }

    /// Whether home and all lists are the same, bit for bit: an unset parameter (NaN) equals itself.
    pub fn is_same(&self, other: &Self) -> bool {
        let homes = match (self.home, other.home) {
            (Some(mine), Some(others)) => {
                (mine.x, mine.y) == (others.x, others.y) && same_number(mine.z, others.z)
            }
            (None, None) => true,
            (Some(_), None) | (None, Some(_)) => false,
        };
        homes
            && ListKind::ALL.into_iter().all(|kind| {
                let (mine, others) = (self.list(kind), other.list(kind));
                mine.len() == others.len() && mine.iter().zip(others).all(|(a, b)| a.is_same(b))
            })
    }
}

impl Item {
    /// Whether every field is the same, bit for bit: an unset parameter (NaN) equals itself.
    pub fn is_same(&self, other: &Self) -> bool {
        let params = self.params.iter().zip(&other.params);
        (self.command, self.frame, self.auto_continue, self.x, self.y)
            == (
                other.command,
                other.frame,
                other.auto_continue,
                other.x,
                other.y,
            )
            && params.into_iter().all(|(a, b)| same_number(*a, *b))
            && same_number(self.z, other.z)
    }
}

fn same_number(a: f32, b: f32) -> bool {
    a.to_bits() == b.to_bits() || (a.is_nan() && b.is_nan())
}
