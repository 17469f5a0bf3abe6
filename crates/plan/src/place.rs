use sortie_geo::LatLon;

use crate::{HeightFrame, Item, command};

impl Item {
    /// The item's x and y as a place; `None` for a command or a frame without a place, if both are
    /// 0 ("here"), or if they are out of range.
    pub fn place(&self) -> Option<LatLon> {
        let is_given = (self.x, self.y) != (0, 0) && self.height_frame() != HeightFrame::Other;
        let place = (is_given && command::has_place(self.command)).then(|| self.point())?;
        place.is_valid().then_some(place)
    }

    /// The item's z in metres, if it is a finite number.
    pub fn altitude_m(&self) -> Option<f32> {
        self.z.is_finite().then_some(self.z)
    }

    /// Whether the vehicle flies to the item's place, which is then part of its path.
    pub fn is_waypoint(&self) -> bool {
        self.place().is_some() && command::is_flown_to(self.command)
    }

    /// Whether the item is a takeoff, which has a height even without a place.
    pub fn is_takeoff(&self) -> bool {
        command::is_takeoff(self.command)
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
