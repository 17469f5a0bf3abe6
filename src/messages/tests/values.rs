//! The effects of single messages on the model of a vehicle.

use mavlink::dialects::ardupilotmega::{
    AUTOPILOT_VERSION_DATA, BATTERY_STATUS_DATA, DISTANCE_SENSOR_DATA, GLOBAL_POSITION_INT_DATA,
    GPS_GLOBAL_ORIGIN_DATA, GPS_RAW_INT_DATA, GpsFixType, HOME_POSITION_DATA,
    LOCAL_POSITION_NED_DATA, MISSION_CURRENT_DATA, MavFrame, MavParamType, MavSensorOrientation,
    MissionState, PARAM_VALUE_DATA, POSITION_TARGET_GLOBAL_INT_DATA,
    POSITION_TARGET_LOCAL_NED_DATA, PositionTargetTypemask, SERVO_OUTPUT_RAW_DATA, SYS_STATUS_DATA,
    VIBRATION_DATA,
};

use super::super::testing::Bench;
use super::{global, health};
use crate::parameters::{ListedParameter, ParameterType};
use mavlink::dialects::ardupilotmega::MavMessage;

#[test]
fn a_position_of_zero_means_unknown() {
    let mut bench = Bench::new();
    bench.hear(global(0, 0));
    assert_eq!(bench.vehicle.global, None);
    bench.hear(global(-353_632_620, 1_491_652_370));
    let position = bench.vehicle.global.expect("a position");
    assert_eq!(position.heading_deg, None);
    assert!((position.altitude_m - 10.0).abs() < 1e-9);
}

/// `ArduPlane` counts its first metres from 0, 0 until it has a fix.
#[test]
fn a_position_near_zero_means_unknown_and_is_no_jump() {
    let mut bench = Bench::new();
    for (lat, lon) in [(1240, -181), (-99_999, 99_999)] {
        bench.hear(global(lat, lon));
        assert_eq!(bench.vehicle.global, None, "{lat} {lon}");
    }
    bench.hear(global(-353_632_620, 1_491_652_370));
    assert!(bench.vehicle.global.is_some());
    assert_eq!(bench.vehicle.jump, None);
    bench.hear(global(0, 67_000_000));
    assert!(bench.vehicle.global.is_some(), "the equator is a place");
}

#[test]
fn a_jump_that_no_flight_explains_is_noted() {
    let mut bench = Bench::new();
    bench.hear(global(-353_632_620, 1_491_652_370));
    bench.hear(global(-353_632_000, 1_491_652_370));
    assert_eq!(bench.vehicle.jump, None);
    bench.hear(global(353_632_620, -308_347_630));
    let jump = bench.vehicle.jump.expect("half round the globe");
    assert!(jump.distance_m > 1e7);
}

#[test]
fn values_at_the_end_of_their_range_are_no_figures() {
    let mut bench = Bench::new();
    for count in [-1, i32::MIN, i32::MAX] {
        bench.hear(MavMessage::BATTERY_STATUS(BATTERY_STATUS_DATA {
            current_consumed: count,
            energy_consumed: count,
            ..Default::default()
        }));
        let battery = bench.vehicle.battery().expect("a pack");
        assert_eq!((battery.consumed_mah, battery.consumed_wh), (None, None));
    }
    bench.hear(MavMessage::VIBRATION(VIBRATION_DATA {
        clipping_1: u32::MAX,
        ..Default::default()
    }));
    assert_eq!(bench.vehicle.vibration.and_then(|it| it.clipping), None);
    bench.hear(MavMessage::SERVO_OUTPUT_RAW(SERVO_OUTPUT_RAW_DATA {
        servo1_raw: u16::MAX,
        servo2_raw: 1500,
        ..Default::default()
    }));
    assert_eq!(bench.vehicle.servos_us[..2], [0, 1500]);
    bench.hear(MavMessage::GPS_RAW_INT(GPS_RAW_INT_DATA {
        h_acc: u32::MAX,
        v_acc: 900,
        ..Default::default()
    }));
    assert_eq!(bench.vehicle.gps_accuracy, None);
    for (fix_type, is_known) in [
        (GpsFixType::GPS_FIX_TYPE_3D_FIX, true),
        (GpsFixType::GPS_FIX_TYPE_NO_FIX, false),
        (GpsFixType::GPS_FIX_TYPE_NO_GPS, false),
    ] {
        bench.hear(MavMessage::GPS_RAW_INT(GPS_RAW_INT_DATA {
            fix_type,
            h_acc: 900,
            v_acc: 900,
            ..Default::default()
        }));
        assert_eq!(
            bench.vehicle.gps_accuracy.is_some(),
            is_known,
            "{fix_type:?}"
        );
    }
    bench.hear(MavMessage::GLOBAL_POSITION_INT(GLOBAL_POSITION_INT_DATA {
        lat: 504_501_000,
        lon: 305_234_000,
        alt: i32::MAX,
        ..Default::default()
    }));
    assert_eq!(bench.vehicle.global, None);
}

#[test]
fn a_home_on_the_other_side_of_the_earth_has_no_distance() {
    let mut bench = Bench::new();
    bench.hear(global(504_501_000, 305_234_000));
    for (latitude, is_near) in [(-504_501_000, false), (504_511_000, true)] {
        bench.hear(MavMessage::HOME_POSITION(HOME_POSITION_DATA {
            latitude,
            longitude: 305_234_000,
            ..Default::default()
        }));
        assert_eq!(bench.vehicle.distance_home_m().is_some(), is_near);
    }
}

#[test]
fn targets_keep_only_what_their_mask_leaves_in() {
    let target = |bits: u16| POSITION_TARGET_GLOBAL_INT_DATA {
        time_boot_ms: 90_000,
        lat_int: -353_632_620,
        lon_int: 1_491_655_673,
        alt: 599.07,
        vx: 5.0,
        type_mask: PositionTargetTypemask::from_bits_retain(bits),
        coordinate_frame: MavFrame::MAV_FRAME_GLOBAL,
        ..Default::default()
    };
    // Masks as ArduCopter sends them; the first is a position, the second a velocity.
    for (bits, has_point, has_velocity) in [
        (0xFDF8, true, false),
        (0x0C07, false, true),
        (0x0C00, true, true),
    ] {
        let mut bench = Bench::new();
        bench.hear(global(-353_632_620, 1_491_652_370));
        bench.hear(MavMessage::POSITION_TARGET_GLOBAL_INT(target(bits)));
        let target = bench.vehicle.target.expect("a target");
        assert_eq!(target.at_point.is_some(), has_point, "{bits:#x}");
        assert_eq!(target.velocity_m_s.is_some(), has_velocity, "{bits:#x}");
        let altitude_m = target.altitude_m.unwrap_or(-1.0);
        assert_eq!((altitude_m - 15.07).abs() < 1e-3, has_point, "{altitude_m}");
    }
}

#[test]
fn a_local_target_is_placed_by_the_origin_or_else_by_the_present_position() {
    for has_origin in [true, false] {
        let mut bench = Bench::new();
        if has_origin {
            bench.hear(MavMessage::GPS_GLOBAL_ORIGIN(GPS_GLOBAL_ORIGIN_DATA {
                latitude: -353_632_620,
                longitude: 1_491_652_370,
                altitude: 584_000,
                ..Default::default()
            }));
        }
        bench.hear(global(-353_632_620, 1_491_652_370));
        bench.hear(MavMessage::LOCAL_POSITION_NED(LOCAL_POSITION_NED_DATA {
            time_boot_ms: 90_000,
            z: -10.0,
            ..Default::default()
        }));
        bench.hear(MavMessage::POSITION_TARGET_LOCAL_NED(
            POSITION_TARGET_LOCAL_NED_DATA {
                time_boot_ms: 90_000,
                x: 100.0,
                y: 50.0,
                z: -40.0,
                type_mask: PositionTargetTypemask::from_bits_retain(0x0DF8),
                coordinate_frame: MavFrame::MAV_FRAME_LOCAL_NED,
                ..Default::default()
            },
        ));
        let target = bench.vehicle.target.expect("a target");
        let from = bench.vehicle.global.expect("a position").at_point;
        let (north_m, east_m) = from.offset_to(target.at_point.expect("a point"));
        assert!(
            (north_m - 100.0).abs() < 0.1 && (east_m - 50.0).abs() < 0.1,
            "{north_m} {east_m}"
        );
        assert!((target.altitude_m.expect("a height") - 40.0).abs() < 1e-3);
    }
}

#[test]
fn packs_are_kept_apart_and_sentinels_mean_unknown() {
    let pack = |id: u8, cells_mv: &[u16]| {
        let mut voltages = [u16::MAX; 10];
        voltages[..cells_mv.len()].copy_from_slice(cells_mv);
        MavMessage::BATTERY_STATUS(BATTERY_STATUS_DATA {
            id,
            voltages,
            current_battery: -1,
            current_consumed: -1,
            energy_consumed: 72,
            battery_remaining: -1,
            ..Default::default()
        })
    };
    let mut bench = Bench::new();
    bench.hear(pack(2, &[3700, 3710, 3690]));
    bench.hear(pack(0, &[12_600]));
    bench.hear(pack(1, &[]));
    let volts = |bench: &Bench| -> Vec<Option<i32>> {
        let packs = bench.vehicle.batteries.iter();
        packs
            .map(|pack| pack.voltage_v.map(|volts| (volts * 100.0).round() as i32))
            .collect()
    };
    assert_eq!(volts(&bench), [Some(1260), None, Some(1110)]);
    let main = bench.vehicle.battery().expect("a battery");
    assert_eq!(
        (main.current_a, main.consumed_mah, main.remaining_percent),
        (None, None, None)
    );
    assert!((main.consumed_wh.expect("energy") - 2.0).abs() < 1e-5);

    let summary = SYS_STATUS_DATA {
        voltage_battery: 11_000,
        ..health(0, 0)
    };
    bench.hear_after(1000, MavMessage::SYS_STATUS(summary.clone()));
    assert_eq!(
        volts(&bench)[0],
        Some(1260),
        "BATTERY_STATUS outranks SYS_STATUS"
    );
    bench.hear_after(5000, MavMessage::SYS_STATUS(summary));
    assert_eq!(
        volts(&bench)[0],
        Some(1100),
        "which takes over once it is silent"
    );
}

#[test]
fn a_vehicle_that_measures_no_battery_has_none() {
    let mut bench = Bench::new();
    bench.hear(MavMessage::SYS_STATUS(health(0, 0)));
    assert_eq!(bench.vehicle.batteries, []);
}

#[test]
fn the_number_of_plan_items_is_told_from_its_absence() {
    for (total, mission_state, expected) in [
        (0, MissionState::MISSION_STATE_UNKNOWN, None),
        (0, MissionState::MISSION_STATE_NO_MISSION, Some(0)),
        (u16::MAX, MissionState::MISSION_STATE_UNKNOWN, Some(0)),
        (10, MissionState::MISSION_STATE_ACTIVE, Some(10)),
    ] {
        let mut bench = Bench::new();
        bench.hear(MavMessage::MISSION_CURRENT(MISSION_CURRENT_DATA {
            seq: 2,
            total,
            mission_state,
            ..Default::default()
        }));
        assert_eq!(
            (bench.vehicle.plan.current, bench.vehicle.plan.total),
            (2, expected)
        );
    }
}

#[test]
fn only_a_distance_sensor_that_faces_down_and_sees_ground_counts() {
    use MavSensorOrientation::{
        MAV_SENSOR_ROTATION_NONE as AHEAD, MAV_SENSOR_ROTATION_PITCH_270 as DOWN,
    };
    for (orientation, current_distance, expected) in [
        (DOWN, 250, Some(2.5)),
        (DOWN, 5000, None),
        (DOWN, 10, None),
        (AHEAD, 250, Some(9.0)),
    ] {
        let mut bench = Bench::new();
        bench.vehicle.rangefinder_m = Some(9.0);
        bench.hear(MavMessage::DISTANCE_SENSOR(DISTANCE_SENSOR_DATA {
            min_distance: 20,
            max_distance: 4000,
            current_distance,
            orientation,
            ..Default::default()
        }));
        assert_eq!(bench.vehicle.rangefinder_m, expected, "{current_distance}");
    }
}

#[test]
fn outputs_of_a_second_port_do_not_replace_the_first() {
    let mut bench = Bench::new();
    for (port, servo1_raw) in [(0, 1500), (1, 1100)] {
        let data = SERVO_OUTPUT_RAW_DATA {
            servo1_raw,
            port,
            ..Default::default()
        };
        bench.hear(MavMessage::SERVO_OUTPUT_RAW(data));
    }
    assert_eq!(bench.vehicle.servos_us[0], 1500);
}

#[test]
fn two_boards_with_long_ids_only_are_told_apart() {
    let board = |first: u8| {
        let mut bench = Bench::new();
        let mut uid2 = [7; 18];
        uid2[0] = first;
        bench.hear(MavMessage::AUTOPILOT_VERSION(AUTOPILOT_VERSION_DATA {
            uid2,
            flight_sw_version: 0x0406_0180,
            ..Default::default()
        }));
        let version = bench.vehicle.version.expect("a version");
        assert_eq!(version.firmware, (4, 6, 1));
        version.board
    };
    assert_ne!(board(51), board(52));
    assert_eq!(board(51), board(51));
}

#[test]
fn parameters_are_counted_and_what_is_missing_is_known() {
    let value = |name: &str, param_value: f32, param_index: u16| {
        MavMessage::PARAM_VALUE(PARAM_VALUE_DATA {
            param_value,
            param_count: 3,
            param_index,
            param_id: name.into(),
            param_type: MavParamType::MAV_PARAM_TYPE_INT16,
        })
    };
    let mut bench = Bench::new();
    assert_eq!(
        (
            bench.inbox.parameters().is_empty(),
            bench.inbox.parameters().count()
        ),
        (true, None)
    );
    for message in [
        value("RTL_ALT", 1500.0, 0),
        value("SIXTEEN_LETTERS_", 1.0, 2),
        value("RTL_ALT", 2000.0, u16::MAX),
        value("bad\u{1b}", 2.0, u16::MAX),
    ] {
        bench.hear(message);
    }
    let parameters = bench.inbox.parameters();
    let rtl = parameters.get("RTL_ALT").expect("known");
    assert_eq!(
        rtl,
        &ListedParameter {
            value: 2000.0,
            original: 1500.0,
            kind: ParameterType::Int16,
            index: Some(0)
        }
    );
    assert_eq!(parameters.missing().collect::<Vec<_>>(), [1]);
    let names: Vec<&str> = parameters.iter().map(|(name, _)| name).collect();
    assert_eq!(names, ["RTL_ALT", "SIXTEEN_LETTERS_"]);
    assert_eq!((parameters.len(), parameters.count()), (2, Some(3)));
}
