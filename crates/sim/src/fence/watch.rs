//! The fences in operation: switching, breaches, slowing down, reports.

use std::time::Duration;

use glam::DVec3;
use mavlink::dialects::ardupilotmega::{FenceBreach, FenceMitigate};

use super::avoidance::Edges;
use super::{
    AREAS, CEILING, CIRCLE, FLOOR, Fence, FenceError, FencePosition, FenceRules, Geofence,
};
use crate::control::Limits;
use crate::mode::ModeId;
use crate::plan::Item;
use crate::reaction::{FailsafeAction, Reaction};
use sortie_geo::LatLon;

/// A vehicle this far outside, in metres, lands where it is.
const GIVE_UP_M: f64 = 100.0;
/// The minimum time between unrequested reports of a breach.
const TELL_EVERY: Duration = Duration::from_secs(1);

/// The fence's state in `FENCE_STATUS`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct FenceReport {
    pub(crate) is_broken: bool,
    pub(crate) breaches: u16,
    pub(crate) kind: FenceBreach,
    pub(crate) broken_since: Duration,
    pub(crate) mitigation: FenceMitigate,
}

/// The fence's state in `SYS_STATUS`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct FenceHealth {
    pub(crate) is_present: bool,
    pub(crate) is_enabled: bool,
    pub(crate) is_healthy: bool,
}

/// A fence that has just been broken.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct NewBreach {
    kinds: u8,
    /// Whether to report the breach to ground stations.
    pub(crate) is_told: bool,
}

impl Geofence {
    /// Stores the uploaded fence. The upload has checked it; an invalid list counts as no fence.
    pub(crate) fn take(&mut self, items: &[Item], from: LatLon) -> Result<(), FenceError> {
        let checked = Fence::check(items);
        let (fence, outcome) = match checked {
            Ok(fence) => (fence, Ok(())),
            Err(error) => (Fence::default(), Err(error)),
        };
        self.areas = fence.in_metres(from);
        outcome
    }

    /// The kinds of fences that are broken.
    pub(crate) fn broken_kinds(&self) -> u8 {
        self.broken
    }

    /// Whether there is a fence to switch on.
    pub(crate) fn can_be_enabled(&self, rules: &FenceRules) -> bool {
        self.is_present(rules)
    }

    /// Notes that the fence was switched on or off.
    pub(crate) fn enabled(&mut self, on: bool) {
        self.has_floor = on;
        if !on {
            self.broken = 0;
        }
    }

    /// Ends the check of the floor.
    pub(crate) fn disable_floor(&mut self) {
        self.has_floor = false;
        self.broken &= !FLOOR;
    }

    /// Checks the fences for a vehicle at `here_m`; returns a new breach.
    pub(crate) fn watch(
        &mut self,
        rules: &FenceRules,
        [here_m, home_m]: [DVec3; 2],
        now: Duration,
    ) -> Option<NewBreach> {
        if !rules.is_enabled && self.broken == 0 {
            return None;
        }
        let was_broken = self.broken != 0;
        let kinds = self.check(rules, FencePosition::new(here_m, home_m), now);
        if kinds == 0 {
            return None;
        }
        let is_told = !was_broken && self.told.is_none_or(|told| now > told + TELL_EVERY);
        if is_told {
            self.told = Some(now);
        }
        Some(NewBreach { kinds, is_told })
    }

    /// An armed vehicle's reaction to a breach; `stands` means that it has landed, `idles` that a pilot holds its
    /// throttle down.
    pub(crate) fn reaction(
        &self,
        breach: NewBreach,
        rules: &FenceRules,
        stands: bool,
        idles: bool,
    ) -> Option<Reaction> {
        if rules.action == 0 {
            return None;
        }
        let falling_back = self.broken & CEILING != 0;
        if stands || (idles && !falling_back) {
            return Some(Reaction::Disarm);
        }
        Some(Reaction::EnterFirst(
            if self.farthest_m(breach.kinds) > GIVE_UP_M {
                &[ModeId::Land]
            } else {
                match rules.action {
                    2 => &[ModeId::Land],
                    3 => &[ModeId::SmartRtl, ModeId::Rtl, ModeId::Land],
                    4 => &[ModeId::Brake, ModeId::Land],
                    5 => &[ModeId::SmartRtl, ModeId::Land],
                    _ => &[ModeId::Rtl, ModeId::Land],
                }
            },
        ))
    }

    /// A rover's reaction to a breach.
    pub(crate) fn action_on_the_ground(
        &self,
        breach: NewBreach,
        rules: &FenceRules,
    ) -> FailsafeAction {
        if rules.action != 0 && self.farthest_m(breach.kinds) > GIVE_UP_M {
            FailsafeAction::Hold
        } else {
            FailsafeAction::of_rover(i32::from(rules.action))
        }
    }

    /// The reason why the fence forbids arming now.
    pub(crate) fn arming_obstacle(
        &self,
        rules: &FenceRules,
        is_ready: bool,
    ) -> Option<&'static str> {
        let level = rules.active() & (CIRCLE | AREAS) != 0;
        if level && !is_ready {
            return Some("Fence requires position");
        }
        self.obstacle(rules)
    }

    /// The bits of the fence in `SYS_STATUS`.
    pub(crate) fn health(&self, rules: &FenceRules) -> FenceHealth {
        let is_present = self.is_present(rules);
        FenceHealth {
            is_present,
            is_enabled: is_present && rules.action != 0 && rules.is_enabled,
            is_healthy: !(is_present && self.broken != 0),
        }
    }

    /// The report of the fence, while it is enabled.
    pub(crate) fn report(&self, rules: &FenceRules, now: Duration) -> Option<FenceReport> {
        rules.is_enabled.then(|| FenceReport {
            is_broken: self.broken != 0,
            breaches: self.breaches,
            kind: self.breach_type(),
            broken_since: self.broken_since,
            mitigation: if self.limiter.is_active(now) {
                FenceMitigate::FENCE_MITIGATE_VEL_LIMIT
            } else {
                FenceMitigate::FENCE_MITIGATE_NONE
            },
        })
    }

    /// A wanted velocity, reduced so that the vehicle stays inside the fence.
    pub(crate) fn keep_inside(
        &mut self,
        wanted_m_s: DVec3,
        rules: &FenceRules,
        [here_m, home_m]: [DVec3; 2],
        limits: &Limits,
        now: Duration,
    ) -> DVec3 {
        let active = rules.active();
        if active == 0 {
            return wanted_m_s;
        }
        let spot = FencePosition::new(here_m, home_m);
        let edges = Edges {
            rules: &rules.avoidance,
            margin_m: rules.margin_m.max(0.0),
            around_home: (active & CIRCLE & !self.broken != 0)
                .then_some((rules.radius_m, spot.from_home_m)),
            areas: if active & AREAS == 0 {
                &[]
            } else {
                &self.areas
            },
            headroom_m: rules.highest_m().map(|most| most - spot.above_home_m),
            here_m: spot.here_m,
            accel_m_s2: (limits.accel_m_s2, limits.accel_z_m_s2),
        };
        self.limiter.limit(wanted_m_s, &edges, now)
    }
}
