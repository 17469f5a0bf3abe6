//! The current alerts of a vehicle, derived from its telemetry.
//! [`ActiveAlerts`](super::ActiveAlerts) stores when each of them began.

use std::time::Duration;

use super::mission_fence::FenceBreach;
use super::separation::CloseVehicle;
use super::traffic::TrafficConflict;
use crate::alert::AlertKind;
use crate::text;
use crate::text::{Text, figure};
use crate::vehicle::{
    EKF_BAD, EkfFlags, FixType, Grade, HomeReach, LandedState, Severity, StatusText, TrafficThreat,
    VIBRATION_BAD_M_S2, Vehicle,
};

/// How long a text about a failsafe counts as current.
const TEXT_LIFE: Duration = Duration::from_secs(60);

/// How long a jump of the position counts as current.
const JUMP_LIFE: Duration = Duration::from_secs(60);
/// How long a change of a vehicle's sender counts as current; it is over once it is acknowledged.
const MOVE_LIFE: Duration = Duration::from_secs(600);

/// A condition that needs attention now.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Alert {
    pub kind: AlertKind,
    pub severity: Severity,
    /// The cause in a few words, the most important ones first.
    pub text: Text,
}

/// A vehicle's most serious condition, if it has any. The vehicle must land with at least
/// `reserve_percent` of its battery.
pub fn alert(vehicle: &Vehicle, reserve_percent: f64, now: Duration) -> Option<Alert> {
    alerts(vehicle, reserve_percent, now).min_by_key(|alert| alert.severity)
}

/// All conditions of a vehicle, at most one per kind.
pub fn alerts(
    vehicle: &Vehicle,
    reserve_percent: f64,
    now: Duration,
) -> impl Iterator<Item = Alert> {
    let found = [
        crashed(vehicle),
        link(vehicle, now),
        failsafe(vehicle, now),
        gps(vehicle, now),
        filter(vehicle),
        battery(vehicle),
        way_home(vehicle, reserve_percent),
        fence(vehicle),
        vibration(vehicle),
        prearm(vehicle),
    ];
    found.into_iter().flatten()
}

/// The alert that another vehicle is too close.
pub fn separation(close: &CloseVehicle) -> Alert {
    let text = text!(
        "alert-separation",
        vehicle = close.vehicle,
        across = figure(close.across_m, 0),
        height = figure(close.height_m, 0)
    );
    condition(AlertKind::Separation, Severity::Critical, text)
}

/// The alert that another aircraft comes too close.
pub fn traffic(conflict: &TrafficConflict) -> Alert {
    let approach = &conflict.approach;
    let severity = match approach.threat {
        TrafficThreat::Critical => Severity::Critical,
        TrafficThreat::Warning | TrafficThreat::None => Severity::Warning,
    };
    let text = text!(
        "alert-traffic",
        name = &conflict.name,
        across = figure(approach.predicted.across_m, 0),
        height = format!("{:+.0}", approach.predicted.height_m),
        seconds = figure(approach.predicted.in_s, 0)
    );
    condition(AlertKind::Traffic, severity, text)
}

/// The alert that a vehicle breaks a fence of the mission.
pub fn mission_fence(breach: &FenceBreach) -> Alert {
    let text = match breach {
        FenceBreach::Outside => text!("alert-fence"),
        FenceBreach::Above { ceiling_m } => {
            text!("alert-ceiling", ceiling = figure(*ceiling_m, 0))
        }
    };
    condition(AlertKind::Fence, Severity::Error, text)
}

/// The alert that a vehicle's simulator process has ended.
pub fn process_ended() -> Alert {
    condition(AlertKind::Process, Severity::Alert, text!("alert-process"))
}

fn condition(kind: AlertKind, severity: Severity, text: impl Into<Text>) -> Alert {
    Alert {
        kind,
        severity,
        text: text.into(),
    }
}

/// The vehicle's last text about a failsafe, if it is recent. Reasons not to arm may name one, too.
fn recent_failsafe(vehicle: &Vehicle, now: Duration) -> Option<&str> {
    let mut texts = vehicle.texts.iter().rev();
    let found = texts.find(|line| {
        let is_recent = now.saturating_sub(line.at) < TEXT_LIFE;
        let is_of_arming = StatusText::reason_not_to_arm(&line.text).is_some();
        is_recent && !is_of_arming && line.text.contains("ailsafe")
    });
    found.map(|line| line.text.as_str())
}

/// The alert for a vehicle that has hit the ground, or is falling disarmed; it lasts until the
/// vehicle is armed again. A vehicle that falls with a dead motor often stays armed on the ground.
fn crashed(vehicle: &Vehicle) -> Option<Alert> {
    let says = |text| Some(condition(AlertKind::Crash, Severity::Emergency, text));
    if !vehicle.armed() && vehicle.heartbeat.is_some() && vehicle.landed == LandedState::InAir {
        return says(text!("alert-motors-stopped"));
    }
    vehicle.crash().and_then(says)
}

/// The alert that a vehicle is silent, or was heard from another sender than before.
fn link(vehicle: &Vehicle, now: Duration) -> Option<Alert> {
    let says = |severity, text| Some(condition(AlertKind::LinkLost, severity, text));
    if vehicle.link.lost {
        return says(Severity::Alert, text!("alert-link-lost"));
    }
    let has_moved = |at| now.saturating_sub(at) < MOVE_LIFE;
    vehicle.link.moved_at.filter(|at| has_moved(*at))?;
    says(Severity::Warning, text!("alert-other-sender"))
}

fn failsafe(vehicle: &Vehicle, now: Duration) -> Option<Alert> {
    if !vehicle.in_failsafe() {
        return None;
    }
    // A heartbeat can still report a failsafe that a text has just ended, or another one.
    let reason = recent_failsafe(vehicle, now).filter(|text| !text.ends_with("Cleared"));
    let text = reason.map_or_else(|| text!("alert-failsafe"), Text::from);
    Some(condition(AlertKind::Failsafe, Severity::Critical, text))
}

fn gps(vehicle: &Vehicle, now: Duration) -> Option<Alert> {
    let says = |text| Some(condition(AlertKind::Gps, Severity::Critical, text));
    let jump = vehicle
        .jump
        .filter(|jump| now.saturating_sub(jump.at) < JUMP_LIFE);
    if let Some(jump) = jump {
        let distance = figure(jump.distance_m / 1000.0, 1);
        return says(text!("alert-position-jump", distance = distance));
    }
    if !vehicle.armed() {
        return None;
    }
    if vehicle.gps.is_some_and(|gps| gps.fix < FixType::Fix3d) {
        return says(text!("alert-gps-lost"));
    }
    let glitching = |ekf: crate::vehicle::Ekf| ekf.flags.has(EkfFlags::GPS_GLITCHING);
    if vehicle.ekf.is_some_and(glitching) {
        return says(text!("alert-gps-glitch"));
    }
    None
}

fn filter(vehicle: &Vehicle) -> Option<Alert> {
    let ekf = vehicle.ekf.filter(|_| vehicle.armed())?;
    if !ekf.flags.has(EkfFlags::POSITION_HORIZONTAL_ABSOLUTE) {
        let text = text!("alert-ekf-position");
        return Some(condition(AlertKind::Ekf, Severity::Critical, text));
    }
    let parts = [
        (text!("alert-ekf-velocity"), ekf.velocity_variance),
        (text!("alert-ekf-where"), ekf.position_horizontal_variance),
        (text!("alert-ekf-height"), ekf.position_vertical_variance),
        (text!("alert-ekf-compass"), ekf.compass_variance),
    ];
    let known = parts.into_iter().filter(|(_, ratio)| ratio.is_finite());
    let (part, worst) = known.max_by(|a, b| a.1.total_cmp(&b.1))?;
    if worst < EKF_BAD {
        return None;
    }
    let text = text!("alert-ekf", part = part, ratio = figure(worst, 1));
    Some(condition(AlertKind::Ekf, Severity::Error, text))
}

fn battery(vehicle: &Vehicle) -> Option<Alert> {
    let left = vehicle.battery()?.remaining_percent?;
    let says = |severity, text| Some(condition(AlertKind::Battery, severity, text));
    match Grade::of_battery(left) {
        Grade::Good => None,
        Grade::Poor => says(
            Severity::Warning,
            text!("alert-battery-low", percent = left),
        ),
        Grade::Bad => says(
            Severity::Critical,
            text!("alert-battery-critical", percent = left),
        ),
    }
}

/// The alert that returning home needs nearly all the remaining battery, or more. A vehicle that is
/// already returning or landing gets no advice to turn back; the alert that home is out of reach
/// ends only in LAND.
fn way_home(vehicle: &Vehicle, reserve_percent: f64) -> Option<Alert> {
    let way_home = vehicle.way_home()?;
    let mode = vehicle.mode()?;
    let says = |severity, text| Some(condition(AlertKind::WayHome, severity, text));
    match way_home.reach(reserve_percent) {
        HomeReach::OutOfReach if !mode.is("LAND") => {
            says(Severity::Critical, text!("alert-out-of-reach"))
        }
        HomeReach::TurnBack if !mode.comes_down() => {
            let needed = figure((way_home.needed_percent + reserve_percent).ceil(), 0);
            let left = figure(way_home.left_percent, 0);
            says(
                Severity::Warning,
                text!("alert-turn-back", needed = needed, left = left),
            )
        }
        HomeReach::Ample | HomeReach::TurnBack | HomeReach::OutOfReach => None,
    }
}

fn fence(vehicle: &Vehicle) -> Option<Alert> {
    if !vehicle.fence?.breached {
        return None;
    }
    Some(condition(
        AlertKind::Fence,
        Severity::Error,
        text!("alert-fence"),
    ))
}

fn vibration(vehicle: &Vehicle) -> Option<Alert> {
    let level = vehicle.vibration?.level_m_s2;
    let known = level.into_iter().filter(|level| level.is_finite());
    let worst = known.fold(0.0, f32::max);
    if !vehicle.armed() || worst < VIBRATION_BAD_M_S2 {
        return None;
    }
    let text = text!("alert-vibration", level = figure(worst, 0));
    Some(condition(AlertKind::Vibration, Severity::Warning, text))
}

fn prearm(vehicle: &Vehicle) -> Option<Alert> {
    if vehicle.armed() || vehicle.health.is_none_or(|health| health.prearm_ok()) {
        return None;
    }
    let (severity, text) = match vehicle.prearm.last() {
        Some(reason) => (Severity::Warning, reason.as_str().into()),
        None => (Severity::Notice, text!("alert-prearm")),
    };
    Some(condition(AlertKind::Prearm, severity, text))
}

#[cfg(test)]
mod tests;
