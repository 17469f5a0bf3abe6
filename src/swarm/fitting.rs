//! Fits a generated plan, which is made for copters, to another kind of vehicle.

use crate::plan::{Document, Item, command};
use crate::vehicle::{Vehicle, VehicleClass};

/// The plan as this vehicle can carry it out. A rover or boat skips takeoffs and landings, so it drives to the place of the
/// landing instead; a plane circles above home at the end, because a landing needs an approach.
pub(super) fn fitted(mut document: Document, vehicle: &Vehicle) -> Document {
    match vehicle.class() {
        VehicleClass::Rover => {
            document
                .plan
                .retain(|item| item.command != command::TAKEOFF);
            replace_landing(&mut document.plan, |item| Item {
                command: command::WAYPOINT,
                ..item
            });
        }
        VehicleClass::Plane => replace_landing(&mut document.plan, |item| Item {
            command: command::RETURN_TO_LAUNCH,
            x: 0,
            y: 0,
            ..item
        }),
        VehicleClass::Copter | VehicleClass::Sub | VehicleClass::Px4 | VehicleClass::Other => {}
    }
    document
}

fn replace_landing(plan: &mut [Item], with: impl Fn(Item) -> Item) {
    for item in plan {
        if item.command == command::LAND {
            *item = with(*item);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vehicle::{Heartbeat, Mode, SystemStatus};
    use mavlink::dialects::ardupilotmega::MavType;
    use std::time::Duration;

    fn commands_of(mav_type: MavType) -> Vec<u16> {
        let mut vehicle = Vehicle::new(1, 1);
        let class = VehicleClass::from_mav_type(mav_type as u8);
        vehicle.heartbeat = Some(Heartbeat {
            mav_type: mav_type as u8,
            autopilot: Heartbeat::ARDUPILOT,
            class,
            mode: Mode { class, number: 15 },
            armed: false,
            status: SystemStatus::Standby,
            at: Duration::ZERO,
        });
        let item = |command| Item {
            command,
            x: 1,
            y: 2,
            ..Item::default()
        };
        let document = Document {
            plan: [command::TAKEOFF, command::WAYPOINT, command::LAND]
                .map(item)
                .to_vec(),
            ..Document::default()
        };
        let plan = fitted(document, &vehicle).plan;
        plan.iter().map(|item| item.command).collect()
    }

    #[test]
    fn a_rover_drives_home_and_a_plane_circles_there() {
        let (waypoint, rtl) = (command::WAYPOINT, command::RETURN_TO_LAUNCH);
        for (mav_type, commands) in [
            (MavType::MAV_TYPE_GROUND_ROVER, vec![waypoint, waypoint]),
            (
                MavType::MAV_TYPE_FIXED_WING,
                vec![command::TAKEOFF, waypoint, rtl],
            ),
            (
                MavType::MAV_TYPE_QUADROTOR,
                vec![command::TAKEOFF, waypoint, command::LAND],
            ),
        ] {
            assert_eq!(commands_of(mav_type), commands);
        }
    }
}
