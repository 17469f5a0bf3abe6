//! The kinds of vehicles that can be built, and the slots of each. The frame, chassis or hull of a design says which kind
//! it is; each kind has figures of its own ([`Performance`](super::Performance)) and checks of its own (`check`).

use super::part::{Part, PartSlot, Spec};
use crate::sim::{Chassis as Steering, VehicleKind};
use crate::text;
use crate::text::Text;

/// What a design is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub enum DesignKind {
    /// A multirotor, which has a frame.
    #[default]
    Drone,
    /// A ground robot, steered or skid-steered.
    Robot,
    /// A boat, which has a hull.
    Boat,
}

impl DesignKind {
    /// All kinds, in the order in which a career unlocks them.
    pub const ALL: [Self; 3] = [Self::Drone, Self::Robot, Self::Boat];

    /// The kind of design that can be a vehicle of a simulator.
    pub fn of(kind: VehicleKind) -> Self {
        match kind {
            VehicleKind::Copter => Self::Drone,
            VehicleKind::Rover(Steering::Ackermann | Steering::Skid) => Self::Robot,
            VehicleKind::Rover(Steering::Boat) => Self::Boat,
        }
    }

    /// The slots of the kind, in the order of building.
    pub fn slots(self) -> &'static [PartSlot] {
        match self {
            Self::Drone => &PartSlot::ALL,
            // The controllers of motors and thrusters are part of the drive.
            Self::Robot | Self::Boat => &[
                PartSlot::Frame,
                PartSlot::Motor,
                PartSlot::Battery,
                PartSlot::Autopilot,
                PartSlot::Navigation,
                PartSlot::Power,
                PartSlot::Radio,
                PartSlot::Payload,
            ],
        }
    }

    /// The key of a slot in a vehicle of this kind, for lists of parts; files call every slot by [`PartSlot::key`].
    pub fn slot_key(self, slot: PartSlot) -> &'static str {
        match (self, slot) {
            (Self::Robot, PartSlot::Frame) => "chassis",
            (Self::Boat, PartSlot::Frame) => "hull",
            (Self::Robot | Self::Boat, PartSlot::Motor) => "drive",
            _ => slot.key(),
        }
    }

    /// The name of a slot in a vehicle of this kind.
    pub fn slot_name(self, slot: PartSlot) -> Text {
        match (self, slot) {
            (Self::Robot, PartSlot::Frame) => text!("slot-chassis"),
            (Self::Boat, PartSlot::Frame) => text!("slot-hull"),
            (Self::Robot | Self::Boat, PartSlot::Motor) => text!("slot-drive"),
            _ => slot.name(),
        }
    }

    /// The height at which the reach of the radio is stated, in metres: that of the antenna on the ground or on water.
    pub(super) fn radio_height_m(self) -> f64 {
        match self {
            Self::Drone => 50.0,
            Self::Robot | Self::Boat => 0.5,
        }
    }

    /// The name of the kind for people.
    pub fn name(self) -> Text {
        match self {
            Self::Drone => text!("kind-drone"),
            Self::Robot => text!("kind-robot"),
            Self::Boat => text!("kind-boat"),
        }
    }

    /// The message that a design of the kind has no problems.
    pub fn none_found(self) -> &'static str {
        match self {
            Self::Drone => "workshop-none",
            Self::Robot | Self::Boat => "workshop-none-driven",
        }
    }

    /// The kind's id in files and JSON.
    pub fn id(self) -> &'static str {
        match self {
            Self::Drone => "drone",
            Self::Robot => "robot",
            Self::Boat => "boat",
        }
    }
}

impl Part {
    /// The only kind of vehicle that takes the part; `None` if all do.
    pub fn only_for(&self) -> Option<DesignKind> {
        match self.spec {
            Spec::Frame(_) | Spec::Motor(_) | Spec::Propeller(_) | Spec::Esc(_) => {
                Some(DesignKind::Drone)
            }
            Spec::Chassis(_) | Spec::WheelDrive(_) | Spec::Flail => Some(DesignKind::Robot),
            Spec::Hull(_) | Spec::Thruster(_) => Some(DesignKind::Boat),
            Spec::Battery(_)
            | Spec::Autopilot
            | Spec::Navigation
            | Spec::PowerModule(_)
            | Spec::Radio(_)
            | Spec::Payload
            | Spec::Load => None,
        }
    }

    /// Whether a vehicle of this kind takes the part.
    pub fn fits(&self, kind: DesignKind) -> bool {
        self.only_for().is_none_or(|only| only == kind)
    }
}
