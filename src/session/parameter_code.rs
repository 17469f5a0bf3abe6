//! The encoding of parameters. `ArduPilot` converts integers to the float of `PARAM_VALUE` and `PARAM_SET`; PX4 copies
//! their bytes into it (`MAV_PROTOCOL_CAPABILITY_PARAM_ENCODE_BYTEWISE`). Inside of the session, all values are
//! converted ones: only here, at its edge, are bytes.

use std::borrow::Cow;

use mavlink::dialects::ardupilotmega::{MavMessage, MavParamType, MavProtocolCapability};

use crate::parameters::{ParameterList, ParameterType};
use crate::vehicle::Vehicle;
use crate::wire::{Content, Frame, Outgoing};

const BYTEWISE: u64 = MavProtocolCapability::MAV_PROTOCOL_CAPABILITY_PARAM_ENCODE_BYTEWISE.bits();

/// Whether the vehicle copies the bytes of integers. A vehicle that has not reported its capabilities is judged by its
/// autopilot.
pub(super) fn is_bytewise(vehicle: &Vehicle) -> bool {
    match vehicle.version {
        Some(version) => version.capabilities & BYTEWISE != 0,
        None => vehicle.runs_px4(),
    }
}

/// A received frame, with a parameter's value converted.
pub(super) fn received<'frame>(frame: &'frame Frame, vehicle: &Vehicle) -> Cow<'frame, Frame> {
    let Content::Message(MavMessage::PARAM_VALUE(data)) = &frame.content else {
        return Cow::Borrowed(frame);
    };
    if frame.component != vehicle.component || !is_bytewise(vehicle) {
        return Cow::Borrowed(frame);
    }
    let mut data = data.clone();
    data.param_value = converted(data.param_value, data.param_type.into());
    Cow::Owned(Frame {
        content: Content::Message(MavMessage::PARAM_VALUE(data)),
        ..frame.clone()
    })
}

/// Encodes a parameter's value in a message to the vehicle, if the vehicle takes bytes. The type must be known: PX4
/// refuses another one.
pub(super) fn encode(message: &mut Outgoing, vehicle: &Vehicle, list: &ParameterList) {
    let Outgoing::Message(MavMessage::PARAM_SET(data)) = message else {
        return;
    };
    let known = data.param_id.to_str().ok().and_then(|name| list.get(name));
    if let Some(known) = known.filter(|_| is_bytewise(vehicle)) {
        data.param_value = copied(data.param_value, known.kind);
        data.param_type = wire_type(known.kind);
    }
}

/// The number whose bytes are in the float. Whole numbers of more than 24 bits are rounded.
fn converted(value: f32, kind: ParameterType) -> f32 {
    let bytes @ [first, second, ..] = value.to_le_bytes();
    match kind {
        ParameterType::Uint8 => f32::from(first),
        ParameterType::Int8 => f32::from(i8::from_le_bytes([first])),
        ParameterType::Uint16 => f32::from(u16::from_le_bytes([first, second])),
        ParameterType::Int16 => f32::from(i16::from_le_bytes([first, second])),
        ParameterType::Uint32 => u32::from_le_bytes(bytes) as f32,
        ParameterType::Int32 => i32::from_le_bytes(bytes) as f32,
        // The float has no room for 64 bits.
        ParameterType::Uint64
        | ParameterType::Int64
        | ParameterType::Real32
        | ParameterType::Real64 => value,
    }
}

/// A float with the bytes of the number, which fits the type.
fn copied(value: f32, kind: ParameterType) -> f32 {
    let bits = match kind {
        ParameterType::Uint8 => u32::from(value as u8),
        ParameterType::Int8 => u32::from((value as i8).cast_unsigned()),
        ParameterType::Uint16 => u32::from(value as u16),
        ParameterType::Int16 => u32::from((value as i16).cast_unsigned()),
        ParameterType::Uint32 => value as u32,
        ParameterType::Int32 => (value as i32).cast_unsigned(),
        ParameterType::Uint64
        | ParameterType::Int64
        | ParameterType::Real32
        | ParameterType::Real64 => return value,
    };
    f32::from_bits(bits)
}

fn wire_type(kind: ParameterType) -> MavParamType {
    match kind {
        ParameterType::Uint8 => MavParamType::MAV_PARAM_TYPE_UINT8,
        ParameterType::Int8 => MavParamType::MAV_PARAM_TYPE_INT8,
        ParameterType::Uint16 => MavParamType::MAV_PARAM_TYPE_UINT16,
        ParameterType::Int16 => MavParamType::MAV_PARAM_TYPE_INT16,
        ParameterType::Uint32 => MavParamType::MAV_PARAM_TYPE_UINT32,
        ParameterType::Int32 => MavParamType::MAV_PARAM_TYPE_INT32,
        ParameterType::Uint64 => MavParamType::MAV_PARAM_TYPE_UINT64,
        ParameterType::Int64 => MavParamType::MAV_PARAM_TYPE_INT64,
        ParameterType::Real32 => MavParamType::MAV_PARAM_TYPE_REAL32,
        ParameterType::Real64 => MavParamType::MAV_PARAM_TYPE_REAL64,
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn bytes_of_integers_are_their_values() {
        let minus_one = f32::from_bits(u32::MAX);
        assert!((converted(minus_one, ParameterType::Int32) + 1.0).abs() < f32::EPSILON);
        assert!((converted(minus_one, ParameterType::Uint16) - 65535.0).abs() < f32::EPSILON);
        assert_eq!(copied(4001.0, ParameterType::Int32).to_bits(), 4001);
        assert!((copied(0.25, ParameterType::Real32) - 0.25).abs() < f32::EPSILON);
    }

    proptest! {
        #[test]
        fn every_integer_comes_back(number in -16_777_216_i32..=16_777_216) {
            let value = number as f32;
            let sent = copied(value, ParameterType::Int32);
            prop_assert_eq!(sent.to_bits(), number.cast_unsigned());
            prop_assert_eq!(converted(sent, ParameterType::Int32).to_bits(), value.to_bits());
        }
    }
}
