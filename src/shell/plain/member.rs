//! A member of a crew: the flights of the host, one after the other.

use super::Plain;
use crate::replay::Replay;

/// Whether the debrief of the flight was printed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum DebriefTold {
    NotYet,
    Told,
}

impl Plain {
    /// At a member of a crew: whether everything that has come from the host was shown.
    pub(super) fn has_played_all(&self) -> bool {
        let followed = self.console.replaying.as_ref();
        followed.is_none_or(Replay::is_at_end)
    }

    /// At a member of a crew: whether the host has begun another flight, of which nothing has been printed.
    pub(super) fn follows_other(&mut self) -> bool {
        let state = self.console.app.state();
        let member = state.crew().member();
        let followed = member.and(state.replay()).map(|view| view.name.clone());
        if followed.is_none() || followed == self.followed {
            return false;
        }
        self.report.begin_flight();
        (self.briefed, self.debrief_told) = (None, DebriefTold::NotYet);
        self.followed = followed;
        true
    }

    /// Prints the brief of the mission that the host of a crew begins.
    pub(super) fn brief_member(&mut self) {
        let state = self.console.app.state();
        if state.crew().member().is_none() {
            return;
        }
        let flown = state.flown_mission().map(|it| it.id.clone());
        if flown.is_some() && flown != self.briefed {
            self.brief();
        }
        self.briefed = flown;
    }
}
