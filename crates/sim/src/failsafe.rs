//! Failsafes: automatic reactions to a lost link, a low battery or a bad estimate.
//!
//! Conditions, texts and actions are those of `ArduCopter` (`events.cpp`, `ekf_check.cpp`, `AP_BattMonitor`).

mod battery;
mod ekf;
mod links;
mod surface;
mod surface_estimate;

use std::time::Duration;

use mavlink::dialects::ardupilotmega::{MavBatteryChargeState, MavSeverity};

pub(super) use self::battery::BatteryRules;
use self::battery::BatteryWatch;
use self::ekf::EkfWatch;
pub(super) use self::ekf::is_over;
use self::links::LinkWatch;
use self::surface::{SurfaceRules, SurfaceWatch};
use super::battery::Battery;
use super::estimator::{Estimator, RadioFault};
use super::mode::{Mode, ModeId};
use super::parameters::Parameters;
use super::reaction::Reaction;

/// The time between checks, in steps.
pub(super) const EVERY_STEPS: u64 = 10;

/// Exceptions to the failsafes: the bits of `FS_OPTIONS`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Options(u32);

impl Options {
    const RADIO_CONTINUES_AUTO: u32 = 1;
    const STATION_CONTINUES_AUTO: u32 = 1 << 1;
    const RADIO_CONTINUES_GUIDED: u32 = 1 << 2;
    const LANDING_CONTINUES: u32 = 1 << 3;
    const STATION_CONTINUES_PILOTED: u32 = 1 << 4;

    fn has(self, bit: u32) -> bool {
        self.0 & bit != 0
    }
}

/// The conditions and actions of the failsafes, from the `FS_*` and `BATT_*` parameters.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct FailsafeRules {
    /// The action for a lost ground station (`FS_GCS_ENABLE`).
    ground_station: i32,
    ground_station_timeout: Duration,
    /// The action for a lost radio (`FS_THR_ENABLE`); 0 for none.
    pub(super) radio: i32,
    radio_timeout: Duration,
    /// The throttle below which the radio counts as lost (`FS_THR_VALUE`), in microseconds.
    pub(super) radio_low_us: f64,
    options: Options,
    /// The maximum variance of the estimator (`FS_EKF_THRESH`); 0 for no limit.
    pub(super) ekf_threshold: f64,
    ekf_action: i32,
    pub(super) battery: BatteryRules,
    surface: SurfaceRules,
}

impl FailsafeRules {
    pub(super) fn read(all: &Parameters) -> Self {
        let seconds = |name| Duration::from_secs_f64(all.value(name).clamp(0.0, 1e6));
        Self {
            ground_station: all.value("FS_GCS_ENABLE") as i32,
            ground_station_timeout: seconds("FS_GCS_TIMEOUT"),
            radio: all.value("FS_THR_ENABLE") as i32,
            radio_timeout: seconds("RC_FS_TIMEOUT"),
            radio_low_us: all.value("FS_THR_VALUE"),
            options: Options(all.value("FS_OPTIONS") as u32),
            ekf_threshold: all.value("FS_EKF_THRESH"),
            ekf_action: all.value("FS_EKF_ACTION") as i32,
            battery: BatteryRules::read(all),
            surface: SurfaceRules::read(all),
        }
    }
}

/// The inputs of the failsafes.
#[expect(
    clippy::struct_excessive_bools,
    reason = "each is a fact of its own, and any may hold beside any other"
)]
pub(super) struct FailsafeInputs<'a> {
    pub(super) now: Duration,
    pub(super) rules: &'a FailsafeRules,
    pub(super) armed: bool,
    pub(super) landed: bool,
    pub(super) mode: Mode,
    pub(super) is_rover: bool,
    pub(super) is_landing: bool,
    pub(super) throttle_is_low: bool,
    pub(super) is_booted: bool,
    pub(super) estimator: &'a Estimator,
    pub(super) battery: &'a Battery,
    pub(super) battery_capacity_mah: f64,
    pub(super) radio: RadioInputs,
}

/// The input from the remote control.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct RadioInputs {
    pub(super) fault: RadioFault,
    /// Whether a ground station overrides the receiver.
    pub(super) is_overridden: bool,
    /// Whether the remote control has been heard since boot.
    pub(super) was_heard: bool,
    pub(super) throttle_us: f64,
}

impl FailsafeInputs<'_> {
    /// Whether to disarm a vehicle on the ground instead of changing its mode.
    fn should_disarm(&self) -> bool {
        match self.mode.id {
            ModeId::Stabilize | ModeId::Acro => self.throttle_is_low || self.landed,
            _ => self.landed,
        }
    }

    /// Whether a landing is under way that must not be interrupted (`FS_OPTIONS`).
    fn goes_on_landing(&self) -> bool {
        self.is_landing && self.rules.options.has(Options::LANDING_CONTINUES)
    }
}

/// The state of the failsafes.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Failsafe {
    /// The time of the ground station's last heartbeat; `None` before the first one.
    pub(super) heard: Option<Duration>,
    links: LinkWatch,
    ekf: EkfWatch,
    battery: BatteryWatch,
    /// The links of a rover.
    surface: SurfaceWatch,
    /// Whether a rover uses the simpler estimate instead of the EKF.
    falls_back: bool,
}

impl Failsafe {
    /// Whether the vehicle reports an emergency.
    pub(super) fn is_active(&self) -> bool {
        self.links.station_is_lost()
            || self.links.radio_is_lost()
            || self.ekf.is_bad()
            || self.battery.has_triggered()
    }

    /// Whether a lost link has triggered a rover's failsafe, which alone counts as an emergency there.
    pub(super) fn has_lost_a_link(&self) -> bool {
        self.surface.triggered
    }

    /// Whether the battery has triggered its failsafe. Only a reboot resets that.
    pub(super) fn battery_is_down(&self) -> bool {
        self.battery.has_triggered()
    }

    pub(super) fn charge_state(&self) -> MavBatteryChargeState {
        self.battery.charge_state()
    }

    /// Whether the ground station is lost.
    pub(super) fn station_is_lost(&self) -> bool {
        self.links.station_is_lost()
    }

    /// Whether the remote control is lost.
    pub(super) fn radio_is_lost(&self) -> bool {
        self.links.radio_is_lost() || self.surface.radio_lost
    }
}

/// The text `X Failsafe`, with its action.
fn announce(what: &str, outcome: Option<&str>) -> Reaction {
    let text = match outcome {
        Some(outcome) => format!("{what} Failsafe - {outcome}"),
        None => format!("{what} Failsafe"),
    };
    Reaction::Say(MavSeverity::MAV_SEVERITY_WARNING, text)
}
