//! The console's configuration, from files, variables and flags.
//!
//! [`SETTINGS`] declares every setting once; [`Layers`] combines defaults, file, environment and flags and keeps the
//! source of each value.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use strum::{EnumString, VariantNames};

use crate::alert::AlertKind;
use crate::rehearsal::{TOO_NEAR_M, TOO_NEAR_VERTICALLY_M};
use crate::text::Language;
use crate::vehicle_id::VehicleIds;
use crate::wire::SystemId;

mod layers;
mod live;
mod setting;
mod show;
mod table;

#[cfg(test)]
mod tests;

pub use layers::{Layers, Origin, WordCheck};
pub use live::LiveSetting;
pub use setting::{SETTINGS, Setting, SettingKind};
pub use show::setting_reference;
pub use table::{Column, TableConfig, TableSort};

/// The name of the theme that is used if none is chosen; the others inherit from it.
pub const DEFAULT_THEME: &str = "dark";

/// The settings; each has a default.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Config {
    /// The language of the screens; `None` follows the shell's locale.
    pub lang: Option<Language>,
    /// The name of the profile in use.
    pub profile: Option<String>,
    pub theme: String,
    /// The maximum number of frames per second.
    pub fps: u8,
    /// The symbols for curves and maps; `None` follows the terminal.
    pub symbols: Option<Symbols>,
    /// Whether the mouse is used.
    pub mouse: bool,
    pub table: TableConfig,
    /// The signals of alerts.
    pub alerts: AlertsConfig,
    /// Named sequences of lines of the command language.
    pub macros: BTreeMap<String, Vec<String>>,
    /// The path of the keymap file; by default, the one in the configuration folder.
    pub keymap: Option<String>,
    /// The question to trainees about their workload.
    pub workload: WorkloadConfig,
    /// The recording of flights.
    pub records: RecordsConfig,
    /// The program's own log.
    pub log: LogConfig,
    pub hangar: HangarConfig,
    pub connect: ConnectConfig,
    pub results: ResultsConfig,
    pub parameters: ParametersConfig,
    pub events: EventsConfig,
    pub class: ClassConfig,
}

/// The class of an instructor.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ClassConfig {
    /// The class that consoles ask to join, by name or path, or the file of a join line.
    pub join: Option<String>,
    /// The user name of its instructor; by default that of the owner of the class's folder.
    pub instructor: Option<String>,
    /// Whether the instructor may take over vehicles that the console does not simulate itself: they may be real.
    pub take_over: bool,
}

/// The parameters of vehicles.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ParametersConfig {
    /// The path of a file with the documentation of parameters; without it, none is shown.
    pub documentation: Option<String>,
}

/// The events of vehicles.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct EventsConfig {
    /// The path of a file with the texts of events; without it, they are shown by number until the vehicle's are read.
    pub documentation: Option<String>,
}

/// The storage of trainees' results.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ResultsConfig {
    pub readers: Readers,
}

/// Who may read profiles, recorded runs and reports.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, VariantNames)]
#[serde(rename_all = "lowercase")]
#[strum(serialize_all = "lowercase")]
pub enum Readers {
    /// Only the trainee may read the results.
    #[default]
    Owner,
    /// The group of the results' folder may read them, too.
    Group,
}

/// Sessions with running vehicles.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ConnectConfig {
    /// The vehicles that belong to the swarm, such as `1-4,7`; without it, all vehicles that are heard.
    pub expect: Option<VehicleIds>,
    /// The forwards to other ground stations, such as `udp:127.0.0.1:14550 read-only`.
    pub forward: Vec<String>,
    /// Whether frames without a valid signature are ignored.
    pub require_signing: bool,
    /// The system id of this program; the usual one if there is none.
    pub station: Option<SystemId>,
}

/// The symbols that a terminal can show besides letters.
#[derive(
    Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, EnumString, VariantNames,
)]
#[serde(rename_all = "lowercase")]
#[strum(serialize_all = "lowercase")]
pub enum Symbols {
    /// Braille patterns, two by four dots in a cell.
    #[default]
    Braille,
    /// Blocks and box characters.
    Block,
    Ascii,
}

/// The signals of alerts.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct AlertsConfig {
    /// Whether serious alerts ring the bell.
    pub bell: bool,
    /// Whether serious alerts request a desktop notification from the terminal (OSC 9).
    pub notify: bool,
    /// The kinds of alerts without a signal.
    pub mute: Vec<AlertKind>,
    /// The horizontal distance below which two vehicles in the air are too close to each other, in
    /// metres; 0 for no alert.
    pub separation: u16,
    /// The vertical distance, in metres, below which such vehicles are too close to each other.
    pub separation_height: u16,
}

/// The question to trainees about their workload.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct WorkloadConfig {
    /// Whether missions ask about the workload every two minutes.
    pub ask: bool,
}

impl Default for WorkloadConfig {
    fn default() -> Self {
        Self { ask: true }
    }
}

/// The recording of flights, and the limits of their storage.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct RecordsConfig {
    /// Whether sessions are recorded.
    pub enabled: bool,
    /// The number of records kept; the oldest are removed first.
    pub count: u32,
    /// The limit on the size of all records, in MiB.
    pub space: u64,
}

impl Default for RecordsConfig {
    /// The default space holds about seven hours of flight with 32 vehicles.
    fn default() -> Self {
        Self {
            enabled: true,
            count: 200,
            space: 4096,
        }
    }
}

/// SITL processes of the hangar, and their limits.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct HangarConfig {
    /// The SITL program for multirotors; if not set, the console looks for one.
    pub arducopter: Option<String>,
    /// The SITL program for planes.
    pub arduplane: Option<String>,
    /// The SITL program for rovers and boats.
    pub ardurover: Option<String>,
    /// The SITL program for submarines.
    pub ardusub: Option<String>,
    /// How many instances may run at the same time.
    pub instances: u16,
    /// The limit on the address space of one instance, in MiB.
    pub memory: u64,
    /// Restart policy for instances that end without a request.
    pub restart: Restart,
    /// The folder for the instances' files; by default, a folder in the state folder.
    pub folder: Option<String>,
    /// The URLs of the services that start the vehicles; by default, the console starts them
    /// itself.
    pub urls: Vec<String>,
    /// The file with the token of the services; by default, the file in the state folder.
    pub token_file: Option<String>,
}

/// Restart policy for an instance that has ended without a request.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, VariantNames)]
#[serde(rename_all = "lowercase")]
#[strum(serialize_all = "lowercase")]
pub enum Restart {
    /// It stays down until a restart is requested.
    #[default]
    Never,
    /// It is started again after growing delays, until it has failed five times in a row.
    Always,
}

impl Default for HangarConfig {
    fn default() -> Self {
        Self {
            arducopter: None,
            arduplane: None,
            ardurover: None,
            ardusub: None,
            instances: 64,
            memory: 1024,
            restart: Restart::Never,
            folder: None,
            urls: Vec::new(),
            token_file: None,
        }
    }
}

/// The program's own log.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct LogConfig {
    /// The path of the log file; without it, no log is written.
    pub file: Option<String>,
    /// The level of detail, as directives of `tracing`: `info`, `warn,sortie::link=debug`.
    pub level: String,
}

impl Default for LogConfig {
    fn default() -> Self {
        Self {
            file: None,
            level: "info".to_owned(),
        }
    }
}

impl Default for Config {
    fn default() -> Self {
        Self {
            lang: None,
            profile: None,
            theme: DEFAULT_THEME.to_owned(),
            fps: 10,
            symbols: None,
            mouse: false,
            table: TableConfig::default(),
            alerts: AlertsConfig::default(),
            macros: BTreeMap::new(),
            keymap: None,
            workload: WorkloadConfig::default(),
            records: RecordsConfig::default(),
            log: LogConfig::default(),
            hangar: HangarConfig::default(),
            connect: ConnectConfig::default(),
            results: ResultsConfig::default(),
            parameters: ParametersConfig::default(),
            events: EventsConfig::default(),
            class: ClassConfig::default(),
        }
    }
}

impl Default for AlertsConfig {
    /// The default separation limits are the conflict limits of the rehearsal.
    fn default() -> Self {
        Self {
            bell: true,
            notify: false,
            mute: Vec::new(),
            separation: TOO_NEAR_M as u16,
            separation_height: TOO_NEAR_VERTICALLY_M as u16,
        }
    }
}
