//! The options of the console.

use std::path::PathBuf;
use std::sync::Arc;

use super::api::ApiOptions;
use super::class::ClassOptions;
use super::crew::CrewOptions;
use crate::app::keymap::Keymap;
use crate::config::Config;
use crate::forward::ForwardSpec;
use crate::hangar::{SitlSource, VehicleBackend};
use crate::link::{Address, Signer};
use crate::metadata::EventDocuments;
use crate::mission::Mission;
use crate::parameters::ParameterDocuments;
use crate::scoring::FlownBy;
use crate::store::{History, Records, Runs};
use crate::text::Text;
use crate::ui::{Look, Themes};

/// The first activity of the console.
#[derive(Debug, Clone)]
pub enum Opening {
    Home,
    Mission(Arc<Mission>),
    Free,
    /// Running vehicles at these addresses.
    Connect(Vec<Address>),
    /// A recording, by one of its files.
    Replay(PathBuf),
}

/// The settings and files with which the console starts.
#[derive(Debug, Clone)]
pub struct ConsoleOptions {
    /// The first activity of the console, such as the home screen or a mission.
    pub opening: Opening,
    pub backend: VehicleBackend,
    /// ArduPilot's SITL, if it is available for a choice on the home screen.
    pub ardupilot: Option<SitlSource>,
    /// The number of simulated vehicles in free flight.
    pub vehicles: u8,
    /// The seed of missions and simulation; `None` for a random one.
    pub seed: Option<u64>,
    /// The speed-up of simulated time.
    pub speedup: f64,
    /// The source of typed lines: a person, or a pipe.
    pub typed_by: FlownBy,
    /// The interface for programs, if one is wanted.
    pub api: Option<ApiOptions>,
    /// The console's part in a class, if it has one.
    pub class: Option<ClassOptions>,
    /// The console's part in a crew, if it has one.
    pub crew: Option<CrewOptions>,
    /// The forwards to other ground stations, in every session.
    pub forwards: Vec<ForwardSpec>,
    /// The look of the screen.
    pub look: Look,
    pub preferences: Preferences,
}

impl ConsoleOptions {
    /// The source of commands that a flight's record states: a script if programs may give
    /// commands.
    pub fn flown_by(&self) -> FlownBy {
        if self.api.as_ref().is_some_and(|api| api.commands) {
            FlownBy::Script
        } else {
            self.typed_by
        }
    }
}

#[cfg(test)]
impl ConsoleOptions {
    /// Options for one simulated vehicle with a fixed seed, flown by hand.
    pub fn for_test(opening: Opening) -> Self {
        Self {
            typed_by: FlownBy::Hand,
            api: None,
            class: None,
            crew: None,
            opening,
            backend: VehicleBackend::default(),
            ardupilot: None,
            vehicles: 1,
            seed: Some(1),
            speedup: 1.0,
            forwards: Vec::new(),
            look: Look::default(),
            preferences: Preferences::default(),
        }
    }
}

/// The preferences of a user.
#[derive(Debug, Clone, Default)]
pub struct Preferences {
    pub config: Config,
    /// Whether the command line sets the language: then a profile does not change it.
    pub is_lang_given: bool,
    pub keymap: Keymap,
    /// The documentation of parameters.
    pub documents: Arc<ParameterDocuments>,
    /// The texts of events.
    pub events: Arc<EventDocuments>,
    pub themes: Themes,
    /// The command history; `None` for measurements.
    pub history: Option<History>,
    /// The folder for records of missions; `None` for measurements.
    pub runs: Option<Runs>,
    /// The folder for records of flights; `None` for measurements, or if the user does not want them.
    pub records: Option<Records>,
    /// The folder of profiles; `None` for measurements.
    pub data: Option<PathBuf>,
    /// The profile to use, by name.
    pub profile: Option<String>,
    /// The keys of signed links; `None` for measurements.
    pub signer: Option<Signer>,
    /// Warnings to show at the start: faults in the user's files.
    pub warnings: Vec<Text>,
}
