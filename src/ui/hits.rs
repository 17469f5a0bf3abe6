//! Clickable areas of the last frame.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use ratatui::layout::{Position, Rect};

use crate::app::action::Action;

/// The clickable areas of the screen with their actions, refilled in every frame.
#[derive(Debug, Clone, Default)]
pub struct Hits(Arc<Mutex<Vec<HitArea>>>);

#[derive(Debug, Clone, Copy)]
struct HitArea {
    place: Rect,
    action: Action,
}

impl Hits {
    /// Removes all areas before a new frame.
    pub fn clear(&self) {
        self.all().clear();
    }

    /// Adds an area with its action.
    pub fn add(&self, place: Rect, action: Action) {
        self.all().push(HitArea { place, action });
    }

    /// The action at a cell, if any; the area drawn last is on top.
    pub fn at(&self, column: u16, row: u16) -> Option<Action> {
        let at = Position::new(column, row);
        let all = self.all();
        let hit = all.iter().rfind(|hit| hit.place.contains(at));
        hit.map(|hit| hit.action)
    }

    fn all(&self) -> MutexGuard<'_, Vec<HitArea>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_drawn_last_lies_on_top() {
        let hits = Hits::default();
        hits.add(Rect::new(0, 0, 10, 2), Action::Help);
        hits.add(Rect::new(4, 1, 2, 1), Action::Quit);
        assert_eq!(hits.at(3, 1), Some(Action::Help));
        assert_eq!(hits.at(5, 1), Some(Action::Quit));
        assert_eq!(hits.at(10, 1), None);
        hits.clear();
        assert_eq!(hits.at(5, 1), None);
    }
}
