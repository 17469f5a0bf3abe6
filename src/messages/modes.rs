//! `AVAILABLE_MODES`, `AVAILABLE_MODES_MONITOR` and `CURRENT_MODE`: the modes of a vehicle, in its own words.

use mavlink::dialects::ardupilotmega::{
    AVAILABLE_MODES_DATA, CURRENT_MODE_DATA, MavModeProperty, MavStandardMode,
};

use crate::notice::sanitised;
use crate::vehicle::{AnnouncedMode, Vehicle};

/// Adds an announced mode.
pub(super) fn apply(vehicle: &mut Vehicle, data: &AVAILABLE_MODES_DATA) {
    if data.mode_index == 0 || data.mode_index > data.number_modes {
        return;
    }
    let given = data.mode_name.to_str().unwrap_or_default();
    let own = word(&sanitised(given));
    let name = if own.is_empty() {
        standard_name(data.standard_mode)
            .map_or_else(|| format!("MODE_{}", data.custom_mode), str::to_owned)
    } else {
        own
    };
    let hidden = MavModeProperty::MAV_MODE_PROPERTY_NOT_USER_SELECTABLE;
    let mode = AnnouncedMode {
        index: data.mode_index,
        number: data.custom_mode,
        name,
        is_selectable: !data.properties.contains(hidden),
    };
    vehicle.modes.add(mode, data.number_modes);
}

/// Notes the mode that was set last. The present mode is in the heartbeat as well.
pub(super) fn apply_current(vehicle: &mut Vehicle, data: &CURRENT_MODE_DATA) {
    // 0 means unknown.
    let intended = data.intended_custom_mode;
    vehicle.intended_mode = (intended != 0).then_some(intended);
}

/// A name as one word of the grammar.
fn word(name: &str) -> String {
    name.split_whitespace().collect::<Vec<_>>().join("_")
}

/// The name of a standard mode, for which vehicles may leave out their own.
fn standard_name(mode: MavStandardMode) -> Option<&'static str> {
    match mode {
        MavStandardMode::MAV_STANDARD_MODE_NON_STANDARD => None,
        MavStandardMode::MAV_STANDARD_MODE_POSITION_HOLD => Some("POSITION_HOLD"),
        MavStandardMode::MAV_STANDARD_MODE_ORBIT => Some("ORBIT"),
        MavStandardMode::MAV_STANDARD_MODE_CRUISE => Some("CRUISE"),
        MavStandardMode::MAV_STANDARD_MODE_ALTITUDE_HOLD => Some("ALTITUDE_HOLD"),
        MavStandardMode::MAV_STANDARD_MODE_SAFE_RECOVERY => Some("SAFE_RECOVERY"),
        MavStandardMode::MAV_STANDARD_MODE_MISSION => Some("MISSION"),
        MavStandardMode::MAV_STANDARD_MODE_LAND => Some("LAND"),
        MavStandardMode::MAV_STANDARD_MODE_TAKEOFF => Some("TAKEOFF"),
    }
}
