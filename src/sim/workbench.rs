//! What is done to the vehicle on the ground: motor tests, compass calibration, safety switch, and the counters it
//! keeps of itself.

use std::time::Duration;

use mavlink::dialects::ardupilotmega::{MavMessage, MavSeverity};

use super::autopilot::{Autopilot, Place};
use super::{inbound, mode};

/// A motor test lasts at most this long, in seconds.
const TEST_MAX_S: f32 = 600.0;
/// The vehicle has three compasses.
const COMPASSES: u8 = 0b111;
/// The counters are stored, and told, this often.
const COUNTED_EVERY: Duration = Duration::from_secs(30);
/// Home lies at most this far above or below the origin.
const HOME_HEIGHT_MAX_M: f64 = 50_000.0;
/// How often the workbench is looked after.
const LOOK: Duration = Duration::from_millis(100);
/// Slower than this, up or down, the vehicle hovers; how fast the throttle of that is learnt.
const HOVER_CLIMB_M_S: f64 = 0.6;
const HOVER_LEARNT_S: f64 = 10.0;
/// The hover throttle is told if it moved by more than this in a flight.
const HOVER_MOVED: f32 = 0.001;

/// Everything that is under way or set up by hand. It does not survive a reboot.
#[derive(Debug, Clone, PartialEq, Default)]
#[expect(clippy::struct_excessive_bools, reason = "independent switches")]
pub(super) struct Workbench {
    pub(super) motor_test: Option<MotorTest>,
    pub(super) compasses: CompassCalibration,
    /// The safety switch blocks the motors.
    pub(super) safety_on: bool,
    /// The parachute was enabled.
    pub(super) parachute: bool,
    pub(super) relay_on: bool,
    /// The stored parameters were erased: the next boot begins with the defaults.
    pub(super) erased: bool,
    /// When BRAKE, entered by the pause button, turns into LOITER.
    pub(super) brake_until: Option<Duration>,
    /// Time in the air since the motors were armed, and the throttle that held the vehicle there.
    flown: Duration,
    hover: f64,
    counted: Duration,
    /// Seconds in the air that are not yet stored.
    flight_s: f64,
    was_armed: bool,
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
    /// A test as the command asks for it: motor, kind of throttle (0 percent, 1 pulse width) and number of motors;
    /// the throttle in that kind; seconds.
    pub(super) fn new(
        [motor, kind, motors]: [i32; 3],
        throttle: f32,
        lasts_s: f32,
        now: Duration,
    ) -> Self {
        let pulse = match kind {
            0 => (throttle <= 100.0).then_some(1000.0 + throttle * 10.0),
            1 => Some(throttle),
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

    /// The motor that turns now, counted from 1, with its pulse width.
    pub(super) fn turning(&self, now: Duration) -> Option<(i32, u16)> {
        let pulse_us = self.pulse_us?;
        (now < self.since + self.lasts).then_some((self.motor, pulse_us))
    }

    /// Moves on; true when the test is over.
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
        // Between two motors all rest for half the time.
        if now >= self.since + self.lasts + self.lasts / 2 {
            self.motor += 1;
            self.left -= 1;
            self.since = now;
        }
        false
    }
}

/// Compasses that are being calibrated, a bit each. As nobody turns the vehicle round by hand, it never succeeds.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct CompassCalibration {
    running: u8,
    begun: bool,
}

impl CompassCalibration {
    /// Begins with the compasses of a mask (zero: all); false if there is another one in it.
    pub(super) fn start(&mut self, mask: u8) -> bool {
        let mask = if mask == 0 { COMPASSES } else { mask };
        if mask & !COMPASSES != 0 {
            return false;
        }
        self.running |= mask;
        self.begun = true;
        true
    }

    /// Accepts results; false while there are none yet.
    pub(super) fn accept(&self, mask: u8) -> bool {
        let mask = if mask == 0 { COMPASSES } else { mask };
        self.running & mask == 0
    }

    /// Breaks off.
    pub(super) fn cancel(&mut self, mask: u8) {
        self.running &= if mask == 0 { 0 } else { !mask };
    }
}

impl Workbench {
    /// Why the vehicle cannot be armed, in the order in which it says so.
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

impl Autopilot {
    /// Looks after what is under way on the workbench.
    pub(super) fn watch_workbench(&mut self) {
        let now = self.uptime();
        if let Some(test) = &mut self.workbench.motor_test
            && test.step(now)
        {
            self.workbench.motor_test = None;
            self.say(MavSeverity::MAV_SEVERITY_INFO, "finished motor test");
        }
        if self.workbench.brake_until.is_some_and(|until| now >= until) {
            self.workbench.brake_until = None;
            if self.mode.number == mode::BRAKE && !self.set_mode(mode::LOITER) {
                self.set_mode(mode::ALT_HOLD);
            }
        }
        self.count(now);
    }

    /// Counts time in the air and since boot, and tells the counters when they are stored: every 30 s and after a
    /// flight.
    fn count(&mut self, now: Duration) {
        let armed = self.safety.armed;
        let landed_again = self.workbench.was_armed && !armed;
        self.workbench.was_armed = armed;
        self.watch_hover();
        if !self.safety.landed {
            self.workbench.flight_s += LOOK.as_secs_f64();
        }
        let due = now >= self.workbench.counted + COUNTED_EVERY;
        if due || (landed_again && self.workbench.flight_s >= 1.0) {
            let passed = now
                .as_secs()
                .saturating_sub(self.workbench.counted.as_secs()) as f64;
            let flown = self.workbench.flight_s.floor();
            self.workbench.counted = now;
            self.workbench.flight_s -= flown;
            self.add("STAT_FLTTIME", flown);
            self.add("STAT_RUNTIME", passed);
        }
        if landed_again {
            self.learn_hover();
        }
    }

    fn add(&mut self, name: &str, seconds: f64) {
        if seconds > 0.0 {
            let sum = self.parameters.value(name) + seconds;
            self.store(name, sum as f32);
        }
    }

    /// Averages the throttle while the vehicle hovers, as `MOT_HOVER_LEARN` does.
    fn watch_hover(&mut self) {
        let still = self.body.velocity_m_s.z.abs() < HOVER_CLIMB_M_S;
        if self.safety.landed || !still {
            return;
        }
        let bench = &mut self.workbench;
        if bench.flown.is_zero() {
            bench.hover = self.tuning.pilot.hover();
        }
        bench.flown += LOOK;
        bench.hover += (self.body.throttle - bench.hover) * LOOK.as_secs_f64() / HOVER_LEARNT_S;
    }

    /// After a flight the throttle that held the vehicle is the new hover throttle.
    fn learn_hover(&mut self) {
        let learned = self.workbench.hover as f32;
        let known = self.parameters.value("MOT_THST_HOVER") as f32;
        let long_enough = self.workbench.flown > LOOK * 10;
        self.workbench.flown = Duration::ZERO;
        if long_enough && (learned - known).abs() > HOVER_MOVED {
            self.store("MOT_THST_HOVER", learned.clamp(0.125, 0.6875));
            self.retune();
        }
    }

    /// Sets a parameter of the vehicle's own and tells everybody.
    fn store(&mut self, name: &str, value: f32) {
        if let Some(parameter) = self.parameters.set(name, value) {
            let told = inbound::unasked_parameter(self, &parameter);
            self.outbox.push(MavMessage::PARAM_VALUE(told));
        }
    }

    /// Whether a place may be home.
    pub(super) fn may_be_home(&self, place: Place) -> bool {
        let above_m = place.altitude_amsl_m - self.start.altitude_amsl_m;
        place.at.is_valid() && above_m.abs() <= HOME_HEIGHT_MAX_M
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
