//! Read access to the state for other modules. The fields are private to `app`, so that only `app` changes them.

use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::Duration;

use super::{
    ActiveAlerts, Activity, Display, FlightView, ForwardSummary, Hangar, Histories, Keymap,
    LinkSummary, NoticeLog, Overlay, ReplayView, Room, Selection, SessionPace, State, TimeFlow,
    Training, Typing,
};
use crate::config::Config;
use crate::debrief::WorkloadStrips;
use crate::doctor::{Cause, LinkFinding, Way, Weight};
use crate::geo::LatLon;
use crate::language::Groups;
use crate::ledger::Ledger;
use crate::mission::Progress;
use crate::text;
use crate::text::{Locale, Text};
use crate::vehicle::{VehicleId, Vehicles};

impl<R> State<R> {
    /// Flight time: the time since the start of the program or, in a replay, of the recording.
    pub fn now(&self) -> Duration {
        self.now
    }

    /// Time since the start of the program by the wall clock.
    pub fn wall(&self) -> Duration {
        self.wall
    }

    /// The workload of the replayed flight, with a mark at the moment shown; `None` while it is
    /// unknown.
    pub fn workload_strips<'a>(
        &'a self,
        locale: &'a Locale,
        width: usize,
    ) -> Option<WorkloadStrips<'a>> {
        let report = self.replay.as_ref()?.report.as_ref()?;
        let workload = Some(&report.workload).filter(|it| !it.is_empty())?;
        Some(WorkloadStrips {
            workload,
            width,
            cursor: self.session.task.progress.as_ref().map(|it| it.elapsed),
            locale,
        })
    }

    /// The recording that is being replayed, if any.
    pub fn replay(&self) -> Option<&ReplayView> {
        self.replay.as_ref()
    }

    pub fn room(&self) -> Room {
        self.room
    }

    /// The state of every room.
    pub fn rooms(&self) -> &R {
        &self.rooms
    }

    /// The overlay over the room.
    pub fn overlay(&self) -> Option<&Overlay> {
        self.overlay.as_ref()
    }

    pub fn session(&self) -> &FlightView {
        &self.session
    }

    /// The notices so far, oldest first.
    pub fn notices(&self) -> &NoticeLog {
        &self.notices
    }

    pub fn typing(&self) -> &Typing {
        &self.typing
    }

    pub fn training(&self) -> &Training {
        &self.training
    }

    pub fn display(&self) -> &Display {
        &self.display
    }
}

/// The user's settings, and the terminal.
impl<R> State<R> {
    pub fn config(&self) -> &Config {
        &self.config
    }

    /// The texts of the language in use.
    pub fn locale(&self) -> &Arc<Locale> {
        &self.locale
    }

    pub fn keymap(&self) -> &Keymap {
        &self.keymap
    }
}

/// The vehicles and the selection.
impl FlightView {
    /// The vehicles with their latest telemetry.
    pub fn vehicles(&self) -> &Vehicles {
        &self.vehicles
    }

    /// The histories of the vehicles' readings.
    pub fn histories(&self) -> &Histories {
        &self.histories
    }

    pub fn alerts(&self) -> &ActiveAlerts {
        &self.alerts
    }

    /// The selected vehicles; without any, commands go to the one under the cursor.
    pub fn selection(&self) -> &Selection {
        &self.choice.selection
    }

    /// The vehicle under the cursor.
    pub fn cursor(&self) -> Option<VehicleId> {
        self.choice.cursor
    }

    /// The groups that commands may name.
    pub fn groups(&self) -> &Groups {
        &self.choice.groups
    }

    /// The places that commands may name.
    pub fn places(&self) -> &BTreeMap<String, LatLon> {
        &self.places
    }
}

/// The activity and its progress.
impl FlightView {
    /// The kind of session; `None` between sessions.
    pub fn activity(&self) -> Option<&Activity> {
        self.activity.as_ref()
    }

    /// When the session began, on the program's clock.
    pub fn began_at(&self) -> Duration {
        self.timing.began_at
    }

    /// The mission's progress, if there is one.
    pub fn mission(&self) -> Option<&Progress> {
        self.task.progress.as_ref()
    }

    /// Whether the mission is over and its debrief is ready.
    pub fn is_over(&self) -> bool {
        self.task.over
    }

    /// The speed-up of simulated time.
    pub fn pace(&self) -> SessionPace {
        self.timing.pace
    }

    /// Whether the program may be suspended: with the embedded simulator, that pauses the session,
    /// which exams and some missions do not allow.
    pub fn may_be_stopped(&self) -> bool {
        let listing = self.task.listing.as_ref().filter(|_| !self.task.over);
        self.hangar.is_some() || listing.is_none_or(|it| it.pausable)
    }

    /// Whether the session is paused.
    pub fn is_paused(&self) -> bool {
        self.timing.flow == TimeFlow::Paused
    }

    /// Whether the session's mission has not begun because the brief is still shown.
    pub fn is_reading(&self) -> bool {
        self.timing.flow == TimeFlow::AwaitsReader
    }

    /// Whether the session's mission clock has started.
    pub fn has_flight_begun(&self) -> bool {
        let mission = self.task.progress.as_ref();
        mission.is_some_and(|progress| !progress.elapsed.is_zero())
    }

    /// Starts the mission if it is waiting for the user to leave the brief.
    pub(in crate::app) fn leave_brief(&mut self) {
        if self.is_reading() {
            self.timing.flow = TimeFlow::Passes;
        }
    }

    /// All commands of the session.
    pub fn ledger(&self) -> &Ledger {
        &self.commands.ledger
    }

    /// The forwards to other ground stations.
    pub fn forwards(&self) -> &[ForwardSummary] {
        &self.connections.forwards
    }

    /// The links, in the order of their addresses.
    pub fn links(&self) -> &[LinkSummary] {
        &self.connections.links
    }

    /// Whether a link is open but nothing at all has arrived on it.
    pub fn hears_nothing(&self, link: usize) -> bool {
        let is_open = self.links().get(link).is_some_and(|it| it.up);
        let mut findings = self.findings().iter();
        is_open && findings.any(|it| it.link == link && it.cause == Cause::Nothing)
    }

    /// Whether a finding explains why a link that should lead to a vehicle leads to none.
    pub fn lacks_vehicle(&self, finding: &LinkFinding) -> bool {
        // The stages of processes tell how far those are which are not heard yet.
        let waits_for_process = finding.way == Way::Pipe && !self.vehicles().is_empty();
        finding.cause.weight() == Weight::Fatal
            && !waits_for_process
            && !self.carries_vehicle(finding.link)
    }

    /// The state of a link as text.
    pub fn link_state(&self, link: usize) -> Text {
        if self.hears_nothing(link) {
            return text!("link-open-silent");
        }
        let links = self.links().get(link);
        links.map_or_else(|| Text::verbatim(""), |it| it.state.clone())
    }

    /// The findings of the link doctor, worst first.
    pub fn findings(&self) -> &[LinkFinding] {
        &self.connections.findings
    }

    /// The processes that simulate the vehicles, if any.
    pub fn hangar(&self) -> Option<&Hangar> {
        self.hangar.as_ref()
    }
}
