//! Every setting: its name, its valid values, and its environment variable.

use strum::VariantNames as _;
use toml::Value;

use super::{Column, Readers, Symbols, TableSort};
use crate::alert::AlertKind;
use crate::diagnostic::{Diagnostic, nearest};
use crate::text;
use crate::text::{Language, Text};
use crate::vehicle_id::VehicleIds;

/// A setting of the configuration, with its valid values.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Setting {
    /// Its name with its section, such as `alerts.bell`.
    pub name: &'static str,
    pub kind: SettingKind,
    /// The environment variable that sets the value.
    pub variable: Option<&'static str>,
    /// Its purpose, as a comment in a configuration file.
    pub about: &'static str,
}

/// The valid values of a setting.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SettingKind {
    /// One of these words.
    OneOf(&'static [&'static str]),
    Text,
    /// A whole number within a range, both ends included.
    Whole(i64, i64),
    /// Yes or no: `true` or `false`.
    Flag,
    /// A list of words.
    Words,
    /// A list of columns of the swarm table.
    Columns,
    /// A column of the swarm table to sort by, or nothing.
    Sort,
    /// A list of kinds of alerts.
    AlertKinds,
    /// Vehicles by number: `1-4,7`.
    Vehicles,
    /// A table of named lines: each a text or a list of texts.
    Lines,
}

/// Every setting, in the order in which they are printed: first those without a section.
pub const SETTINGS: &[Setting] = &[
    setting(
        "lang",
        SettingKind::OneOf(Language::CODES),
        Some("SORTIE_LANG"),
        "Language; by default that of the shell (LC_ALL, LC_MESSAGES, LANG). In the console, the language that \
         `:set lang` stored in the profile takes precedence over both, and `--lang` over all.",
    ),
    setting(
        "profile",
        SettingKind::Text,
        Some("SORTIE_PROFILE"),
        "The profile to use (`sortie profile list`).",
    ),
    setting(
        "theme",
        SettingKind::Text,
        Some("SORTIE_THEME"),
        "The theme: dark, light, high-contrast, monochrome, or a file in the folder themes.",
    ),
    setting(
        "fps",
        SettingKind::Whole(Setting::FPS_LEAST, Setting::FPS_MOST),
        Some("SORTIE_FPS"),
        "Maximum number of frames per second.",
    ),
    setting(
        "symbols",
        SettingKind::OneOf(Symbols::VARIANTS),
        Some("SORTIE_SYMBOLS"),
        "Characters for curves and maps: braille, block or ascii; by default what the terminal can show.",
    ),
    setting(
        "mouse",
        SettingKind::Flag,
        Some("SORTIE_MOUSE"),
        "Whether the console uses the mouse.",
    ),
    setting(
        "keymap",
        SettingKind::Text,
        Some("SORTIE_KEYMAP"),
        "The keymap file; by default keymap.toml next to this file.",
    ),
    setting(
        "table.columns",
        SettingKind::Columns,
        None,
        "Columns of the swarm table, from left to right; an empty list shows as many as fit.",
    ),
    setting(
        "table.sort",
        SettingKind::Sort,
        None,
        "Column to sort by; a - before the name puts the largest value first.",
    ),
    setting(
        "alerts.bell",
        SettingKind::Flag,
        Some("SORTIE_BELL"),
        "Whether serious alerts ring the bell.",
    ),
    setting(
        "alerts.notify",
        SettingKind::Flag,
        Some("SORTIE_NOTIFY"),
        "Whether serious alerts ask the terminal for a desktop notification.",
    ),
    setting(
        "alerts.mute",
        SettingKind::AlertKinds,
        None,
        "The kinds of alerts that stay silent.",
    ),
    setting(
        "alerts.separation",
        SettingKind::Whole(0, 1000),
        None,
        "Horizontal distance in m below which vehicles in the air are too close to each other, outside of missions; 0 for no alert.",
    ),
    setting(
        "alerts.separation_height",
        SettingKind::Whole(0, 1000),
        None,
        "Vertical distance in m below which vehicles in the air are too close to each other.",
    ),
    setting(
        "workload.ask",
        SettingKind::Flag,
        Some("SORTIE_ASK_WORKLOAD"),
        "Whether missions ask for your workload every two minutes; exams never ask.",
    ),
    setting(
        "records.enabled",
        SettingKind::Flag,
        Some("SORTIE_RECORD"),
        "Whether flights are recorded for replay.",
    ),
    setting(
        "records.count",
        SettingKind::Whole(1, 100_000),
        None,
        "Number of records kept; the oldest are removed first.",
    ),
    setting(
        "records.space",
        SettingKind::Whole(16, 16 * 1024 * 1024),
        None,
        "Maximum size of all records in MiB; a single record may take up half of it.",
    ),
    setting(
        "log.file",
        SettingKind::Text,
        Some("SORTIE_LOG_FILE"),
        "Log file; a relative path is in the state folder.",
    ),
    setting(
        "log.level",
        SettingKind::Text,
        Some("SORTIE_LOG"),
        "Log levels: error, warn, info, debug, trace, or \"warn,sortie::link=debug\".",
    ),
    setting(
        "hangar.arducopter",
        SettingKind::Text,
        Some("SORTIE_ARDUCOPTER"),
        "SITL program for multirotors; by default the one on the PATH or in a usual build folder.",
    ),
    setting(
        "hangar.arduplane",
        SettingKind::Text,
        Some("SORTIE_ARDUPLANE"),
        "SITL program for planes.",
    ),
    setting(
        "hangar.ardurover",
        SettingKind::Text,
        Some("SORTIE_ARDUROVER"),
        "SITL program for rovers and boats.",
    ),
    setting(
        "hangar.ardusub",
        SettingKind::Text,
        Some("SORTIE_ARDUSUB"),
        "SITL program for submarines.",
    ),
    setting(
        "hangar.instances",
        SettingKind::Whole(1, 1000),
        None,
        "Maximum number of SITL processes.",
    ),
    setting(
        "hangar.memory",
        SettingKind::Whole(64, 65_536),
        None,
        "Maximum address space of one SITL process, in MiB.",
    ),
    setting(
        "hangar.restart",
        SettingKind::OneOf(&["never", "always"]),
        None,
        "Whether a SITL process that ends on its own is restarted.",
    ),
    setting(
        "hangar.folder",
        SettingKind::Text,
        None,
        "Folder in which SITL processes run; by default the folder hangar in the state folder.",
    ),
    setting(
        "hangar.urls",
        SettingKind::Words,
        Some("SORTIE_HANGAR"),
        "Services (`sortie hangar`) that start SITL instead of this program: [\"http://127.0.0.1:5700\"].",
    ),
    setting(
        "hangar.token_file",
        SettingKind::Text,
        Some("SORTIE_HANGAR_TOKEN_FILE"),
        "File with the token of the services; by default hangar-token in the state folder.",
    ),
    setting(
        "results.readers",
        SettingKind::OneOf(Readers::VARIANTS),
        Some("SORTIE_READERS"),
        "Who may read profiles, recorded runs and reports: owner, or group (the group of the data folder).",
    ),
    setting(
        "connect.expect",
        SettingKind::Vehicles,
        None,
        "The vehicles that belong to the swarm: \"1-4,7\"; `all` leaves out any other.",
    ),
    setting(
        "connect.forward",
        SettingKind::Words,
        None,
        "Forwards of `sortie fly` and `sortie connect`: [\"udp:127.0.0.1:14550 read-only\"]; `--forward` replaces them.",
    ),
    setting(
        "connect.require_signing",
        SettingKind::Flag,
        None,
        "Whether frames that are not signed with the key of their vehicle are ignored.",
    ),
    setting(
        "connect.station",
        SettingKind::Whole(1, 255),
        Some("SORTIE_STATION"),
        "MAVLink system id of this console; by default 255, which ArduPilot expects (SYSID_MYGCS). Two consoles need two ids.",
    ),
    setting(
        "parameters.documentation",
        SettingKind::Text,
        Some("SORTIE_PARAMETER_DOCS"),
        "File with the documentation of parameters: apm.pdef.xml or apm.pdef.json of ArduPilot, parameters.json of PX4, also compressed (.xz).",
    ),
    setting(
        "events.documentation",
        SettingKind::Text,
        Some("SORTIE_EVENT_DOCS"),
        "File with the texts of events: all_events.json of PX4, also compressed (.xz).",
    ),
    setting(
        "class.join",
        SettingKind::Text,
        Some("SORTIE_CLASS"),
        "The class that consoles ask to join, by name or path (`sortie class open`), or the file of a join line.",
    ),
    setting(
        "class.instructor",
        SettingKind::Text,
        None,
        "User name of the instructor to whom the desk must belong; by default the owner of the folder of the class.",
    ),
    setting(
        "class.take_over",
        SettingKind::Flag,
        None,
        "Whether the instructor may take over vehicles that this console is connected to: true or false. Simulated vehicles may always be taken over.",
    ),
    setting(
        "macros",
        SettingKind::Lines,
        None,
        "Lines of the command language by name: name = [\"all guided\", \"all arm\"].",
    ),
];

const fn setting(
    name: &'static str,
    kind: SettingKind,
    variable: Option<&'static str>,
    about: &'static str,
) -> Setting {
    Setting {
        name,
        kind,
        variable,
        about,
    }
}

impl Setting {
    /// The minimum number of frames per second.
    pub const FPS_LEAST: i64 = 1;
    /// The maximum number of frames per second.
    pub const FPS_MOST: i64 = 60;

    /// The setting with this name; `None` if there is none.
    pub fn named(name: &str) -> Option<&'static Self> {
        SETTINGS.iter().find(|setting| setting.name == name)
    }

    /// The setting's section; empty for a setting without one.
    pub fn section(&self) -> &'static str {
        match (self.name.split_once('.'), self.kind) {
            (Some((section, _)), _) => section,
            (None, SettingKind::Lines) => self.name,
            (None, _) => "",
        }
    }

    /// The setting's name within its section.
    pub fn key(&self) -> &'static str {
        self.name.rsplit('.').next().unwrap_or(self.name)
    }
}

impl SettingKind {
    /// Checks the type of a value in a file; [`Self::check_word`] checks its words.
    ///
    /// # Errors
    /// The value has the wrong type; the span of the fault is empty.
    pub fn check(self, value: &Value) -> Result<(), Diagnostic> {
        let fits = match (self, value) {
            (Self::OneOf(choices), Value::String(word)) => {
                let known = choices.contains(&word.as_str());
                if !known && let Some(guess) = nearest(word, choices.iter().copied()) {
                    let fault = Diagnostic::new(0..0, self.expected());
                    return Err(fault.with_nearest(word, [guess]));
                }
                known
            }
            (Self::Text | Self::Sort | Self::Vehicles | Self::Lines, Value::String(_))
            | (Self::Flag, Value::Boolean(_)) => true,
            (Self::Whole(least, most), Value::Integer(number)) => (least..=most).contains(number),
            (Self::Words | Self::Columns | Self::AlertKinds, Value::Array(words)) => {
                words.iter().all(Value::is_str)
            }
            (Self::Lines, Value::Array(lines)) => {
                !lines.is_empty() && lines.iter().all(Value::is_str)
            }
            (
                Self::OneOf(_)
                | Self::Text
                | Self::Whole(..)
                | Self::Flag
                | Self::Words
                | Self::Columns
                | Self::Sort
                | Self::AlertKinds
                | Self::Vehicles
                | Self::Lines,
                _,
            ) => false,
        };
        if fits {
            Ok(())
        } else {
            Err(Diagnostic::new(0..0, self.expected()))
        }
    }

    /// Checks a word: the value itself, or an item of its list.
    ///
    /// # Errors
    /// The word is not valid; the span is the whole word.
    pub fn check_word(self, word: &str) -> Result<(), Diagnostic> {
        match self {
            Self::Columns => Column::read(word).map(drop),
            Self::Sort if word.is_empty() => Ok(()),
            Self::Sort => TableSort::read(word).map(drop),
            Self::AlertKinds => AlertKind::read(word).map(drop),
            Self::Vehicles => match word.parse::<VehicleIds>() {
                Ok(_) => Ok(()),
                Err(reason) => Err(Diagnostic::new(0..word.len(), reason)),
            },
            Self::OneOf(_)
            | Self::Text
            | Self::Whole(..)
            | Self::Flag
            | Self::Words
            | Self::Lines => Ok(()),
        }
    }

    /// Parses a word from the environment or the command line; `None` if it has the wrong type.
    pub fn read(self, word: &str) -> Option<Value> {
        let value = match self {
            Self::OneOf(_) | Self::Text => Value::String(word.to_owned()),
            Self::Sort | Self::Vehicles => {
                self.check_word(word).ok()?;
                Value::String(word.to_owned())
            }
            Self::Whole(..) => Value::Integer(word.parse().ok()?),
            Self::Flag => Value::Boolean(match word.to_lowercase().as_str() {
                "true" | "yes" | "on" | "1" => true,
                "false" | "no" | "off" | "0" => false,
                _ => return None,
            }),
            Self::Words | Self::Columns | Self::AlertKinds => {
                let parts = word.split(',').map(str::trim);
                let words: Vec<&str> = parts.filter(|part| !part.is_empty()).collect();
                for word in &words {
                    self.check_word(word).ok()?;
                }
                Value::from(words)
            }
            Self::Lines => return None,
        };
        self.check(&value).ok().map(|()| value)
    }

    /// A description of the valid values.
    pub fn expected(self) -> Text {
        match self {
            Self::OneOf(choices) => text!("config-expected-word", choices = choices.join(", ")),
            Self::Text | Self::Sort | Self::Vehicles => text!("config-expected-text"),
            Self::Whole(least, most) => {
                text!("config-expected-number", least = least, most = most)
            }
            Self::Flag => text!("config-expected-flag"),
            Self::Words | Self::Columns | Self::AlertKinds => text!("config-expected-words"),
            Self::Lines => text!("config-expected-lines"),
        }
    }
}
