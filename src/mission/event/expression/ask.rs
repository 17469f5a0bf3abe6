//! What an expression can ask of a flight.

use std::ops::Range;
use std::time::Duration;

use super::parse::Reader;
use super::token::ExpressionToken;
use super::{Type, Value};
use crate::diagnostic::Diagnostic;
use crate::mission::event::scope::{Scope, Spot};
use crate::mission::sensor::Sensor;
use crate::mission::zone::Zone;
use crate::scoring::AlertLevel;
use crate::vehicle::VehicleClass;

/// The names that an expression may use.
#[derive(Debug, Clone, Copy, Default)]
pub(in crate::mission) struct ExpressionNames<'a> {
    pub zones: &'a [Zone],
    /// Ids of objectives, hazards, events, and of who and what events bring.
    pub objectives: &'a [String],
    pub hazards: &'a [String],
    pub events: &'a [String],
    pub movers: &'a [String],
    pub sensors: &'a [&'static Sensor],
    pub vehicles: usize,
}

/// A function of the language.
pub(in crate::mission) struct Function {
    pub name: &'static str,
    arguments: &'static [Argument],
    is: Type,
    build: fn(&[Given]) -> Option<Question>,
}

/// What a function is given.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Argument {
    Number,
    Zone,
    /// A zone, or somebody who is on the way.
    Place,
    Objective,
    Hazard,
    Sensor,
    Vehicle,
    Modes,
    Level,
    Event,
}

/// The same as it was written.
#[derive(Debug, Clone, PartialEq)]
enum Given {
    Number(f64),
    Index(usize),
    Name(String),
    Modes(Vec<String>),
    Level(AlertLevel),
    Spot(Spot),
}

/// Something that is asked.
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
    AnyMode(Vec<String>),
    AllModes(Vec<String>),
    PausedOrClear(Spot, f64),
    AlertOpen(AlertLevel),
    Fired(usize),
    Wind,
    Chance(f64),
}

/// What can be asked of one vehicle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Field {
    Airborne,
    Armed,
    Lost,
    Heard,
    Mode,
    Battery,
    Link,
    Speed,
    East,
    North,
    Height,
}

/// What can be asked of one vehicle, by name.
#[cfg(test)]
pub(in crate::mission) fn field_names() -> impl Iterator<Item = &'static str> {
    FIELDS.iter().map(|(name, ..)| *name)
}

const FIELDS: [(&str, Field, Type); 11] = [
    ("airborne", Field::Airborne, Type::Bool),
    ("armed", Field::Armed, Type::Bool),
    ("lost", Field::Lost, Type::Bool),
    ("heard", Field::Heard, Type::Bool),
    ("mode", Field::Mode, Type::Text),
    ("battery", Field::Battery, Type::Number),
    ("link", Field::Link, Type::Number),
    ("speed", Field::Speed, Type::Number),
    ("x", Field::East, Type::Number),
    ("y", Field::North, Type::Number),
    ("z", Field::Height, Type::Number),
];

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

/// All functions. Those without arguments need no brackets.
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
        _ => None,
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
    function!("alert_open", [Level], Bool, |g| match g.first()? {
        Given::Level(level) => Some(Question::AlertOpen(*level)),
        _ => None,
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
        _ => None,
    }
}

fn number(given: &[Given]) -> Option<f64> {
    match given.first()? {
        Given::Number(number) => Some(*number),
        _ => None,
    }
}

fn modes(given: &[Given]) -> Option<Vec<String>> {
    match given.first()? {
        Given::Modes(modes) => Some(modes.clone()),
        _ => None,
    }
}

/// Reads what follows a function's name, and says of what type its answer is.
pub(super) fn read(
    reader: &mut Reader<'_>,
    name: &str,
    span: &Range<usize>,
) -> Result<(Question, Type), Diagnostic> {
    let names = || FUNCTIONS.iter().map(|function| function.name);
    let unknown = |what: &str| {
        let fault = Diagnostic::new(span.clone(), format!("unknown {what} `{name}`"));
        fault.with_nearest(name, names())
    };
    let function = FUNCTIONS.iter().find(|function| function.name == name);
    let function = function.ok_or_else(|| unknown("name"))?;
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
    let question = (function.build)(&given).ok_or_else(|| unknown("function"))?;
    let Question::Vehicle(vehicle, _) = question else {
        return Ok((question, function.is));
    };
    reader.sign(".")?;
    let (token, span) = reader.next("what is asked of the vehicle")?;
    let fields = || FIELDS.iter().map(|(name, ..)| *name);
    let ExpressionToken::Name(name) = token else {
        let known = fields().collect::<Vec<_>>().join(", ");
        let message = format!("what is asked of the vehicle is missing: one of {known}");
        return Err(Diagnostic::new(span, message));
    };
    if let Some((_, field, is)) = FIELDS.iter().find(|(field, ..)| *field == name) {
        Ok((Question::Vehicle(vehicle, *field), *is))
    } else {
        let message = format!("a vehicle has no `{name}`");
        Err(Diagnostic::new(span, message).with_nearest(&name, fields()))
    }
}

impl Argument {
    fn read(self, reader: &mut Reader<'_>) -> Result<Given, Diagnostic> {
        if self == Self::Modes {
            return read_modes(reader);
        }
        let wanted = self.wanted();
        let (token, span) = reader.next(wanted)?;
        match (self, token) {
            (Self::Number, ExpressionToken::Number(number)) => Ok(Given::Number(number)),
            (Self::Vehicle, ExpressionToken::Number(number)) => {
                let last = reader.names.vehicles;
                let found = (1..=last).find(|index| (number - *index as f64).abs() < 1e-9);
                found.map(|index| Given::Index(index - 1)).ok_or_else(|| {
                    let message = format!("the mission has the vehicles 1 to {last}");
                    Diagnostic::new(span, message)
                })
            }
            (Self::Number | Self::Vehicle, _)
            | (_, ExpressionToken::Number(_) | ExpressionToken::Sign(_)) => {
                Err(Diagnostic::new(span, format!("{wanted} is needed here")))
            }
            (_, ExpressionToken::Text(name) | ExpressionToken::Name(name)) => {
                self.named(&name, span, reader.names)
            }
        }
    }

    fn wanted(self) -> &'static str {
        match self {
            Self::Number => "a number",
            Self::Zone => "the id of a zone",
            Self::Place => "the id of a zone, or of what an event brings",
            Self::Objective => "the id of an objective",
            Self::Hazard => "the id of a hazard",
            Self::Sensor => "a sensor",
            Self::Vehicle => "the number of a vehicle",
            Self::Modes => "a list of modes such as ['LAND', 'RTL']",
            Self::Level => "a level of alerts",
            Self::Event => "the id of an event",
        }
    }

    fn named(
        self,
        name: &str,
        span: Range<usize>,
        names: &ExpressionNames<'_>,
    ) -> Result<Given, Diagnostic> {
        let levels = ["caution", "warning", "critical"];
        let zones = || names.zones.iter().map(|zone| zone.id.as_str());
        let known: Vec<&str> = match self {
            Self::Zone => zones().collect(),
            Self::Place => zones().chain(ids(names.movers)).collect(),
            Self::Objective => ids(names.objectives).collect(),
            Self::Hazard => ids(names.hazards).collect(),
            Self::Sensor => names.sensors.iter().map(|sensor| sensor.id).collect(),
            Self::Event => ids(names.events).collect(),
            _ => levels.to_vec(),
        };
        let Some(index) = known.iter().position(|known| *known == name) else {
            let message = format!("{} is needed here, not `{name}`", self.wanted());
            return Err(Diagnostic::new(span, message).with_nearest(name, known));
        };
        Ok(match self {
            Self::Sensor => Given::Name(name.to_owned()),
            Self::Level => Given::Level(match index {
                0 => AlertLevel::Caution,
                1 => AlertLevel::Warning,
                _ => AlertLevel::Critical,
            }),
            Self::Place if index >= names.zones.len() => Given::Spot(Spot::Mover(name.to_owned())),
            Self::Place => Given::Spot(Spot::Zone(index)),
            _ => Given::Index(index),
        })
    }
}

fn ids(ids: &[String]) -> impl Iterator<Item = &str> {
    ids.iter().map(String::as_str)
}

/// `['LAND', 'RTL']`.
fn read_modes(reader: &mut Reader<'_>) -> Result<Given, Diagnostic> {
    reader.sign("[")?;
    let known = || {
        let modes = VehicleClass::Copter.modes().iter();
        modes.map(|(_, name)| *name)
    };
    let mut modes = Vec::new();
    loop {
        let (token, span) = reader.next("a mode")?;
        let (ExpressionToken::Text(name) | ExpressionToken::Name(name)) = token else {
            return Err(Diagnostic::new(span, "a mode is needed here"));
        };
        if !known().any(|mode| mode.eq_ignore_ascii_case(&name)) {
            let fault = Diagnostic::new(span, format!("unknown mode `{name}`"));
            return Err(fault.with_nearest(&name, known()));
        }
        modes.push(name);
        if !reader.takes(",") {
            break;
        }
    }
    reader.sign("]")?;
    Ok(Given::Modes(modes))
}

impl Question {
    pub(super) fn answer(&self, scope: &Scope<'_>) -> Value {
        match self {
            Self::Time => Value::Number(scope.sight.now.as_secs_f64()),
            Self::Measure(objective) => {
                Value::Number(scope.standing(*objective).map_or(0.0, |s| s.measure))
            }
            Self::Progress(objective) => {
                Value::Number(scope.standing(*objective).map_or(0.0, |s| s.fraction))
            }
            Self::Met(objective) => Value::Bool(scope.standing(*objective).is_some_and(|s| s.met)),
            Self::Found(hazard) => Value::Number(scope.found(*hazard)),
            Self::Contacts => Value::Number(scope.sight.contacts.len() as f64),
            Self::Marks => Value::Number(scope.sight.marks.len() as f64),
            Self::LowestHeight => Value::Number(scope.lowest_height_m()),
            Self::Speed(sensor) => Value::Number(scope.speed_m_s(sensor)),
            Self::Vehicle(vehicle, field) => field.answer(*vehicle, scope),
            Self::Airborne => Value::Number(scope.flying().count() as f64),
            Self::Lost => {
                let lost = scope.sight.crafts.iter().filter(|craft| craft.lost);
                Value::Number(lost.count() as f64)
            }
            Self::LowestBattery => Value::Number(scope.lowest_battery_percent()),
            Self::Separation => Value::Number(scope.separation_m()),
            Self::Outside(zone) => Value::Bool(scope.inside(*zone) == 0),
            Self::Inside(zone) => Value::Number(scope.inside(*zone) as f64),
            Self::Active(zone) => Value::Bool(scope.is_active(*zone)),
            Self::NoCommand(time) => Value::Bool(scope.since_command() >= *time),
            Self::AnyMode(modes) => Value::Bool(scope.modes().any(|mode| is_among(mode, modes))),
            Self::AllModes(modes) => Value::Bool(scope.modes().all(|mode| is_among(mode, modes))),
            Self::PausedOrClear(spot, metres) => {
                Value::Bool(scope.is_paused_or_clear(spot, *metres))
            }
            Self::AlertOpen(level) => Value::Bool(scope.alerts.contains(level)),
            Self::Fired(event) => Value::Bool(scope.fired.get(*event) == Some(&true)),
            Self::Wind => Value::Number(scope.wind_m_s),
            Self::Chance(share) => Value::Bool(scope.draw() < *share),
        }
    }
}

fn is_among(mode: &str, modes: &[String]) -> bool {
    modes.iter().any(|among| among.eq_ignore_ascii_case(mode))
}

impl Field {
    fn answer(self, vehicle: usize, scope: &Scope<'_>) -> Value {
        let craft = scope.sight.crafts.get(vehicle);
        let is = |of: fn(&crate::mission::craft::Craft) -> bool| Value::Bool(craft.is_some_and(of));
        let number = |value: Option<f64>| Value::Number(value.unwrap_or(f64::NAN));
        match self {
            Self::Airborne => is(|craft| craft.airborne),
            Self::Armed => is(|craft| craft.armed),
            Self::Lost => is(|craft| craft.lost),
            Self::Heard => is(|craft| craft.heard),
            Self::Mode => {
                let mode = craft.and_then(|craft| scope.mode(craft.id));
                Value::Text(mode.unwrap_or_default().to_owned())
            }
            Self::Battery => number(craft.and_then(|craft| craft.battery_percent)),
            Self::Link => number(craft.map(|craft| scope.margin_db(craft.id))),
            Self::Speed => number(craft.map(|craft| craft.speed_m_s)),
            Self::East => number(craft.and_then(|craft| craft.at).map(|at| at[0])),
            Self::North => number(craft.and_then(|craft| craft.at).map(|at| at[1])),
            Self::Height => number(craft.map(|craft| craft.height_m)),
        }
    }
}
