//! Rally points: places other than home where a return may end (`ArduPilot`'s `AP_Rally`).

use glam::DVec3;

use super::Start;
use super::parameters::Parameters;
use super::place::altitude_amsl_m;
use super::plan::Item;
use crate::cmd;
use sortie_geo::LatLon;

/// The rules from the `RALLY_*` parameters.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct RallyRules {
    /// Rally points farther away than this, in metres, do not count; zero means that all count.
    limit_m: f64,
    /// Whether home counts as a rally point.
    with_home: bool,
}

impl RallyRules {
    pub(super) fn read(all: &Parameters) -> Self {
        Self {
            limit_m: all.value("RALLY_LIMIT_KM") * 1000.0,
            with_home: all.value("RALLY_INCL_HOME") as i32 != 0,
        }
    }
}

/// The rally points of a vehicle.
#[derive(Debug, Clone, Copy)]
pub(super) struct Rally<'a> {
    pub(super) items: &'a [Item],
    /// The origin of the vehicle's north-east-down frame.
    pub(super) start: &'a Start,
}

impl Rally<'_> {
    /// The destination of a return from `here_m`: home, or the nearest allowed rally point. Its height is the minimum
    /// on arrival.
    pub(super) fn destination(
        &self,
        rules: &RallyRules,
        here_m: DVec3,
        home_m: DVec3,
        allowed: impl Fn(DVec3) -> bool,
    ) -> DVec3 {
        let away = |point: &DVec3| point.truncate().distance(here_m.truncate());
        let nearest = self
            .items
            .iter()
            .filter_map(|item| self.point(item, home_m))
            .filter(|point| allowed(*point))
            .min_by(|a, b| away(a).total_cmp(&away(b)));
        nearest
            .filter(|point| rules.limit_m <= 0.0 || away(point) <= rules.limit_m)
            .filter(|point| !rules.with_home || away(point) < away(&home_m))
            .unwrap_or(home_m)
    }

    /// A rally point in metres from the start.
    fn point(&self, item: &Item, home_m: DVec3) -> Option<DVec3> {
        let at = LatLon::from_e7(item.x, item.y);
        let set = (item.x, item.y) != (0, 0) && at.is_valid() && item.z.is_finite();
        if item.command != cmd::NAV_RALLY_POINT || !set {
            return None;
        }
        // The vehicle stores whole metres.
        let altitude_m = f64::from(item.z as i16);
        let (north, east) = self.start.at.offset_to(at);
        let amsl_m = altitude_amsl_m(item.frame, altitude_m, self.start, home_m)?;
        Some(DVec3::new(north, east, self.start.altitude_amsl_m - amsl_m))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn point(north_m: f64, east_m: f64, z: f32) -> Item {
        let (x, y) = crate::tests::start().at.moved(north_m, east_m).to_e7();
        Item {
            command: cmd::NAV_RALLY_POINT,
            frame: crate::frame::GLOBAL_RELATIVE_ALT,
            x,
            y,
            z,
            ..Item::default()
        }
    }

    fn destination(items: &[Item], limit_m: f64, with_home: bool) -> (i64, i64) {
        let start = crate::tests::start();
        let rally = Rally {
            items,
            start: &start,
        };
        let rules = RallyRules { limit_m, with_home };
        let here = DVec3::new(90.0, 0.0, -20.0);
        let to = rally.destination(&rules, here, DVec3::ZERO, |point| point.y < 50.0);
        (to.x.round() as i64, to.y.round() as i64)
    }

    #[test]
    fn a_return_ends_at_the_nearest_point_that_counts() {
        let near = [point(60.0, 20.0, 12.0), point(80.0, 70.0, 12.0)];
        let far = [point(-30.0, -20.0, 12.0), point(-30.0, 30.0, 18.0)];
        for (what, items, limit_m, with_home, expected) in [
            ("no points", &[][..], 300.0, true, (0, 0)),
            (
                "a near one, not the one outside the fence",
                &near,
                300.0,
                true,
                (60, 20),
            ),
            ("home is nearer", &far, 300.0, true, (0, 0)),
            ("home does not count", &far, 300.0, false, (-30, -20)),
            ("all too far", &far, 100.0, false, (0, 0)),
            ("no limit", &far, 0.0, false, (-30, -20)),
        ] {
            assert_eq!(destination(items, limit_m, with_home), expected, "{what}");
        }
    }
}
