//! The arguments of an expression's functions: how each kind is parsed.

use std::ops::Range;

use super::reader::{ExpressionNames, Reader, needed_not, quoted};
use super::token::ExpressionToken;
use crate::diagnostic::Diagnostic;
use crate::mission::event::scope::Spot;
use crate::scoring::AlertLevel;
use crate::text;
use crate::text::Text;
use crate::vehicle::VehicleClass;

const LEVELS: [(&str, AlertLevel); 3] = [
    ("caution", AlertLevel::Caution),
    ("warning", AlertLevel::Warning),
    ("critical", AlertLevel::Critical),
];

/// A kind of argument.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Argument {
    Number,
    Zone,
    /// A zone, or a moving person or aircraft.
    Place,
    Objective,
    Hazard,
    Sensor,
    Vehicle,
    Modes,
    Level,
    Event,
}

/// The argument as given in the file.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Given {
    Number(f64),
    Index(usize),
    Name(String),
    Modes(Vec<String>),
    Level(AlertLevel),
    Spot(Spot),
}

impl Argument {
    /// Reads one argument of this kind.
    pub fn read(self, reader: &mut Reader<'_>) -> Result<Given, Diagnostic> {
        if self == Self::Modes {
            return read_modes(reader);
        }
        let (token, span) = reader.next(|| self.wanted())?;
        match (self, token) {
            (Self::Number, ExpressionToken::Number(number)) => Ok(Given::Number(number)),
            (Self::Vehicle, ExpressionToken::Number(number)) => {
                let last = reader.names.vehicles;
                // A fleet with faults has no vehicles yet; that fault is enough.
                let most = if last == 0 {
                    usize::from(u8::MAX)
                } else {
                    last
                };
                let found = (1..=most).find(|index| (number - *index as f64).abs() < 1e-9);
                found.map(|index| Given::Index(index - 1)).ok_or_else(|| {
                    Diagnostic::new(span, text!("expression-no-vehicle", last = last))
                })
            }
            (_, ExpressionToken::Number(_) | ExpressionToken::Sign(_)) => Err(self.needed(span)),
            (_, ExpressionToken::Text(name) | ExpressionToken::Name(name)) => {
                self.named(&name, span, reader.names)
            }
        }
    }

    fn needed(self, span: Range<usize>) -> Diagnostic {
        Diagnostic::new(span, text!("expression-needed", wanted = self.wanted()))
    }

    fn wanted(self) -> Text {
        match self {
            Self::Number => text!("expression-number"),
            Self::Zone => text!("expression-zone"),
            Self::Place => text!("expression-place"),
            Self::Objective => text!("expression-objective"),
            Self::Hazard => text!("expression-hazard"),
            Self::Sensor => text!("expression-sensor"),
            Self::Vehicle => text!("expression-vehicle"),
            Self::Modes => text!("expression-modes"),
            Self::Level => text!("expression-level"),
            Self::Event => text!("expression-event"),
        }
    }

    /// The value of a name as this argument.
    fn named(
        self,
        name: &str,
        span: Range<usize>,
        names: &ExpressionNames<'_>,
    ) -> Result<Given, Diagnostic> {
        let zones = || names.zones.iter().map(|zone| zone.id.as_str());
        let place_among = |known: Vec<&str>| {
            let found = known.iter().position(|known| *known == name);
            let found = found.or(names.are_open.then_some(known.len()));
            found.ok_or_else(|| {
                needed_not(self.wanted(), quoted(name), span.clone()).with_nearest(name, known)
            })
        };
        match self {
            Self::Zone => place_among(zones().collect()).map(Given::Index),
            Self::Place => {
                let place = place_among(zones().chain(ids(names.movers)).collect())?;
                Ok(Given::Spot(if place < names.zones.len() {
                    Spot::Zone(place)
                } else {
                    Spot::Mover(name.to_owned())
                }))
            }
            Self::Objective => place_among(ids(names.objectives).collect()).map(Given::Index),
            Self::Hazard => place_among(ids(names.hazards).collect()).map(Given::Index),
            Self::Event => place_among(ids(names.events).collect()).map(Given::Index),
            Self::Sensor => {
                let known = names.sensors.iter().map(|sensor| sensor.id);
                place_among(known.collect()).map(|_| Given::Name(name.to_owned()))
            }
            Self::Level => {
                let found = LEVELS.iter().find(|(known, _)| *known == name);
                let known = || LEVELS.iter().map(|(name, _)| *name);
                let unknown = || {
                    needed_not(self.wanted(), quoted(name), span.clone())
                        .with_nearest(name, known())
                };
                found
                    .map(|(_, level)| Given::Level(*level))
                    .ok_or_else(unknown)
            }
            Self::Number | Self::Vehicle | Self::Modes => Err(self.needed(span)),
        }
    }
}

fn ids(ids: &[String]) -> impl Iterator<Item = &str> {
    ids.iter().map(String::as_str)
}

fn a_mode() -> Text {
    text!("expression-mode")
}

/// Flight modes in a list, such as `['LAND', 'RTL']`.
fn read_modes(reader: &mut Reader<'_>) -> Result<Given, Diagnostic> {
    reader.sign("[")?;
    let known = || {
        let modes = VehicleClass::Copter.modes().iter();
        modes.map(|(_, name)| *name)
    };
    let mut modes = Vec::new();
    loop {
        let (token, span) = reader.next(a_mode)?;
        let (ExpressionToken::Text(name) | ExpressionToken::Name(name)) = token else {
            let message = text!("expression-needed", wanted = a_mode());
            return Err(Diagnostic::new(span, message));
        };
        if !known().any(|mode| mode.eq_ignore_ascii_case(&name)) {
            let fault = Diagnostic::new(span, text!("expression-no-mode", name = &name));
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
