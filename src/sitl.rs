//! One instance of ArduPilot's SITL: what it is told on its command line and in the files beside it.
//!
//! Facts of its options and traps are those of `ArduPilot` 4.6 (`SITL_cmdline.cpp`, `UARTDriver.cpp`), tried on a
//! running one.

use core::net::SocketAddr;
use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use crate::sim::Start;

mod defaults;

/// The file of parameters that an instance is started with, in its folder.
const PARAMETER_FILE: &str = "vehicle.parm";
/// The airframe, in its folder: SITL takes it only by a path that is relative to where it runs.
const AIRFRAME_FILE: &str = "frame.json";

/// A vehicle that `ArduPilot` is built for.
#[derive(
    Debug, Clone, Copy, Default, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, ToSchema,
)]
#[serde(rename_all = "lowercase")]
pub enum Kind {
    /// `ArduCopter`.
    #[default]
    Copter,
    /// `ArduPlane`.
    Plane,
    /// Rover.
    Rover,
    /// `ArduSub`.
    Sub,
}

impl Kind {
    /// Every kind.
    pub const ALL: [Self; 4] = [Self::Copter, Self::Plane, Self::Rover, Self::Sub];

    /// What its program is usually called.
    pub fn program(self) -> &'static str {
        match self {
            Self::Copter => "arducopter",
            Self::Plane => "arduplane",
            Self::Rover => "ardurover",
            Self::Sub => "ardusub",
        }
    }

    /// SITL's simplest model of it; `quad` means plus.
    fn model(self) -> &'static str {
        match self {
            Self::Copter => "quad",
            Self::Plane => "plane",
            Self::Rover => "rover",
            Self::Sub => "vectored",
        }
    }
}

/// What an instance is to be.
#[derive(Debug, Clone, PartialEq)]
pub struct Recipe {
    /// The vehicle.
    pub kind: Kind,
    /// SITL's name of a model (`quad`, `x`, `hexa`); by default what suits the kind and the airframe.
    pub model: Option<String>,
    /// A frame file in the JSON of `SIM_Frame`; multicopters only.
    pub airframe: Option<String>,
    /// Where it stands.
    pub start: Start,
    /// Its system id, 1 to 254.
    pub system: u8,
    /// Simulated seconds per second.
    pub speedup: f64,
    /// Parameters beside those that every new vehicle needs, or instead of them.
    pub parameters: BTreeMap<String, f64>,
}

/// How the instance's serial 0 is reached.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Door {
    /// It connects to this address, and nobody can connect to it: all its other serial ports are closed.
    Outwards(SocketAddr),
    /// It listens as SITL usually does, on port 5760 + 10 * this number and 2 and 3 above, and boots once somebody
    /// has connected.
    Listening(u16),
}

/// A command line, and the files that must lie where it is run.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CommandLine {
    /// The arguments, without the program.
    pub arguments: Vec<String>,
    /// Names and contents of the files.
    pub files: Vec<(&'static str, String)>,
}

impl Recipe {
    /// The command line of this instance.
    pub fn command_line(&self, door: Door) -> CommandLine {
        let model = self.model.as_deref().unwrap_or(self.kind.model());
        let model = match &self.airframe {
            Some(_) => format!("{model}:{AIRFRAME_FILE}"),
            None => model.to_owned(),
        };
        let Start {
            at,
            altitude_amsl_m,
            heading_deg,
        } = self.start;
        let home = format!(
            "{:.7},{:.7},{altitude_amsl_m},{heading_deg}",
            at.lat_deg, at.lon_deg
        );
        let mut arguments: Vec<String> = [
            ("--model", model),
            ("--speedup", self.speedup.to_string()),
            ("--slave", "0".to_owned()),
            ("--defaults", PARAMETER_FILE.to_owned()),
            ("--home", home),
            ("--sysid", self.system.to_string()),
        ]
        .into_iter()
        .flat_map(|(option, value)| [option.to_owned(), value])
        .collect();
        arguments.extend(door.arguments());
        let mut files = vec![(PARAMETER_FILE, self.parameter_file())];
        files.extend(self.airframe.clone().map(|json| (AIRFRAME_FILE, json)));
        CommandLine { arguments, files }
    }

    fn parameter_file(&self) -> String {
        let mut parameters = defaults::of(self.kind);
        parameters.extend(self.parameters.clone());
        let line = |(name, value): (&String, &f64)| format!("{name} {value}\n");
        parameters.iter().map(line).collect()
    }
}

impl Door {
    fn arguments(self) -> Vec<String> {
        match self {
            // A port of 0 lets the system choose: the only socket that SITL cannot be kept from opening.
            Self::Outwards(address) => [
                (
                    "--serial0",
                    format!("tcpclient:{}:{}", address.ip(), address.port()),
                ),
                ("--serial1", "none:".to_owned()),
                ("--serial2", "none:".to_owned()),
                ("--rc-in-port", "0".to_owned()),
            ]
            .into_iter()
            .flat_map(|(option, value)| [option.to_owned(), value])
            .collect(),
            Self::Listening(instance) => vec!["-I".to_owned(), instance.to_string()],
        }
    }
}
