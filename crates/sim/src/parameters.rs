//! The vehicle's parameters: their table, names and values.

mod aliases;
mod table;

use mavlink::dialects::ardupilotmega::{MavMessage, MavParamType, PARAM_VALUE_DATA};
use mavlink::types::CharArray;

use self::table::TABLE;
pub use aliases::{AliasSense, other_name};

/// The index in the answer to a parameter that was requested or set by name.
pub(super) const BY_NAME: u16 = u16::MAX;

/// The stored type of a parameter; all are sent as floats.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    Int8,
    Int16,
    Int32,
    Real32,
}

impl Kind {
    /// The corresponding `MAVLink` type.
    pub(super) fn on_the_wire(self) -> MavParamType {
        match self {
            Self::Int8 => MavParamType::MAV_PARAM_TYPE_INT8,
            Self::Int16 => MavParamType::MAV_PARAM_TYPE_INT16,
            Self::Int32 => MavParamType::MAV_PARAM_TYPE_INT32,
            Self::Real32 => MavParamType::MAV_PARAM_TYPE_REAL32,
        }
    }

    /// The value as it is stored: integers are truncated and saturate.
    fn stored(self, value: f32) -> f32 {
        // The vehicle adds a hundredth away from zero before it truncates the fraction.
        let whole = value + 0.01f32.copysign(value);
        match self {
            Self::Int8 => f32::from(whole as i8),
            Self::Int16 => f32::from(whole as i16),
            Self::Int32 => whole as i32 as f32,
            Self::Real32 => value,
        }
    }
}

/// A parameter with its current value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Parameter {
    pub(super) name: &'static str,
    pub(super) kind: Kind,
    pub(super) value: f32,
    pub(super) index: u16,
}

/// The parameter values of a vehicle, which survive a reboot. Thousands of vehicles share the defaults: each stores
/// only the values that differ.
#[derive(Debug, Clone)]
pub(super) struct Parameters {
    /// Places in the table with values other than the default, in ascending order.
    changed: Vec<(u16, f32)>,
}

impl Parameters {
    /// Everything at its default, with the vehicle's own system id.
    pub(super) fn new(system: u8) -> Self {
        let mut all = Self {
            changed: Vec::new(),
        };
        all.set("SYSID_THISMAV", f32::from(system));
        all
    }

    /// The number of parameters.
    #[expect(
        clippy::unused_self,
        reason = "that all vehicles have the same ones is known here only"
    )]
    pub(super) fn count(&self) -> u16 {
        TABLE.rows.len() as u16
    }

    /// The parameter at a place in the list.
    pub(super) fn at(&self, index: u16) -> Option<Parameter> {
        let row = TABLE.rows.get(usize::from(index))?;
        let place = self.changed_place(index).ok();
        let changed = place.and_then(|place| self.changed.get(place));
        Some(Parameter {
            name: row.name,
            kind: row.kind,
            value: changed.map_or(row.default, |(_, value)| *value),
            index,
        })
    }

    /// The default value of the parameter at an index.
    pub(super) fn default_at(index: u16) -> f32 {
        TABLE
            .rows
            .get(usize::from(index))
            .map_or(0.0, |row| row.default)
    }

    /// The parameter with a name of either firmware; case does not matter.
    pub(super) fn named(&self, name: &str) -> Option<Parameter> {
        if let Some(index) = TABLE.place(name) {
            return self.at(index as u16);
        }
        let (alias, own, sense) = aliases::older(name)?;
        let parameter = self.named(own)?;
        Some(Parameter {
            name: alias,
            value: sense.convert(parameter.value),
            ..parameter
        })
    }

    /// Stores a value without a range check, as the vehicle does. `None` for an unknown name or a value that
    /// is not a finite number.
    pub(super) fn set(&mut self, name: &str, value: f32) -> Option<Parameter> {
        if !value.is_finite() {
            return None;
        }
        if let Some((alias, own, sense)) = aliases::older(name) {
            self.set(own, sense.convert(value))?;
            return self.named(alias);
        }
        let parameter = self.named(name)?;
        let changed = (parameter.index, parameter.kind.stored(value));
        match self.changed_place(parameter.index) {
            Ok(place) => self.changed[place] = changed,
            Err(place) => self.changed.insert(place, changed),
        }
        self.at(parameter.index)
    }

    /// The `PARAM_VALUE` of a parameter, with its index in the list.
    pub(super) fn message(&self, parameter: &Parameter) -> MavMessage {
        MavMessage::PARAM_VALUE(self.fields_of(parameter))
    }

    /// The fields of a `PARAM_VALUE`, with its index.
    pub(super) fn fields_of(&self, parameter: &Parameter) -> PARAM_VALUE_DATA {
        let mut name = [0; 16];
        let len = parameter.name.len().min(name.len());
        name[..len].copy_from_slice(&parameter.name.as_bytes()[..len]);
        PARAM_VALUE_DATA {
            param_value: parameter.value,
            param_count: self.count(),
            param_index: parameter.index,
            param_id: CharArray::new(name),
            param_type: parameter.kind.on_the_wire(),
        }
    }

    fn changed_place(&self, index: u16) -> Result<usize, usize> {
        self.changed.binary_search_by_key(&index, |(own, _)| *own)
    }

    /// The value of a parameter of the table.
    pub(super) fn value(&self, name: &str) -> f64 {
        let found = self.named(name);
        debug_assert!(found.is_some(), "no parameter {name}");
        found.map_or(0.0, |parameter| f64::from(parameter.value))
    }

    /// Whether the vehicle offers files by `MAVLink` FTP; a bit of the board's options turns that off.
    pub(super) fn hands_out_files(&self) -> bool {
        self.value("BRD_OPTIONS") as i64 & 0x2 == 0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn integers_are_truncated_and_names_ignore_case() {
        let mut all = Parameters::new(3);
        let stored = all.set("rtl_alt", 1500.7).expect("known");
        assert!((stored.value - 1500.0).abs() < f32::EPSILON);
        assert_eq!(all.value("SYSID_THISMAV") as u8, 3);
        assert_eq!(all.set("WPNAV_SPEED", f32::NAN), None);
        assert_eq!(all.set("NO_SUCH_NAME", 1.0), None);
    }

    #[test]
    fn every_newer_name_sets_and_reads_an_old_parameter() {
        let old_names = (0..Parameters::new(1).count()).filter_map(|index| {
            let own = Parameters::new(1).at(index)?.name;
            let (newer, sense) = aliases::other_name(own)?;
            Some((newer, own, sense))
        });
        let old_names: Vec<_> = old_names.collect();
        assert!(old_names.len() > 20, "{old_names:?}");
        for (newer, own, sense) in old_names {
            let mut all = Parameters::new(1);
            for value in [0.0, 1.0] {
                let set = all.set(&newer.to_lowercase(), value).expect("known");
                assert_eq!((set.name, set.value.to_bits()), (newer, value.to_bits()));
                let stored = all.named(own).expect("in the table").value;
                assert_eq!(stored.to_bits(), sense.convert(value).to_bits(), "{newer}");
                assert!((0..all.count()).all(|index| all.at(index).expect("listed").name != newer));
            }
        }
    }
}
