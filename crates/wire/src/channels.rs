//! RC channels, each of which has its own field in the messages.

/// The first 16 channels of a message with fields `chan1_raw`, `chan2_raw`..., in order.
#[macro_export]
macro_rules! first_channels {
    ($data:expr) => {
        [
            $data.chan1_raw,
            $data.chan2_raw,
            $data.chan3_raw,
            $data.chan4_raw,
            $data.chan5_raw,
            $data.chan6_raw,
            $data.chan7_raw,
            $data.chan8_raw,
            $data.chan9_raw,
            $data.chan10_raw,
            $data.chan11_raw,
            $data.chan12_raw,
            $data.chan13_raw,
            $data.chan14_raw,
            $data.chan15_raw,
            $data.chan16_raw,
        ]
    };
}
