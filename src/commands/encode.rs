//! Commands as MAVLink messages. Only finite numbers are encoded: one NaN in a setpoint crashes ArduPilot's simulator.
//! In commands to PX4, NaN stands for what is left to the vehicle.

use mavlink::dialects::ardupilotmega::{
    COMMAND_INT_DATA, COMMAND_LONG_DATA, MavCmd, MavFrame, MavMessage, MavParamType,
    PARAM_REQUEST_READ_DATA, PARAM_SET_DATA, PositionTargetTypemask as Mask,
    SET_POSITION_TARGET_GLOBAL_INT_DATA, SET_POSITION_TARGET_LOCAL_NED_DATA,
};
use mavlink::{MavlinkVersion, Message as _, MessageData as _};

use crate::geo::LatLon;
use crate::text;
use crate::text::Text;
use crate::vehicle::Vehicle;
use crate::wire::Outgoing;

const COMMAND_INT: u32 = COMMAND_INT_DATA::ID;
const COMMAND_LONG: u32 = COMMAND_LONG_DATA::ID;
/// The offset of the confirmation in `COMMAND_LONG`'s payload.
const CONFIRMATION_OFFSET: usize = 32;

/// `MAV_FRAME_GLOBAL`: heights above mean sea level.
pub(super) const FRAME_GLOBAL: u8 = MavFrame::MAV_FRAME_GLOBAL as u8;
/// The frame of heights above home.
#[expect(
    deprecated,
    reason = "older autopilots know only the _INT spelling of the frame, newer ones both"
)]
pub(super) const FRAME_RELATIVE: u8 = MavFrame::MAV_FRAME_GLOBAL_RELATIVE_ALT_INT as u8;

const IGNORE_POSITION: Mask = Mask::POSITION_TARGET_TYPEMASK_X_IGNORE
    .union(Mask::POSITION_TARGET_TYPEMASK_Y_IGNORE)
    .union(Mask::POSITION_TARGET_TYPEMASK_Z_IGNORE);
const IGNORE_VELOCITY: Mask = Mask::POSITION_TARGET_TYPEMASK_VX_IGNORE
    .union(Mask::POSITION_TARGET_TYPEMASK_VY_IGNORE)
    .union(Mask::POSITION_TARGET_TYPEMASK_VZ_IGNORE);
const IGNORE_ACCELERATION: Mask = Mask::POSITION_TARGET_TYPEMASK_AX_IGNORE
    .union(Mask::POSITION_TARGET_TYPEMASK_AY_IGNORE)
    .union(Mask::POSITION_TARGET_TYPEMASK_AZ_IGNORE);
const IGNORE_YAW: Mask = Mask::POSITION_TARGET_TYPEMASK_YAW_IGNORE;
const IGNORE_YAW_RATE: Mask = Mask::POSITION_TARGET_TYPEMASK_YAW_RATE_IGNORE;

/// Command and parameters of a `COMMAND_LONG`.
pub(super) struct LongFields {
    pub command: u16,
    pub params: [f32; 7],
}

impl LongFields {
    /// Fields with the first parameters given and the others 0.
    pub fn new(command: MavCmd, given: &[f32]) -> Self {
        Self::numbered(command as u16, given)
    }

    /// As [`Self::new`], with the number of the command.
    pub fn numbered(command: u16, given: &[f32]) -> Self {
        let mut params = [0.0; 7];
        params[..given.len()].copy_from_slice(given);
        Self { command, params }
    }
}

/// `COMMAND_LONG` to a vehicle.
pub(super) fn long(
    vehicle: &Vehicle,
    fields: &LongFields,
    confirmation: u8,
) -> Result<Outgoing, Text> {
    encodable(vehicle, &fields.params)?;
    let mut payload = Vec::with_capacity(33);
    for param in fields.params {
        payload.extend_from_slice(&param.to_le_bytes());
    }
    payload.extend_from_slice(&fields.command.to_le_bytes());
    payload.extend_from_slice(&[vehicle.system, vehicle.component, confirmation]);
    Ok(outgoing(COMMAND_LONG, payload))
}

/// The fields of `COMMAND_INT` that differ from command to command.
pub(super) struct IntFields {
    pub command: u16,
    pub frame: u8,
    pub params: [f32; 4],
    pub x: i32,
    pub y: i32,
    pub z: f32,
}

impl IntFields {
    /// A command with a place in degrees, and a height that depends on `frame`.
    pub fn at(
        command: MavCmd,
        frame: u8,
        params: [f32; 4],
        point: LatLon,
        height_m: f64,
    ) -> Result<Self, Text> {
        let (x, y) = checked(point)?.to_e7();
        Ok(Self {
            command: command as u16,
            frame,
            params,
            x,
            y,
            z: height_m as f32,
        })
    }
}

/// `COMMAND_INT` to a vehicle.
pub(super) fn int(vehicle: &Vehicle, fields: &IntFields) -> Result<Outgoing, Text> {
    encodable(vehicle, &fields.params)?;
    finite(&[fields.z])?;
    let mut payload = Vec::with_capacity(35);
    for param in fields.params {
        payload.extend_from_slice(&param.to_le_bytes());
    }
    payload.extend_from_slice(&fields.x.to_le_bytes());
    payload.extend_from_slice(&fields.y.to_le_bytes());
    payload.extend_from_slice(&fields.z.to_le_bytes());
    payload.extend_from_slice(&fields.command.to_le_bytes());
    payload.extend_from_slice(&[vehicle.system, vehicle.component, fields.frame, 0, 0]);
    Ok(outgoing(COMMAND_INT, payload))
}

/// A message of the dialect if the dialect has names for all numbers in the payload, otherwise the raw payload.
fn outgoing(id: u32, payload: Vec<u8>) -> Outgoing {
    match MavMessage::parse(MavlinkVersion::V2, id, &payload) {
        Ok(message) => message.into(),
        Err(_) => Outgoing::Raw { id, payload },
    }
}

/// Increments the confirmation of a `COMMAND_LONG`; other messages have none.
pub(super) fn confirm_again(outgoing: &mut Outgoing) {
    match outgoing {
        Outgoing::Message(MavMessage::COMMAND_LONG(long)) => {
            long.confirmation = long.confirmation.wrapping_add(1);
        }
        Outgoing::Raw { id, payload } if *id == COMMAND_LONG => {
            if let Some(confirmation) = payload.get_mut(CONFIRMATION_OFFSET) {
                *confirmation = confirmation.wrapping_add(1);
            }
        }
        Outgoing::Message(_) | Outgoing::Raw { .. } => {}
    }
}

/// A position target in metres north, east, down of the EKF origin.
pub(super) fn local_position(
    vehicle: &Vehicle,
    ned_m: [f64; 3],
    yaw_deg: Option<f64>,
) -> Result<Outgoing, Text> {
    let [x, y, z] = ned_m.map(|metres| metres as f32);
    let yaw = yaw_deg.unwrap_or(0.0).to_radians() as f32;
    finite(&[x, y, z, yaw])?;
    Ok(local(
        vehicle,
        SET_POSITION_TARGET_LOCAL_NED_DATA {
            x,
            y,
            z,
            yaw,
            type_mask: position_mask(yaw_deg),
            ..Default::default()
        },
    ))
}

/// A velocity target in m/s north, east, down.
pub(super) fn velocity(vehicle: &Vehicle, ned_m_s: [f64; 3]) -> Result<Outgoing, Text> {
    let [vx, vy, vz] = ned_m_s.map(|speed| speed as f32);
    finite(&[vx, vy, vz])?;
    Ok(local(
        vehicle,
        SET_POSITION_TARGET_LOCAL_NED_DATA {
            vx,
            vy,
            vz,
            type_mask: IGNORE_POSITION | IGNORE_ACCELERATION | IGNORE_YAW | IGNORE_YAW_RATE,
            ..Default::default()
        },
    ))
}

/// A standstill of a vehicle on the ground or on water, at a heading in degrees. A velocity of zero alone would mean
/// north.
pub(super) fn standstill(vehicle: &Vehicle, heading_deg: f64) -> Result<Outgoing, Text> {
    let yaw = heading_deg.to_radians() as f32;
    finite(&[yaw])?;
    Ok(local(
        vehicle,
        SET_POSITION_TARGET_LOCAL_NED_DATA {
            yaw,
            type_mask: IGNORE_POSITION | IGNORE_ACCELERATION | IGNORE_YAW_RATE,
            ..Default::default()
        },
    ))
}

fn local(vehicle: &Vehicle, mut fields: SET_POSITION_TARGET_LOCAL_NED_DATA) -> Outgoing {
    fields.target_system = vehicle.system;
    fields.target_component = vehicle.component;
    fields.coordinate_frame = MavFrame::MAV_FRAME_LOCAL_NED;
    MavMessage::SET_POSITION_TARGET_LOCAL_NED(fields).into()
}

/// A position target on the earth, with its height above home.
#[expect(
    deprecated,
    reason = "older autopilots know only the _INT spelling of the frame, newer ones both"
)]
pub(super) fn global_position(
    vehicle: &Vehicle,
    point: LatLon,
    altitude_m: f64,
    yaw_deg: Option<f64>,
) -> Result<Outgoing, Text> {
    let (lat_int, lon_int) = checked(point)?.to_e7();
    let alt = altitude_m as f32;
    let yaw = yaw_deg.unwrap_or(0.0).to_radians() as f32;
    finite(&[alt, yaw])?;
    Ok(
        MavMessage::SET_POSITION_TARGET_GLOBAL_INT(SET_POSITION_TARGET_GLOBAL_INT_DATA {
            target_system: vehicle.system,
            target_component: vehicle.component,
            coordinate_frame: MavFrame::MAV_FRAME_GLOBAL_RELATIVE_ALT_INT,
            lat_int,
            lon_int,
            alt,
            yaw,
            type_mask: position_mask(yaw_deg),
            ..Default::default()
        })
        .into(),
    )
}

/// A moving position target on the earth, with its velocity in m/s north, east, down.
pub(super) fn moving_position(
    vehicle: &Vehicle,
    point: LatLon,
    altitude_m: f64,
    velocity_m_s: [f64; 3],
) -> Result<Outgoing, Text> {
    let [vx, vy, vz] = velocity_m_s.map(|speed| speed as f32);
    finite(&[vx, vy, vz])?;
    let mut message = global_position(vehicle, point, altitude_m, None)?;
    if let Outgoing::Message(MavMessage::SET_POSITION_TARGET_GLOBAL_INT(fields)) = &mut message {
        (fields.vx, fields.vy, fields.vz) = (vx, vy, vz);
        fields.type_mask = IGNORE_ACCELERATION | IGNORE_YAW | IGNORE_YAW_RATE;
    }
    Ok(message)
}

/// Requests a parameter by name.
pub(super) fn read_parameter(vehicle: &Vehicle, name: &str) -> Result<Outgoing, Text> {
    Ok(MavMessage::PARAM_REQUEST_READ(PARAM_REQUEST_READ_DATA {
        param_index: -1,
        target_system: vehicle.system,
        target_component: vehicle.component,
        param_id: parameter_id(name)?.into(),
    })
    .into())
}

/// `PARAM_SET`. ArduPilot takes the value as a number and ignores the type field.
pub(super) fn write_parameter(vehicle: &Vehicle, name: &str, value: f32) -> Result<Outgoing, Text> {
    finite(&[value])?;
    Ok(MavMessage::PARAM_SET(PARAM_SET_DATA {
        param_value: value,
        target_system: vehicle.system,
        target_component: vehicle.component,
        param_id: parameter_id(name)?.into(),
        param_type: MavParamType::MAV_PARAM_TYPE_REAL32,
    })
    .into())
}

fn parameter_id(name: &str) -> Result<[u8; 16], Text> {
    if name.is_empty() || name.len() > 16 || !name.is_ascii() {
        return Err(text!("refused-parameter-name", name = name));
    }
    let mut id = [0; 16];
    id[..name.len()].copy_from_slice(name.as_bytes());
    Ok(id)
}

fn position_mask(yaw_deg: Option<f64>) -> Mask {
    let yaw = if yaw_deg.is_some() {
        Mask::empty()
    } else {
        IGNORE_YAW
    };
    IGNORE_VELOCITY | IGNORE_ACCELERATION | IGNORE_YAW_RATE | yaw
}

fn checked(point: LatLon) -> Result<LatLon, Text> {
    if point.is_valid() {
        Ok(point)
    } else {
        Err(text!(
            "refused-no-place",
            lat = point.lat_deg.to_string(),
            lon = point.lon_deg.to_string()
        ))
    }
}

/// Refuses numbers that a command to this vehicle cannot carry.
fn encodable(vehicle: &Vehicle, params: &[f32]) -> Result<(), Text> {
    if !vehicle.runs_px4() {
        return finite(params);
    }
    params
        .iter()
        .filter(|param| !param.is_nan())
        .try_for_each(|param| finite(&[*param]))
}

pub(super) fn finite(values: &[f32]) -> Result<(), Text> {
    match values.iter().find(|value| !value.is_finite()) {
        None => Ok(()),
        Some(value) => Err(text!("refused-not-finite", value = value.to_string())),
    }
}
