//! A flight as a ground station can observe it.

use mavlink::MessageData as _;
use mavlink::dialects::ardupilotmega::{
    COMMAND_ACK_DATA, HEARTBEAT_DATA, MavMessage, MavModeFlag, MavType,
};

use super::answers::Said;
use super::{Series, Timed};
use crate::geo::{LatLon, wrap_180};
use crate::sim::{Chassis, Start, VehicleKind};
use crate::vehicle::{Mode, VehicleClass};
use crate::wire::Content;

/// The parameter with the function of the first output, and its value for the motors of the left side.
const FIRST_OUTPUT: &str = "SERVO1_FUNCTION";
const LEFT_MOTORS: f32 = 73.0;

const COMMAND_ACK: u32 = COMMAND_ACK_DATA::ID;

/// The messages of one vehicle, sorted by subject. Times are seconds since the beginning of the recording.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Observed {
    /// Metres north, east and down of the origin.
    pub position_ned_m: Series<3>,
    /// Metres per second north, east and down.
    pub velocity_ned_m_s: Series<3>,
    /// Roll, pitch and yaw in degrees; the yaw continues beyond 360 instead of jumping.
    pub attitude_deg: Series<3>,
    pub voltage_v: Series<1>,
    /// Results of commands and of plan transfers.
    pub(super) acks: Vec<Said>,
    pub(super) texts: Vec<Said>,
    pub(super) modes: Vec<Said>,
    pub(super) reached: Vec<Said>,
    /// When the vehicle was armed (`true`) and disarmed.
    pub(super) armed: Vec<(f64, bool)>,
    /// Time, command and result of each ack, by number.
    pub(super) results: Vec<(f64, u16, u8)>,
    end_s: f64,
    origin: Option<(LatLon, f64)>,
    mode: Option<Mode>,
    vehicle_type: Option<MavType>,
    is_skid_steered: bool,
}

impl Observed {
    /// Sorts the frames of a vehicle.
    pub fn new(heard: &[Timed]) -> Self {
        let mut observed = Self::default();
        for Timed { at, frame } in heard {
            let at_s = at.as_secs_f64();
            observed.end_s = at_s;
            match &frame.content {
                Content::Message(message) => observed.note(at_s, message),
                Content::Undecoded { id, payload } if *id == COMMAND_ACK => {
                    let command = u16::from_le_bytes([payload[0], payload[1]]);
                    observed.note_result(at_s, command, payload[2], &command.to_string());
                }
                Content::Undecoded { .. } | Content::Unknown { .. } => {}
            }
        }
        observed
    }

    /// When the position became known; earlier messages belong to the boot.
    pub fn begin_s(&self) -> f64 {
        self.position_ned_m.first().map_or(0.0, |(at, _)| at)
    }

    /// The time of the last message.
    pub fn end_s(&self) -> f64 {
        self.end_s
    }

    /// The place where the vehicle was switched on, if it has reported its origin.
    pub fn start(&self) -> Option<Start> {
        let (at, altitude_amsl_m) = self.origin?;
        let heading = self.attitude_deg.at(self.begin_s()).map(|angles| angles[2]);
        Some(Start {
            at,
            altitude_amsl_m,
            heading_deg: heading.unwrap_or_default(),
        })
    }

    /// What the vehicle is: a copter, unless it reports another type. A rover with steered wheels and one that turns on
    /// the spot differ by the function of their first output.
    pub fn kind(&self) -> VehicleKind {
        match self.vehicle_type {
            Some(MavType::MAV_TYPE_SURFACE_BOAT) => VehicleKind::Rover(Chassis::Boat),
            Some(MavType::MAV_TYPE_GROUND_ROVER) if self.is_skid_steered => {
                VehicleKind::Rover(Chassis::Skid)
            }
            Some(MavType::MAV_TYPE_GROUND_ROVER) => VehicleKind::Rover(Chassis::Ackermann),
            _ => VehicleKind::Copter,
        }
    }

    /// The class that names the vehicle's modes.
    pub(super) fn class(&self) -> VehicleClass {
        self.vehicle_type.map_or(VehicleClass::Copter, |kind| {
            VehicleClass::from_mav_type(kind as u8)
        })
    }

    /// Whether the vehicle accepted a command sent at a time (true without an answer).
    pub(super) fn accepted(&self, command: u16, sent_s: f64) -> bool {
        self.results
            .iter()
            .find(|(at, about, _)| *about == command && *at >= sent_s)
            .is_none_or(|(_, _, result)| *result == 0)
    }

    fn note(&mut self, at_s: f64, message: &MavMessage) {
        match message {
            MavMessage::LOCAL_POSITION_NED(data) => {
                let position = [data.x, data.y, data.z].map(f64::from);
                let velocity = [data.vx, data.vy, data.vz].map(f64::from);
                self.position_ned_m.push(at_s, position);
                self.velocity_ned_m_s.push(at_s, velocity);
            }
            MavMessage::ATTITUDE(data) => {
                self.note_attitude(at_s, [data.roll, data.pitch, data.yaw]);
            }
            MavMessage::SYS_STATUS(data) if data.voltage_battery != u16::MAX => {
                self.voltage_v
                    .push(at_s, [f64::from(data.voltage_battery) / 1000.0]);
            }
            MavMessage::GPS_GLOBAL_ORIGIN(data) => {
                let at = LatLon::from_e7(data.latitude, data.longitude);
                self.origin
                    .get_or_insert((at, f64::from(data.altitude) / 1000.0));
            }
            MavMessage::HEARTBEAT(data) => {
                self.note_heartbeat(at_s, data);
            }
            MavMessage::PARAM_VALUE(data) if data.param_id.to_str() == Ok(FIRST_OUTPUT) => {
                self.is_skid_steered = data.param_value == LEFT_MOTORS;
            }
            _ => self.note_answer(at_s, message),
        }
    }

    fn note_answer(&mut self, at_s: f64, message: &MavMessage) {
        match message {
            MavMessage::COMMAND_ACK(data) => {
                let named = format!("{:?}", data.command);
                let name = named.trim_start_matches("MAV_CMD_");
                self.note_result(at_s, data.command as u16, data.result as u8, name);
            }
            MavMessage::MISSION_ACK(data) => {
                let text = format!("{:?} {:?}", data.mission_type, data.mavtype)
                    .replace("MAV_MISSION_TYPE_", "plan ")
                    .replace("MAV_MISSION_", "");
                self.acks.push(Said::new(at_s, text));
            }
            MavMessage::MISSION_ITEM_REACHED(data) => {
                self.reached.push(Said::new(at_s, data.seq.to_string()));
            }
            MavMessage::STATUSTEXT(data) => {
                let padded = String::from_utf8_lossy(&data.text[..]);
                let text = padded.trim_end_matches('\0');
                self.texts.push(Said::text(at_s, data.severity as u8, text));
            }
            _ => {}
        }
    }

    fn note_attitude(&mut self, at_s: f64, angles_rad: [f32; 3]) {
        let [roll, pitch, yaw] = angles_rad.map(|angle| f64::from(angle).to_degrees());
        let yaw = match self.attitude_deg.last() {
            Some((_, [_, _, last])) => last + wrap_180(yaw - last),
            None => yaw,
        };
        self.attitude_deg.push(at_s, [roll, pitch, yaw]);
    }

    fn note_result(&mut self, at_s: f64, command: u16, result: u8, name: &str) {
        const RESULTS: [&str; 5] = [
            "ACCEPTED",
            "TEMPORARILY_REJECTED",
            "DENIED",
            "UNSUPPORTED",
            "FAILED",
        ];
        let word = RESULTS
            .get(usize::from(result))
            .unwrap_or(&"another result");
        self.results.push((at_s, command, result));
        self.acks.push(Said::new(at_s, format!("{name} {word}")));
    }

    fn note_heartbeat(&mut self, at_s: f64, data: &HEARTBEAT_DATA) {
        self.vehicle_type.get_or_insert(data.mavtype);
        let mode = Mode {
            class: self.class(),
            number: data.custom_mode,
        };
        if self.mode != Some(mode) {
            self.mode = Some(mode);
            self.modes.push(Said::new(at_s, mode.to_string()));
        }
        let armed = data
            .base_mode
            .contains(MavModeFlag::MAV_MODE_FLAG_SAFETY_ARMED);
        if self.armed.last().is_none_or(|(_, last)| *last != armed) {
            self.armed.push((at_s, armed));
        }
    }
}
