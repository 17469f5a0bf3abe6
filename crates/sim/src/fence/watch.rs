//! What the autopilot does with its fences: switching them, acting on a breach, slowing down, reporting.

use std::time::Duration;

use glam::DVec3;
use mavlink::dialects::ardupilotmega::{FenceBreach, FenceMitigate, MavSeverity};

use super::avoidance::Edges;
use super::{AREAS, CEILING, CIRCLE, FLOOR, Fence, Spot};
use crate::autopilot::Autopilot;
use crate::task::Cockpit;
use crate::{mode, telemetry};

/// A vehicle this far outside lands where it is.
const GIVE_UP_M: f64 = 100.0;
/// Ground stations are told of a breach unasked, but not more often than this.
const TELL_EVERY: Duration = Duration::from_secs(1);
/// The id of `FENCE_STATUS`.
pub(super) const FENCE_STATUS: u32 = 162;

/// What `FENCE_STATUS` tells.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct FenceReport {
    pub(crate) is_broken: bool,
    pub(crate) breaches: u16,
    pub(crate) kind: FenceBreach,
    /// Since boot.
    pub(crate) broken_since: Duration,
    pub(crate) mitigation: FenceMitigate,
}

/// What `SYS_STATUS` tells of the fence.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct FenceHealth {
    pub(crate) is_present: bool,
    pub(crate) is_enabled: bool,
    pub(crate) is_healthy: bool,
}

impl Autopilot {
    /// Takes over the uploaded fence. The upload has checked it; a list that makes no sense counts as no fence.
    pub(crate) fn fence_changed(&mut self) {
        let fence = match Fence::check(&self.plans.fence) {
            Ok(fence) => fence,
            Err(error) => {
                self.say(error.severity(), &error.to_string());
                Fence::default()
            }
        };
        self.fence.areas = fence.in_metres(self.datum.start.at);
    }

    /// Switches the fence on or off; `false` if there is no fence to switch on.
    pub(crate) fn enable_fence(&mut self, on: bool) -> bool {
        if on && !self.fence.is_present(&self.tuning.flight.fence) {
            return false;
        }
        self.parameters.set("FENCE_ENABLE", f32::from(u8::from(on)));
        self.retune();
        self.fence.has_floor = on;
        if !on {
            self.fence.broken = 0;
        }
        true
    }

    /// Stops looking at the floor.
    pub(crate) fn disable_fence_floor(&mut self) {
        self.fence.has_floor = false;
        self.fence.broken &= !FLOOR;
    }

    /// Looks at the fences and acts on a breach.
    pub(crate) fn watch_fence(&mut self) {
        if !self.tuning.flight.fence.is_enabled && self.fence.broken == 0 {
            return;
        }
        let spot =
            self.with_cockpit(|_, cockpit| Spot::new(cockpit.body.position_m, cockpit.home_m));
        let now = self.uptime();
        let was_broken = self.fence.broken != 0;
        let fresh = self.fence.check(&self.tuning.flight.fence, spot, now);
        if fresh == 0 {
            return;
        }
        let tell = !was_broken && self.fence.told.is_none_or(|told| now > told + TELL_EVERY);
        if tell {
            self.fence.told = Some(now);
        }
        let flying = self.safety.armed && !self.safety.landed;
        if self.safety.armed && self.tuning.flight.fence.action != 0 {
            self.act_on_breach(fresh);
        }
        if tell {
            self.outbox.extend(telemetry::message(FENCE_STATUS, self));
        }
        if flying {
            self.say(MavSeverity::MAV_SEVERITY_NOTICE, "Fence Breached");
        }
    }

    fn act_on_breach(&mut self, fresh: u8) {
        let manual = !self.mode.controls_height && self.sticks().throttle_is_low();
        let falling_back = self.fence.broken & CEILING != 0;
        if self.safety.landed || (manual && !falling_back) {
            self.disarm();
            return;
        }
        let ways: &[u8] = if self.fence.farthest_m(fresh) > GIVE_UP_M {
            &[mode::LAND]
        } else {
            match self.tuning.flight.fence.action {
                2 => &[mode::LAND],
                3 => &[mode::SMART_RTL, mode::RTL, mode::LAND],
                4 => &[mode::BRAKE, mode::LAND],
                5 => &[mode::SMART_RTL, mode::LAND],
                _ => &[mode::RTL, mode::LAND],
            }
        };
        for &way in ways {
            if self.set_mode(way) {
                break;
            }
        }
    }

    /// Why the fence forbids arming now.
    pub(crate) fn fence_obstacle(&self) -> Option<&'static str> {
        let rules = &self.tuning.flight.fence;
        let level = rules.active() & (CIRCLE | AREAS) != 0;
        if level && !self.is_ready() {
            return Some("Fence requires position");
        }
        self.fence.obstacle(rules)
    }

    /// Whether the fence lets the vehicle fly to a point.
    pub(crate) fn may_fly_to(&self, point_m: DVec3) -> bool {
        self.fence
            .allows(&self.tuning.flight.fence, point_m, self.datum.home_point())
    }

    /// The bits of the fence in `SYS_STATUS`.
    pub(crate) fn fence_health(&self) -> FenceHealth {
        let rules = &self.tuning.flight.fence;
        let is_present = self.fence.is_present(rules);
        FenceHealth {
            is_present,
            is_enabled: is_present && rules.action != 0 && rules.is_enabled,
            is_healthy: !(is_present && self.fence.broken != 0),
        }
    }

    /// The report of the fence, as long as it is enabled.
    pub(crate) fn fence_report(&self) -> Option<FenceReport> {
        self.tuning.flight.fence.is_enabled.then(|| FenceReport {
            is_broken: self.fence.broken != 0,
            breaches: self.fence.breaches,
            kind: self.fence.breach_type(),
            broken_since: self.fence.broken_since,
            mitigation: if self.fence.limiter.is_active(self.uptime()) {
                FenceMitigate::FENCE_MITIGATE_VEL_LIMIT
            } else {
                FenceMitigate::FENCE_MITIGATE_NONE
            },
        })
    }
}

impl Cockpit<'_> {
    /// A wanted velocity, slowed so that the vehicle stays inside its fence.
    pub(crate) fn keep_inside(&mut self, wanted_m_s: DVec3) -> DVec3 {
        let rules = &self.tuning.fence;
        let active = rules.active();
        if active == 0 {
            return wanted_m_s;
        }
        let spot = Spot::new(self.body.position_m, self.home_m);
        let fence = &mut *self.fence;
        let edges = Edges {
            rules: &rules.avoidance,
            margin_m: rules.margin_m.max(0.0),
            around_home: (active & CIRCLE & !fence.broken != 0)
                .then_some((rules.radius_m, spot.from_home_m)),
            areas: if active & AREAS == 0 {
                &[]
            } else {
                &fence.areas
            },
            headroom_m: rules.highest_m().map(|most| most - spot.above_home_m),
            here_m: spot.here_m,
            accel_m_s2: (self.limits.accel_m_s2, self.limits.accel_z_m_s2),
        };
        fence.limiter.limit(wanted_m_s, &edges, self.now)
    }
}
