//! The vehicle that another one follows, as it reports itself (`AP_Follow`).

use std::time::Duration;

use glam::{DVec2, DVec3};
use mavlink::dialects::ardupilotmega::{FOLLOW_TARGET_DATA, GLOBAL_POSITION_INT_DATA, MavMessage};
use sortie_geo::{LatLon, maths};

use super::body::Body;
use super::kind::VehicleKind;
use super::parameters::Parameters;
use super::place::{LocalDatum, Place};

/// A report is used for this time.
const LASTS: Duration = Duration::from_secs(3);
/// A leader that was chosen by its first report is given up after this time without one.
pub(super) const FORGOTTEN: Duration = Duration::from_secs(10);
/// The heading of a report that has none.
const NO_HEADING: u16 = 36_000;
/// The bits of `FOLLOW_TARGET`'s `est_capabilities`: place, velocity, attitude.
const HAS_PLACE: u8 = 1;
const HAS_VELOCITY: u8 = 2;
const HAS_ATTITUDE: u8 = 8;

/// How to follow a leader: the values of the `FOLL_*` parameters.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct FollowRules {
    /// The leader's system id; 0 for the first that reports itself.
    pub(super) system: u8,
    /// A leader that is further away is not followed; 0 for any distance.
    furthest_m: f64,
    /// Whether the offset turns with the leader.
    turns: bool,
    /// The place to keep, from the leader; zero for the one where the following begins.
    pub(super) offset_m: DVec3,
    pub(super) position_p: f64,
}

impl FollowRules {
    /// The rules of a rover that may follow (`FOLL_ENABLE`).
    pub(super) fn read(all: &Parameters) -> Option<Self> {
        let may_follow = all.kind() != VehicleKind::Copter && all.value("FOLL_ENABLE") > 0.0;
        may_follow.then(|| Self {
            system: all.value("FOLL_SYSID") as u8,
            furthest_m: all.value("FOLL_DIST_MAX"),
            turns: all.value("FOLL_OFS_TYPE") as i32 == 1,
            offset_m: DVec3::new(
                all.value("FOLL_OFS_X"),
                all.value("FOLL_OFS_Y"),
                all.value("FOLL_OFS_Z"),
            ),
            position_p: all.value("FOLL_POS_P"),
        })
    }
}

/// The last report of the vehicle to follow.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Leader {
    point_m: DVec3,
    pub(super) velocity_m_s: DVec2,
    /// The heading, and when it was heard.
    heading_deg: Option<(f64, Duration)>,
    pub(super) heard: Duration,
}

/// Where a vehicle says it is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct LeaderReport {
    place: Place,
    velocity_m_s: DVec2,
    heading_deg: Option<f64>,
}

impl LeaderReport {
    /// The report in a message, if it is one.
    pub(super) fn read(message: &MavMessage) -> Option<Self> {
        match message {
            MavMessage::GLOBAL_POSITION_INT(data) => Self::position(data),
            MavMessage::FOLLOW_TARGET(data) => Self::target(data),
            _ => None,
        }
    }

    fn position(data: &GLOBAL_POSITION_INT_DATA) -> Option<Self> {
        let heading = data.hdg <= NO_HEADING;
        Self::at([data.lat, data.lon], f64::from(data.alt) / 1000.0).map(|report| Self {
            velocity_m_s: DVec2::new(f64::from(data.vx), f64::from(data.vy)) / 100.0,
            heading_deg: heading.then(|| f64::from(data.hdg) / 100.0),
            ..report
        })
    }

    fn target(data: &FOLLOW_TARGET_DATA) -> Option<Self> {
        let has = |bit| data.est_capabilities & bit != 0;
        let [north, east, _] = data.vel.map(f64::from);
        let [w, x, y, z] = data.attitude_q.map(f64::from);
        let heading = maths::atan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z));
        let report = Self::at([data.lat, data.lon], f64::from(data.alt)).filter(|_| has(HAS_PLACE));
        report.map(|report| Self {
            velocity_m_s: if has(HAS_VELOCITY) {
                DVec2::new(north, east)
            } else {
                DVec2::ZERO
            },
            heading_deg: has(HAS_ATTITUDE).then(|| heading.to_degrees()),
            ..report
        })
    }

    /// A report of a place; `None` for exactly zero, which means that none is known.
    fn at(e7: [i32; 2], altitude_amsl_m: f64) -> Option<Self> {
        let is_known = e7 != [0, 0] && altitude_amsl_m.is_finite();
        is_known.then(|| Self {
            place: Place {
                at: LatLon::from_e7(e7[0], e7[1]),
                altitude_amsl_m,
            },
            velocity_m_s: DVec2::ZERO,
            heading_deg: None,
        })
    }
}

impl Leader {
    pub(super) fn new(report: &LeaderReport, datum: &LocalDatum, now: Duration) -> Self {
        Self {
            point_m: datum.point_of(report.place),
            velocity_m_s: report.velocity_m_s,
            heading_deg: report.heading_deg.map(|heading| (heading, now)),
            heard: now,
        }
    }

    /// The way to where the leader is now; `None` if it is silent, or too far away.
    pub(super) fn way_m(&self, body: &Body, rules: &FollowRules, now: Duration) -> Option<DVec3> {
        let since = now.saturating_sub(self.heard);
        let moved_m = self.velocity_m_s * since.as_secs_f64();
        let way_m = self.point_m + moved_m.extend(0.0) - body.position_m;
        let is_near = rules.furthest_m <= 0.0 || way_m.length() <= rules.furthest_m;
        (since <= LASTS && is_near && way_m.is_finite()).then_some(way_m)
    }

    /// The place to keep, from the leader, to the north and east; `None` if it turns with a heading that is unknown.
    pub(super) fn offset_m(&self, rules: &FollowRules, now: Duration) -> Option<DVec2> {
        let offset_m = rules.offset_m.truncate();
        if !rules.turns || rules.offset_m == DVec3::ZERO {
            return Some(offset_m);
        }
        let (sin, cos) = maths::sin_cos(self.heading(now)?.to_radians());
        Some(DVec2::new(cos, sin).rotate(offset_m))
    }

    /// The offset of a vehicle on this way from its leader, in the frame of the rules' offset, and whether that turns with
    /// the leader.
    pub(super) fn offset_here(
        &self,
        way_m: DVec3,
        rules: &FollowRules,
        now: Duration,
    ) -> (DVec3, bool) {
        let heading = self.heading(now).filter(|_| rules.turns);
        let Some(heading) = heading else {
            return (-way_m, false);
        };
        let (sin, cos) = maths::sin_cos(-heading.to_radians());
        let flat = DVec2::new(cos, sin).rotate(-way_m.truncate());
        (flat.extend(-way_m.z), true)
    }

    fn heading(&self, now: Duration) -> Option<f64> {
        let fresh = |at: Duration| now.saturating_sub(at) <= LASTS;
        self.heading_deg
            .filter(|(_, at)| fresh(*at))
            .map(|(heading, _)| heading)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_offset_turns_with_the_leader_and_back() {
        let now = Duration::from_secs(1);
        let leader = Leader {
            point_m: DVec3::ZERO,
            velocity_m_s: DVec2::ZERO,
            heading_deg: Some((90.0, now)),
            heard: now,
        };
        let rules = FollowRules {
            system: 0,
            furthest_m: 0.0,
            turns: true,
            offset_m: DVec3::new(-4.0, 0.0, 0.0),
            position_p: 0.1,
        };
        let behind = leader.offset_m(&rules, now).expect("its heading is known");
        assert!(behind.distance(DVec2::new(0.0, -4.0)) < 1e-9, "{behind}");
        let (own, turns) = leader.offset_here(-behind.extend(0.0), &rules, now);
        assert!(turns && own.distance(rules.offset_m) < 1e-9, "{own}");
        assert_eq!(leader.offset_m(&rules, now + LASTS * 2), None);
    }

    #[test]
    fn a_report_without_a_place_is_ignored() {
        let nowhere = GLOBAL_POSITION_INT_DATA::default();
        assert_eq!(
            LeaderReport::read(&MavMessage::GLOBAL_POSITION_INT(nowhere)),
            None
        );
        let target = FOLLOW_TARGET_DATA {
            lat: 1,
            ..Default::default()
        };
        assert_eq!(LeaderReport::read(&MavMessage::FOLLOW_TARGET(target)), None);
    }
}
