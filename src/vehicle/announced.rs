//! The modes that a vehicle announces (`AVAILABLE_MODES`). If it announces none, the built-in names
//! are used.

use std::sync::Arc;

use super::mode::{Mode, is_same_name};
use super::{Heartbeat, Vehicle};

/// A mode of a vehicle, as the vehicle announces it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct AnnouncedMode {
    /// The mode's place in the vehicle's list, from 1.
    pub index: u8,
    /// The number on the wire (`custom_mode`).
    pub number: u32,
    /// The mode's name as one word, with underscores for blanks.
    pub name: String,
    /// Whether users may set it; others are for the autopilot itself.
    pub is_selectable: bool,
}

/// The modes that a vehicle has announced so far.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct AnnouncedModes {
    list: Arc<Vec<AnnouncedMode>>,
    /// The number of modes in the vehicle's list; 0 while none was announced.
    total: u8,
    /// The last number of `AVAILABLE_MODES_MONITOR`, which changes with the list.
    monitor: Option<u8>,
}

impl AnnouncedModes {
    /// Adds a mode to a list of `total` modes. A list of another length is a new list.
    pub fn add(&mut self, mode: AnnouncedMode, total: u8) {
        if self.total != total {
            self.list = Arc::default();
            self.total = total;
        }
        let list = Arc::make_mut(&mut self.list);
        match list.binary_search_by_key(&mode.index, |known| known.index) {
            Ok(at) => list[at] = mode,
            Err(at) => list.insert(at, mode),
        }
    }

    /// Notes the monitor's number; a number other than the last one makes the list stale.
    pub fn note_monitor(&mut self, number: u8) {
        if self.monitor.is_some_and(|known| known != number) {
            *self = Self::default();
        }
        self.monitor = Some(number);
    }

    /// The monitor's number, if the vehicle sends one.
    pub fn monitor(&self) -> Option<u8> {
        self.monitor
    }

    /// Whether no mode has been announced.
    pub fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    /// Whether all modes of the list have arrived.
    pub fn is_complete(&self) -> bool {
        self.total > 0 && self.list.len() == usize::from(self.total)
    }

    /// The index of the first mode of the list that has not arrived; `None` if none is missing.
    pub fn missing(&self) -> Option<u8> {
        let has = |index: &u8| self.list.iter().any(|mode| mode.index == *index);
        (1..=self.total).find(|index| !has(index))
    }

    /// The modes, in the vehicle's order.
    pub fn iter(&self) -> impl Iterator<Item = &AnnouncedMode> {
        self.list.iter()
    }

    /// The mode of this number, if it was announced.
    pub fn numbered(&self, number: u32) -> Option<&AnnouncedMode> {
        self.list.iter().find(|mode| mode.number == number)
    }

    /// The mode of this name, if it was announced; case does not matter and underscores are
    /// optional.
    pub fn named(&self, name: &str) -> Option<&AnnouncedMode> {
        self.list.iter().find(|mode| is_same_name(&mode.name, name))
    }
}

impl Vehicle {
    /// The name of one of the vehicle's modes: the announced one, or the built-in one.
    pub fn name_of(&self, mode: Mode) -> String {
        let announced = self.modes.numbered(mode.number);
        announced.map_or_else(|| mode.to_string(), |known| known.name.clone())
    }

    /// The name of the vehicle's present mode, if known.
    pub fn mode_name(&self) -> Option<String> {
        self.mode().map(|mode| self.name_of(mode))
    }

    /// As [`Self::mode_name`], but of a built-in name in two parts only the second: `TAKEOFF` for `AUTO.TAKEOFF`.
    pub fn short_mode_name(&self) -> Option<String> {
        let mode = self.mode()?;
        match (self.modes.numbered(mode.number), mode.last_part()) {
            (None, Some(part)) => Some(part.to_owned()),
            _ => Some(self.name_of(mode)),
        }
    }

    /// The mode that was set last, if the vehicle is in another mode.
    pub fn mode_not_reached(&self) -> Option<Mode> {
        let now = self.heartbeat.as_ref().map(|beat: &Heartbeat| beat.mode)?;
        let number = self.intended_mode.filter(|&number| number != now.number)?;
        Some(Mode { number, ..now })
    }
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::*;
    use crate::vehicle::{SystemStatus, VehicleClass};

    fn mode(index: u8, number: u32, name: &str) -> AnnouncedMode {
        AnnouncedMode {
            index,
            number,
            name: name.to_owned(),
            is_selectable: true,
        }
    }

    #[test]
    fn modes_arrive_in_any_order_and_missing_ones_are_known() {
        let mut modes = AnnouncedModes::default();
        assert!(modes.is_empty() && modes.missing().is_none());
        modes.add(mode(3, 70, "CABLE_CAM"), 3);
        modes.add(mode(1, 65, "LAWN_MOWER"), 3);
        modes.add(mode(1, 65, "LAWN_MOWER"), 3);
        assert_eq!((modes.missing(), modes.is_complete()), (Some(2), false));
        modes.add(mode(2, 66, "HIDE"), 3);
        assert!(modes.is_complete() && modes.missing().is_none());
        let order: Vec<u32> = modes.iter().map(|mode| mode.number).collect();
        assert_eq!(order, [65, 66, 70]);
        assert_eq!(modes.named("lawnmower").map(|it| it.number), Some(65));
    }

    #[test]
    fn a_changed_monitor_makes_the_list_stale() {
        let mut modes = AnnouncedModes::default();
        modes.add(mode(1, 65, "LAWN_MOWER"), 1);
        modes.note_monitor(4);
        assert!(modes.is_complete(), "the first number says nothing");
        modes.note_monitor(4);
        assert!(modes.is_complete());
        modes.note_monitor(5);
        assert!(modes.is_empty());
        assert_eq!(modes.monitor(), Some(5));
    }

    #[test]
    fn announced_names_come_first_and_built_in_ones_stay() {
        let mut vehicle = Vehicle::new(1, 1);
        assert_eq!(vehicle.name_of(Mode::copter(6)), "RTL");
        vehicle.modes.add(mode(1, 6, "GO_HOME"), 2);
        assert_eq!(vehicle.name_of(Mode::copter(6)), "GO_HOME");
        assert_eq!(vehicle.name_of(Mode::copter(4)), "GUIDED");
        assert_eq!(vehicle.name_of(Mode::copter(65)), "MODE_65");
    }

    #[test]
    fn the_short_name_is_the_second_part_of_a_built_in_one() {
        let mut vehicle = Vehicle::new(1, 1);
        let class = VehicleClass::Px4;
        vehicle.heartbeat = Some(Heartbeat {
            mav_type: 2,
            autopilot: Heartbeat::PX4,
            class: VehicleClass::Copter,
            mode: class.mode("AUTO.TAKEOFF").expect("a mode"),
            armed: true,
            status: SystemStatus::Active,
            at: Duration::ZERO,
        });
        assert_eq!(vehicle.mode_name().as_deref(), Some("AUTO.TAKEOFF"));
        assert_eq!(vehicle.short_mode_name().as_deref(), Some("TAKEOFF"));
        vehicle.modes.add(mode(1, 0x0204_0000, "Take.Off"), 2);
        assert_eq!(vehicle.short_mode_name().as_deref(), Some("Take.Off"));
    }
}
