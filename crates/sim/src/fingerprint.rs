//! A hash of a vehicle's whole state, for comparing two flights.

use std::fmt::{self, Debug, Write as _};

use super::autopilot::Autopilot;
use super::port::Serials;
use super::slot::VehicleSlot;
use super::vehicle::{Plant, Vehicle};

/// 64-bit FNV-1a over the debug text of the state, in which numbers have all their digits.
struct Fingerprint(u64);

impl Fingerprint {
    fn add(&mut self, part: &dyn Debug) {
        // Writing to a hash cannot fail.
        let _ = write!(self, "{part:?};");
    }
}

impl fmt::Write for Fingerprint {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        for &byte in text.as_bytes() {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
        }
        Ok(())
    }
}

impl VehicleSlot {
    /// The fingerprint of all state that determines how the flight continues. It leaves out values
    /// derived from that state (the tuning), constants (the airframe), reports (logs, buffers of
    /// the ports), and the signing key, which must not enter a record.
    pub(super) fn fingerprint(&self) -> u64 {
        let mut print = Fingerprint(0xcbf2_9ce4_8422_2325);
        let Self {
            autopilot,
            serials,
            ports: _,
        } = self;
        let Serials {
            links,
            signing: _,
            transfers,
            transferring: _,
        } = serials;
        print.add(links);
        print.add(transfers);
        autopilot.add_to(&mut |part| print.add(part));
        print.0
    }
}

impl Autopilot {
    fn add_to(&self, add: &mut dyn FnMut(&dyn Debug)) {
        let (vehicle, watches) = self.state();
        for part in watches {
            add(part);
        }
        vehicle.add_to(add);
    }
}

impl Vehicle {
    fn add_to(&self, add: &mut dyn FnMut(&dyn Debug)) {
        let Self {
            kind,
            system,
            board_id,
            parameters,
            tuning: _,
            plant,
            estimator,
            odometry,
            datum,
            flight,
            safety,
            fence,
            plans,
            radio,
            servos_us,
            boot,
            log: _,
            adsb,
            following,
            outbox,
            steps,
        } = self;
        plant.add_to(add);
        let parts: [&dyn Debug; 15] = [
            kind, system, board_id, parameters, estimator, datum, flight, safety, fence, plans,
            radio, servos_us, boot, outbox, steps,
        ];
        for part in parts {
            add(part);
        }
        if let Some(adsb) = adsb {
            add(adsb);
        }
        if let Some(odometry) = odometry {
            add(odometry);
        }
        if let Some(following) = following {
            add(following);
        }
    }
}

impl Plant {
    fn add_to(&self, add: &mut dyn FnMut(&dyn Debug)) {
        let Self {
            airframe: _,
            body,
            battery,
            wind,
            start_density,
        } = self;
        let parts: [&dyn Debug; 4] = [body, battery, wind, start_density];
        for part in parts {
            add(part);
        }
    }
}
