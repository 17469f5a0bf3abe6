//! SITL's models of vehicles, and the parameters that the autopilot needs for each.
//!
//! SITL finds a model by the beginning of its name and does not check the parameters: with wrong
//! parameters, a vehicle arms and then turns over. The table has the combinations that were flown
//! or armed with `ArduPilot` 4.6; the outlines are those of `SIM_Frame.cpp`, the parameters those
//! of `AP_Motors_Class.h`.

use super::{SitlKind, SitlUnfit};

/// A vehicle model of SITL (`--model`), with the parameters that it needs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct SitlModel {
    pub name: &'static str,
    pub kind: SitlKind,
    /// The number of motors of a multirotor; 0 for other vehicles.
    pub motors: usize,
    /// Required parameters of the autopilot.
    pub parameters: &'static [(&'static str, f64)],
}

macro_rules! multirotors {
    ($($name:literal: $motors:literal, $class:literal, $shape:literal;)*) => {
        &[$(SitlModel {
            name: $name,
            kind: SitlKind::Copter,
            motors: $motors,
            parameters: &[("FRAME_CLASS", $class), ("FRAME_TYPE", $shape)],
        }),*]
    };
}

/// Multirotors: motors, `FRAME_CLASS`, `FRAME_TYPE`. An airframe uses the first model with its
/// number of motors, which has the outline of the embedded simulator. `quad` means a plus frame.
const MULTIROTORS: &[SitlModel] = multirotors! {
    "quad": 4, 1.0, 0.0;
    "+": 4, 1.0, 0.0;
    "copter": 4, 1.0, 0.0;
    "x": 4, 1.0, 1.0;
    "bfx": 4, 1.0, 12.0;
    "djix": 4, 1.0, 13.0;
    "cwx": 4, 1.0, 14.0;
    "bfxrev": 4, 1.0, 18.0;
    "hexa": 6, 2.0, 0.0;
    "hexax": 6, 2.0, 1.0;
    "hexa-dji": 6, 2.0, 13.0;
    "hexa-cwx": 6, 2.0, 14.0;
    "y6": 6, 5.0, 0.0;
    "octa": 8, 3.0, 0.0;
    "octa-dji": 8, 3.0, 13.0;
    "octa-cwx": 8, 3.0, 14.0;
    "octa-quad": 8, 4.0, 0.0;
    "octa-quad-cwx": 8, 4.0, 14.0;
    "deca": 10, 14.0, 0.0;
    "deca-cwx": 10, 14.0, 14.0;
    "dodeca-hexa": 12, 12.0, 0.0;
    "tri": 3, 7.0, 0.0;
};

/// Models of other vehicles; the first model of a kind is its default.
const OTHERS: &[SitlModel] = &[
    other(SitlKind::Plane, "plane", &[]),
    other(SitlKind::Rover, "rover", &[]),
    // Left and right throttle, instead of steering and throttle.
    other(
        SitlKind::Rover,
        "rover-skid",
        &[("SERVO1_FUNCTION", 73.0), ("SERVO3_FUNCTION", 74.0)],
    ),
    other(SitlKind::Rover, "motorboat", &[("FRAME_CLASS", 2.0)]),
    // A main sail on output 4, and the simulated wind as the wind vane; without wind it does not move.
    other(
        SitlKind::Rover,
        "sailboat",
        &[
            ("FRAME_CLASS", 2.0),
            ("SAIL_ENABLE", 1.0),
            ("SERVO4_FUNCTION", 89.0),
            ("WNDVN_TYPE", 10.0),
            ("WNDVN_SPEED_TYPE", 10.0),
        ],
    ),
    other(SitlKind::Sub, "vectored", &[("FRAME_CONFIG", 1.0)]),
    other(SitlKind::Sub, "vectored_6dof", &[("FRAME_CONFIG", 2.0)]),
];

const fn other(
    kind: SitlKind,
    name: &'static str,
    parameters: &'static [(&'static str, f64)],
) -> SitlModel {
    SitlModel {
        name,
        kind,
        motors: 0,
        parameters,
    }
}

fn of(kind: SitlKind) -> impl Iterator<Item = &'static SitlModel> {
    let all = MULTIROTORS.iter().chain(OTHERS);
    all.filter(move |model| model.kind == kind)
}

/// The model with a name, otherwise the first one that matches the number of motors and the
/// requested parameters.
///
/// # Errors
/// No model fits; or the named model is unknown or does not fit, and the error lists the
/// alternatives.
pub(super) fn choose(
    kind: SitlKind,
    name: Option<&str>,
    motors: Option<usize>,
    asked: impl Fn(&str) -> Option<f64>,
) -> Result<&'static SitlModel, SitlUnfit> {
    let fits = |model: &SitlModel| {
        let has_motors = motors.is_none_or(|motors| motors == model.motors);
        has_motors && disagreement(model, &asked).is_none()
    };
    let Some(name) = name else {
        return likely(kind, motors, fits).ok_or(SitlUnfit::NoModel { kind, motors });
    };
    let named = of(kind).find(|model| model.name.eq_ignore_ascii_case(name));
    let Some(model) = named else {
        return Err(SitlUnfit::UnknownModel {
            name: name.to_owned(),
            kind,
            known: of(kind).map(|model| model.name).collect(),
        });
    };
    let fitting = |motors: usize| -> Vec<&str> {
        let alike = of(kind).filter(|it| it.motors == motors && fits(it));
        alike.map(|it| it.name).collect()
    };
    if let Some(motors) = motors.filter(|motors| *motors != model.motors) {
        return Err(SitlUnfit::Motors {
            model: model.name,
            has: model.motors,
            motors,
            fitting: fitting(motors),
        });
    }
    match disagreement(model, &asked) {
        None => Ok(model),
        Some((parameter, needed, asked)) => Err(SitlUnfit::Frame {
            model: model.name,
            parameter,
            needed,
            asked,
            fitting: fitting(model.motors),
        }),
    }
}

/// The first model that fits, preferably with this number of motors; without a number, preferably
/// with as many motors as the default model.
fn likely(
    kind: SitlKind,
    motors: Option<usize>,
    fits: impl Fn(&SitlModel) -> bool,
) -> Option<&'static SitlModel> {
    let usual = motors.or_else(|| of(kind).next().map(|model| model.motors));
    let is_usual = |model: &&SitlModel| fits(model) && Some(model.motors) == usual;
    of(kind)
        .find(is_usual)
        .or_else(|| of(kind).find(|model| fits(model)))
}

/// The parameter of a model for which another value is requested: its name, the required value, and the requested one.
fn disagreement(
    model: &SitlModel,
    asked: &impl Fn(&str) -> Option<f64>,
) -> Option<(&'static str, f64, f64)> {
    model.parameters.iter().find_map(|&(name, needed)| {
        let asked = asked(name)?;
        ((asked - needed).abs() > 1e-6).then_some((name, needed, asked))
    })
}
