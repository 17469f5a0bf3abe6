//! Driving: from the current task over the helm to the body.

use super::Vehicle;
use super::plant::Plant;
use crate::airframe::Airframe;
use crate::helm::Course;
use crate::kind::Chassis;
use crate::output_test::OutputTest;
use crate::task::{DriveNews, stick_outputs};
use crate::wheels::{Handling, Outputs};

impl Vehicle {
    /// Lets the task drive the body of a rover for one step, or a test one of its outputs; returns what happened.
    pub(crate) fn drive(&mut self, test: Option<&OutputTest>) -> Option<DriveNews> {
        let chassis = self.kind.chassis()?;
        let (course, news) = if self.safety.armed && !self.is_stopped() {
            self.with_cockpit(|task, cockpit| {
                let rules = cockpit.tuning.helm.as_deref()?;
                Some(task.course(cockpit, rules))
            })?
        } else {
            (Course::Off, None)
        };
        let test = test.map(|test| (test, self.with_cockpit(|_, cockpit| stick_outputs(cockpit))));
        let rules = self.tuning.flight.helm.as_deref()?;
        let believed = self.estimator.belief(&self.plant.body);
        let helm = self.flight.helm.as_mut()?;
        let kept = helm.outputs;
        let mut outputs = helm.step(course, believed, chassis, rules);
        if let Some((test, sticks)) = test {
            outputs = test.outputs(chassis, kept, sticks);
            helm.outputs = outputs;
        }
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
