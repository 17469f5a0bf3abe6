//! The vehicle in flight: the mode, the task, and the path and the nose that follow it.

use std::time::Duration;

use glam::{DVec2, DVec3};

use crate::body::{Body, Demand};
use crate::control::{Limits, PositionControl};
use crate::helm::Helm;
use crate::kind::VehicleKind;
use crate::mode::{self, Mode, ModeId};
use crate::radio::SimpleSticks;
use crate::task::{Act, Drive, FlightTuning, Pilot, Task};
use crate::trail::Trail;
use crate::yaw::{Turning, YawControl, YawDemand};

/// Speeds set by commands; they last until the mode changes, in GUIDED only until the kind of target changes.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[expect(clippy::struct_field_names, reason = "the unit belongs to each name")]
pub(crate) struct AskedSpeeds {
    pub(crate) ground_m_s: Option<f64>,
    pub(crate) up_m_s: Option<f64>,
    pub(crate) down_m_s: Option<f64>,
}

#[derive(Debug, Clone)]
pub(crate) struct FlightState {
    pub(crate) mode: Mode,
    pub(crate) task: Task,
    /// The task that `DO_PAUSE_CONTINUE` interrupted.
    pub(crate) paused: Option<Task>,
    pub(crate) speeds: AskedSpeeds,
    pub(crate) control: PositionControl,
    /// The steering of a rover; `None` for a vehicle that flies.
    pub(crate) helm: Option<Box<Helm>>,
    pub(crate) yaw: YawControl,
    /// The state of the piloted modes.
    pub(crate) pilot: Pilot,
    /// The reference of the sticks.
    pub(crate) simple: SimpleSticks,
    /// Whether a switch has turned the GPS off.
    pub(crate) gps_off: bool,
    /// The return path of `SMART_RTL`.
    pub(crate) trail: Trail,
    /// The end of the last takeoff, until the vehicle gets another target.
    pub(crate) takeoff_m: Option<DVec3>,
    /// Whether a rover drives backwards along its path, until the mode changes.
    pub(crate) backs_up: bool,
    /// When BRAKE, entered by the pause button, turns into LOITER.
    pub(crate) brake_until: Option<Duration>,
}

impl FlightState {
    pub(super) fn resting(kind: VehicleKind, body: &Body) -> Self {
        Self {
            mode: Mode::boot(kind),
            task: match kind {
                VehicleKind::Copter => Task::Manual,
                VehicleKind::Rover(_) => Task::Drive(Drive::Manual),
            },
            paused: None,
            speeds: AskedSpeeds::default(),
            control: PositionControl::at(body),
            helm: kind.chassis().map(|_| Box::default()),
            yaw: YawControl::holding(body.yaw_deg),
            pilot: Pilot::default(),
            simple: SimpleSticks::default(),
            gps_off: false,
            trail: Trail::default(),
            takeoff_m: None,
            backs_up: false,
            brake_until: None,
        }
    }

    /// Whether the vehicle is landing.
    pub(crate) fn is_landing(&self) -> bool {
        self.mode.id == ModeId::Land
            || matches!(&self.task, Task::Return(way) if way.landing().is_some())
    }

    /// Whether the vehicle still holds the end of a takeoff, without a new target since.
    pub(crate) fn holds_takeoff(&self) -> bool {
        matches!(&self.task, Task::Goto { goal_m, .. } if self.takeoff_m == Some(*goal_m))
    }

    /// The task of the mode for a vehicle on the ground.
    pub(crate) fn wait_on_ground(&mut self) {
        if self.helm.is_some() {
            // A rover keeps its task.
            return;
        }
        self.task = match self.mode.id {
            ModeId::Stabilize | ModeId::Acro | ModeId::Drift => Task::Manual,
            ModeId::Guided
            | ModeId::GuidedNoGps
            | ModeId::Auto
            | ModeId::Brake
            | ModeId::Circle => Task::Wait,
            ModeId::Rtl | ModeId::SmartRtl | ModeId::Land => self.task.clone(),
            _ => Task::Piloted,
        };
    }

    /// Applies speed parameters that have changed in flight: cruise, climb, descent. Modes that fly
    /// along waypoints use the new speeds at once, even after a command for another speed; other
    /// modes keep the cruise speed with which they were entered.
    pub(super) fn speeds_changed(&mut self, before: [f64; 3], now: [f64; 3]) {
        let changed = |place: usize| before[place].to_bits() != now[place].to_bits();
        let asked = &mut self.speeds;
        if mode::follows_waypoints(self.mode.id) {
            let speeds = [
                &mut asked.ground_m_s,
                &mut asked.up_m_s,
                &mut asked.down_m_s,
            ];
            for (place, speed) in speeds.into_iter().enumerate() {
                if changed(place) {
                    *speed = None;
                }
            }
        } else if asked.ground_m_s.is_none() {
            asked.ground_m_s = Some(before[0]);
        }
    }

    /// The limits of the flight: from the parameters, with changes by commands.
    pub(super) fn limits(&self, tuning: &FlightTuning) -> Limits {
        let asked = self.speeds;
        Limits {
            speed_m_s: asked.ground_m_s.unwrap_or(tuning.speed_m_s),
            speed_up_m_s: asked.up_m_s.unwrap_or(tuning.speed_up_m_s),
            speed_down_m_s: asked.down_m_s.unwrap_or(tuning.speed_down_m_s),
            accel_m_s2: tuning.accel_m_s2,
            accel_z_m_s2: tuning.accel_z_m_s2,
            jerk_m_s3: tuning.jerk_m_s3,
            jerk_z_m_s3: tuning.jerk_z_m_s3,
        }
    }

    /// The demand on the body for an act of the task. `believed` is the estimated state; `level_error_m_s2` the error
    /// while keeping level.
    pub(super) fn demand(
        &mut self,
        act: Act,
        believed: &Body,
        level_error_m_s2: DVec2,
        tuning: &FlightTuning,
    ) -> Demand {
        match act {
            Act::Idle => Demand::Off,
            Act::Throttle { share, lean_m_s2 } => Demand::Throttle { share, lean_m_s2 },
            Act::Accelerate(wanted) => Demand::Acceleration(wanted),
            Act::Fly => {
                let limits = self.limits(tuning);
                if let Some(shift_m) = self.control.drag_along(believed, &limits) {
                    self.shift_held_takeoff(shift_m);
                }
                Demand::Acceleration(self.control.demand(
                    believed,
                    tuning.lean_max_m_s2,
                    tuning.accel_m_s2,
                ))
            }
            Act::Level => {
                let down = self.control.demand_level(believed);
                Demand::Acceleration(level_error_m_s2.extend(down))
            }
        }
    }

    /// Ends a turn rate together with the setpoint that set it.
    pub(super) fn end_turn(&mut self, now: Duration) {
        let until = match &self.task {
            Task::Velocity { until, .. } | Task::Accelerate { until, .. } => *until,
            Task::Attitude(attitude) => attitude.until,
            Task::Wait
            | Task::Takeoff(_)
            | Task::Goto { .. }
            | Task::Brake
            | Task::Return(_)
            | Task::Land(_)
            | Task::Circle(_)
            | Task::Route(_)
            | Task::Orbit(_)
            | Task::Piloted
            | Task::Manual
            | Task::Drive(_) => return,
        };
        if now >= until && matches!(self.yaw.demand, YawDemand::Rate(_)) {
            self.yaw.demand = YawDemand::Hold;
        }
    }

    /// Turns the nose at a deflected stick's rate, in degrees per second; a released stick ends its
    /// turn.
    pub(super) fn turn_by_stick(&mut self, rate_deg_s: f64) {
        let turning = matches!(self.yaw.demand, YawDemand::Stick(_));
        if rate_deg_s != 0.0 || turning {
            self.yaw.demand = YawDemand::Stick(rate_deg_s);
        }
    }

    /// The rate at which the nose of a body turns in this step, in degrees per second.
    pub(super) fn nose_rate_deg_s(&mut self, body: &Body, turning: Turning) -> f64 {
        let moving = self.control.velocity_m_s.truncate();
        let here = body.position_m.truncate();
        self.yaw.step(body.yaw_deg, moving, here, turning)
    }

    /// Ends a takeoff to a point, where the vehicle then waits with the task of its mode.
    pub(super) fn end_takeoff(&mut self, goal_m: DVec3) {
        self.takeoff_m = Some(goal_m);
        self.task = match self.mode.id {
            ModeId::Guided => Task::goto(goal_m),
            // In AUTO, the mission continues on its own.
            ModeId::Auto => return,
            _ => Task::Piloted,
        };
    }

    /// Shifts the path, and the goal of a takeoff that is held, after the estimated position has
    /// jumped.
    pub(super) fn follow_jump(&mut self, jump_m: DVec3) {
        self.control.path_m += jump_m;
        self.shift_held_takeoff(jump_m);
    }

    /// Shifts the goal of a takeoff that is held: its height is held at the vehicle's own position, even if its estimate
    /// jumps or the wind blows it away.
    fn shift_held_takeoff(&mut self, jump_m: DVec3) {
        if let (Task::Goto { goal_m, .. }, Some(hold_m)) = (&mut self.task, &mut self.takeoff_m)
            && *goal_m == *hold_m
        {
            *goal_m += jump_m;
            *hold_m = *goal_m;
        }
    }
}
