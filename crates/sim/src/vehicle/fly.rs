//! Flying: from the current task to the body, and back through the estimator.

use super::Vehicle;
use crate::body::Demand;
use crate::estimator::Surroundings;
use crate::mode::ModeId;
use crate::task::{Act, Task};
use crate::yaw::Turning;

impl Vehicle {
    /// Lets the task steer the body for one step; returns the speed of an impact on the ground in m/s, if any.
    pub(crate) fn fly(&mut self) -> Option<f64> {
        let act = if self.safety.armed && !self.is_stopped() {
            self.with_cockpit(Task::step)
        } else {
            Act::Idle
        };
        let believed = self.estimator.belief(&self.plant.body);
        let level_error_m_s2 = self.estimator.level_error_m_s2();
        let tuning = &self.tuning.flight;
        let demand = self.flight.demand(act, believed, level_error_m_s2, tuning);
        self.flight.end_turn(self.uptime());
        self.turn_by_stick();
        let conditions = self.plant.conditions(&self.tuning.wind);
        if demand != Demand::Off || !self.plant.body.on_ground {
            let turning = Turning {
                fastest_deg_s: self.tuning.slew_yaw_deg_s,
                accel_deg_s2: self.tuning.yaw_accel_deg_s2,
                is_upset: self.plant.body.upset.is_some(),
            };
            let rate_deg_s = self.flight.nose_rate_deg_s(&self.plant.body, turning);
            self.plant.body.turn(rate_deg_s);
        }
        let impact_m_s = self.plant.step(demand, &conditions, &self.tuning);
        if let Task::Takeoff(takeoff) = &self.flight.task {
            if takeoff.is_spooled(self.uptime()) {
                self.safety.landed = false;
            }
            if takeoff.reached {
                let goal_m = takeoff.goal_m;
                self.flight.end_takeoff(goal_m);
            }
        }
        impact_m_s
    }

    /// Updates the estimator, and shifts the path if the estimate has jumped.
    pub(crate) fn estimate(&mut self) {
        if !self.boot.is_over() {
            return;
        }
        if self.estimator.has_work(&self.tuning.faults) {
            self.estimate_with_faults();
        }
        if let Some(odometry) = &mut self.odometry {
            odometry.step(&self.plant.body);
            self.estimator.blur(&self.plant.body, odometry);
        }
    }

    fn estimate_with_faults(&mut self) {
        let around = Surroundings {
            now: self.uptime(),
            truth: &self.plant.body,
            faults: &self.tuning.faults,
            latitude_deg: self.datum.start.at.lat_deg,
        };
        if let Some(jump_m) = self.estimator.step(&around, &mut self.outbox) {
            self.flight.follow_jump(jump_m);
        }
    }

    /// Turns the nose by a deflected yaw stick, even while the autopilot flies.
    fn turn_by_stick(&mut self) {
        let steered = matches!(self.flight.task, Task::Piloted | Task::Manual);
        let overridden = self.uptime() < self.radio.until;
        if !self.safety.armed || !(steered || overridden) || self.flight.mode.id == ModeId::Brake {
            return;
        }
        let pilot = self.flight.pilot.clone();
        let rate = self.with_cockpit(|_, cockpit| pilot.turn_deg_s(cockpit));
        self.flight.turn_by_stick(rate);
    }
}
