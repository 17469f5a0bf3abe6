//! How long a vehicle has been armed on the ground: `ArduPilot` disarms it after `DISARM_DELAY`, without a text.

use std::ops::RangeInclusive;
use std::time::Duration;

use crate::vehicle::{IdleDisarm, Vehicle, VehicleClass};

/// `DISARM_DELAY` of `ArduCopter` in seconds, until the vehicle reports its own.
const USUAL_DELAY_S: f32 = 10.0;
/// The delays that `ArduCopter` can store, without 0 for never.
const DELAYS_S: RangeInclusive<f32> = 1.0..=127.0;
/// How much earlier and later than the delay a disarming may show: heartbeats arrive once a second.
const EARLIER: Duration = Duration::from_millis(1500);
const LATER: Duration = Duration::from_millis(2500);
/// The maximum time from the answer to a command to arm or disarm until the disarming that it
/// causes.
const BY_COMMAND: Duration = Duration::from_secs(2);

/// The time that an armed vehicle has spent on the ground, by its own clock.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct IdleWatch {
    since: Option<Duration>,
    has_flown: bool,
    /// When it last answered a command to arm or to disarm.
    answered: Option<Duration>,
    /// `DISARM_DELAY` in seconds, if it was heard.
    pub delay_s: Option<f32>,
}

impl IdleWatch {
    /// Notes the answer to a command to arm or to disarm.
    pub fn note_answer(&mut self, vehicle: &Vehicle, now: Duration) {
        self.answered = Some(clock(vehicle, now));
    }

    /// Notes a heartbeat, after it has been applied. Returns the cause if the vehicle has just disarmed by itself.
    pub fn note_heartbeat(&mut self, vehicle: &Vehicle, now: Duration) -> Option<IdleDisarm> {
        let at = clock(vehicle, now);
        if !vehicle.armed() {
            let ended = std::mem::take(&mut self.since)?;
            return self.cause(vehicle, ended, at);
        }
        if self.since.is_none() {
            self.has_flown = false;
        }
        if vehicle.airborne() {
            self.has_flown = true;
            self.since = Some(at);
        }
        self.since.get_or_insert(at);
        None
    }

    fn cause(&self, vehicle: &Vehicle, since: Duration, at: Duration) -> Option<IdleDisarm> {
        let is_copter = vehicle.mode()?.class == VehicleClass::Copter;
        let delay_s = self.delay_s.unwrap_or(USUAL_DELAY_S);
        if !is_copter || !DELAYS_S.contains(&delay_s) {
            return None;
        }
        let is_commanded = self
            .answered
            .is_some_and(|answered| at.saturating_sub(answered) <= BY_COMMAND);
        let (idle, delay) = (at.saturating_sub(since), Duration::from_secs_f32(delay_s));
        let is_due = idle + EARLIER >= delay && idle <= delay + LATER;
        (is_due && !is_commanded).then_some(IdleDisarm {
            has_flown: self.has_flown,
            delay_s: delay_s as u32,
        })
    }
}

/// The vehicle's own clock, which runs faster than the console's under a speed-up.
fn clock(vehicle: &Vehicle, now: Duration) -> Duration {
    vehicle.clock().unwrap_or(now)
}
