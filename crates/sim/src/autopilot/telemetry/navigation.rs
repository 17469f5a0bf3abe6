//! Home, origin, targets and the plan.

use glam::{DVec2, DVec3};
use mavlink::dialects::ardupilotmega::{
    MISSION_CURRENT_DATA, MavFrame, MavMessage, NAV_CONTROLLER_OUTPUT_DATA,
    POSITION_TARGET_GLOBAL_INT_DATA, POSITION_TARGET_LOCAL_NED_DATA, PositionTargetTypemask,
};

use super::{boot_ms, boot_us};
use crate::autopilot::Autopilot;
use crate::helm::bearing_deg;
use crate::kind::VehicleKind;
use crate::mask::{POSITION_ONLY, VELOCITY_ONLY};
use crate::mode::ModeId;
use crate::task::{Drive, Task};
use sortie_geo::maths;
use sortie_geo::{wrap_180, wrap_360};

/// The unused bits of the type mask, which the vehicle also sets.
const WITHOUT_MEANING: u16 = !PositionTargetTypemask::all().bits();

pub(super) fn home_position(autopilot: &Autopilot) -> Option<MavMessage> {
    autopilot.vehicle.datum.home_position(boot_us(autopilot))
}

pub(super) fn gps_global_origin(autopilot: &Autopilot) -> Option<MavMessage> {
    autopilot.vehicle.datum.global_origin(boot_us(autopilot))
}

pub(super) fn mission_current(autopilot: &Autopilot) -> MavMessage {
    let items = autopilot.vehicle.plans.mission.len();
    MavMessage::MISSION_CURRENT(MISSION_CURRENT_DATA {
        seq: autopilot.auto_plan.current(),
        total: items.saturating_sub(1) as u16,
        mission_state: autopilot.auto_plan.reported_state(items),
        mission_mode: u8::from(autopilot.vehicle.flight.mode.id == ModeId::Auto),
        ..Default::default()
    })
}

/// The target that the vehicle reports in GUIDED: position, velocity and type mask; `None` if there
/// is none.
fn target(autopilot: &Autopilot) -> Option<(DVec3, DVec3, u16)> {
    if autopilot.vehicle.flight.mode.id != ModeId::Guided || !autopilot.vehicle.safety.armed {
        return None;
    }
    // During a takeoff, and until the next target, the vehicle reports a target that it does not fly to.
    let rises = (DVec3::ZERO, DVec3::ZERO, POSITION_ONLY);
    match &autopilot.vehicle.flight.task {
        Task::Goto { .. } if autopilot.vehicle.flight.holds_takeoff() => Some(rises),
        Task::Goto {
            goal_m, drift_m_s, ..
        } => Some((*goal_m, *drift_m_s, POSITION_ONLY)),
        Task::Velocity { wanted_m_s, .. } => Some((DVec3::ZERO, *wanted_m_s, VELOCITY_ONLY)),
        Task::Takeoff(_) => Some(rises),
        Task::Wait
        | Task::Accelerate { .. }
        | Task::Attitude(_)
        | Task::Brake
        | Task::Return(_)
        | Task::Land(_)
        | Task::Circle(_)
        | Task::Route(_)
        | Task::Orbit(_)
        | Task::Piloted
        | Task::Manual
        | Task::Drive(_) => None,
    }
}

pub(super) fn position_target_local_ned(autopilot: &Autopilot) -> Option<MavMessage> {
    let (at, v, mask) = target(autopilot)?;
    Some(MavMessage::POSITION_TARGET_LOCAL_NED(
        POSITION_TARGET_LOCAL_NED_DATA {
            time_boot_ms: boot_ms(autopilot),
            x: at.x as f32,
            y: at.y as f32,
            z: at.z as f32,
            vx: v.x as f32,
            vy: v.y as f32,
            vz: v.z as f32,
            type_mask: PositionTargetTypemask::from_bits_truncate(mask),
            coordinate_frame: MavFrame::MAV_FRAME_LOCAL_NED,
            ..Default::default()
        },
    ))
}

pub(super) fn position_target_global_int(autopilot: &Autopilot) -> Option<MavMessage> {
    let goal = goal(autopilot)?;
    let place = autopilot.vehicle.datum.place_of(goal);
    let (lat_int, lon_int) = place.at.to_e7();
    Some(MavMessage::POSITION_TARGET_GLOBAL_INT(
        POSITION_TARGET_GLOBAL_INT_DATA {
            time_boot_ms: boot_ms(autopilot),
            lat_int,
            lon_int,
            alt: place.altitude_amsl_m as f32,
            type_mask: PositionTargetTypemask::from_bits_retain(WITHOUT_MEANING | POSITION_ONLY),
            coordinate_frame: MavFrame::MAV_FRAME_GLOBAL,
            ..Default::default()
        },
    ))
}

/// The point to which the vehicle flies; `None` without one, as after a takeoff.
pub(super) fn goal(autopilot: &Autopilot) -> Option<DVec3> {
    match &autopilot.vehicle.flight.task {
        Task::Goto { .. } if autopilot.vehicle.flight.holds_takeoff() => None,
        Task::Goto { goal_m, .. } => Some(*goal_m),
        Task::Return(_) => Some(autopilot.vehicle.datum.home_point()),
        Task::Route(route) => Some(route.goal_m()),
        Task::Drive(drive) => drive.goal_m(),
        Task::Wait
        | Task::Takeoff(_)
        | Task::Velocity { .. }
        | Task::Accelerate { .. }
        | Task::Attitude(_)
        | Task::Brake
        | Task::Land(_)
        | Task::Circle(_)
        | Task::Orbit(_)
        | Task::Piloted
        | Task::Manual => None,
    }
}

pub(super) fn nav_controller_output(autopilot: &Autopilot) -> Option<MavMessage> {
    if autopilot.vehicle.kind != VehicleKind::Copter {
        return way_of_rover(autopilot);
    }
    let body = autopilot.vehicle.believed();
    let (roll, pitch) = body.roll_pitch_rad();
    let way = goal(autopilot).map_or(DVec3::ZERO, |goal| goal - body.position_m);
    let bearing = if way.truncate() == DVec2::ZERO {
        0.0
    } else {
        wrap_180(maths::atan2(way.y, way.x).to_degrees())
    };
    let alt_error = if autopilot.vehicle.plant.body.on_ground {
        0.0
    } else {
        body.position_m.z - autopilot.vehicle.flight.control.path_m.z
    };
    Some(MavMessage::NAV_CONTROLLER_OUTPUT(
        NAV_CONTROLLER_OUTPUT_DATA {
            nav_roll: roll.to_degrees() as f32,
            nav_pitch: pitch.to_degrees() as f32,
            alt_error: alt_error as f32,
            nav_bearing: bearing as i16,
            target_bearing: wrap_360(bearing) as i16,
            wp_dist: way.truncate().length() as u16,
            ..Default::default()
        },
    ))
}

/// A rover does not send it in the modes of a pilot. Its bearings are those of the last turn on the spot and of the goal;
/// around a place, those of the point that it follows and of the centre.
fn way_of_rover(autopilot: &Autopilot) -> Option<MavMessage> {
    let flight = &autopilot.vehicle.flight;
    if !flight.mode.autonomous {
        return None;
    }
    let here_m = autopilot.vehicle.believed().position_m.truncate();
    let way_m = goal(autopilot).map_or(DVec2::ZERO, |goal| goal.truncate() - here_m);
    let (bearings_deg, xtrack_m) = match &flight.task {
        Task::Drive(Drive::Circle(circle)) => {
            let bearings = [circle.way_to_point_m(here_m), way_m].map(circled_bearing_deg);
            (bearings, circle.off_m(here_m))
        }
        task => {
            let pivot_deg = flight
                .helm
                .as_ref()
                .map_or(0.0, |helm| helm.last_pivot_deg());
            let bearings = [pivot_deg, bearing_deg(DVec2::ZERO, way_m)].map(wrap_360);
            let xtrack_m = match task {
                Task::Drive(drive) => drive.cross_track_m(here_m),
                Task::Route(route) => route.cross_track_m(here_m),
                _ => 0.0,
            };
            (bearings, xtrack_m)
        }
    };
    let [nav_deg, target_deg] = bearings_deg;
    Some(MavMessage::NAV_CONTROLLER_OUTPUT(
        NAV_CONTROLLER_OUTPUT_DATA {
            nav_bearing: nav_deg as i16,
            target_bearing: target_deg as i16,
            wp_dist: way_m.length() as u16,
            xtrack_error: xtrack_m as f32,
            ..Default::default()
        },
    ))
}

/// The bearing of a way from -90 to 270 degrees, as a rover reports it on a circle.
fn circled_bearing_deg(way_m: DVec2) -> f64 {
    let bearing = wrap_180(bearing_deg(DVec2::ZERO, way_m));
    if bearing < -90.0 {
        bearing + 360.0
    } else {
        bearing
    }
}
