//! The console's state. Only [`App::update`](super::App::update) changes it; drawing reads it.

use std::collections::{BTreeMap, BTreeSet, VecDeque};
use std::sync::Arc;
use std::time::Duration;

use super::action::Action;
use super::effect::Launch;
use super::keymap::Place;
use crate::campaign::Reward;
use crate::config::{Config, Symbols};
use crate::mission::Stake;
use crate::review::Review;
use crate::scoring::{TryReport, workload_question};
use crate::text::{Language, Locale, Text};
use crate::vehicle::VehicleId;
use crate::vehicle::{Severity, VehicleClass};
use crate::workshop::Design;

mod alarms;
mod alert;
mod bell;
mod career;
mod column;
mod filter;
mod flight_view;
mod ghost;
mod hangar;
mod heights;
mod help;
mod history;
mod links;
mod names;
mod notices;
mod overlay;
mod pace;
mod profiles;
mod replay;
mod time;
mod views;

use super::Setup;
pub use super::keymap::Keymap;
pub use super::room_list::Room;
pub use crate::mission::Listing as MissionListing;
pub use alarms::{Alarms, Pressing, Standing};
pub use alert::{Alert, alert, alerts};
pub use bell::{BellCall, Due};
pub use career::Career;
pub use column::SortKey;
pub use filter::VehicleFilter;
pub use flight_view::{Activity, FlightView, TimeFlow};
pub use ghost::Ghost;
pub use hangar::{Hangar, Instance, SitlStage};
pub use heights::Heights;
pub use help::{HelpLine, HelpPage, SHORT_USAGE, command_help, help_lines};
pub use history::{Channel, Histories, History, Window};
pub use links::{ForwardSummary, LinkSummary};
pub use notices::{NoticeLine, NoticeLog};
pub use overlay::{Confirm, Consequence, Log, Overlay, Palette, ParameterSetting, Prompt, Purpose};
pub use pace::{SessionPace, rate};
pub use profiles::Trainee;
pub use replay::{ReplayPosition, ReplayView};
pub use time::SessionTime;

/// The smallest terminal that the console fits into: columns and rows.
pub const SMALLEST: (u16, u16) = (80, 24);
/// The length of the command line's history.
const HISTORY_KEPT: usize = 200;
/// How long a message stays on the last line of the screen: one that needs attention, and a confirmation.
const MESSAGE_LIFE: Duration = Duration::from_secs(8);
const ACKNOWLEDGEMENT_LIFE: Duration = Duration::from_secs(4);

/// The console's state; `R` is the rooms' part.
#[derive(Debug, Clone)]
pub struct State<R> {
    /// Flight time: since the start of the program, or of the recording in a replay.
    pub(in crate::app) now: Duration,
    /// The replay, if there is one.
    pub(in crate::app) replay: Option<ReplayView>,
    /// Another flight of the mission, shown beside this one.
    pub(in crate::app) ghost: Option<Ghost>,
    pub(in crate::app) room: Room,
    /// The state of every room.
    pub(in crate::app) rooms: R,
    /// The overlay over the room.
    pub(in crate::app) overlay: Option<Overlay>,
    pub(in crate::app) session: FlightView,
    /// The vehicle list being typed, `3-9`; empty without one.
    pub(in crate::app) typed: String,
    /// Time since the start of the program by the wall clock: this also runs during a pause.
    pub(in crate::app) wall: Duration,
    /// When the previous key answered a question that changed the session, by the wall clock.
    pub(in crate::app) answered_at: Option<Duration>,
    pub(in crate::app) config: Config,
    /// The texts of the language in use.
    pub(in crate::app) locale: Arc<Locale>,
    /// Lines of a macro that wait for an answer.
    pub(in crate::app) pending: VecDeque<String>,
    pub(in crate::app) notices: NoticeLog,
    pub(in crate::app) missions: Vec<MissionListing>,
    /// The trainee's attempts at their current revisions, by the mission's id, oldest first.
    pub(in crate::app) tries: BTreeMap<String, Vec<TryReport>>,
    /// The trainee's newest review of each mission, by the mission's id.
    pub(in crate::app) reviews: BTreeMap<String, Review>,
    /// The trainee's career; `None` without a profile.
    pub(in crate::app) career: Option<Career>,
    /// The rewards of the last flight; `None` once another session has started.
    pub(in crate::app) reward: Option<Reward>,
    /// The names of all profiles.
    pub(in crate::app) profiles: Vec<String>,
    /// The drones chosen for missions, by the mission's id: one for all seats or one per seat; empty for the mission's
    /// own.
    pub(in crate::app) fleets: BTreeMap<String, Vec<Design>>,
    /// The designs that come with the program.
    pub(in crate::app) stock: Vec<Design>,
    /// The names of the available themes.
    pub(in crate::app) themes: Vec<String>,
    /// The name of the theme in use.
    pub(in crate::app) theme: String,
    pub(in crate::app) keymap: Keymap,
    /// The command history, oldest first.
    pub(in crate::app) history: VecDeque<String>,
    /// The size of the terminal: columns and rows.
    pub(in crate::app) size: (u16, u16),
    /// Whether ArduPilot's SITL is available.
    pub(in crate::app) has_ardupilot: bool,
    /// Whether rooms are drawn; the plain console has none.
    pub(in crate::app) has_rooms: bool,
    /// The bytes per second that the line to the terminal carries, while it cannot keep up.
    pub(in crate::app) slow_line: Option<u32>,
    /// The console's latest message.
    message: Option<Message>,
    revision: u64,
}

/// A message of the console, shown for a while on the last line.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Message {
    pub text: Text,
    /// How serious it is.
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
        let mut state = Self {
            now: Duration::ZERO,
            replay: None,
            ghost: None,
            room: Room::Home,
            rooms: R::default(),
            typed: String::new(),
            wall: Duration::ZERO,
            answered_at: None,
            config: setup.config,
            locale: setup.locale,
            pending: VecDeque::new(),
            overlay: None,
            session: FlightView::default(),
            notices: NoticeLog::default(),
            missions: setup.missions,
            tries: setup.tries,
            reviews: BTreeMap::new(),
            career: None,
            reward: None,
            profiles: Vec::new(),
            fleets: BTreeMap::new(),
            stock: setup.stock,
            themes: setup.themes,
            theme: setup.theme,
            keymap: setup.keymap,
            history: VecDeque::new(),
            size: SMALLEST,
            has_ardupilot: setup.has_ardupilot,
            has_rooms: setup.has_rooms,
            slow_line: None,
            message: None,
            revision: 0,
        };
        for line in &setup.history {
            state.remember(line);
        }
        state
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

    /// Whether the terminal is too small to show anything, so that keys would be pressed blindly.
    pub fn is_too_small(&self) -> bool {
        self.size.0 < SMALLEST.0 || self.size.1 < SMALLEST.1
    }

    /// The number of a log's entries.
    pub fn log_length(&self, log: Log) -> usize {
        match log {
            Log::Notices => self.notices.lines().len(),
            Log::Moments => self.replay.as_ref().map_or(0, |it| it.moments.len()),
        }
    }

    /// The message, while it is fresh.
    pub fn message(&self) -> Option<&Message> {
        self.message
            .as_ref()
            .filter(|message| self.wall.saturating_sub(message.at) < message.life())
    }

    /// Switches to a language, if the terminal can show its letters.
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
        let elapsed = self.session.mission.as_ref()?.elapsed;
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
        if self.session.selection.is_empty() {
            self.session.cursor.into_iter().collect()
        } else {
            self.session.selection.iter().copied().collect()
        }
    }

    /// Adds a line to the history, without duplicates.
    pub fn remember(&mut self, line: &str) {
        self.history.retain(|known| known != line);
        self.history.push_back(line.to_owned());
        if self.history.len() > HISTORY_KEPT {
            self.history.pop_front();
        }
    }

    /// A graded flight of a mission with the drones chosen for it.
    pub fn launch(&self, mission: &str) -> Launch {
        Launch {
            fleet: self.fleets.get(mission).cloned().unwrap_or_default(),
            ..Launch::graded(mission)
        }
    }

    /// Why the mission is locked for the trainee; `None` without a profile.
    pub fn lock(&self, mission: &str) -> Option<Text> {
        self.career.as_ref()?.lock(mission)
    }

    /// The listing of the mission that is being flown.
    pub fn flown_mission(&self) -> Option<&MissionListing> {
        self.session.listing.as_deref()
    }

    /// Whether the trainee is asked now for the workload: in the air, except in exams, until the question is
    /// answered.
    pub fn asks_workload(&self) -> bool {
        let session = &self.session;
        let Some(progress) = session.mission.as_ref().filter(|_| !session.over) else {
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
        is_open && !is_exam && self.replay.is_none() && self.config.workload.ask
    }

    /// Whether the trainee can still enter a prediction and a goal for the flight.
    pub fn can_pledge(&self) -> bool {
        let progress = self.session.mission.as_ref();
        !self.session.over && progress.is_none_or(|progress| progress.can_pledge)
    }

    /// The trainee's best attempt that counts and earned points; of several equal ones, the first.
    pub fn best_try(&self, mission: &str) -> Option<&TryReport> {
        let tries = self.tries.get(mission)?.iter();
        let ended = tries.filter(|one| one.score > Some(0) && !one.is_practice);
        ended.rev().max_by_key(|one| one.score)
    }

    /// The vehicle class for modes on the command line: that of the first target.
    pub fn class(&self) -> VehicleClass {
        let first = self.addressed().first().copied();
        let vehicle = first.and_then(|id| self.session.vehicles.get(&id));
        let heartbeat = vehicle.and_then(|vehicle| vehicle.heartbeat);
        heartbeat.map_or(VehicleClass::Copter, |heartbeat| heartbeat.class)
    }
}

pub type Selection = BTreeSet<VehicleId>;
