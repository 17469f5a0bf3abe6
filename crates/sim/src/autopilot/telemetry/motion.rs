//! Attitude, position and speed.

use mavlink::dialects::ardupilotmega::{
    AHRS_DATA, AHRS2_DATA, ATTITUDE_DATA, ATTITUDE_QUATERNION_DATA, GLOBAL_POSITION_INT_DATA,
    LOCAL_POSITION_NED_DATA, MavMessage, SIMSTATE_DATA, VFR_HUD_DATA,
};

use super::boot_ms;
use crate::autopilot::Autopilot;
use crate::kinematics::GRAVITY_M_S2;
use crate::place::Place;
use sortie_geo::{wrap_180, wrap_360};

pub(super) fn attitude(autopilot: &Autopilot) -> MavMessage {
    let body = autopilot.vehicle.believed();
    let (roll, pitch) = body.roll_pitch_rad();
    MavMessage::ATTITUDE(ATTITUDE_DATA {
        time_boot_ms: boot_ms(autopilot),
        roll: roll as f32,
        pitch: pitch as f32,
        yaw: wrap_180(body.yaw_deg).to_radians() as f32,
        rollspeed: body.angle_rates_rad_s.0 as f32,
        pitchspeed: body.angle_rates_rad_s.1 as f32,
        yawspeed: body.yaw_rate_deg_s.to_radians() as f32,
    })
}

pub(super) fn attitude_quaternion(autopilot: &Autopilot) -> MavMessage {
    let body = autopilot.vehicle.believed();
    let (roll, pitch) = body.roll_pitch_rad();
    let yaw = body.yaw_deg.to_radians();
    let q = glam::DQuat::from_euler(glam::EulerRot::ZYX, yaw, pitch, roll);
    MavMessage::ATTITUDE_QUATERNION(ATTITUDE_QUATERNION_DATA {
        time_boot_ms: boot_ms(autopilot),
        q1: q.w as f32,
        q2: q.x as f32,
        q3: q.y as f32,
        q4: q.z as f32,
        rollspeed: body.angle_rates_rad_s.0 as f32,
        pitchspeed: body.angle_rates_rad_s.1 as f32,
        yawspeed: body.yaw_rate_deg_s.to_radians() as f32,
        ..Default::default()
    })
}

/// Not sent before the estimator has a position.
pub(super) fn local_position_ned(autopilot: &Autopilot) -> Option<MavMessage> {
    if !autopilot.vehicle.boot.is_over() || !autopilot.vehicle.estimator.is_aiding() {
        return None;
    }
    let (at, v) = (
        autopilot.vehicle.believed().position_m,
        autopilot.vehicle.believed().velocity_m_s,
    );
    Some(MavMessage::LOCAL_POSITION_NED(LOCAL_POSITION_NED_DATA {
        time_boot_ms: boot_ms(autopilot),
        x: at.x as f32,
        y: at.y as f32,
        z: at.z as f32,
        vx: v.x as f32,
        vy: v.y as f32,
        vz: v.z as f32,
    }))
}

pub(super) fn global_position_int(autopilot: &Autopilot) -> MavMessage {
    let body = autopilot.vehicle.believed();
    if autopilot.vehicle.boot.early_fix().is_some() {
        return nowhere_yet(autopilot);
    }
    let here = reported_place(autopilot);
    let (lat, lon) = here.at.to_e7();
    let v = body.velocity_m_s;
    let over_home_m = autopilot.vehicle.datum.home_point().z - body.position_m.z;
    MavMessage::GLOBAL_POSITION_INT(GLOBAL_POSITION_INT_DATA {
        time_boot_ms: boot_ms(autopilot),
        lat,
        lon,
        alt: (here.altitude_amsl_m * 1000.0) as i32,
        relative_alt: (over_home_m * 1000.0) as i32,
        vx: (v.x * 100.0) as i16,
        vy: (v.y * 100.0) as i16,
        vz: (v.z * 100.0) as i16,
        hdg: (wrap_360(body.yaw_deg) * 100.0) as u16,
    })
}

/// `GLOBAL_POSITION_INT` without a position, before the first GPS fix.
fn nowhere_yet(autopilot: &Autopilot) -> MavMessage {
    MavMessage::GLOBAL_POSITION_INT(GLOBAL_POSITION_INT_DATA {
        time_boot_ms: boot_ms(autopilot),
        hdg: (wrap_360(autopilot.vehicle.believed().yaw_deg) * 100.0) as u16,
        ..Default::default()
    })
}

/// The estimated position; the last known one while the estimator has given up.
fn reported_place(autopilot: &Autopilot) -> Place {
    autopilot.vehicle.estimator.last_known_m().map_or_else(
        || autopilot.vehicle.here(),
        |last_m| autopilot.vehicle.datum.place_of(last_m),
    )
}

pub(super) fn vfr_hud(autopilot: &Autopilot) -> MavMessage {
    let body = autopilot.vehicle.believed();
    let groundspeed = body.velocity_m_s.truncate().length() as f32;
    MavMessage::VFR_HUD(VFR_HUD_DATA {
        airspeed: groundspeed,
        groundspeed,
        alt: reported_place(autopilot).altitude_amsl_m as f32,
        climb: -body.velocity_m_s.z as f32,
        heading: wrap_360(body.yaw_deg) as i16,
        throttle: (body.throttle.abs() * 100.0) as u16,
    })
}

pub(super) fn ahrs(_autopilot: &Autopilot) -> MavMessage {
    MavMessage::AHRS(AHRS_DATA::default())
}

pub(super) fn ahrs2(autopilot: &Autopilot) -> MavMessage {
    let (roll, pitch) = autopilot.vehicle.believed().roll_pitch_rad();
    let here = autopilot.vehicle.here();
    let (lat, lng) = here.at.to_e7();
    MavMessage::AHRS2(AHRS2_DATA {
        roll: roll as f32,
        pitch: pitch as f32,
        yaw: wrap_180(autopilot.vehicle.believed().yaw_deg).to_radians() as f32,
        altitude: here.altitude_amsl_m as f32,
        lat,
        lng,
    })
}

pub(super) fn simstate(autopilot: &Autopilot) -> MavMessage {
    let body = &autopilot.vehicle.plant.body;
    let (roll, pitch) = body.roll_pitch_rad();
    let (lat, lng) = autopilot.vehicle.truly_here().at.to_e7();
    MavMessage::SIMSTATE(SIMSTATE_DATA {
        roll: roll as f32,
        pitch: pitch as f32,
        yaw: wrap_180(body.yaw_deg).to_radians() as f32,
        xacc: body.accel_m_s2.x as f32,
        yacc: body.accel_m_s2.y as f32,
        zacc: (body.accel_m_s2.z - GRAVITY_M_S2) as f32,
        xgyro: body.angle_rates_rad_s.0 as f32,
        ygyro: body.angle_rates_rad_s.1 as f32,
        zgyro: body.yaw_rate_deg_s.to_radians() as f32,
        lat,
        lng,
    })
}
