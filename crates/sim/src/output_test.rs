//! The motor test of a rover (`DO_MOTOR_TEST`): one output is driven for a time, while the others keep their values.

use std::time::Duration;

use mavlink::dialects::ardupilotmega::MotorTestThrottleType;

use super::kind::Chassis;
use super::wheels::Outputs;

/// The outputs that can be tested, by their numbers in the command.
const THROTTLE: i32 = 1;
const STEERING: i32 = 2;
const LEFT: i32 = 3;
const RIGHT: i32 = 4;
const MAINSAIL: i32 = 5;
const PERCENT: i32 = MotorTestThrottleType::MOTOR_TEST_THROTTLE_PERCENT as i32;
const PULSE_WIDTH: i32 = MotorTestThrottleType::MOTOR_TEST_THROTTLE_PWM as i32;
const PILOT: i32 = MotorTestThrottleType::MOTOR_TEST_THROTTLE_PILOT as i32;
const PULSE_MAX_US: i32 = 2200;
/// A test lasts at most this long, in seconds.
const LASTS_MAX_S: f32 = 30.0;

/// The failsafes that are off during a test.
pub(super) const SUSPENDED: [&str; 3] = ["FS_GCS_ENABLE", "FS_THR_ENABLE", "FS_CRASH_CHECK"];

/// What a command asks for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct TestRequest {
    /// The number of the output, from 1.
    pub(super) output: i32,
    /// The kind of the value (`MOTOR_TEST_THROTTLE_TYPE`).
    pub(super) kind: i32,
    /// The value: percent, or microseconds.
    pub(super) value: i32,
    /// The duration, in seconds.
    pub(super) lasts_s: f32,
}

impl TestRequest {
    /// Whether a calibrated remote control is needed.
    pub(super) fn needs_radio(&self) -> bool {
        self.kind != PULSE_WIDTH
    }

    /// The vehicle's text if a test cannot begin with this request. A test under way takes any.
    pub(super) fn fault(&self) -> Option<String> {
        let Self {
            output,
            kind,
            value,
            ..
        } = self;
        if !(0..=RIGHT).contains(output) {
            Some(format!("Motor Test: invalid motor ({output})"))
        } else if !(0..=PILOT).contains(kind) {
            Some(format!("Motor Test: invalid throttle type: {kind}"))
        } else if *kind == PULSE_WIDTH && *value > PULSE_MAX_US {
            Some(format!("Motor Test: pwm ({value}) too high"))
        } else if *kind == PERCENT && *value > 100 {
            Some(format!("Motor Test: percentage ({value}) too high"))
        } else {
            None
        }
    }
}

/// A test under way.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct OutputTest {
    request: TestRequest,
    began: Duration,
    /// The values of [`SUSPENDED`] before the test.
    pub(super) suspended: [f32; 3],
}

impl OutputTest {
    pub(super) fn new(request: TestRequest, began: Duration, suspended: [f32; 3]) -> Self {
        Self {
            request,
            began,
            suspended,
        }
    }

    /// Goes on as another request says.
    pub(super) fn replace(&mut self, request: TestRequest, now: Duration) {
        self.request = request;
        self.began = now;
    }

    /// Whether the test is over. One with a negative duration ends only with the next.
    pub(super) fn is_over(&self, now: Duration) -> bool {
        let lasts_s = self.request.lasts_s.min(LASTS_MAX_S);
        let has_passed = lasts_s >= 0.0 && now >= self.began + Duration::from_secs_f32(lasts_s);
        has_passed || (self.is_driven() && self.request.output > MAINSAIL)
    }

    /// Whether the kind of the value is known; with another one, all outputs keep their values.
    fn is_driven(&self) -> bool {
        (0..=PILOT).contains(&self.request.kind)
    }

    /// The outputs of this step. `kept` are those of the last one, and `sticks` those of the pilot.
    pub(super) fn outputs(&self, chassis: Chassis, kept: Outputs, sticks: Outputs) -> Outputs {
        let TestRequest {
            output,
            kind,
            value,
            ..
        } = self.request;
        let share = match kind {
            PERCENT => (f64::from(value) / 100.0).clamp(-1.0, 1.0),
            PULSE_WIDTH => (f64::from(value) - 1500.0) / 500.0,
            PILOT if output == STEERING => sticks.steering,
            PILOT => sticks.throttle,
            _ => return kept,
        };
        match (chassis, output) {
            (Chassis::Ackermann | Chassis::Boat, THROTTLE) => Outputs {
                throttle: share,
                ..kept
            },
            (Chassis::Ackermann | Chassis::Boat, STEERING) => Outputs {
                steering: share,
                ..kept
            },
            (Chassis::Skid, LEFT) => Outputs::of_sides(share, kept.right()),
            (Chassis::Skid, RIGHT) => Outputs::of_sides(kept.left(), share),
            _ => kept,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const STILL: Outputs = Outputs {
        steering: 0.0,
        throttle: 0.0,
    };

    fn percent(output: i32, value: i32, lasts_s: f32) -> OutputTest {
        let request = TestRequest {
            output,
            kind: PERCENT,
            value,
            lasts_s,
        };
        OutputTest::new(request, Duration::ZERO, [0.0; 3])
    }

    #[test]
    fn each_chassis_has_its_own_outputs() {
        let moves = |chassis: Chassis, output: i32| {
            percent(output, 20, 1.0).outputs(chassis, STILL, STILL) != STILL
        };
        for chassis in [Chassis::Ackermann, Chassis::Boat] {
            let moved: Vec<i32> = (0..=MAINSAIL).filter(|&it| moves(chassis, it)).collect();
            assert_eq!(moved, [THROTTLE, STEERING], "{chassis:?}");
        }
        let moved: Vec<i32> = (0..=MAINSAIL)
            .filter(|&it| moves(Chassis::Skid, it))
            .collect();
        assert_eq!(moved, [LEFT, RIGHT]);
    }

    #[test]
    fn a_test_lasts_half_a_minute_at_most() {
        let after = |seconds| Duration::from_secs(seconds);
        assert!(!percent(THROTTLE, 20, 45.0).is_over(after(29)));
        assert!(percent(THROTTLE, 20, 45.0).is_over(after(30)));
        assert!(percent(THROTTLE, 20, 0.0).is_over(after(0)));
        assert!(!percent(THROTTLE, 20, -3.0).is_over(after(3600)));
        assert!(percent(9, 20, 5.0).is_over(after(0)), "no such output");
    }

    #[test]
    fn one_side_is_driven_and_the_other_kept() {
        let kept = Outputs::of_sides(-0.5, 0.25);
        let driven = percent(LEFT, 40, 1.0).outputs(Chassis::Skid, kept, STILL);
        assert!((driven.left() - 0.4).abs() < 1e-9);
        assert!((driven.right() - 0.25).abs() < 1e-9);
    }
}
