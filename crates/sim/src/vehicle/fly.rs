//! Flying: from the task at hand to the body, and back through the estimator.

use glam::DVec3;

use super::Vehicle;
use crate::body::Demand;
use crate::estimator::Surroundings;
use crate::mode;
use crate::task::{Act, Task};
use crate::yaw::{Turning, YawDemand};

impl Vehicle {
    /// Lets the task steer the body for one step; the speed at which it hits the ground, if it does.
    pub(crate) fn fly(&mut self) -> Option<f64> {
        let act = if self.safety.armed {
            self.with_cockpit(Task::step)
        } else {
            Act::Idle
        };
        let demand = self.demand_of(act);
        self.end_turn();
        self.turn_by_stick();
        let conditions = self.plant.conditions(&self.tuning.wind);
        if demand != Demand::Off || !self.plant.body.on_ground {
            self.turn_nose();
        }
        let impact_m_s = self.plant.step(demand, &conditions, &self.tuning);
        if let Task::Takeoff(takeoff) = &self.flight.task {
            if takeoff.is_spooled(self.uptime()) {
                self.safety.landed = false;
            }
            if takeoff.reached {
                let goal_m = takeoff.goal_m;
                self.end_takeoff(goal_m);
            }
        }
        impact_m_s
    }

    /// What the task asks of the body.
    fn demand_of(&mut self, act: Act) -> Demand {
        let believed = self.estimator.belief(&self.plant.body);
        match act {
            Act::Idle => Demand::Off,
            Act::Throttle(throttle) => Demand::Throttle(throttle),
            Act::Accelerate(wanted) => Demand::Acceleration(wanted),
            Act::Fly => {
                let lean_max = self.tuning.flight.lean_max_rad;
                let correction = self.tuning.flight.accel_m_s2;
                Demand::Acceleration(self.flight.control.demand(believed, lean_max, correction))
            }
            Act::Level => {
                let down = self.flight.control.demand_level(believed);
                Demand::Acceleration(self.estimator.level_error_m_s2().extend(down))
            }
        }
    }

    fn turn_nose(&mut self) {
        let moving = self.flight.control.velocity_m_s.truncate();
        let here = self.plant.body.position_m.truncate();
        let turning = Turning {
            fastest_deg_s: self.tuning.slew_yaw_deg_s,
            accel_deg_s2: self.tuning.yaw_accel_deg_s2,
            is_upset: self.plant.body.upset.is_some(),
        };
        let rate = self
            .flight
            .yaw
            .step(self.plant.body.yaw_deg, moving, here, turning);
        self.plant.body.turn(rate);
    }

    /// Lets the estimator follow what has happened, and the path what it has jumped.
    pub(crate) fn estimate(&mut self) {
        if !self.boot.is_over() || !self.estimator.has_work(&self.tuning.faults) {
            return;
        }
        let around = Surroundings {
            now: self.uptime(),
            truth: &self.plant.body,
            faults: &self.tuning.faults,
            latitude_deg: self.datum.start.at.lat_deg,
        };
        if let Some(jump_m) = self.estimator.step(&around, &mut self.outbox) {
            self.flight.control.path_m += jump_m;
            // The height of a takeoff is held where the vehicle is, wherever that is said to be.
            if let (Task::Goto { goal_m, .. }, Some(hold_m)) =
                (&mut self.flight.task, &mut self.flight.takeoff_m)
                && *goal_m == *hold_m
            {
                *goal_m += jump_m;
                *hold_m = *goal_m;
            }
        }
    }

    /// A turning rate lasts as long as the setpoint that asked for it.
    fn end_turn(&mut self) {
        let until = match &self.flight.task {
            Task::Velocity { until, .. } | Task::Accelerate { until, .. } => *until,
            Task::Attitude(attitude) => attitude.until,
            _ => return,
        };
        if self.uptime() >= until && matches!(self.flight.yaw.demand, YawDemand::Rate(_)) {
            self.flight.yaw.demand = YawDemand::Hold;
        }
    }

    /// A yaw stick that is over turns the nose, also where the autopilot flies.
    fn turn_by_stick(&mut self) {
        let steered = matches!(self.flight.task, Task::Piloted | Task::Manual);
        let overridden = self.uptime() < self.radio.until;
        if !self.safety.armed || !(steered || overridden) || self.flight.mode.number == mode::BRAKE
        {
            return;
        }
        let pilot = self.flight.pilot.clone();
        let rate = self.with_cockpit(|_, cockpit| pilot.turn_deg_s(cockpit));
        let turning = matches!(self.flight.yaw.demand, YawDemand::Stick(_));
        if rate != 0.0 || turning {
            self.flight.yaw.demand = YawDemand::Stick(rate);
        }
    }

    fn end_takeoff(&mut self, goal_m: DVec3) {
        self.flight.takeoff_m = Some(goal_m);
        self.flight.task = match self.flight.mode.number {
            mode::GUIDED => Task::goto(goal_m),
            // The mission goes on by itself.
            mode::AUTO => return,
            _ => Task::Piloted,
        };
    }
}
