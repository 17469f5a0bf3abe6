//! The console's state. Only [`App::update`](super::App::update) changes it; drawing reads it.
//!
//! # How the parts fit
//! - What needs attention: `alert` derives the conditions of a vehicle from its telemetry, `separation` and `traffic`
//!   find vehicles and other aircraft that come too close; `active_alerts` decides when an alert begins, becomes
//!   worse, ends, and is acknowledged or muted; `bell` decides when it rings. `notices` folds repeated notices into
//!   one line.
//! - The session: `flight_view` is all that is dropped at its end; `timing`, `time` and `pace` are its clock, its
//!   pauses and its speed-up; `flown_mission` the mission; `session_ledger` finds a vehicle's current command;
//!   `links` and `hangar` hold the state of connections and processes; `history` and `heights` keep past readings;
//!   `replay` and `ghost` show recorded flights.
//! - Why an order needs a confirmation: `plan_failures` (plans that failed in a rehearsal) and `mission_fence`
//!   (targets outside a fence of the mission, or above its ceiling).
//! - The user: `choice` (cursor, selection, groups), `filter` and `column` (which vehicles the table shows, by what
//!   they are sorted; `arrange` in `room/fly` sorts), `typing`, `overlay` (questions and prompts), `help` (made
//!   from the keymap and the verbs), `names` (the names that a line may use), `sticks`; `display` has the size of
//!   the smallest terminal. `training` and `career` hold missions, results and standing.
//! - The class: `class` (a seat or the desk), `seat_report` (what a seat says of itself), `danger` (collisions and broken
//!   fences that are near). `crew` is the part in a crew, of the host or of a member.
//! - `views` is what other modules may read.

use std::sync::Arc;
use std::time::Duration;

use super::action::Action;
use super::keymap::Place;
use crate::config::{Config, Symbols};
use crate::mission::Stake;
use crate::parameters::ParameterDocuments;
use crate::scoring::workload_question;
use crate::text::{Language, Locale, Text};
use crate::vehicle::VehicleId;
use crate::vehicle::{Severity, VehicleClass};

mod active_alerts;
mod alert;
mod bell;
mod career;
mod choice;
mod class;
mod column;
mod crew;
mod danger;
mod display;
mod filter;
mod flight_view;
mod flown_mission;
mod ghost;
mod hangar;
mod heights;
mod help;
mod history;
mod insight;
mod links;
mod member_rights;
mod mission_fence;
mod names;
mod notices;
mod overlay;
mod pace;
mod plan_failures;
mod replay;
mod seat_report;
mod separation;
mod session_ledger;
mod sticks;
mod time;
mod timing;
mod traffic;
mod training;
mod typing;
mod views;

use super::Setup;
pub use super::keymap::Keymap;
pub use super::room_list::Room;
pub use crate::mission::Listing as MissionListing;
pub use active_alerts::{ActiveAlerts, Pressing, Standing};
pub use alert::{Alert, alert, alerts};
pub use bell::{BellCall, Due};
pub use career::Career;
pub use choice::{Choice, Selection};
pub(in crate::app) use class::{
    ArmedOrder, HeldBrief, OpenTry, OrderTrace, PendingOrder, SeatSituation, WaitingStep,
};
pub use class::{ClassRole, SeatPlace, ShownTry};
pub use column::SortKey;
pub use crew::{AskedLine, CrewLink, CrewPart, MemberPlace};
pub use display::{Display, SMALLEST, is_too_small};
pub use filter::VehicleFilter;
pub use flight_view::{Activity, FlightView};
pub use flown_mission::FlownMission;
pub use ghost::Ghost;
pub use hangar::{Hangar, Instance, SitlStage};
pub use heights::Heights;
pub use help::{DeskView, HelpLine, HelpPage, HelpScene, SHORT_USAGE, command_help, help_lines};
pub use history::{Channel, Histories, History, Window};
pub use insight::{FlightTruth, TrueVehicle};
pub use links::{Connections, ForwardSummary, LinkCounters, LinkSummary};
pub use notices::{NoticeLine, NoticeLog};
pub use overlay::{
    Confirm, Consequence, Log, Overlay, Palette, ParameterSetting, Prompt, Purpose, YES,
};
pub use pace::{SessionPace, rate};
pub use plan_failures::PlanFailures;
pub use replay::{ReplayPosition, ReplayView};
pub use separation::{CloseVehicle, separation_limits, too_close};
pub use session_ledger::SessionLedger;
pub use sticks::{StickAxis, StickMode};
pub use time::SessionTime;
pub use timing::{TimeFlow, Timing};
pub use traffic::{TrackedAircraft, TrafficConflict, TrafficPicture, VehicleApproach};
pub use training::{Trainee, Training};
pub(in crate::app) use typing::Folder;
pub use typing::Typing;

/// How long a message that needs attention stays on the last line of the screen.
const MESSAGE_LIFE: Duration = Duration::from_secs(8);
/// How long a confirmation stays on the last line of the screen.
const ACKNOWLEDGEMENT_LIFE: Duration = Duration::from_secs(4);

/// The console's state; `R` is the state of the rooms.
#[derive(Debug, Clone)]
pub struct State<R> {
    /// Flight time: the time since the start of the program or, in a replay, of the recording.
    pub(in crate::app) now: Duration,
    /// The program's clock, without the pauses of a session; it also runs during a replay.
    pub(in crate::app) clock: Duration,
    /// The replay, if there is one.
    pub(in crate::app) replay: Option<ReplayView>,
    /// Another flight of the mission, shown beside this one.
    pub(in crate::app) ghost: Option<Ghost>,
    pub(in crate::app) room: Room,
    /// The state of the rooms.
    pub(in crate::app) rooms: R,
    /// The overlay over the room.
    pub(in crate::app) overlay: Option<Overlay>,
    pub(in crate::app) session: FlightView,
    pub(in crate::app) typing: Typing,
    /// Time since the start of the program by the wall clock, including pauses.
    pub(in crate::app) wall: Duration,
    pub(in crate::app) config: Config,
    /// The texts of the language in use.
    pub(in crate::app) locale: Arc<Locale>,
    pub(in crate::app) notices: NoticeLog,
    pub(in crate::app) training: Training,
    pub(in crate::app) display: Display,
    pub(in crate::app) keymap: Keymap,
    /// The documentation of parameters.
    pub(in crate::app) documents: Arc<ParameterDocuments>,
    /// Whether ArduPilot's SITL is available.
    pub(in crate::app) has_ardupilot: bool,
    /// The console's part in a class.
    pub(in crate::app) class: ClassRole,
    /// The console's part in a crew.
    pub(in crate::app) crew: CrewPart,
    message: Option<Message>,
    revision: u64,
}

/// A message of the console, shown for a while on the last line.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Message {
    pub text: Text,
    pub severity: Severity,
    at: Duration,
}

impl Message {
    fn life(&self) -> Duration {
        if self.severity < Severity::Notice {
            MESSAGE_LIFE
        } else {
            ACKNOWLEDGEMENT_LIFE
        }
    }
}

impl<R: Default> State<R> {
    /// A console on its home screen.
    pub(in crate::app) fn new(setup: Setup) -> Self {
        Self {
            now: Duration::ZERO,
            clock: Duration::ZERO,
            wall: Duration::ZERO,
            replay: None,
            ghost: None,
            room: match setup.class {
                ClassRole::Desk(_) => Room::Class,
                ClassRole::None | ClassRole::Seat(_) => Room::Home,
            },
            rooms: R::default(),
            overlay: None,
            session: FlightView::default(),
            typing: Typing::after(&setup.history),
            config: setup.config,
            locale: setup.locale,
            notices: NoticeLog::default(),
            training: Training {
                missions: setup.missions,
                tries: setup.tries,
                stock: setup.stock,
                ..Training::default()
            },
            display: Display {
                size: SMALLEST,
                slow_line: None,
                has_rooms: setup.has_rooms,
                themes: setup.themes,
                theme: setup.theme,
            },
            keymap: setup.keymap,
            documents: setup.documents,
            has_ardupilot: setup.has_ardupilot,
            class: setup.class,
            crew: setup.crew,
            message: None,
            revision: 0,
        }
    }
}

impl<R> State<R> {
    /// A number that increases whenever something visible may have changed.
    pub fn revision(&self) -> u64 {
        self.revision
    }

    /// Marks the screen as changed.
    pub fn touch(&mut self) {
        self.revision += 1;
    }

    /// Ends the replay, if there is one: flight time then follows the program's clock again.
    pub(in crate::app) fn leave_replay(&mut self) {
        self.replay = None;
        self.now = self.clock;
    }

    /// The number of entries in a log.
    pub fn log_length(&self, log: Log) -> usize {
        match log {
            Log::Notices => self.notices.lines().len(),
            Log::Traffic => self.session.traffic.tracked().len(),
            Log::Moments => self.replay.as_ref().map_or(0, |it| it.moments.len()),
        }
    }

    /// The latest message, until its display time is over.
    pub fn message(&self) -> Option<&Message> {
        self.message
            .as_ref()
            .filter(|message| self.wall.saturating_sub(message.at) < message.life())
    }

    /// Switches to a language; returns false if the terminal cannot show its letters.
    pub fn speak(&mut self, language: Language) -> bool {
        // Words of other scripts would show only question marks.
        if language != Language::English && self.config.symbols == Some(Symbols::Ascii) {
            return false;
        }
        self.config.lang = Some(language);
        self.locale = Arc::new(Locale::new(language));
        true
    }

    /// Shows a message on the last line.
    pub fn say(&mut self, severity: Severity, text: impl Into<Text>) {
        self.message = Some(Message {
            text: text.into(),
            severity,
            at: self.wall,
        });
    }

    /// The key of an action in the current room, for messages.
    pub fn key(&self, action: Action) -> Text {
        self.keymap.key(action, Place::In(self.room))
    }

    /// Another flight of the mission, shown beside this one.
    pub fn ghost(&self) -> Option<&Ghost> {
        self.ghost.as_ref()
    }

    /// The other flight's time, if one is shown and has begun.
    pub fn ghost_time(&self) -> Option<Duration> {
        let elapsed = self.session.task.progress.as_ref()?.elapsed;
        self.ghost.as_ref()?.time(elapsed)
    }

    /// Asks a question that `y` confirms.
    pub fn ask(&mut self, question: Text, reason: Text, then: Consequence) {
        self.overlay = Some(Overlay::Confirm(Confirm::new(question, reason, then)));
    }

    /// Opens a prompt; the proposed text can be edited.
    pub fn prompt(&mut self, purpose: Purpose, entered: impl Into<String>) {
        let is_proposal = matches!(
            purpose,
            Purpose::SaveDesign
                | Purpose::CopyDesign(_)
                | Purpose::RenameDesign(_)
                | Purpose::ExportDesign
                | Purpose::Filter(_)
        );
        self.overlay = Some(Overlay::Prompt(Prompt {
            input: entered.into().into(),
            is_proposal,
            ..Prompt::new(purpose)
        }));
    }

    pub fn hush(&mut self) {
        self.message = None;
    }

    /// The targets of a command that names none: the selection, or the vehicle under the cursor.
    pub fn addressed(&self) -> Vec<VehicleId> {
        self.session.choice.vehicles()
    }

    /// Whether the room's keys have a row of their own above the timeline of a replay.
    pub fn has_keys_above_replay(&self) -> bool {
        self.shows_past() && self.room.is_apart_from_flight()
    }

    /// The listing of the mission that is being flown.
    pub fn flown_mission(&self) -> Option<&MissionListing> {
        self.session.task.listing.as_deref()
    }

    /// Whether a question about the workload is open now: it is due by mission time and has not been answered. Lessons and exams
    /// and replays have none, and the user can turn them off.
    pub fn asks_workload(&self) -> bool {
        let session = &self.session;
        let Some(progress) = session
            .task
            .progress
            .as_ref()
            .filter(|_| !session.task.over)
        else {
            return false;
        };
        let question = workload_question(progress.elapsed);
        let is_open = question.is_some() && question != progress.answered_question;
        let is_exam = matches!(
            session.activity,
            Some(Activity::Mission {
                stake: Stake::Exam,
                ..
            })
        );
        // A guided lesson asks for one thing at a time.
        is_open
            && !is_exam
            && progress.lesson.is_none()
            && self.replay.is_none()
            && self.config.workload.ask
    }

    /// Whether the trainee can still enter a prediction and a goal for the flight.
    pub fn can_pledge(&self) -> bool {
        let progress = self.session.task.progress.as_ref();
        !self.session.task.over && progress.is_none_or(|progress| progress.can_pledge)
    }

    /// The class whose modes are valid on the command line: that of the first target's modes; a copter if it is
    /// unknown.
    pub fn class(&self) -> VehicleClass {
        let first = self.addressed().first().copied();
        let vehicle = first.and_then(|id| self.session.vehicles.get(&id));
        let heartbeat = vehicle.and_then(|vehicle| vehicle.heartbeat);
        heartbeat.map_or(VehicleClass::Copter, |heartbeat| heartbeat.mode.class)
    }
}
