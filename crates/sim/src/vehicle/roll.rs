//! Driving: from the current task over the helm to the body.

use super::Vehicle;
use super::plant::Plant;
use crate::airframe::Airframe;
use crate::helm::Course;
use crate::kind::Chassis;
use crate::task::DriveNews;
use crate::wheels::{Handling, Outputs};

impl Vehicle {
    /// Lets the task drive the body of a rover for one step; returns what happened.
    pub(crate) fn drive(&mut self) -> Option<DriveNews> {
        let chassis = self.kind.chassis()?;
        let (course, news) = if self.safety.armed && !self.is_stopped() {
            self.with_cockpit(|task, cockpit| {
                let rules = cockpit.tuning.helm.as_deref()?;
                Some(task.course(cockpit, rules))
            })?
        } else {
            (Course::Off, None)
        };
        let rules = self.tuning.flight.helm.as_deref()?;
        let believed = self.estimator.belief(&self.plant.body);
        let helm = self.flight.helm.as_mut()?;
        let outputs = helm.step(course, believed, chassis, rules);
        let (handling, outputs) = self.handling(chassis, outputs);
        let body = &mut self.plant.body;
        let speed_m_s = body.velocity_m_s.truncate().dot(body.heading());
        if outputs.are_off() && Chassis::stands(speed_m_s) {
            body.park();
        } else {
            body.roll(handling.rolling(outputs, speed_m_s), outputs.throttle);
        }
        news
    }

    /// How the vehicle answers its outputs, and what is left of them: a built vehicle with an empty battery rolls on.
    fn handling(&self, chassis: Chassis, outputs: Outputs) -> (Handling, Outputs) {
        let Plant {
            airframe, battery, ..
        } = &self.plant;
        match airframe.gear() {
            None => (Handling::of_model(chassis), outputs),
            Some(gear) if Airframe::has_power(battery.voltage_share(airframe)) => {
                (Handling::of_gear(chassis, gear), outputs)
            }
            Some(gear) => (Handling::of_gear(chassis, gear), Outputs::default()),
        }
    }
}
