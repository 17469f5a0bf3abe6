//! Sessions against a scripted vehicle, with simulated time.

use std::time::Duration;

use mavlink::dialects::ardupilotmega::{
    COMMAND_ACK_DATA, COMMAND_LONG_DATA, HEARTBEAT_DATA, MavAutopilot, MavCmd, MavMessage,
    MavModeFlag, MavResult, MavSeverity, MavState, MavType, STATUSTEXT_DATA, TIMESYNC_DATA,
};

use super::*;
use crate::commands::{
    Act, ArmingCommand, Command, Destination, FlightCommand, Heading, MotionCommand,
    ParameterCommand, QueryCommand, Setup,
};
use crate::language;
use crate::ledger::{EntryId, Risk, RowState, RowUpdate};
use crate::vehicle::RadioPreset;
use crate::verb::{Retry, Verb};

mod download;
mod hearing;
mod logs;
mod metadata;
mod modes;
mod naming;
mod orders;
mod overtaken;
mod speeds;
mod stations;
mod targets;

const GUIDED: u32 = 4;
const STABILIZE: u32 = 0;

fn ms(milliseconds: u64) -> Duration {
    Duration::from_millis(milliseconds)
}

struct Scene {
    session: Session,
    now: Duration,
    sequence: u8,
    sent: Vec<Outgoing>,
    rows: Vec<RowUpdate>,
    notices: Vec<String>,
}

impl Scene {
    fn new() -> Self {
        let mut scene = Self {
            session: Session::new(3, 1, Duration::ZERO),
            now: Duration::ZERO,
            sequence: 0,
            sent: Vec::new(),
            rows: Vec::new(),
            notices: Vec::new(),
        };
        scene.heartbeat(STABILIZE, false);
        scene.rows.clear();
        scene
    }

    fn hear(&mut self, message: MavMessage) {
        self.hear_from(1, message);
    }

    fn hear_from(&mut self, component: u8, message: MavMessage) {
        let frame = Frame {
            system: 3,
            component,
            sequence: self.sequence,
            version: mavlink::MavlinkVersion::V2,
            seal: crate::wire::Seal::Unsigned,
            wire_len: 20,
            content: Content::Message(message),
        };
        self.sequence = self.sequence.wrapping_add(1);
        self.session.receive(&frame, self.now);
        self.collect();
    }

    fn heartbeat(&mut self, custom_mode: u32, armed: bool) {
        let armed_flag = if armed {
            MavModeFlag::MAV_MODE_FLAG_SAFETY_ARMED
        } else {
            MavModeFlag::empty()
        };
        self.hear(MavMessage::HEARTBEAT(HEARTBEAT_DATA {
            custom_mode,
            mavtype: MavType::MAV_TYPE_QUADROTOR,
            autopilot: MavAutopilot::MAV_AUTOPILOT_ARDUPILOTMEGA,
            base_mode: MavModeFlag::MAV_MODE_FLAG_CUSTOM_MODE_ENABLED | armed_flag,
            system_status: MavState::MAV_STATE_STANDBY,
            ..HEARTBEAT_DATA::DEFAULT
        }));
    }

    fn ack(&mut self, command: MavCmd, result: MavResult) {
        self.hear(MavMessage::COMMAND_ACK(COMMAND_ACK_DATA {
            command,
            result,
            target_system: 255,
            target_component: 190,
            ..COMMAND_ACK_DATA::DEFAULT
        }));
    }

    fn text(&mut self, text: &str) {
        self.hear(MavMessage::STATUSTEXT(STATUSTEXT_DATA {
            severity: MavSeverity::MAV_SEVERITY_CRITICAL,
            text: text.into(),
            ..STATUSTEXT_DATA::DEFAULT
        }));
    }

    fn pass(&mut self, time: Duration) {
        let until = self.now + time;
        while self.now < until {
            self.now += ms(10).min(until.saturating_sub(self.now));
            self.session.poll(self.now);
            self.collect();
        }
    }

    fn order(&mut self, entry: u32, verb: &'static str, command: Command) {
        let row = language::verb(verb).expect(verb);
        let verb = Box::leak(Box::new(Verb {
            retry: Retry::new(3, 1000, 3500),
            ..*row
        }));
        let order = VehicleCommand::new(EntryId(entry), verb, command);
        self.session.order(order, self.now);
        self.collect();
    }

    fn collect(&mut self) {
        self.sent.extend(self.session.take_outgoing());
        for report in self.session.take_reports() {
            match report {
                Report::Row(row) => self.rows.push(row),
                Report::Notice(notice) => self.notices.push(notice.text.to_string()),
                Report::Folder(_) => {}
            }
        }
    }

    fn longs(&self, command: MavCmd) -> Vec<&COMMAND_LONG_DATA> {
        self.sent
            .iter()
            .filter_map(|sent| match sent {
                Outgoing::Message(MavMessage::COMMAND_LONG(long)) if long.command == command => {
                    Some(long)
                }
                _ => None,
            })
            .collect()
    }

    fn states(&self, entry: u32) -> Vec<RowState> {
        self.rows
            .iter()
            .filter(|row| row.entry == EntryId(entry))
            .map(|row| row.state)
            .collect()
    }

    fn explanation(&self, entry: u32) -> String {
        self.rows
            .iter()
            .rev()
            .find(|row| row.entry == EntryId(entry) && row.explanation.is_some())
            .and_then(|row| row.explanation.as_ref())
            .map(ToString::to_string)
            .unwrap_or_default()
    }
}

const ARM: MavCmd = MavCmd::MAV_CMD_COMPONENT_ARM_DISARM;
