//! The GPS receiver's reports: samples at its rate, with a delay.

use std::time::Duration;

use glam::DVec3;
use mavlink::dialects::ardupilotmega::GpsFixType;

use super::faults::{GpsFault, GpsUnused};
use sortie_geo::METRES_PER_DEGREE;
use sortie_geo::maths;

const SATELLITES_WITHOUT_FIX: u8 = 3;
const FIXED: GpsFixType = GpsFixType::GPS_FIX_TYPE_RTK_FIXED;
const NO_FIX: GpsFixType = GpsFixType::GPS_FIX_TYPE_NO_FIX;
/// The jumps of a jammed receiver's position and velocity.
const JAM_LEAP_M: f64 = 200.0;
const JAM_SPEED_M_S: f64 = 400.0;
/// The initial silence of a jammed receiver, in seconds.
const JAM_SILENCE_S: (f64, f64) = (1.0, 6.0);

/// One report of the receiver, as the difference from the truth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Fix {
    pub(crate) kind: GpsFixType,
    pub(crate) satellites: u8,
    /// Metres north, east and down.
    pub(crate) offset_m: DVec3,
    /// Metres per second north, east and down.
    pub(crate) velocity_offset_m_s: DVec3,
}

impl Fix {
    /// Whether there is a position.
    pub(crate) fn is_locked(&self) -> bool {
        self.kind as u8 >= GpsFixType::GPS_FIX_TYPE_3D_FIX as u8
    }
}

/// A receiver, with the reports that have not arrived yet.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Receiver {
    pub(super) fix: Fix,
    under_way: Option<(Duration, Fix)>,
    seed: u64,
    jammed_since: Option<Duration>,
    jam_m: DVec3,
}

impl Receiver {
    pub(super) fn new(seed: u64) -> Self {
        Self {
            fix: Fix {
                kind: FIXED,
                satellites: 10,
                offset_m: DVec3::ZERO,
                velocity_offset_m_s: DVec3::ZERO,
            },
            under_way: None,
            seed,
            jammed_since: None,
            jam_m: DVec3::ZERO,
        }
    }

    /// The arrival time of the last report taken before `now`; it may be in the future.
    pub(super) fn last_arrival(now: Duration, fault: &GpsFault) -> Duration {
        let periods = now.as_micros() / fault.period.as_micros().max(1);
        let taken = fault.period * u32::try_from(periods).unwrap_or(u32::MAX);
        taken + fault.lag
    }

    /// Takes a sample when due; returns whether a report arrived in this step.
    pub(super) fn step(&mut self, now: Duration, latitude_deg: f64, fault: &GpsFault) -> bool {
        let arrived = match self.under_way {
            Some((due, fix)) if now >= due => {
                self.fix = fix;
                self.under_way = None;
                true
            }
            _ => false,
        };
        let period_us = fault.period.as_micros().max(1);
        if now.as_micros() % period_us < 10_000 {
            let sample = self.sample(now, latitude_deg, fault);
            self.under_way = Some((now + fault.lag, sample));
        }
        arrived
    }

    fn sample(&mut self, now: Duration, latitude_deg: f64, fault: &GpsFault) -> Fix {
        let east_m = METRES_PER_DEGREE * maths::cos(latitude_deg.to_radians());
        let noise_m = fault.altitude_noise_m * self.random();
        let up_m = fault.glitch.z + fault.altitude_offset_m + noise_m;
        let mut fix = Fix {
            kind: FIXED,
            satellites: fault.satellites,
            offset_m: DVec3::new(
                fault.glitch.x * METRES_PER_DEGREE,
                fault.glitch.y * east_m,
                -up_m,
            ),
            velocity_offset_m_s: DVec3::ZERO,
        };
        if fault.jammed {
            self.jam(now, &mut fix);
        } else {
            self.jammed_since = None;
            self.jam_m = DVec3::ZERO;
        }
        if fault.disabled || now < fault.lock_after {
            fix.kind = NO_FIX;
        }
        match fault.unused {
            Some(GpsUnused::Absent) => {
                (fix.kind, fix.satellites) = (GpsFixType::GPS_FIX_TYPE_NO_GPS, 0);
            }
            Some(GpsUnused::SwitchedOff) => {}
            None if fix.is_locked() => {}
            None => fix.satellites = SATELLITES_WITHOUT_FIX,
        }
        fix
    }

    /// Jams the receiver: after a silence the fix comes and goes, and position and speed jump.
    fn jam(&mut self, now: Duration, fix: &mut Fix) {
        let since = *self.jammed_since.get_or_insert(now);
        let (least, most) = JAM_SILENCE_S;
        let silence = Duration::from_secs_f64(least + self.random().abs() * (most - least));
        if now < since + silence {
            fix.kind = NO_FIX;
            return;
        }
        if self.random() < -0.6 {
            let leap = DVec3::new(self.random(), self.random(), 0.0);
            self.jam_m += leap * JAM_LEAP_M;
        }
        fix.offset_m += self.jam_m;
        fix.velocity_offset_m_s =
            DVec3::new(self.random(), self.random(), self.random()) * JAM_SPEED_M_S;
        fix.satellites = 2 + ((self.random() + 1.0) * 7.0) as u8;
        if fix.satellites < 4 || self.random() < 0.0 {
            fix.kind = NO_FIX;
        }
    }

    /// The next pseudo-random number, from -1 to 1 (splitmix64).
    pub(super) fn random(&mut self) -> f64 {
        self.seed = self.seed.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.seed;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^= z >> 31;
        (z >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
}
