//! The true state of a vehicle.

use super::autopilot::Autopilot;
use sortie_geo::{LatLon, wrap_360};

/// The true state, independent of the telemetry: for tests and benchmarks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Truth {
    /// Latitude and longitude of the vehicle.
    pub at: LatLon,
    /// Metres above mean sea level.
    pub altitude_amsl_m: f64,
    /// Metres north, east and down from the start.
    pub position_ned_m: [f64; 3],
    /// Metres per second north, east and down.
    pub velocity_ned_m_s: [f64; 3],
    /// Degrees; positive to the right.
    pub roll_deg: f64,
    /// Degrees; positive nose up.
    pub pitch_deg: f64,
    /// Degrees clockwise from north, 0 to 360.
    pub heading_deg: f64,
    /// Whether the motors are armed.
    pub armed: bool,
    /// Whether the vehicle touches the ground.
    pub on_ground: bool,
    /// The mode as the firmware's `custom_mode` (0 is STABILIZE for a copter, MANUAL for a rover).
    pub mode: u8,
    /// The number of the plan item under way or flown last; 0 before the first.
    pub plan_item: u16,
    /// Whether the plan was flown to its end.
    pub plan_complete: bool,
    /// Volts at the battery's terminals, under load.
    pub battery_voltage_v: f64,
    /// Amperes drawn from the battery.
    pub battery_current_a: f64,
    /// Milliampere hours drawn since boot.
    pub battery_consumed_mah: f64,
    /// Throttle, 0 to 1.
    pub throttle: f64,
    /// The fences that are switched on and breached, as bits of `FENCE_TYPE`.
    pub broken_fences: u8,
}

impl Truth {
    /// The current true state of a vehicle.
    pub(super) fn of(autopilot: &Autopilot) -> Self {
        let body = &autopilot.vehicle.plant.body;
        let here = autopilot.vehicle.truly_here();
        let (roll, pitch) = body.roll_pitch_rad();
        Self {
            at: here.at,
            altitude_amsl_m: here.altitude_amsl_m,
            position_ned_m: body.position_m.to_array(),
            velocity_ned_m_s: body.velocity_m_s.to_array(),
            roll_deg: roll.to_degrees(),
            pitch_deg: pitch.to_degrees(),
            heading_deg: wrap_360(body.yaw_deg),
            armed: autopilot.vehicle.safety.armed,
            on_ground: body.on_ground,
            mode: autopilot.reported_mode(),
            plan_item: autopilot.auto_plan.current(),
            plan_complete: autopilot.auto_plan.is_complete(),
            battery_voltage_v: autopilot.vehicle.plant.battery.voltage_v,
            battery_current_a: autopilot.vehicle.plant.battery.current_a,
            battery_consumed_mah: autopilot.vehicle.plant.battery.consumed_mah,
            throttle: body.throttle,
            broken_fences: autopilot.vehicle.fence.broken_kinds(),
        }
    }
}
