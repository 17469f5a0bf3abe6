//! Whether a vehicle's fence is on: by its reports and its parameters, which may be older.

use super::{FencePlan, Transfer, Vehicle};

impl Vehicle {
    /// Whether the vehicle reports that its fence is on; `None` without a fence
    /// ([`Health::fence_on`](super::Health::fence_on)).
    pub fn reports_fence_on(&self) -> Option<bool> {
        self.health?.fence_on()
    }

    /// The areas of the vehicle's fence, if it reports that the fence is on, and they have been
    /// read.
    pub fn fence_in_force(&self) -> Option<&FencePlan> {
        let stored = &self.plans.fence;
        let is_on = self.reports_fence_on() == Some(true);
        let content = stored.content.as_deref();
        content.filter(|_| is_on && stored.transfer == Transfer::Done)
    }
}

/// The switch of a fence.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct FenceSwitch {
    /// Whether the fence is on, if known.
    pub is_on: Option<bool>,
    /// The state to which a command may have switched the fence: it differs from `FENCE_ENABLE`,
    /// which has not been read, or was read before the command.
    pub by_command: Option<bool>,
}

impl FenceSwitch {
    /// The switch according to the vehicle's report ([`Health::fence_on`](super::Health::fence_on))
    /// and to its parameters as last read. A command that switches the fence changes `FENCE_ENABLE`
    /// without reporting it.
    pub fn of(reported: Option<bool>, parameter: impl Fn(&str) -> Option<f32>) -> Self {
        let stored = parameter("FENCE_ENABLE").map(|value| value > 0.0);
        // A fence that only reports breaches is always reported as off.
        let only_reports = parameter("FENCE_ACTION").is_some_and(|value| value < 0.5);
        let current = reported.filter(|_| !only_reports);
        let differs = |on: &bool| stored != Some(*on);
        Self {
            is_on: current.or(stored),
            by_command: current.filter(differs),
        }
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;
    use std::time::Duration;

    use super::*;
    use crate::vehicle::{Health, Stored};

    /// Only the current report that the fence is on counts, not an earlier one.
    #[test]
    fn a_fence_is_in_force_if_it_is_on_and_read() {
        let mut vehicle = Vehicle::new(1, 1);
        vehicle.plans.fence = Stored {
            content: Some(Arc::new(FencePlan::default())),
            transfer: Transfer::Done,
        };
        assert_eq!(vehicle.fence_in_force(), None, "nothing is reported");
        for (enabled, is_in_force) in [(Health::FENCE, true), (0, false)] {
            vehicle.health = Some(Health {
                present: Health::FENCE,
                enabled,
                healthy: 0,
                load_percent: 0.0,
                at: Duration::ZERO,
            });
            assert_eq!(vehicle.fence_in_force().is_some(), is_in_force);
        }
        vehicle.health = vehicle.health.map(|health| Health {
            enabled: Health::FENCE,
            ..health
        });
        vehicle.plans.fence.transfer = Transfer::Failed;
        assert_eq!(vehicle.fence_in_force(), None, "it may have changed");
    }

    #[test]
    fn the_report_counts_more_than_a_parameter_that_was_read_before() {
        let switch = |reported, enable: Option<f32>, action: f32| {
            let switch = FenceSwitch::of(reported, |name| match name {
                "FENCE_ENABLE" => enable,
                "FENCE_ACTION" => Some(action),
                _ => None,
            });
            (switch.is_on, switch.by_command)
        };
        let on = Some(true);
        assert_eq!(switch(on, Some(0.0), 1.0), (on, on), "`fence on`");
        assert_eq!(
            switch(Some(false), Some(1.0), 1.0),
            (Some(false), Some(false))
        );
        assert_eq!(switch(on, Some(1.0), 1.0), (on, None));
        assert_eq!(switch(on, None, 1.0), (on, on), "nothing is read yet");
        assert_eq!(switch(None, Some(1.0), 1.0), (on, None));
        assert_eq!(
            switch(Some(false), Some(1.0), 0.0),
            (on, None),
            "it only reports"
        );
        assert_eq!(switch(None, None, 1.0), (None, None));
    }
}
