//! A controller with a filtered error (`AC_PID`).

use crate::kinematics::STEP_S;
use crate::parameters::Parameters;

/// The gains of a controller.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct PidGains {
    pub(super) p: f64,
    pub(super) i: f64,
    pub(super) d: f64,
    pub(super) i_max: f64,
    /// The frequency of the error's filter in hertz; 0 for none.
    pub(super) filter_hz: f64,
}

impl PidGains {
    /// The gains in a group of parameters.
    pub(super) fn read(all: &Parameters, group: &str) -> Self {
        let of = |end: &str| all.value(&format!("{group}_{end}"));
        Self {
            p: of("P"),
            i: of("I"),
            d: of("D"),
            i_max: of("IMAX"),
            filter_hz: of("FLTE"),
        }
    }
}

/// The state of a controller.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Pid {
    error: Option<f64>,
    integral: f64,
}

impl Pid {
    /// The output for an aim and a measurement. While the output is limited, the integral may only shrink.
    pub(super) fn step(
        &mut self,
        [aim, measured]: [f64; 2],
        limited: bool,
        gains: &PidGains,
    ) -> f64 {
        let raw = aim - measured;
        let before = self.error;
        let error = match before {
            Some(last) if gains.filter_hz > 0.0 => {
                let lag_s = 1.0 / (std::f64::consts::TAU * gains.filter_hz);
                last + (raw - last) * (STEP_S / (STEP_S + lag_s))
            }
            _ => raw,
        };
        self.error = Some(error);
        let shrinks = self.integral * error < 0.0;
        if !limited || shrinks {
            let grown = self.integral + error * gains.i * STEP_S;
            self.integral = grown.clamp(-gains.i_max, gains.i_max);
        }
        let slope = before.map_or(0.0, |last| (error - last) / STEP_S);
        error * gains.p + self.integral + slope * gains.d
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_integral_grows_only_while_the_output_is_free() {
        let gains = PidGains {
            p: 0.0,
            i: 1.0,
            d: 0.0,
            i_max: 1.0,
            filter_hz: 0.0,
        };
        let mut pid = Pid::default();
        assert!(pid.step([1.0, 0.0], true, &gains).abs() < 1e-9);
        for _ in 0..50 {
            pid.step([1.0, 0.0], false, &gains);
        }
        let held = pid.step([1.0, 0.0], true, &gains);
        assert!((held - 0.5).abs() < 1e-9, "{held}");
        let less = pid.step([-1.0, 0.0], true, &gains);
        assert!(less < held, "it may always shrink");
    }
}
