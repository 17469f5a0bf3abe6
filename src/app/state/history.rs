//! The vehicles' readings of the last ten minutes: a bounded ring per vehicle, sampled at a fixed
//! rate.

use std::collections::{BTreeMap, VecDeque};
use std::time::Duration;

use crate::vehicle::{Vehicle, VehicleId, Vehicles};

pub const SAMPLE_EVERY: Duration = Duration::from_millis(500);
/// The number of samples kept: ten minutes. At 14 bytes each, that is 16.8 kB per vehicle and 17 MB
/// for a thousand vehicles.
const SAMPLES_KEPT: usize = 1200;
const UNKNOWN: i16 = i16::MIN;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Channel {
    /// Height above home, in metres.
    Altitude,
    /// Speed over ground, in m/s.
    Speed,
    /// Vertical speed, in m/s, positive up.
    Climb,
    /// Voltage of the main pack, in volts.
    Voltage,
    /// Current of the main pack, in amperes.
    Current,
    /// Charge left in the main pack, in percent.
    Remaining,
    /// The throttle output, in percent.
    Throttle,
}

impl Channel {
    /// All channels, in display order.
    pub const ALL: [Self; 7] = [
        Self::Altitude,
        Self::Speed,
        Self::Climb,
        Self::Voltage,
        Self::Current,
        Self::Remaining,
        Self::Throttle,
    ];

    pub fn reading(self, vehicle: &Vehicle) -> Option<f32> {
        let pack = vehicle.battery();
        let value = match self {
            Self::Altitude => vehicle.altitude_m().map(|altitude| altitude as f32),
            Self::Speed => vehicle.ground_speed_m_s(),
            Self::Climb => vehicle
                .global
                .map(|global| -global.down_m_s)
                .or_else(|| vehicle.hud.map(|hud| hud.climb_m_s)),
            Self::Voltage => pack.and_then(|pack| pack.voltage_v),
            Self::Current => pack.and_then(|pack| pack.current_a),
            Self::Remaining => pack.and_then(|pack| pack.remaining_percent.map(f32::from)),
            Self::Throttle => vehicle.hud.map(|hud| f32::from(hud.throttle_percent)),
        };
        // Adding zero turns a rounded -0 into +0, so that the sign does not flicker.
        value
            .filter(|value| value.is_finite())
            .map(|value| value + 0.0)
    }

    /// Stored steps per unit: fine enough for display, coarse enough for the range of an i16.
    fn scale(self) -> f32 {
        match self {
            Self::Altitude | Self::Current => 10.0,
            Self::Speed | Self::Climb | Self::Voltage | Self::Remaining | Self::Throttle => 100.0,
        }
    }

    fn stored(self, vehicle: &Vehicle) -> i16 {
        self.reading(vehicle).map_or(UNKNOWN, |value| {
            // The cast saturates; the lowest number is reserved.
            ((value * self.scale()).round() as i16).max(UNKNOWN + 1)
        })
    }
}

/// The time span of a curve.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Window {
    /// The last 30 s.
    #[default]
    Short,
    /// The last 2 minutes.
    Middle,
    /// The last 10 minutes.
    Long,
}

impl Window {
    /// The next longer span; after the longest, the shortest.
    #[must_use]
    pub fn next(self) -> Self {
        match self {
            Self::Short => Self::Middle,
            Self::Middle => Self::Long,
            Self::Long => Self::Short,
        }
    }

    /// The length of the span in seconds.
    pub fn seconds(self) -> u16 {
        match self {
            Self::Short => 30,
            Self::Middle => 120,
            Self::Long => 600,
        }
    }

    /// The length of the span in samples.
    pub fn samples(self) -> usize {
        let per_second = 1000 / SAMPLE_EVERY.as_millis() as usize;
        usize::from(self.seconds()) * per_second
    }
}

/// The recorded readings of one vehicle.
#[derive(Debug, Clone)]
pub struct History {
    samples: VecDeque<[i16; Channel::ALL.len()]>,
    armed_for: Duration,
    is_armed: bool,
    reboots: u32,
}

impl History {
    fn new() -> Self {
        Self {
            samples: VecDeque::with_capacity(SAMPLES_KEPT),
            armed_for: Duration::ZERO,
            is_armed: false,
            reboots: 0,
        }
    }

    /// How long the vehicle has been armed, or was armed last, to half a second; times without
    /// contact are not counted. Zero if it has not been armed since it booted.
    pub fn armed_for(&self) -> Duration {
        self.armed_for
    }

    /// Counts one more armed sample; arming and booting reset the count.
    fn count(&mut self, vehicle: &Vehicle) {
        let is_armed = vehicle.armed();
        let is_rebooted = self.reboots != vehicle.link.reboots;
        if is_rebooted || (is_armed && !self.is_armed) {
            self.armed_for = Duration::ZERO;
        }
        if is_armed {
            self.armed_for += SAMPLE_EVERY;
        }
        (self.is_armed, self.reboots) = (is_armed, vehicle.link.reboots);
    }

    /// The readings of a channel within a span, oldest first, one per sample; `None` where unknown.
    /// There are fewer than the span holds if the vehicle was heard only recently.
    pub fn readings(
        &self,
        channel: Channel,
        window: Window,
    ) -> impl Iterator<Item = Option<f32>> + '_ {
        let first = self.samples.len().saturating_sub(window.samples());
        self.samples.range(first..).map(move |sample| {
            let stored = sample[channel as usize];
            (stored != UNKNOWN).then(|| f32::from(stored) / channel.scale())
        })
    }

    fn push(&mut self, sample: [i16; Channel::ALL.len()]) {
        if self.samples.len() == SAMPLES_KEPT {
            self.samples.pop_front();
        }
        self.samples.push_back(sample);
    }
}

/// The histories of all vehicles.
#[derive(Debug, Clone, Default)]
pub struct Histories {
    by_vehicle: BTreeMap<VehicleId, History>,
    sampled_at: Option<Duration>,
}

impl Histories {
    pub fn of(&self, vehicle: VehicleId) -> Option<&History> {
        self.by_vehicle.get(&vehicle)
    }

    /// Drops the samples of a vehicle.
    pub fn forget(&mut self, vehicle: VehicleId) {
        self.by_vehicle.remove(&vehicle);
    }

    /// Takes the samples due at `now`; returns whether there were any. Silent vehicles, and times without a call, are
    /// recorded as unknown.
    pub fn sample(&mut self, vehicles: &Vehicles, now: Duration) -> bool {
        let since = self.sampled_at.map(|at| now.saturating_sub(at));
        let steps = match since {
            None => 1,
            Some(since) => (since.as_millis() / SAMPLE_EVERY.as_millis()) as usize,
        };
        if steps == 0 {
            return false;
        }
        // Keep to the schedule, so that delays do not accumulate.
        let beat = self.sampled_at.unwrap_or(now) + SAMPLE_EVERY * steps as u32;
        self.sampled_at = Some(if since.is_none() { now } else { beat });
        for (&id, vehicle) in vehicles {
            let history = self.by_vehicle.entry(id).or_insert_with(History::new);
            if !history.samples.is_empty() {
                for _ in 0..(steps - 1).min(SAMPLES_KEPT) {
                    history.push([UNKNOWN; Channel::ALL.len()]);
                }
            }
            if vehicle.link.lost {
                history.push([UNKNOWN; Channel::ALL.len()]);
                continue;
            }
            history.push(Channel::ALL.map(|channel| channel.stored(vehicle)));
            history.count(vehicle);
        }
        true
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use std::sync::Arc;

    use super::*;
    use crate::vehicle::{Heartbeat, Hud, SystemStatus, VehicleClass};

    fn at_speed(speed_m_s: f32) -> Vehicles {
        let mut vehicle = Vehicle::new(1, 1);
        vehicle.hud = Some(Hud {
            airspeed_m_s: 0.0,
            ground_speed_m_s: speed_m_s,
            climb_m_s: 0.0,
            altitude_amsl_m: 0.0,
            throttle_percent: 0,
            heading_deg: 0.0,
            at: Duration::ZERO,
        });
        BTreeMap::from([(1, vehicle.into())])
    }

    fn speeds(histories: &Histories, window: Window) -> Vec<Option<f32>> {
        let history = histories.of(1).expect("a history");
        history.readings(Channel::Speed, window).collect()
    }

    #[test]
    fn samples_keep_the_beat_and_late_ones_leave_a_gap() {
        let mut histories = Histories::default();
        for (ms, due) in [
            (1000, true),
            (1100, false),
            (1600, true),
            (2000, true),
            (2499, false),
            (4000, true),
        ] {
            let now = Duration::from_millis(ms);
            assert_eq!(histories.sample(&at_speed(ms as f32 / 1000.0), now), due);
        }
        let expected = [Some(1.0), Some(1.6), Some(2.0), None, None, None, Some(4.0)];
        assert_eq!(speeds(&histories, Window::Short), expected);
    }

    #[test]
    fn a_lost_vehicle_and_what_is_no_number_read_nothing() {
        let mut histories = Histories::default();
        let mut vehicles = at_speed(3.0);
        histories.sample(&vehicles, Duration::ZERO);
        let vehicle = Arc::make_mut(vehicles.get_mut(&1).expect("it"));
        vehicle.link.lost = true;
        histories.sample(&vehicles, SAMPLE_EVERY);
        histories.sample(&at_speed(f32::NAN), SAMPLE_EVERY * 2);
        assert_eq!(speeds(&histories, Window::Long), [Some(3.0), None, None]);
        let history = histories.of(1).expect("a history");
        let mut volts = history.readings(Channel::Voltage, Window::Long);
        assert!(volts.all(|volt| volt.is_none()));
    }

    #[test]
    fn armed_time_is_that_of_the_last_flight_since_booting() {
        let mut histories = Histories::default();
        let mut vehicle = Vehicle::new(1, 1);
        for (step, (armed, reboots, expected_ms)) in [
            (false, 0, 0),
            (true, 0, 500),
            (true, 0, 1000),
            (false, 0, 1000),
            (true, 0, 500),
            (false, 1, 0),
            (true, 1, 500),
        ]
        .into_iter()
        .enumerate()
        {
            vehicle.heartbeat = Some(Heartbeat {
                mav_type: 2,
                autopilot: 3,
                class: VehicleClass::Copter,
                mode: VehicleClass::Copter.mode("GUIDED").expect("a mode"),
                armed,
                status: SystemStatus::Active,
                at: Duration::ZERO,
            });
            vehicle.link.reboots = reboots;
            let vehicles = BTreeMap::from([(1, Arc::new(vehicle.clone()))]);
            histories.sample(&vehicles, SAMPLE_EVERY * step as u32);
            let armed_for = histories.of(1).expect("a history").armed_for();
            assert_eq!(armed_for.as_millis(), expected_ms, "step {step}");
        }
    }

    proptest! {
        /// With any readings over any time, the ring is bounded and returns the newest readings of its span.
        #[test]
        fn a_ring_is_bounded_and_ends_with_the_newest(
            values in proptest::collection::vec(-300.0..300.0f32, 1..1500),
        ) {
            let mut histories = Histories::default();
            for (step, value) in values.iter().enumerate() {
                histories.sample(&at_speed(*value), SAMPLE_EVERY * step as u32);
            }
            for window in [Window::Short, Window::Middle, Window::Long] {
                let read = speeds(&histories, window);
                prop_assert_eq!(read.len(), values.len().min(window.samples()));
                for (read, value) in read.iter().rev().zip(values.iter().rev()) {
                    prop_assert!((read.expect("a reading") - value).abs() < 0.006);
                }
            }
            let history = histories.of(1).expect("a history");
            prop_assert_eq!(history.samples.capacity(), SAMPLES_KEPT);
        }
    }
}
