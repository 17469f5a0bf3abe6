//! Flight modes in lines, with warnings about some of them.

use super::Context;
use crate::text;
use crate::text::Text;
use crate::vehicle::{AnnouncedMode, AnnouncedModes, Mode, Vehicle, VehicleClass, is_same_name};

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
/// The copter modes in which the throttle stick sets the climb, and those in which it sets the
/// thrust.
const STICK_CLIMBS: [&str; 5] = ["LOITER", "ALT_HOLD", "POSHOLD", "FLOWHOLD", "SPORT"];
const STICK_LIFTS: [&str; 3] = ["STABILIZE", "ACRO", "DRIFT"];

/// The modes that the vehicles of a session have announced, under their own names.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct OfferedModes {
    /// The announced modes; of modes with equal names, the first.
    modes: Vec<AnnouncedMode>,
    /// Whether a vehicle has announced none, so the built-in names are valid, too.
    has_others: bool,
}

impl OfferedModes {
    /// The modes of these vehicles; `None` if none of them has announced any.
    pub fn of<'a>(vehicles: impl Iterator<Item = &'a Vehicle>) -> Option<Self> {
        let mut offered = Self::default();
        let mut last: Option<&AnnouncedModes> = None;
        for vehicle in vehicles {
            let announced = &vehicle.modes;
            offered.has_others |= !announced.is_complete();
            // Vehicles of a swarm are mostly of one kind.
            if last.replace(announced) == Some(announced) {
                continue;
            }
            for mode in announced.iter() {
                let same = |known: &AnnouncedMode| is_same_name(&known.name, &mode.name);
                if !offered.modes.iter().any(same) {
                    offered.modes.push(mode.clone());
                }
            }
        }
        (!offered.modes.is_empty()).then_some(offered)
    }
}

/// The canonical name of a mode: an announced one, or a built-in one.
pub(super) fn mode_named<'a>(text: &str, context: &Context<'a>) -> Option<&'a str> {
    let announced = context.modes.into_iter().flat_map(|offered| &offered.modes);
    let mut names = announced.map(|mode| mode.name.as_str());
    names
        .find(|name| is_same_name(name, text))
        .or_else(|| built_in(text, context))
}

fn built_in(name: &str, context: &Context) -> Option<&'static str> {
    let mut classes = classes(context).into_iter();
    classes.find_map(|class| class.mode(name).and_then(Mode::name))
}

/// Whether a name is one of these modes; vehicles announce them in any spelling.
fn is_one_of(name: &str, modes: &[&str]) -> bool {
    modes.iter().any(|mode| is_same_name(mode, name))
}

/// A warning for pilots without a stick before they enter a mode; `None` if the mode needs no
/// warning.
pub(super) fn mode_warning(name: &str, context: &Context) -> Option<Text> {
    if !matches!(context.class, VehicleClass::Copter | VehicleClass::Other) {
        None
    } else if is_one_of(name, &STICK_CLIMBS) {
        Some(text!("grammar-stick-sinks"))
    } else if is_one_of(name, &STICK_LIFTS) {
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
    let name = built_in(name, context).unwrap_or(name);
    let own = match context.class {
        VehicleClass::Rover => on_surface(name),
        VehicleClass::Plane => of_plane(name),
        VehicleClass::Copter | VehicleClass::Sub | VehicleClass::Px4 | VehicleClass::Other => None,
    };
    own.unwrap_or_else(|| usual_summary(name))
}

/// The purpose of a mode of rovers and boats, where it differs from that of copters.
fn on_surface(name: &str) -> Option<Text> {
    Some(match name {
        "MANUAL" => text!("mode-manual"),
        "ACRO" | "STEERING" => text!("mode-steering"),
        "HOLD" => text!("mode-hold-surface"),
        "LOITER" => text!("mode-loiter-surface"),
        "AUTO" => text!("mode-auto-surface"),
        "RTL" => text!("mode-rtl-surface"),
        "SMART_RTL" => text!("mode-smart-rtl-surface"),
        _ => return None,
    })
}

/// The purpose of a mode of planes, where it differs from that of copters.
fn of_plane(name: &str) -> Option<Text> {
    Some(match name {
        "MANUAL" => text!("mode-manual"),
        "TAKEOFF" => text!("mode-takeoff-plane"),
        "LOITER" => text!("mode-loiter-plane"),
        "RTL" => text!("mode-rtl-plane"),
        "QLAND" => text!("mode-land"),
        _ => return None,
    })
}

fn usual_summary(name: &str) -> Text {
    match name {
        "GUIDED" => text!("mode-guided"),
        "AUTO" | "AUTO.MISSION" => text!("mode-auto"),
        "RTL" | "AUTO.RTL" => text!("mode-rtl"),
        "SMART_RTL" => text!("mode-smart-rtl"),
        "LAND" | "AUTO.LAND" => text!("mode-land"),
        "BRAKE" | "HOLD" | "AUTO.LOITER" => text!("mode-brake"),
        "CIRCLE" => text!("mode-circle"),
        "FOLLOW" | "AUTO.FOLLOW" => text!("mode-follow"),
        _ => text!("grammar-mode"),
    }
}

/// The names of all modes that can be set, each once, common ones first. A vehicle that announces its modes has no
/// others.
pub(super) fn mode_names<'a>(context: &Context<'a>) -> Vec<&'a str> {
    let announced = context.modes.into_iter().flat_map(|offered| &offered.modes);
    let selectable = announced.filter(|mode| mode.is_selectable);
    let mut names: Vec<&'a str> = selectable.map(|mode| mode.name.as_str()).collect();
    if context.modes.is_none_or(|offered| offered.has_others) {
        let hidden = |name: &str| {
            let mut modes = context.modes.into_iter().flat_map(|offered| &offered.modes);
            modes.any(|mode| !mode.is_selectable && is_same_name(&mode.name, name))
        };
        for &(_, name) in classes(context).iter().flat_map(|class| class.modes()) {
            if !is_one_of(name, &names) && !hidden(name) {
                names.push(name);
            }
        }
    }
    let everyday = |name: &str| {
        let mut modes = EVERYDAY_MODES.iter();
        modes.position(|mode| is_same_name(mode, name))
    };
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
            VehicleClass::Px4,
        ],
        class @ (VehicleClass::Copter
        | VehicleClass::Plane
        | VehicleClass::Rover
        | VehicleClass::Sub
        | VehicleClass::Px4) => vec![class],
    }
}
