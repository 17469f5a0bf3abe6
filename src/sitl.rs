//! One instance of ArduPilot's SITL: its command line and its files.
//!
//! The facts about its options and pitfalls apply to `ArduPilot` 4.6 (`SITL_cmdline.cpp`,
//! `UARTDriver.cpp`), and were tested with a running instance.

use core::net::SocketAddr;
use std::collections::BTreeMap;
use std::ops::RangeInclusive;

use serde::{Deserialize, Serialize};
use strum::{IntoStaticStr, VariantArray, VariantNames};

use crate::sim::{Airframe, Start, VehicleKind};
use models::SitlModel;

mod defaults;
mod formation;
mod gear;
mod models;
mod shell;
mod stage;
mod unfit;

#[cfg(test)]
mod tests;

pub use formation::{FormationShape, Offset, StartFormation};
pub use gear::gear_parameters;
pub use shell::{line, quoted};
pub use stage::SitlStage;
pub use unfit::SitlUnfit;

/// The instance's file of start parameters, in its folder.
const PARAMETER_FILE: &str = "vehicle.parm";
/// The airframe file in the instance's folder: SITL accepts only a path relative to its working folder.
const AIRFRAME_FILE: &str = "frame.json";

/// A kind of vehicle that `ArduPilot` is built for.
#[derive(
    Debug,
    Clone,
    Copy,
    Default,
    PartialEq,
    Eq,
    PartialOrd,
    Ord,
    Serialize,
    Deserialize,
    IntoStaticStr,
    VariantArray,
    VariantNames,
)]
#[serde(rename_all = "lowercase")]
#[strum(serialize_all = "lowercase")]
pub enum SitlKind {
    #[default]
    Copter,
    Plane,
    Rover,
    Sub,
}

impl From<VehicleKind> for SitlKind {
    fn from(kind: VehicleKind) -> Self {
        match kind {
            VehicleKind::Copter => Self::Copter,
            VehicleKind::Rover(_) => Self::Rover,
        }
    }
}

impl SitlKind {
    pub const ALL: &[Self] = <Self as VariantArray>::VARIANTS;

    /// The kind's name in JSON.
    pub fn name(self) -> &'static str {
        self.into()
    }

    /// The usual name of the kind's SITL program.
    pub fn program(self) -> &'static str {
        match self {
            Self::Copter => "arducopter",
            Self::Plane => "arduplane",
            Self::Rover => "ardurover",
            Self::Sub => "ardusub",
        }
    }
}

/// The description of an instance.
#[derive(Debug, Clone, PartialEq)]
pub struct Recipe {
    pub kind: SitlKind,
    /// SITL's name for a model (`quad` is a plus frame; `x`; `hexa`); by default the one that suits
    /// the kind, the airframe and the parameters.
    pub model: Option<String>,
    /// A frame file in the JSON of `SIM_Frame`, for multicopters only; by default [`Airframe::standard`].
    pub airframe: Option<String>,
    pub start: Start,
    /// The vehicle's system id, 1 to 254.
    pub system: u8,
    /// Simulated seconds per second of real time.
    pub speedup: f64,
    /// Parameters that extend or override the defaults of every new vehicle.
    pub parameters: BTreeMap<String, f64>,
}

/// The connection of the instance's serial 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SerialEndpoint {
    /// Serial 0 connects to this address and accepts no connection; all other serial ports are
    /// closed.
    Outwards(SocketAddr),
    /// SITL listens as usual: on port 5760 + 10 * this number, and on the ports 2 and 3 above it.
    /// It boots once a client has connected.
    Listening(u16),
}

/// A command line, and the files that its working folder needs.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CommandLine {
    /// The arguments, without the program.
    pub arguments: Vec<String>,
    /// Names and contents of the files.
    pub files: Vec<(&'static str, String)>,
}

/// The system ids that a vehicle may have: 255 is the ground station's.
const SYSTEMS: RangeInclusive<u8> = 1..=254;
const SPEEDUPS: RangeInclusive<f64> = 0.01..=1000.0;
/// The valid altitudes, in metres above mean sea level.
const ALTITUDES_M: RangeInclusive<f64> = -1000.0..=20_000.0;
/// SITL treats a home closer than this to latitude 0, longitude 0 as no home, and starts near Canberra.
const NOWHERE_DEG: f64 = 1e-7;
const LONGEST_NAME: usize = 16;
/// The number of serial ports: serial 0 listens on the first port, serial 1 and 2 on the ports 2
/// and 3 above it.
const SERIALS: u16 = 3;
const FIRST_PORT: u16 = 5760;
const PORTS_PER_INSTANCE: u16 = 10;
/// SITL stores its instance number in eight bits (`SITL_State.h`): instance 256 would use the ports
/// of instance 0.
const LAST_INSTANCE: u16 = 255;

impl Recipe {
    /// The command line of this instance.
    ///
    /// # Errors
    /// A value that SITL would misunderstand, crash on or hang on, with advice.
    pub fn command_line(&self, endpoint: SerialEndpoint) -> Result<CommandLine, SitlUnfit> {
        self.check()?;
        let named = self.airframe()?;
        let motors = named.as_ref().map(Airframe::motors);
        let asked = |name: &str| self.parameters.get(name).copied();
        let model = models::choose(self.kind, self.model.as_deref(), motors, asked)?;
        let standard = || (self.kind == SitlKind::Copter).then(|| Airframe::standard(model.motors));
        let airframe = named.or_else(standard);
        let word = match &airframe {
            Some(_) => format!("{}:{AIRFRAME_FILE}", model.name),
            None => model.name.to_owned(),
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
        let mut arguments = words([
            ("--model", word),
            ("--speedup", self.speedup.to_string()),
            ("--slave", "0".to_owned()),
            ("--defaults", PARAMETER_FILE.to_owned()),
            ("--home", home),
            ("--sysid", self.system.to_string()),
        ]);
        arguments.extend(endpoint.arguments()?);
        let mut files = vec![(
            PARAMETER_FILE,
            self.parameter_file(model, airframe.as_ref()),
        )];
        let own = || airframe.as_ref()?.file().map(ToString::to_string);
        let frame = self.airframe.clone().or_else(own);
        files.extend(frame.map(|json| (AIRFRAME_FILE, json)));
        Ok(CommandLine { arguments, files })
    }

    fn check(&self) -> Result<(), SitlUnfit> {
        let Start {
            at,
            altitude_amsl_m,
            heading_deg,
        } = self.start;
        if !SYSTEMS.contains(&self.system) {
            return Err(SitlUnfit::System(self.system));
        }
        if !SPEEDUPS.contains(&self.speedup) {
            return Err(SitlUnfit::Speedup(self.speedup));
        }
        let is_somewhere = at.lat_deg.abs() >= NOWHERE_DEG || at.lon_deg.abs() >= NOWHERE_DEG;
        let is_home = at.is_valid() && is_somewhere && heading_deg.is_finite();
        if !is_home || !ALTITUDES_M.contains(&altitude_amsl_m) {
            return Err(SitlUnfit::Home);
        }
        let is_name = |name: &str| {
            let good =
                |byte: u8| byte.is_ascii_uppercase() || byte.is_ascii_digit() || byte == b'_';
            (1..=LONGEST_NAME).contains(&name.len()) && name.bytes().all(good)
        };
        for (name, value) in &self.parameters {
            if !is_name(name) {
                return Err(SitlUnfit::ParameterName(name.clone()));
            }
            if !(*value as f32).is_finite() {
                return Err(SitlUnfit::ParameterValue(name.clone(), *value));
            }
        }
        Ok(())
    }

    fn airframe(&self) -> Result<Option<Airframe>, SitlUnfit> {
        match &self.airframe {
            Some(_) if self.kind != SitlKind::Copter => Err(SitlUnfit::AirframeOf(self.kind)),
            Some(json) => Ok(Some(Airframe::from_json(json)?.0)),
            None => Ok(None),
        }
    }

    fn parameter_file(&self, model: &SitlModel, airframe: Option<&Airframe>) -> String {
        let mut parameters: BTreeMap<String, f64> = defaults::of(self.kind).into_iter().collect();
        parameters.extend(defaults::of_model(self.kind, model.name));
        if let Some(airframe) = airframe {
            parameters.extend(defaults::of_airframe(airframe));
            let set = airframe.parameters().iter();
            parameters.extend(set.map(|&(name, value)| (name.to_owned(), value)));
        }
        let model = model.parameters.iter();
        parameters.extend(model.map(|&(name, value)| (name.to_owned(), value)));
        parameters.extend(self.parameters.clone());
        let line = |(name, value): (&String, &f64)| format!("{name} {value}\n");
        parameters.iter().map(line).collect()
    }
}

impl SerialEndpoint {
    /// The ports of serial 0, 1 and 2 for an instance that listens; empty for one that connects
    /// outwards.
    ///
    /// # Errors
    /// SITL has no instance with this number.
    pub fn ports(self) -> Result<Vec<u16>, SitlUnfit> {
        let Self::Listening(instance) = self else {
            return Ok(Vec::new());
        };
        if instance > LAST_INSTANCE {
            return Err(SitlUnfit::Instance(instance));
        }
        let first = FIRST_PORT + PORTS_PER_INSTANCE * instance;
        let last = first + SERIALS;
        Ok(vec![first, last - 1, last])
    }

    fn arguments(self) -> Result<Vec<String>, SitlUnfit> {
        self.ports()?;
        Ok(match self {
            // With port 0 the system chooses: this socket is the only one that SITL cannot be prevented from opening.
            Self::Outwards(address) => words([
                (
                    "--serial0",
                    format!("tcpclient:{}:{}", address.ip(), address.port()),
                ),
                ("--serial1", "none:".to_owned()),
                ("--serial2", "none:".to_owned()),
                ("--rc-in-port", "0".to_owned()),
            ]),
            Self::Listening(instance) => words([("-I", instance.to_string())]),
        })
    }
}

fn words<const N: usize>(options: [(&str, String); N]) -> Vec<String> {
    let options = options.into_iter();
    options
        .flat_map(|(option, value)| [option.to_owned(), value])
        .collect()
}
