//! The messages of one serial port and their rates.

#![expect(
    deprecated,
    reason = "ground stations in use still ask for streams, which the dialect calls superseded"
)]

mod buckets;

use std::time::Duration;

use mavlink::MessageData as _;
use mavlink::dialects::ardupilotmega::{
    ADSB_VEHICLE_DATA, AHRS_DATA, AHRS2_DATA, ATTITUDE_DATA, BATTERY_STATUS_DATA,
    EKF_STATUS_REPORT_DATA, ESC_TELEMETRY_1_TO_4_DATA, FENCE_STATUS_DATA, GLOBAL_POSITION_INT_DATA,
    GPS_RAW_INT_DATA, HEARTBEAT_DATA, LOCAL_POSITION_NED_DATA, MEMINFO_DATA, MISSION_CURRENT_DATA,
    MavDataStream, NAV_CONTROLLER_OUTPUT_DATA, POSITION_TARGET_GLOBAL_INT_DATA, POWER_STATUS_DATA,
    RAW_IMU_DATA, RC_CHANNELS_DATA, SCALED_IMU2_DATA, SCALED_IMU3_DATA, SCALED_PRESSURE_DATA,
    SCALED_PRESSURE2_DATA, SERVO_OUTPUT_RAW_DATA, SIMSTATE_DATA, SYS_STATUS_DATA, SYSTEM_TIME_DATA,
    TERRAIN_REPORT_DATA, TERRAIN_REQUEST_DATA, VFR_HUD_DATA, VIBRATION_DATA, WIND_DATA,
};

use self::buckets::Buckets;
use super::Serial;
use super::parameters::Parameters;

/// `TERRAIN_REQUEST` and `TERRAIN_REPORT` are sent together.
pub(super) const TERRAIN_REQUEST: u32 = TERRAIN_REQUEST_DATA::ID;
pub(super) const TERRAIN_REPORT: u32 = TERRAIN_REPORT_DATA::ID;
/// The shortest and the longest interval, in milliseconds.
const SHORTEST_MS: i64 = 3;
const LONGEST_MS: i64 = 60_000;
/// The default stream of a new link: HEARTBEAT once per second.
const HEARTBEAT: u32 = HEARTBEAT_DATA::ID;
const HEARTBEAT_MS: u64 = 1000;
const TERRAIN_MS: u64 = 2000;
/// The vehicle looks for due messages several times in a step, at these times before its end, in
/// milliseconds.
const LOOKS_MS: [u64; 4] = [7, 5, 2, 0];

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
/// The stream of traffic, which has a parameter but no number: only a request for all streams
/// includes it.
const TRAFFIC: (&str, u32) = ("ADSB", ADSB_VEHICLE_DATA::ID);
const ALL_STREAMS: u8 = MavDataStream::MAV_DATA_STREAM_ALL as u8;

/// A message with a clock of its own.
#[derive(Debug, Clone, Copy)]
struct ScheduleEntry {
    id: u32,
    interval_ms: u64,
    next_ms: u64,
}

/// The intervals of one serial port.
#[derive(Debug, Clone)]
pub(super) struct Schedule {
    entries: Vec<ScheduleEntry>,
    buckets: Buckets,
    /// No message is due before this time.
    earliest_ms: u64,
}

impl Schedule {
    /// A schedule of heartbeats only.
    pub(super) fn new(now: Duration) -> Self {
        let mut schedule = Self {
            entries: Vec::new(),
            buckets: Buckets::default(),
            earliest_ms: u64::MAX,
        };
        // The first heartbeat does not wait, so that ground stations see the vehicle at once.
        schedule.entries.push(ScheduleEntry {
            id: HEARTBEAT,
            interval_ms: HEARTBEAT_MS,
            next_ms: now.as_millis() as u64,
        });
        schedule.earliest_ms = schedule.next_due_ms();
        schedule
    }

    /// The messages of a serial port after boot: heartbeats, and the streams of its `SRn_` parameters.
    pub(super) fn booted(serial: Serial, parameters: &Parameters, now: Duration) -> Self {
        let mut schedule = Self::new(now);
        for (group, name, _) in STREAMS {
            let rate_hz = parameters.value(&rate_name(serial, name));
            if rate_hz > 0.0 {
                schedule.set_stream(*group as u8, rate_hz as u16, now);
            }
        }
        let (name, id) = TRAFFIC;
        let rate_hz = parameters.value(&rate_name(serial, name));
        if rate_hz > 0.0 {
            schedule.set_ms(id, interval_ms(rate_hz as u16), now);
        }
        schedule
    }

    /// Handles the first client after a period without clients: each message is due at once, and
    /// only once.
    pub(super) fn resume(&mut self) {
        self.earliest_ms = 0;
    }

    /// Sets an interval in microseconds. -1 switches the message off; any other number that is too small (including
    /// negative ones) sets the shortest interval.
    pub(super) fn set(&mut self, id: u32, interval_us: i64, now: Duration) {
        let interval_ms = match interval_us {
            -1 => 0,
            us => (us / 1000).clamp(SHORTEST_MS, LONGEST_MS) as u64,
        };
        self.set_ms(id, interval_ms, now);
    }

    /// Sets the rate of the message's stream (`SRn_`), which is 0 for a message of no stream.
    pub(super) fn set_default(
        &mut self,
        id: u32,
        serial: Serial,
        parameters: &Parameters,
        now: Duration,
    ) {
        let of = STREAMS.iter().find(|(.., ids)| ids.contains(&id));
        let of_traffic = (id == TRAFFIC.1).then_some(TRAFFIC.0);
        let of_stream = of
            .map(|(_, name, _)| *name)
            .or(of_traffic)
            .map_or(0, |name| {
                interval_ms(parameters.value(&rate_name(serial, name)) as u16)
            });
        let default_ms = if id == HEARTBEAT {
            HEARTBEAT_MS
        } else {
            of_stream
        };
        self.set_ms(id, default_ms, now);
    }

    fn set_ms(&mut self, id: u32, interval_ms: u64, now: Duration) {
        let now_ms = now.as_millis() as u64;
        match id {
            HEARTBEAT => self.set_own(id, interval_ms, now_ms),
            TERRAIN_REQUEST => {
                // The report is sent every time, the request for data no more often than every 2 s.
                self.buckets.set(TERRAIN_REPORT, interval_ms, now_ms);
                let rare_ms = if interval_ms > 0 {
                    interval_ms.max(TERRAIN_MS)
                } else {
                    0
                };
                self.set_own(id, rare_ms, now_ms);
            }
            _ => self.buckets.set(id, interval_ms, now_ms),
        }
        self.earliest_ms = self.next_due_ms();
    }

    fn set_own(&mut self, id: u32, interval_ms: u64, now_ms: u64) {
        self.entries.retain(|entry| entry.id != id);
        if interval_ms > 0 {
            self.entries.push(ScheduleEntry {
                id,
                interval_ms,
                next_ms: now_ms + interval_ms,
            });
        }
    }

    fn next_due_ms(&self) -> u64 {
        let own = self.entries.iter().map(|entry| entry.next_ms).min();
        self.buckets.due_ms().min(own.unwrap_or(u64::MAX))
    }

    /// The interval of a message in microseconds, -1 when it is off.
    pub(super) fn interval_us(&self, id: u32) -> i64 {
        let own = self.entries.iter().find(|entry| entry.id == id);
        let interval_ms = match (id, own) {
            (TERRAIN_REQUEST, _) => self.buckets.interval_ms(TERRAIN_REPORT),
            (_, Some(entry)) => entry.interval_ms,
            (_, None) => self.buckets.interval_ms(id),
        };
        if interval_ms == 0 {
            -1
        } else {
            1000 * interval_ms as i64
        }
    }

    /// Sets a whole group, or all groups, to a rate; 0 Hz switches it off.
    pub(super) fn set_stream(&mut self, stream: u8, rate_hz: u16, now: Duration) {
        for (group, _, ids) in STREAMS {
            if stream == ALL_STREAMS || stream == *group as u8 {
                for &id in *ids {
                    self.set_ms(id, interval_ms(rate_hz), now);
                }
            }
        }
        if stream == ALL_STREAMS {
            self.set_ms(TRAFFIC.1, interval_ms(rate_hz), now);
        }
    }

    /// Calls `send` for every message that is due since the last step of 10 ms, as many times as it is due.
    pub(super) fn each_due(&mut self, now: Duration, mut send: impl FnMut(u32)) {
        let now_ms = now.as_millis() as u64;
        if now_ms < self.earliest_ms {
            return;
        }
        for early_ms in LOOKS_MS {
            self.look(now_ms.saturating_sub(early_ms), &mut send);
        }
        self.earliest_ms = self.next_due_ms();
    }

    fn look(&mut self, now_ms: u64, send: &mut impl FnMut(u32)) {
        for entry in &mut self.entries {
            if entry.next_ms > now_ms {
                continue;
            }
            send(entry.id);
            entry.next_ms += entry.interval_ms;
            if entry.next_ms < now_ms {
                entry.next_ms = now_ms + entry.interval_ms;
            }
        }
        self.buckets.each_due(now_ms, send);
    }
}

/// The parameters with the rates of a stream of `REQUEST_DATA_STREAM`.
pub(super) fn rate_names(serial: Serial, stream: u8) -> impl Iterator<Item = String> {
    let without_messages = [
        (MavDataStream::MAV_DATA_STREAM_RAW_CONTROLLER, "RAW_CTRL"),
        (MavDataStream::MAV_DATA_STREAM_ALL, TRAFFIC.0),
    ];
    let with_messages = STREAMS.iter().map(|(group, name, _)| (*group, *name));
    with_messages
        .chain(without_messages)
        .filter(move |(group, _)| stream == ALL_STREAMS || stream == *group as u8)
        .map(move |(_, name)| rate_name(serial, name))
}

fn rate_name(serial: Serial, stream: &str) -> String {
    format!("SR{}_{stream}", serial.index())
}

fn interval_ms(rate_hz: u16) -> u64 {
    1000_u64.checked_div(u64::from(rate_hz)).unwrap_or(0)
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
            (333_333, 333_000, 30),
            (100_000_000, 60_000_000, 0),
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
        schedule.set(HEARTBEAT, 500_000, Duration::ZERO);
        let mut parameters = Parameters::new(crate::VehicleKind::Copter, 1);
        parameters.set("SR1_EXTRA1", 4.0);
        for id in [HEARTBEAT, ATTITUDE_DATA::ID, VFR_HUD_DATA::ID] {
            schedule.set_default(id, Serial::One, &parameters, Duration::ZERO);
        }
        assert_eq!(schedule.interval_us(ATTITUDE_DATA::ID), 250_000);
        assert_eq!(schedule.interval_us(VFR_HUD_DATA::ID), -1);
        assert_eq!(schedule.interval_us(0), 1_000_000);
    }
    /// The times in milliseconds at which a message is sent within 4 s.
    fn times(schedule: &mut Schedule, id: u32, from_ms: u64) -> Vec<u64> {
        let mut times = Vec::new();
        for step in from_ms / 10..400 {
            schedule.each_due(Duration::from_millis(step * 10), |due| {
                if due == id {
                    times.push(step * 10);
                }
            });
        }
        times
    }

    #[test]
    fn a_message_comes_after_its_interval_and_with_others_of_the_same() {
        let mut schedule = Schedule::new(Duration::ZERO);
        schedule.set(ATTITUDE_DATA::ID, 1_000_000, Duration::ZERO);
        let mut early = schedule.clone();
        assert_eq!(
            times(&mut schedule, ATTITUDE_DATA::ID, 0),
            [1000, 2000, 3000]
        );
        // A message that is set later joins the others.
        assert!(times(&mut early, VFR_HUD_DATA::ID, 0).is_empty());
        let mut late = Schedule::new(Duration::ZERO);
        late.set(ATTITUDE_DATA::ID, 1_000_000, Duration::ZERO);
        late.set(VFR_HUD_DATA::ID, 1_000_000, Duration::from_millis(700));
        assert_eq!(times(&mut late, VFR_HUD_DATA::ID, 700), [2000, 3000]);
    }

    #[test]
    fn an_eleventh_interval_becomes_the_nearest() {
        let mut schedule = Schedule::new(Duration::ZERO);
        for id in 100..110 {
            let interval_us = i64::from(id - 99) * 100_000;
            schedule.set(id, interval_us, Duration::ZERO);
        }
        schedule.set(110, 440_000, Duration::ZERO);
        assert_eq!(schedule.interval_us(110), 400_000);
        schedule.set(109, -1, Duration::ZERO);
        schedule.set(110, 440_000, Duration::ZERO);
        assert_eq!(schedule.interval_us(110), 440_000);
    }
}
