//! The estimate of a rover: the change to the simpler estimate while the EKF does not know the position, and the
//! failsafe of `FS_EKF_ACTION` (`ArduRover`'s `ekf_check`).

use mavlink::dialects::ardupilotmega::MavSeverity;

use super::ekf::{EkfChange, is_over};
use super::{Failsafe, FailsafeInputs};
use crate::mode::ModeId;
use crate::reaction::Reaction;

/// The values of `FS_EKF_ACTION`; with any other one, the vehicle enters HOLD.
const NOTHING: i32 = 0;
const REPORT: i32 = 2;

const HOLD: Reaction = Reaction::EnterFirst(&[ModeId::Hold]);

impl Failsafe {
    /// Whether a rover distrusts its estimate: modes that need a position are refused.
    pub(crate) fn distrusts_estimate(&self) -> bool {
        self.ekf.is_bad()
    }

    /// Whether the EKF was given up for the simpler estimate.
    pub(crate) fn falls_back(&self) -> bool {
        self.falls_back
    }

    pub(crate) fn watch_surface_estimate(&mut self, inputs: &FailsafeInputs<'_>) -> Vec<Reaction> {
        if !inputs.is_booted {
            return Vec::new();
        }
        let mut reactions = Vec::new();
        reactions.extend(self.watch_fallback(inputs));
        let threshold = inputs.rules.ekf_threshold;
        let change = if !inputs.armed || threshold <= 0.0 {
            self.ekf.reset()
        } else {
            let passed = !self.falls_back && !is_over(inputs.estimator, threshold);
            self.ekf.count(passed)
        };
        match change {
            Some(EkfChange::Begins) => {
                reactions.extend(self.ekf.say_variance(inputs.now));
                reactions.extend(surface_action(inputs));
            }
            Some(EkfChange::Ends) => {
                let text = "EKF failsafe cleared";
                reactions.push(Reaction::say(MavSeverity::MAV_SEVERITY_CRITICAL, text));
            }
            None => {}
        }
        reactions
    }

    fn watch_fallback(&mut self, inputs: &FailsafeInputs<'_>) -> Option<Reaction> {
        let estimator = inputs.estimator;
        let ignores_gps = inputs.armed && estimator.ignores_gps(inputs.now);
        let falls_back = ignores_gps || !estimator.has_position();
        if falls_back == self.falls_back {
            return None;
        }
        self.falls_back = falls_back;
        let text = if falls_back {
            "AHRS: DCM active"
        } else {
            "AHRS: EKF3 active"
        };
        Some(Reaction::say(MavSeverity::MAV_SEVERITY_INFO, text))
    }
}

/// The action in a mode that needs a position.
fn surface_action(inputs: &FailsafeInputs<'_>) -> Vec<Reaction> {
    let action = inputs.rules.ekf_action;
    if !inputs.mode.needs_position() || action == NOTHING {
        return Vec::new();
    }
    let hold = (action != REPORT).then_some(HOLD);
    let text = Reaction::say(MavSeverity::MAV_SEVERITY_CRITICAL, "EKF failsafe");
    hold.into_iter().chain([text]).collect()
}
