//! The messages of one serial port and their rates.

#![expect(
    deprecated,
    reason = "ground stations in use still ask for streams, which the dialect calls superseded"
)]

use std::time::Duration;

use mavlink::MessageData as _;
use mavlink::dialects::ardupilotmega::{
    AHRS_DATA, AHRS2_DATA, ATTITUDE_DATA, BATTERY_STATUS_DATA, EKF_STATUS_REPORT_DATA,
    ESC_TELEMETRY_1_TO_4_DATA, FENCE_STATUS_DATA, GLOBAL_POSITION_INT_DATA, GPS_RAW_INT_DATA,
    HEARTBEAT_DATA, LOCAL_POSITION_NED_DATA, MEMINFO_DATA, MISSION_CURRENT_DATA, MavDataStream,
    NAV_CONTROLLER_OUTPUT_DATA, POSITION_TARGET_GLOBAL_INT_DATA, POWER_STATUS_DATA, RAW_IMU_DATA,
    RC_CHANNELS_DATA, SCALED_IMU2_DATA, SCALED_IMU3_DATA, SCALED_PRESSURE_DATA,
    SCALED_PRESSURE2_DATA, SERVO_OUTPUT_RAW_DATA, SIMSTATE_DATA, SYS_STATUS_DATA, SYSTEM_TIME_DATA,
    TERRAIN_REPORT_DATA, TERRAIN_REQUEST_DATA, VFR_HUD_DATA, VIBRATION_DATA, WIND_DATA,
};

use super::Serial;
use super::parameters::Parameters;

/// `TERRAIN_REQUEST` and `TERRAIN_REPORT` are sent together.
pub(super) const TERRAIN_REQUEST: u32 = TERRAIN_REQUEST_DATA::ID;
pub(super) const TERRAIN_REPORT: u32 = TERRAIN_REPORT_DATA::ID;
/// The shortest interval; shorter ones are lengthened to it, as the vehicle does.
const SHORTEST_US: i64 = 3_000;
/// The default stream of a new link: HEARTBEAT once per second.
const HEARTBEAT: u32 = HEARTBEAT_DATA::ID;
const HEARTBEAT_US: i64 = 1_000_000;
const TERRAIN_US: i64 = 2_000_000;
/// Messages that are this many intervals late are skipped.
const LATE_INTERVALS: u64 = 4;

/// The stream groups of `REQUEST_DATA_STREAM`: for each, the suffix of its parameter's name, and its messages.
const STREAMS: &[(MavDataStream, &str, &[u32])] = &[
    (
        MavDataStream::MAV_DATA_STREAM_RAW_SENSORS,
        "RAW_SENS",
        &[
            RAW_IMU_DATA::ID,
            SCALED_IMU2_DATA::ID,
            SCALED_IMU3_DATA::ID,
            SCALED_PRESSURE_DATA::ID,
            SCALED_PRESSURE2_DATA::ID,
        ],
    ),
    (
        MavDataStream::MAV_DATA_STREAM_EXTENDED_STATUS,
        "EXT_STAT",
        &[
            SYS_STATUS_DATA::ID,
            POWER_STATUS_DATA::ID,
            MEMINFO_DATA::ID,
            MISSION_CURRENT_DATA::ID,
            GPS_RAW_INT_DATA::ID,
            NAV_CONTROLLER_OUTPUT_DATA::ID,
            POSITION_TARGET_GLOBAL_INT_DATA::ID,
            FENCE_STATUS_DATA::ID,
        ],
    ),
    (
        MavDataStream::MAV_DATA_STREAM_RC_CHANNELS,
        "RC_CHAN",
        &[SERVO_OUTPUT_RAW_DATA::ID, RC_CHANNELS_DATA::ID],
    ),
    (
        MavDataStream::MAV_DATA_STREAM_POSITION,
        "POSITION",
        &[LOCAL_POSITION_NED_DATA::ID, GLOBAL_POSITION_INT_DATA::ID],
    ),
    (
        MavDataStream::MAV_DATA_STREAM_EXTRA1,
        "EXTRA1",
        &[ATTITUDE_DATA::ID, SIMSTATE_DATA::ID, AHRS2_DATA::ID],
    ),
    (
        MavDataStream::MAV_DATA_STREAM_EXTRA2,
        "EXTRA2",
        &[VFR_HUD_DATA::ID],
    ),
    (
        MavDataStream::MAV_DATA_STREAM_EXTRA3,
        "EXTRA3",
        &[
            SYSTEM_TIME_DATA::ID,
            BATTERY_STATUS_DATA::ID,
            AHRS_DATA::ID,
            WIND_DATA::ID,
            EKF_STATUS_REPORT_DATA::ID,
            VIBRATION_DATA::ID,
            TERRAIN_REQUEST,
            ESC_TELEMETRY_1_TO_4_DATA::ID,
        ],
    ),
];
/// The group that means all groups.
const ALL_STREAMS: u8 = MavDataStream::MAV_DATA_STREAM_ALL as u8;

#[derive(Debug, Clone, Copy)]
struct ScheduleEntry {
    id: u32,
    interval_us: u64,
    next_us: u64,
}

/// The intervals of one serial port.
#[derive(Debug, Clone)]
pub(super) struct Schedule {
    entries: Vec<ScheduleEntry>,
    /// No message is due before this time, in microseconds.
    earliest_us: u64,
}

impl Schedule {
    /// A schedule of heartbeats only.
    pub(super) fn new(now: Duration) -> Self {
        let mut schedule = Self {
            entries: Vec::new(),
            earliest_us: u64::MAX,
        };
        schedule.set(HEARTBEAT, HEARTBEAT_US, now);
        schedule
    }

    /// The messages of a serial port after boot: heartbeats, and the streams of its `SRn_` parameters.
    pub(super) fn booted(serial: Serial, parameters: &Parameters, now: Duration) -> Self {
        let mut schedule = Self::new(now);
        for (group, name, _) in STREAMS {
            let rate_hz = parameters.value(&format!("SR{}_{name}", serial.index()));
            if rate_hz > 0.0 {
                schedule.set_stream(*group as u8, rate_hz as u16, now);
            }
        }
        schedule
    }

    /// Handles the first client after a time without clients: each message is due at once, and only once.
    pub(super) fn resume(&mut self, now: Duration) {
        let now_us = now.as_micros() as u64;
        for entry in &mut self.entries {
            entry.next_us = entry.next_us.max(now_us);
        }
        self.earliest_us = now_us;
    }

    /// Sets an interval in microseconds. 0 and -1 switch the message off; any other number that is too small
    /// (including negative ones) sets the shortest interval.
    pub(super) fn set(&mut self, id: u32, interval_us: i64, now: Duration) {
        if id == TERRAIN_REQUEST {
            // The report is sent every time, the request for data no more often than every 2 s.
            self.set(TERRAIN_REPORT, interval_us, now);
            let on = interval_us != 0 && interval_us != -1;
            let rare_us = if on { interval_us.max(TERRAIN_US) } else { 0 };
            return self.set_one(TERRAIN_REQUEST, rare_us, now);
        }
        self.set_one(id, interval_us, now);
    }

    fn set_one(&mut self, id: u32, interval_us: i64, now: Duration) {
        self.entries.retain(|entry| entry.id != id);
        if interval_us != 0 && interval_us != -1 {
            let now_us = now.as_micros() as u64;
            self.entries.push(ScheduleEntry {
                id,
                interval_us: interval_us.max(SHORTEST_US) as u64,
                next_us: now_us,
            });
            self.earliest_us = self.earliest_us.min(now_us);
        }
    }

    /// The interval of a message in microseconds, -1 when it is off.
    pub(super) fn interval_us(&self, id: u32) -> i64 {
        let id = if id == TERRAIN_REQUEST {
            TERRAIN_REPORT
        } else {
            id
        };
        self.entries
            .iter()
            .find(|entry| entry.id == id)
            .map_or(-1, |entry| entry.interval_us as i64)
    }

    /// Sets a whole group, or all groups, to a rate; 0 Hz switches it off.
    pub(super) fn set_stream(&mut self, stream: u8, rate_hz: u16, now: Duration) {
        let interval_us = match rate_hz {
            0 => 0,
            rate => 1_000_000 / i64::from(rate),
        };
        for (group, _, ids) in STREAMS {
            if stream == ALL_STREAMS || stream == *group as u8 {
                for &id in *ids {
                    self.set(id, interval_us, now);
                }
            }
        }
    }

    /// Calls `send` for every message that is due, as many times as it is due.
    pub(super) fn each_due(&mut self, now: Duration, mut send: impl FnMut(u32)) {
        let now_us = now.as_micros() as u64;
        if now_us < self.earliest_us {
            return;
        }
        let mut earliest_us = u64::MAX;
        for entry in &mut self.entries {
            if entry.next_us + LATE_INTERVALS * entry.interval_us < now_us {
                entry.next_us = now_us;
            }
            while entry.next_us <= now_us {
                send(entry.id);
                entry.next_us += entry.interval_us;
            }
            earliest_us = earliest_us.min(entry.next_us);
        }
        self.earliest_us = earliest_us;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn count(schedule: &mut Schedule, id: u32, seconds: u64) -> usize {
        let mut sent = 0;
        for step in 0..seconds * 100 {
            schedule.each_due(Duration::from_millis(step * 10), |due| {
                sent += usize::from(due == id);
            });
        }
        sent
    }

    #[test]
    fn intervals_follow_the_vehicles_quirks() {
        for (asked_us, kept_us, per_10_s) in [
            (100_000, 100_000, 100),
            (1_000, 3_000, 3_331),
            (-5, 3_000, 3_331),
            (0, -1, 0),
            (-1, -1, 0),
        ] {
            let mut schedule = Schedule::new(Duration::ZERO);
            schedule.set(ATTITUDE_DATA::ID, asked_us, Duration::ZERO);
            assert_eq!(
                schedule.interval_us(ATTITUDE_DATA::ID),
                kept_us,
                "{asked_us}"
            );
            let sent = count(&mut schedule, ATTITUDE_DATA::ID, 10);
            assert!(sent.abs_diff(per_10_s) <= 2, "{asked_us}: {sent}");
        }
    }

    #[test]
    fn a_stream_sets_its_messages_and_only_those() {
        let mut schedule = Schedule::new(Duration::ZERO);
        schedule.set_stream(6, 4, Duration::ZERO);
        assert_eq!(schedule.interval_us(GLOBAL_POSITION_INT_DATA::ID), 250_000);
        assert_eq!(schedule.interval_us(ATTITUDE_DATA::ID), -1);
        schedule.set_stream(0, 0, Duration::ZERO);
        assert_eq!(schedule.interval_us(GLOBAL_POSITION_INT_DATA::ID), -1);
        assert_eq!(schedule.interval_us(0), 1_000_000);
    }
}
