//! The breadcrumbs of a vehicle, for `SMART_RTL`.

use mavlink::dialects::ardupilotmega::MavSeverity;

use super::Vehicle;
use crate::mode::ModeId;
use crate::trail::TrailNews;

impl Vehicle {
    /// Whether the position is known, well or badly: to a rover always.
    pub(crate) fn knows_place(&self) -> bool {
        self.is_ready() || self.kind.chassis().is_some()
    }

    /// Starts the trail here, if the position is known.
    pub(crate) fn begin_trail(&mut self, known: bool) {
        let here_m = known.then(|| self.believed().position_m);
        let now = self.uptime();
        let rules = &self.tuning.flight.trail;
        self.flight.trail.begin(here_m, rules, now);
    }

    /// Drops a breadcrumb when one is due.
    pub(crate) fn watch_trail(&mut self) {
        let now = self.uptime();
        let here_m = self.knows_place().then(|| self.believed().position_m);
        let saves = self.safety.armed && self.flight.mode.id != ModeId::SmartRtl;
        let rules = &self.tuning.flight.trail;
        let trail = &mut self.flight.trail;
        let noted = saves.then(|| trail.note(here_m, rules, now)).flatten();
        let tended = trail.tend(rules, now);
        for news in noted.into_iter().chain(tended) {
            match news {
                TrailNews::Low => {
                    self.say(MavSeverity::MAV_SEVERITY_INFO, "SmartRTL Low on space!");
                }
                TrailNews::GivenUp(reason) => {
                    let text = format!("SmartRTL deactivated: {reason}");
                    self.say(MavSeverity::MAV_SEVERITY_WARNING, &text);
                }
            }
        }
    }
}
