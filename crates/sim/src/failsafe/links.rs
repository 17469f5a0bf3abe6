//! The links to the ground: the ground station's heartbeats and the remote control.

use std::time::Duration;

use mavlink::dialects::ardupilotmega::MavSeverity;

use super::{Failsafe, FailsafeInputs, Options, RadioInputs, announce};
use crate::estimator::RadioFault;
use crate::mode::ModeId;
use crate::radio::Sticks;
use crate::reaction::{FailsafeAction, Reaction};

/// How long the throttle must be low before it counts, at 50 frames per second.
const LOW_FOR: Duration = Duration::from_millis(50);
/// The throttle of a receiver that has lost its transmitter, in microseconds.
const LOST_THROTTLE_US: f64 = 950.0;

/// The state of the links.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct LinkWatch {
    station_lost: bool,
    radio_lost: bool,
    /// The time at which the remote control fell silent, or its throttle became too low.
    radio_bad_since: Option<Duration>,
}

impl LinkWatch {
    pub(super) fn station_is_lost(&self) -> bool {
        self.station_lost
    }

    pub(super) fn radio_is_lost(&self) -> bool {
        self.radio_lost
    }
}

impl RadioInputs {
    /// A receiver's output: the throttle of a lost transmitter, or that of the sticks.
    pub(crate) fn new(
        fault: RadioFault,
        is_overridden: bool,
        was_heard: bool,
        sticks: &Sticks,
    ) -> Self {
        let is_lost = fault == RadioFault::Low && !is_overridden;
        Self {
            fault,
            is_overridden,
            was_heard,
            throttle_us: if is_lost {
                LOST_THROTTLE_US
            } else {
                f64::from(sticks.channels_us[2])
            },
        }
    }
}

impl Failsafe {
    /// Checks for the loss of the ground station.
    pub(crate) fn watch_station(&mut self, inputs: &FailsafeInputs<'_>) -> Vec<Reaction> {
        let Some(heard) = self.heard else {
            return Vec::new();
        };
        if inputs.rules.ground_station == 0 {
            return Vec::new();
        }
        let lost = inputs.now > heard + inputs.rules.ground_station_timeout;
        if lost == self.links.station_lost {
            return Vec::new();
        }
        self.links.station_lost = lost;
        if lost {
            // The ground station's override of the sticks ends as well.
            let mut reactions = vec![Reaction::ReleaseSticks];
            reactions.extend(self.lose_station(&FailsafeInputs {
                throttle_is_low: Sticks::RELEASED.throttle_is_low(),
                ..*inputs
            }));
            reactions
        } else {
            vec![Reaction::say(
                MavSeverity::MAV_SEVERITY_WARNING,
                "GCS Failsafe Cleared",
            )]
        }
    }

    fn lose_station(&self, inputs: &FailsafeInputs<'_>) -> Vec<Reaction> {
        let options = inputs.rules.options;
        let action = match inputs.rules.ground_station {
            3 => FailsafeAction::PathBackOrReturn,
            4 => FailsafeAction::PathBackOrLand,
            5 => FailsafeAction::Land,
            6 => FailsafeAction::PlannedLanding,
            7 => FailsafeAction::BrakeOrLand,
            _ => FailsafeAction::Return,
        };
        let continues_piloted = !inputs.mode.autonomous
            && inputs.mode.id != ModeId::Land
            && options.has(Options::STATION_CONTINUES_PILOTED);
        if !inputs.armed {
            vec![announce("GCS", None)]
        } else if inputs.should_disarm() {
            vec![Reaction::Disarm, announce("GCS", Some("Disarming"))]
        } else if inputs.is_landing && self.battery.wants_to_land() {
            go_on_landing("GCS + Battery")
        } else if inputs.goes_on_landing() {
            go_on_landing("GCS")
        } else if inputs.mode.id == ModeId::Auto && options.has(Options::STATION_CONTINUES_AUTO) {
            vec![announce("GCS", Some("Continuing Auto Mode"))]
        } else if continues_piloted {
            vec![announce("GCS", Some("Continuing Pilot Control"))]
        } else {
            vec![announce("GCS", None), Reaction::Act(action)]
        }
    }

    /// Whether [`Failsafe::watch_radio`] has to be called: it is not needed while the remote control works.
    pub(crate) fn doubts_radio(&self, fault: RadioFault) -> bool {
        fault != RadioFault::Fine || self.links.radio_lost || self.links.radio_bad_since.is_some()
    }

    /// Checks for the loss of the remote control.
    pub(crate) fn watch_radio(&mut self, inputs: &FailsafeInputs<'_>) -> Vec<Reaction> {
        let low = inputs.radio.throttle_us < inputs.rules.radio_low_us;
        let delay = match inputs.radio.fault {
            _ if inputs.rules.radio == 0 => None,
            // A remote control that was never heard is not lost, unless the vehicle flies.
            RadioFault::Silent if !inputs.armed && !inputs.radio.was_heard => None,
            RadioFault::Silent if !inputs.radio.is_overridden => Some(inputs.rules.radio_timeout),
            _ if low => Some(LOW_FOR),
            RadioFault::Fine | RadioFault::Silent | RadioFault::Low => None,
        };
        let Some(delay) = delay else {
            self.links.radio_bad_since = None;
            let was_lost = std::mem::take(&mut self.links.radio_lost);
            let cleared = was_lost.then(|| {
                Reaction::say(MavSeverity::MAV_SEVERITY_WARNING, "Radio Failsafe Cleared")
            });
            return cleared.into_iter().collect();
        };
        let since = *self.links.radio_bad_since.get_or_insert(inputs.now);
        if self.links.radio_lost || inputs.now < since + delay {
            return Vec::new();
        }
        self.links.radio_lost = true;
        self.lose_radio(inputs)
    }

    fn lose_radio(&self, inputs: &FailsafeInputs<'_>) -> Vec<Reaction> {
        let options = inputs.rules.options;
        let action = match inputs.rules.radio {
            1 | 2 => FailsafeAction::Return,
            4 => FailsafeAction::PathBackOrReturn,
            5 => FailsafeAction::PathBackOrLand,
            6 => FailsafeAction::PlannedLanding,
            7 => FailsafeAction::BrakeOrLand,
            _ => FailsafeAction::Land,
        };
        let in_auto = inputs.mode.id == ModeId::Auto;
        let in_guided = inputs.mode.id == ModeId::Guided;
        if inputs.should_disarm() {
            vec![announce("Radio", Some("Disarming")), Reaction::Disarm]
        } else if inputs.is_landing && self.battery.wants_to_land() {
            go_on_landing("Radio + Battery")
        } else if inputs.goes_on_landing() {
            go_on_landing("Radio")
        } else if in_auto && options.has(Options::RADIO_CONTINUES_AUTO) {
            vec![announce("Radio", Some("Continuing Auto"))]
        } else if in_guided && options.has(Options::RADIO_CONTINUES_GUIDED) {
            vec![announce("Radio", Some("Continuing Guided Mode"))]
        } else {
            vec![announce("Radio", None), Reaction::Act(action)]
        }
    }
}

fn go_on_landing(what: &str) -> Vec<Reaction> {
    vec![
        announce(what, Some("Continuing Landing")),
        Reaction::Act(FailsafeAction::Land),
    ]
}
