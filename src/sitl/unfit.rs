//! Why an instance cannot be started as requested.

use super::SitlKind;
use crate::sim::AirframeError;

/// A fault of a recipe, with advice.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SitlUnfit {
    #[error("system id {0} cannot be a vehicle's: use 1 to 254")]
    System(u8),
    #[error("SITL cannot run {0} times as fast as real time: use 0.01 to 1000")]
    Speedup(f64),
    #[error(
        "a home is a latitude and longitude on earth, -1000 to 20000 m above sea level, and a heading; SITL treats latitude 0, longitude 0 as no home"
    )]
    Home,
    #[error("SITL has no instance {0}: use 0 to 255")]
    Instance(u16),
    /// The name of a parameter is not valid.
    #[error(
        "`{0}` is not the name of a parameter: at most 16 capital letters, digits and underscores"
    )]
    ParameterName(String),
    /// The value of a parameter is not a finite number; SITL would hang.
    #[error("{0} cannot be {1}: a value is a finite number that fits a float")]
    ParameterValue(String, f64),
    /// A frame file is given for a vehicle that is not a multirotor.
    #[error("only multirotors use a frame file, but this is a {}: leave it out", .0.name())]
    AirframeOf(SitlKind),
    #[error("the frame file, {0}")]
    Airframe(#[from] AirframeError),
    /// The model is not known.
    #[error("a {} has no model `{name}`: use {}", .kind.name(), .known.join(", "))]
    UnknownModel {
        name: String,
        kind: SitlKind,
        /// The models of this kind.
        known: Vec<&'static str>,
    },
    /// No model agrees with the airframe and the parameters.
    #[error(
        "no model of a {}{} has the frame that the parameters require: leave FRAME_CLASS and FRAME_TYPE to the model",
        .kind.name(), .motors.map_or_else(String::new, |motors| format!(" with {motors} motors"))
    )]
    NoModel {
        kind: SitlKind,
        motors: Option<usize>,
    },
    /// The model and the airframe have different numbers of motors.
    #[error(
        "the model {model} has {has} motors and the frame file {motors}: {}", advice(.fitting)
    )]
    Motors {
        model: &'static str,
        has: usize,
        motors: usize,
        /// The models that fit.
        fitting: Vec<&'static str>,
    },
    /// The model requires a value of a parameter other than the requested one.
    #[error(
        "the model {model} needs {parameter} {needed} and would flip over with {asked}: leave {parameter} out, or {}",
        advice(.fitting)
    )]
    Frame {
        model: &'static str,
        parameter: &'static str,
        needed: f64,
        asked: f64,
        /// The models that fit.
        fitting: Vec<&'static str>,
    },
}

fn advice(fitting: &[&str]) -> String {
    match fitting {
        [] => "no model fits".to_owned(),
        models => format!("use the model {}", models.join(" or ")),
    }
}
