//! VIBRATION: vibration levels and clipped accelerations.

use mavlink::dialects::ardupilotmega::VIBRATION_DATA;

use crate::vehicle::{Vehicle, Vibration};

pub(super) fn apply(vehicle: &mut Vehicle, data: &VIBRATION_DATA) {
    let clipping = [data.clipping_0, data.clipping_1, data.clipping_2];
    vehicle.vibration = Some(Vibration {
        level_m_s2: [data.vibration_x, data.vibration_y, data.vibration_z],
        clipping: (!clipping.contains(&u32::MAX)).then_some(clipping),
    });
}
