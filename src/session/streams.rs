//! Requests the telemetry for display, without competing with other ground stations for the rates.
//!
//! The messages that arrive are counted. A message that arrives often enough is left alone, even if
//! another station requested it. A message that arrives too rarely is requested, a few times at
//! most: if another ground station keeps changing the rate back, that station wins.

use std::collections::BTreeMap;
use std::time::Duration;

use mavlink::MessageData as _;
use mavlink::dialects::ardupilotmega::{
    ADSB_VEHICLE_DATA, ATTITUDE_DATA, AUTOPILOT_VERSION_DATA, BATTERY_STATUS_DATA,
    EKF_STATUS_REPORT_DATA, EXTENDED_SYS_STATE_DATA, FENCE_STATUS_DATA, GLOBAL_POSITION_INT_DATA,
    GPS_RAW_INT_DATA, HOME_POSITION_DATA, LOCAL_POSITION_NED_DATA, MISSION_CURRENT_DATA,
    POSITION_TARGET_GLOBAL_INT_DATA, RC_CHANNELS_DATA, SERVO_OUTPUT_RAW_DATA, SYS_STATUS_DATA,
    VFR_HUD_DATA, VIBRATION_DATA, WIND_DATA,
};

use crate::commands::{Answer, Command, QueryCommand};
use crate::vehicle::Vehicle;
use crate::wire::Outgoing;

/// A message and the rate at which it is needed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stream {
    pub message: u32,
    /// Wanted rate in Hz.
    pub rate_hz: f64,
}

const fn stream(message: u32, rate_hz: f64) -> Stream {
    Stream { message, rate_hz }
}

/// The console's messages and their rates.
pub const WANTED_STREAMS: &[Stream] = &[
    stream(GLOBAL_POSITION_INT_DATA::ID, 5.0),
    stream(ATTITUDE_DATA::ID, 5.0),
    stream(LOCAL_POSITION_NED_DATA::ID, 2.0),
    stream(VFR_HUD_DATA::ID, 2.0),
    stream(SYS_STATUS_DATA::ID, 1.0),
    stream(BATTERY_STATUS_DATA::ID, 1.0),
    stream(GPS_RAW_INT_DATA::ID, 1.0),
    stream(EKF_STATUS_REPORT_DATA::ID, 1.0),
    stream(EXTENDED_SYS_STATE_DATA::ID, 2.0),
    stream(POSITION_TARGET_GLOBAL_INT_DATA::ID, 1.0),
    stream(MISSION_CURRENT_DATA::ID, 1.0),
    stream(VIBRATION_DATA::ID, 0.5),
    stream(SERVO_OUTPUT_RAW_DATA::ID, 1.0),
    stream(RC_CHANNELS_DATA::ID, 1.0),
    stream(WIND_DATA::ID, 0.5),
    stream(FENCE_STATUS_DATA::ID, 0.5),
    // One aircraft at a time, and only if there is any: without, no message tells whether the request has arrived.
    stream(ADSB_VEHICLE_DATA::ID, 5.0),
];

const HOME_POSITION: u32 = HOME_POSITION_DATA::ID;
const AUTOPILOT_VERSION: u32 = AUTOPILOT_VERSION_DATA::ID;

/// The time over which rates are measured.
const WINDOW: Duration = Duration::from_secs(4);
/// The length of the first measurement: short, so that a new vehicle's telemetry appears soon.
const FIRST_LOOK: Duration = Duration::from_millis(150);
/// How many times a message is requested.
const TRIES: u32 = 3;
/// An unknown home is requested at growing intervals, up to this many windows. It is set when the position is found,
/// which may take long.
const HOME_EVERY: u32 = 16;
/// The share of the wanted rate that is sufficient.
const GOOD_ENOUGH: f64 = 0.7;

/// Monitors the message rates of one vehicle.
#[derive(Debug, Clone)]
pub(super) struct Streams {
    wanted: &'static [Stream],
    arrived: BTreeMap<u32, u32>,
    asked: BTreeMap<u32, u32>,
    /// The number of requests for each mode, by its index (0 for all modes), since `modes_monitor`
    /// last changed.
    modes_asked: BTreeMap<u8, u32>,
    modes_monitor: Option<u8>,
    window_start: Duration,
    next_look: Duration,
}

impl Streams {
    pub fn new(wanted: &'static [Stream], now: Duration) -> Self {
        Self {
            wanted,
            arrived: BTreeMap::new(),
            asked: BTreeMap::new(),
            modes_asked: BTreeMap::new(),
            modes_monitor: None,
            window_start: now,
            next_look: now + FIRST_LOOK,
        }
    }

    /// Starts again after a reconnection or a reboot, which may have reset the rates.
    pub fn forget(&mut self, now: Duration) {
        *self = Self::new(self.wanted, now);
    }

    /// Counts a received message.
    pub fn note(&mut self, message: u32) {
        *self.arrived.entry(message).or_default() += 1;
    }

    /// The requests that are due, each with the `MAV_CMD` of its acknowledgement.
    pub fn poll(&mut self, vehicle: &Vehicle, now: Duration) -> Vec<(Outgoing, u16)> {
        if now < self.next_look {
            return Vec::new();
        }
        let window_s = now.saturating_sub(self.window_start).as_secs_f64();
        let mut commands = Vec::new();
        for wanted in self.wanted {
            let arrived = self.arrived.get(&wanted.message).copied().unwrap_or(0);
            if f64::from(arrived) < wanted.rate_hz * window_s * GOOD_ENOUGH
                && self.may_ask(wanted.message)
            {
                commands.push(Command::Query(QueryCommand::Interval {
                    message: wanted.message,
                    rate_hz: wanted.rate_hz,
                }));
            }
        }
        for (known, message) in [
            (vehicle.version.is_some(), AUTOPILOT_VERSION),
            (vehicle.home.is_some(), HOME_POSITION),
        ] {
            if !known && self.may_ask(message) {
                commands.push(Command::Query(QueryCommand::Request { message }));
            }
        }
        commands.extend(self.modes_to_ask(vehicle).map(Command::Query));
        self.arrived.clear();
        self.window_start = now;
        self.next_look = now + WINDOW;
        let requests = commands
            .iter()
            .filter_map(|command| command.request(vehicle, 0).ok());
        requests
            .filter_map(|request| match request.answer {
                Answer::Ack(command) => Some((request.messages.into_iter().next()?, command)),
                Answer::Parameter(_) | Answer::None | Answer::NotAwaited(_) => None,
            })
            .collect()
    }

    /// The request for the vehicle's modes: a few times for all modes and for each mode that was
    /// lost, and again when they change. A vehicle that announces no modes refuses the request, and
    /// its modes keep the built-in names.
    fn modes_to_ask(&mut self, vehicle: &Vehicle) -> Option<QueryCommand> {
        let monitor = vehicle.modes.monitor();
        if self.modes_monitor != monitor {
            self.modes_asked.clear();
            self.modes_monitor = monitor;
        }
        let index = if vehicle.modes.is_empty() {
            0
        } else {
            vehicle.modes.missing()?
        };
        let asked = self.modes_asked.entry(index).or_default();
        *asked = asked.saturating_add(1);
        (*asked <= TRIES).then_some(QueryCommand::Modes { index })
    }

    fn may_ask(&mut self, message: u32) -> bool {
        let asked = self.asked.entry(message).or_default();
        *asked = asked.saturating_add(1);
        if message == HOME_POSITION {
            return asked.is_power_of_two() || asked.is_multiple_of(HOME_EVERY);
        }
        *asked <= TRIES
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use mavlink::dialects::ardupilotmega::MavMessage;

    #[test]
    fn a_home_that_stays_unknown_is_asked_for_ever_more_seldom_but_never_given_up() {
        let vehicle = Vehicle::new(1, 1);
        let mut streams = Streams::new(WANTED_STREAMS, Duration::ZERO);
        let is_for_home = |(message, _): &(Outgoing, u16)| match message {
            Outgoing::Message(MavMessage::COMMAND_LONG(long)) => {
                long.param1.to_bits() == 242f32.to_bits()
            }
            Outgoing::Message(MavMessage::COMMAND_INT(int)) => {
                int.param1.to_bits() == 242f32.to_bits()
            }
            Outgoing::Raw { payload, .. } => payload.starts_with(&242f32.to_le_bytes()),
            Outgoing::Message(_) => false,
        };
        let mut asked_at = Vec::new();
        for second in 1..3600 {
            let requests = streams.poll(&vehicle, Duration::from_secs(second));
            if requests.iter().any(is_for_home) {
                asked_at.push(second);
            }
        }
        let first_minute = asked_at.iter().filter(|at| **at <= 60).count();
        assert_eq!(first_minute, 4, "{asked_at:?}");
        let pauses: Vec<u64> = asked_at.windows(2).map(|pair| pair[1] - pair[0]).collect();
        assert!(
            pauses.is_sorted() && pauses.last() == Some(&64),
            "{pauses:?}"
        );
    }
}
