//! The switches of rovers: their own functions, and those of copters that they do not know.

use super::super::Autopilot;
use crate::mode::ModeId;
use crate::radio::{MOTOR_INTERLOCK, SwitchPosition};

/// Functions that enter a mode of a rover.
const MODES: &[(u16, ModeId)] = &[
    (4, ModeId::Rtl),
    (16, ModeId::Auto),
    (42, ModeId::SmartRtl),
    (51, ModeId::Manual),
    (52, ModeId::Acro),
    (53, ModeId::Steering),
    (54, ModeId::Hold),
    (55, ModeId::Guided),
    (56, ModeId::Loiter),
    (57, ModeId::Follow),
    (59, ModeId::Simple),
    (72, ModeId::Circle),
];
/// Functions of rovers that have no effect in the simulation: none at all, learning the cruise speed, sails, walking,
/// trim.
const WITHOUT_EFFECT: &[u16] = &[0, 50, 63, 74, 97, 155, 201, 202, 207, 211];
/// Functions of copters that a rover does not know, apart from modes.
const UNKNOWN: &[u16] = &[
    super::SIMPLE,
    super::SAVE_TRIM,
    super::SUPER_SIMPLE,
    super::ACRO_TRAINER,
    super::PARACHUTE_ENABLE,
    super::PARACHUTE_RELEASE,
    super::PARACHUTE,
    MOTOR_INTERLOCK,
    super::ZIGZAG_POINTS,
    super::STANDBY,
    super::SIMPLE_HEADING,
    super::ARM_OR_DISARM_AIRMODE,
    super::PAUSE,
    // Those that have no effect on a copter either.
    10,
    25,
    26,
    29,
    39,
    44,
    45,
    75,
    83,
    84,
    109,
    159,
    160,
];

/// What a function is to a rover.
enum SurfaceFunction {
    Mode(ModeId),
    Idle,
    Unknown,
    /// It is that of every vehicle.
    Shared,
}

impl SurfaceFunction {
    fn numbered(function: u16) -> Self {
        if let Some((_, mode)) = MODES.iter().find(|(known, _)| *known == function) {
            Self::Mode(*mode)
        } else if WITHOUT_EFFECT.contains(&function) {
            Self::Idle
        } else if UNKNOWN.contains(&function) || super::is_mode(function) {
            Self::Unknown
        } else {
            Self::Shared
        }
    }
}

impl Autopilot {
    /// Runs a function of a rover; `None` for one of every vehicle.
    pub(super) fn run_surface_function(
        &mut self,
        function: u16,
        position: SwitchPosition,
    ) -> Option<bool> {
        match SurfaceFunction::numbered(function) {
            SurfaceFunction::Mode(mode) => {
                self.switch_mode(mode, position);
                Some(true)
            }
            SurfaceFunction::Idle => Some(true),
            SurfaceFunction::Unknown => Some(self.refuse_function(function)),
            SurfaceFunction::Shared => None,
        }
    }
}
