//! The kinds of vehicles: each has a firmware, with its modes, parameters and texts.
//!
//! # How a second kind fits in
//! Both kinds share the autopilot, the vehicle and everything that is not about moving: links, parameters, lists, the
//! fence, the battery, the estimator, faults, logs. The kind picks tables: modes (`mode`), parameters (`parameters`),
//! commands (`commands`), the boot (`boot`), texts (here). A mode has the same identity in both firmwares (`ModeId`),
//! and a number of each.
//!
//! What a rover does in its own way is beside the copter's part, and the part chooses between them at one place:
//! - moving: `wheels` instead of the flight in `body`; `helm`, which steers along the same paths (`control`, the routes
//!   of `task`) that a copter leans along; the tasks in `task::drive`; `vehicle::roll` instead of `vehicle::fly`.
//! - deciding: `driving` in `autopilot` (modes, actions of failsafes), `auto_plan` (items of a mission), `commands` and
//!   `guided` (setpoints); `failsafe::surface`.

/// What a vehicle is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum VehicleKind {
    /// A multirotor that runs `ArduCopter`.
    #[default]
    Copter,
    /// A vehicle on the ground or on water that runs `ArduRover`.
    Rover(Chassis),
}

/// How a rover moves: the models of `ArduPilot`'s SITL.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Chassis {
    /// Steered front wheels, as on a car (the model `rover`).
    Ackermann,
    /// Motors on both sides; it turns on the spot (the model `rover-skid`).
    Skid,
    /// A boat with a motor that is steered (the model `motorboat`).
    Boat,
}

impl VehicleKind {
    /// All kinds, in the order of the help.
    pub const ALL: [Self; 4] = [
        Self::Copter,
        Self::Rover(Chassis::Ackermann),
        Self::Rover(Chassis::Skid),
        Self::Rover(Chassis::Boat),
    ];

    /// The kind's name: that of the model of `ArduPilot`'s SITL, and `copter`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Copter => "copter",
            Self::Rover(Chassis::Ackermann) => "rover",
            Self::Rover(Chassis::Skid) => "rover-skid",
            Self::Rover(Chassis::Boat) => "motorboat",
        }
    }

    /// The names of all kinds.
    pub fn names() -> Vec<&'static str> {
        Self::ALL.into_iter().map(Self::name).collect()
    }

    /// The kind with a name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.name() == name)
    }

    /// The version of the firmware, as in its banner: the behaviour is that of this commit of `ArduPilot`.
    pub(super) fn version(self) -> &'static str {
        match self {
            Self::Copter => "ArduCopter V4.6.0-dev (fbb78585)",
            Self::Rover(_) => "ArduRover V4.6.0-dev (fbb78585)",
        }
    }

    /// The frame in the banner; a rover does not report one.
    pub(super) fn frame_text(self) -> Option<&'static str> {
        match self {
            Self::Copter => Some("Frame: QUAD/PLUS"),
            Self::Rover(_) => None,
        }
    }

    /// The text after arming.
    pub(super) fn armed_text(self) -> &'static str {
        match self {
            Self::Copter => "Arming motors",
            Self::Rover(_) => "Throttle armed",
        }
    }

    /// The text after disarming.
    pub(super) fn disarmed_text(self) -> &'static str {
        match self {
            Self::Copter => "Disarming motors",
            Self::Rover(_) => "Throttle disarmed",
        }
    }

    /// The parameter that holds the channel of the mode switch.
    pub(super) fn mode_channel(self) -> &'static str {
        match self {
            Self::Copter => "FLTMODE_CH",
            Self::Rover(_) => "MODE_CH",
        }
    }

    /// The beginning of the parameters with the modes of the mode switch.
    pub(super) fn mode_parameters(self) -> &'static str {
        match self {
            Self::Copter => "FLTMODE",
            Self::Rover(_) => "MODE",
        }
    }

    /// How the vehicle moves on the surface; `None` for one that flies.
    pub(super) fn chassis(self) -> Option<Chassis> {
        match self {
            Self::Copter => None,
            Self::Rover(chassis) => Some(chassis),
        }
    }
}

impl Chassis {
    /// Parameters that differ from those of the model `rover`.
    pub(super) fn parameters(self) -> &'static [(&'static str, f32)] {
        match self {
            Self::Ackermann => &[],
            Self::Skid => &[
                ("ATC_STR_RAT_FF", 0.2),
                ("CRUISE_SPEED", 3.0),
                ("CRUISE_THROTTLE", 75.0),
                ("SERVO1_FUNCTION", 73.0),
                ("SERVO3_FUNCTION", 74.0),
                ("WP_SPEED", 3.0),
            ],
            Self::Boat => &[
                ("FRAME_CLASS", 2.0),
                ("MIS_DONE_BEHAVE", 1.0),
                ("SIM_WAVE_ENABLE", 1.0),
                ("SIM_WIND_SPD", 3.0),
                ("SIM_WIND_T", 1.0),
            ],
        }
    }
}
