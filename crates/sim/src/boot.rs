//! The boot, from power-on to ready: in seconds, or as long as on the real vehicle.

use mavlink::dialects::ardupilotmega::{EkfStatusFlags, GpsFixType};

use super::estimator::{FLAGS_GIVEN_UP, FLAGS_GOOD};
use super::kind::VehicleKind;
use super::mode::Mode;

/// The hash of the commit of `ArduPilot` whose behaviour this is, in `AUTOPILOT_VERSION`.
pub(super) const COMMIT: [u8; 8] = *b"fbb78585";

/// The time of an event in hundredths of a second, whether the event waits for a GPS position, and
/// the event.
type Entry = (u32, bool, BootEvent);

/// An event during the boot.
#[derive(Debug, Clone, Copy)]
pub(super) enum BootEvent {
    Say(&'static str),
    /// Plain text on the serial ports, between the frames.
    Print(&'static str),
    /// The initialisation is over: return to the first mode.
    Initialised,
    /// The position is known: it becomes origin and home.
    Origin,
    Elevation,
    /// The position is good enough to fly.
    Ready,
}

use BootEvent::{Elevation, Initialised, Origin, Print, Ready, Say};

const QUICK: &[Entry] = &[
    (30, false, Say("ArduPilot Ready")),
    (50, false, Say("EKF3 IMU0 initialised")),
    (120, true, Say("EKF3 IMU0 origin set")),
    (120, true, Say("EKF3 IMU0 is using GPS")),
    (120, true, Origin),
    (120, true, Ready),
];

/// The boot of an `ArduCopter` in SITL, measured 28 times.
const REALISTIC: &[Entry] = &[
    (
        2,
        false,
        Print("\n\nInit ArduCopter V4.6.0-dev (fbb78585)\n\nFree RAM: 131072\nBooting 0/0\n"),
    ),
    (31, false, Say("Calibrating barometer")),
    (105, false, Print("Init Gyro*")),
    (110, false, Print("*\n")),
    (191, false, Say("Barometer 1 calibration complete")),
    (191, false, Say("Barometer 2 calibration complete")),
    (243, false, Initialised),
    (244, false, Say("ArduPilot Ready")),
    (244, false, Say("AHRS: DCM active")),
    (444, false, Say("EKF3 IMU0 initialised")),
    (444, false, Say("EKF3 IMU1 initialised")),
    (444, false, Say("AHRS: EKF3 active")),
    (579, false, Say("EKF3 IMU0 tilt alignment complete")),
    (579, false, Say("EKF3 IMU1 tilt alignment complete")),
    (
        589,
        false,
        Say("EKF3 IMU0 MAG0 initial yaw alignment complete"),
    ),
    (
        589,
        false,
        Say("EKF3 IMU1 MAG0 initial yaw alignment complete"),
    ),
    (980, false, Say("GPS 1: probing for u-blox at 230400 baud")),
    (982, false, Say("GPS 1: detected u-blox")),
    (2001, true, Origin),
    (2001, true, Say("EKF3 IMU0 origin set")),
    (2004, true, Elevation),
    (2020, true, Say("EKF3 IMU1 origin set")),
    (4161, true, Say("EKF3 IMU0 is using GPS")),
    (4161, true, Say("EKF3 IMU1 is using GPS")),
    (4161, true, Ready),
];

/// The boot of an `ArduRover` in SITL.
const REALISTIC_ROVER: &[Entry] = &[
    (
        2,
        false,
        Print("\n\nInit ArduRover V4.6.0-dev (fbb78585)\n\nFree RAM: 131072\n"),
    ),
    (14, false, Say("Calibrating barometer")),
    (174, false, Say("Barometer 1 calibration complete")),
    (174, false, Say("Barometer 2 calibration complete")),
    (
        175,
        false,
        Say("Beginning INS calibration. Do not move vehicle"),
    ),
    (237, false, Initialised),
    (237, false, Say("ArduPilot Ready")),
    (237, false, Say("AHRS: DCM active")),
    (439, false, Say("EKF3 IMU0 initialised")),
    (439, false, Say("EKF3 IMU1 initialised")),
    (599, false, Say("EKF3 IMU0 tilt alignment complete")),
    (599, false, Say("EKF3 IMU1 tilt alignment complete")),
    (
        607,
        false,
        Say("EKF3 IMU0 MAG0 initial yaw alignment complete"),
    ),
    (
        607,
        false,
        Say("EKF3 IMU1 MAG0 initial yaw alignment complete"),
    ),
    (967, false, Say("GPS 1: probing for u-blox at 230400 baud")),
    (970, false, Say("GPS 1: detected u-blox")),
    (1988, true, Origin),
    (1988, true, Say("EKF3 IMU0 origin set")),
    (1988, true, Say("EKF3 IMU1 origin set")),
    (1995, true, Elevation),
    (4210, true, Say("EKF3 IMU0 is using GPS")),
    (4210, true, Say("EKF3 IMU1 is using GPS")),
    (4210, true, Say("AHRS: EKF3 active")),
    (4210, true, Ready),
];

/// Times of states without an event, in hundredths of a second.
mod at {
    /// Only in the quick boot.
    pub(super) const QUICK_EKF_STARTED: u32 = 50;
    pub(super) const FIRST_HEARTBEAT: u32 = 95;
    pub(super) const INITIALISED: u32 = 243;
    pub(super) const BATTERY_HEALTHY: u32 = 240;
    pub(super) const COMPASS_HEALTHY: u32 = 240;
    pub(super) const GYROS_HEALTHY: u32 = 190;
    pub(super) const EKF_STARTED: u32 = 444;
    pub(super) const ATTITUDE: u32 = 579;
    pub(super) const ALIGNED: u32 = 589;
    pub(super) const GPS_SEEN: u32 = 982;
    pub(super) const GPS_FIXED: u32 = 1006;
    pub(super) const ACCELS_CONSISTENT: u32 = 1210;
    pub(super) const GYROS_CONSISTENT: u32 = 2250;
    pub(super) const CHECKED: u32 = 2345;
}

/// The progress of the boot.
#[derive(Debug, Clone)]
pub(super) struct Boot {
    kind: VehicleKind,
    pub(super) realistic: bool,
    /// Hundredths of a second; stopped while an event waits for the GPS.
    clock: u32,
    next: usize,
    over: bool,
    /// Text to print on the serial ports.
    console: Vec<&'static str>,
}

impl Boot {
    pub(super) fn new(kind: VehicleKind, realistic: bool) -> Self {
        Self {
            kind,
            realistic,
            clock: 0,
            next: 0,
            over: false,
            console: Vec::new(),
        }
    }

    /// Whether the position estimate has become good for the first time.
    pub(super) fn is_over(&self) -> bool {
        self.over
    }

    /// Whether the boot waits for the first ground station, as SITL does.
    pub(super) fn awaits_client(&self) -> bool {
        self.realistic && self.clock == 0
    }

    /// Whether a due message cannot be sent yet.
    pub(super) fn holds_back(&self, message_id: u32) -> bool {
        let from = if message_id == 0 {
            at::FIRST_HEARTBEAT
        } else {
            at::INITIALISED
        };
        self.is_before(from)
    }

    /// Whether the initialisation is running, with the system status "active".
    pub(super) fn is_initialising(&self) -> bool {
        self.is_before(at::INITIALISED)
    }

    /// `fix_type` and satellites of a receiver that is still starting; `None` once it has a fix.
    pub(super) fn early_fix(&self) -> Option<(GpsFixType, u8)> {
        if self.is_before(at::GPS_SEEN) {
            Some((GpsFixType::GPS_FIX_TYPE_NO_GPS, 0))
        } else if self.is_before(at::GPS_FIXED) {
            Some((GpsFixType::GPS_FIX_TYPE_NO_FIX, 3))
        } else {
            None
        }
    }

    /// Whether the attitude and position reference is healthy.
    pub(super) fn has_reference(&self) -> bool {
        self.over || (self.realistic && self.clock >= at::GYROS_CONSISTENT)
    }

    /// Whether the pre-arm checks pass for modes without a position.
    pub(super) fn is_checked(&self) -> bool {
        !self.is_before(at::CHECKED)
    }

    /// `EKF_STATUS_REPORT.flags` during the boot.
    pub(super) fn flags(&self) -> EkfStatusFlags {
        if self.over {
            FLAGS_GOOD
        } else if self.is_before(at::EKF_STARTED) {
            EkfStatusFlags::EKF_UNINITIALIZED
        } else if self.is_before(at::ALIGNED) {
            EkfStatusFlags::empty()
        } else {
            FLAGS_GIVEN_UP
        }
    }

    /// The reasons why the boot forbids arming, in the order of `ArduCopter`'s checks. `is_blind`
    /// means that the GPS is checked and has no position.
    pub(super) fn obstacles(
        &self,
        mode: &Mode,
        has_home: bool,
        is_blind: bool,
    ) -> Vec<&'static str> {
        let mut reasons = Vec::new();
        if self.over {
            return reasons;
        }
        let is_blind = is_blind && mode.needs_position() && !self.is_before(at::GPS_SEEN);
        if !self.realistic {
            let blind = is_blind.then_some("GPS 1: Bad fix");
            reasons.extend(blind.or_else(|| self.reference_obstacle(mode)));
            return reasons;
        }
        let mut until = |time: u32, reason: &'static str| {
            if self.is_before(time) {
                reasons.push(reason);
            }
        };
        if mode.controls_height {
            until(at::ATTITUDE, "Need Alt Estimate");
        }
        if self.is_before(at::GYROS_HEALTHY) {
            until(at::GYROS_HEALTHY, "Gyros not healthy");
        } else if self.is_before(at::ACCELS_CONSISTENT) {
            until(at::ACCELS_CONSISTENT, "Accels inconsistent");
        } else {
            until(at::GYROS_CONSISTENT, "Gyros inconsistent");
        }
        until(at::ATTITUDE, "EKF attitude is bad");
        until(at::COMPASS_HEALTHY, "Compass not healthy");
        if is_blind {
            reasons.push("GPS 1: Bad fix");
        } else if let Some(reason) = self.position_obstacle(mode, has_home) {
            reasons.push(reason);
        }
        if self.is_before(at::BATTERY_HEALTHY) {
            reasons.push("Battery 1 unhealthy");
        }
        reasons
    }

    /// The missing condition for a position, among the optional checks.
    fn position_obstacle(&self, mode: &Mode, has_home: bool) -> Option<&'static str> {
        if mode.needs_position() {
            return Some(if has_home {
                "Need Position Estimate"
            } else {
                "AHRS: waiting for home"
            });
        }
        self.reference_obstacle(mode)
    }

    /// The missing condition among the mandatory checks, if any.
    pub(super) fn reference_obstacle(&self, mode: &Mode) -> Option<&'static str> {
        if self.over {
            None
        } else if !self.realistic {
            if mode.needs_position() {
                Some("Need Position Estimate")
            } else {
                (self.clock < at::QUICK_EKF_STARTED).then_some("AHRS: EKF3 not started")
            }
        } else if self.is_before(at::EKF_STARTED) {
            Some("AHRS: EKF3 not started")
        } else if !mode.needs_position() {
            None
        } else if self.is_before(at::GPS_SEEN) {
            Some("AHRS: EK3 sources require GPS")
        } else {
            Some("Need Position Estimate")
        }
    }

    /// One step of the boot; `is_blind` means that there is no GPS position. Returns the events of the step.
    pub(super) fn step(&mut self, is_blind: bool) -> impl Iterator<Item = BootEvent> + use<> {
        let table = self.table();
        let from = self.next;
        // The clock stops before an event that waits for a position.
        let holds = table
            .get(self.next)
            .is_some_and(|(time, waits, _)| *waits && is_blind && self.clock + 1 >= *time);
        if !self.over && !holds {
            self.clock += 1;
            let due = |place: usize| {
                table
                    .get(place)
                    .is_some_and(|(time, ..)| *time <= self.clock)
            };
            while due(self.next) {
                self.next += 1;
            }
        }
        let passed = table.get(from..self.next).unwrap_or_default();
        passed.iter().map(|(_, _, event)| *event)
    }

    /// Notes that the position is good enough to fly.
    pub(super) fn finish(&mut self) {
        self.over = true;
    }

    /// Prints plain text on the serial ports.
    pub(super) fn print(&mut self, text: &'static str) {
        self.console.push(text);
    }

    /// Takes the text to print.
    pub(super) fn take_console(&mut self) -> Vec<&'static str> {
        std::mem::take(&mut self.console)
    }

    fn is_before(&self, time: u32) -> bool {
        self.realistic && self.clock < time
    }

    fn table(&self) -> &'static [Entry] {
        match self.kind {
            _ if !self.realistic => QUICK,
            VehicleKind::Copter => REALISTIC,
            VehicleKind::Rover(_) => REALISTIC_ROVER,
        }
    }
}
