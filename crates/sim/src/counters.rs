//! What a vehicle counts and learns of its flights and keeps in its parameters: the hours, and the throttle that
//! holds it in the air.

use std::time::Duration;

use super::autopilot::Autopilot;

/// The counters are stored, and told, this often.
const COUNTED_EVERY: Duration = Duration::from_secs(30);
/// How often the vehicle counts.
const LOOK: Duration = Duration::from_millis(100);
/// Slower than this, up or down, the vehicle hovers; how fast the throttle of that is learnt.
const HOVER_CLIMB_M_S: f64 = 0.6;
const HOVER_LEARNT_S: f64 = 10.0;
/// The hover throttle is told if it moved by more than this in a flight.
const HOVER_MOVED: f32 = 0.001;

/// What is not yet stored.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Counters {
    /// Time in the air since the motors were armed, and the throttle that held the vehicle there.
    flown: Duration,
    hover: f64,
    counted: Duration,
    /// Seconds in the air that are not yet stored.
    flight_s: f64,
    was_armed: bool,
}

impl Autopilot {
    /// Counts time in the air and since boot, and tells the counters when they are stored: every 30 s and after a
    /// flight. To be called every [`LOOK`].
    pub(super) fn count(&mut self) {
        let now = self.uptime();
        let armed = self.safety.armed;
        let landed_again = self.counters.was_armed && !armed;
        self.counters.was_armed = armed;
        self.watch_hover();
        if !self.safety.landed {
            self.counters.flight_s += LOOK.as_secs_f64();
        }
        let due = now >= self.counters.counted + COUNTED_EVERY;
        if due || (landed_again && self.counters.flight_s >= 1.0) {
            let passed = now
                .as_secs()
                .saturating_sub(self.counters.counted.as_secs()) as f64;
            let flown = self.counters.flight_s.floor();
            self.counters.counted = now;
            self.counters.flight_s -= flown;
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
            self.store_parameter(name, sum as f32);
        }
    }

    /// Averages the throttle while the vehicle hovers, as `MOT_HOVER_LEARN` does.
    fn watch_hover(&mut self) {
        let still = self.body.velocity_m_s.z.abs() < HOVER_CLIMB_M_S;
        if self.safety.landed || !still {
            return;
        }
        let counters = &mut self.counters;
        if counters.flown.is_zero() {
            counters.hover = self.tuning.flight.pilot.hover();
        }
        counters.flown += LOOK;
        counters.hover +=
            (self.body.throttle - counters.hover) * LOOK.as_secs_f64() / HOVER_LEARNT_S;
    }

    /// After a flight the throttle that held the vehicle is the new hover throttle.
    fn learn_hover(&mut self) {
        let learned = self.counters.hover as f32;
        let known = self.parameters.value("MOT_THST_HOVER") as f32;
        let long_enough = self.counters.flown > LOOK * 10;
        self.counters.flown = Duration::ZERO;
        if long_enough && (learned - known).abs() > HOVER_MOVED {
            self.store_parameter("MOT_THST_HOVER", learned.clamp(0.125, 0.6875));
            self.retune();
        }
    }
}
