//! Modes that are flown by a pilot's sticks.
//!
//! After `ArduCopter`'s `mode_loiter`, `mode_poshold`, `mode_althold`, `mode_stabilize`, `mode_acro` and `mode_drift`,
//! and its loiter controller (`AC_Loiter`).

mod lift_off;
mod rules;
mod zigzag;

use std::time::Duration;

use glam::{DVec2, DVec3};

use self::lift_off::LiftOff;
pub(crate) use self::rules::PilotRules;
pub(crate) use self::zigzag::{LineEnd, ZigZag};
use super::{Act, Cockpit};
use crate::control::{FlatMotion, Limits};
use crate::kinematics::square_root;
use crate::kinematics::{GRAVITY_M_S2, STEP_S};
use crate::mode::ModeId;
use sortie_geo::maths;

/// The lag of the pilot's lean behind the stick in LOITER (`ATC_INPUT_TC`), in seconds.
const STICK_LAG_S: f64 = 0.15;
/// The rate of climb with which a takeoff leaves the ground, in m/s.
const LEAST_LIFT_M_S: f64 = 0.3;
/// The greatest distance by which the loiter target leads the vehicle, in metres.
const LEAD_MAX_M: f64 = 2.0;
/// POSHOLD: the decay rate of the lean with the stick released, when braking begins, and when it is over.
const RELEASE_PER_S: f64 = 5.0;
const RELEASED_RAD: f64 = 0.003;
const STANDING_M_S: f64 = 0.1;
/// DRIFT: the braking lean per speed with released sticks, and its growth.
const DRIFT_BRAKE_RAD_S_M: f64 = 0.14;
const DRIFT_BRAKE_GROWS_PER_S: f64 = 0.03;
const DRIFT_LEAN_MAX_RAD: f64 = 45.0 * std::f64::consts::PI / 180.0;
/// DRIFT: the throttle per metre per second that helps to hold the height, with the stick in the middle third.
const DRIFT_ASSIST: f64 = 0.18;

/// How the sticks control the vehicle.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
enum Style {
    #[default]
    Stabilize,
    /// The sticks set rates of turn and throttle.
    Acro,
    /// The pitch stick leans forward, the roll stick turns, and the throttle is assisted.
    Drift,
    /// The sticks set lean and climb rate; with released sticks the height is held.
    HoldHeight,
    /// The sticks set lean and climb rate; with released sticks the vehicle brakes and holds the place.
    HoldPlace,
    /// The sticks set a climb rate, and the acceleration of a target that the vehicle follows.
    Loiter,
}

/// The state of the piloted modes.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Pilot {
    style: Style,
    /// The time at which the sticks were centred.
    released: Duration,
    brake_m_s2: f64,
    /// LOITER: the acceleration expected from the lean. POSHOLD: the lean that is flown. Forward, right.
    lean_m_s2: DVec2,
    braking: bool,
    holding: bool,
    drift_brake: f64,
    /// ACRO: forward and right lean in radians.
    angles_rad: DVec2,
    lift_off: LiftOff,
    /// The line of ZIGZAG.
    pub(crate) zigzag: ZigZag,
}

impl Pilot {
    /// The state at the beginning of a mode.
    pub(crate) fn begin(mode: ModeId, lean_ne_m_s2: DVec2) -> Self {
        Self {
            style: match mode {
                ModeId::Acro => Style::Acro,
                ModeId::Drift => Style::Drift,
                ModeId::AltHold => Style::HoldHeight,
                ModeId::PosHold => Style::HoldPlace,
                ModeId::Stabilize => Style::Stabilize,
                _ => Style::Loiter,
            },
            lean_m_s2: lean_ne_m_s2,
            holding: lean_ne_m_s2.length_squared() < 1.0,
            ..Self::default()
        }
    }

    /// The turning rate demanded by the sticks, degrees per second.
    pub(crate) fn turn_deg_s(&self, cockpit: &Cockpit<'_>) -> f64 {
        let (rules, sticks) = (&cockpit.tuning.pilot, &cockpit.sticks.channels_us);
        let [roll, _, _, yaw] = &cockpit.tuning.radio.sticks;
        match self.style {
            Style::Acro => yaw.off_centre(sticks[3]) * rules.acro_turn_deg_s,
            Style::Drift => {
                let speed = cockpit.body.velocity_m_s.truncate().length().min(20.0);
                let lean_deg = roll.off_centre(sticks[0]) * rules.lean_max_rad.to_degrees();
                lean_deg * (1.0 - speed / 50.0) * rules.acro_turn_deg_s / 45.0
            }
            Style::Stabilize | Style::HoldHeight | Style::HoldPlace | Style::Loiter => {
                yaw.off_centre(sticks[3]) * rules.turn_deg_s
            }
        }
    }
}

/// The deflection of the sticks, forward and right of the nose, -1 to 1 each.
fn deflection(cockpit: &Cockpit<'_>) -> DVec2 {
    let [roll, pitch, ..] = &cockpit.tuning.radio.sticks;
    let channels = &cockpit.sticks.channels_us;
    DVec2::new(-pitch.off_centre(channels[1]), roll.off_centre(channels[0]))
}

/// The deflection of the sticks where they may refer to a heading other than the nose (SIMPLE mode).
fn simple_deflection(cockpit: &Cockpit<'_>) -> DVec2 {
    let stick = deflection(cockpit);
    match cockpit.stick_heading_deg {
        Some(heading_deg) if stick != DVec2::ZERO => {
            let aside_rad = (heading_deg - cockpit.body.yaw_deg).to_radians();
            let (sin, cos) = maths::sin_cos(aside_rad);
            DVec2::new(stick.x * cos - stick.y * sin, stick.x * sin + stick.y * cos)
        }
        _ => stick,
    }
}

/// Forward and right lean demanded by the sticks, as accelerations, with a maximum lean.
fn leaning(stick: DVec2, lean_max_rad: f64) -> DVec2 {
    if stick == DVec2::ZERO {
        return DVec2::ZERO;
    }
    let lean = DVec2::new(
        maths::tan(stick.x * lean_max_rad),
        maths::tan(stick.y * lean_max_rad),
    );
    lean.clamp_length_max(maths::tan(lean_max_rad)) * GRAVITY_M_S2
}

/// A vector forward and right, turned to north and east.
fn north_east(cockpit: &Cockpit<'_>, v: DVec2) -> DVec2 {
    if v == DVec2::ZERO {
        return v;
    }
    let (sin, cos) = maths::sin_cos(cockpit.body.yaw_deg.to_radians());
    DVec2::new(v.x * cos - v.y * sin, v.x * sin + v.y * cos)
}

/// A vector north and east, turned to forward and right.
fn forward_right(cockpit: &Cockpit<'_>, v: DVec2) -> DVec2 {
    let (sin, cos) = maths::sin_cos(cockpit.body.yaw_deg.to_radians());
    DVec2::new(v.x * cos + v.y * sin, -v.x * sin + v.y * cos)
}

/// The velocity to which the sticks move a vehicle that lands on its own; zero if a parameter forbids it.
pub(super) fn moved_landing(cockpit: &Cockpit<'_>, most_m_s: f64) -> DVec2 {
    if !cockpit.tuning.pilot.moves_landing {
        return DVec2::ZERO;
    }
    let asked = simple_deflection(cockpit);
    north_east(cockpit, asked.clamp_length_max(1.0) * most_m_s)
}

/// The climb demanded by the throttle stick, metres per second upwards.
pub(crate) fn climb_m_s(cockpit: &Cockpit<'_>) -> f64 {
    let rules = &cockpit.tuning.pilot;
    let throttle = &cockpit.tuning.radio.sticks[2];
    let share = throttle.pushed(cockpit.sticks.channels_us[2]);
    let (top, bottom) = (
        (throttle.middle() + rules.dead_throttle).min(0.99),
        (throttle.middle() - rules.dead_throttle).max(0.01),
    );
    if share > top {
        rules.climb_m_s * (share - top) / (1.0 - top)
    } else if share < bottom {
        rules.sink_m_s * (share - bottom) / bottom
    } else {
        0.0
    }
}

/// One step of a mode in which the autopilot holds the height.
pub(super) fn step(cockpit: &mut Cockpit<'_>) -> Act {
    let mut asked = climb_m_s(cockpit);
    let takeoff_m = cockpit.tuning.pilot.takeoff_m;
    if !cockpit.body.on_ground {
        let here_m = cockpit.body.position_m.z;
        asked = cockpit
            .pilot
            .lift_off
            .climb(asked, here_m, &cockpit.tuning.pilot);
    }
    let climb = -super::keep_inside(cockpit, DVec3::new(0.0, 0.0, -asked)).z;
    if cockpit.body.on_ground {
        let (now, from) = (cockpit.now, cockpit.lifts_from);
        if !cockpit.pilot.lift_off.lifts(climb, takeoff_m, now, from) {
            return Act::Idle;
        }
    }
    // A takeoff leaves the ground even if the stick has been released.
    let climb = if cockpit.body.on_ground {
        climb.max(LEAST_LIFT_M_S)
    } else {
        climb
    };
    let limits = Limits {
        accel_z_m_s2: cockpit.tuning.pilot.accel_z_m_s2,
        jerk_z_m_s3: cockpit.limits.jerk_z_m_s3.max(5.0),
        ..cockpit.limits
    };
    match cockpit.pilot.style {
        Style::HoldHeight => {
            let lean_max_rad = cockpit.tuning.pilot.lean_max_rad;
            let lean = leaning(simple_deflection(cockpit), lean_max_rad);
            leant(cockpit, lean, climb, &limits)
        }
        Style::HoldPlace => hold_place(cockpit, climb, &limits),
        Style::Stabilize | Style::Acro | Style::Drift | Style::Loiter => {
            loiter(cockpit, climb, &limits)
        }
    }
}

/// Leans by an acceleration and holds a climb rate.
fn leant(cockpit: &mut Cockpit<'_>, lean_m_s2: DVec2, climb_m_s: f64, limits: &Limits) -> Act {
    let moving = cockpit.body.velocity_m_s.truncate();
    let here = cockpit.body.position_m.truncate();
    let flat = FlatMotion::steady(here, moving);
    cockpit.control.steered(&flat, -climb_m_s, limits);
    let lift = cockpit.control.lift(cockpit.body);
    Act::Accelerate(north_east(cockpit, lean_m_s2).extend(lift))
}

/// The loiter controller: the stick accelerates a target, drag and brake slow it, the vehicle follows it.
fn loiter(cockpit: &mut Cockpit<'_>, climb_m_s: f64, limits: &Limits) -> Act {
    let rules = cockpit.tuning.pilot.clone();
    let asked = north_east(
        cockpit,
        leaning(simple_deflection(cockpit), rules.loiter_lean_rad),
    );
    let pilot = &mut *cockpit.pilot;
    pilot.lean_m_s2 += (asked - pilot.lean_m_s2) * (STEP_S / (STEP_S + STICK_LAG_S));
    let mut velocity = cockpit.control.velocity_m_s.truncate() + pilot.lean_m_s2 * STEP_S;
    let speed = velocity.length();
    let mut brake = 0.0;
    if asked == DVec2::ZERO {
        if cockpit.now >= pilot.released + rules.brake_delay {
            brake =
                square_root(speed, 1.0, rules.brake_jerk_m_s3).clamp(0.0, rules.brake_accel_m_s2);
        }
    } else {
        pilot.released = cockpit.now;
    }
    let change = rules.brake_jerk_m_s3 * STEP_S;
    pilot.brake_m_s2 += (brake - pilot.brake_m_s2).clamp(-change, change);
    let mut accel = asked;
    if speed > 1e-6 {
        let way = velocity / speed;
        let drag =
            GRAVITY_M_S2 * maths::tan(rules.loiter_lean_rad) * speed / rules.loiter_speed_m_s;
        let slower = (speed - (drag + pilot.brake_m_s2) * STEP_S).max(0.0);
        velocity = way * slower.min(rules.loiter_speed_m_s);
        accel -= way * pilot.brake_m_s2;
    }
    let velocity = super::keep_inside(cockpit, velocity.extend(0.0)).truncate();
    let here = cockpit.body.position_m.truncate();
    let ahead = cockpit.control.path_m.truncate() + velocity * STEP_S;
    let path = here + (ahead - here).clamp_length_max(LEAD_MAX_M);
    let accel = accel.clamp_length_max(rules.loiter_accel_m_s2.max(limits.accel_m_s2));
    cockpit.control.steered(
        &FlatMotion {
            place_m: path,
            velocity_m_s: velocity,
            accel_m_s2: accel,
        },
        -climb_m_s,
        limits,
    );
    Act::Fly
}

/// POSHOLD: leans with the stick; with the stick released, brakes with a growing lean, then holds the place.
fn hold_place(cockpit: &mut Cockpit<'_>, climb_m_s: f64, limits: &Limits) -> Act {
    let rules = cockpit.tuning.pilot.clone();
    let asked = leaning(simple_deflection(cockpit), rules.lean_max_rad);
    let moving = forward_right(cockpit, cockpit.body.velocity_m_s.truncate());
    let pilot = &mut *cockpit.pilot;
    if asked != DVec2::ZERO {
        pilot.lean_m_s2 = asked;
        (pilot.braking, pilot.holding) = (false, false);
    } else if pilot.holding {
        return loiter_still(cockpit, climb_m_s, limits);
    } else if pilot.braking {
        // The braking lean for the speed: 2.15 degrees per metre per second, more when slow.
        let speed = moving.length();
        let lean_rad = (0.0215 * speed * 100.0 * (1.0 + 500.0 / (speed * 100.0 + 60.0)))
            .to_radians()
            .min(rules.hold_brake_rad);
        let wanted = -moving.normalize_or_zero() * GRAVITY_M_S2 * maths::tan(lean_rad);
        let most = GRAVITY_M_S2 * rules.hold_brake_rad_s * STEP_S;
        pilot.lean_m_s2 += (wanted - pilot.lean_m_s2).clamp_length_max(most);
        if speed < STANDING_M_S {
            pilot.holding = true;
            cockpit.control.take_over(cockpit.body);
        }
    } else {
        pilot.lean_m_s2 *= 1.0 - RELEASE_PER_S * STEP_S;
        pilot.braking = pilot.lean_m_s2.length() < RELEASED_RAD * GRAVITY_M_S2;
    }
    let lean = cockpit.pilot.lean_m_s2;
    leant(cockpit, lean, climb_m_s, limits)
}

fn loiter_still(cockpit: &mut Cockpit<'_>, climb_m_s: f64, limits: &Limits) -> Act {
    cockpit
        .control
        .at_velocity(DVec3::new(0.0, 0.0, -climb_m_s), limits);
    Act::Fly
}

/// One step of a mode in which the throttle stick drives the motors.
pub(super) fn manual(cockpit: &mut Cockpit<'_>) -> Act {
    let throttle = &cockpit.tuning.radio.sticks[2];
    let share = throttle.pushed(cockpit.sticks.channels_us[2]);
    if cockpit.body.on_ground {
        let (now, from) = (cockpit.now, cockpit.lifts_from);
        if !cockpit.pilot.lift_off.spools(share, now, from) {
            return Act::Idle;
        }
    }
    let rules = &cockpit.tuning.pilot;
    let mut weights = thrust_weights(share, throttle.middle(), rules.hover);
    let lean = match cockpit.pilot.style {
        Style::Acro => acro(cockpit),
        Style::Drift => {
            weights = drift_throttle(cockpit, weights);
            drift(cockpit)
        }
        Style::Stabilize | Style::HoldHeight | Style::HoldPlace | Style::Loiter => {
            leaning(simple_deflection(cockpit), rules.lean_max_rad)
        }
    };
    Act::Throttle {
        share: weights * rules.hover,
        lean_m_s2: north_east(cockpit, lean),
    }
}

/// The thrust for a throttle stick, as a multiple of the vehicle's weight: 1 at the middle, with
/// `ArduCopter`'s curve.
fn thrust_weights(share: f64, middle: f64, hover: f64) -> f64 {
    let input = if share < middle {
        0.5 * share / middle
    } else {
        0.5 + 0.5 * (share - middle) / (1.0 - middle)
    };
    let expo = ((0.5 - hover) / 0.375).clamp(-0.5, 1.0);
    (input * (1.0 - expo) + expo * maths::powi(input, 3)) / hover
}

/// Changes the lean at the rates demanded by the sticks; with released sticks it slowly returns to level.
fn acro(cockpit: &mut Cockpit<'_>) -> DVec2 {
    let rules = &cockpit.tuning.pilot;
    let asked = deflection(cockpit);
    // The stick's exponential curve (ACRO_RP_EXPO 0.3).
    let rate = asked * (0.7 + 0.3 * asked.length_squared()) * rules.acro_rate_rad_s;
    let angles = &mut cockpit.pilot.angles_rad;
    *angles += (rate - *angles * rules.acro_balance_per_s) * STEP_S;
    *angles = angles.clamp_length_max(rules.lean_max_rad);
    DVec2::new(maths::tan(angles.x), maths::tan(angles.y)) * GRAVITY_M_S2
}

/// DRIFT: leans forward with the stick and against a sideways slip, and brakes with released sticks.
fn drift(cockpit: &mut Cockpit<'_>) -> DVec2 {
    let forward = leaning(deflection(cockpit), cockpit.tuning.pilot.lean_max_rad).x;
    let moving = forward_right(cockpit, cockpit.body.velocity_m_s.truncate());
    // 8 hundredths of a degree per centimetre per second, each way.
    let against = |speed: f64, gain: f64| {
        let lean = (-speed * gain).clamp(-DRIFT_LEAN_MAX_RAD, DRIFT_LEAN_MAX_RAD);
        GRAVITY_M_S2 * maths::tan(lean)
    };
    let brake = &mut cockpit.pilot.drift_brake;
    if forward == 0.0 {
        *brake = (*brake + DRIFT_BRAKE_GROWS_PER_S * 3.0 * STEP_S / 0.01 * 0.14)
            .min(DRIFT_BRAKE_RAD_S_M);
    } else {
        *brake = 0.0;
    }
    let pitch = if forward == 0.0 {
        against(moving.x, *brake)
    } else {
        forward
    };
    DVec2::new(pitch, against(moving.y, DRIFT_BRAKE_RAD_S_M))
}

/// The thrust in DRIFT, as a multiple of the vehicle's weight: with the stick near its middle,
/// climbing and sinking are damped.
fn drift_throttle(cockpit: &Cockpit<'_>, weights: f64) -> f64 {
    let hover = cockpit.tuning.pilot.hover;
    let off = (weights * hover - 0.5).abs() / 0.24;
    let help = (1.2 - off).clamp(0.0, 1.0) * DRIFT_ASSIST * cockpit.body.velocity_m_s.z;
    (weights + help.clamp(-0.3, 0.3) / hover).clamp(0.0, 1.0 / hover)
}
