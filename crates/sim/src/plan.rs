//! Uploaded lists: the mission, the fence and the rally points, item by item.

/// An item of a list, as received.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Item {
    /// The number of a `MAV_CMD`.
    pub(super) command: u16,
    /// The number of a `MAV_FRAME`.
    pub(super) frame: u8,
    pub(super) auto_continue: bool,
    /// The first four parameters of the command.
    pub(super) p: [f32; 4],
    /// Latitude, in 1e-7 degrees, if the command has a place; otherwise the fifth parameter.
    pub(super) x: i32,
    /// Longitude, in 1e-7 degrees, or the sixth parameter.
    pub(super) y: i32,
    /// Altitude in metres of the frame, or the seventh parameter.
    pub(super) z: f32,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum ListKind {
    Mission,
    Fence,
    Rally,
}

impl ListKind {
    pub(super) const ALL: [Self; 3] = [Self::Mission, Self::Fence, Self::Rally];

    /// The list of a `MAV_MISSION_TYPE`, if a vehicle has such a list.
    pub(super) fn numbered(number: u8) -> Option<Self> {
        Self::ALL.get(usize::from(number)).copied()
    }

    /// Its number as a `MAV_MISSION_TYPE`.
    pub(super) fn number(self) -> u8 {
        self as u8
    }

    pub(super) fn most(self) -> usize {
        match self {
            Self::Mission => 650,
            Self::Fence => 70,
            Self::Rally => 46,
        }
    }
}

/// The three lists of a vehicle. They survive a reboot.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Plans {
    /// Item 0 is home, item 1 the first command; empty without a mission.
    pub(super) mission: Vec<Item>,
    pub(super) fence: Vec<Item>,
    pub(super) rally: Vec<Item>,
}

impl Plans {
    /// An item of the mission by its number.
    pub(super) fn item(&self, at: u16) -> Option<Item> {
        self.mission.get(usize::from(at)).copied()
    }

    /// One of the lists.
    pub(super) fn list(&self, kind: ListKind) -> &Vec<Item> {
        match kind {
            ListKind::Mission => &self.mission,
            ListKind::Fence => &self.fence,
            ListKind::Rally => &self.rally,
        }
    }

    /// One of the lists, to be changed.
    pub(super) fn list_mut(&mut self, kind: ListKind) -> &mut Vec<Item> {
        match kind {
            ListKind::Mission => &mut self.mission,
            ListKind::Fence => &mut self.fence,
            ListKind::Rally => &mut self.rally,
        }
    }
}
