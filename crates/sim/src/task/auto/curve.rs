//! Motion along a line whose snap is limited: `ArduPilot`'s S-curve.
//!
//! Its jerk rises and falls as a raised cosine. Such a profile is the sum of a few smoothed steps
//! of jerk, and every smoothed step has a closed form, so no table of segments is needed.

use sortie_geo::maths;
use std::f64::consts::PI;

/// Steps of a bisection: enough for a hundredth of a millimetre.
const HALVINGS: usize = 40;
/// Speeds closer than this are the same, metres per second.
const SAME_SPEED_M_S: f64 = 1e-6;

/// The limits of a curve along its line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct CurveBounds {
    pub(super) speed_m_s: f64,
    pub(super) accel_m_s2: f64,
    pub(super) jerk_m_s3: f64,
    pub(super) snap_m_s4: f64,
}

/// One change of the jerk, smoothed over a rise time.
#[derive(Debug, Clone, Copy, PartialEq)]
struct CurveStep {
    at_s: f64,
    jerk_m_s3: f64,
    rise_s: f64,
}

/// Distance, speed and acceleration along the line.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Motion {
    pub(super) way_m: f64,
    pub(super) speed_m_s: f64,
    pub(super) accel_m_s2: f64,
}

/// A motion from rest to rest over a length.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct SpeedCurve {
    length_m: f64,
    steps: Vec<CurveStep>,
    top_m_s: f64,
    /// The times at which the constant acceleration, all acceleration, and the cruise end.
    pub(super) turn_in_s: f64,
    ramp_end_s: f64,
    pub(super) brake_s: f64,
    pub(super) end_s: f64,
}

/// A change of speed with no acceleration at either end: four steps of jerk.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Ramp {
    from_m_s: f64,
    to_m_s: f64,
    jerk_m_s3: f64,
    rise_s: f64,
    /// The duration of the jerk of one sign, and the start of the other.
    block_s: f64,
    gap_s: f64,
}

impl Ramp {
    fn between(from_m_s: f64, to_m_s: f64, bounds: &CurveBounds) -> Self {
        let change = (to_m_s - from_m_s).abs();
        let sign = (to_m_s - from_m_s).signum();
        let nothing = Self {
            from_m_s,
            to_m_s,
            jerk_m_s3: 0.0,
            rise_s: 0.0,
            block_s: 0.0,
            gap_s: 0.0,
        };
        if change < SAME_SPEED_M_S {
            return nothing;
        }
        let (jerk, snap) = (bounds.jerk_m_s3, bounds.snap_m_s4);
        let rise = jerk * PI / (2.0 * snap);
        let peak = (jerk * ((rise * rise + 4.0 * change / jerk).sqrt() - rise) / 2.0)
            .min(bounds.accel_m_s2);
        let (jerk, rise, block, gap) = if peak >= jerk * rise {
            (jerk, rise, peak / jerk, change / peak)
        } else if from_m_s.min(to_m_s) < SAME_SPEED_M_S {
            let rise = rise
                .min(maths::cbrt(change * PI / (4.0 * snap)))
                .min((bounds.accel_m_s2 * PI / (2.0 * snap)).sqrt());
            let jerk = 2.0 * snap * rise / PI;
            (jerk, rise, rise, (change / (jerk * rise)).max(2.0 * rise))
        } else {
            let peak = bounds.accel_m_s2.min(change / (2.0 * rise));
            (peak / rise, rise, rise, change / peak)
        };
        Self {
            jerk_m_s3: sign * jerk,
            rise_s: rise,
            block_s: block,
            gap_s: gap,
            ..nothing
        }
    }

    fn duration_s(&self) -> f64 {
        self.gap_s + self.block_s + self.rise_s
    }

    fn length_m(&self) -> f64 {
        f64::midpoint(self.from_m_s, self.to_m_s) * self.duration_s()
    }

    fn steps(&self, at_s: f64) -> impl Iterator<Item = CurveStep> {
        let (jerk, rise_s) = (self.jerk_m_s3, self.rise_s);
        [
            (0.0, jerk),
            (self.block_s, -jerk),
            (self.gap_s, -jerk),
            (self.gap_s + self.block_s, jerk),
        ]
        .into_iter()
        .filter(|(_, jerk)| *jerk != 0.0)
        .map(move |(after_s, jerk_m_s3)| CurveStep {
            at_s: at_s + after_s,
            jerk_m_s3,
            rise_s,
        })
    }
}

impl CurveStep {
    /// Adds the motion of this step to a sum, once it has begun.
    fn add(&self, now_s: f64, sum: &mut Motion) {
        let t = now_s - self.at_s;
        if t <= 0.0 {
            return;
        }
        let (first, second, third) = if t < self.rise_s {
            let beta = PI / self.rise_s;
            let (sin, cos) = maths::sin_cos(beta * t);
            (
                t / 2.0 - sin / (2.0 * beta),
                t * t / 4.0 + (cos - 1.0) / (2.0 * beta * beta),
                t * t * t / 12.0 - t / (2.0 * beta * beta) + sin / (2.0 * maths::powi(beta, 3)),
            )
        } else {
            // Once complete, a step smoothed by a half sine equals a step at its middle, spread by its variance.
            let late = t - self.rise_s / 2.0;
            let spread = self.rise_s * self.rise_s * (0.25 - 2.0 / (PI * PI));
            (
                late,
                f64::midpoint(late * late, spread),
                (maths::powi(late, 3) + 3.0 * late * spread) / 6.0,
            )
        };
        sum.accel_m_s2 += self.jerk_m_s3 * first;
        sum.speed_m_s += self.jerk_m_s3 * second;
        sum.way_m += self.jerk_m_s3 * third;
    }
}

impl SpeedCurve {
    /// Plans from rest to rest; a line too short for the speed has a lower top speed.
    pub(super) fn plan(length_m: f64, bounds: &CurveBounds) -> Self {
        let half = |top: f64| Ramp::between(0.0, top, bounds).length_m() <= length_m / 2.0;
        let top_m_s = largest(0.0, bounds.speed_m_s, half);
        let ramp = Ramp::between(0.0, top_m_s, bounds);
        let mut curve = Self {
            length_m,
            steps: ramp.steps(0.0).collect(),
            top_m_s,
            turn_in_s: ramp.gap_s,
            ramp_end_s: ramp.duration_s(),
            brake_s: ramp.duration_s(),
            end_s: 0.0,
        };
        curve.cruise_and_brake(top_m_s, bounds);
        curve
    }

    /// The motion at a time after the start.
    pub(super) fn at(&self, now_s: f64) -> Motion {
        if now_s >= self.end_s {
            return Motion {
                way_m: self.length_m,
                ..Motion::default()
            };
        }
        let mut sum = Motion::default();
        for step in &self.steps {
            step.add(now_s, &mut sum);
        }
        sum.way_m = sum.way_m.clamp(0.0, self.length_m);
        sum.speed_m_s = sum.speed_m_s.max(0.0);
        sum
    }

    /// Changes the top speed on the way. A speed that no longer fits into the remaining length has no effect.
    pub(super) fn change_speed(&mut self, now_s: f64, bounds: &CurveBounds) {
        let wanted_m_s = bounds.speed_m_s;
        if now_s >= self.brake_s || (wanted_m_s - self.top_m_s).abs() < SAME_SPEED_M_S {
            return;
        }
        if now_s <= 0.0 {
            *self = Self::plan(self.length_m, bounds);
            return;
        }
        let mut changed = self.clone();
        changed.steps.retain(|step| step.at_s < self.brake_s);
        if wanted_m_s < self.top_m_s && now_s < self.ramp_end_s {
            changed.cut_ramp(now_s);
        }
        let from_s = now_s.max(changed.ramp_end_s);
        changed.end_s = f64::INFINITY;
        let from = changed.sum(from_s);
        let fits = |top: f64| {
            from.way_m
                + Ramp::between(from.speed_m_s, top, bounds).length_m()
                + Ramp::between(0.0, top, bounds).length_m()
                <= self.length_m
        };
        let top_m_s = if wanted_m_s > from.speed_m_s {
            largest(from.speed_m_s, wanted_m_s, fits)
        } else {
            wanted_m_s
        };
        if !fits(top_m_s) {
            return;
        }
        let ramp = Ramp::between(from.speed_m_s, top_m_s, bounds);
        changed.steps.extend(ramp.steps(from_s));
        changed.ramp_end_s = from_s + ramp.duration_s();
        changed.cruise_and_brake(top_m_s, bounds);
        *self = changed;
    }

    /// Ends an acceleration early: steps that have not begun are dropped, and the acceleration returns to zero.
    fn cut_ramp(&mut self, now_s: f64) {
        let begun = self.steps.iter().filter(|step| step.at_s <= now_s).count();
        let Some(first) = self.steps.first().copied() else {
            return;
        };
        let step = |at_s: f64, jerk_m_s3: f64| CurveStep {
            at_s,
            jerk_m_s3,
            ..first
        };
        let block_s = match begun {
            1 => now_s - first.at_s,
            2 => self.steps.get(1).map_or(0.0, |end| end.at_s) - first.at_s,
            _ => return,
        };
        self.steps.truncate(begun);
        if begun == 1 {
            self.steps.push(step(now_s, -first.jerk_m_s3));
        }
        self.steps.push(step(now_s, -first.jerk_m_s3));
        self.steps.push(step(now_s + block_s, first.jerk_m_s3));
        self.turn_in_s = now_s;
        self.ramp_end_s = now_s + block_s + first.rise_s;
    }

    fn cruise_and_brake(&mut self, top_m_s: f64, bounds: &CurveBounds) {
        let brake = Ramp::between(top_m_s, 0.0, bounds);
        let left_m = self.length_m - self.sum(self.ramp_end_s).way_m - brake.length_m();
        let cruise_s = if top_m_s > SAME_SPEED_M_S {
            left_m.max(0.0) / top_m_s
        } else {
            0.0
        };
        self.top_m_s = top_m_s;
        self.brake_s = self.ramp_end_s + cruise_s;
        self.end_s = self.brake_s + brake.duration_s();
        self.steps.extend(brake.steps(self.brake_s));
    }

    fn sum(&self, now_s: f64) -> Motion {
        let mut sum = Motion::default();
        for step in &self.steps {
            step.add(now_s, &mut sum);
        }
        sum
    }
}

/// The largest value between `low` and `high` that satisfies `holds`, which is true for small values.
fn largest(low: f64, high: f64, holds: impl Fn(f64) -> bool) -> f64 {
    if holds(high) {
        return high;
    }
    let (mut low, mut high) = (low, high);
    for _ in 0..HALVINGS {
        let middle = f64::midpoint(low, high);
        if holds(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    low
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// `WPNAV_ACCEL` 2.5, `WPNAV_JERK` 1, `ATC_INPUT_TC` 0.15.
    fn usual(speed_m_s: f64) -> CurveBounds {
        CurveBounds {
            speed_m_s,
            accel_m_s2: 2.5,
            jerk_m_s3: 1.0,
            snap_m_s4: 5.24,
        }
    }

    fn check(curve: &SpeedCurve, fastest: f64) -> Result<(), TestCaseError> {
        let mut last = curve.at(0.0);
        for i in 1..=2000 {
            let now = curve.end_s * f64::from(i) / 2000.0;
            let motion = curve.at(now);
            prop_assert!(motion.way_m + 1e-6 >= last.way_m, "goes back");
            prop_assert!(motion.speed_m_s <= fastest + 1e-6, "too fast");
            prop_assert!(motion.accel_m_s2.abs() <= 2.5 + 1e-6, "too hard");
            let step_m = fastest * curve.end_s / 2000.0;
            prop_assert!(motion.way_m - last.way_m <= step_m + 1e-3, "jumps");
            last = motion;
        }
        Ok(())
    }

    proptest! {
        #[test]
        fn a_curve_runs_from_rest_to_rest_within_its_bounds(length in 0.01..3000.0f64, speed in 0.2..20.0f64) {
            let curve = SpeedCurve::plan(length, &usual(speed));
            prop_assert!(curve.end_s.is_finite());
            prop_assert!((curve.at(curve.end_s - 1e-9).way_m - length).abs() < 1e-3);
            check(&curve, speed)?;
        }

        #[test]
        fn a_change_of_speed_on_the_way_still_ends_at_rest_at_the_goal(length in 20.0..1000.0f64, first in 1.0..15.0f64, then in 1.0..15.0f64, share in 0.0..1.0f64) {
            let mut curve = SpeedCurve::plan(length, &usual(first));
            let now = curve.end_s * share;
            let before = curve.at(now);
            curve.change_speed(now, &usual(then));
            prop_assert!((curve.at(now).way_m - before.way_m).abs() < 1e-6);
            prop_assert!((curve.at(curve.end_s - 1e-9).way_m - length).abs() < 1e-3);
            check(&curve, first.max(then))?;
        }
    }

    #[test]
    fn a_later_higher_speed_shortens_the_time_and_a_lower_one_lengthens_it() {
        let plain = SpeedCurve::plan(200.0, &usual(5.0));
        let mut faster = plain.clone();
        faster.change_speed(10.0, &usual(10.0));
        let mut slower = plain.clone();
        slower.change_speed(1.0, &usual(2.0));
        assert!(faster.end_s < plain.end_s - 5.0, "{}", faster.end_s);
        assert!(slower.end_s > plain.end_s + 40.0, "{}", slower.end_s);
    }
}
