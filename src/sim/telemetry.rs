//! What the vehicle reports: one builder per message, picked by message id.

mod health;
mod motion;
mod navigation;
mod sensors;

use mavlink::dialects::ardupilotmega::MavMessage;

use super::autopilot::Autopilot;

/// The real vehicle accepts requests for these, but without the hardware behind them it sends nothing.
const SILENT: &[u32] = &[
    22, 34, 35, 100, 124, 127, 128, 132, 143, 162, 173, 180, 181, 226,
];

type Builder = fn(&Autopilot) -> Option<MavMessage>;

/// Message ids with their builders, in rising order.
const TABLE: &[(u32, Builder)] = &[
    (0, health::heartbeat),
    (1, health::sys_status),
    (2, health::system_time),
    (24, sensors::gps_raw_int),
    (27, sensors::raw_imu),
    (29, sensors::scaled_pressure),
    (30, motion::attitude),
    (31, motion::attitude_quaternion),
    (32, motion::local_position_ned),
    (33, motion::global_position_int),
    (36, sensors::servo_output_raw),
    (42, navigation::mission_current),
    (49, navigation::gps_global_origin),
    (62, navigation::nav_controller_output),
    (65, sensors::rc_channels),
    (74, motion::vfr_hud),
    (85, navigation::position_target_local_ned),
    (87, navigation::position_target_global_int),
    (116, sensors::scaled_imu2),
    (125, health::power_status),
    (147, health::battery_status),
    (148, health::autopilot_version),
    (152, health::meminfo),
    (163, motion::ahrs),
    (164, motion::simstate),
    (168, sensors::wind),
    (178, motion::ahrs2),
    (193, health::ekf_status_report),
    (241, sensors::vibration),
    (242, navigation::home_position),
    (245, health::extended_sys_state),
];

/// The message of an id as it reads now; `None` if the vehicle has nothing to say under that id.
pub(super) fn message(id: u32, autopilot: &Autopilot) -> Option<MavMessage> {
    builder(id)?(autopilot)
}

/// Whether the firmware knows the message, so that it can be asked for.
pub(super) fn is_known(id: u32) -> bool {
    builder(id).is_some() || SILENT.contains(&id)
}

fn builder(id: u32) -> Option<Builder> {
    let at = TABLE.binary_search_by_key(&id, |(known, _)| *known).ok()?;
    TABLE.get(at).map(|(_, builder)| *builder)
}

/// Milliseconds since boot.
fn boot_ms(autopilot: &Autopilot) -> u32 {
    autopilot.uptime().as_millis() as u32
}

/// Microseconds since boot.
fn boot_us(autopilot: &Autopilot) -> u64 {
    autopilot.uptime().as_micros() as u64
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sim::wind::Wind;
    use mavlink::Message as _;

    #[test]
    fn the_table_is_sorted_and_each_builder_makes_its_own_message() {
        assert!(TABLE.windows(2).all(|pair| pair[0].0 < pair[1].0));
        let mut autopilot = Autopilot::new(1, crate::sim::tests::start(), Wind::new(0, 0));
        for _ in 0..200 {
            autopilot.step();
        }
        for &(id, build) in TABLE {
            if let Some(message) = build(&autopilot) {
                assert_eq!(message.message_id(), id);
            }
        }
    }
}
