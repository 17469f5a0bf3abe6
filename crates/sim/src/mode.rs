//! The flight modes and their properties, one table for each firmware.

pub(super) mod rover;

use mavlink::dialects::ardupilotmega::CopterMode;

use super::kind::VehicleKind;

/// A mode by what it does. Each firmware has its own numbers for its modes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum ModeId {
    Acro,
    AltHold,
    Auto,
    AutoRtl,
    AutoTune,
    Brake,
    Circle,
    Dock,
    Drift,
    Flip,
    FlowHold,
    Follow,
    Guided,
    GuidedNoGps,
    Hold,
    Initialising,
    Land,
    Loiter,
    Manual,
    PosHold,
    Rtl,
    Simple,
    SmartRtl,
    Stabilize,
    Steering,
    Throw,
    Turtle,
    ZigZag,
}

/// The conditions for entering a mode.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum ModeEntry {
    /// Can be entered at any time.
    Free,
    /// Refused in the air without a position.
    Position,
    /// Refused once armed, if there is no plan to fly.
    Plan,
    /// Always refused, with these texts.
    Refused(&'static [&'static str]),
}

/// One row of the mode table.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Mode {
    pub(super) id: ModeId,
    /// `custom_mode` on the wire.
    pub(super) number: u8,
    /// The mode's name in the firmware's texts.
    pub(super) name: &'static str,
    pub(super) entry: ModeEntry,
    /// Whether the autopilot holds or flies to positions, which sets the GUIDED bit of `base_mode`.
    pub(super) autonomous: bool,
    pub(super) controls_height: bool,
    pub(super) armable: bool,
}

const fn mode(id: ModeId, name: &'static str, entry: ModeEntry, facts: [bool; 3]) -> Mode {
    Mode {
        id,
        number: copter_number(id),
        name,
        entry,
        autonomous: facts[0],
        controls_height: facts[1],
        armable: facts[2],
    }
}

const fn refused(id: ModeId, name: &'static str, texts: &'static [&'static str]) -> Mode {
    mode(id, name, ModeEntry::Refused(texts), [false; 3])
}

/// The number of AUTO while it flies a landing sequence.
pub(super) const AUTO_RTL: u8 = CopterMode::COPTER_MODE_AUTO_RTL as u8;

/// `ArduCopter`'s number of a mode.
const fn copter_number(id: ModeId) -> u8 {
    let number = match id {
        ModeId::Acro => CopterMode::COPTER_MODE_ACRO,
        ModeId::AltHold => CopterMode::COPTER_MODE_ALT_HOLD,
        ModeId::Auto => CopterMode::COPTER_MODE_AUTO,
        ModeId::AutoTune => CopterMode::COPTER_MODE_AUTOTUNE,
        ModeId::AutoRtl => CopterMode::COPTER_MODE_AUTO_RTL,
        ModeId::Brake => CopterMode::COPTER_MODE_BRAKE,
        ModeId::Circle => CopterMode::COPTER_MODE_CIRCLE,
        ModeId::Drift => CopterMode::COPTER_MODE_DRIFT,
        ModeId::Flip => CopterMode::COPTER_MODE_FLIP,
        ModeId::FlowHold => CopterMode::COPTER_MODE_FLOWHOLD,
        ModeId::Follow => CopterMode::COPTER_MODE_FOLLOW,
        ModeId::Guided => CopterMode::COPTER_MODE_GUIDED,
        ModeId::GuidedNoGps => CopterMode::COPTER_MODE_GUIDED_NOGPS,
        ModeId::Land => CopterMode::COPTER_MODE_LAND,
        ModeId::Loiter => CopterMode::COPTER_MODE_LOITER,
        ModeId::PosHold => CopterMode::COPTER_MODE_POSHOLD,
        ModeId::Rtl => CopterMode::COPTER_MODE_RTL,
        ModeId::SmartRtl => CopterMode::COPTER_MODE_SMART_RTL,
        ModeId::Stabilize => CopterMode::COPTER_MODE_STABILIZE,
        ModeId::Throw => CopterMode::COPTER_MODE_THROW,
        ModeId::Turtle => CopterMode::COPTER_MODE_TURTLE,
        ModeId::ZigZag => CopterMode::COPTER_MODE_ZIGZAG,
        ModeId::Dock
        | ModeId::Hold
        | ModeId::Initialising
        | ModeId::Manual
        | ModeId::Simple
        | ModeId::Steering => panic!("a mode of another firmware"),
    };
    number as u8
}

/// All modes. The flags of a row are, in this order: autonomous, controls the height, armable.
const COPTER: &[Mode] = &[
    mode(
        ModeId::Stabilize,
        "STABILIZE",
        ModeEntry::Free,
        [false, false, true],
    ),
    mode(ModeId::Acro, "ACRO", ModeEntry::Free, [false, false, true]),
    mode(
        ModeId::AltHold,
        "ALT_HOLD",
        ModeEntry::Free,
        [false, true, true],
    ),
    mode(ModeId::Auto, "AUTO", ModeEntry::Plan, [true, true, false]),
    mode(
        ModeId::Guided,
        "GUIDED",
        ModeEntry::Position,
        [true, true, true],
    ),
    mode(
        ModeId::Loiter,
        "LOITER",
        ModeEntry::Position,
        [true, true, true],
    ),
    mode(ModeId::Rtl, "RTL", ModeEntry::Position, [true, true, false]),
    mode(
        ModeId::Circle,
        "CIRCLE",
        ModeEntry::Position,
        [true, true, false],
    ),
    mode(ModeId::Land, "LAND", ModeEntry::Free, [false, true, false]),
    mode(
        ModeId::Drift,
        "DRIFT",
        ModeEntry::Position,
        [false, false, true],
    ),
    refused(
        ModeId::Flip,
        "FLIP",
        &["Mode change to FLIP failed: init failed"],
    ),
    refused(
        ModeId::AutoTune,
        "AUTOTUNE",
        &["Mode change to AUTOTUNE failed: init failed"],
    ),
    mode(
        ModeId::PosHold,
        "POSHOLD",
        ModeEntry::Position,
        [true, true, true],
    ),
    mode(
        ModeId::Brake,
        "BRAKE",
        ModeEntry::Position,
        [true, true, false],
    ),
    refused(
        ModeId::Throw,
        "THROW",
        &["Mode change to THROW failed: init failed"],
    ),
    mode(
        ModeId::GuidedNoGps,
        "GUIDED_NOGPS",
        ModeEntry::Free,
        [false, true, true],
    ),
    mode(
        ModeId::SmartRtl,
        "SMARTRTL",
        ModeEntry::Position,
        [true, true, false],
    ),
    refused(
        ModeId::FlowHold,
        "FLOWHOLD",
        &["Mode change to FLOWHOLD failed: init failed"],
    ),
    refused(
        ModeId::Follow,
        "FOLLOW",
        &[
            "Set FOLL_ENABLE = 1",
            "Mode change to FOLLOW failed: init failed",
        ],
    ),
    mode(
        ModeId::ZigZag,
        "ZIGZAG",
        ModeEntry::Position,
        [false, true, true],
    ),
    refused(
        ModeId::AutoRtl,
        "AUTO_RTL",
        &[
            "Unable to start landing sequence",
            "Mode change to AUTO RTL failed: No return path or landing sequence found",
        ],
    ),
    refused(
        ModeId::Turtle,
        "TURTLE",
        &["Mode change to TURTLE failed: init failed"],
    ),
];

/// Every mode of a firmware, by number.
pub(super) fn all(kind: VehicleKind) -> &'static [Mode] {
    match kind {
        VehicleKind::Copter => COPTER,
        VehicleKind::Rover(_) => rover::MODES,
    }
}

/// Whether the mode takes setpoints from a ground station.
pub(super) fn is_guided(id: ModeId) -> bool {
    matches!(id, ModeId::Guided | ModeId::GuidedNoGps)
}

/// Whether a speed command takes effect in the mode.
pub(super) fn changes_speed(id: ModeId) -> bool {
    is_guided(id) || follows_waypoints(id)
}

/// Whether the mode moves along waypoints, at the speeds of the parameters.
pub(super) fn follows_waypoints(id: ModeId) -> bool {
    matches!(id, ModeId::Auto | ModeId::Rtl | ModeId::SmartRtl)
}

/// Whether the mode takes off by command; `ALT_HOLD` does only if the vehicle need not hold its
/// place.
pub(super) fn takes_off(id: ModeId, navigates: bool) -> bool {
    use ModeId::{AltHold, Guided, Loiter, PosHold, ZigZag};
    matches!(id, Guided | Loiter | PosHold | ZigZag) || (id == AltHold && !navigates)
}

impl Mode {
    /// The mode in which a vehicle boots.
    pub(super) fn boot(kind: VehicleKind) -> Self {
        match kind {
            VehicleKind::Copter => COPTER[0],
            VehicleKind::Rover(_) => rover::MODES[0],
        }
    }

    /// Whether the mode can never be entered; `AUTO_RTL` can, with a mission that has a landing.
    pub(super) fn is_always_refused(&self) -> bool {
        matches!(self.entry, ModeEntry::Refused(_)) && self.id != ModeId::AutoRtl
    }

    /// Whether a rover reports that a pilot's sticks steer it; SIMPLE, where they also do, does not.
    pub(super) fn is_steered(&self) -> bool {
        matches!(self.id, ModeId::Manual | ModeId::Acro | ModeId::Steering)
    }

    /// Whether the mode moves by the horizontal position.
    pub(super) fn needs_position(&self) -> bool {
        matches!(self.entry, ModeEntry::Position | ModeEntry::Plan)
    }

    /// The mode of a firmware with a number.
    pub(super) fn numbered(kind: VehicleKind, number: u8) -> Option<Self> {
        all(kind).iter().copied().find(|mode| mode.number == number)
    }

    /// The mode of a firmware that does something.
    pub(super) fn of(kind: VehicleKind, id: ModeId) -> Option<Self> {
        all(kind).iter().copied().find(|mode| mode.id == id)
    }
}
