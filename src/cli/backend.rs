//! What flies: the options that `fly`, `run` and others share.

use std::env;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use clap::{Args, ValueEnum};

use super::Failure;
use super::programs::ProgramOptions;
use super::settings::Settings;
use crate::hangar::client::{AddressError, Remote};
use crate::hangar::programs::Missing;
use crate::hangar::{Backend, Config, Frame, Limits, Source, Token};
use crate::sim::Airframe;
use crate::sitl::Kind;
use crate::store;

/// What simulates the vehicles.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum Simulator {
    /// The simulator within this program.
    Embedded,
    /// ArduPilot's SITL: a process for every vehicle.
    Ardupilot,
}

/// Options of commands that fly simulated vehicles.
#[derive(Debug, Clone, Default, Args)]
#[command(next_help_heading = "What flies")]
pub(super) struct BackendArguments {
    /// What simulates the vehicles; embedded unless a hangar or a program is named.
    #[arg(long, value_enum)]
    backend: Option<Simulator>,
    /// A service (`sortie hangar`) that starts ArduPilot's SITL, such as http://127.0.0.1:5700; several share the
    /// vehicles. Without one this program starts them itself.
    #[arg(long = "hangar", value_name = "URL", num_args = 1.., conflicts_with_all = ["arducopter", "arduplane", "ardurover", "ardusub"])]
    hangars: Vec<String>,
    /// The file with the token of the services.
    #[arg(long, value_name = "FILE")]
    hangar_token: Option<PathBuf>,
    #[command(flatten)]
    programs: ProgramOptions,
    /// The airframe of the vehicles: a frame file of ArduPilot's SITL, in JSON. Give the option once for all
    /// vehicles, or several times: one file per vehicle, the last one for all that follow.
    #[arg(long = "frame", value_name = "FILE")]
    frames: Vec<PathBuf>,
}

impl BackendArguments {
    /// What was chosen, with its files read and its program found.
    ///
    /// # Errors
    /// A frame file is faulty, or there is no such program.
    pub fn choose(&self, settings: &Settings) -> Result<Backend, Failure> {
        let frames: Result<_, Failure> = self.frames.iter().map(|path| frame(path)).collect();
        Ok(Backend {
            ardupilot: self.source(settings)?,
            frames: frames?,
        })
    }

    fn is_ardupilot(&self) -> bool {
        let is_named = !self.hangars.is_empty() || self.programs.is_given();
        match self.backend {
            Some(simulator) => simulator == Simulator::Ardupilot,
            None => is_named,
        }
    }

    fn source(&self, settings: &Settings) -> Result<Option<Source>, Failure> {
        if !self.is_ardupilot() {
            return Ok(None);
        }
        let set = &settings.config.hangar.urls;
        let urls = match self.hangars.as_slice() {
            [] if self.programs.is_given() => &[],
            [] => set.as_slice(),
            named => named,
        };
        if urls.is_empty() {
            return own(&self.programs, settings).map(Some);
        }
        far(urls, self.hangar_token.as_deref(), settings).map(Some)
    }
}

/// Where ArduPilot's SITL could be started without any option, if it could.
pub(super) fn found(settings: &Settings) -> Option<Source> {
    own(&ProgramOptions::default(), settings).ok()
}

/// Reads a frame file; its warnings go to standard error.
pub(super) fn frame(path: &Path) -> Result<Frame, Failure> {
    let source = store::read(path, "file-frame")
        .map_err(|error| Failure::Invalid(format!("sortie: {error}")))?;
    let name = &source.name;
    let faulty = |error: crate::sim::AirframeError| {
        let (line, column, what) = (error.line, error.column, error.what);
        format!("sortie: {name}:{line}:{column}: {what}")
    };
    let (airframe, warnings) =
        Airframe::from_json(&source.text).map_err(|error| Failure::Invalid(faulty(error)))?;
    for warning in warnings {
        eprintln!("{}", faulty(warning));
    }
    let json = Airframe::json(&source.text).map_err(|error| Failure::Invalid(faulty(error)))?;
    Ok(Frame {
        airframe: Arc::new(airframe),
        json,
    })
}

/// Services with the token that was named, or the one that is kept for them.
fn far(urls: &[String], token: Option<&Path>, settings: &Settings) -> Result<Source, Failure> {
    let invalid = |error: &dyn std::fmt::Display| Failure::Invalid(format!("sortie: {error}"));
    let set = settings.config.hangar.token_file.as_deref().map(Path::new);
    let state = settings.folders.as_ref();
    let usual = state.map(|folders| folders.state.join("hangar.token"));
    let usual = usual.filter(|path| path.exists());
    let token = token.or(set).or(usual.as_deref());
    let token = token.map(Token::load).transpose();
    let token = token.map_err(|error| invalid(&error))?;
    let service = |url: &String| {
        let address = url.parse().map_err(|error: AddressError| invalid(&error))?;
        Ok(Remote::new(address, token.clone()))
    };
    let services: Result<_, Failure> = urls.iter().map(service).collect();
    Ok(Source::Far(services?))
}

/// A hangar within this program, with the programs that are found.
fn own(programs: &ProgramOptions, settings: &Settings) -> Result<Source, Failure> {
    let found = programs.find(settings);
    found
        .of(Kind::Copter)
        .map_err(|missing| missing_program(&missing))?;
    let set = &settings.config.hangar;
    let state = settings
        .folders
        .as_ref()
        .map(|folders| folders.state.clone());
    let folder = set.folder.clone().map(PathBuf::from);
    let folder = folder.unwrap_or_else(|| state.unwrap_or_else(env::temp_dir).join("hangar"));
    Ok(Source::Own(Box::new(Config {
        programs: found.paths(),
        // Two consoles of one user must not run in the same folder.
        folder: folder.join(std::process::id().to_string()),
        limits: Limits {
            instances: set.instances,
            memory_mib: set.memory,
            ..Limits::default()
        },
        restart: set.restart,
        sortie: env::current_exe()?,
    })))
}

pub(super) fn missing_program(missing: &Missing) -> Failure {
    Failure::Invalid(format!(
        "sortie: {missing}\n  name it with --arducopter FILE or SORTIE_ARDUCOPTER, or build it, in a checkout of ArduPilot:\n    \
         ./waf configure --board sitl && ./waf copter   makes build/sitl/bin/arducopter\n  \
         without it, --backend embedded flies the simulator within this program"
    ))
}
