//! The fields of one vehicle in expressions.

use super::{PartValue, Type};
use crate::mission::craft::Craft;
use crate::mission::event::scope::Scope;

/// A field of one vehicle.
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

#[cfg(test)]
pub(in crate::mission) fn field_names() -> impl Iterator<Item = &'static str> {
    FIELDS.iter().map(|(name, ..)| *name)
}

pub(super) const FIELDS: [(&str, Field, Type); 11] = [
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

impl Field {
    pub fn answer(self, vehicle: usize, scope: &Scope<'_>) -> PartValue {
        let craft = scope.sight.crafts.get(vehicle);
        let is = |of: fn(&Craft) -> bool| PartValue::Bool(craft.is_some_and(of));
        let number = |value: Option<f64>| PartValue::Number(value.unwrap_or(f64::NAN));
        match self {
            Self::Airborne => is(|craft| craft.under_way),
            Self::Armed => is(|craft| craft.armed),
            Self::Lost => is(|craft| craft.lost),
            Self::Heard => is(|craft| craft.heard),
            Self::Mode => {
                let mode = craft.and_then(|craft| scope.mode(craft.id));
                PartValue::Text(mode.unwrap_or_default().to_owned())
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
