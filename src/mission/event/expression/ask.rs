//! The functions of expressions: queries of a flight's state.

use std::ops::Range;
use std::time::Duration;

use super::argument::{Argument, Given};
use super::field::{FIELDS, Field};
use super::reader::Reader;
use super::token::ExpressionToken;
use super::{PartValue, Type};
use crate::diagnostic::Diagnostic;
use crate::mission::event::scope::{Scope, Spot};
use crate::scoring::AlertLevel;
use crate::text;

/// A function of the language.
pub(in crate::mission) struct Function {
    pub name: &'static str,
    arguments: &'static [Argument],
    is: Type,
    build: fn(&[Given]) -> Option<Question>,
}

/// The query that a function makes.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Question {
    Time,
    Measure(usize),
    Progress(usize),
    Met(usize),
    Found(usize),
    Contacts,
    Marks,
    LowestHeight,
    Speed(String),
    Vehicle(usize, Field),
    Airborne,
    Lost,
    LowestBattery,
    Separation,
    Outside(usize),
    Inside(usize),
    Active(usize),
    NoCommand(Duration),
    Refused,
    AnyMode(Vec<String>),
    AllModes(Vec<String>),
    PausedOrClear(Spot, f64),
    Clearance(Spot),
    AlertOpen(AlertLevel),
    Fired(usize),
    Wind,
    Chance(f64),
}

macro_rules! function {
    ($name:literal, [$($argument:ident),*], $is:ident, $build:expr) => {
        Function {
            name: $name,
            arguments: &[$(Argument::$argument),*],
            is: Type::$is,
            build: $build,
        }
    };
}

/// All functions. Functions without arguments are written without parentheses.
pub(in crate::mission) const FUNCTIONS: &[Function] = &[
    function!("t", [], Number, |_| Some(Question::Time)),
    function!("coverage", [Objective], Number, |g| Some(
        Question::Measure(index(g)?)
    )),
    function!("progress", [Objective], Number, |g| Some(
        Question::Progress(index(g)?)
    )),
    function!("met", [Objective], Bool, |g| Some(Question::Met(index(g)?))),
    function!("found", [Hazard], Number, |g| Some(Question::Found(index(
        g
    )?))),
    function!("contacts", [], Number, |_| Some(Question::Contacts)),
    function!("marks", [], Number, |_| Some(Question::Marks)),
    function!("agl_min", [], Number, |_| Some(Question::LowestHeight)),
    function!("speed", [Sensor], Number, |g| match g.first()? {
        Given::Name(name) => Some(Question::Speed(name.clone())),
        Given::Number(_) | Given::Index(_) | Given::Modes(_) | Given::Level(_) | Given::Spot(_) =>
            None,
    }),
    function!("vehicle", [Vehicle], Number, |g| Some(Question::Vehicle(
        index(g)?,
        Field::Height
    ))),
    function!("airborne", [], Number, |_| Some(Question::Airborne)),
    function!("lost", [], Number, |_| Some(Question::Lost)),
    function!("battery_min", [], Number, |_| Some(Question::LowestBattery)),
    function!("separation", [], Number, |_| Some(Question::Separation)),
    function!("outside", [Zone], Bool, |g| Some(Question::Outside(index(
        g
    )?))),
    function!("inside", [Zone], Number, |g| Some(Question::Inside(index(
        g
    )?))),
    function!("active", [Zone], Bool, |g| Some(Question::Active(index(
        g
    )?))),
    function!("no_command", [Number], Bool, |g| {
        let seconds = number(g)?.clamp(0.0, 86_400.0);
        Some(Question::NoCommand(Duration::from_secs_f64(seconds)))
    }),
    function!("refused", [], Number, |_| Some(Question::Refused)),
    function!("mode_any", [Modes], Bool, |g| Some(Question::AnyMode(
        modes(g)?
    ))),
    function!("mode_all", [Modes], Bool, |g| Some(Question::AllModes(
        modes(g)?
    ))),
    function!("paused_or_clear", [Place, Number], Bool, |g| match g {
        [Given::Spot(spot), Given::Number(metres)] => {
            Some(Question::PausedOrClear(spot.clone(), *metres))
        }
        _ => None,
    }),
    function!("clearance", [Place], Number, |g| match g.first()? {
        Given::Spot(spot) => Some(Question::Clearance(spot.clone())),
        Given::Number(_) | Given::Index(_) | Given::Name(_) | Given::Modes(_) | Given::Level(_) =>
            None,
    }),
    function!("alert_open", [Level], Bool, |g| match g.first()? {
        Given::Level(level) => Some(Question::AlertOpen(*level)),
        Given::Number(_) | Given::Index(_) | Given::Name(_) | Given::Modes(_) | Given::Spot(_) =>
            None,
    }),
    function!("fired", [Event], Bool, |g| Some(Question::Fired(index(g)?))),
    function!("wind", [], Number, |_| Some(Question::Wind)),
    function!("rand", [Number], Bool, |g| Some(Question::Chance(number(
        g
    )?))),
];

fn index(given: &[Given]) -> Option<usize> {
    match given.first()? {
        Given::Index(index) => Some(*index),
        Given::Number(_) | Given::Name(_) | Given::Modes(_) | Given::Level(_) | Given::Spot(_) => {
            None
        }
    }
}

fn number(given: &[Given]) -> Option<f64> {
    match given.first()? {
        Given::Number(number) => Some(*number),
        Given::Index(_) | Given::Name(_) | Given::Modes(_) | Given::Level(_) | Given::Spot(_) => {
            None
        }
    }
}

fn modes(given: &[Given]) -> Option<Vec<String>> {
    match given.first()? {
        Given::Modes(modes) => Some(modes.clone()),
        Given::Number(_) | Given::Index(_) | Given::Name(_) | Given::Level(_) | Given::Spot(_) => {
            None
        }
    }
}

/// Reads the arguments after a function's name; returns the query with the type of its result.
pub(super) fn read(
    reader: &mut Reader<'_>,
    name: &str,
    span: &Range<usize>,
) -> Result<(Question, Type), Diagnostic> {
    let names = || FUNCTIONS.iter().map(|function| function.name);
    let unknown = || {
        let fault = Diagnostic::new(span.clone(), text!("expression-no-name", name = name));
        fault.with_nearest(name, names())
    };
    let function = FUNCTIONS
        .iter()
        .find(|function| function.name == name)
        .ok_or_else(unknown)?;
    let mut given = Vec::new();
    if !function.arguments.is_empty() || reader.takes("(") {
        if !function.arguments.is_empty() {
            reader.sign("(")?;
        }
        for (place, argument) in function.arguments.iter().enumerate() {
            if place > 0 {
                reader.sign(",")?;
            }
            given.push(argument.read(reader)?);
        }
        reader.sign(")")?;
    }
    let question = (function.build)(&given).ok_or_else(unknown)?;
    let Question::Vehicle(vehicle, _) = question else {
        return Ok((question, function.is));
    };
    reader.sign(".")?;
    let (token, span) = reader.next(|| text!("expression-property"))?;
    let fields = || FIELDS.iter().map(|(name, ..)| *name);
    let ExpressionToken::Name(name) = token else {
        let known = fields().collect::<Vec<_>>().join(", ");
        let message = text!("expression-property-missing", known = known);
        return Err(Diagnostic::new(span, message));
    };
    if let Some((_, field, is)) = FIELDS.iter().find(|(field, ..)| *field == name) {
        Ok((Question::Vehicle(vehicle, *field), *is))
    } else {
        let message = text!("expression-no-property", name = &name);
        Err(Diagnostic::new(span, message).with_nearest(&name, fields()))
    }
}

impl Question {
    pub(super) fn answer(&self, scope: &Scope<'_>) -> PartValue {
        match self {
            Self::Time => PartValue::Number(scope.sight.now.as_secs_f64()),
            Self::Measure(objective) => {
                PartValue::Number(scope.standing(*objective).map_or(0.0, |s| s.measure))
            }
            Self::Progress(objective) => {
                PartValue::Number(scope.standing(*objective).map_or(0.0, |s| s.fraction))
            }
            Self::Met(objective) => {
                PartValue::Bool(scope.standing(*objective).is_some_and(|s| s.met))
            }
            Self::Found(hazard) => PartValue::Number(scope.found(*hazard)),
            Self::Contacts => PartValue::Number(scope.sight.contacts.len() as f64),
            Self::Marks => PartValue::Number(scope.sight.marks.len() as f64),
            Self::LowestHeight => PartValue::Number(scope.lowest_height_m()),
            Self::Speed(sensor) => PartValue::Number(scope.speed_m_s(sensor)),
            Self::Vehicle(vehicle, field) => field.answer(*vehicle, scope),
            Self::Airborne => PartValue::Number(scope.flying().count() as f64),
            Self::Lost => {
                let lost = scope.sight.crafts.iter().filter(|craft| craft.lost);
                PartValue::Number(lost.count() as f64)
            }
            Self::LowestBattery => PartValue::Number(scope.lowest_battery_percent()),
            Self::Separation => PartValue::Number(scope.separation_m()),
            Self::Outside(zone) => PartValue::Bool(scope.inside(*zone) == 0),
            Self::Inside(zone) => PartValue::Number(scope.inside(*zone) as f64),
            Self::Active(zone) => PartValue::Bool(scope.is_active(*zone)),
            Self::NoCommand(time) => PartValue::Bool(scope.since_command() >= *time),
            Self::Refused => PartValue::Number(f64::from(scope.sight.refused)),
            Self::AnyMode(modes) => {
                PartValue::Bool(scope.modes().any(|mode| is_among(mode, modes)))
            }
            Self::AllModes(modes) => {
                PartValue::Bool(scope.modes().all(|mode| is_among(mode, modes)))
            }
            Self::PausedOrClear(spot, metres) => {
                PartValue::Bool(scope.is_paused_or_clear(spot, *metres))
            }
            Self::Clearance(spot) => PartValue::Number(scope.clearance_m(spot)),
            Self::AlertOpen(level) => PartValue::Bool(scope.alerts.contains(level)),
            Self::Fired(event) => PartValue::Bool(scope.fired.get(*event) == Some(&true)),
            Self::Wind => PartValue::Number(scope.wind_m_s),
            Self::Chance(share) => PartValue::Bool(scope.draw() < *share),
        }
    }
}

fn is_among(mode: &str, modes: &[String]) -> bool {
    modes.iter().any(|among| among.eq_ignore_ascii_case(mode))
}
