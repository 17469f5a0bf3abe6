use sortie_geo::LatLon;

use crate::item::{HeightFrame, Item};

const NAV_ROI: u16 = 80;
const NAV_TAKEOFF: u16 = 22;
const NAV_VTOL_TAKEOFF: u16 = 84;
/// The last command that a vehicle flies to (`NAV_PAYLOAD_PLACE`); higher numbers only name a place.
const LAST_FLOWN: u16 = 94;
/// From `NAV_FENCE_RETURN_POINT` to `NAV_RALLY_POINT`.
const FENCE_AND_RALLY: std::ops::RangeInclusive<u16> = 5000..=5100;

/// Commands of a plan whose x and y are a place: the navigation commands with one, the regions of interest, setting
/// home, and the start of a landing sequence. Source: MAVLink's `MAV_CMD`, `hasLocation`.
const WITH_PLACE: [u16; 18] = [
    16, 17, 18, 19, 21, 22, 25, 31, 36, 80, 82, 84, 85, 94, 179, 189, 195, 201,
];

/// Whether x and y of commands with this number are a place.
pub fn has_place(command: u16) -> bool {
    WITH_PLACE.contains(&command) || FENCE_AND_RALLY.contains(&command)
}

impl Item {
    /// Its x and y as a place; `None` for a command without a place, and if both are 0 ("here").
    pub fn place(&self) -> Option<LatLon> {
        let is_given = (self.x, self.y) != (0, 0) && self.height_frame() != HeightFrame::Other;
        let place = (is_given && has_place(self.command)).then(|| self.point())?;
        place.is_valid().then_some(place)
    }

    /// Its z in metres, if it is a finite number.
    pub fn altitude_m(&self) -> Option<f32> {
        self.z.is_finite().then_some(self.z)
    }

    /// Whether the vehicle flies to its place, so that it belongs to the path.
    pub fn is_waypoint(&self) -> bool {
        self.place().is_some() && self.command <= LAST_FLOWN && self.command != NAV_ROI
    }

    /// Whether it is a takeoff, which has a height even without a place.
    pub const fn is_takeoff(&self) -> bool {
        matches!(self.command, NAV_TAKEOFF | NAV_VTOL_TAKEOFF)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn item(command: u16, frame: u8, x: i32) -> Item {
        Item {
            command,
            frame,
            auto_continue: true,
            params: [0.0; 4],
            x,
            y: 0,
            z: f32::NAN,
        }
    }

    #[test]
    fn a_place_needs_a_command_with_one_a_frame_and_numbers() {
        for (item, has) in [
            (item(16, 3, 1), true),
            (item(16, 3, 0), false),
            (item(16, 2, 1), false),
            (item(178, 3, 1), false),
            (item(5001, 0, 1), true),
            (item(16, 3, 910_000_000), false),
        ] {
            assert_eq!(item.place().is_some(), has, "{item:?}");
            assert_eq!(item.altitude_m(), None);
        }
    }

    #[test]
    fn regions_of_interest_are_not_flown_to() {
        assert!(item(16, 3, 1).is_waypoint());
        assert!(!item(80, 3, 1).is_waypoint());
        assert!(!item(201, 3, 1).is_waypoint());
        assert!(item(84, 3, 1).is_takeoff());
    }
}
