//! Statistics that a vehicle keeps in its parameters: hours flown, and the hover throttle.

use std::time::Duration;

use super::body::Body;
use super::parameters::Parameters;

/// The interval at which the counters are stored and reported.
const COUNTED_EVERY: Duration = Duration::from_secs(30);
/// The time between two updates of the counters.
const LOOK: Duration = Duration::from_millis(100);
/// The vertical speed below which the vehicle counts as hovering, and the time constant with which
/// the hover throttle is learned.
const HOVER_CLIMB_M_S: f64 = 0.6;
const HOVER_LEARNT_S: f64 = 10.0;
/// The minimum change of the hover throttle that is reported after a flight.
const HOVER_MOVED: f32 = 0.001;

/// Counts not stored yet.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Counters {
    /// Time in the hover since arming, and the throttle learned in it.
    flown: Duration,
    hover: f64,
    counted: Duration,
    /// Seconds in the air not stored yet.
    flight_s: f64,
    was_armed: bool,
}

/// The inputs of the counters.
pub(super) struct CounterInputs<'a> {
    pub(super) now: Duration,
    pub(super) armed: bool,
    pub(super) landed: bool,
    pub(super) body: &'a Body,
    /// The hover throttle from the parameters.
    pub(super) hover: f64,
    pub(super) parameters: &'a Parameters,
}

/// New values of parameters.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct CounterReport {
    /// New values of `STAT_FLTTIME` and `STAT_RUNTIME`.
    pub(super) times: Vec<(&'static str, f32)>,
    /// A new value of `MOT_THST_HOVER`, if it has changed enough to be reported.
    pub(super) hover: Option<f32>,
}

impl Counters {
    /// Counts time in the air and since boot, and stores the counters every 30 s and after a flight. To be called every
    /// [`LOOK`].
    pub(super) fn step(&mut self, inputs: &CounterInputs<'_>) -> CounterReport {
        let mut report = CounterReport::default();
        let landed_again = self.was_armed && !inputs.armed;
        self.was_armed = inputs.armed;
        self.watch_hover(inputs);
        if !inputs.landed {
            self.flight_s += LOOK.as_secs_f64();
        }
        let due = inputs.now >= self.counted + COUNTED_EVERY;
        if due || (landed_again && self.flight_s >= 1.0) {
            let passed = inputs.now.as_secs().saturating_sub(self.counted.as_secs()) as f64;
            let flown = self.flight_s.floor();
            self.counted = inputs.now;
            self.flight_s -= flown;
            for (name, seconds) in [("STAT_FLTTIME", flown), ("STAT_RUNTIME", passed)] {
                if seconds > 0.0 {
                    let sum = inputs.parameters.value(name) + seconds;
                    report.times.push((name, sum as f32));
                }
            }
        }
        if landed_again {
            report.hover = self.learn_hover(inputs.parameters);
        }
        report
    }

    /// Averages the throttle while the vehicle hovers, as `MOT_HOVER_LEARN` does.
    fn watch_hover(&mut self, inputs: &CounterInputs<'_>) {
        let still = inputs.body.velocity_m_s.z.abs() < HOVER_CLIMB_M_S;
        if inputs.landed || !still {
            return;
        }
        if self.flown.is_zero() {
            self.hover = inputs.hover;
        }
        self.flown += LOOK;
        self.hover += (inputs.body.throttle - self.hover) * LOOK.as_secs_f64() / HOVER_LEARNT_S;
    }

    /// After a flight, stores the learned hover throttle.
    fn learn_hover(&mut self, parameters: &Parameters) -> Option<f32> {
        let learned = self.hover as f32;
        let known = parameters.value("MOT_THST_HOVER") as f32;
        let long_enough = self.flown > LOOK * 10;
        self.flown = Duration::ZERO;
        (long_enough && (learned - known).abs() > HOVER_MOVED).then(|| learned.clamp(0.125, 0.6875))
    }
}
