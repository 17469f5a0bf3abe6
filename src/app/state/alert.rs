//! The most serious thing that is wrong with a vehicle right now.

use std::time::Duration;

use crate::text::Text;
use crate::vehicle::{EkfFlags, FixType, LandedState, Severity, SystemStatus, Vehicle};

/// How long a text about a failsafe counts as the present state.
const TEXT_LIFE: Duration = Duration::from_secs(60);
/// Battery warnings, in percent of the charge left: soon, and now.
const BATTERY_LOW: u8 = 25;
const BATTERY_CRITICAL: u8 = 10;
/// Hitting the ground faster than this breaks a vehicle, in m/s.
const HARD_LANDING_M_S: f32 = 3.0;
/// EKF innovation test ratio above which ArduPilot's own failsafe acts (`FS_EKF_THRESH` 0.8).
const EKF_LIMIT: f32 = 0.8;
/// Above this vibration spoils the estimates (ArduPilot's documentation of VIBRATION), in m/s2.
const VIBRATION_LIMIT: f32 = 60.0;

/// A condition that holds now.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Alert {
    /// How serious it is.
    pub severity: Severity,
    /// In a few words, the most telling first.
    pub text: Text,
}

/// The most serious present condition of a vehicle, if anything is wrong.
pub fn alert(vehicle: &Vehicle, now: Duration) -> Option<Alert> {
    crashed(vehicle)
        .or_else(|| link_lost(vehicle, now))
        .or_else(|| failsafe(vehicle, now))
        .or_else(|| estimate(vehicle))
        .or_else(|| battery(vehicle))
        .or_else(|| fence(vehicle))
        .or_else(|| vibration(vehicle))
        .or_else(|| prearm(vehicle))
}

fn condition(severity: Severity, text: impl Into<Text>) -> Alert {
    Alert {
        severity,
        text: text.into(),
    }
}

fn recent_text<'a>(vehicle: &'a Vehicle, now: Duration, words: &[&str]) -> Option<&'a str> {
    let mut texts = vehicle.texts.iter().rev();
    let found = texts.find(|line| {
        now.saturating_sub(line.at) < TEXT_LIFE && words.iter().any(|word| line.text.contains(word))
    });
    found.map(|line| line.text.as_str())
}

/// That a disarmed vehicle has come down hard, or is coming down, until it is armed again.
fn crashed(vehicle: &Vehicle) -> Option<Alert> {
    if vehicle.armed() {
        return None;
    }
    if vehicle.heartbeat.is_some() && vehicle.landed == LandedState::InAir {
        return Some(condition(Severity::Emergency, "MOTORS STOPPED in the air"));
    }
    let since_armed = vehicle
        .texts
        .iter()
        .rev()
        .take_while(|line| !line.text.contains("Arming motors"));
    let mut found = since_armed.filter_map(|line| crash(&line.text));
    found
        .next()
        .map(|text| condition(Severity::Emergency, text))
}

/// What a status text says about a crash: ArduPilot's crash check, or the simulator about the ground.
fn crash(text: &str) -> Option<String> {
    if text.contains("Crash: Disarming") {
        return Some("CRASHED, disarmed".to_owned());
    }
    let speed = text.strip_prefix("SIM Hit ground at ")?;
    let speed: f32 = speed.split_whitespace().next()?.parse().ok()?;
    (speed > HARD_LANDING_M_S).then(|| format!("CRASHED at {speed:.0} m/s"))
}

fn link_lost(vehicle: &Vehicle, now: Duration) -> Option<Alert> {
    if !vehicle.link.lost {
        return None;
    }
    let silent = now.saturating_sub(vehicle.link.last_heard.unwrap_or_default());
    Some(condition(
        Severity::Alert,
        format!("LINK LOST {} s", silent.as_secs()),
    ))
}

fn failsafe(vehicle: &Vehicle, now: Duration) -> Option<Alert> {
    let status = vehicle.heartbeat?.status;
    if !matches!(status, SystemStatus::Critical | SystemStatus::Emergency) {
        return None;
    }
    let reason = recent_text(vehicle, now, &["ailsafe"]);
    Some(condition(
        Severity::Critical,
        reason.unwrap_or("FAILSAFE active"),
    ))
}

fn estimate(vehicle: &Vehicle) -> Option<Alert> {
    if !vehicle.armed() {
        return None;
    }
    if vehicle.gps.is_some_and(|gps| gps.fix < FixType::Fix3d) {
        return Some(condition(Severity::Critical, "GPS lost"));
    }
    let ekf = vehicle.ekf?;
    if ekf.flags.has(EkfFlags::GPS_GLITCHING) {
        return Some(condition(Severity::Critical, "GPS glitch"));
    }
    if !ekf.flags.has(EkfFlags::POSITION_HORIZONTAL_ABSOLUTE) {
        return Some(condition(Severity::Critical, "EKF no position"));
    }
    let parts = [
        ("velocity", ekf.velocity_variance),
        ("position", ekf.position_horizontal_variance),
        ("height", ekf.position_vertical_variance),
        ("compass", ekf.compass_variance),
    ];
    let known = parts.into_iter().filter(|(_, ratio)| ratio.is_finite());
    let (part, worst) = known.max_by(|a, b| a.1.total_cmp(&b.1))?;
    if worst < EKF_LIMIT {
        return None;
    }
    if !worst.is_finite() {
        return Some(condition(Severity::Error, format!("EKF {part} -")));
    }
    Some(condition(Severity::Error, format!("EKF {part} {worst:.1}")))
}

fn battery(vehicle: &Vehicle) -> Option<Alert> {
    let left = vehicle.battery()?.remaining_percent?;
    if left <= BATTERY_CRITICAL {
        return Some(condition(Severity::Critical, format!("BATTERY {left} %")));
    }
    if left <= BATTERY_LOW {
        return Some(condition(
            Severity::Warning,
            format!("battery low {left} %"),
        ));
    }
    None
}

fn fence(vehicle: &Vehicle) -> Option<Alert> {
    if !vehicle.fence?.breached {
        return None;
    }
    Some(condition(Severity::Error, "outside fence"))
}

fn vibration(vehicle: &Vehicle) -> Option<Alert> {
    let level = vehicle.vibration?.level_m_s2;
    let known = level.into_iter().filter(|level| level.is_finite());
    let worst = known.fold(0.0, f32::max);
    if !vehicle.armed() || worst < VIBRATION_LIMIT {
        return None;
    }
    Some(condition(
        Severity::Warning,
        format!("vibration {worst:.0}"),
    ))
}

fn prearm(vehicle: &Vehicle) -> Option<Alert> {
    if vehicle.armed() || vehicle.health.is_none_or(|health| health.prearm_ok()) {
        return None;
    }
    match vehicle.prearm.last() {
        Some(reason) => Some(condition(Severity::Warning, reason.clone())),
        None => Some(condition(Severity::Notice, "not ready to arm")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vehicle::{Battery, Fence, Health, StatusText};

    fn vehicle() -> Vehicle {
        let mut vehicle = Vehicle::new(1, 1);
        vehicle.health = Some(Health {
            present: 0,
            enabled: 0,
            healthy: Health::PREARM,
            load_percent: 0.0,
            at: Duration::ZERO,
        });
        vehicle
    }

    fn text_of(vehicle: &Vehicle) -> Option<String> {
        alert(vehicle, Duration::from_secs(10)).map(|alert| alert.text.to_string())
    }

    #[test]
    fn a_healthy_vehicle_has_no_alert() {
        assert_eq!(text_of(&vehicle()), None);
        assert_eq!(
            text_of(&Vehicle::new(1, 1)),
            None,
            "nothing known is nothing wrong"
        );
    }

    #[test]
    fn the_most_serious_condition_wins() {
        let mut vehicle = vehicle();
        vehicle.health = vehicle.health.map(|health| Health {
            healthy: 0,
            ..health
        });
        assert_eq!(text_of(&vehicle).as_deref(), Some("not ready to arm"));
        vehicle.prearm.push("Need Position Estimate".to_owned());
        assert_eq!(text_of(&vehicle).as_deref(), Some("Need Position Estimate"));
        vehicle.fence = Some(Fence {
            breached: true,
            breaches: 1,
            breach_type: 1,
        });
        assert_eq!(text_of(&vehicle).as_deref(), Some("outside fence"));
        vehicle.batteries.push(Battery {
            id: 0,
            voltage_v: None,
            current_a: None,
            consumed_mah: None,
            consumed_wh: None,
            remaining_percent: Some(9),
            at: Duration::ZERO,
        });
        assert_eq!(text_of(&vehicle).as_deref(), Some("BATTERY 9 %"));
        vehicle.link.lost = true;
        vehicle.link.last_heard = Some(Duration::from_secs(4));
        assert_eq!(text_of(&vehicle).as_deref(), Some("LINK LOST 6 s"));
        vehicle.texts.push(StatusText {
            severity: Severity::Critical,
            text: "Crash: Disarming: AngErr=179>30".to_owned(),
            at: Duration::from_secs(9),
        });
        assert_eq!(text_of(&vehicle).as_deref(), Some("CRASHED, disarmed"));
    }

    #[test]
    fn a_crash_is_shown_until_the_vehicle_is_armed_again() {
        let hear = |vehicle: &mut Vehicle, text: &str| {
            vehicle.texts.push(StatusText {
                severity: Severity::Critical,
                text: text.to_owned(),
                at: Duration::ZERO,
            });
        };
        let long_after = Duration::from_secs(1000);
        let shown =
            |vehicle: &Vehicle| alert(vehicle, long_after).map(|alert| alert.text.to_string());
        let mut vehicle = vehicle();
        hear(&mut vehicle, "SIM Hit ground at 0.48 m/s");
        assert_eq!(shown(&vehicle), None, "a landing");
        hear(&mut vehicle, "SIM Hit ground at 15.97 m/s");
        hear(&mut vehicle, "Disarming motors");
        assert_eq!(shown(&vehicle).as_deref(), Some("CRASHED at 16 m/s"));
        hear(&mut vehicle, "Arming motors");
        assert_eq!(shown(&vehicle), None);
    }

    #[test]
    fn a_vehicle_that_falls_says_so() {
        let mut vehicle = vehicle();
        vehicle.landed = LandedState::InAir;
        assert_eq!(text_of(&vehicle), None, "whether it is armed is not known");
        vehicle.heartbeat = Some(crate::vehicle::Heartbeat {
            mav_type: 2,
            autopilot: 3,
            class: crate::vehicle::VehicleClass::Copter,
            mode: crate::vehicle::VehicleClass::Copter
                .mode("GUIDED")
                .expect("a mode"),
            armed: false,
            status: SystemStatus::Active,
            at: Duration::ZERO,
        });
        assert_eq!(
            text_of(&vehicle).as_deref(),
            Some("MOTORS STOPPED in the air")
        );
    }
}
