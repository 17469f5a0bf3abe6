//! Pulse widths in and out: `RC_CHANNELS` and `SERVO_OUTPUT_RAW`.

use mavlink::dialects::ardupilotmega::{RC_CHANNELS_DATA, SERVO_OUTPUT_RAW_DATA};

use crate::vehicle::{RcChannels, Vehicle};
use crate::wire::first_channels;

/// Applies `RC_CHANNELS`; 65535 and values beyond the channel count are unused.
pub(super) fn apply_rc(vehicle: &mut Vehicle, data: &RC_CHANNELS_DATA) {
    let mut channels_us = [0; 18];
    channels_us[..16].copy_from_slice(&first_channels!(data));
    channels_us[16..].copy_from_slice(&[data.chan17_raw, data.chan18_raw]);
    let count = usize::from(data.chancount);
    for (index, channel_us) in channels_us.iter_mut().enumerate() {
        if index >= count || *channel_us == u16::MAX {
            *channel_us = 0;
        }
    }
    vehicle.rc = Some(RcChannels {
        channels_us,
        rssi: (data.rssi != u8::MAX).then_some(data.rssi),
    });
}

/// Applies `SERVO_OUTPUT_RAW` of the first port; 65535 is unused.
pub(super) fn apply_servos(vehicle: &mut Vehicle, data: &SERVO_OUTPUT_RAW_DATA) {
    if data.port != 0 {
        return;
    }
    vehicle.servos_us = [
        data.servo1_raw,
        data.servo2_raw,
        data.servo3_raw,
        data.servo4_raw,
        data.servo5_raw,
        data.servo6_raw,
        data.servo7_raw,
        data.servo8_raw,
        data.servo9_raw,
        data.servo10_raw,
        data.servo11_raw,
        data.servo12_raw,
        data.servo13_raw,
        data.servo14_raw,
        data.servo15_raw,
        data.servo16_raw,
    ]
    .map(|width_us| if width_us == u16::MAX { 0 } else { width_us });
}
