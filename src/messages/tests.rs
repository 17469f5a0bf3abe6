use mavlink::dialects::ardupilotmega::{
    ADSB_VEHICLE_DATA, ATTITUDE_DATA, AdsbFlags, COMMAND_ACK_DATA, EKF_STATUS_REPORT_DATA,
    EXTENDED_SYS_STATE_DATA, EkfStatusFlags, FENCE_STATUS_DATA, FenceBreach,
    GLOBAL_POSITION_INT_DATA, GPS_RAW_INT_DATA, GpsFixType, HEARTBEAT_DATA, HOME_POSITION_DATA,
    MISSION_ITEM_REACHED_DATA, MavAutopilot, MavLandedState, MavModeFlag, MavState,
    MavSysStatusSensor, MavType, PARAM_VALUE_DATA, STATUSTEXT_DATA, SYS_STATUS_DATA,
};
use proptest::prelude::*;

use super::testing::Bench;
use super::*;
use crate::vehicle::{Aircraft, Mode, SystemStatus, VehicleClass};

mod values;

fn beat(custom_mode: u32, armed: bool) -> HEARTBEAT_DATA {
    let mut base_mode = MavModeFlag::MAV_MODE_FLAG_CUSTOM_MODE_ENABLED;
    base_mode.set(MavModeFlag::MAV_MODE_FLAG_SAFETY_ARMED, armed);
    HEARTBEAT_DATA {
        custom_mode,
        mavtype: MavType::MAV_TYPE_QUADROTOR,
        autopilot: MavAutopilot::MAV_AUTOPILOT_ARDUPILOTMEGA,
        base_mode,
        system_status: MavState::MAV_STATE_STANDBY,
        mavlink_version: 3,
    }
}

fn attitude_at(time_boot_ms: u32) -> MavMessage {
    MavMessage::ATTITUDE(ATTITUDE_DATA {
        time_boot_ms,
        ..Default::default()
    })
}

fn global(lat: i32, lon: i32) -> MavMessage {
    MavMessage::GLOBAL_POSITION_INT(GLOBAL_POSITION_INT_DATA {
        time_boot_ms: 90_000,
        lat,
        lon,
        alt: 594_000,
        relative_alt: 10_000,
        hdg: u16::MAX,
        ..Default::default()
    })
}

fn text(text: &str) -> MavMessage {
    MavMessage::STATUSTEXT(STATUSTEXT_DATA {
        text: text.into(),
        ..Default::default()
    })
}

fn health(enabled: u32, healthy: u32) -> SYS_STATUS_DATA {
    SYS_STATUS_DATA {
        onboard_control_sensors_enabled: MavSysStatusSensor::from_bits_retain(enabled),
        onboard_control_sensors_health: MavSysStatusSensor::from_bits_retain(healthy),
        current_battery: -1,
        battery_remaining: -1,
        ..Default::default()
    }
}

#[test]
fn changes_of_mode_and_arming_are_said_once() {
    let mut bench = Bench::new();
    for (mode, armed) in [
        (0, false),
        (4, false),
        (4, true),
        (4, true),
        (9, true),
        (9, false),
    ] {
        bench.hear_after(1000, MavMessage::HEARTBEAT(beat(mode, armed)));
    }
    assert_eq!(
        bench.said(),
        ["mode GUIDED", "armed", "mode LAND", "disarmed"]
    );
}

/// `ArduCopter` disarms after `DISARM_DELAY` on the ground and sends no reason.
#[test]
fn a_vehicle_that_disarms_on_the_ground_gives_the_reason_that_its_delay_shows() {
    let disarmed_after = |bench: &mut Bench, seconds: u64| {
        bench.hear(MavMessage::HEARTBEAT(beat(4, true)));
        bench.said();
        for _ in 1..seconds {
            bench.hear_after(1000, MavMessage::HEARTBEAT(beat(4, true)));
        }
        bench.hear_after(1000, MavMessage::HEARTBEAT(beat(4, false)));
        bench.said()
    };
    let ready = || {
        let mut bench = Bench::new();
        bench.hear(MavMessage::HEARTBEAT(beat(4, false)));
        bench
    };
    assert_eq!(
        disarmed_after(&mut ready(), 10),
        ["disarmed: no takeoff within 10 s"]
    );
    assert_eq!(disarmed_after(&mut ready(), 5), ["disarmed"]);
    assert_eq!(disarmed_after(&mut ready(), 20), ["disarmed"]);
    let mut patient = ready();
    patient.hear(delay(20.0));
    assert_eq!(
        disarmed_after(&mut patient, 20),
        ["disarmed: no takeoff within 20 s"]
    );
    for seconds in [0.0, -1.0, f32::NAN, f32::INFINITY] {
        let mut never = ready();
        never.hear(delay(seconds));
        assert_eq!(disarmed_after(&mut never, 10), ["disarmed"], "{seconds}");
    }
}

#[test]
fn after_a_flight_the_time_on_the_ground_counts_and_a_command_needs_no_reason() {
    let landed = |landed_state| {
        MavMessage::EXTENDED_SYS_STATE(EXTENDED_SYS_STATE_DATA {
            landed_state,
            ..Default::default()
        })
    };
    let mut bench = Bench::new();
    for armed in [false, true] {
        bench.hear(MavMessage::HEARTBEAT(beat(4, armed)));
    }
    bench.hear(landed(MavLandedState::MAV_LANDED_STATE_IN_AIR));
    bench.hear_after(30_000, MavMessage::HEARTBEAT(beat(4, true)));
    bench.hear(landed(MavLandedState::MAV_LANDED_STATE_ON_GROUND));
    bench.said();
    bench.hear_after(10_000, MavMessage::HEARTBEAT(beat(4, false)));
    assert_eq!(bench.said(), ["disarmed: on the ground for 10 s"]);
    assert!(bench.vehicle.idle_disarm.is_some());

    bench.hear(MavMessage::HEARTBEAT(beat(4, true)));
    assert_eq!(bench.vehicle.idle_disarm, None);
    bench.said();
    bench.hear_after(
        9500,
        MavMessage::COMMAND_ACK(COMMAND_ACK_DATA {
            command: MavCmd::MAV_CMD_COMPONENT_ARM_DISARM,
            ..Default::default()
        }),
    );
    bench.hear_after(500, MavMessage::HEARTBEAT(beat(4, false)));
    assert_eq!(bench.said(), ["disarmed"]);
}

fn delay(seconds: f32) -> MavMessage {
    MavMessage::PARAM_VALUE(PARAM_VALUE_DATA {
        param_value: seconds,
        param_count: 900,
        param_index: 49,
        param_id: DISARM_DELAY.into(),
        ..Default::default()
    })
}

#[test]
fn only_the_autopilot_speaks_for_the_vehicle() {
    let mut bench = Bench::new();
    bench.hear(MavMessage::HEARTBEAT(beat(4, true)));
    let gimbal = beat(0, false);
    bench.hear_from(154, Content::Message(MavMessage::HEARTBEAT(gimbal.clone())));
    let ground = HEARTBEAT_DATA {
        mavtype: MavType::MAV_TYPE_GCS,
        ..gimbal.clone()
    };
    bench.hear(MavMessage::HEARTBEAT(ground));
    let no_autopilot = HEARTBEAT_DATA {
        autopilot: MavAutopilot::MAV_AUTOPILOT_INVALID,
        ..gimbal
    };
    bench.hear(MavMessage::HEARTBEAT(no_autopilot));
    bench.hear_from(154, Content::Message(attitude_at(12)));
    assert!(bench.vehicle.armed());
    assert_eq!(bench.vehicle.attitude, None);
    assert_eq!(bench.said(), Vec::<String>::new());
}

#[test]
fn a_vehicle_type_newer_than_the_dialect_is_still_understood() {
    let mut payload = Box::new([0; 255]);
    payload[..9].copy_from_slice(&[0x05, 0x01, 0, 0, 200, 3, 0x81, 5, 3]);
    let mut bench = Bench::new();
    bench.hear_from(1, Content::Undecoded { id: 0, payload });
    let heartbeat = bench.vehicle.heartbeat.expect("a heartbeat");
    assert_eq!((heartbeat.mav_type, heartbeat.autopilot), (200, 3));
    assert_eq!(
        heartbeat.mode,
        Mode {
            class: VehicleClass::Other,
            number: 0x105
        }
    );
    assert!(heartbeat.armed);
    assert_eq!(heartbeat.status, SystemStatus::Critical);
}

#[test]
fn mode_numbers_of_other_autopilots_get_no_ardupilot_names() {
    let mut bench = Bench::new();
    bench.hear(MavMessage::HEARTBEAT(HEARTBEAT_DATA {
        autopilot: MavAutopilot::MAV_AUTOPILOT_PX4,
        ..beat(4, false)
    }));
    assert_eq!(
        bench.vehicle.mode().map(|mode| mode.to_string()),
        Some("MODE_4".to_owned())
    );
    assert_eq!(
        bench.vehicle.heartbeat.map(|heartbeat| heartbeat.class),
        Some(VehicleClass::Copter)
    );
}

#[test]
fn a_reboot_forgets_what_the_old_run_said() {
    let mut bench = Bench::new();
    bench.hear(MavMessage::HEARTBEAT(beat(4, false)));
    bench.hear(attitude_at(90_000));
    bench.hear(global(-353_632_620, 1_491_652_370));
    bench.hear(MavMessage::HOME_POSITION(HOME_POSITION_DATA {
        latitude: -353_632_620,
        longitude: 1_491_652_370,
        ..Default::default()
    }));
    bench.hear(MavMessage::MISSION_ITEM_REACHED(
        MISSION_ITEM_REACHED_DATA { seq: 4 },
    ));
    bench.hear(text("PreArm: Battery failsafe"));
    bench.vehicle.link.received = 99;
    bench.said();

    bench.hear_after(2000, attitude_at(1500));
    assert_eq!(bench.said(), ["rebooted"]);
    let vehicle = &bench.vehicle;
    assert_eq!((vehicle.link.reboots, vehicle.link.received), (1, 99));
    assert_eq!(
        (vehicle.home, vehicle.global, vehicle.prearm.len()),
        (None, None, 0)
    );
    assert_eq!(vehicle.plan.reached, None);
    assert_eq!(vehicle.texts.len(), 1);
    assert!(
        vehicle.attitude.is_some(),
        "the message that told of the reboot counts"
    );
    bench.hear_after(100, attitude_at(1600));
    assert_eq!(bench.said(), Vec::<String>::new());
}

#[test]
fn reasons_not_to_arm_go_when_the_check_passes() {
    const PREARM: u32 = 0x1000_0000;
    let mut bench = Bench::new();
    bench.hear(text("PreArm: Need Position Estimate"));
    bench.hear(MavMessage::SYS_STATUS(health(PREARM, 0)));
    assert_eq!(bench.vehicle.prearm, ["Need Position Estimate"]);
    bench.hear(MavMessage::SYS_STATUS(health(PREARM, PREARM)));
    assert_eq!(bench.vehicle.prearm, Vec::<String>::new());
    bench.hear(text("Arm: LAND mode not armable"));
    bench.hear(MavMessage::SYS_STATUS(health(PREARM, PREARM)));
    assert_eq!(
        bench.vehicle.prearm,
        ["LAND mode not armable"],
        "the bit has not changed"
    );
}

#[test]
fn fence_gps_and_filter_are_said_when_they_change() {
    let fence = |out: u8| {
        MavMessage::FENCE_STATUS(FENCE_STATUS_DATA {
            breach_status: out,
            breach_count: 1,
            breach_type: FenceBreach::FENCE_BREACH_MAXALT,
            ..Default::default()
        })
    };
    let gps = |fix_type| {
        MavMessage::GPS_RAW_INT(GPS_RAW_INT_DATA {
            fix_type,
            ..Default::default()
        })
    };
    let ekf = |bits| {
        MavMessage::EKF_STATUS_REPORT(EKF_STATUS_REPORT_DATA {
            flags: EkfStatusFlags::from_bits_retain(bits),
            ..Default::default()
        })
    };
    let mut bench = Bench::new();
    let (rtk, none) = (
        GpsFixType::GPS_FIX_TYPE_RTK_FIXED,
        GpsFixType::GPS_FIX_TYPE_NO_FIX,
    );
    for message in [
        fence(0),
        fence(1),
        fence(1),
        fence(0),
        gps(rtk),
        gps(none),
        gps(none),
        gps(rtk),
        ekf(0x033F),
        ekf(0x00A7),
        ekf(0x0025),
        ekf(0x033F),
    ] {
        bench.hear(message);
    }
    let expected = [
        "fence breached (too high)",
        "back inside the fence",
        "GPS fix lost (no fix)",
        "GPS fix RTK",
        "EKF position lost",
        "EKF position good",
    ];
    assert_eq!(bench.said(), expected);
    let bit = MavSysStatusSensor::MAV_SYS_STATUS_GEOFENCE.bits();
    bench.hear(MavMessage::SYS_STATUS(health(bit, 0)));
    assert!(bench.vehicle.fence.is_some());
    bench.hear(MavMessage::SYS_STATUS(health(0, 0)));
    assert_eq!(bench.vehicle.fence, None, "switched off");
}

proptest! {
    #[test]
    fn no_bytes_from_a_vehicle_can_break_the_model(
        payloads in prop::collection::vec((any::<prop::sample::Index>(), prop::collection::vec(any::<u8>(), 255)), 1..40),
    ) {
        use mavlink::{MavlinkVersion, Message as _};
        // The ids of all messages that have a handler.
        const IDS: [u32; 28] = [
            0, 1, 2, 24, 30, 32, 33, 36, 42, 46, 49, 65, 74, 85, 87, 132, 147, 148, 162, 168, 173, 193, 22, 241, 242,
            245, 253, 109,
        ];
        let mut bench = Bench::new();
        for (pick, payload) in payloads {
            if let Ok(message) = MavMessage::parse(MavlinkVersion::V2, *pick.get(&IDS), &payload) {
                bench.hear_after(50, message);
            }
        }
        bench.poll_after(5000);
        let controls = |text: &str| text.chars().any(char::is_control);
        prop_assert!(!bench.said().iter().any(|text| controls(text)));
        prop_assert!(!bench.vehicle.prearm.iter().any(|text| controls(text)));
        if let Some(attitude) = bench.vehicle.attitude {
            prop_assert!((0.0..360.0).contains(&attitude.yaw_deg));
        }
    }
}

fn report(icao: u32, flags: AdsbFlags) -> MavMessage {
    MavMessage::ADSB_VEHICLE(ADSB_VEHICLE_DATA {
        ICAO_address: icao,
        lat: 504_500_000,
        lon: 305_200_000,
        altitude: 350_000,
        heading: 9000,
        hor_velocity: 4000,
        ver_velocity: -150,
        callsign: "MED\u{1b}1".into(),
        flags,
        tslc: 2,
        ..ADSB_VEHICLE_DATA::DEFAULT
    })
}

#[test]
fn traffic_is_noted_as_far_as_its_report_is_valid_and_drops_out() {
    let mut bench = Bench::new();
    bench.hear(MavMessage::HEARTBEAT(beat(4, false)));
    bench.hear_after(20_000, report(1, AdsbFlags::all()));
    bench.hear(report(2, AdsbFlags::ADSB_FLAGS_VALID_COORDS));
    let place = AdsbFlags::ADSB_FLAGS_VALID_COORDS | AdsbFlags::ADSB_FLAGS_VALID_ALTITUDE;
    bench.hear(report(3, place));
    let heard: Vec<&Aircraft> = bench.vehicle.traffic.iter().collect();
    assert_eq!(heard.len(), 2, "no height, no place: {heard:?}");
    let (whole, bare) = (heard[0], heard[1]);
    assert_eq!(whole.name(), "MED?1");
    assert!((whole.altitude_amsl_m - 350.0).abs() < 1e-9);
    let [north, east] = whole.velocity_m_s.expect("a velocity");
    assert!(north.abs() < 1e-9 && (east - 40.0).abs() < 1e-9);
    assert_eq!(whole.climb_m_s, Some(-1.5));
    assert_eq!((bare.name().as_str(), bare.velocity_m_s), ("000003", None));
    // A receiver with its own component counts, any other component does not.
    for (component, count) in [(156, 3), (100, 3)] {
        let content = Content::Message(report(u32::from(component), place));
        bench.hear_from(component, content);
        assert_eq!(bench.vehicle.traffic.iter().count(), count, "{component}");
    }
    bench.poll_after(15_000);
    assert!(bench.vehicle.traffic.is_empty());
}
