//! The comparison of the inertial sensors before arming.

use std::time::Duration;

use crate::estimator::Faults;

/// The sensors count as consistent again after they have agreed for this long.
const AGREES_FOR: Duration = Duration::from_secs(10);

/// When the accelerometers, and the gyros, last disagreed.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct ImuWatch([Option<Duration>; 2]);

impl ImuWatch {
    /// Compares the sensors; to be called once a second.
    pub(crate) fn look(&mut self, faults: &Faults, now: Duration) {
        for (last, differs) in self.0.iter_mut().zip(faults.inertial_differences) {
            if differs {
                *last = Some(now);
            }
        }
    }

    /// Whether the accelerometers, and the gyros, disagree or did so until recently.
    pub(crate) fn doubts(&self, faults: &Faults, now: Duration) -> [bool; 2] {
        let [accelerometers, gyros] = self.0;
        let recently = |last: Option<Duration>| last.is_some_and(|at| now < at + AGREES_FOR);
        let [accelerometers_differ, gyros_differ] = faults.inertial_differences;
        [
            accelerometers_differ || recently(accelerometers),
            gyros_differ || recently(gyros),
        ]
    }
}
