//! The traffic around a vehicle, and its reports.

use std::time::Duration;

use mavlink::dialects::ardupilotmega::{MavMessage, MavSeverity};

use super::Vehicle;
use crate::Serial;

/// The number of steps between two reports of each aircraft; together they take 1 s.
const REPORT_STEPS: u64 = 100;
/// Nothing is reported before this time since boot.
const SILENT_FOR: Duration = Duration::from_secs(10);

impl Vehicle {
    /// Moves the surrounding aircraft, and reports them once a second.
    pub(crate) fn watch_traffic(&mut self) {
        let Some(adsb) = &mut self.adsb else {
            return;
        };
        adsb.fly(&self.parameters, self.plant.body.position_m);
        let is_due = self.steps.is_multiple_of(REPORT_STEPS) && self.uptime() >= SILENT_FOR;
        if is_due && !self.hear_traffic() {
            let text = "ADSB: Unable to initialize ADSB driver";
            self.say(MavSeverity::MAV_SEVERITY_CRITICAL, text);
        }
    }

    /// Passes the aircraft's reports to the receiver; `false`, once, if the configured receiver
    /// does not exist.
    fn hear_traffic(&mut self) -> bool {
        let now = self.uptime();
        let own = self.is_ready().then(|| self.here());
        let Some(adsb) = &mut self.adsb else {
            return true;
        };
        adsb.hear(&self.datum, own, &self.parameters, now)
    }

    /// The message about the next aircraft for a serial port, if one is due.
    pub(crate) fn next_traffic(&mut self, serial: Serial) -> Option<MavMessage> {
        let is_on = self.parameters.value("ADSB_TYPE") > 0.0;
        let now = self.uptime();
        let adsb = self.adsb.as_mut().filter(|_| is_on)?;
        adsb.next(serial, now).map(MavMessage::ADSB_VEHICLE)
    }
}
