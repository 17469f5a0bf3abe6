//! Parameters as they pass.

use std::collections::BTreeMap;
use std::str;

use mavlink::dialects::ardupilotmega::{MavParamType, PARAM_VALUE_DATA};

/// `PARAM_VALUE.param_index` of a value that was sent for itself, not as part of the list.
const NO_INDEX: u16 = u16::MAX;
/// No vehicle has more parameters; beyond this, names are noise and are not kept.
const MOST_PARAMETERS: usize = 10_000;

/// The type that the vehicle stores a parameter in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ParameterType {
    /// 8 bits, unsigned.
    Uint8,
    /// 8 bits.
    Int8,
    /// 16 bits, unsigned.
    Uint16,
    /// 16 bits.
    Int16,
    /// 32 bits, unsigned.
    Uint32,
    /// 32 bits.
    Int32,
    /// 64 bits, unsigned.
    Uint64,
    /// 64 bits.
    Int64,
    /// 32 bits, floating point.
    Real32,
    /// 64 bits, floating point.
    Real64,
}

impl From<MavParamType> for ParameterType {
    fn from(wire: MavParamType) -> Self {
        match wire {
            MavParamType::MAV_PARAM_TYPE_UINT8 => Self::Uint8,
            MavParamType::MAV_PARAM_TYPE_INT8 => Self::Int8,
            MavParamType::MAV_PARAM_TYPE_UINT16 => Self::Uint16,
            MavParamType::MAV_PARAM_TYPE_INT16 => Self::Int16,
            MavParamType::MAV_PARAM_TYPE_UINT32 => Self::Uint32,
            MavParamType::MAV_PARAM_TYPE_INT32 => Self::Int32,
            MavParamType::MAV_PARAM_TYPE_UINT64 => Self::Uint64,
            MavParamType::MAV_PARAM_TYPE_INT64 => Self::Int64,
            MavParamType::MAV_PARAM_TYPE_REAL32 => Self::Real32,
            MavParamType::MAV_PARAM_TYPE_REAL64 => Self::Real64,
        }
    }
}

/// One parameter as the vehicle said it last.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Parameter {
    /// The value. Integers come converted to a float, as `ArduPilot` sends them, not as its bits.
    pub value: f32,
    /// The type that the vehicle stores it in.
    pub kind: ParameterType,
    /// Its place in the vehicle's list, where one was said.
    pub index: Option<u16>,
}

/// The parameters of a vehicle that have passed so far, by name.
#[derive(Debug, Clone, Default)]
pub struct Parameters {
    by_name: BTreeMap<String, Parameter>,
    count: Option<u16>,
    /// Which places of the list have passed.
    seen: Vec<bool>,
}

impl Parameters {
    /// The parameter of that name (upper case, as the vehicle spells it).
    pub fn get(&self, name: &str) -> Option<&Parameter> {
        self.by_name.get(name)
    }

    /// All that have passed, in order of their names.
    pub fn iter(&self) -> impl Iterator<Item = (&str, &Parameter)> {
        self.by_name
            .iter()
            .map(|(name, parameter)| (name.as_str(), parameter))
    }

    /// How many have passed.
    pub fn len(&self) -> usize {
        self.by_name.len()
    }

    /// Whether none has passed.
    pub fn is_empty(&self) -> bool {
        self.by_name.is_empty()
    }

    /// How many the vehicle has, once it has said so.
    pub fn count(&self) -> Option<u16> {
        self.count
    }

    /// Places of the vehicle's list that have not passed yet, in order. Empty also before the vehicle has
    /// said how many there are.
    pub fn missing(&self) -> impl Iterator<Item = u16> + '_ {
        (0..)
            .zip(&self.seen)
            .filter(|(_, seen)| !**seen)
            .map(|(index, _)| index)
    }

    pub(super) fn note(&mut self, data: &PARAM_VALUE_DATA) {
        let bytes: &[u8; 16] = &data.param_id;
        let bytes = bytes.split(|&byte| byte == 0).next().unwrap_or_default();
        // Names are ASCII; what is not is noise, or no name at all.
        let Ok(name) = str::from_utf8(bytes) else {
            return;
        };
        if name.is_empty() || !name.bytes().all(|byte| byte.is_ascii_graphic()) {
            return;
        }
        self.note_place(data);
        let index = (data.param_index != NO_INDEX).then_some(data.param_index);
        let parameter = Parameter {
            value: data.param_value,
            kind: data.param_type.into(),
            index,
        };
        if let Some(known) = self.by_name.get_mut(name) {
            *known = Parameter {
                index: index.or(known.index),
                ..parameter
            };
        } else if self.by_name.len() < MOST_PARAMETERS {
            self.by_name.insert(name.to_owned(), parameter);
        }
    }

    /// Another count means another list, in which the places that were seen mean nothing.
    fn note_place(&mut self, data: &PARAM_VALUE_DATA) {
        if self.count != Some(data.param_count) {
            self.count = Some(data.param_count);
            self.seen.clear();
            self.seen.resize(usize::from(data.param_count), false);
            for parameter in self.by_name.values_mut() {
                parameter.index = None;
            }
        }
        if let Some(seen) = self.seen.get_mut(usize::from(data.param_index)) {
            *seen = true;
        }
    }
}
