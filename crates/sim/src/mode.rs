//! The flight modes and their properties.

use mavlink::dialects::ardupilotmega::CopterMode;

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
    /// `custom_mode` on the wire.
    pub(super) number: u8,
    /// The mode's name in `ArduCopter`'s texts.
    pub(super) name: &'static str,
    pub(super) entry: ModeEntry,
    /// Whether the autopilot holds or flies to positions, which sets the GUIDED bit of `base_mode`.
    pub(super) autonomous: bool,
    pub(super) controls_height: bool,
    pub(super) armable: bool,
}

const fn mode(number: u8, name: &'static str, entry: ModeEntry, facts: [bool; 3]) -> Mode {
    Mode {
        number,
        name,
        entry,
        autonomous: facts[0],
        controls_height: facts[1],
        armable: facts[2],
    }
}

const fn refused(number: u8, name: &'static str, texts: &'static [&'static str]) -> Mode {
    mode(number, name, ModeEntry::Refused(texts), [false; 3])
}

pub(super) const AUTOTUNE: u8 = CopterMode::COPTER_MODE_AUTOTUNE as u8;
pub(super) const FLOWHOLD: u8 = CopterMode::COPTER_MODE_FLOWHOLD as u8;
pub(super) const FLIP: u8 = CopterMode::COPTER_MODE_FLIP as u8;
pub(super) const THROW: u8 = CopterMode::COPTER_MODE_THROW as u8;
pub(super) const FOLLOW: u8 = CopterMode::COPTER_MODE_FOLLOW as u8;
pub(super) const TURTLE: u8 = CopterMode::COPTER_MODE_TURTLE as u8;
pub(super) const STABILIZE: u8 = CopterMode::COPTER_MODE_STABILIZE as u8;
pub(super) const ACRO: u8 = CopterMode::COPTER_MODE_ACRO as u8;
pub(super) const ALT_HOLD: u8 = CopterMode::COPTER_MODE_ALT_HOLD as u8;
pub(super) const AUTO: u8 = CopterMode::COPTER_MODE_AUTO as u8;
pub(super) const GUIDED: u8 = CopterMode::COPTER_MODE_GUIDED as u8;
pub(super) const LOITER: u8 = CopterMode::COPTER_MODE_LOITER as u8;
pub(super) const RTL: u8 = CopterMode::COPTER_MODE_RTL as u8;
pub(super) const CIRCLE: u8 = CopterMode::COPTER_MODE_CIRCLE as u8;
pub(super) const LAND: u8 = CopterMode::COPTER_MODE_LAND as u8;
pub(super) const DRIFT: u8 = CopterMode::COPTER_MODE_DRIFT as u8;
pub(super) const POSHOLD: u8 = CopterMode::COPTER_MODE_POSHOLD as u8;
pub(super) const BRAKE: u8 = CopterMode::COPTER_MODE_BRAKE as u8;
pub(super) const GUIDED_NOGPS: u8 = CopterMode::COPTER_MODE_GUIDED_NOGPS as u8;
pub(super) const SMART_RTL: u8 = CopterMode::COPTER_MODE_SMART_RTL as u8;
pub(super) const ZIGZAG: u8 = CopterMode::COPTER_MODE_ZIGZAG as u8;
pub(super) const AUTO_RTL: u8 = CopterMode::COPTER_MODE_AUTO_RTL as u8;

/// All modes. The flags of a row are, in this order: autonomous, controls the height, armable.
const MODES: &[Mode] = &[
    mode(
        STABILIZE,
        "STABILIZE",
        ModeEntry::Free,
        [false, false, true],
    ),
    mode(ACRO, "ACRO", ModeEntry::Free, [false, false, true]),
    mode(ALT_HOLD, "ALT_HOLD", ModeEntry::Free, [false, true, true]),
    mode(AUTO, "AUTO", ModeEntry::Plan, [true, true, false]),
    mode(GUIDED, "GUIDED", ModeEntry::Position, [true, true, true]),
    mode(LOITER, "LOITER", ModeEntry::Position, [true, true, true]),
    mode(RTL, "RTL", ModeEntry::Position, [true, true, false]),
    mode(CIRCLE, "CIRCLE", ModeEntry::Position, [true, true, false]),
    mode(LAND, "LAND", ModeEntry::Free, [false, true, false]),
    mode(DRIFT, "DRIFT", ModeEntry::Position, [false, false, true]),
    refused(FLIP, "FLIP", &["Mode change to FLIP failed: init failed"]),
    refused(
        AUTOTUNE,
        "AUTOTUNE",
        &["Mode change to AUTOTUNE failed: init failed"],
    ),
    mode(POSHOLD, "POSHOLD", ModeEntry::Position, [true, true, true]),
    mode(BRAKE, "BRAKE", ModeEntry::Position, [true, true, false]),
    refused(
        THROW,
        "THROW",
        &["Mode change to THROW failed: init failed"],
    ),
    mode(
        GUIDED_NOGPS,
        "GUIDED_NOGPS",
        ModeEntry::Free,
        [false, true, true],
    ),
    mode(
        SMART_RTL,
        "SMARTRTL",
        ModeEntry::Position,
        [true, true, false],
    ),
    refused(
        FLOWHOLD,
        "FLOWHOLD",
        &["Mode change to FLOWHOLD failed: init failed"],
    ),
    refused(
        FOLLOW,
        "FOLLOW",
        &[
            "Set FOLL_ENABLE = 1",
            "Mode change to FOLLOW failed: init failed",
        ],
    ),
    mode(ZIGZAG, "ZIGZAG", ModeEntry::Position, [false, true, true]),
    refused(
        AUTO_RTL,
        "AUTO_RTL",
        &[
            "Unable to start landing sequence",
            "Mode change to AUTO RTL failed: No return path or landing sequence found",
        ],
    ),
    refused(
        TURTLE,
        "TURTLE",
        &["Mode change to TURTLE failed: init failed"],
    ),
];

/// Every mode of the firmware, by number.
pub(super) fn all() -> impl Iterator<Item = &'static Mode> {
    MODES.iter()
}

/// Whether the mode takes setpoints from a ground station.
pub(super) fn is_guided(number: u8) -> bool {
    matches!(number, GUIDED | GUIDED_NOGPS)
}

/// Whether a speed command takes effect in the mode.
pub(super) fn changes_speed(number: u8) -> bool {
    matches!(number, AUTO | GUIDED | RTL | GUIDED_NOGPS | SMART_RTL)
}

/// Whether the mode flies along waypoints, at the speeds of the parameters.
pub(super) fn follows_waypoints(number: u8) -> bool {
    matches!(number, AUTO | RTL | SMART_RTL)
}

/// Whether the mode takes off by command; `ALT_HOLD` does only if the vehicle need not hold its
/// place.
pub(super) fn takes_off(number: u8, navigates: bool) -> bool {
    matches!(number, GUIDED | LOITER | POSHOLD | ZIGZAG) || (number == ALT_HOLD && !navigates)
}

impl Mode {
    /// The mode in which the vehicle boots.
    pub(super) const BOOT: Self = MODES[0];

    /// Whether the mode can never be entered; `AUTO_RTL` can, with a mission that has a landing.
    pub(super) fn is_always_refused(&self) -> bool {
        matches!(self.entry, ModeEntry::Refused(_)) && self.number != AUTO_RTL
    }

    /// Whether the mode flies by the horizontal position.
    pub(super) fn needs_position(&self) -> bool {
        matches!(self.entry, ModeEntry::Position | ModeEntry::Plan)
    }

    /// The mode with a number, if the firmware has it.
    pub(super) fn numbered(number: u8) -> Option<Self> {
        MODES.iter().copied().find(|mode| mode.number == number)
    }
}
