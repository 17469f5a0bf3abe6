//! The failsafes of a rover (`ArduRover`'s `failsafe_trigger`): any lost link for longer than `FS_TIMEOUT` triggers the
//! action of `FS_ACTION`.

use std::time::Duration;

use mavlink::dialects::ardupilotmega::MavSeverity;

use super::{Failsafe, FailsafeInputs};
use crate::estimator::RadioFault;
use crate::mode::ModeId;
use crate::parameters::Parameters;
use crate::reaction::{FailsafeAction, Reaction};

/// A receiver that is silent for this long is lost.
const SILENT_FOR: Duration = Duration::from_millis(500);
/// The value of `FS_GCS_ENABLE` and `FS_THR_ENABLE` with which a mission continues.
const CONTINUES_MISSION: i32 = 2;

/// The rules from the `FS_*` parameters of a rover.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct SurfaceRules {
    action: i32,
    after: Duration,
    acts_in_hold: bool,
}

impl SurfaceRules {
    pub(super) fn read(all: &Parameters) -> Self {
        Self {
            action: all.value("FS_ACTION") as i32,
            after: Duration::from_secs_f64(all.value("FS_TIMEOUT").clamp(0.0, 1e6)),
            acts_in_hold: all.value("FS_OPTIONS") as i32 & 1 != 0,
        }
    }
}

/// A link that can be lost.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum SurfaceLink {
    Station,
    Radio,
}

/// The lost links, and whether they have triggered.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct SurfaceWatch {
    station_lost: bool,
    pub(super) radio_lost: bool,
    since: Duration,
    pub(super) triggered: bool,
    silent_since: Option<Duration>,
}

impl Failsafe {
    /// Checks the links of a rover.
    pub(crate) fn watch_surface_links(&mut self, inputs: &FailsafeInputs<'_>) -> Vec<Reaction> {
        let mut reactions = Vec::new();
        // The check that finds the time to be up names its own link, whichever was lost: the radio's comes first.
        if inputs.rules.radio != 0 {
            let lost = self.surface.hears_nothing(inputs);
            reactions.extend(self.surface.trigger(SurfaceLink::Radio, lost, inputs));
        }
        if let Some(heard) = self.heard.filter(|_| inputs.rules.ground_station != 0) {
            let lost = inputs.now >= heard + inputs.rules.ground_station_timeout;
            reactions.extend(self.surface.trigger(SurfaceLink::Station, lost, inputs));
        }
        reactions
    }
}

impl SurfaceWatch {
    fn hears_nothing(&mut self, inputs: &FailsafeInputs<'_>) -> bool {
        let radio = &inputs.radio;
        let is_silent = radio.fault == RadioFault::Silent && !radio.is_overridden;
        if !is_silent {
            self.silent_since = None;
            return radio.throttle_us < inputs.rules.radio_low_us;
        }
        let since = *self.silent_since.get_or_insert(inputs.now);
        inputs.now > since + SILENT_FOR
    }

    /// Notes the state of a link; returns whether any is lost.
    fn note(&mut self, link: SurfaceLink, lost: bool, now: Duration) -> bool {
        let was_lost = self.station_lost || self.radio_lost;
        match link {
            SurfaceLink::Station => self.station_lost = lost,
            SurfaceLink::Radio => self.radio_lost = lost,
        }
        let is_lost = self.station_lost || self.radio_lost;
        if is_lost && !was_lost {
            self.since = now;
        }
        is_lost
    }

    fn trigger(
        &mut self,
        link: SurfaceLink,
        lost: bool,
        inputs: &FailsafeInputs<'_>,
    ) -> Vec<Reaction> {
        let (name, enabled) = match link {
            SurfaceLink::Station => ("GCS", inputs.rules.ground_station),
            SurfaceLink::Radio => ("Radio", inputs.rules.radio),
        };
        let is_lost = self.note(link, lost, inputs.now);
        let mut reactions = Vec::new();
        if self.triggered && !is_lost {
            self.triggered = false;
            let text = format!("{name} Failsafe Cleared");
            reactions.push(Reaction::Say(MavSeverity::MAV_SEVERITY_INFO, text));
        }
        let rules = &inputs.rules.surface;
        let is_safe = inputs.mode.id == ModeId::Rtl
            || (inputs.mode.id == ModeId::Hold && !rules.acts_in_hold);
        if self.triggered || !is_lost || is_safe || inputs.now <= self.since + rules.after {
            return reactions;
        }
        self.triggered = true;
        let text = format!("{name} Failsafe");
        reactions.push(Reaction::Say(MavSeverity::MAV_SEVERITY_WARNING, text));
        reactions.push(Reaction::ReleaseSticks);
        if inputs.mode.id == ModeId::Auto && enabled == CONTINUES_MISSION {
            let text = "Failsafe - Continuing Auto Mode";
            reactions.push(Reaction::say(MavSeverity::MAV_SEVERITY_WARNING, text));
        } else {
            reactions.push(Reaction::Act(FailsafeAction::of_rover(rules.action)));
        }
        reactions
    }
}
