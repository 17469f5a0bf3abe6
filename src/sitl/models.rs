//! SITL's models of vehicles, and the parameters that the autopilot needs to fly each.
//!
//! SITL takes a model by the beginning of its name and asks nothing about the parameters: with the wrong ones a
//! vehicle arms, and turns over. The table has the combinations that were flown or armed on an `ArduPilot` 4.6; the
//! outlines are those of `SIM_Frame.cpp`, the parameters those of `AP_Motors_Class.h`.

use super::{Kind, Unfit};

/// A model of SITL.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Model {
    /// SITL's name.
    pub name: &'static str,
    pub kind: Kind,
    /// How many motors a multirotor has; 0 for other vehicles.
    pub motors: usize,
    /// What the autopilot must be told.
    pub parameters: &'static [(&'static str, f64)],
}

macro_rules! multirotors {
    ($($name:literal: $motors:literal, $class:literal, $shape:literal;)*) => {
        &[$(Model {
            name: $name,
            kind: Kind::Copter,
            motors: $motors,
            parameters: &[("FRAME_CLASS", $class), ("FRAME_TYPE", $shape)],
        }),*]
    };
}

/// Multirotors: motors, `FRAME_CLASS`, `FRAME_TYPE`. The first one of a number of motors is what an airframe with so
/// many gets: the same outline that the embedded simulator gives it. `quad` means plus.
const MULTIROTORS: &[Model] = multirotors! {
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

/// The others; the first one of a kind is its default.
const OTHERS: &[Model] = &[
    other(Kind::Plane, "plane", &[]),
    other(Kind::Rover, "rover", &[]),
    // Left and right throttle instead of steering.
    other(
        Kind::Rover,
        "rover-skid",
        &[("SERVO1_FUNCTION", 73.0), ("SERVO3_FUNCTION", 74.0)],
    ),
    other(Kind::Rover, "motorboat", &[("FRAME_CLASS", 2.0)]),
    other(Kind::Sub, "vectored", &[("FRAME_CONFIG", 1.0)]),
    other(Kind::Sub, "vectored_6dof", &[("FRAME_CONFIG", 2.0)]),
];

const fn other(
    kind: Kind,
    name: &'static str,
    parameters: &'static [(&'static str, f64)],
) -> Model {
    Model {
        name,
        kind,
        motors: 0,
        parameters,
    }
}

/// The models of a kind.
fn of(kind: Kind) -> impl Iterator<Item = &'static Model> {
    let all = MULTIROTORS.iter().chain(OTHERS);
    all.filter(move |model| model.kind == kind)
}

/// The model of a name, else the first one that has so many motors and agrees with the parameters that are asked for.
///
/// # Errors
/// None fits, or the one that is named does not: with what would.
pub(super) fn choose(
    kind: Kind,
    name: Option<&str>,
    motors: Option<usize>,
    asked: impl Fn(&str) -> Option<f64>,
) -> Result<&'static Model, Unfit> {
    let fits = |model: &Model| {
        let has_motors = motors.is_none_or(|motors| motors == model.motors);
        has_motors && disagreement(model, &asked).is_none()
    };
    let fitting = || -> Vec<&str> { of(kind).filter(|it| fits(it)).map(|it| it.name).collect() };
    let Some(name) = name else {
        // Without a frame file it is the default that SITL has: four motors.
        let usual = of(kind).next().map_or(0, |model| model.motors);
        let likely =
            of(kind).find(|model| fits(model) && (motors.is_some() || model.motors == usual));
        return likely
            .or_else(|| of(kind).find(|model| fits(model)))
            .ok_or(Unfit::NoModel { kind, motors });
    };
    let named = of(kind).find(|model| model.name.eq_ignore_ascii_case(name));
    let Some(model) = named else {
        return Err(Unfit::UnknownModel {
            name: name.to_owned(),
            kind,
            known: of(kind).map(|model| model.name).collect(),
        });
    };
    if let Some(motors) = motors.filter(|motors| *motors != model.motors) {
        return Err(Unfit::Motors {
            model: model.name,
            has: model.motors,
            motors,
            fitting: fitting(),
        });
    }
    match disagreement(model, &asked) {
        None => Ok(model),
        Some((parameter, needed, asked)) => Err(Unfit::Frame {
            model: model.name,
            parameter,
            needed,
            asked,
            fitting: fitting(),
        }),
    }
}

/// The parameter of a model for which another value is asked: what the model needs, and what is asked.
fn disagreement(
    model: &Model,
    asked: &impl Fn(&str) -> Option<f64>,
) -> Option<(&'static str, f64, f64)> {
    model.parameters.iter().find_map(|&(name, needed)| {
        let asked = asked(name)?;
        ((asked - needed).abs() > 1e-6).then_some((name, needed, asked))
    })
}
