//! The console without its shell: its state ([`state`]), events ([`event`]), the user's actions
//! ([`action`]), effects for the shell ([`effect`]), and the one function that turns events and
//! actions into state and effects.
//!
//! Nothing here waits, reads a clock or touches a terminal: the shell feeds events to
//! [`App::update`], carries the effects out and draws when [`State::revision`] has changed. The
//! shell can read the state but not change it.
//!
//! # How the parts fit
//! - What a key does: `keymap` finds its action in the current room or overlay, `room` does what
//!   belongs to one room (its cursor, its keys, the hints in its footer), `update` everything else.
//!   `room_list` is the list of rooms.
//! - What a line does, and when an order needs a confirmation: `update`, with the reasons from
//!   `state`.
//! - When an alert begins, rings and ends: `state` (`active_alerts`, `bell`).
//! - Which faults the commands in keymaps and macros have: `lines`. Which key a step of a lesson
//!   names: `lesson`.
//! - What a jump of a replay restores: `snapshot`.

use std::collections::BTreeMap;
use std::sync::Arc;

use crate::config::{Config, DEFAULT_THEME};
use crate::parameters::ParameterDocuments;
use crate::scoring::TryReport;
use crate::text::Locale;
use crate::workshop::Design;
use effect::Effect;
use event::Event;
use keymap::Keymap;
use state::{ClassRole, CrewPart, MissionListing};

pub mod action;
pub mod effect;
pub mod event;
pub mod keymap;
mod lesson;
pub mod lines;
pub mod room;
pub mod room_list;
mod snapshot;
pub mod state;
#[cfg(test)]
mod testing;
mod update;

pub use room::State;
pub use snapshot::FlightSnapshot;

/// The initial content of the console.
#[derive(Debug, Clone)]
pub struct Setup {
    pub config: Config,
    pub keymap: Keymap,
    /// The documentation of parameters.
    pub documents: Arc<ParameterDocuments>,
    /// The texts of the language in use.
    pub locale: Arc<Locale>,
    /// The name of the theme in use.
    pub theme: String,
    /// The names of the available themes.
    pub themes: Vec<String>,
    pub missions: Vec<MissionListing>,
    /// The attempts at current revisions of missions, by mission id, oldest first.
    pub tries: BTreeMap<String, Vec<TryReport>>,
    /// The designs that come with the program.
    pub stock: Vec<Design>,
    /// Earlier lines of the command line, oldest first.
    pub history: Vec<String>,
    /// Whether ArduPilot's SITL is available.
    pub has_ardupilot: bool,
    /// Whether rooms are drawn; the plain console has only the vehicles.
    pub has_rooms: bool,
    /// The console's part in a class.
    pub class: ClassRole,
    /// The console's part in a crew.
    pub crew: CrewPart,
}

impl Default for Setup {
    fn default() -> Self {
        Self {
            config: Config::default(),
            keymap: Keymap::default(),
            documents: Arc::default(),
            locale: Arc::default(),
            theme: DEFAULT_THEME.to_owned(),
            themes: Vec::new(),
            missions: Vec::new(),
            tries: BTreeMap::new(),
            stock: Vec::new(),
            history: Vec::new(),
            has_ardupilot: false,
            has_rooms: true,
            class: ClassRole::None,
            crew: CrewPart::None,
        }
    }
}

/// The console. Only [`App::update`] changes its state.
#[derive(Debug, Clone)]
pub struct App {
    state: State,
}

impl App {
    /// A console on its home screen.
    pub fn new(setup: Setup) -> Self {
        Self {
            state: State::new(setup),
        }
    }

    /// The state that the screens show.
    pub fn state(&self) -> &State {
        &self.state
    }

    /// Handles an event, and returns the work for the shell.
    #[must_use = "the shell has to carry the effects out"]
    pub fn update(&mut self, event: impl Into<Event>) -> Vec<Effect> {
        update::update(&mut self.state, event.into()).into_vec()
    }
}
