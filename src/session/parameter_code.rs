//! The encoding of parameters that are set. `ArduPilot` converts integers to the float of `PARAM_SET`; PX4 copies their
//! bytes into it (`MAV_PROTOCOL_CAPABILITY_PARAM_ENCODE_BYTEWISE`). For received values see `messages::parameters`.

use mavlink::dialects::ardupilotmega::{MavMessage, MavParamType};

use super::VehicleCommand;
use crate::commands::{Command, ParameterCommand, Request};
use crate::messages::parameter_encoding;
use crate::parameters::{ParameterEncoding, ParameterList, ParameterType};
use crate::vehicle::Vehicle;
use crate::wire::Outgoing;

/// Whether the vehicle copies the bytes of integers.
pub(super) fn is_bytewise(vehicle: &Vehicle) -> bool {
    parameter_encoding(vehicle) == ParameterEncoding::Bytewise
}

/// The type of the parameter that a command sets, if the vehicle takes the bytes of that type. It must be known: PX4
/// refuses another one.
pub(super) fn kind(
    command: &Command,
    list: &ParameterList,
    vehicle: &Vehicle,
) -> Option<ParameterType> {
    let Command::Parameter(ParameterCommand::Set { name, .. }) = command else {
        return None;
    };
    let known = list.get(name).filter(|_| is_bytewise(vehicle));
    known.map(|known| known.kind)
}

/// Encodes the value that an order sets, if the vehicle takes bytes. The value is the command's: the float of the message
/// has only 24 of its bits.
pub(super) fn encode(request: &mut Request, order: &VehicleCommand) {
    let (Command::Parameter(ParameterCommand::Set { value, .. }), Some(kind)) =
        (&order.command, order.stored_as)
    else {
        return;
    };
    for message in &mut request.messages {
        if let Outgoing::Message(MavMessage::PARAM_SET(data)) = message {
            data.param_value = copied(*value, kind);
            data.param_type = wire_type(kind);
        }
    }
}

/// A float with the bytes of the number, which fits the type.
fn copied(value: f64, kind: ParameterType) -> f32 {
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
        | ParameterType::Real64 => return value as f32,
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
    fn reals_are_sent_as_they_are() {
        assert!((copied(0.25, ParameterType::Real32) - 0.25).abs() < f32::EPSILON);
        assert_eq!(copied(-3.0, ParameterType::Int8).to_bits(), 0xFD);
    }

    proptest! {
        #[test]
        fn integers_keep_all_their_bits(number in any::<i32>()) {
            let sent = copied(f64::from(number), ParameterType::Int32);
            prop_assert_eq!(sent.to_bits(), number.cast_unsigned());
        }
    }
}
