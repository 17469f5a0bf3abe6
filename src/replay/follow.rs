//! Recordings that are followed while they are made.

use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

use super::{Film, Index, Replay, Stage};
use crate::app::event::Event;
use crate::crew::CrewViewpoint;
use crate::text::Text;

impl Replay {
    /// Opens a recording that is still being made; it is played as far as [`complete`](Self::complete) says. It has no
    /// index, so it cannot jump.
    ///
    /// # Errors
    /// As [`open`](Self::open).
    pub fn follow(path: &Path, viewpoint: &CrewViewpoint) -> Result<(Self, Vec<Event>), Text> {
        let film = Arc::new(Film::open_growing(path)?);
        let stage = Stage::new(&film)?.seen_from(viewpoint.clone());
        Ok(Self::of(film, stage, Index::none(), false))
    }

    /// Notes that a recording that is still being made is complete up to a time.
    pub fn complete(&mut self, to: Duration) {
        self.complete_to = self.complete_to.map(|known| known.max(to));
    }

    /// Plays as far as the recording is complete; returns the events.
    pub(super) fn follow_to(&mut self, to: Duration) -> Vec<Event> {
        self.stage.grow();
        self.player.go_to(to);
        let mut events = self.approach();
        events.extend(self.stage.read_late());
        events.extend(self.news());
        events
    }
}
