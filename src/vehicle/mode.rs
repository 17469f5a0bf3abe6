//! Flight modes by name, per class of vehicle. Source: ArduPilot's `Mode::Number` enums of each vehicle
//! (ArduCopter, `ArduPlane`, Rover, `ArduSub`; 4.6), the same numbers as MAVLink's `COPTER_MODE` and siblings. PX4 has
//! one table for all its vehicles.

use std::fmt;

use mavlink::dialects::ardupilotmega::MavType;
use serde::{Deserialize, Serialize};

use super::px4_modes::PX4;

/// The class of a vehicle, which has its own mode table.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub enum VehicleClass {
    Copter,
    /// Fixed wing and VTOL.
    Plane,
    /// Ground vehicles and boats.
    Rover,
    Sub,
    /// Any vehicle with PX4, as the class of its modes only: its own class is that of its type.
    Px4,
    /// Any other vehicle, whose modes are shown by number.
    Other,
}

/// A flight mode: HEARTBEAT's `custom_mode` and the class that gives it its name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Mode {
    /// The class whose mode table contains the number.
    pub class: VehicleClass,
    /// The number on the wire (`custom_mode`).
    pub number: u32,
}

const COPTER: &[(u32, &str)] = &[
    (0, "STABILIZE"),
    (1, "ACRO"),
    (2, "ALT_HOLD"),
    (3, "AUTO"),
    (4, "GUIDED"),
    (5, "LOITER"),
    (6, "RTL"),
    (7, "CIRCLE"),
    (9, "LAND"),
    (11, "DRIFT"),
    (13, "SPORT"),
    (14, "FLIP"),
    (15, "AUTOTUNE"),
    (16, "POSHOLD"),
    (17, "BRAKE"),
    (18, "THROW"),
    (19, "AVOID_ADSB"),
    (20, "GUIDED_NOGPS"),
    (21, "SMART_RTL"),
    (22, "FLOWHOLD"),
    (23, "FOLLOW"),
    (24, "ZIGZAG"),
    (25, "SYSTEMID"),
    (26, "AUTOROTATE"),
    (27, "AUTO_RTL"),
    (28, "TURTLE"),
];

const PLANE: &[(u32, &str)] = &[
    (0, "MANUAL"),
    (1, "CIRCLE"),
    (2, "STABILIZE"),
    (3, "TRAINING"),
    (4, "ACRO"),
    (5, "FBWA"),
    (6, "FBWB"),
    (7, "CRUISE"),
    (8, "AUTOTUNE"),
    (10, "AUTO"),
    (11, "RTL"),
    (12, "LOITER"),
    (13, "TAKEOFF"),
    (14, "AVOID_ADSB"),
    (15, "GUIDED"),
    (16, "INITIALISING"),
    (17, "QSTABILIZE"),
    (18, "QHOVER"),
    (19, "QLOITER"),
    (20, "QLAND"),
    (21, "QRTL"),
    (22, "QAUTOTUNE"),
    (23, "QACRO"),
    (24, "THERMAL"),
    (25, "LOITER_ALT_QLAND"),
    (26, "AUTOLAND"),
];

const ROVER: &[(u32, &str)] = &[
    (0, "MANUAL"),
    (1, "ACRO"),
    (3, "STEERING"),
    (4, "HOLD"),
    (5, "LOITER"),
    (6, "FOLLOW"),
    (7, "SIMPLE"),
    (8, "DOCK"),
    (9, "CIRCLE"),
    (10, "AUTO"),
    (11, "RTL"),
    (12, "SMART_RTL"),
    (15, "GUIDED"),
    (16, "INITIALISING"),
];

const SUB: &[(u32, &str)] = &[
    (0, "STABILIZE"),
    (1, "ACRO"),
    (2, "ALT_HOLD"),
    (3, "AUTO"),
    (4, "GUIDED"),
    (7, "CIRCLE"),
    (9, "SURFACE"),
    (16, "POSHOLD"),
    (19, "MANUAL"),
    (20, "MOTOR_DETECT"),
    (21, "SURFTRAK"),
];

/// Modes that stop a vehicle where it is, under the names of every class.
const STOPPING: [&str; 3] = ["BRAKE", "HOLD", "AUTO.LOITER"];

const COPTER_TYPES: &[MavType] = &[
    MavType::MAV_TYPE_QUADROTOR,
    MavType::MAV_TYPE_COAXIAL,
    MavType::MAV_TYPE_HELICOPTER,
    MavType::MAV_TYPE_HEXAROTOR,
    MavType::MAV_TYPE_OCTOROTOR,
    MavType::MAV_TYPE_TRICOPTER,
    MavType::MAV_TYPE_DODECAROTOR,
];

const PLANE_TYPES: &[MavType] = &[
    MavType::MAV_TYPE_FIXED_WING,
    MavType::MAV_TYPE_FLAPPING_WING,
    MavType::MAV_TYPE_VTOL_TAILSITTER_DUOROTOR,
    MavType::MAV_TYPE_VTOL_TAILSITTER_QUADROTOR,
    MavType::MAV_TYPE_VTOL_TILTROTOR,
    MavType::MAV_TYPE_VTOL_FIXEDROTOR,
    MavType::MAV_TYPE_VTOL_TAILSITTER,
    MavType::MAV_TYPE_VTOL_TILTWING,
    MavType::MAV_TYPE_VTOL_RESERVED5,
];

const ROVER_TYPES: &[MavType] = &[
    MavType::MAV_TYPE_GROUND_ROVER,
    MavType::MAV_TYPE_SURFACE_BOAT,
];

impl VehicleClass {
    /// The class of a `MAV_TYPE`.
    pub fn from_mav_type(mav_type: u8) -> Self {
        let of_class = |types: &[MavType]| types.iter().any(|known| *known as u8 == mav_type);
        if of_class(COPTER_TYPES) {
            Self::Copter
        } else if of_class(PLANE_TYPES) {
            Self::Plane
        } else if of_class(ROVER_TYPES) {
            Self::Rover
        } else if mav_type == MavType::MAV_TYPE_SUBMARINE as u8 {
            Self::Sub
        } else {
            Self::Other
        }
    }

    /// The numbers and names of the modes of this class.
    pub fn modes(self) -> &'static [(u32, &'static str)] {
        match self {
            Self::Copter => COPTER,
            Self::Plane => PLANE,
            Self::Rover => ROVER,
            Self::Sub => SUB,
            Self::Px4 => PX4,
            Self::Other => &[],
        }
    }

    /// The mode with this name, if any; case does not matter and underscores are optional. The second part of a
    /// two-part name is enough: `RTL` for `AUTO.RTL`.
    pub fn mode(self, name: &str) -> Option<Mode> {
        let modes = self.modes();
        let whole = modes.iter().find(|(_, known)| is_same_name(known, name));
        let found = whole.or_else(|| modes.iter().find(|(_, known)| ends_with(known, name)));
        found.map(|&(number, _)| Mode {
            class: self,
            number,
        })
    }
}

impl Mode {
    /// A mode of a copter by its number.
    pub fn copter(number: u8) -> Self {
        Self {
            class: VehicleClass::Copter,
            number: u32::from(number),
        }
    }

    /// The mode's name, if its class has a name for the number.
    pub fn name(self) -> Option<&'static str> {
        self.class
            .modes()
            .iter()
            .find(|(number, _)| *number == self.number)
            .map(|&(_, name)| name)
    }

    /// The second part of a two-part name.
    pub fn last_part(self) -> Option<&'static str> {
        let parts = self.name()?.split_once('.');
        parts.map(|(_, part)| part)
    }

    /// Whether the vehicle returns or lands on its own, and so ends on the ground.
    pub fn comes_down(self) -> bool {
        let names: &[&str] = match self.class {
            VehicleClass::Copter => &["LAND", "RTL", "SMART_RTL", "AUTO_RTL"],
            // In RTL, a plane circles above its home, so RTL is missing here.
            VehicleClass::Plane => &["QLAND", "QRTL", "LOITER_ALT_QLAND", "AUTOLAND"],
            VehicleClass::Rover => &["RTL", "SMART_RTL"],
            VehicleClass::Px4 => &["AUTO.LAND", "AUTO.RTL", "AUTO.PRECLAND"],
            VehicleClass::Sub | VehicleClass::Other => &[],
        };
        names.iter().any(|name| self.is(name))
    }

    /// Whether the vehicle flies its plan.
    pub fn flies_plan(self) -> bool {
        matches!(self.name(), Some("AUTO" | "AUTO.MISSION"))
    }

    /// Whether the vehicle stops where it is.
    pub fn stops(self) -> bool {
        STOPPING.iter().any(|name| self.is(name))
    }

    /// Whether this is the mode of that name; the second part of a two-part name is enough.
    pub fn is(self, name: &str) -> bool {
        self.name()
            .is_some_and(|known| is_same_name(known, name) || ends_with(known, name))
    }
}

/// Whether two names mean the same mode: case does not matter and underscores are optional. Allocates nothing, because every position message of a
/// vehicle looks up the name of its mode.
pub fn is_same_name(one: &str, other: &str) -> bool {
    letters(one).eq(letters(other))
}

/// Whether the second part of a two-part name is that name.
fn ends_with(known: &str, name: &str) -> bool {
    let parts = known.split_once('.');
    parts.is_some_and(|(_, part)| is_same_name(part, name))
}

fn letters(name: &str) -> impl Iterator<Item = u8> {
    let letters = name.bytes().filter(|byte| *byte != b'_');
    letters.map(|byte| byte.to_ascii_uppercase())
}

impl fmt::Display for Mode {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.name() {
            Some(name) => f.pad(name),
            None => f.pad(&format!("MODE_{}", self.number)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_name_leads_back_to_its_number() {
        for class in [
            VehicleClass::Copter,
            VehicleClass::Plane,
            VehicleClass::Rover,
            VehicleClass::Sub,
            VehicleClass::Px4,
        ] {
            for &(number, name) in class.modes() {
                assert_eq!(class.mode(name), Some(Mode { class, number }));
                assert_eq!(
                    class
                        .mode(&name.to_lowercase().replace('_', ""))
                        .map(|m| m.number),
                    Some(number)
                );
            }
        }
    }

    #[test]
    fn a_plane_circles_in_rtl_while_a_copter_lands() {
        let comes_down = |class: VehicleClass, name| {
            let mode = class.mode(name).expect("it has the mode");
            mode.comes_down()
        };
        assert!(comes_down(VehicleClass::Copter, "RTL"));
        assert!(!comes_down(VehicleClass::Plane, "RTL"));
        assert!(comes_down(VehicleClass::Plane, "QRTL"));
    }

    #[test]
    fn the_second_part_of_a_px4_name_is_enough() {
        let px4 = VehicleClass::Px4;
        let rtl = px4.mode("rtl").expect("a mode");
        assert_eq!(rtl.number, 0x0504_0000);
        assert_eq!(rtl.to_string(), "AUTO.RTL");
        assert!(rtl.is("RTL") && rtl.is("AUTO.RTL") && !rtl.is("AUTO") && rtl.comes_down());
        assert_eq!(px4.mode("GUIDED"), None);
    }

    #[test]
    fn unnamed_modes_show_their_number() {
        let mode = Mode {
            class: VehicleClass::Copter,
            number: 99,
        };
        assert_eq!(mode.to_string(), "MODE_99");
    }
}
