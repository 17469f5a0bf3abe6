//! How the console is set up.

use std::path::PathBuf;
use std::sync::Arc;

use crate::app::keymap::Keymap;
use crate::config::Config;
use crate::hangar::{SitlSource, VehicleBackend};
use crate::link::Address;
use crate::mission::Mission;
use crate::scoring::FlownBy;
use crate::store::{History, Records, Runs};
use crate::text::Text;
use crate::ui::{Look, Themes};

/// What the console begins with.
#[derive(Debug, Clone)]
pub enum Opening {
    Home,
    Mission(Arc<Mission>),
    Free,
    /// Vehicles that are already there.
    Connect(Vec<Address>),
    /// A recording, by one of its files.
    Replay(PathBuf),
}

/// How the console is set up.
#[derive(Debug, Clone)]
pub struct ConsoleOptions {
    /// What it begins with.
    pub opening: Opening,
    pub backend: VehicleBackend,
    /// ArduPilot's SITL where it could be started without being asked for.
    pub ardupilot: Option<SitlSource>,
    /// Simulated vehicles in free flight.
    pub vehicles: u8,
    /// What varies missions and simulation; `None` leaves it to the console.
    pub seed: Option<u64>,
    /// Simulated seconds per second.
    pub speedup: f64,
    /// What gives the commands: a person, or a pipe.
    pub flown_by: FlownBy,
    /// What it looks like.
    pub look: Look,
    /// What its user has set.
    pub preferences: Preferences,
}

#[cfg(test)]
impl ConsoleOptions {
    /// One simulated vehicle, the same every time, flown by hand.
    pub fn for_test(opening: Opening) -> Self {
        Self {
            flown_by: FlownBy::Hand,
            opening,
            backend: VehicleBackend::default(),
            ardupilot: None,
            vehicles: 1,
            seed: Some(1),
            speedup: 1.0,
            look: Look::default(),
            preferences: Preferences::default(),
        }
    }
}

/// What a user brings along.
#[derive(Debug, Clone, Default)]
pub struct Preferences {
    pub config: Config,
    /// Whether the command line says the language: then no profile changes it.
    pub is_lang_given: bool,
    /// What the keys mean.
    pub keymap: Keymap,
    /// The themes on offer.
    pub themes: Themes,
    /// Where the lines of the command line are kept; nowhere for measurements.
    pub history: Option<History>,
    /// Where flown missions are recorded; nowhere for measurements.
    pub runs: Option<Runs>,
    /// Where flights are recorded to be replayed; nowhere for measurements, or if the user does not want it.
    pub records: Option<Records>,
    /// The folder of profiles; none are kept for measurements.
    pub data: Option<PathBuf>,
    /// Whose career it is, by name.
    pub profile: Option<String>,
    /// What has to be said at the start: what is wrong with the user's files.
    pub warnings: Vec<Text>,
}
