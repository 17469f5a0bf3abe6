//! Reads commands, setpoints and parameter settings from frames, even where a field holds a number that has no name in
//! the dialect.

use glam::DVec3;
use mavlink::MessageData as _;
use mavlink::dialects::ardupilotmega::{
    COMMAND_INT_DATA, COMMAND_LONG_DATA, MavMessage, PARAM_SET_DATA, SET_ATTITUDE_TARGET_DATA,
    SET_POSITION_TARGET_GLOBAL_INT_DATA, SET_POSITION_TARGET_LOCAL_NED_DATA,
};

use crate::commands::Command;
use crate::guided::{AttitudeTarget, Setpoint, TargetPoint};
use crate::payload::Payload;
use sortie_geo::LatLon;
use sortie_wire::Content;

/// The ids of the messages that are read by hand.
const PARAM_SET: u32 = PARAM_SET_DATA::ID;
const COMMAND_INT: u32 = COMMAND_INT_DATA::ID;
const COMMAND_LONG: u32 = COMMAND_LONG_DATA::ID;
const ATTITUDE: u32 = SET_ATTITUDE_TARGET_DATA::ID;
const TARGET_LOCAL: u32 = SET_POSITION_TARGET_LOCAL_NED_DATA::ID;
const TARGET_GLOBAL: u32 = SET_POSITION_TARGET_GLOBAL_INT_DATA::ID;

/// A request, and the system that it is addressed to.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Addressed {
    pub(super) to: u8,
    pub(super) request: StationRequest,
}

/// A request to a vehicle.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum StationRequest {
    Command(Command),
    Setpoint(Setpoint),
    Attitude(AttitudeTarget),
    /// Base mode and custom mode of `SET_MODE`, which is not acknowledged.
    SetMode {
        base: u8,
        custom: u32,
    },
    SetParameter {
        name: String,
        value: f32,
    },
}

impl StationRequest {
    /// The request of a frame, if it carries one.
    #[expect(
        deprecated,
        reason = "ground stations in use still send what the dialect calls superseded"
    )]
    pub(super) fn read(content: &Content) -> Option<Addressed> {
        match content {
            Content::Message(MavMessage::COMMAND_LONG(data)) => Some(long(data)),
            Content::Message(MavMessage::COMMAND_INT(data)) => Some(int(data)),
            Content::Message(MavMessage::SET_POSITION_TARGET_LOCAL_NED(data)) => Some(local(data)),
            Content::Message(MavMessage::SET_POSITION_TARGET_GLOBAL_INT(data)) => {
                Some(global(data))
            }
            Content::Message(MavMessage::SET_ATTITUDE_TARGET(data)) => Some(attitude(data)),
            Content::Message(MavMessage::PARAM_SET(data)) => Some(parameter(data)),
            Content::Message(MavMessage::SET_MODE(data)) => Some(Addressed {
                to: data.target_system,
                request: StationRequest::SetMode {
                    base: data.base_mode.bits(),
                    custom: data.custom_mode,
                },
            }),
            Content::Message(_) | Content::Unknown { .. } => None,
            Content::Undecoded { id, payload } => by_hand(*id, &Payload::new(&payload[..])),
        }
    }
}

fn long(data: &COMMAND_LONG_DATA) -> Addressed {
    command(
        data.target_system,
        Command::from_long(
            data.command as u16,
            [data.param1, data.param2, data.param3, data.param4],
            [data.param5, data.param6, data.param7],
        ),
    )
}

fn int(data: &COMMAND_INT_DATA) -> Addressed {
    command(
        data.target_system,
        Command {
            number: data.command as u16,
            p: [data.param1, data.param2, data.param3, data.param4],
            x: data.x,
            y: data.y,
            z: data.z,
            frame: Some(data.frame as u8),
        },
    )
}

fn command(to: u8, command: Command) -> Addressed {
    Addressed {
        to,
        request: StationRequest::Command(command),
    }
}

fn local(data: &SET_POSITION_TARGET_LOCAL_NED_DATA) -> Addressed {
    Addressed {
        to: data.target_system,
        request: StationRequest::Setpoint(Setpoint {
            point: TargetPoint::Local(vector(data.x, data.y, data.z)),
            velocity_m_s: vector(data.vx, data.vy, data.vz),
            accel_m_s2: vector(data.afx, data.afy, data.afz),
            yaw_rad: f64::from(data.yaw),
            yaw_rate_rad_s: f64::from(data.yaw_rate),
            mask: data.type_mask.bits(),
            frame: data.coordinate_frame as u8,
        }),
    }
}

fn global(data: &SET_POSITION_TARGET_GLOBAL_INT_DATA) -> Addressed {
    Addressed {
        to: data.target_system,
        request: StationRequest::Setpoint(Setpoint {
            point: TargetPoint::Global {
                at: LatLon::from_e7(data.lat_int, data.lon_int),
                height_m: f64::from(data.alt),
            },
            velocity_m_s: vector(data.vx, data.vy, data.vz),
            accel_m_s2: vector(data.afx, data.afy, data.afz),
            yaw_rad: f64::from(data.yaw),
            yaw_rate_rad_s: f64::from(data.yaw_rate),
            mask: data.type_mask.bits(),
            frame: data.coordinate_frame as u8,
        }),
    }
}

fn attitude(data: &SET_ATTITUDE_TARGET_DATA) -> Addressed {
    Addressed {
        to: data.target_system,
        request: StationRequest::Attitude(AttitudeTarget {
            q: data.q,
            rates_rad_s: [
                data.body_roll_rate,
                data.body_pitch_rate,
                data.body_yaw_rate,
            ],
            thrust: data.thrust,
            mask: data.type_mask.bits(),
        }),
    }
}

fn parameter(data: &PARAM_SET_DATA) -> Addressed {
    Addressed {
        to: data.target_system,
        request: StationRequest::SetParameter {
            name: data.param_id.to_str().unwrap_or_default().to_owned(),
            value: data.param_value,
        },
    }
}

fn vector(x: f32, y: f32, z: f32) -> DVec3 {
    DVec3::new(f64::from(x), f64::from(y), f64::from(z))
}

/// A vector of three consecutive floats.
fn vector_at(payload: &Payload, at: usize) -> DVec3 {
    vector(
        payload.float(at),
        payload.float(at + 4),
        payload.float(at + 8),
    )
}

/// Reads a request field by field; the offsets are those of the `MAVLink` definitions after sorting
/// by field size.
fn by_hand(id: u32, payload: &Payload) -> Option<Addressed> {
    let (target_at, request) = match id {
        PARAM_SET => (4, parameter_by_hand(payload)),
        COMMAND_INT | COMMAND_LONG => (30, StationRequest::Command(command_by_hand(id, payload))),
        ATTITUDE => (36, StationRequest::Attitude(attitude_by_hand(payload))),
        TARGET_LOCAL | TARGET_GLOBAL => {
            (50, StationRequest::Setpoint(setpoint_by_hand(id, payload)))
        }
        _ => return None,
    };
    Some(Addressed {
        to: payload.byte(target_at),
        request,
    })
}

fn attitude_by_hand(payload: &Payload) -> AttitudeTarget {
    AttitudeTarget {
        q: [4, 8, 12, 16].map(|at| payload.float(at)),
        rates_rad_s: [20, 24, 28].map(|at| payload.float(at)),
        thrust: payload.float(32),
        mask: payload.byte(38),
    }
}

fn setpoint_by_hand(id: u32, payload: &Payload) -> Setpoint {
    let point = if id == TARGET_LOCAL {
        TargetPoint::Local(vector_at(payload, 4))
    } else {
        TargetPoint::Global {
            at: LatLon::from_e7(payload.integer(4), payload.integer(8)),
            height_m: f64::from(payload.float(12)),
        }
    };
    Setpoint {
        point,
        velocity_m_s: vector_at(payload, 16),
        accel_m_s2: vector_at(payload, 28),
        yaw_rad: f64::from(payload.float(40)),
        yaw_rate_rad_s: f64::from(payload.float(44)),
        mask: payload.short(48),
        frame: payload.byte(52),
    }
}

fn command_by_hand(id: u32, payload: &Payload) -> Command {
    let number = payload.short(28);
    let p = [0, 4, 8, 12].map(|at| payload.float(at));
    if id == COMMAND_INT {
        Command {
            number,
            p,
            x: payload.integer(16),
            y: payload.integer(20),
            z: payload.float(24),
            frame: Some(payload.byte(32)),
        }
    } else {
        Command::from_long(number, p, [16, 20, 24].map(|at| payload.float(at)))
    }
}

fn parameter_by_hand(payload: &Payload) -> StationRequest {
    let name: Vec<u8> = (6..22)
        .map(|at| payload.byte(at))
        .take_while(|byte| *byte != 0)
        .collect();
    StationRequest::SetParameter {
        name: String::from_utf8_lossy(&name).into_owned(),
        value: payload.float(0),
    }
}
