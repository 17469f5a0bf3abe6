//! What the vehicle reports: one builder per message, picked by message id.

mod extra;
mod fence;
mod health;
mod motion;
mod navigation;
mod sensors;

use mavlink::dialects::ardupilotmega::MavMessage;

use self::Builder::{Always, Sometimes};
use super::Autopilot;
use crate::schedule::{TERRAIN_REPORT, TERRAIN_REQUEST};

/// The real vehicle accepts requests for these, but without the hardware behind them it sends nothing.
const SILENT: &[u32] = &[
    22, 34, 35, 100, 124, 127, 128, 132, 143, 173, 180, 181, 191, 192, 194, 195, 225, 226, 246,
    259, 260, 262, 271, 280, 281, 285, 301, 373, 9005, 10008, 11020,
];
/// Sent with another message and not to be asked for by itself.
const UNASKABLE: u32 = TERRAIN_REPORT;

/// How a message is made: it can be made at any time, or not always.
#[derive(Clone, Copy)]
enum Builder {
    Always(fn(&Autopilot) -> MavMessage),
    Sometimes(fn(&Autopilot) -> Option<MavMessage>),
}

impl Builder {
    fn build(self, autopilot: &Autopilot) -> Option<MavMessage> {
        match self {
            Always(build) => Some(build(autopilot)),
            Sometimes(build) => build(autopilot),
        }
    }
}

/// Message ids with their builders, in rising order.
const TABLE: &[(u32, Builder)] = &[
    (0, Always(health::heartbeat)),
    (1, Always(health::sys_status)),
    (2, Always(health::system_time)),
    (24, Always(sensors::gps_raw_int)),
    (26, Always(extra::scaled_imu)),
    (27, Always(sensors::raw_imu)),
    (29, Always(sensors::scaled_pressure)),
    (30, Always(motion::attitude)),
    (31, Always(motion::attitude_quaternion)),
    (32, Sometimes(motion::local_position_ned)),
    (33, Always(motion::global_position_int)),
    (36, Always(extra::servo_output_raw)),
    (42, Always(navigation::mission_current)),
    (46, Always(extra::mission_item_reached)),
    (49, Sometimes(navigation::gps_global_origin)),
    (62, Always(navigation::nav_controller_output)),
    (65, Always(extra::rc_channels)),
    (74, Always(motion::vfr_hud)),
    (83, Always(extra::attitude_target)),
    (85, Sometimes(navigation::position_target_local_ned)),
    (87, Sometimes(navigation::position_target_global_int)),
    (108, Always(extra::sim_state)),
    (116, Always(sensors::scaled_imu2)),
    (125, Always(health::power_status)),
    (129, Always(extra::scaled_imu3)),
    (TERRAIN_REQUEST, Always(extra::terrain_request)),
    (TERRAIN_REPORT, Always(extra::terrain_report)),
    (137, Always(extra::scaled_pressure2)),
    (147, Always(health::battery_status)),
    (148, Always(health::autopilot_version)),
    (152, Always(health::meminfo)),
    (162, Sometimes(fence::fence_status)),
    (163, Always(motion::ahrs)),
    (164, Always(motion::simstate)),
    (165, Always(extra::hwstatus)),
    (168, Sometimes(sensors::wind)),
    (178, Always(motion::ahrs2)),
    (193, Always(health::ekf_status_report)),
    (235, Always(extra::high_latency2)),
    (241, Always(sensors::vibration)),
    (242, Sometimes(navigation::home_position)),
    (245, Always(health::extended_sys_state)),
    (286, Always(extra::state_for_gimbal)),
    (376, Always(extra::relay_status)),
    (11030, Always(extra::esc_telemetry)),
];

/// The message of an id as it reads now; `None` if the vehicle has nothing to say under that id.
pub(crate) fn message(id: u32, autopilot: &Autopilot) -> Option<MavMessage> {
    builder(id)?.build(autopilot)
}

/// Whether the firmware knows the message, so that it can be asked for.
pub(crate) fn is_known(id: u32) -> bool {
    id != UNASKABLE && (builder(id).is_some() || SILENT.contains(&id))
}

fn builder(id: u32) -> Option<Builder> {
    let at = TABLE.binary_search_by_key(&id, |(known, _)| *known).ok()?;
    TABLE.get(at).map(|(_, builder)| *builder)
}

/// Milliseconds since boot.
fn boot_ms(autopilot: &Autopilot) -> u32 {
    autopilot.vehicle.uptime().as_millis() as u32
}

/// Microseconds since boot.
fn boot_us(autopilot: &Autopilot) -> u64 {
    autopilot.vehicle.uptime().as_micros() as u64
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::wind::Wind;
    use mavlink::Message as _;

    #[test]
    fn the_table_is_sorted_and_each_builder_makes_its_own_message() {
        assert!(TABLE.windows(2).all(|pair| pair[0].0 < pair[1].0));
        let mut autopilot = Autopilot::new(
            1,
            crate::tests::start(),
            crate::Airframe::shared_default(),
            Wind::new(0, 0),
        );
        for _ in 0..200 {
            autopilot.step();
        }
        for &(id, builder) in TABLE {
            if let Some(message) = builder.build(&autopilot) {
                assert_eq!(message.message_id(), id);
            }
        }
    }
}
