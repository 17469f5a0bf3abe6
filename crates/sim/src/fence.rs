//! The geofence: uploaded areas, a circle around home, a ceiling and a floor; detection of a breach and the reaction.
//! Follows `ArduPilot`'s `AC_Fence` and `ArduCopter`'s reaction to it.

mod area;
mod avoidance;
#[cfg(test)]
mod tests;
mod watch;

use std::time::Duration;

use glam::{DVec2, DVec3};
use mavlink::dialects::ardupilotmega::FenceBreach;

use self::area::FenceArea;
pub(super) use self::area::{Fence, FenceError, severity};
use self::avoidance::Limiter;
use super::kind::VehicleKind;
use super::parameters::Parameters;

/// The time between checks, in steps.
pub(super) const EVERY_STEPS: u64 = 4;
/// The kinds of fences, a bit of `FENCE_TYPE` each.
const CEILING: u8 = 1;
const CIRCLE: u8 = 2;
const AREAS: u8 = 4;
const FLOOR: u8 = 8;
/// A broken limit counts as broken again each time the vehicle is this much farther out, in metres.
const BACKUP_M: f64 = 20.0;
/// How long the checks pause after a change of mode, because the pilot is bringing the vehicle back.
const RECOVERY: Duration = Duration::from_secs(10);
const COUNT_MAX: u16 = 65_500;

/// The rules from the `FENCE_*` parameters.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct FenceRules {
    pub(super) is_enabled: bool,
    kinds: u8,
    action: u8,
    ceiling_m: f64,
    floor_m: f64,
    radius_m: f64,
    margin_m: f64,
    avoidance: avoidance::AvoidanceRules,
}

/// The highest and the lowest height of a rover, which has no parameters for them and is never checked for them.
const ROVER_HEIGHTS_M: [f64; 2] = [100.0, -10.0];

impl FenceRules {
    pub(super) fn read(all: &Parameters) -> Self {
        let [ceiling_m, floor_m] = match all.kind() {
            VehicleKind::Copter => ["FENCE_ALT_MAX", "FENCE_ALT_MIN"].map(|name| all.value(name)),
            VehicleKind::Rover(_) => ROVER_HEIGHTS_M,
        };
        Self {
            is_enabled: all.value("FENCE_ENABLE") as i32 != 0,
            kinds: all.value("FENCE_TYPE") as u8,
            action: all.value("FENCE_ACTION") as u8,
            ceiling_m,
            floor_m,
            radius_m: all.value("FENCE_RADIUS"),
            margin_m: all.value("FENCE_MARGIN"),
            avoidance: avoidance::AvoidanceRules::read(all),
        }
    }

    /// The active kinds of fence.
    fn active(&self) -> u8 {
        if self.is_enabled { self.kinds } else { 0 }
    }

    /// The greatest height above home, in metres: the ceiling less the margin; `None` without a
    /// ceiling.
    pub(super) fn highest_m(&self) -> Option<f64> {
        (self.active() & CEILING != 0).then_some(self.ceiling_m - self.margin_m)
    }
}

/// A numeric limit: how far the vehicle is beyond it, and the distance beyond at which the limit
/// counts as broken again, in metres.
#[derive(Debug, Clone, PartialEq, Default)]
struct Limit {
    beyond_m: f64,
    backup_m: Option<f64>,
}

/// The fences of a vehicle and their state.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Geofence {
    /// The areas, in metres north and east of the start.
    areas: Vec<FenceArea<DVec2>>,
    broken: u8,
    breaches: u16,
    broken_since: Duration,
    ceiling: Limit,
    floor: Limit,
    circle: Limit,
    /// Whether the floor is active: only after a command has switched the fence on.
    has_floor: bool,
    recovering_until: Option<Duration>,
    told: Option<Duration>,
    limiter: Limiter,
}

#[derive(Debug, Clone, Copy, PartialEq)]
#[expect(clippy::struct_field_names, reason = "the unit belongs to each name")]
struct FencePosition {
    /// The position in metres north and east of the start.
    here_m: DVec2,
    from_home_m: DVec2,
    above_home_m: f64,
}

impl FencePosition {
    fn new(point_m: DVec3, home_m: DVec3) -> Self {
        Self {
            here_m: point_m.truncate(),
            from_home_m: (point_m - home_m).truncate(),
            above_home_m: home_m.z - point_m.z,
        }
    }
}

impl Geofence {
    /// Notes a change of mode, after which breaches are ignored for a while.
    pub(super) fn mode_changed(&mut self, now: Duration) {
        if self.broken != 0 {
            self.recovering_until = Some(now + RECOVERY);
        }
    }

    /// Checks every fence; returns the kinds just broken.
    fn check(&mut self, rules: &FenceRules, spot: FencePosition, now: Duration) -> u8 {
        self.broken &= rules.kinds;
        if rules.active() == 0 {
            return 0;
        }
        if self.recovering_until.is_some_and(|until| now < until) {
            return 0;
        }
        self.recovering_until = None;
        let beyond = [
            (CEILING, spot.above_home_m - rules.ceiling_m),
            (FLOOR, rules.floor_m - spot.above_home_m),
            (CIRCLE, spot.from_home_m.length() - rules.radius_m),
        ];
        let mut fresh = 0;
        for (kind, beyond_m) in beyond {
            let counts = rules.kinds & kind != 0 && (kind != FLOOR || self.has_floor);
            if counts && self.cross(kind, beyond_m, now) {
                fresh |= kind;
            }
        }
        let outside = rules.kinds & AREAS != 0 && self.is_area_broken(spot.here_m);
        if !outside {
            self.broken &= !AREAS;
        } else if self.broken & AREAS == 0 {
            self.record(AREAS, now);
            fresh |= AREAS;
        }
        fresh
    }

    /// Stores how far the vehicle is beyond a limit; returns whether this counts as a new breach.
    fn cross(&mut self, kind: u8, beyond_m: f64, now: Duration) -> bool {
        let was_broken = self.broken & kind != 0;
        let limit = match kind {
            CEILING => &mut self.ceiling,
            FLOOR => &mut self.floor,
            _ => &mut self.circle,
        };
        if beyond_m < 0.0 {
            *limit = Limit::default();
            self.broken &= !kind;
            return false;
        }
        limit.beyond_m = beyond_m;
        let fresh = !was_broken || limit.backup_m.is_some_and(|backup| beyond_m >= backup);
        if fresh {
            limit.backup_m = Some(beyond_m + BACKUP_M);
            self.record(kind, now);
        }
        fresh
    }

    fn record(&mut self, kind: u8, now: Duration) {
        if self.broken == 0 {
            self.broken_since = now;
        }
        if self.breaches < COUNT_MAX {
            self.breaches += 1;
        }
        self.broken |= kind;
    }

    fn is_area_broken(&self, point: DVec2) -> bool {
        self.areas.iter().any(|area| area.is_broken_at(point))
    }

    /// Whether flying to a point is allowed.
    pub(super) fn allows(&self, rules: &FenceRules, point_m: DVec3, home_m: DVec3) -> bool {
        let active = rules.active();
        if active == 0 {
            return true;
        }
        let spot = FencePosition::new(point_m, home_m);
        let outside = (active & CEILING != 0 && spot.above_home_m > rules.ceiling_m)
            || (active & FLOOR != 0 && spot.above_home_m < rules.floor_m)
            || (active & CIRCLE != 0 && spot.from_home_m.length() > rules.radius_m)
            || (active & AREAS != 0 && self.is_area_broken(spot.here_m));
        !outside
    }

    /// The largest distance, in metres, by which the vehicle is outside fences of these kinds.
    fn farthest_m(&self, kinds: u8) -> f64 {
        [
            (CEILING, &self.ceiling),
            (FLOOR, &self.floor),
            (CIRCLE, &self.circle),
        ]
        .iter()
        .filter(|(kind, _)| kinds & kind != 0)
        .fold(0.0, |most, (_, limit)| limit.beyond_m.max(most))
    }

    fn is_present(&self, rules: &FenceRules) -> bool {
        rules.kinds & (CEILING | FLOOR | CIRCLE) != 0
            || (rules.kinds & AREAS != 0 && !self.areas.is_empty())
    }

    fn obstacle(&self, rules: &FenceRules) -> Option<&'static str> {
        if !rules.is_enabled {
            return None;
        }
        if !self.is_present(rules) {
            return Some("Fences enabled, but none selected");
        }
        let narrow = |area: &FenceArea<DVec2>| match area.shape {
            area::AreaShape::Circle { radius_m, .. } => area.keeps_in && radius_m < rules.margin_m,
            area::AreaShape::Polygon(_) => false,
        };
        let reasons = [
            (
                rules.kinds & AREAS != 0 && self.areas.iter().any(narrow),
                "Margin is less than inclusion circle radius",
            ),
            (rules.radius_m < 0.0, "Invalid FENCE_RADIUS value"),
            (
                rules.radius_m < rules.margin_m,
                "FENCE_MARGIN is less than FENCE_RADIUS",
            ),
            (rules.ceiling_m < 0.0, "Invalid FENCE_ALT_MAX value"),
            (rules.floor_m < -100.0, "Invalid FENCE_ALT_MIN value"),
            (self.broken != 0, "vehicle outside fence"),
            (rules.margin_m < 0.0, "Invalid FENCE_MARGIN value"),
            (
                rules.ceiling_m < rules.floor_m,
                "FENCE_ALT_MAX < FENCE_ALT_MIN",
            ),
            (
                rules.ceiling_m - rules.floor_m <= 2.0 * rules.margin_m,
                "FENCE_MARGIN too big",
            ),
        ];
        let found = reasons.into_iter().find(|(applies, _)| *applies);
        found.map(|(_, reason)| reason)
    }

    fn breach_type(&self) -> FenceBreach {
        if self.broken & (CIRCLE | AREAS) != 0 {
            FenceBreach::FENCE_BREACH_BOUNDARY
        } else if self.broken & CEILING != 0 {
            FenceBreach::FENCE_BREACH_MAXALT
        } else if self.broken & FLOOR != 0 {
            FenceBreach::FENCE_BREACH_MINALT
        } else {
            FenceBreach::FENCE_BREACH_NONE
        }
    }
}
