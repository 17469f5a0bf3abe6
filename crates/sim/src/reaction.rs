//! Requests to the autopilot from the parts that monitor a flight.

use mavlink::dialects::ardupilotmega::MavSeverity;

use super::mode::ModeId;

/// One request; a part lists them in the order in which they must be carried out.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Reaction {
    /// Sends a text to every ground station.
    Say(MavSeverity, String),
    Disarm,
    /// Releases the sticks that a ground station overrides.
    ReleaseSticks,
    /// Takes the action set by a failsafe's parameters.
    Act(FailsafeAction),
    /// Leaves a mode that needs a position: holds the height if that is set and possible, otherwise lands.
    LeavePosition {
        holds_height: bool,
    },
    /// Compensates for a lost motor with more thrust than usual.
    BoostThrust,
    /// Enters the first of these modes that can be entered.
    EnterFirst(&'static [ModeId]),
}

impl Reaction {
    /// A text for every ground station, with a severity.
    pub(super) fn say(severity: MavSeverity, text: impl Into<String>) -> Self {
        Self::Say(severity, text.into())
    }
}

/// `ArduCopter`'s `FailsafeAction`: numbers as in the `BATT_FS_*_ACT` and `FS_DR_ENABLE` parameters.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum FailsafeAction {
    Nothing,
    Land,
    Return,
    PathBackOrReturn,
    PathBackOrLand,
    Terminate,
    PlannedLanding,
    BrakeOrLand,
    /// Only rovers: stops where it is.
    Hold,
    /// Only rovers: back along the path, or stops.
    PathBackOrHold,
}

impl FailsafeAction {
    /// The action of a battery parameter's value; unknown numbers mean no action.
    pub(super) fn numbered(number: i32) -> Self {
        match number {
            1 => Self::Land,
            2 => Self::Return,
            3 => Self::PathBackOrReturn,
            4 => Self::PathBackOrLand,
            5 => Self::Terminate,
            6 => Self::PlannedLanding,
            7 => Self::BrakeOrLand,
            _ => Self::Nothing,
        }
    }

    /// `ArduRover`'s action with a number, in `FS_ACTION`, `BATT_FS_*_ACT` and `FENCE_ACTION`.
    pub(super) fn of_rover(number: i32) -> Self {
        match number {
            1 => Self::Return,
            2 => Self::Hold,
            3 => Self::PathBackOrReturn,
            4 => Self::PathBackOrHold,
            5 => Self::Terminate,
            _ => Self::Nothing,
        }
    }

    /// The urgency of the action: 0 is the most urgent. The action of the battery's second level
    /// must not undo that of the first.
    pub(super) fn priority(self) -> u8 {
        match self {
            Self::Terminate => 0,
            Self::Land | Self::Hold => 1,
            Self::Return => 2,
            Self::PathBackOrLand | Self::PathBackOrHold => 3,
            Self::PathBackOrReturn => 4,
            Self::Nothing => 5,
            Self::PlannedLanding | Self::BrakeOrLand => 6,
        }
    }
}
