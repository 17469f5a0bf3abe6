//! ADS-B: simulated aircraft around the vehicle, and the receiver that reports them.
//!
//! As in SITL, the sky exists if `SIM_ADSB_COUNT` is not negative at boot; the receiver works with `ADSB_TYPE` 1
//! (uAvionix over MAVLink). Source: `SIM_ADSB.cpp` and `AP_ADSB.cpp` of ArduPilot 4.6-dev.

mod receiver;
mod sky;

use std::time::Duration;

use glam::DVec3;
use mavlink::dialects::ardupilotmega::ADSB_VEHICLE_DATA;

use self::receiver::Receiver;
use self::sky::Sky;
use super::Serial;
use super::parameters::Parameters;
use super::place::{LocalDatum, Place};

/// The number of steps between two moves of the sky; together they take 0.1 s.
pub(super) const EVERY_STEPS: u64 = 10;
/// `ADSB_TYPE` of the receiver that SITL simulates.
const SIMULATED_TYPE: f64 = 1.0;

/// The aircraft around one vehicle, and its receiver.
#[derive(Debug, Clone)]
pub(super) struct Adsb {
    sky: Sky,
    receiver: Receiver,
    /// Whether the missing receiver has been reported.
    has_failed: bool,
}

impl Adsb {
    /// The sky of a vehicle with this board id; `None` if the sky is switched off at boot.
    pub(super) fn booted(count: f64, board_id: u64) -> Option<Box<Self>> {
        (count >= 0.0).then(|| {
            Box::new(Self {
                sky: Sky::new(board_id),
                receiver: Receiver::default(),
                has_failed: false,
            })
        })
    }

    /// Moves the aircraft by 0.1 s; `here_m` is the position of the vehicle.
    pub(super) fn fly(&mut self, parameters: &Parameters, here_m: DVec3) {
        self.sky.step(parameters, here_m);
    }

    /// Passes the reports of all aircraft to the receiver; `own` is the vehicle's position, if
    /// known. Returns `false`, once, if no receiver of this `ADSB_TYPE` exists.
    pub(super) fn hear(
        &mut self,
        datum: &LocalDatum,
        own: Option<Place>,
        parameters: &Parameters,
        now: Duration,
    ) -> bool {
        let kind = parameters.value("ADSB_TYPE");
        if kind <= 0.0 {
            return true;
        }
        // Any other type needs a device on a serial port.
        if (kind - SIMULATED_TYPE).abs() > f64::EPSILON {
            return std::mem::replace(&mut self.has_failed, true);
        }
        self.receiver.expire(now);
        // `SIM_ADSB_TYPES` bit 0: the device of SITL itself.
        if parameters.value("SIM_ADSB_TYPES") as i32 & 1 != 0 {
            for report in self.sky.reports(datum) {
                self.receiver.hear(report, own, parameters, now);
            }
        }
        true
    }

    /// The next aircraft for a serial port, if one is due.
    pub(super) fn next(&mut self, serial: Serial, now: Duration) -> Option<ADSB_VEHICLE_DATA> {
        self.receiver.next(serial, now)
    }
}
