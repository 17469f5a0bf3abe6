//! Texts and actions of a vehicle, with their times.

use mavlink::dialects::ardupilotmega::{MavCmd, MavMessage};

use super::super::*;
use super::Ground;
use sortie_geo::LatLon;

/// Health bits that belong to sensors and failsafes: without logging, terrain, proximity and fence.
const JUDGED: u32 = !0x0550_0000;

/// A vehicle under observation. Each line is a change: of a text, a mode, an estimator flag, a GPS fix.
pub(crate) struct Timeline {
    pub(crate) ground: Ground,
    /// Seconds since the last [`Timeline::mark`], and the change.
    pub(crate) lines: Vec<(f64, String)>,
    /// Whether the ground station sends heartbeats.
    pub(crate) beats: bool,
    seen: usize,
    steps: u32,
    last: [String; 4],
}

impl Timeline {
    pub(crate) fn of(mut ground: Ground) -> Self {
        for id in [1.0, 24.0, 193.0] {
            ground.long(MavCmd::MAV_CMD_SET_MESSAGE_INTERVAL, [id, 100_000.0]);
        }
        let seen = ground.heard.len();
        let mut timeline = Self {
            ground,
            lines: Vec::new(),
            beats: true,
            seen,
            steps: 0,
            last: Default::default(),
        };
        timeline.run(0.5);
        timeline.mark();
        timeline
    }

    pub(crate) fn mark(&mut self) {
        self.lines.clear();
        self.steps = 0;
    }

    pub(crate) fn run(&mut self, seconds: f64) {
        for _ in 0..(seconds * 100.0).round() as usize {
            if self.beats && self.steps.is_multiple_of(100) {
                self.ground.heartbeat();
            }
            self.ground.step();
            self.steps += 1;
            self.listen();
        }
    }

    fn listen(&mut self) {
        let now_s = f64::from(self.steps) * 0.01;
        for message in self.ground.messages_since(self.seen) {
            let (kind, line) = match message {
                MavMessage::STATUSTEXT(data) => {
                    let text = data.text.to_str().unwrap_or("?").to_owned();
                    self.lines.push((now_s, text));
                    continue;
                }
                MavMessage::HEARTBEAT(data) => (
                    0,
                    format!(
                        "mode {} status {}",
                        data.custom_mode, data.system_status as u8
                    ),
                ),
                MavMessage::EKF_STATUS_REPORT(data) => {
                    (1, format!("flags {:04x}", data.flags.bits()))
                }
                MavMessage::GPS_RAW_INT(data) => (
                    2,
                    format!("fix {} {}", data.fix_type as u8, data.satellites_visible),
                ),
                MavMessage::SYS_STATUS(data) => (
                    3,
                    format!(
                        "health {:08x}",
                        data.onboard_control_sensors_health.bits() & JUDGED
                    ),
                ),
                _ => continue,
            };
            if self.last[kind] != line {
                self.last[kind].clone_from(&line);
                self.lines.push((now_s, line));
            }
        }
        self.seen = self.ground.heard.len();
    }

    /// Checks that every line of a table appears, in this order, within the tolerance in seconds.
    pub(crate) fn must_say(&self, tolerance_s: f64, table: &[(f64, &str)]) {
        let mut from = 0;
        for (at_s, line) in table {
            let found = self.lines[from..]
                .iter()
                .position(|(t, said)| said.contains(line) && (t - at_s).abs() <= tolerance_s);
            let Some(found) = found else {
                panic!("`{line}` not at {at_s} s: {:#?}", self.lines);
            };
            from += found + 1;
        }
    }

    /// Checks that none of these lines has appeared.
    pub(crate) fn must_not_say(&self, forbidden: &[&str]) {
        for (t, line) in &self.lines {
            let bad = forbidden.iter().any(|text| line.contains(text));
            assert!(!bad, "{t} s: {line}");
        }
    }

    /// Requests a message and returns the vehicle's answer.
    pub(crate) fn asked(&mut self, id: u32) -> Option<MavMessage> {
        let before = self.ground.heard.len();
        self.ground
            .long(MavCmd::MAV_CMD_REQUEST_MESSAGE, [id as f32]);
        let answers = self.ground.messages_since(before);
        self.seen = self.ground.heard.len();
        answers
            .into_iter()
            .find(|message| mavlink::Message::message_id(message) == id)
    }

    /// The error of the vehicle's estimated position, in metres north and east.
    pub(crate) fn error_m(&mut self) -> (f64, f64) {
        let truth = self.ground.truth();
        let Some(MavMessage::GLOBAL_POSITION_INT(data)) = self.asked(33) else {
            panic!("no position");
        };
        let believed = LatLon::from_e7(data.lat, data.lon);
        truth.at.offset_to(believed)
    }
}
