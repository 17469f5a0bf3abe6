//! What other modules may read of the state. Its fields are private to `app`, so that only `app` changes them.

use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::Duration;

use super::{
    Activity, Alarms, Career, FlightView, Hangar, Histories, Keymap, LinkSummary, MissionListing,
    NoticeLog, Overlay, ReplayView, Room, Selection, SessionPace, State, TimeFlow,
};
use crate::campaign::Reward;
use crate::config::Config;
use crate::doctor::LinkFinding;
use crate::geo::{GridSize, LatLon};
use crate::language::Groups;
use crate::ledger::Ledger;
use crate::mission::Progress;
use crate::scoring::TryReport;
use crate::text::Locale;
use crate::vehicle::{VehicleId, Vehicles};
use crate::workshop::Design;

/// What is shown, and where one is in it.
impl<R> State<R> {
    /// The time of what is flown: since the program began, or since the beginning of what is replayed.
    pub fn now(&self) -> Duration {
        self.now
    }

    /// The recording that is replayed, if one is.
    pub fn replay(&self) -> Option<&ReplayView> {
        self.replay.as_ref()
    }

    /// The room that is shown.
    pub fn room(&self) -> Room {
        self.room
    }

    /// What every room remembers.
    pub fn rooms(&self) -> &R {
        &self.rooms
    }

    /// What lies over the room.
    pub fn overlay(&self) -> Option<&Overlay> {
        self.overlay.as_ref()
    }

    /// What is being flown.
    pub fn session(&self) -> &FlightView {
        &self.session
    }

    /// The notices so far, oldest first.
    pub fn notices(&self) -> &NoticeLog {
        &self.notices
    }

    /// The vehicle list that is being typed, `3-9`; empty if none.
    pub fn typed(&self) -> &str {
        &self.typed
    }

    /// Whether lines of a macro wait for the answer to a question.
    pub fn is_in_macro(&self) -> bool {
        !self.pending.is_empty()
    }

    /// The line of the command line that was given last.
    pub fn last_line(&self) -> Option<&str> {
        self.history.back().map(String::as_str)
    }
}

/// What the user has set, and the terminal that it is shown on.
impl<R> State<R> {
    /// What the user has set.
    pub fn config(&self) -> &Config {
        &self.config
    }

    /// The words of the language in use.
    pub fn locale(&self) -> &Arc<Locale> {
        &self.locale
    }

    /// What the keys do.
    pub fn keymap(&self) -> &Keymap {
        &self.keymap
    }

    /// Columns and rows of the terminal.
    pub fn size(&self) -> (u16, u16) {
        self.size
    }

    /// The terminal as a grid of cells.
    pub fn grid(&self) -> GridSize {
        let (columns, rows) = self.size;
        GridSize::new(columns, rows)
    }

    /// What the line to the terminal carries in bytes per second, while it cannot keep up.
    pub fn slow_line(&self) -> Option<u32> {
        self.slow_line
    }
}

/// What there is to fly, and who flies it.
impl<R> State<R> {
    /// The missions on offer.
    pub fn missions(&self) -> &[MissionListing] {
        &self.missions
    }

    /// The trainee's career; `None` where no flights are kept.
    pub fn career(&self) -> Option<&Career> {
        self.career.as_ref()
    }

    /// What the last flight brought to the career; nothing once another session has started.
    pub fn reward(&self) -> Option<&Reward> {
        self.reward.as_ref()
    }

    /// The trainee's tries at a mission as it is now, oldest first.
    pub fn tries(&self, mission: &str) -> &[TryReport] {
        self.tries.get(mission).map_or(&[], Vec::as_slice)
    }

    /// The drones that were chosen for a mission: one for all seats or one each. Where there are none, the mission
    /// lends its own.
    pub fn fleet(&self, mission: &str) -> &[Design] {
        self.fleets.get(mission).map_or(&[], Vec::as_slice)
    }
}

/// The vehicles, and which of them are meant.
impl FlightView {
    /// The vehicles, as their telemetry said last.
    pub fn vehicles(&self) -> &Vehicles {
        &self.vehicles
    }

    /// What their readings were.
    pub fn histories(&self) -> &Histories {
        &self.histories
    }

    /// What is wrong with them.
    pub fn alarms(&self) -> &Alarms {
        &self.alarms
    }

    /// The vehicles that commands go to; none selected means the one under the cursor.
    pub fn selection(&self) -> &Selection {
        &self.selection
    }

    /// The vehicle under the cursor.
    pub fn cursor(&self) -> Option<VehicleId> {
        self.cursor
    }

    /// The groups that commands may name.
    pub fn groups(&self) -> &Groups {
        &self.groups
    }

    /// The places that commands may name.
    pub fn places(&self) -> &BTreeMap<String, LatLon> {
        &self.places
    }
}

/// What is done, and how it goes.
impl FlightView {
    /// What is being done; `None` between sessions.
    pub fn activity(&self) -> Option<&Activity> {
        self.activity.as_ref()
    }

    /// When the session began, on the program's clock.
    pub fn began_at(&self) -> Duration {
        self.began_at
    }

    /// The mission's progress, if one is flown.
    pub fn mission(&self) -> Option<&Progress> {
        self.mission.as_ref()
    }

    /// Whether the mission is over: its debrief is there.
    pub fn is_over(&self) -> bool {
        self.over
    }

    /// How fast simulated time passes.
    pub fn pace(&self) -> SessionPace {
        self.pace
    }

    /// Whether the session stands still.
    pub fn is_paused(&self) -> bool {
        self.flow == TimeFlow::Paused
    }

    /// Whether its mission has not begun yet because the brief has not been left.
    pub fn is_reading(&self) -> bool {
        self.flow == TimeFlow::AwaitsReader
    }

    /// Whether its mission's clock has started.
    pub fn has_flight_begun(&self) -> bool {
        let mission = self.mission.as_ref();
        mission.is_some_and(|progress| !progress.elapsed.is_zero())
    }

    /// The mission may begin; does nothing unless it awaits that.
    pub(in crate::app) fn leave_brief(&mut self) {
        if self.is_reading() {
            self.flow = TimeFlow::Passes;
        }
    }

    /// All commands of the session.
    pub fn ledger(&self) -> &Ledger {
        &self.ledger
    }

    /// The links, in the order of their addresses.
    pub fn links(&self) -> &[LinkSummary] {
        &self.links
    }

    /// What the link doctor has found, worst first.
    pub fn findings(&self) -> &[LinkFinding] {
        &self.findings
    }

    /// The processes that simulate the vehicles, where there are any.
    pub fn hangar(&self) -> Option<&Hangar> {
        self.hangar.as_ref()
    }
}
