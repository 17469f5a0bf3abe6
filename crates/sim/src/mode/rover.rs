//! The modes of `ArduRover`.

use mavlink::dialects::ardupilotmega::RoverMode;

use super::{Mode, ModeEntry, ModeId};

const fn mode(id: ModeId, number: RoverMode, name: &'static str, entry: ModeEntry) -> Mode {
    let is_autonomous = matches!(
        id,
        ModeId::Auto
            | ModeId::Circle
            | ModeId::Dock
            | ModeId::Follow
            | ModeId::Guided
            | ModeId::Loiter
            | ModeId::Rtl
            | ModeId::SmartRtl
    );
    Mode {
        id,
        number: number as u8,
        name,
        entry,
        autonomous: is_autonomous,
        controls_height: false,
        armable: !matches!(id, ModeId::Rtl | ModeId::SmartRtl | ModeId::Initialising),
    }
}

/// What the vehicle says when it refuses a mode, whatever the reason.
pub(crate) const REFUSAL: &str = "Flight mode change failed";

/// All modes; those that are always refused are not simulated, or need a device that is absent.
pub(super) const MODES: &[Mode] = &[
    mode(
        ModeId::Manual,
        RoverMode::ROVER_MODE_MANUAL,
        "MANUAL",
        ModeEntry::Free,
    ),
    mode(
        ModeId::Acro,
        RoverMode::ROVER_MODE_ACRO,
        "ACRO",
        ModeEntry::Free,
    ),
    mode(
        ModeId::Steering,
        RoverMode::ROVER_MODE_STEERING,
        "STEERING",
        ModeEntry::Position,
    ),
    mode(
        ModeId::Hold,
        RoverMode::ROVER_MODE_HOLD,
        "HOLD",
        ModeEntry::Free,
    ),
    mode(
        ModeId::Loiter,
        RoverMode::ROVER_MODE_LOITER,
        "LOITER",
        ModeEntry::Position,
    ),
    mode(
        ModeId::Follow,
        RoverMode::ROVER_MODE_FOLLOW,
        "FOLLOW",
        ModeEntry::Position,
    ),
    mode(
        ModeId::Simple,
        RoverMode::ROVER_MODE_SIMPLE,
        "SIMPLE",
        ModeEntry::Free,
    ),
    mode(
        ModeId::Dock,
        RoverMode::ROVER_MODE_DOCK,
        "DOCK",
        ModeEntry::Refused(&["Dock: target not acquired"]),
    ),
    mode(
        ModeId::Circle,
        RoverMode::ROVER_MODE_CIRCLE,
        "CIRCLE",
        ModeEntry::Position,
    ),
    mode(
        ModeId::Auto,
        RoverMode::ROVER_MODE_AUTO,
        "AUTO",
        ModeEntry::Plan,
    ),
    mode(
        ModeId::Rtl,
        RoverMode::ROVER_MODE_RTL,
        "RTL",
        ModeEntry::Position,
    ),
    mode(
        ModeId::SmartRtl,
        RoverMode::ROVER_MODE_SMART_RTL,
        "SMART_RTL",
        ModeEntry::Position,
    ),
    mode(
        ModeId::Guided,
        RoverMode::ROVER_MODE_GUIDED,
        "GUIDED",
        ModeEntry::Position,
    ),
    mode(
        ModeId::Initialising,
        RoverMode::ROVER_MODE_INITIALIZING,
        "INITIALISING",
        ModeEntry::Refused(&[]),
    ),
];
