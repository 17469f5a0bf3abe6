//! What flies: the options that `fly`, `run` and others share.

use std::collections::BTreeMap;
use std::env;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use clap::{Args, ValueEnum};

use super::Failure;
use super::settings::Settings;
use crate::hangar::{Backend, Config, Frame, Limits, Restart, Source};
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
    #[arg(long = "hangar", value_name = "URL", num_args = 1.., conflicts_with = "arducopter")]
    hangars: Vec<String>,
    /// The file with the token of the services.
    #[arg(long, value_name = "FILE", requires = "hangars")]
    hangar_token: Option<PathBuf>,
    /// ArduPilot's SITL program; unless it is named, the one of the configuration, of SORTIE_ARDUCOPTER, on the PATH or
    /// in a usual build folder.
    #[arg(long, value_name = "FILE")]
    arducopter: Option<PathBuf>,
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
        let is_named = !self.hangars.is_empty() || self.arducopter.is_some();
        match self.backend {
            Some(simulator) => simulator == Simulator::Ardupilot,
            None => is_named,
        }
    }

    fn source(&self, settings: &Settings) -> Result<Option<Source>, Failure> {
        if !self.is_ardupilot() {
            return Ok(None);
        }
        if self.hangars.is_empty() {
            return own(self.arducopter.as_deref(), settings).map(Some);
        }
        let token = self.hangar_token.as_deref().map(token).transpose()?;
        Ok(Some(Source::Far {
            urls: self.hangars.clone(),
            token,
        }))
    }
}

/// Where ArduPilot's SITL could be started without any option, if it could.
pub(super) fn found(settings: &Settings) -> Option<Source> {
    own(None, settings).ok()
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

fn token(path: &Path) -> Result<String, Failure> {
    let text = std::fs::read_to_string(path).map_err(|error| {
        let path = path.display();
        Failure::Invalid(format!("sortie: cannot read the token {path}: {error}"))
    })?;
    Ok(text.trim().to_owned())
}

/// A hangar within this program.
fn own(arducopter: Option<&Path>, settings: &Settings) -> Result<Source, Failure> {
    let sortie = env::current_exe()?;
    let program = program(arducopter)?;
    let state = settings
        .folders
        .as_ref()
        .map(|folders| folders.state.clone());
    let folder = state.unwrap_or_else(env::temp_dir).join("hangar");
    Ok(Source::Own(Box::new(Config {
        programs: BTreeMap::from([(Kind::Copter, program)]),
        folder: folder.join(std::process::id().to_string()),
        limits: Limits::default(),
        restart: Restart::Never,
        sortie,
    })))
}

fn program(named: Option<&Path>) -> Result<PathBuf, Failure> {
    let named = named
        .map(Path::to_owned)
        .or_else(|| env::var_os("SORTIE_ARDUCOPTER").map(Into::into));
    if let Some(path) = named {
        return match path.canonicalize() {
            Ok(path) if path.is_file() => Ok(path),
            Ok(_) => Err(missing(&format!("{} is no file", path.display()))),
            Err(error) => Err(missing(&format!("{}: {error}", path.display()))),
        };
    }
    let path = env::var_os("PATH").unwrap_or_default();
    let mut files = env::split_paths(&path).map(|folder| folder.join(Kind::Copter.program()));
    files
        .find(|file| file.is_file())
        .ok_or_else(|| missing("no arducopter on the PATH"))
}

fn missing(what: &str) -> Failure {
    Failure::Invalid(format!(
        "sortie: {what}\n  name one with --arducopter FILE or SORTIE_ARDUCOPTER, or build it: in a checkout of ArduPilot\n  \
         ./waf configure --board sitl && ./waf copter   makes build/sitl/bin/arducopter\n  \
         without it, --backend embedded flies the simulator within this program"
    ))
}
