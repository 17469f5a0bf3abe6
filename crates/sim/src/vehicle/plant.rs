//! The physical vehicle, independent of the autopilot's estimate: body, battery and the air around
//! it.

use std::sync::Arc;

use crate::Start;
use crate::airframe::{Airframe, Conditions, air_density};
use crate::battery::Battery;
use crate::body::{Body, Demand};
use crate::tuning::Tuning;
use crate::upset::Drive;
use crate::wind::{Wind, WindRules};

/// The true state of the vehicle.
#[derive(Debug, Clone)]
pub(crate) struct Plant {
    pub(crate) airframe: Arc<Airframe>,
    pub(crate) body: Body,
    pub(crate) battery: Battery,
    pub(crate) wind: Wind,
    /// Density of the air at the start, in kg/m³.
    pub(crate) start_density: f64,
}

impl Plant {
    /// A vehicle at rest at a start, with the battery at a voltage.
    pub(super) fn resting(
        airframe: Arc<Airframe>,
        wind: Wind,
        start: &Start,
        battery_v: f64,
    ) -> Self {
        Self {
            body: Body::resting(start.heading_deg),
            battery: Battery::charged(&airframe, battery_v),
            airframe,
            wind,
            start_density: air_density(start.altitude_amsl_m),
        }
    }

    /// The current state of the air and of the battery.
    pub(super) fn conditions(&mut self, rules: &WindRules) -> Conditions {
        let height_m = self.body.height_m();
        // A tenth of a percent for 10 m, as in the standard atmosphere.
        let thinner = (1.0 - 1e-4 * height_m).clamp(0.1, 1.5);
        Conditions {
            wind_m_s: self.wind.step(height_m, rules),
            air_density: self.start_density * thinner,
            voltage_share: self.battery.voltage_share(&self.airframe),
        }
    }

    /// Moves the body by one step; returns the speed of an impact on the ground in m/s, if any.
    pub(super) fn step(
        &mut self,
        demand: Demand,
        conditions: &Conditions,
        tuning: &Tuning,
    ) -> Option<f64> {
        let drive = Drive {
            airframe: &self.airframe,
            conditions,
            fault: tuning.motor_fault,
            wrecked: self.body.wrecked,
        };
        self.body.step(demand, &drive)
    }

    /// The power that the motors draw, in watts.
    pub(crate) fn power_w(&self) -> f64 {
        self.airframe.power_w(self.body.thrust_m_s2)
    }

    /// A motor's pulse in microseconds: the minimum while the motors are stopped.
    pub(crate) fn motor_pulse_us(&self, motor: usize) -> u16 {
        if self.body.throttle <= 0.0 {
            return 1000;
        }
        let share = self.body.motor_share(motor, &self.airframe);
        self.airframe.pulse_us(share) as u16
    }
}
