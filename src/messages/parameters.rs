//! `PARAM_VALUE`: values of parameters, requested or not.

use std::str;

use mavlink::dialects::ardupilotmega::{MavProtocolCapability, PARAM_VALUE_DATA};

use crate::parameters::{HeardParameter, ParameterEncoding, ParameterList, ParameterType};
use crate::vehicle::Vehicle;

/// `PARAM_VALUE.param_index` of a value that was sent on its own, not as part of the list.
const NO_INDEX: u16 = u16::MAX;
const BYTEWISE: u64 = MavProtocolCapability::MAV_PROTOCOL_CAPABILITY_PARAM_ENCODE_BYTEWISE.bits();

pub(super) fn apply(parameters: &mut ParameterList, data: &PARAM_VALUE_DATA, vehicle: &Vehicle) {
    let bytes: &[u8; 16] = &data.param_id;
    let bytes = bytes.split(|&byte| byte == 0).next().unwrap_or_default();
    // Names are ASCII; other bytes are noise, or not a name.
    let Ok(name) = str::from_utf8(bytes) else {
        return;
    };
    if name.is_empty() || !name.bytes().all(|byte| byte.is_ascii_graphic()) {
        return;
    }
    parameters.note(&HeardParameter {
        name,
        value: parameter_value(data, vehicle),
        kind: data.param_type.into(),
        encoding: parameter_encoding(vehicle),
        index: (data.param_index != NO_INDEX).then_some(data.param_index),
        count: data.param_count,
    });
}

/// How a vehicle encodes integers. One that has not reported its capabilities is judged by its autopilot.
pub fn parameter_encoding(vehicle: &Vehicle) -> ParameterEncoding {
    let is_bytewise = match vehicle.version {
        Some(version) => version.capabilities & BYTEWISE != 0,
        None => vehicle.runs_px4(),
    };
    if is_bytewise {
        ParameterEncoding::Bytewise
    } else {
        ParameterEncoding::Converted
    }
}

/// The value of a parameter as a number.
pub fn parameter_value(data: &PARAM_VALUE_DATA, vehicle: &Vehicle) -> f64 {
    match parameter_encoding(vehicle) {
        ParameterEncoding::Converted => data.param_value.into(),
        ParameterEncoding::Bytewise => of_bytes(data.param_value, data.param_type.into()),
    }
}

/// The number whose bytes are in the float.
fn of_bytes(value: f32, kind: ParameterType) -> f64 {
    let bytes @ [first, second, ..] = value.to_bits().to_le_bytes();
    match kind {
        ParameterType::Uint8 => f64::from(first),
        ParameterType::Int8 => f64::from(i8::from_le_bytes([first])),
        ParameterType::Uint16 => f64::from(u16::from_le_bytes([first, second])),
        ParameterType::Int16 => f64::from(i16::from_le_bytes([first, second])),
        ParameterType::Uint32 => f64::from(u32::from_le_bytes(bytes)),
        ParameterType::Int32 => f64::from(i32::from_le_bytes(bytes)),
        // The float has no room for 64 bits.
        ParameterType::Uint64
        | ParameterType::Int64
        | ParameterType::Real32
        | ParameterType::Real64 => value.into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_of_integers_are_their_values() {
        let minus_one = f32::from_bits(u32::MAX);
        let value = |kind| of_bytes(minus_one, kind) as i64;
        assert_eq!(value(ParameterType::Int32), -1);
        assert_eq!(value(ParameterType::Int8), -1);
        assert_eq!(value(ParameterType::Uint16), 65_535);
        assert_eq!(value(ParameterType::Uint32), 4_294_967_295);
        let real = of_bytes(0.25, ParameterType::Real32);
        assert!((real - 0.25).abs() < f64::EPSILON);
    }
}
