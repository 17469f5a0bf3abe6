//! Flight modes in lines, with warnings about some of them.

use super::Context;
use crate::text;
use crate::text::Text;
use crate::vehicle::{Mode, VehicleClass};

/// The common modes, the most used first.
const EVERYDAY_MODES: [&str; 8] = [
    "GUIDED",
    "LOITER",
    "RTL",
    "LAND",
    "BRAKE",
    "AUTO",
    "ALT_HOLD",
    "STABILIZE",
];
/// The modes of a copter in which the throttle stick sets the climb; then those in which it sets the thrust.
const STICK_CLIMBS: [&str; 5] = ["LOITER", "ALT_HOLD", "POSHOLD", "FLOWHOLD", "SPORT"];
const STICK_LIFTS: [&str; 3] = ["STABILIZE", "ACRO", "DRIFT"];

/// The canonical name of a mode; `None` if no mode has that name.
pub(super) fn mode_named(text: &str, context: &Context) -> Option<&'static str> {
    classes(context)
        .iter()
        .find_map(|class| class.mode(text).and_then(Mode::name))
}

/// A warning for pilots without a stick before they enter a mode.
pub(super) fn mode_warning(name: &str, context: &Context) -> Option<Text> {
    if !matches!(context.class, VehicleClass::Copter | VehicleClass::Other) {
        None
    } else if STICK_CLIMBS.contains(&name) {
        Some(text!("grammar-stick-sinks"))
    } else if STICK_LIFTS.contains(&name) {
        Some(text!("grammar-stick-falls"))
    } else {
        None
    }
}

/// The purpose of a mode, or the warning about it, for the list of modes.
pub(super) fn mode_summary(name: &str, context: &Context) -> Text {
    if let Some(warning) = mode_warning(name, context) {
        return warning;
    }
    match name {
        "GUIDED" => text!("mode-guided"),
        "AUTO" => text!("mode-auto"),
        "RTL" => text!("mode-rtl"),
        "SMART_RTL" => text!("mode-smart-rtl"),
        "LAND" => text!("mode-land"),
        "BRAKE" | "HOLD" => text!("mode-brake"),
        "CIRCLE" => text!("mode-circle"),
        "FOLLOW" => text!("mode-follow"),
        _ => text!("grammar-mode"),
    }
}

/// The names of all modes, each once, common ones first.
pub(super) fn mode_names(context: &Context) -> Vec<&'static str> {
    let mut names: Vec<&'static str> = Vec::new();
    for (_, name) in classes(context).iter().flat_map(|class| class.modes()) {
        if !names.contains(name) {
            names.push(name);
        }
    }
    let everyday = |name: &&str| EVERYDAY_MODES.iter().position(|mode| mode == name);
    names.sort_by_key(|name| everyday(name).unwrap_or(EVERYDAY_MODES.len()));
    names
}

fn classes(context: &Context) -> Vec<VehicleClass> {
    match context.class {
        VehicleClass::Other => vec![
            VehicleClass::Copter,
            VehicleClass::Plane,
            VehicleClass::Rover,
            VehicleClass::Sub,
        ],
        class @ (VehicleClass::Copter
        | VehicleClass::Plane
        | VehicleClass::Rover
        | VehicleClass::Sub) => vec![class],
    }
}
