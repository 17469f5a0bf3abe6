//! GPS, inertial sensors, pressure, wind and vibration.

use mavlink::dialects::ardupilotmega::{
    GPS_RAW_INT_DATA, GpsFixType, MavMessage, RAW_IMU_DATA, SCALED_IMU2_DATA, SCALED_PRESSURE_DATA,
    VIBRATION_DATA, WIND_DATA,
};

use glam::DVec3;

use super::{boot_ms, boot_us};
use crate::autopilot::Autopilot;
use crate::kinematics::GRAVITY_M_S2;
use sortie_geo::maths;
use sortie_geo::wrap_360;

pub(super) fn gps_raw_int(autopilot: &Autopilot) -> MavMessage {
    let (kind, satellites, offset_m, velocity_m_s) = reception(autopilot);
    let here = autopilot
        .vehicle
        .datum
        .place_of(autopilot.vehicle.plant.body.position_m + offset_m);
    let (lat, lon) = here.at.to_e7();
    let v = autopilot.vehicle.plant.body.velocity_m_s + velocity_m_s;
    let seen = kind != GpsFixType::GPS_FIX_TYPE_NO_GPS;
    let course = wrap_360(maths::atan2(v.y, v.x).to_degrees());
    MavMessage::GPS_RAW_INT(GPS_RAW_INT_DATA {
        time_usec: boot_us(autopilot),
        lat: if seen { lat } else { 0 },
        lon: if seen { lon } else { 0 },
        alt: if seen {
            (here.altitude_amsl_m * 1000.0) as i32
        } else {
            0
        },
        // The receiver has no data about the height of the geoid.
        alt_ellipsoid: if seen {
            (here.altitude_amsl_m * 1000.0) as i32
        } else {
            0
        },
        eph: if seen { 121 } else { u16::MAX },
        epv: if seen { 200 } else { u16::MAX },
        vel: (v.truncate().length() * 100.0) as u16,
        cog: (course * 100.0) as u16,
        fix_type: kind,
        satellites_visible: satellites,
        h_acc: 300,
        v_acc: 300,
        vel_acc: 40,
        ..Default::default()
    })
}

/// The earth's magnetic field at the place of the measurements (north, east, down), in milligauss.
const FIELD_MGAUSS: DVec3 = DVec3::new(232.0, 52.0, -528.0);
/// The temperature of the inertial sensors, in hundredths of a degree Celsius.
const IMU_CDEG: i16 = 2700;

/// Fix type, satellites, and the errors of position (metres) and velocity (metres per second).
fn reception(autopilot: &Autopilot) -> (GpsFixType, u8, DVec3, DVec3) {
    if let Some((kind, satellites)) = autopilot.vehicle.boot.early_fix() {
        return (kind, satellites, DVec3::ZERO, DVec3::ZERO);
    }
    autopilot.vehicle.estimator.fix().map_or(
        (
            GpsFixType::GPS_FIX_TYPE_RTK_FIXED,
            autopilot.vehicle.tuning.faults.gps.satellites,
            DVec3::ZERO,
            DVec3::ZERO,
        ),
        |fix| {
            (
                fix.kind,
                fix.satellites,
                fix.offset_m,
                fix.velocity_offset_m_s,
            )
        },
    )
}

/// Specific force in milli-g and rotation in milli-radians per second, in the body's axes.
fn inertial(autopilot: &Autopilot) -> ([i16; 3], [i16; 3]) {
    let body = &autopilot.vehicle.plant.body;
    let (roll, pitch) = body.roll_pitch_rad();
    let force = body.accel_m_s2 - glam::DVec3::new(0.0, 0.0, GRAVITY_M_S2);
    let attitude =
        glam::DQuat::from_euler(glam::EulerRot::ZYX, body.yaw_deg.to_radians(), pitch, roll);
    let felt = attitude.inverse() * force / GRAVITY_M_S2 * 1000.0;
    let (roll_rate, pitch_rate) = body.angle_rates_rad_s;
    (
        [felt.x as i16, felt.y as i16, felt.z as i16],
        [
            (roll_rate * 1000.0) as i16,
            (pitch_rate * 1000.0) as i16,
            (body.yaw_rate_deg_s.to_radians() * 1000.0) as i16,
        ],
    )
}

/// The earth's magnetic field in the body's axes, in milligauss.
pub(super) fn magnetic(autopilot: &Autopilot) -> [i16; 3] {
    let body = &autopilot.vehicle.plant.body;
    let (roll, pitch) = body.roll_pitch_rad();
    let attitude =
        glam::DQuat::from_euler(glam::EulerRot::ZYX, body.yaw_deg.to_radians(), pitch, roll);
    let felt = attitude.inverse() * FIELD_MGAUSS;
    [felt.x as i16, felt.y as i16, felt.z as i16]
}

pub(super) fn raw_imu(autopilot: &Autopilot) -> MavMessage {
    let (force, turn) = inertial(autopilot);
    let field = magnetic(autopilot);
    MavMessage::RAW_IMU(RAW_IMU_DATA {
        time_usec: boot_us(autopilot),
        xacc: force[0],
        yacc: force[1],
        zacc: force[2],
        xgyro: turn[0],
        ygyro: turn[1],
        zgyro: turn[2],
        xmag: field[0],
        ymag: field[1],
        zmag: field[2],
        temperature: IMU_CDEG,
        ..Default::default()
    })
}

pub(super) fn scaled_imu2(autopilot: &Autopilot) -> MavMessage {
    let (force, turn) = inertial(autopilot);
    let field = magnetic(autopilot);
    MavMessage::SCALED_IMU2(SCALED_IMU2_DATA {
        time_boot_ms: boot_ms(autopilot),
        xacc: force[0],
        yacc: force[1],
        zacc: force[2],
        xgyro: turn[0],
        ygyro: turn[1],
        zgyro: turn[2],
        xmag: field[0],
        ymag: field[1],
        zmag: field[2],
        temperature: IMU_CDEG,
    })
}

/// Pressure of the standard atmosphere (ISA), in hectopascals.
pub(super) fn scaled_pressure(autopilot: &Autopilot) -> MavMessage {
    let altitude_m = autopilot.vehicle.truly_here().altitude_amsl_m
        + autopilot.vehicle.estimator.barometer_offset_m();
    let pressure = 1013.25 * maths::powf((1.0 - 2.255_77e-5 * altitude_m).max(0.0), 5.2559);
    MavMessage::SCALED_PRESSURE(SCALED_PRESSURE_DATA {
        time_boot_ms: boot_ms(autopilot),
        press_abs: pressure as f32,
        temperature: 2500,
        ..Default::default()
    })
}

/// An empty message: a copter without an airspeed sensor has no estimate of the wind. A rover needs a wind vane to
/// send it at all.
pub(super) fn wind(autopilot: &Autopilot) -> Option<MavMessage> {
    if autopilot.vehicle.kind != crate::VehicleKind::Copter {
        return None;
    }
    autopilot
        .vehicle
        .boot
        .is_over()
        .then(|| MavMessage::WIND(WIND_DATA::default()))
}

pub(super) fn vibration(autopilot: &Autopilot) -> MavMessage {
    MavMessage::VIBRATION(VIBRATION_DATA {
        time_usec: boot_us(autopilot),
        ..Default::default()
    })
}
