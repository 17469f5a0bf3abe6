//! Uploaded lists: the mission, the fence and the rally points, item by item.

pub(super) use sortie_plan::{Item, ListKind, frame};

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
            ListKind::Plan => &self.mission,
            ListKind::Fence => &self.fence,
            ListKind::Rally => &self.rally,
        }
    }

    /// One of the lists, to be changed.
    pub(super) fn list_mut(&mut self, kind: ListKind) -> &mut Vec<Item> {
        match kind {
            ListKind::Plan => &mut self.mission,
            ListKind::Fence => &mut self.fence,
            ListKind::Rally => &mut self.rally,
        }
    }
}
