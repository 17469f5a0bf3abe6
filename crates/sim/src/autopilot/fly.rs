//! Flying: from the task at hand to the body, and back through the estimator.

use glam::DVec3;

use super::Autopilot;
use crate::airframe::Conditions;
use crate::body::Demand;
use crate::estimator::Surroundings;
use crate::mode;
use crate::task::{Act, Task};
use crate::upset::Drive;
use crate::yaw::{Turning, YawDemand};

impl Autopilot {
    /// Lets the task steer the body for one step.
    pub(super) fn fly(&mut self) {
        let act = if self.safety.armed {
            self.with_cockpit(Task::step)
        } else {
            Act::Idle
        };
        let demand = self.demand_of(act);
        self.end_turn();
        self.turn_by_stick();
        let conditions = self.conditions();
        if demand != Demand::Off || !self.body.on_ground {
            self.turn_nose();
        }
        let drive = Drive {
            airframe: &self.airframe,
            conditions: &conditions,
            fault: self.tuning.motor_fault,
            wrecked: self.body.wrecked,
        };
        if let Some(impact_m_s) = self.body.step(demand, &drive) {
            self.report_impact(impact_m_s);
        }
        if let Task::Takeoff(takeoff) = &self.task {
            if takeoff.is_spooled(self.uptime()) {
                self.safety.landed = false;
            }
            if takeoff.reached {
                let goal_m = takeoff.goal_m;
                self.end_takeoff(goal_m);
            }
        }
    }

    /// What the task asks of the body.
    fn demand_of(&mut self, act: Act) -> Demand {
        let believed = self.estimator.belief(&self.body);
        match act {
            Act::Idle => Demand::Off,
            Act::Throttle(throttle) => Demand::Throttle(throttle),
            Act::Accelerate(wanted) => Demand::Acceleration(wanted),
            Act::Fly => {
                let lean_max = self.tuning.flight.lean_max_rad;
                let correction = self.tuning.flight.accel_m_s2;
                Demand::Acceleration(self.control.demand(believed, lean_max, correction))
            }
            Act::Level => {
                let down = self.control.demand_level(believed);
                Demand::Acceleration(self.estimator.level_error_m_s2().extend(down))
            }
        }
    }

    fn turn_nose(&mut self) {
        let moving = self.control.velocity_m_s.truncate();
        let here = self.body.position_m.truncate();
        let turning = Turning {
            fastest_deg_s: self.tuning.slew_yaw_deg_s,
            accel_deg_s2: self.tuning.yaw_accel_deg_s2,
            is_upset: self.body.upset.is_some(),
        };
        let rate = self.yaw.step(self.body.yaw_deg, moving, here, turning);
        self.body.turn(rate);
    }

    /// Air and battery now.
    fn conditions(&mut self) -> Conditions {
        let height_m = self.body.height_m();
        // A tenth of a percent for 10 m, as in the standard atmosphere.
        let thinner = (1.0 - 1e-4 * height_m).clamp(0.1, 1.5);
        Conditions {
            wind_m_s: self.wind.step(height_m, &self.tuning.wind),
            air_density: self.start_density * thinner,
            voltage_share: self.battery.voltage_share(&self.airframe),
        }
    }

    /// Lets the estimator follow what has happened, and the path what it has jumped.
    pub(super) fn estimate(&mut self) {
        if !self.boot.is_over() || !self.estimator.has_work(&self.tuning.faults) {
            return;
        }
        let around = Surroundings {
            now: self.uptime(),
            truth: &self.body,
            faults: &self.tuning.faults,
            latitude_deg: self.datum.start.at.lat_deg,
        };
        if let Some(jump_m) = self.estimator.step(&around, &mut self.outbox) {
            self.control.path_m += jump_m;
            // The height of a takeoff is held where the vehicle is, wherever that is said to be.
            if let (Task::Goto { goal_m, .. }, Some(hold_m)) = (&mut self.task, &mut self.takeoff_m)
                && *goal_m == *hold_m
            {
                *goal_m += jump_m;
                *hold_m = *goal_m;
            }
        }
    }

    /// A turning rate lasts as long as the setpoint that asked for it.
    fn end_turn(&mut self) {
        let until = match &self.task {
            Task::Velocity { until, .. } | Task::Accelerate { until, .. } => *until,
            Task::Attitude(attitude) => attitude.until,
            _ => return,
        };
        if self.uptime() >= until && matches!(self.yaw.demand, YawDemand::Rate(_)) {
            self.yaw.demand = YawDemand::Hold;
        }
    }

    /// A yaw stick that is over turns the nose, also where the autopilot flies.
    fn turn_by_stick(&mut self) {
        let steered = matches!(self.task, Task::Piloted | Task::Manual);
        let overridden = self.uptime() < self.radio.until;
        if !self.safety.armed || !(steered || overridden) || self.mode.number == mode::BRAKE {
            return;
        }
        let pilot = self.pilot.clone();
        let rate = self.with_cockpit(|_, cockpit| pilot.turn_deg_s(cockpit));
        let turning = matches!(self.yaw.demand, YawDemand::Stick(_));
        if rate != 0.0 || turning {
            self.yaw.demand = YawDemand::Stick(rate);
        }
    }

    fn end_takeoff(&mut self, goal_m: DVec3) {
        self.takeoff_m = Some(goal_m);
        self.task = match self.mode.number {
            mode::GUIDED => Task::goto(goal_m),
            // The mission goes on by itself.
            mode::AUTO => return,
            _ => Task::Piloted,
        };
    }

    /// The pulse that a motor gets, in microseconds: the least while the motors stand still.
    pub(crate) fn motor_pulse_us(&self, motor: usize) -> u16 {
        if self.body.throttle <= 0.0 {
            return 1000;
        }
        let share = self.body.motor_share(motor, &self.airframe);
        self.airframe.pulse_us(share) as u16
    }
}
