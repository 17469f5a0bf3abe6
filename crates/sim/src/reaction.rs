//! Requests to the autopilot from the parts that watch over a flight.

use mavlink::dialects::ardupilotmega::MavSeverity;

/// One thing to do, in the order in which a part lists them.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Reaction {
    /// Tell every ground station.
    Say(MavSeverity, String),
    Disarm,
    /// The sticks that a ground station held are let go.
    ReleaseSticks,
    /// The action set by a failsafe's parameters.
    Act(FailsafeAction),
    /// Modes that need a position end: the height is held, if so set and possible, or else the vehicle lands.
    LeavePosition {
        holds_height: bool,
    },
    /// A lost motor is made up for with more thrust than is usual.
    BoostThrust,
    /// The first of these modes that can be entered.
    EnterFirst(&'static [u8]),
}

impl Reaction {
    /// Tells something of a severity.
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
}

impl FailsafeAction {
    /// The action of a battery parameter's value; unknown numbers do nothing.
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

    /// Its urgency: 0 is the most urgent. The battery's second level must not undo the first's.
    pub(super) fn priority(self) -> u8 {
        match self {
            Self::Terminate => 0,
            Self::Land => 1,
            Self::Return => 2,
            Self::PathBackOrLand => 3,
            Self::PathBackOrReturn => 4,
            Self::Nothing => 5,
            Self::PlannedLanding | Self::BrakeOrLand => 6,
        }
    }
}
