//! Messages that are requested less often: outputs and inputs, further sensors, terrain, summaries.

use mavlink::dialects::ardupilotmega::{
    ATTITUDE_TARGET_DATA, AUTOPILOT_STATE_FOR_GIMBAL_DEVICE_DATA, AttitudeTargetTypemask,
    ESC_TELEMETRY_1_TO_4_DATA, EstimatorStatusFlags, HIGH_LATENCY2_DATA, HlFailureFlag,
    MISSION_ITEM_REACHED_DATA, MavAutopilot, MavLandedState, MavMessage, RC_CHANNELS_DATA,
    RELAY_STATUS_DATA, SCALED_IMU_DATA, SCALED_IMU3_DATA, SCALED_PRESSURE2_DATA,
    SERVO_OUTPUT_RAW_DATA, SIM_STATE_DATA, TERRAIN_REPORT_DATA, TERRAIN_REQUEST_DATA,
};

use super::{boot_ms, boot_us, health, sensors};
use crate::autopilot::Autopilot;
use crate::estimator::FLAGS_GOOD;
use crate::kinematics::GRAVITY_M_S2;
use crate::workbench;
use sortie_geo::maths;
use sortie_geo::wrap_360;

/// The temperature of the board's second barometer, in hundredths of a degree Celsius.
const BOARD_CDEG: i16 = 3015;
/// The spacing of requested terrain, in metres, and the number of missing blocks.
const TERRAIN_SPACING_M: u16 = 100;
const TERRAIN_PENDING: u16 = 504;
/// All 56 blocks of a grid.
const TERRAIN_MASK: u64 = (1 << 56) - 1;
/// The distance to the south-western corner of the requested grid, metres south and west.
const TERRAIN_CORNER_M: (f64, f64) = (1281.0, 1038.0);
/// The speed of a SITL quad's motor at full output, in revolutions per minute.
const FULL_RPM: f64 = 7000.0;

pub(super) fn servo_output_raw(autopilot: &Autopilot) -> MavMessage {
    let mut servos = autopilot.vehicle.servos_us;
    let count = match &autopilot.vehicle.flight.helm {
        None => autopilot.vehicle.plant.airframe.motors(),
        Some(helm) => {
            let outputs = helm.pulses_us(autopilot.vehicle.kind);
            servos[0] = outputs[0];
            servos[2] = outputs[1];
            0
        }
    };
    for (motor, servo) in servos.iter_mut().enumerate().take(count) {
        *servo = autopilot.vehicle.plant.motor_pulse_us(motor);
    }
    if let Some(test) = &autopilot.workbench.motor_test {
        servos
            .iter_mut()
            .take(count)
            .for_each(|servo| *servo = 1000);
        if let Some((motor, pulse_us)) = test.turning(autopilot.vehicle.uptime())
            && let Some(place) = usize::try_from(motor).ok().and_then(|n| n.checked_sub(1))
            && let Some(output) = servos.get_mut(MOTOR_ORDER.get(place).copied().unwrap_or(place))
        {
            *output = pulse_us;
        }
    }
    MavMessage::SERVO_OUTPUT_RAW(SERVO_OUTPUT_RAW_DATA {
        time_usec: boot_us(autopilot) as u32,
        servo1_raw: servos[0],
        servo2_raw: servos[1],
        servo3_raw: servos[2],
        servo4_raw: servos[3],
        servo5_raw: servos[4],
        servo6_raw: servos[5],
        servo7_raw: servos[6],
        servo8_raw: servos[7],
        servo9_raw: servos[8],
        servo10_raw: servos[9],
        servo11_raw: servos[10],
        servo12_raw: servos[11],
        servo13_raw: servos[12],
        servo14_raw: servos[13],
        servo15_raw: servos[14],
        servo16_raw: servos[15],
        ..Default::default()
    })
}

/// Motor tests count clockwise from the front: outputs 3, 1, 4, 2 of a quad in plus shape.
const MOTOR_ORDER: [usize; 4] = [2, 0, 3, 1];

pub(super) fn rc_channels(autopilot: &Autopilot) -> MavMessage {
    let mut channels = autopilot.vehicle.sticks().channels_us;
    channels[2] = autopilot.vehicle.reception().throttle_us as u16;
    MavMessage::RC_CHANNELS(RC_CHANNELS_DATA {
        time_boot_ms: boot_ms(autopilot),
        chan1_raw: channels[0],
        chan2_raw: channels[1],
        chan3_raw: channels[2],
        chan4_raw: channels[3],
        chan5_raw: channels[4],
        chan6_raw: channels[5],
        chan7_raw: channels[6],
        chan8_raw: channels[7],
        chan9_raw: channels[8],
        chan10_raw: channels[9],
        chan11_raw: channels[10],
        chan12_raw: channels[11],
        chan13_raw: channels[12],
        chan14_raw: channels[13],
        chan15_raw: channels[14],
        chan16_raw: channels[15],
        chancount: 8,
        rssi: 255,
        ..Default::default()
    })
}

pub(super) fn scaled_imu(autopilot: &Autopilot) -> MavMessage {
    let MavMessage::RAW_IMU(raw) = sensors::raw_imu(autopilot) else {
        return MavMessage::SCALED_IMU(SCALED_IMU_DATA::default());
    };
    MavMessage::SCALED_IMU(SCALED_IMU_DATA {
        time_boot_ms: boot_ms(autopilot),
        xacc: raw.xacc,
        yacc: raw.yacc,
        zacc: raw.zacc,
        xgyro: raw.xgyro,
        ygyro: raw.ygyro,
        zgyro: raw.zgyro,
        xmag: raw.xmag,
        ymag: raw.ymag,
        zmag: raw.zmag,
        temperature: raw.temperature,
    })
}

/// The third compass alone: there is no third inertial sensor.
pub(super) fn scaled_imu3(autopilot: &Autopilot) -> MavMessage {
    let field = sensors::magnetic(autopilot);
    MavMessage::SCALED_IMU3(SCALED_IMU3_DATA {
        time_boot_ms: boot_ms(autopilot),
        xmag: field[0],
        ymag: field[1],
        zmag: field[2],
        ..Default::default()
    })
}

pub(super) fn scaled_pressure2(autopilot: &Autopilot) -> MavMessage {
    let press_abs = match sensors::scaled_pressure(autopilot) {
        MavMessage::SCALED_PRESSURE(data) => data.press_abs,
        _ => 0.0,
    };
    MavMessage::SCALED_PRESSURE2(SCALED_PRESSURE2_DATA {
        time_boot_ms: boot_ms(autopilot),
        press_abs,
        temperature: BOARD_CDEG,
        ..Default::default()
    })
}

pub(super) fn mission_item_reached(_autopilot: &Autopilot) -> MavMessage {
    MavMessage::MISSION_ITEM_REACHED(MISSION_ITEM_REACHED_DATA { seq: u16::MAX })
}

fn attitude(autopilot: &Autopilot) -> glam::DQuat {
    let (roll, pitch) = autopilot.vehicle.plant.body.roll_pitch_rad();
    let yaw = autopilot.vehicle.plant.body.yaw_deg.to_radians();
    glam::DQuat::from_euler(glam::EulerRot::ZYX, yaw, pitch, roll)
}

pub(super) fn attitude_target(autopilot: &Autopilot) -> MavMessage {
    let q = attitude(autopilot);
    let (roll_rate, pitch_rate) = autopilot.vehicle.plant.body.angle_rates_rad_s;
    MavMessage::ATTITUDE_TARGET(ATTITUDE_TARGET_DATA {
        time_boot_ms: boot_ms(autopilot),
        q: [q.w as f32, q.x as f32, q.y as f32, q.z as f32],
        body_roll_rate: roll_rate as f32,
        body_pitch_rate: pitch_rate as f32,
        body_yaw_rate: autopilot.vehicle.plant.body.yaw_rate_deg_s.to_radians() as f32,
        thrust: autopilot.vehicle.plant.body.throttle as f32,
        type_mask: AttitudeTargetTypemask::empty(),
    })
}

pub(super) fn sim_state(autopilot: &Autopilot) -> MavMessage {
    let body = &autopilot.vehicle.plant.body;
    let (roll, pitch) = body.roll_pitch_rad();
    let q = attitude(autopilot);
    let here = autopilot.vehicle.here();
    let (lat_int, lon_int) = here.at.to_e7();
    let felt = q.inverse() * (body.accel_m_s2 - glam::DVec3::new(0.0, 0.0, GRAVITY_M_S2));
    MavMessage::SIM_STATE(SIM_STATE_DATA {
        q1: q.w as f32,
        q2: q.x as f32,
        q3: q.y as f32,
        q4: q.z as f32,
        roll: roll as f32,
        pitch: pitch as f32,
        yaw: sortie_geo::wrap_180(body.yaw_deg).to_radians() as f32,
        xacc: felt.x as f32,
        yacc: felt.y as f32,
        zacc: felt.z as f32,
        xgyro: body.angle_rates_rad_s.0 as f32,
        ygyro: body.angle_rates_rad_s.1 as f32,
        zgyro: body.yaw_rate_deg_s.to_radians() as f32,
        // The real vehicle also sends degrees times 1e7 in these fields.
        lat: lat_int as f32,
        lon: lon_int as f32,
        alt: here.altitude_amsl_m as f32,
        vn: body.velocity_m_s.x as f32,
        ve: body.velocity_m_s.y as f32,
        vd: body.velocity_m_s.z as f32,
        lat_int,
        lon_int,
        ..Default::default()
    })
}

/// Without terrain data, all blocks are missing, and the height is that above sea level.
pub(super) fn terrain_report(autopilot: &Autopilot) -> MavMessage {
    let here = autopilot.vehicle.here();
    let (lat, lon) = here.at.to_e7();
    MavMessage::TERRAIN_REPORT(TERRAIN_REPORT_DATA {
        lat,
        lon,
        current_height: here.altitude_amsl_m as f32,
        pending: TERRAIN_PENDING,
        ..Default::default()
    })
}

pub(super) fn terrain_request(autopilot: &Autopilot) -> MavMessage {
    let (south, west) = TERRAIN_CORNER_M;
    let (lat, lon) = autopilot.vehicle.here().at.moved(-south, -west).to_e7();
    MavMessage::TERRAIN_REQUEST(TERRAIN_REQUEST_DATA {
        mask: TERRAIN_MASK,
        lat,
        lon,
        grid_spacing: TERRAIN_SPACING_M,
    })
}

#[expect(deprecated, reason = "the vehicle still sends it when it is asked to")]
pub(super) fn hwstatus(_autopilot: &Autopilot) -> MavMessage {
    MavMessage::HWSTATUS(mavlink::dialects::ardupilotmega::HWSTATUS_DATA {
        Vcc: 5000,
        I2Cerr: 0,
    })
}

pub(super) fn high_latency2(autopilot: &Autopilot) -> MavMessage {
    let body = &autopilot.vehicle.plant.body;
    let here = autopilot.vehicle.here();
    let (latitude, longitude) = here.at.to_e7();
    let heading = (wrap_360(body.yaw_deg) / 2.0) as u8;
    let speed = (body.velocity_m_s.truncate().length() * 5.0).min(255.0) as u8;
    let goal = super::navigation::goal(autopilot);
    let way = goal.map_or(glam::DVec3::ZERO, |goal| goal - body.position_m);
    let (base_mode, battery) = match health::heartbeat(autopilot) {
        MavMessage::HEARTBEAT(beat) => (beat.base_mode.bits(), health::remaining(autopilot)),
        _ => (0, 0),
    };
    MavMessage::HIGH_LATENCY2(HIGH_LATENCY2_DATA {
        timestamp: boot_ms(autopilot),
        latitude,
        longitude,
        custom_mode: u16::from(autopilot.vehicle.flight.mode.number),
        altitude: here.altitude_amsl_m as i16,
        target_altitude: (here.altitude_amsl_m - way.z) as i16,
        target_distance: (way.truncate().length() / 10.0) as u16,
        // A copter has no airspeed sensor.
        failure_flags: HlFailureFlag::HL_FAILURE_FLAG_DIFFERENTIAL_PRESSURE,
        mavtype: health::vehicle_type(autopilot),
        autopilot: MavAutopilot::MAV_AUTOPILOT_ARDUPILOTMEGA,
        heading,
        target_heading: (wrap_360(maths::atan2(way.y, way.x).to_degrees()) / 2.0) as u8,
        throttle: (body.throttle * 100.0) as u8,
        airspeed: speed,
        groundspeed: speed,
        wind_heading: 90,
        temperature_air: -128,
        climb_rate: (-body.velocity_m_s.z * 10.0) as i8,
        battery,
        custom0: base_mode as i8,
        ..Default::default()
    })
}

pub(super) fn state_for_gimbal(autopilot: &Autopilot) -> MavMessage {
    let q = attitude(autopilot);
    let v = autopilot.vehicle.plant.body.velocity_m_s;
    MavMessage::AUTOPILOT_STATE_FOR_GIMBAL_DEVICE(AUTOPILOT_STATE_FOR_GIMBAL_DEVICE_DATA {
        time_boot_us: boot_us(autopilot),
        q: [q.w as f32, q.x as f32, q.y as f32, q.z as f32],
        vx: v.x as f32,
        vy: v.y as f32,
        vz: v.z as f32,
        estimator_status: EstimatorStatusFlags::from_bits_truncate(FLAGS_GOOD.bits()),
        target_system: autopilot.vehicle.system,
        landed_state: MavLandedState::MAV_LANDED_STATE_UNDEFINED,
        angular_velocity_z: autopilot.vehicle.plant.body.yaw_rate_deg_s.to_radians() as f32,
        ..Default::default()
    })
}

pub(super) fn relay_status(autopilot: &Autopilot) -> MavMessage {
    let present = workbench::relays(&autopilot.vehicle.parameters);
    MavMessage::RELAY_STATUS(RELAY_STATUS_DATA {
        time_boot_ms: boot_ms(autopilot),
        on: autopilot.workbench.relays_on & present,
        present,
    })
}

pub(super) fn esc_telemetry(autopilot: &Autopilot) -> MavMessage {
    let spin = f64::from(
        autopilot
            .vehicle
            .plant
            .motor_pulse_us(0)
            .saturating_sub(1000),
    ) / 1000.0;
    MavMessage::ESC_TELEMETRY_1_TO_4(ESC_TELEMETRY_1_TO_4_DATA {
        voltage: [1679; 4],
        current: [80; 4],
        totalcurrent: [1; 4],
        rpm: [(spin * FULL_RPM) as u16; 4],
        count: [(boot_ms(autopilot) / 3) as u16; 4],
        temperature: [32; 4],
    })
}
