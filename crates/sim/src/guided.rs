//! `SET_POSITION_TARGET_LOCAL_NED`, `SET_POSITION_TARGET_GLOBAL_INT` and `SET_ATTITUDE_TARGET`, in GUIDED.

mod driving;

pub(super) use driving::drive_along;

use glam::{DQuat, DVec2, DVec3, EulerRot};
use mavlink::dialects::ardupilotmega::AttitudeTargetTypemask;

use super::autopilot::Autopilot;
use super::frame::{self, HeightOrigin};
use super::kind::VehicleKind;
use super::mask::{ACCELERATION, FORCE, POSITION, VELOCITY, YAW, YAW_RATE};
use super::mode::{self, ModeId};
use super::place::Place;
use super::task::{Attitude, Lift, Task};
use super::vehicle::{AskedSpeeds, Vehicle};
use super::yaw::YawDemand;
use sortie_geo::LatLon;
use sortie_geo::maths;

/// Bits of an attitude's type mask.
const NO_ROLL_RATE: u8 =
    AttitudeTargetTypemask::ATTITUDE_TARGET_TYPEMASK_BODY_ROLL_RATE_IGNORE.bits();
const NO_PITCH_RATE: u8 =
    AttitudeTargetTypemask::ATTITUDE_TARGET_TYPEMASK_BODY_PITCH_RATE_IGNORE.bits();
const NO_YAW_RATE: u8 =
    AttitudeTargetTypemask::ATTITUDE_TARGET_TYPEMASK_BODY_YAW_RATE_IGNORE.bits();
const NO_THRUST: u8 = AttitudeTargetTypemask::ATTITUDE_TARGET_TYPEMASK_THROTTLE_IGNORE.bits();
const NO_ATTITUDE: u8 = AttitudeTargetTypemask::ATTITUDE_TARGET_TYPEMASK_ATTITUDE_IGNORE.bits();
/// The maximum deviation of a quaternion's length from 1.
const UNIT_WITHIN: f64 = 1e-3;
/// The bit of `GUID_OPTIONS` with which the thrust field of an attitude means a thrust, not a climb rate.
const THRUST_AS_THRUST: i32 = 1 << 3;
/// Velocities beyond this along any axis stop the vehicle, in m/s.
const SANE_MAX: f64 = 1000.0;
/// Positions, velocities and accelerations beyond this are mistakes; in metres, the limit is 2.5
/// times the circumference of the earth.
const SENSIBLE_MAX: f64 = 1e8;

/// The position of a setpoint, in one of two forms.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum TargetPoint {
    /// Metres along the axes of the frame.
    Local(DVec3),
    /// A place on the earth, and a height in metres above the frame's reference.
    Global { at: LatLon, height_m: f64 },
}

/// A setpoint as it arrived.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Setpoint {
    pub(super) point: TargetPoint,
    pub(super) velocity_m_s: DVec3,
    pub(super) accel_m_s2: DVec3,
    pub(super) yaw_rad: f64,
    pub(super) yaw_rate_rad_s: f64,
    pub(super) mask: u16,
    pub(super) frame: u8,
}

/// An attitude as it arrived: a quaternion, body rates, thrust.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct AttitudeTarget {
    pub(super) q: [f32; 4],
    pub(super) rates_rad_s: [f32; 3],
    pub(super) thrust: f32,
    pub(super) mask: u8,
}

/// Carries out a setpoint. Outside GUIDED, while disarmed and before a takeoff, a setpoint is
/// silently ignored; so are forces and points outside the fence. An invalid setpoint (an unknown
/// frame, no field in use, a value that is not a number) stops the vehicle where it is.
pub(super) fn take_setpoint(autopilot: &mut Autopilot, setpoint: &Setpoint) {
    match autopilot.vehicle.kind {
        VehicleKind::Copter => fly_by_setpoint(autopilot, setpoint),
        VehicleKind::Rover(_) => driving::take_setpoint(autopilot, setpoint),
    }
}

fn fly_by_setpoint(autopilot: &mut Autopilot, setpoint: &Setpoint) {
    let plan_is_guided = autopilot.auto_plan.is_guided();
    let vehicle = &mut autopilot.vehicle;
    let flying = vehicle.safety.armed && !vehicle.safety.landed;
    let lifting = matches!(vehicle.flight.task, Task::Takeoff(_)) && vehicle.plant.body.on_ground;
    let guided = vehicle.flight.mode.id == ModeId::Guided || plan_is_guided;
    if !guided || !flying || lifting {
        return;
    }
    let forced = setpoint.mask & FORCE != 0 && setpoint.mask & ACCELERATION == 0;
    if forced {
        return;
    }
    let task = task_for(vehicle, setpoint);
    if let Some(Task::Goto { goal_m, .. }) = &task
        && !vehicle.may_fly_to(*goal_m)
    {
        return;
    }
    vehicle.flight.paused = None;
    if let Some(task) = task {
        change_task(vehicle, task);
        aim_nose(vehicle, setpoint);
    } else {
        // The control restarts as if the mode had just been entered.
        restart_control(vehicle);
        vehicle.flight.task = Task::STOP;
    }
}

/// Carries out an attitude target. It is ignored without a thrust or with an invalid quaternion; on
/// the ground a climb starts a takeoff.
pub(super) fn take_attitude(autopilot: &mut Autopilot, asked: &AttitudeTarget) {
    match autopilot.vehicle.kind {
        VehicleKind::Copter => fly_by_attitude(&mut autopilot.vehicle, asked),
        VehicleKind::Rover(_) => driving::take_attitude(autopilot, asked),
    }
}

fn fly_by_attitude(vehicle: &mut Vehicle, asked: &AttitudeTarget) {
    let rates = asked.rates_rad_s.map(f64::from);
    let finite = asked.thrust.is_finite() && rates.iter().all(|rate| rate.is_finite());
    if !mode::is_guided(vehicle.flight.mode.id) || !vehicle.safety.armed || !finite {
        return;
    }
    let q = quaternion(asked.q);
    let attitude = asked.mask & NO_ATTITUDE == 0;
    let unit = (q.length() - 1.0).abs() < UNIT_WITHIN;
    if asked.mask & NO_THRUST != 0 || (attitude && !unit) {
        return;
    }
    vehicle.flight.paused = None;
    let of = |bit: u8, rate: f64| if asked.mask & bit == 0 { rate } else { 0.0 };
    let (yaw, pitch, roll) = q.normalize().to_euler(EulerRot::ZYX);
    let lean_rad = if attitude {
        DVec2::new(-pitch, roll)
    } else {
        leaning_rad(vehicle)
    };
    if !matches!(vehicle.flight.task, Task::Attitude(_)) {
        // Only the vertical control is started again (`angle_control_start`).
        vehicle.flight.speeds = AskedSpeeds {
            ground_m_s: vehicle.flight.speeds.ground_m_s,
            ..AskedSpeeds::default()
        };
    }
    let yaw_rate = of(NO_YAW_RATE, rates[2]);
    if attitude {
        vehicle.flight.yaw.turn_to(yaw.to_degrees(), 0.0, 0.0);
    } else {
        vehicle.flight.yaw.demand = YawDemand::Rate(yaw_rate.to_degrees());
    }
    vehicle.flight.task = Task::Attitude(Attitude {
        lean_rad,
        rates_rad_s: if attitude {
            DVec2::ZERO
        } else {
            DVec2::new(-of(NO_PITCH_RATE, rates[1]), of(NO_ROLL_RATE, rates[0]))
        },
        lift: lift_of(vehicle, f64::from(asked.thrust)),
        until: vehicle.uptime() + vehicle.tuning.setpoint_timeout,
    });
}

/// The current lean forward and to the right, in radians: the start for a setpoint that gives rates.
fn leaning_rad(vehicle: &Vehicle) -> DVec2 {
    let (roll, pitch) = vehicle.plant.body.roll_pitch_rad();
    DVec2::new(-pitch, roll)
}

/// The lift of a thrust value: a climb rate, where one half holds the height, or a thrust if `GUID_OPTIONS` requires
/// it.
fn lift_of(vehicle: &Vehicle, thrust: f64) -> Lift {
    if vehicle.tuning.guided_options & THRUST_AS_THRUST != 0 {
        return Lift::Thrust(thrust.clamp(-1.0, 1.0));
    }
    let off = (thrust.clamp(0.0, 1.0) - 0.5) * 2.0;
    Lift::Climb(if off > 0.0 {
        off * vehicle.tuning.flight.speed_up_m_s
    } else {
        off * vehicle.tuning.flight.speed_down_m_s
    })
}

/// Flies to a point that itself moves for a while.
pub(super) fn go_to(vehicle: &mut Vehicle, goal_m: DVec3, drift_m_s: DVec3) {
    vehicle.flight.paused = None;
    change_task(
        vehicle,
        Task::Goto {
            goal_m,
            drift_m_s,
            drift_until: vehicle.uptime() + vehicle.tuning.setpoint_timeout,
        },
    );
}

/// Changes the task. The position control restarts if the kind of target changes, and with the first target after a
/// takeoff; speeds set by commands then no longer apply (`ModeGuided::pva_control_start`).
fn change_task(vehicle: &mut Vehicle, task: Task) {
    if vehicle.flight.task.kind() != task.kind() || vehicle.flight.holds_takeoff() {
        restart_control(vehicle);
    }
    vehicle.flight.takeoff_m = None;
    vehicle.flight.task = task;
}

fn restart_control(vehicle: &mut Vehicle) {
    vehicle
        .flight
        .control
        .take_over(vehicle.estimator.belief(&vehicle.plant.body));
    vehicle.flight.speeds = AskedSpeeds::default();
}

fn task_for(vehicle: &Vehicle, setpoint: &Setpoint) -> Option<Task> {
    let asked = |bits: u16| setpoint.mask & bits == 0;
    let until = vehicle.uptime() + vehicle.tuning.setpoint_timeout;
    let velocity = in_north_east(vehicle, setpoint, setpoint.velocity_m_s);
    let usable = |v: DVec3| v.is_finite() && v.length() < SENSIBLE_MAX;
    if !is_frame_known(setpoint) {
        return None;
    }
    if asked(POSITION) && !asked(VELOCITY) && asked(ACCELERATION) {
        return None;
    }
    if asked(VELOCITY) && (velocity.is_nan() || velocity.abs().max_element() > SANE_MAX) {
        return None;
    }
    if asked(POSITION) {
        let goal_m = goal_of(vehicle, setpoint).filter(|goal| usable(*goal))?;
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
    let accel = in_north_east(vehicle, setpoint, setpoint.accel_m_s2);
    (asked(ACCELERATION) && usable(accel)).then_some(Task::Accelerate {
        wanted_m_s2: accel,
        until,
    })
}

fn goal_of(vehicle: &Vehicle, setpoint: &Setpoint) -> Option<DVec3> {
    match setpoint.point {
        TargetPoint::Local(offset) => Some(match setpoint.frame {
            // Offsets start at the vehicle's position.
            frame::LOCAL_OFFSET_NED | frame::BODY_NED | frame::BODY_OFFSET_NED => {
                vehicle.believed().position_m + in_north_east(vehicle, setpoint, offset)
            }
            _ => offset,
        }),
        TargetPoint::Global { at, height_m } => {
            // Without terrain data the ground counts as level with the sea, as in ArduCopter.
            let frame = match HeightOrigin::of(setpoint.frame)? {
                HeightOrigin::Sea | HeightOrigin::Terrain => frame::GLOBAL,
                HeightOrigin::Home => frame::GLOBAL_RELATIVE_ALT,
            };
            let altitude_amsl_m = vehicle.datum.altitude_amsl_m(frame, height_m)?;
            at.is_valid().then(|| {
                vehicle.datum.point_of(Place {
                    at,
                    altitude_amsl_m,
                })
            })
        }
    }
}

/// Rotates a vector to north and east if the setpoint is in a body frame; otherwise returns it unchanged.
fn in_north_east(vehicle: &Vehicle, setpoint: &Setpoint, v: DVec3) -> DVec3 {
    if !is_body_frame(setpoint) {
        return v;
    }
    let (sin, cos) = maths::sin_cos(vehicle.plant.body.yaw_deg.to_radians());
    DVec3::new(v.x * cos - v.y * sin, v.x * sin + v.y * cos, v.z)
}

fn aim_nose(vehicle: &mut Vehicle, setpoint: &Setpoint) {
    let asked = |bit: u16| setpoint.mask & bit == 0;
    if asked(YAW) && setpoint.yaw_rad.is_finite() {
        let heading = setpoint.yaw_rad.to_degrees();
        if is_body_frame(setpoint) {
            vehicle
                .flight
                .yaw
                .turn_by(sortie_geo::wrap_180(heading), 0.0);
        } else {
            vehicle.flight.yaw.turn_to(heading, 0.0, 0.0);
        }
    } else if asked(YAW_RATE) && setpoint.yaw_rate_rad_s.is_finite() {
        vehicle.flight.yaw.demand = YawDemand::Rate(setpoint.yaw_rate_rad_s.to_degrees());
    } else if !matches!(vehicle.flight.yaw.demand, YawDemand::Towards(_)) {
        vehicle.flight.yaw.demand = vehicle.default_yaw();
    }
}

fn is_body_frame(setpoint: &Setpoint) -> bool {
    matches!(setpoint.point, TargetPoint::Local(_))
        && matches!(setpoint.frame, frame::BODY_NED | frame::BODY_OFFSET_NED)
}

fn is_frame_known(setpoint: &Setpoint) -> bool {
    match setpoint.point {
        TargetPoint::Local(_) => matches!(
            setpoint.frame,
            frame::LOCAL_NED | frame::LOCAL_OFFSET_NED | frame::BODY_NED | frame::BODY_OFFSET_NED
        ),
        TargetPoint::Global { .. } => HeightOrigin::of(setpoint.frame).is_some(),
    }
}

/// A quaternion in the order of `MAVLink`: the scalar first.
fn quaternion(q: [f32; 4]) -> DQuat {
    let [scalar, vector @ ..] = q.map(f64::from);
    DQuat::from_vec4(DVec3::from_array(vector).extend(scalar))
}
