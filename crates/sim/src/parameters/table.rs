//! The parameters of the simulated vehicle, in the order in which it lists them.
//!
//! Names, types and values are those of an `ArduCopter` 4.6 SITL with its default parameters for
//! copters, read from it over `MAVLink`. Those that `tuning` and its parts read affect the
//! vehicle's behaviour; the others are only stored and listed, because ground stations look for
//! them.

use std::collections::HashMap;
use std::sync::LazyLock;

use super::Kind;
use crate::kind::VehicleKind;

/// Comments, and one line per parameter: name, type, value at the first boot, and the default if it differs. An
/// indented line belongs to the switch above it.
const COPTER: &str = include_str!("arducopter.txt");
/// The same for rovers.
const ROVER: &str = include_str!("ardurover.txt");

/// The fixed properties of a parameter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ParameterRow {
    pub(super) name: &'static str,
    pub(super) kind: Kind,
    /// The value at the first boot.
    pub(super) first: f32,
    /// The default of the firmware.
    pub(super) default: f32,
}

/// Parameters that are listed only while their switch (an `ENABLE` or a `TYPE`) is not zero. They can be read and set
/// by name at any time.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct SubTree {
    /// The place of the switch; the parameters follow it.
    pub(super) switch: u16,
    pub(super) count: u16,
}

/// Every parameter, in the order of the list and by name.
#[derive(Debug)]
pub(super) struct ParameterTable {
    pub(super) rows: Vec<ParameterRow>,
    /// The sub-trees, in ascending order.
    pub(super) sub_trees: Vec<SubTree>,
    /// Places in `rows` by name.
    by_name: HashMap<&'static str, u16>,
}

/// The tables are the same for every vehicle of a kind; they are read once.
static COPTERS: LazyLock<ParameterTable> = LazyLock::new(|| ParameterTable::read(COPTER));
static ROVERS: LazyLock<ParameterTable> = LazyLock::new(|| ParameterTable::read(ROVER));

impl ParameterTable {
    /// The parameters of a kind of vehicle.
    pub(super) fn of(kind: VehicleKind) -> &'static Self {
        match kind {
            VehicleKind::Copter => &COPTERS,
            VehicleKind::Rover(_) => &ROVERS,
        }
    }

    /// Whether any kind of vehicle has a parameter.
    pub(super) fn is_known(name: &str) -> bool {
        [&COPTERS, &ROVERS]
            .iter()
            .any(|table| table.place(name).is_some())
    }

    fn read(text: &'static str) -> Self {
        let rows: Vec<ParameterRow> = lines(text).filter_map(row).collect();
        let sub_trees = sub_trees(text);
        let by_name = rows.iter().map(|row| row.name).zip(0..).collect();
        Self {
            rows,
            sub_trees,
            by_name,
        }
    }

    /// The index of a parameter; `None` for an unknown name. Case does not matter.
    pub(super) fn place(&self, name: &str) -> Option<usize> {
        let place = self.by_name.get(name).copied().or_else(|| {
            let is_upper = !name.bytes().any(|byte| byte.is_ascii_lowercase());
            (!is_upper).then(|| {
                self.by_name
                    .get(name.to_ascii_uppercase().as_str())
                    .copied()
            })?
        })?;
        Some(usize::from(place))
    }
}

fn lines(text: &'static str) -> impl Iterator<Item = &'static str> {
    text.lines().filter(|line| !line.starts_with('#'))
}

fn sub_trees(text: &'static str) -> Vec<SubTree> {
    let mut all: Vec<SubTree> = Vec::new();
    for (place, line) in lines(text).enumerate() {
        if !line.starts_with(' ') {
            continue;
        }
        match all.last_mut() {
            Some(tree) if usize::from(tree.switch + tree.count) + 1 == place => tree.count += 1,
            _ => all.push(SubTree {
                switch: place.saturating_sub(1) as u16,
                count: 1,
            }),
        }
    }
    all
}

fn row(line: &'static str) -> Option<ParameterRow> {
    let mut words = line.trim_start().split(' ');
    let name = words.next()?;
    let kind = match words.next()? {
        "i8" => Kind::Int8,
        "i16" => Kind::Int16,
        "i32" => Kind::Int32,
        _ => Kind::Real32,
    };
    let first = words.next()?.parse().ok()?;
    let default = match words.next() {
        Some(word) => word.parse().ok()?,
        None => first,
    };
    Some(ParameterRow {
        name,
        kind,
        first,
        default,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kind::Chassis;

    #[test]
    fn every_line_is_a_parameter_whose_name_fits_its_field_and_occurs_once() {
        let rover = VehicleKind::Rover(Chassis::Ackermann);
        for (kind, text) in [(VehicleKind::Copter, COPTER), (rover, ROVER)] {
            let table = ParameterTable::of(kind);
            assert_eq!(table.rows.len(), lines(text).count());
            assert!(table.rows.iter().all(|row| row.name.len() <= 16));
            for (place, row) in table.rows.iter().enumerate() {
                assert_eq!(table.place(row.name), Some(place), "once");
                for value in [row.first, row.default] {
                    assert!((row.kind.stored(value) - value).abs() < f32::EPSILON);
                }
            }
        }
    }
}
