//! The vehicle's parameters: their table, names and values.

mod aliases;
mod table;

use mavlink::dialects::ardupilotmega::{MavMessage, MavParamType, PARAM_VALUE_DATA};
use mavlink::types::CharArray;

use self::table::{ParameterTable, SubTree};
use super::kind::{Chassis, VehicleKind};
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
    pub(super) default: f32,
    /// The index in the list; [`BY_NAME`] while it is not listed.
    pub(super) index: u16,
    /// The place in the table.
    place: u16,
}

/// The parameter values of a vehicle, which survive a reboot. Thousands of vehicles share those of the first boot: each
/// stores only the values that differ.
#[derive(Debug, Clone)]
pub(super) struct Parameters {
    kind: VehicleKind,
    /// Places in the table with values other than those of the first boot, in ascending order.
    changed: Vec<(u16, f32)>,
    /// Values that return at the next boot, since the present ones are not stored.
    stored: Vec<(u16, f32)>,
}

impl VehicleKind {
    /// The parameters with which a new vehicle of this kind starts and whose values differ from the defaults of its
    /// firmware: those of SITL's model with the same name.
    pub fn own_parameters(self) -> Vec<(&'static str, f32)> {
        let rows = ParameterTable::of(self).rows.iter();
        let own = rows.filter(|row| row.first.total_cmp(&row.default).is_ne());
        let of_chassis = self.chassis().map_or(&[][..], Chassis::parameters).iter();
        own.map(|row| (row.name, row.first))
            .chain(of_chassis.copied())
            .collect()
    }
}

impl Parameters {
    /// All parameters at their defaults, with the vehicle's own system id.
    pub(super) fn new(kind: VehicleKind, system: u8) -> Self {
        let mut all = Self {
            kind,
            changed: Vec::new(),
            stored: Vec::new(),
        };
        all.set("SYSID_THISMAV", f32::from(system));
        all
    }

    fn table(&self) -> &'static ParameterTable {
        ParameterTable::of(self.kind)
    }

    /// The kind of vehicle whose parameters these are.
    pub(super) fn kind(&self) -> VehicleKind {
        self.kind
    }

    /// The switches of sub-trees.
    pub(super) fn switches(&self) -> impl Iterator<Item = &'static str> {
        let table = self.table();
        let trees = table.sub_trees.iter();
        trees.filter_map(|tree| table.rows.get(usize::from(tree.switch)).map(|row| row.name))
    }

    /// The number of parameters in the list, which changes with the switches of sub-trees.
    pub(super) fn count(&self) -> u16 {
        let hidden: u16 = self.hidden().map(|tree| tree.count).sum();
        self.table().rows.len() as u16 - hidden
    }

    /// The parameter at an index of the list; `None` beyond its end.
    pub(super) fn at(&self, index: u16) -> Option<Parameter> {
        let mut place = index;
        for tree in self.hidden() {
            if tree.switch >= place {
                break;
            }
            place += tree.count;
        }
        self.in_place(place)
    }

    /// The sub-trees that are not listed, in ascending order.
    fn hidden(&self) -> impl Iterator<Item = &'static SubTree> {
        let trees = self.table().sub_trees.iter();
        trees.filter(|tree| self.value_in_place(tree.switch) == 0.0)
    }

    fn in_place(&self, place: u16) -> Option<Parameter> {
        let row = self.table().rows.get(usize::from(place))?;
        Some(Parameter {
            name: row.name,
            kind: row.kind,
            value: self.value_in_place(place),
            default: row.default,
            index: self.index_of(place),
            place,
        })
    }

    fn value_in_place(&self, place: u16) -> f32 {
        let at = self.changed_place(place).ok();
        let changed = at.and_then(|at| self.changed.get(at));
        let first = || {
            self.table()
                .rows
                .get(usize::from(place))
                .map_or(0.0, |row| row.first)
        };
        changed.map_or_else(first, |(_, value)| *value)
    }

    /// The list index of the parameter at a place of the table.
    fn index_of(&self, place: u16) -> u16 {
        let mut before = 0;
        for tree in self.hidden().take_while(|tree| tree.switch < place) {
            if place <= tree.switch + tree.count {
                return BY_NAME;
            }
            before += tree.count;
        }
        place - before
    }

    /// The parameter with a name of either firmware; `None` for an unknown name. Case does not
    /// matter.
    pub(super) fn named(&self, name: &str) -> Option<Parameter> {
        if let Some(index) = self.table().place(name) {
            return self.in_place(index as u16);
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
        self.stored.retain(|(place, _)| *place != parameter.place);
        self.change(parameter.place, parameter.kind.stored(value));
        self.in_place(parameter.place)
    }

    fn change(&mut self, place: u16, value: f32) {
        match self.changed_place(place) {
            Ok(at) => self.changed[at] = (place, value),
            Err(at) => self.changed.insert(at, (place, value)),
        }
    }

    /// Sets a value until the next boot, without storing it.
    pub(super) fn set_until_boot(&mut self, name: &str, value: f32) {
        let Some(parameter) = self.named(name) else {
            return;
        };
        if self
            .stored
            .iter()
            .all(|(place, _)| *place != parameter.place)
        {
            self.stored.push((parameter.place, parameter.value));
        }
        self.change(parameter.place, parameter.kind.stored(value));
    }

    /// The values after a boot.
    pub(super) fn rebooted(mut self) -> Self {
        for (place, value) in std::mem::take(&mut self.stored) {
            self.change(place, value);
        }
        self
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

    fn changed_place(&self, place: u16) -> Result<usize, usize> {
        self.changed.binary_search_by_key(&place, |(own, _)| *own)
    }

    /// The value of a parameter; 0 for one that only another kind of vehicle has.
    pub(super) fn value(&self, name: &str) -> f64 {
        if let Some(place) = self.table().place(name) {
            return f64::from(self.value_in_place(place as u16));
        }
        let found = self.named(name);
        debug_assert!(
            found.is_some() || ParameterTable::is_known(name),
            "no parameter {name}"
        );
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
        let mut all = Parameters::new(VehicleKind::Copter, 3);
        let stored = all.set("rtl_alt", 1500.7).expect("known");
        assert!((stored.value - 1500.0).abs() < f32::EPSILON);
        assert_eq!(all.value("SYSID_THISMAV") as u8, 3);
        assert_eq!(all.set("WPNAV_SPEED", f32::NAN), None);
        assert_eq!(all.set("NO_SUCH_NAME", 1.0), None);
    }

    #[test]
    fn a_value_that_is_not_stored_lasts_until_the_next_boot() {
        let mut all = Parameters::new(VehicleKind::Copter, 1);
        all.set("SR0_POSITION", 2.0);
        all.set_until_boot("SR0_POSITION", 4.0);
        all.set_until_boot("SR0_POSITION", 5.0);
        all.set_until_boot("SR0_EXTRA1", 5.0);
        all.set("SR0_EXTRA1", 1.0);
        assert!((all.value("SR0_POSITION") - 5.0).abs() < 1e-9);
        let all = all.rebooted();
        assert!((all.value("SR0_POSITION") - 2.0).abs() < 1e-9);
        assert!((all.value("SR0_EXTRA1") - 1.0).abs() < 1e-9);
    }

    #[test]
    fn a_sub_tree_is_listed_after_its_switch_while_that_is_on() {
        let mut all = Parameters::new(VehicleKind::Copter, 1);
        let before = all.count();
        let names = |all: &Parameters| -> Vec<_> {
            let listed = (0..all.count()).filter_map(|index| all.at(index));
            listed.map(|parameter| parameter.name).collect()
        };
        let all_names = names(&all);
        assert_eq!(all_names.len(), usize::from(before));
        assert!(!all_names.contains(&"CHUTE_TYPE"));
        // It can be set by name before it is listed.
        let hidden = all.set("CHUTE_TYPE", 10.0).expect("known");
        assert_eq!(hidden.index, BY_NAME);
        all.set("CHUTE_ENABLED", 1.0).expect("known");
        assert_eq!(all.count(), before + 7);
        let listed = names(&all);
        let at = listed
            .iter()
            .position(|name| *name == "CHUTE_ENABLED")
            .expect("listed");
        assert_eq!(
            listed[at..at + 9],
            [
                "CHUTE_ENABLED",
                "CHUTE_TYPE",
                "CHUTE_SERVO_ON",
                "CHUTE_SERVO_OFF",
                "CHUTE_ALT_MIN",
                "CHUTE_DELAY_MS",
                "CHUTE_CRT_SINK",
                "CHUTE_OPTIONS",
                "LGR_ENABLE"
            ]
        );
        for (index, name) in listed.iter().enumerate() {
            assert_eq!(
                usize::from(all.named(name).expect("known").index),
                index,
                "{name}"
            );
        }
        all.set("CHUTE_ENABLED", 0.0);
        assert_eq!(names(&all), all_names);
        for (switch, name) in [
            ("RNGFND1_TYPE", "RNGFND1_MIN_CM"),
            ("MNT1_TYPE", "MNT1_PITCH_MIN"),
            ("PLND_ENABLED", "PLND_TYPE"),
            ("FOLL_ENABLE", "FOLL_SYSID"),
            ("WVANE_ENABLE", "WVANE_GAIN"),
            ("BATT2_MONITOR", "BATT2_CAPACITY"),
            ("GRIP_ENABLE", "GRIP_TYPE"),
            ("INS_HNTCH_ENABLE", "INS_HNTCH_FREQ"),
            ("GPS2_TYPE", "GPS2_POS_Y"),
        ] {
            all.set(switch, 1.0);
            assert_ne!(all.named(name).expect("known").index, BY_NAME, "{name}");
        }
    }

    #[test]
    fn every_newer_name_sets_and_reads_an_old_parameter() {
        let old_names = (0..Parameters::new(VehicleKind::Copter, 1).count()).filter_map(|index| {
            let own = Parameters::new(VehicleKind::Copter, 1).at(index)?.name;
            let (newer, sense) = aliases::other_name(own)?;
            Some((newer, own, sense))
        });
        let old_names: Vec<_> = old_names.collect();
        assert!(old_names.len() > 20, "{old_names:?}");
        for (newer, own, sense) in old_names {
            let mut all = Parameters::new(VehicleKind::Copter, 1);
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
