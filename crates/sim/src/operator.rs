//! Operator control: the ground station that may command a vehicle (`CONTROL_STATUS`,
//! `MAV_CMD_REQUEST_OPERATOR_CONTROL`). `ArduCopter` 4.6 lacks it, so vehicles have it only on request.

#![expect(
    deprecated,
    reason = "ground stations in use still send what the dialect calls superseded"
)]

use std::time::Duration;

use mavlink::MessageData as _;
use mavlink::dialects::ardupilotmega::{
    COMMAND_LONG_DATA, MISSION_ACK_DATA, MISSION_CLEAR_ALL_DATA, MISSION_COUNT_DATA,
    MISSION_SET_CURRENT_DATA, MISSION_WRITE_PARTIAL_LIST_DATA, MavMissionResult, MavResult,
    SET_HOME_POSITION_DATA, SETUP_SIGNING_DATA,
};
use sortie_wire::{CONTROL_STATUS, Frame, GROUND_STATION_COMPONENT, Outgoing};

use super::cmd;
use super::payload::Payload;

/// `MAV_CMD_REQUEST_OPERATOR_CONTROL`, which the dialect lacks.
pub(super) const REQUEST_CONTROL: u16 = 32100;
/// The time between two announcements.
const ANNOUNCED_EVERY: Duration = Duration::from_secs(1);
/// An owner without a heartbeat for this long has lost control, as with `FS_GCS_TIMEOUT`.
const OWNER_LOST_AFTER: Duration = Duration::from_secs(5);
/// The flags of `CONTROL_STATUS`.
const SYSTEM_MANAGER: u8 = 1;
const TAKEOVER_ALLOWED: u8 = 2;

/// The commands that change nothing, which every station may send.
const QUESTIONS: [u16; 7] = [
    cmd::REQUEST_MESSAGE,
    cmd::SET_MESSAGE_INTERVAL,
    cmd::GET_MESSAGE_INTERVAL,
    cmd::GET_HOME_POSITION,
    cmd::REQUEST_AUTOPILOT_CAPABILITIES,
    cmd::DO_SEND_BANNER,
    REQUEST_CONTROL,
];
/// The messages that begin a change to a list; they are answered by `MISSION_ACK`.
const LIST_CHANGES: [u32; 3] = [
    MISSION_COUNT_DATA::ID,
    MISSION_CLEAR_ALL_DATA::ID,
    MISSION_WRITE_PARTIAL_LIST_DATA::ID,
];
/// Other messages that change the vehicle; they are dropped.
const CHANGES: [u32; 3] = [
    SETUP_SIGNING_DATA::ID,
    MISSION_SET_CURRENT_DATA::ID,
    SET_HOME_POSITION_DATA::ID,
];

/// The owner of a vehicle, and its announcements.
#[derive(Debug, Clone, Default)]
pub(super) struct OperatorControl {
    /// The station in control; 0 for none.
    owner: u8,
    /// Whether another station may take control without asking.
    takeover: bool,
    /// When the owner was last heard.
    heard: Duration,
    announced: Option<Duration>,
    outbox: Vec<Outgoing>,
}

impl OperatorControl {
    /// Notes that a station was heard.
    pub(super) fn hear(&mut self, station: u8, now: Duration) {
        if station == self.owner {
            self.heard = now;
        }
    }

    /// Whether a station may change the vehicle: while no station is in control, any may.
    pub(super) fn admits(&self, station: u8) -> bool {
        self.owner == 0 || self.owner == station
    }

    /// Carries out a request for control, or its release. A request that needs the owner's permission fails, and the
    /// owner gets it.
    pub(super) fn request(&mut self, from: u8, params: [f32; 4]) -> MavResult {
        let [action, takeover, timeout_s, _] = params;
        if action < 0.5 {
            if self.owner != from {
                return MavResult::MAV_RESULT_FAILED;
            }
            self.set(0, false);
        } else if self.admits(from) || self.takeover {
            self.set(from, takeover > 0.5);
        } else {
            let asked = [1.0, takeover, timeout_s, f32::from(from), 0.0, 0.0, 0.0];
            self.ask_owner(&asked);
            return MavResult::MAV_RESULT_FAILED;
        }
        MavResult::MAV_RESULT_ACCEPTED
    }

    fn set(&mut self, owner: u8, takeover: bool) {
        (self.owner, self.takeover) = (owner, takeover);
        self.announced = None;
    }

    fn ask_owner(&mut self, params: &[f32; 7]) {
        let mut payload: Vec<u8> = params.iter().flat_map(|it| it.to_le_bytes()).collect();
        payload.extend_from_slice(&REQUEST_CONTROL.to_le_bytes());
        payload.extend_from_slice(&[self.owner, GROUND_STATION_COMPONENT, 0]);
        let id = COMMAND_LONG_DATA::ID;
        self.outbox.push(Outgoing::Raw { id, payload });
    }

    /// Releases control of an owner that is no longer heard, and returns the messages for all stations.
    pub(super) fn step(&mut self, now: Duration) -> Vec<Outgoing> {
        if self.announced.is_none() && self.owner != 0 {
            self.heard = self.heard.max(now);
        }
        if self.owner != 0 && now.saturating_sub(self.heard) > OWNER_LOST_AFTER {
            self.set(0, false);
        }
        if self.announced.is_none_or(|at| now >= at + ANNOUNCED_EVERY) {
            self.announced = Some(now);
            self.outbox.push(self.status());
        }
        std::mem::take(&mut self.outbox)
    }

    fn status(&self) -> Outgoing {
        let takeover = if self.takeover { TAKEOVER_ALLOWED } else { 0 };
        let mut payload = vec![0; 12];
        payload[..2].copy_from_slice(&[SYSTEM_MANAGER | takeover, self.owner]);
        Outgoing::Raw {
            id: CONTROL_STATUS,
            payload,
        }
    }
}

/// Whether a command only asks.
pub(super) fn is_question(number: u16) -> bool {
    QUESTIONS.contains(&number)
}

/// What happens to a message of a station that is not in control.
pub(super) enum Refusal {
    /// No refusal: the vehicle takes the message.
    None,
    /// The vehicle drops the message without an answer.
    Silent,
    /// The vehicle drops the message, and sends this answer.
    Answered(Box<Outgoing>),
}

/// The refusal of a message that is no command and changes the vehicle.
pub(super) fn refusal(frame: &Frame) -> Refusal {
    let id = frame.content.id();
    if CHANGES.contains(&id) {
        return Refusal::Silent;
    }
    let list = Payload::of(&frame.content).filter(|_| LIST_CHANGES.contains(&id));
    list.map_or(Refusal::None, |payload| {
        let kind_at = match id {
            MISSION_COUNT_DATA::ID => 4,
            MISSION_CLEAR_ALL_DATA::ID => 2,
            _ => 6,
        };
        let denied = MavMissionResult::MAV_MISSION_DENIED as u8;
        Refusal::Answered(Box::new(Outgoing::Raw {
            id: MISSION_ACK_DATA::ID,
            payload: vec![frame.system, frame.component, denied, payload.byte(kind_at)],
        }))
    })
}
