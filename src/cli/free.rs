//! The options of `sortie fly` about the vehicles of free flight.

use clap::Args;

use super::Failure;
use super::home::StartPlace;
use super::kind::{KindWord, parse_parameter};
use crate::hangar::{FreeFlight, LaunchHome};
use crate::sitl::{Recipe, SerialEndpoint, SitlKind};

/// Options of free flight.
#[derive(Debug, Clone, Args)]
#[command(next_help_heading = "Free flight")]
pub(super) struct FreeOptions {
    /// Start this kind of vehicle; planes and submarines need ArduPilot's SITL.
    #[arg(long, value_enum, default_value = "copter", conflicts_with_all = ["mission", "connect"])]
    kind: KindWord,
    /// Use this model of SITL: motorboat, rover-skid, hexa, ..; by default the one that suits the kind.
    #[arg(long, value_name = "NAME", conflicts_with_all = ["mission", "connect"])]
    model: Option<String>,
    /// Start SITL with this parameter; repeat the option for each one.
    #[arg(
        long = "param",
        value_name = "NAME=VALUE",
        value_parser = parse_parameter,
        conflicts_with_all = ["mission", "connect"]
    )]
    parameters: Vec<(String, f64)>,
    /// Place the first vehicle here: latitude, longitude, height above sea level in metres, heading in degrees.
    #[arg(
        long,
        value_name = "LAT,LON,ALT,HDG",
        allow_hyphen_values = true,
        conflicts_with_all = ["mission", "connect"]
    )]
    home: Option<StartPlace>,
}

impl FreeOptions {
    /// What was asked for, not checked.
    pub fn asked(&self) -> FreeFlight {
        let usual = self.kind.model().map(str::to_owned);
        FreeFlight {
            kind: self.kind.into(),
            model: self.model.clone().or(usual),
            parameters: self.parameters.iter().cloned().collect(),
            start: self.home.map(|home| home.0),
        }
    }

    /// What flies, checked as far as possible before any process starts.
    ///
    /// # Errors
    /// An option needs ArduPilot's SITL, or SITL cannot start such a vehicle.
    pub fn flight(&self, is_ardupilot: bool) -> Result<FreeFlight, Failure> {
        let flight = self.asked();
        if is_ardupilot {
            check(&flight)?;
        } else {
            self.check_embedded(&flight)?;
        }
        Ok(flight)
    }

    /// Refuses the options that the embedded simulator does not have.
    fn check_embedded(&self, flight: &FreeFlight) -> Result<(), Failure> {
        let fault = if flight.kind == SitlKind::Copter && flight.model.is_some() {
            "--model is for ArduPilot's SITL: use --backend ardupilot".to_owned()
        } else if flight.embedded().is_none() {
            let name = flight.model.as_deref().unwrap_or(flight.kind.name());
            format!(
                "the embedded simulator has copters, rovers (rover, rover-skid) and boats (motorboat): \
                 for {name}, use --backend ardupilot"
            )
        } else if !self.parameters.is_empty() {
            "--param is for ArduPilot's SITL: use --backend ardupilot, or `param set` in the console".to_owned()
        } else {
            return Ok(());
        };
        Err(Failure::Invalid(format!("sortie: {fault}")))
    }
}

/// Checks that SITL can start such a vehicle.
fn check(flight: &FreeFlight) -> Result<(), Failure> {
    let start = flight.start.unwrap_or_else(|| LaunchHome::default().into());
    let recipe = Recipe {
        kind: flight.kind,
        model: flight.model.clone(),
        airframe: None,
        start,
        system: 1,
        speedup: 1.0,
        parameters: flight.parameters.clone(),
    };
    let checked = recipe.command_line(SerialEndpoint::Listening(0));
    checked
        .map(drop)
        .map_err(|unfit| Failure::Invalid(format!("sortie: {unfit}")))
}
