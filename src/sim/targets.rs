//! `SET_POSITION_TARGET_LOCAL_NED` and _`GLOBAL_INT` in GUIDED.

use glam::DVec3;

use super::autopilot::{Autopilot, Place};
use super::mode;
use super::task::Task;
use super::yaw::YawDemand;
use crate::geo::LatLon;

/// Bits of the type mask; a set bit means "ignore". A group of three counts as a whole.
const POSITION: u16 = 0x007;
const VELOCITY: u16 = 0x038;
const ACCELERATION: u16 = 0x1C0;
const YAW: u16 = 0x400;
const YAW_RATE: u16 = 0x800;
/// Altitudes, speeds and offsets beyond this are mistakes (10 times round the earth).
const SENSIBLE_MAX: f64 = 1e8;

/// Where a position is meant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Point {
    /// Metres along the axes of the frame.
    Local(DVec3),
    /// A place on the earth and a height whose meaning the frame tells.
    Global { at: LatLon, height_m: f64 },
}

/// A setpoint as it arrived.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Setpoint {
    pub(super) point: Point,
    pub(super) velocity_m_s: DVec3,
    pub(super) accel_m_s2: DVec3,
    pub(super) yaw_rad: f64,
    pub(super) yaw_rate_rad_s: f64,
    pub(super) mask: u16,
    pub(super) frame: u8,
}

/// The altitude above sea level that a height means in a global frame; `None` in a frame the vehicle lacks.
/// Without terrain data the ground counts as level with the start.
pub(super) fn altitude_amsl_m(autopilot: &Autopilot, frame: u8, height_m: f64) -> Option<f64> {
    match frame {
        0 | 5 => Some(height_m),
        3 | 6 => {
            let home = autopilot.home_point();
            Some(autopilot.start.altitude_amsl_m - home.z + height_m)
        }
        10 | 11 => Some(autopilot.start.altitude_amsl_m + height_m),
        _ => None,
    }
}

impl Autopilot {
    /// Takes a setpoint. Outside GUIDED, disarmed or before a takeoff it is ignored without a word; one that makes no sense
    /// (an unknown frame, nothing asked, not a number) stops the vehicle where it is.
    pub(super) fn take_setpoint(&mut self, setpoint: &Setpoint) {
        let flying = self.safety.armed && !self.safety.landed;
        let lifting = matches!(self.task, Task::Takeoff(_)) && self.body.on_ground;
        let guided = self.mode.number == mode::GUIDED || self.mission.is_guided();
        if !guided || !flying || lifting {
            return;
        }
        self.paused = None;
        match self.task_for(setpoint) {
            Some(task) => {
                self.task = task;
                self.aim_nose(setpoint);
            }
            None => self.task = Task::STOP,
        }
    }

    /// Flies to a point that itself moves for a while.
    pub(super) fn go_to(&mut self, goal_m: DVec3, drift_m_s: DVec3) {
        self.paused = None;
        self.task = Task::Goto {
            goal_m,
            drift_m_s,
            drift_until: self.uptime() + self.tuning.setpoint_timeout,
        };
    }

    fn task_for(&self, setpoint: &Setpoint) -> Option<Task> {
        let asked = |bits: u16| setpoint.mask & bits == 0;
        let until = self.uptime() + self.tuning.setpoint_timeout;
        let velocity = self.in_north_east(setpoint, setpoint.velocity_m_s);
        let usable = |v: DVec3| v.is_finite() && v.length() < SENSIBLE_MAX;
        if !is_frame_known(setpoint) {
            return None;
        }
        if asked(POSITION) {
            let goal_m = self.goal_of(setpoint).filter(|goal| usable(*goal))?;
            let drift_m_s = if asked(VELOCITY) {
                velocity
            } else {
                DVec3::ZERO
            };
            return usable(drift_m_s).then_some(Task::Goto {
                goal_m,
                drift_m_s,
                drift_until: until,
            });
        }
        if asked(VELOCITY) {
            return usable(velocity).then_some(Task::Velocity {
                wanted_m_s: velocity,
                until,
            });
        }
        let accel = self.in_north_east(setpoint, setpoint.accel_m_s2);
        (asked(ACCELERATION) && usable(accel)).then_some(Task::Accelerate {
            wanted_m_s2: accel,
            until,
        })
    }

    fn goal_of(&self, setpoint: &Setpoint) -> Option<DVec3> {
        match setpoint.point {
            Point::Local(offset) => Some(match setpoint.frame {
                // Offsets start where the vehicle is.
                7..=9 => self.body.position_m + self.in_north_east(setpoint, offset),
                _ => offset,
            }),
            Point::Global { at, height_m } => {
                let altitude_amsl_m = altitude_amsl_m(self, setpoint.frame, height_m)?;
                at.is_valid().then(|| {
                    self.point_of(Place {
                        at,
                        altitude_amsl_m,
                    })
                })
            }
        }
    }

    /// Turns a vector of the body's frames to north and east.
    fn in_north_east(&self, setpoint: &Setpoint, v: DVec3) -> DVec3 {
        if !is_body_frame(setpoint) {
            return v;
        }
        let (sin, cos) = self.body.yaw_deg.to_radians().sin_cos();
        DVec3::new(v.x * cos - v.y * sin, v.x * sin + v.y * cos, v.z)
    }

    fn aim_nose(&mut self, setpoint: &Setpoint) {
        let asked = |bit: u16| setpoint.mask & bit == 0;
        if asked(YAW) && setpoint.yaw_rad.is_finite() {
            let heading = setpoint.yaw_rad.to_degrees();
            if is_body_frame(setpoint) {
                self.yaw.turn_by(crate::geo::wrap_180(heading), 0.0);
            } else {
                self.yaw.turn_to(heading, 0.0, 0.0);
            }
        } else if asked(YAW_RATE) && setpoint.yaw_rate_rad_s.is_finite() {
            self.yaw.demand = YawDemand::Rate(setpoint.yaw_rate_rad_s.to_degrees());
        } else if !matches!(self.yaw.demand, YawDemand::Towards(_)) {
            self.yaw.demand = self.default_yaw();
        }
    }
}

/// `MAV_FRAME_BODY_NED` and `MAV_FRAME_BODY_OFFSET_NED`.
fn is_body_frame(setpoint: &Setpoint) -> bool {
    matches!(setpoint.point, Point::Local(_)) && matches!(setpoint.frame, 8 | 9)
}

fn is_frame_known(setpoint: &Setpoint) -> bool {
    match setpoint.point {
        Point::Local(_) => matches!(setpoint.frame, 1 | 7 | 8 | 9),
        Point::Global { .. } => matches!(setpoint.frame, 0 | 3 | 5 | 6 | 10 | 11),
    }
}
