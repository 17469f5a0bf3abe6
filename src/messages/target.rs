//! The target of the autopilot.

use std::time::Duration;

use mavlink::dialects::ardupilotmega::{
    MavFrame, POSITION_TARGET_GLOBAL_INT_DATA, POSITION_TARGET_LOCAL_NED_DATA,
    PositionTargetTypemask,
};

use super::position::point;
use crate::geo::LatLon;
use crate::plan::HeightFrame;
use crate::vehicle::{Place, Target, Vehicle};

/// The silence after which a target is void. Targets are requested once a second and may be lost.
/// This is longer than the time-out of a link, so that the last target of a lost vehicle stays
/// known.
const SILENT: Duration = Duration::from_millis(3500);

/// Applies `POSITION_TARGET_GLOBAL_INT`. A height above mean sea level becomes a height above home
/// if home's altitude is known, from home itself or from a position report.
pub(super) fn apply_global(
    vehicle: &mut Vehicle,
    data: &POSITION_TARGET_GLOBAL_INT_DATA,
    now: Duration,
) {
    let uses = Uses(data.type_mask);
    let altitude_m = match HeightFrame::of(data.coordinate_frame as u8) {
        HeightFrame::SeaLevel => home_altitude_m(vehicle).map(|home| f64::from(data.alt) - home),
        HeightFrame::Home => Some(f64::from(data.alt)),
        // The height of the terrain is unknown here.
        HeightFrame::Terrain | HeightFrame::Other => None,
    };
    vehicle.target = Some(Target {
        at_point: point(data.lat_int, data.lon_int).filter(|_| uses.point()),
        altitude_m: altitude_m.filter(|altitude| uses.height() && altitude.is_finite()),
        velocity_m_s: uses.velocity([data.vx, data.vy, data.vz]),
        at: now,
    });
}

/// Applies `POSITION_TARGET_LOCAL_NED`, which is measured from the origin of local coordinates.
/// Without a known `origin`, it is converted with the vehicle's current position in both kinds of
/// coordinates.
pub(super) fn apply_local(
    vehicle: &mut Vehicle,
    data: &POSITION_TARGET_LOCAL_NED_DATA,
    origin: Option<Place>,
    now: Duration,
) {
    if data.coordinate_frame != MavFrame::MAV_FRAME_LOCAL_NED {
        return;
    }
    let uses = Uses(data.type_mask);
    let [north_m, east_m, down_m] = [data.x, data.y, data.z].map(f64::from);
    let origin = origin
        .or_else(|| origin_from_position(vehicle))
        .filter(|_| {
            [north_m, east_m, down_m]
                .iter()
                .all(|part| part.is_finite())
        });
    let at_point = origin.map(|origin| origin.at_point.moved(north_m, east_m));
    let altitude_m = origin
        .zip(home_altitude_m(vehicle))
        .map(|(origin, home_m)| origin.altitude_amsl_m - down_m - home_m);
    vehicle.target = Some(Target {
        at_point: at_point.filter(|point: &LatLon| uses.point() && point.is_valid()),
        altitude_m: altitude_m.filter(|_| uses.height()),
        velocity_m_s: uses.velocity([data.vx, data.vy, data.vz]),
        at: now,
    });
}

/// Forgets a target that has not been heard for long. Autopilots do not report that they have no target, but stop
/// sending it (`ArduCopter` under a velocity command, in LOITER, on the ground).
pub(super) fn expire(vehicle: &mut Vehicle, now: Duration) {
    let is_over = |target: Target| now.saturating_sub(target.at) >= SILENT;
    if !vehicle.link.lost && vehicle.target.is_some_and(is_over) {
        vehicle.target = None;
    }
}

/// The parts of a target that its type mask does not ignore.
struct Uses(PositionTargetTypemask);

impl Uses {
    fn point(&self) -> bool {
        use PositionTargetTypemask as Ignore;
        let ignored =
            Ignore::POSITION_TARGET_TYPEMASK_X_IGNORE | Ignore::POSITION_TARGET_TYPEMASK_Y_IGNORE;
        !self.0.intersects(ignored)
    }

    fn height(&self) -> bool {
        !self
            .0
            .contains(PositionTargetTypemask::POSITION_TARGET_TYPEMASK_Z_IGNORE)
    }

    fn velocity(&self, velocity_m_s: [f32; 3]) -> Option<[f32; 3]> {
        use PositionTargetTypemask as Ignore;
        let ignored = Ignore::POSITION_TARGET_TYPEMASK_VX_IGNORE
            | Ignore::POSITION_TARGET_TYPEMASK_VY_IGNORE
            | Ignore::POSITION_TARGET_TYPEMASK_VZ_IGNORE;
        let finite = velocity_m_s.iter().all(|part| part.is_finite());
        (finite && !self.0.intersects(ignored)).then_some(velocity_m_s)
    }
}

/// Home's height above mean sea level, from home itself or from the two heights of a position
/// report; `None` without either.
fn home_altitude_m(vehicle: &Vehicle) -> Option<f64> {
    vehicle.home.map(|home| home.altitude_amsl_m).or_else(|| {
        vehicle
            .global
            .map(|global| global.altitude_amsl_m - global.altitude_m)
    })
}

fn origin_from_position(vehicle: &Vehicle) -> Option<Place> {
    let (global, local) = (vehicle.global?, vehicle.local?);
    let [north_m, east_m, down_m] = local.ned_m.map(f64::from);
    Some(Place {
        at_point: global.at_point.moved(-north_m, -east_m),
        altitude_amsl_m: global.altitude_amsl_m + down_m,
    })
}
