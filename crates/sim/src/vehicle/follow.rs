//! Following another vehicle: hearing it, and the place to keep to it.

use mavlink::dialects::ardupilotmega::MavSeverity;

use super::Vehicle;
use crate::leader::{FORGOTTEN, Leader, LeaderReport};
use crate::mode::ModeId;

/// What a vehicle that may follow keeps about the one to follow.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Following {
    pub(crate) leader: Option<Leader>,
    /// The system that became the leader by its report, since no other was set.
    chosen: Option<u8>,
    /// Whether the place to keep is the one where the following began.
    keeps_first_offset: bool,
}

impl Vehicle {
    /// Hears another vehicle's report of itself.
    pub(crate) fn hear_leader(&mut self, system: u8, report: &LeaderReport) {
        let Some(rules) = self.tuning.flight.follow else {
            return;
        };
        let now = self.uptime();
        let leader = Leader::new(report, &self.datum, now);
        let following = self.following.get_or_insert_default();
        if rules.system != 0 && rules.system != system {
            let heard = following.leader.as_ref().map(|leader| leader.heard);
            let silent = heard.is_none_or(|heard| now.saturating_sub(heard) > FORGOTTEN);
            if silent && following.chosen.take().is_some() {
                self.set_following("FOLL_SYSID", 0.0);
            }
            return;
        }
        following.leader = Some(leader);
        if rules.system == 0 {
            following.chosen = Some(system);
            self.set_following("FOLL_SYSID", f32::from(system));
        }
    }

    /// Keeps the place to the leader where the following began, if no other is set, until the mode ends.
    pub(crate) fn keep_offset(&mut self) {
        let Some((following, rules)) = self.following.as_ref().zip(self.tuning.flight.follow)
        else {
            return;
        };
        if self.flight.mode.id != ModeId::Follow {
            if following.keeps_first_offset {
                self.store_offset([0.0; 3], false);
            }
            return;
        }
        let now = self.uptime();
        let Some(leader) = following
            .leader
            .as_ref()
            .filter(|_| rules.offset_m == glam::DVec3::ZERO)
        else {
            return;
        };
        let Some(way_m) = leader.way_m(self.believed(), &rules, now) else {
            return;
        };
        let (offset_m, turns) = leader.offset_here(way_m, &rules, now);
        self.set_following("FOLL_OFS_TYPE", f32::from(u8::from(turns)));
        self.store_offset(offset_m.as_vec3().to_array(), true);
        let frame = if turns { "Relative" } else { "N-E-D" };
        let text = format!("{frame} follow offset loaded");
        self.say(MavSeverity::MAV_SEVERITY_INFO, &text);
    }

    fn store_offset(&mut self, offset_m: [f32; 3], is_first: bool) {
        for (name, value) in ["FOLL_OFS_X", "FOLL_OFS_Y", "FOLL_OFS_Z"]
            .iter()
            .zip(offset_m)
        {
            self.set_following(name, value);
        }
        if let Some(following) = &mut self.following {
            following.keeps_first_offset = is_first;
        }
    }

    /// Sets a parameter without storing it.
    fn set_following(&mut self, name: &str, value: f32) {
        self.parameters.set_until_boot(name, value);
        self.retune();
    }
}
