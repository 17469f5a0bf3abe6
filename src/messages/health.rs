//! `SYS_STATUS`: health of the subsystems, the pre-arm bit among them.

use std::time::Duration;

use mavlink::dialects::ardupilotmega::SYS_STATUS_DATA;

use crate::vehicle::{Health, Vehicle};

const UNKNOWN_LOAD: u16 = u16::MAX;

/// Applies the health bits of `SYS_STATUS`. Removes the reasons not to arm when the pre-arm bit
/// turns healthy, and the state of the fence when the fence is switched off, since its own message
/// then merely stops.
pub(super) fn apply(vehicle: &mut Vehicle, data: &SYS_STATUS_DATA, now: Duration) {
    let health = Health {
        present: data.onboard_control_sensors_present.bits(),
        enabled: data.onboard_control_sensors_enabled.bits(),
        healthy: data.onboard_control_sensors_health.bits(),
        load_percent: match data.load {
            UNKNOWN_LOAD => f32::NAN,
            permille => f32::from(permille) * 0.1,
        },
        at: now,
    };
    let before = vehicle.health.replace(health);
    if health.prearm_ok() && !before.is_some_and(|before| before.prearm_ok()) {
        vehicle.prearm.clear();
    }
    if before.is_some_and(|before| before.enabled & Health::FENCE != 0)
        && health.enabled & Health::FENCE == 0
    {
        vehicle.fence = None;
    }
}
