//! The options about vehicles that `fly`, `run` and others share.

use std::env;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use clap::{Args, ValueEnum};

use super::Failure;
use super::hangar::services::ServiceOptions;
use super::programs::ProgramOptions;
use super::settings::CliSettings;
use crate::hangar::programs::Missing;
use crate::hangar::{FreeFlight, HangarLimits, HangarSetup, SitlSource, VehicleBackend};
use crate::sim::Airframe;
use crate::sitl::{SitlKind, SitlUnfit};
use crate::store;

/// The program that simulates the vehicles.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum SimulatorChoice {
    /// The simulator inside this program.
    Embedded,
    /// ArduPilot's SITL: one process for each vehicle.
    Ardupilot,
}

/// Options of commands that fly simulated vehicles.
#[derive(Debug, Clone, Default, Args)]
#[command(next_help_heading = "What flies")]
pub(super) struct BackendArguments {
    /// Use this simulator; by default the embedded one, unless a hangar, a program or a vehicle that it lacks is named.
    #[arg(long, value_enum)]
    backend: Option<SimulatorChoice>,
    #[command(flatten)]
    services: ServiceOptions,
    #[command(flatten)]
    programs: ProgramOptions,
    /// Use this airframe: a JSON frame file of ArduPilot's SITL. Repeat the option for several vehicles: one file for
    /// each; the last one applies to all further vehicles.
    #[arg(long = "frame", value_name = "FILE")]
    frames: Vec<PathBuf>,
}

impl BackendArguments {
    /// The chosen simulator for a flight, with its files read and its program found.
    ///
    /// # Errors
    /// A frame file is faulty or not for this kind, or the program does not exist.
    pub fn choose(
        &self,
        flight: &FreeFlight,
        settings: &CliSettings,
    ) -> Result<VehicleBackend, Failure> {
        let kind = flight.kind;
        if kind != SitlKind::Copter && !self.frames.is_empty() {
            let unfit = SitlUnfit::AirframeOf(kind);
            return Err(Failure::Invalid(format!("sortie: {unfit}")));
        }
        let frames: Result<_, Failure> = self.frames.iter().map(|path| frame(path)).collect();
        Ok(VehicleBackend {
            ardupilot: self.source(flight, settings)?,
            airframes: frames?,
            free: FreeFlight::default(),
        })
    }

    fn is_ardupilot(&self, flight: &FreeFlight) -> bool {
        if let Some(simulator) = self.backend {
            return simulator == SimulatorChoice::Ardupilot;
        }
        let is_named = self.services.is_given() || self.programs.is_given();
        let is_embedded = flight.kind == SitlKind::Copter || flight.embedded().is_some();
        is_named || !is_embedded
    }

    fn source(
        &self,
        flight: &FreeFlight,
        settings: &CliSettings,
    ) -> Result<Option<SitlSource>, Failure> {
        if !self.is_ardupilot(flight) {
            return Ok(None);
        }
        if self.services.is_given() && self.programs.is_given() {
            let text = "sortie: a hangar starts a program of its own host: leave out --hangar or the program";
            return Err(Failure::Invalid(text.to_owned()));
        }
        let services = if self.programs.is_given() {
            Vec::new()
        } else {
            self.services.remotes(settings)?
        };
        if services.is_empty() {
            let own = own(flight.kind, &self.programs, settings)?;
            return Ok(Some(SitlSource::Own(Box::new(own))));
        }
        Ok(Some(SitlSource::Far(services)))
    }
}

/// The SITL source used without any option; `None` if no program is found.
pub(super) fn found(settings: &CliSettings) -> Option<SitlSource> {
    let own = own(SitlKind::Copter, &ProgramOptions::default(), settings).ok()?;
    Some(SitlSource::Own(Box::new(own)))
}

/// Reads a frame file; its warnings go to standard error.
pub(super) fn frame(path: &Path) -> Result<Arc<Airframe>, Failure> {
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
        tell!("{}", faulty(warning));
    }
    Ok(Arc::new(airframe))
}

/// A hangar within this program, with the SITL programs that are found.
///
/// # Errors
///
/// The program for this kind of vehicle was not found.
pub(super) fn own(
    kind: SitlKind,
    programs: &ProgramOptions,
    settings: &CliSettings,
) -> Result<HangarSetup, Failure> {
    let found = programs.find(settings);
    found
        .of(kind)
        .map_err(|missing| missing_program(kind, &missing))?;
    let set = &settings.config.hangar;
    let state = settings
        .folders
        .as_ref()
        .map(|folders| folders.state.clone());
    let folder = set.folder.clone().map_or_else(
        || state.unwrap_or_else(env::temp_dir).join("hangar"),
        PathBuf::from,
    );
    Ok(HangarSetup {
        programs: found.paths(),
        folder,
        limits: HangarLimits {
            instances: set.instances,
            memory_mib: set.memory,
            ..HangarLimits::default()
        },
        restart: set.restart,
        sortie: env::current_exe()?,
    })
}

fn missing_program(kind: SitlKind, missing: &Missing) -> Failure {
    let (name, program) = (kind.name(), kind.program());
    let variable = program.to_uppercase();
    let embedded = if kind == SitlKind::Copter {
        "\n  without it, use --backend embedded: the simulator within this program"
    } else {
        ""
    };
    Failure::Invalid(format!(
        "sortie: {missing}\n  name it with --{program} FILE or SORTIE_{variable}, or build it, in a checkout of ArduPilot:\n    \
         ./waf configure --board sitl && ./waf {name}   makes build/sitl/bin/{program}{embedded}"
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_embedded_simulator_flies_what_it_has_unless_another_is_named() {
        let flight = |kind, model: Option<&str>| FreeFlight {
            kind,
            model: model.map(str::to_owned),
            ..FreeFlight::default()
        };
        let usual = BackendArguments::default();
        for (kind, model, is_ardupilot) in [
            (SitlKind::Copter, None, false),
            (SitlKind::Rover, None, false),
            (SitlKind::Rover, Some("rover-skid"), false),
            (SitlKind::Rover, Some("motorboat"), false),
            (SitlKind::Rover, Some("sailboat"), true),
            (SitlKind::Plane, None, true),
            (SitlKind::Sub, None, true),
        ] {
            let flight = flight(kind, model);
            assert_eq!(usual.is_ardupilot(&flight), is_ardupilot, "{flight:?}");
        }
        let named = BackendArguments {
            backend: Some(SimulatorChoice::Ardupilot),
            ..usual
        };
        assert!(named.is_ardupilot(&flight(SitlKind::Rover, None)));
    }
}
