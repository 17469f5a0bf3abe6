//! The parameters of the simulated vehicle, in the order in which it lists them.
//!
//! Names, types and values are those of an `ArduCopter` 4.6 SITL with its default parameters for
//! copters, read from it over `MAVLink`. Those that `tuning` and its parts read affect the
//! vehicle's behaviour; the others are only stored and listed, because ground stations look for
//! them.

use std::collections::HashMap;
use std::sync::LazyLock;

use super::Kind;

/// Comments, and one line per parameter: name, type, value at the first boot, and the default if it differs. An
/// indented line belongs to the switch above it.
const LINES: &str = include_str!("arducopter.txt");

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
pub(super) struct ParameterTable {
    pub(super) rows: Vec<ParameterRow>,
    /// The sub-trees, in ascending order.
    pub(super) sub_trees: Vec<SubTree>,
    /// Places in `rows` by name.
    by_name: HashMap<&'static str, u16>,
}

/// The table is the same for every vehicle; it is read once.
pub(super) static TABLE: LazyLock<ParameterTable> = LazyLock::new(ParameterTable::read);

impl ParameterTable {
    fn read() -> Self {
        let rows: Vec<ParameterRow> = lines().filter_map(row).collect();
        let sub_trees = sub_trees();
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

fn lines() -> impl Iterator<Item = &'static str> {
    LINES.lines().filter(|line| !line.starts_with('#'))
}

fn sub_trees() -> Vec<SubTree> {
    let mut all: Vec<SubTree> = Vec::new();
    for (place, line) in lines().enumerate() {
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

    #[test]
    fn every_line_is_a_parameter_whose_name_fits_its_field_and_occurs_once() {
        assert_eq!(TABLE.rows.len(), lines().count());
        assert!(TABLE.rows.iter().all(|row| row.name.len() <= 16));
        let mut names: Vec<_> = TABLE.rows.iter().map(|row| row.name).collect();
        names.sort_unstable();
        names.dedup();
        assert_eq!(names.len(), TABLE.rows.len());
        for (place, row) in TABLE.rows.iter().enumerate() {
            assert_eq!(TABLE.place(row.name), Some(place));
            for value in [row.first, row.default] {
                assert!((row.kind.stored(value) - value).abs() < f32::EPSILON);
            }
        }
    }
}
