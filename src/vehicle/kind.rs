//! The kind of a vehicle, and what follows from it for its state.

use mavlink::dialects::ardupilotmega::MavType;

use super::{Heartbeat, LandedState, Vehicle, VehicleClass};
use crate::text;
use crate::text::Text;

/// Types of planes that hover.
const VTOL_TYPES: [MavType; 7] = [
    MavType::MAV_TYPE_VTOL_TAILSITTER_DUOROTOR,
    MavType::MAV_TYPE_VTOL_TAILSITTER_QUADROTOR,
    MavType::MAV_TYPE_VTOL_TILTROTOR,
    MavType::MAV_TYPE_VTOL_FIXEDROTOR,
    MavType::MAV_TYPE_VTOL_TAILSITTER,
    MavType::MAV_TYPE_VTOL_TILTWING,
    MavType::MAV_TYPE_VTOL_RESERVED5,
];
/// A vehicle that is slower than this stands; a boat at its place drifts a little.
const MOVING_M_S: f32 = 0.5;
/// The mode by which a plane that announces its modes shows that it hovers.
const HOVER_MODE: &str = "QHOVER";

impl Vehicle {
    /// The class of the vehicle; [`VehicleClass::Other`] before its first heartbeat.
    pub fn class(&self) -> VehicleClass {
        let heartbeat = self.heartbeat;
        heartbeat.map_or(VehicleClass::Other, |heartbeat| heartbeat.class)
    }

    /// Whether the vehicle moves on the ground or on water, so that it has no height of its own.
    pub fn is_on_surface(&self) -> bool {
        self.class() == VehicleClass::Rover
    }

    /// Whether the vehicle floats. A boat without power drifts.
    pub fn is_boat(&self) -> bool {
        self.has_type(&[MavType::MAV_TYPE_SURFACE_BOAT])
    }

    /// Whether the vehicle is known to be a plane that hovers. `ArduPilot` reports one as a fixed wing unless
    /// `Q_MAV_TYPE` says otherwise.
    pub fn is_vtol(&self) -> bool {
        self.has_type(&VTOL_TYPES)
            || self.class() == VehicleClass::Plane && self.modes.named(HOVER_MODE).is_some()
    }

    fn has_type(&self, types: &[MavType]) -> bool {
        let is_one = |beat: Heartbeat| types.iter().any(|known| *known as u8 == beat.mav_type);
        self.heartbeat.is_some_and(is_one)
    }

    /// The word for the vehicle's kind: copter, boat, ..
    pub fn kind_name(&self) -> Text {
        match self.class() {
            VehicleClass::Copter => text!("class-copter"),
            VehicleClass::Plane => text!("class-plane"),
            VehicleClass::Rover if self.is_boat() => text!("class-boat"),
            VehicleClass::Rover => text!("class-rover"),
            VehicleClass::Sub => text!("class-sub"),
            VehicleClass::Px4 | VehicleClass::Other => text!("class-vehicle"),
        }
    }

    /// Whether the vehicle is on the ground according to `EXTENDED_SYS_STATE`; without that
    /// message, whether it is not airborne. Always, if it moves on the ground or on water.
    pub fn is_on_the_ground(&self) -> bool {
        match self.landed {
            _ if self.is_on_surface() => true,
            LandedState::OnGround => true,
            LandedState::Undefined => self.heartbeat.is_some() && !self.airborne(),
            LandedState::InAir | LandedState::Takeoff | LandedState::Landing => false,
        }
    }

    /// Whether the vehicle is off the ground according to `EXTENDED_SYS_STATE`; without that
    /// message, whether it is armed and above 1 m. Never, if it moves on the ground or on water.
    pub fn airborne(&self) -> bool {
        match self.landed {
            _ if self.is_on_surface() => false,
            LandedState::InAir | LandedState::Takeoff | LandedState::Landing => true,
            LandedState::OnGround => false,
            LandedState::Undefined => {
                self.armed() && self.altitude_m().is_some_and(|altitude| altitude > 1.0)
            }
        }
    }

    /// Whether the vehicle is known to move over ground.
    pub fn moves(&self) -> bool {
        let speed_m_s = self.ground_speed_m_s();
        speed_m_s.is_some_and(|speed_m_s| speed_m_s >= MOVING_M_S)
    }

    /// Whether the vehicle is on its way: armed, and in the air unless it moves on the ground or on water.
    pub fn is_under_way(&self) -> bool {
        self.armed() && (self.is_on_surface() || !self.is_on_the_ground())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geo::LatLon;
    use crate::vehicle::{GlobalPosition, Mode, SystemStatus};
    use std::time::Duration;

    /// An armed vehicle, 20 m above its home, that does not report whether it is in the air.
    fn armed(mav_type: MavType) -> Vehicle {
        let mut vehicle = Vehicle::new(1, 1);
        let class = VehicleClass::from_mav_type(mav_type as u8);
        vehicle.heartbeat = Some(Heartbeat {
            mav_type: mav_type as u8,
            autopilot: Heartbeat::ARDUPILOT,
            class,
            mode: Mode { class, number: 15 },
            armed: true,
            status: SystemStatus::Active,
            at: Duration::ZERO,
        });
        vehicle.global = Some(GlobalPosition {
            at_point: LatLon::new(50.0, 30.0),
            altitude_amsl_m: 120.0,
            altitude_m: 20.0,
            north_m_s: 0.0,
            east_m_s: 0.0,
            down_m_s: 0.0,
            heading_deg: None,
            at: Duration::ZERO,
        });
        vehicle
    }

    #[test]
    fn a_rover_on_a_hill_is_under_way_and_not_in_the_air() {
        for mav_type in [
            MavType::MAV_TYPE_GROUND_ROVER,
            MavType::MAV_TYPE_SURFACE_BOAT,
        ] {
            let mut vehicle = armed(mav_type);
            assert!(!vehicle.airborne() && vehicle.is_on_the_ground() && vehicle.is_under_way());
            vehicle.landed = LandedState::InAir;
            assert!(!vehicle.airborne(), "whatever it reports");
        }
        let mut copter = armed(MavType::MAV_TYPE_QUADROTOR);
        assert!(copter.airborne() && copter.is_under_way());
        copter.landed = LandedState::OnGround;
        assert!(!copter.is_under_way());
    }

    #[test]
    fn boats_and_planes_that_hover_are_known_by_their_type() {
        assert!(armed(MavType::MAV_TYPE_SURFACE_BOAT).is_boat());
        assert!(!armed(MavType::MAV_TYPE_GROUND_ROVER).is_boat());
        assert!(armed(MavType::MAV_TYPE_VTOL_TILTROTOR).is_vtol());
        assert!(!armed(MavType::MAV_TYPE_FIXED_WING).is_vtol());
    }
}
