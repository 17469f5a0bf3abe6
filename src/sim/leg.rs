//! A straight leg from rest to rest with limited jerk, planned once: what `ArduPilot` calls an S-curve.

use glam::DVec2;

/// The plan of one leg. Seven phases: jerk, constant acceleration, jerk, cruise, and the same backwards.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Leg {
    from_m: DVec2,
    direction: DVec2,
    length_m: f64,
    jerk_m_s3: f64,
    /// Lengths of the jerk, constant-acceleration and cruise phases, in seconds.
    jerk_s: f64,
    accel_s: f64,
    cruise_s: f64,
}

impl Leg {
    /// Plans a leg; where it is too short for the speed or the acceleration, neither is reached.
    pub(super) fn plan(
        from_m: DVec2,
        to_m: DVec2,
        speed_m_s: f64,
        accel_m_s2: f64,
        jerk_m_s3: f64,
    ) -> Self {
        let way = to_m - from_m;
        let length_m = way.length();
        // Half the way must suffice to reach the speed.
        let shortest_jerk_s = (length_m / (2.0 * jerk_m_s3)).cbrt();
        let jerk_s = (accel_m_s2 / jerk_m_s3)
            .min((speed_m_s / jerk_m_s3).sqrt())
            .min(shortest_jerk_s);
        let accel = jerk_m_s3 * jerk_s;
        let (accel_s, cruise_s) = if accel > 0.0 {
            let until_speed_s = (speed_m_s / accel - jerk_s).max(0.0);
            // Distance of one acceleration: accel (jerk_s + t) (2 jerk_s + t) / 2 <= length / 2.
            let b = 3.0 * jerk_s;
            let c = 2.0 * jerk_s * jerk_s - length_m / accel;
            let until_half_s = ((b * b - 4.0 * c).max(0.0).sqrt() - b) / 2.0;
            let accel_s = until_speed_s.min(until_half_s.max(0.0));
            let top = accel * (jerk_s + accel_s);
            let covered = top * (2.0 * jerk_s + accel_s);
            (accel_s, ((length_m - covered) / top).max(0.0))
        } else {
            (0.0, 0.0)
        };
        Self {
            from_m,
            direction: way.normalize_or_zero(),
            length_m,
            jerk_m_s3,
            jerk_s,
            accel_s,
            cruise_s,
        }
    }

    /// How long it takes, in seconds.
    pub(super) fn duration_s(&self) -> f64 {
        2.0 * self.ramp_s() + self.cruise_s
    }

    /// Position, velocity and acceleration at a time after the start.
    pub(super) fn at(&self, time_s: f64) -> (DVec2, DVec2, DVec2) {
        let total = self.duration_s();
        let (way, speed, accel) = if time_s >= total {
            (self.length_m, 0.0, 0.0)
        } else if time_s <= self.ramp_s() {
            self.ramp(time_s)
        } else if time_s <= self.ramp_s() + self.cruise_s {
            let (way, speed, _) = self.ramp(self.ramp_s());
            (way + speed * (time_s - self.ramp_s()), speed, 0.0)
        } else {
            let (way, speed, accel) = self.ramp(total - time_s);
            (self.length_m - way, speed, -accel)
        };
        (
            self.from_m + self.direction * way,
            self.direction * speed,
            self.direction * accel,
        )
    }

    fn ramp_s(&self) -> f64 {
        2.0 * self.jerk_s + self.accel_s
    }

    /// Way, speed and acceleration while speeding up.
    fn ramp(&self, time_s: f64) -> (f64, f64, f64) {
        let (jerk, tj) = (self.jerk_m_s3, self.jerk_s);
        let cubic = |t: f64, way: f64, speed: f64, accel: f64, jerk: f64| {
            (
                way + speed * t + accel * t * t / 2.0 + jerk * t * t * t / 6.0,
                speed + accel * t + jerk * t * t / 2.0,
                accel + jerk * t,
            )
        };
        let first = cubic(time_s.min(tj), 0.0, 0.0, 0.0, jerk);
        let second_s = (time_s - tj).clamp(0.0, self.accel_s);
        let second = cubic(second_s, first.0, first.1, first.2, 0.0);
        let third_s = (time_s - tj - self.accel_s).clamp(0.0, tj);
        cubic(
            third_s,
            second.0,
            second.1,
            second.2,
            if third_s > 0.0 { -jerk } else { 0.0 },
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn a_leg_ends_at_its_goal_and_keeps_its_limits(length in 0.0..2000.0f64, speed in 0.5..20.0f64, accel in 0.3..5.0f64, jerk in 0.3..5.0f64) {
            let leg = Leg::plan(DVec2::ZERO, DVec2::new(0.0, length), speed, accel, jerk);
            let total = leg.duration_s();
            prop_assert!(total.is_finite());
            prop_assert!((leg.at(total).0.y - length).abs() < 1e-6);
            let mut last = 0.0;
            for i in 0..=400 {
                let (p, v, a) = leg.at(total * f64::from(i) / 400.0);
                prop_assert!(v.length() <= speed + 1e-6 && a.length() <= accel + 1e-6);
                prop_assert!(p.y + 1e-6 >= last, "goes back");
                last = p.y;
            }
            // Continuous across the middle: no jump in position.
            let (before, after) = (leg.at(total / 2.0 - 1e-6).0.y, leg.at(total / 2.0 + 1e-6).0.y);
            prop_assert!((after - before).abs() < 1e-3);
        }
    }
}
