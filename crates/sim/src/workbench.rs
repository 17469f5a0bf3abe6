//! Work on a vehicle on the ground, as on a workbench: motor tests, compass calibration,
//! and the switches of the hardware.

use std::time::Duration;

use mavlink::dialects::ardupilotmega::MotorTestThrottleType;

use super::output_test::OutputTest;
use super::parameters::Parameters;

/// A motor test lasts at most this long, in seconds.
const TEST_MAX_S: f32 = 600.0;
const PERCENT: i32 = MotorTestThrottleType::MOTOR_TEST_THROTTLE_PERCENT as i32;
const PULSE_WIDTH: i32 = MotorTestThrottleType::MOTOR_TEST_THROTTLE_PWM as i32;
/// A bit for each of the vehicle's three compasses.
const COMPASSES: u8 = 0b111;

/// The state of tests, calibrations and switches. It does not survive a reboot.
#[derive(Debug, Clone, PartialEq, Default)]
#[expect(clippy::struct_excessive_bools, reason = "independent switches")]
pub(super) struct Workbench {
    pub(super) motor_test: Option<MotorTest>,
    /// The motor test of a rover.
    pub(super) output_test: Option<OutputTest>,
    pub(super) compasses: CompassCalibration,
    /// Whether the safety switch blocks the motors.
    pub(super) safety_on: bool,
    /// Whether the parachute is enabled.
    pub(super) parachute: bool,
    /// The relays that are on, one bit each.
    pub(super) relays_on: u16,
    /// Whether the remote control is being calibrated.
    pub(super) radio_calibrates: bool,
    /// When a calibration last kept the vehicle busy.
    pub(super) initialised_at: Option<Duration>,
    /// When the level or the accelerometers were last calibrated in one position.
    pub(super) accelerometers_calibrated: Duration,
    /// Whether the stored parameters were erased: the next boot then begins with the defaults.
    pub(super) erased: bool,
}

/// A motor that is driven by hand.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct MotorTest {
    motor: i32,
    /// Motors still to be driven, this one included.
    left: i32,
    /// Throttle as a pulse width; `None` ends the test.
    pulse_us: Option<u16>,
    since: Duration,
    lasts: Duration,
}

impl MotorTest {
    /// A test as commanded. `kind` is the kind of throttle (`MOTOR_TEST_THROTTLE_TYPE`), `throttle`
    /// the value of that kind; the test lasts `lasts_s` seconds for each of `motors` motors, from
    /// `motor` on.
    pub(super) fn new(
        [motor, kind, motors]: [i32; 3],
        throttle: f32,
        lasts_s: f32,
        now: Duration,
    ) -> Self {
        let pulse = match kind {
            PERCENT => (throttle <= 100.0).then_some(1000.0 + throttle * 10.0),
            PULSE_WIDTH => Some(throttle),
            _ => None,
        };
        let seconds = if lasts_s.is_finite() { lasts_s } else { 0.0 };
        Self {
            motor,
            left: motors.max(1),
            pulse_us: pulse
                .filter(|us| (800.0..=2200.0).contains(us))
                .map(|us| us as u16),
            since: now,
            lasts: Duration::from_secs_f32(seconds.clamp(0.0, TEST_MAX_S)),
        }
    }

    /// The motor that turns now, if any, counted from 1, with its pulse width.
    pub(super) fn turning(&self, now: Duration) -> Option<(i32, u16)> {
        let pulse_us = self.pulse_us?;
        (now < self.since + self.lasts).then_some((self.motor, pulse_us))
    }

    /// Advances by one step; true when the test is over.
    fn step(&mut self, now: Duration) -> bool {
        if self.pulse_us.is_none() {
            return true;
        }
        if now < self.since + self.lasts {
            return false;
        }
        if self.left <= 1 {
            return true;
        }
        // Between two motors, all motors rest for half the duration of one test.
        if now >= self.since + self.lasts + self.lasts / 2 {
            self.motor += 1;
            self.left -= 1;
            self.since = now;
        }
        false
    }
}

/// Compasses that are being calibrated, a bit each. Since the vehicle is not turned by hand, the
/// calibration never succeeds.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct CompassCalibration {
    running: u8,
    begun: bool,
}

impl CompassCalibration {
    /// Begins with the compasses of a mask (zero: all); `false` if the mask contains any other bit.
    pub(super) fn start(&mut self, mask: u8) -> bool {
        let mask = if mask == 0 { COMPASSES } else { mask };
        if mask & !COMPASSES != 0 {
            return false;
        }
        self.running |= mask;
        self.begun = true;
        true
    }

    /// Accepts the results of a calibration; `false` while there are none.
    pub(super) fn accept(&self, mask: u8) -> bool {
        let mask = if mask == 0 { COMPASSES } else { mask };
        self.running & mask == 0
    }

    pub(super) fn cancel(&mut self, mask: u8) {
        self.running &= if mask == 0 { 0 } else { !mask };
    }
}

/// The highest number of relays.
const RELAYS: u16 = 6;

/// The relays that are present, one bit each (`RELAYn_FUNCTION`).
pub(super) fn relays(all: &Parameters) -> u16 {
    let is_relay = |number: &u16| all.value(&format!("RELAY{}_FUNCTION", number + 1)) as i32 == 1;
    (0..RELAYS)
        .filter(is_relay)
        .fold(0, |bits, number| bits | 1 << number)
}

impl Workbench {
    /// Switches the relay with a bit on or off; `false` if it is absent.
    pub(super) fn switch_relay(&mut self, all: &Parameters, bit: u16, on: bool) -> bool {
        let present = relays(all) & bit;
        if on {
            self.relays_on |= present;
        } else {
            self.relays_on &= !present;
        }
        present != 0
    }

    /// Advances by one step; returns whether a motor test is over.
    pub(super) fn step(&mut self, now: Duration) -> bool {
        let ends = self.motor_test.as_mut().is_some_and(|test| test.step(now));
        if ends {
            self.motor_test = None;
        }
        ends
    }

    /// The reasons not to arm, in the order of the vehicle's texts.
    pub(super) fn obstacles(&self) -> impl Iterator<Item = &'static str> {
        let compasses = &self.compasses;
        [
            (self.safety_on, "Hardware safety switch"),
            (compasses.running != 0, "Compass calibration running"),
            (
                compasses.begun && compasses.running == 0,
                "Compass calibrated requires reboot",
            ),
            (self.erased, "Compass not calibrated"),
            (self.parachute, "Chute has no relay"),
        ]
        .into_iter()
        .filter_map(|(holds, text)| holds.then_some(text))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_test_of_two_motors_rests_between_them_and_ends() {
        let ms = Duration::from_millis;
        let mut test = MotorTest::new([1, 0, 2], 10.0, 1.0, ms(0));
        assert_eq!(test.turning(ms(500)), Some((1, 1100)));
        assert!(!test.step(ms(1000)));
        assert_eq!(test.turning(ms(1200)), None);
        assert!(!test.step(ms(1500)));
        assert_eq!(test.turning(ms(1600)), Some((2, 1100)));
        assert!(test.step(ms(2500)));
        let mut nonsense = MotorTest::new([1, 9, 1], 10.0, 1.0, ms(0));
        assert!(nonsense.step(ms(0)));
    }

    #[test]
    fn a_compass_calibration_blocks_until_the_reboot() {
        let mut bench = Workbench::default();
        assert!(!bench.compasses.start(8));
        assert!(bench.compasses.start(0) && !bench.compasses.accept(0));
        assert_eq!(
            bench.obstacles().collect::<Vec<_>>(),
            ["Compass calibration running"]
        );
        bench.compasses.cancel(0);
        assert_eq!(
            bench.obstacles().collect::<Vec<_>>(),
            ["Compass calibrated requires reboot"]
        );
    }
}
