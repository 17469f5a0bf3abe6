//! The kinds of alerts.

use serde::{Deserialize, Serialize};
use strum::{EnumString, IntoStaticStr, VariantNames};

use crate::diagnostic::Diagnostic;
use crate::text;
use crate::text::{Text, figure};

/// The impact speed above which a vehicle breaks, in m/s.
const HARD_LANDING_M_S: f32 = 3.0;

/// The kind of an alert. The names are those of the configuration and of the command line.
#[derive(
    Debug,
    Clone,
    Copy,
    PartialEq,
    Eq,
    PartialOrd,
    Ord,
    Serialize,
    Deserialize,
    EnumString,
    IntoStaticStr,
    VariantNames,
)]
#[serde(rename_all = "kebab-case")]
#[strum(serialize_all = "kebab-case")]
pub enum AlertKind {
    /// The vehicle has come down hard, or its motors have stopped in the air.
    Crash,
    /// The process that simulates the vehicle has ended.
    Process,
    /// The vehicle's link is lost.
    LinkLost,
    /// The autopilot responds to a failure.
    Failsafe,
    /// The vehicle has no reliable satellite position.
    Gps,
    /// The estimates of the EKF contradict the sensors.
    Ekf,
    /// Another vehicle in the air is too close.
    Separation,
    /// Another aircraft comes too close.
    Traffic,
    Battery,
    /// The remaining charge is little more than the flight home needs.
    WayHome,
    /// The vehicle is outside its fence.
    Fence,
    /// The vehicle vibrates too much.
    Vibration,
    /// The vehicle would refuse to arm.
    Prearm,
    /// A serious status text of no other kind.
    Message,
}

impl AlertKind {
    /// The names of all kinds.
    pub const NAMES: &'static [&'static str] = Self::VARIANTS;

    pub fn name(self) -> &'static str {
        self.into()
    }

    /// The kind with this name.
    ///
    /// # Errors
    ///
    /// The name is unknown; the place is the whole word.
    pub fn read(word: &str) -> Result<Self, Diagnostic> {
        word.parse().map_err(|_| {
            Diagnostic::new(0..word.len(), text!("alert-no-kind", word = word))
                .with_help(text!("alert-kinds-are", kinds = Self::NAMES.join(" ")))
                .with_nearest(word, Self::NAMES.iter().copied())
        })
    }

    /// Whether the console adds a notice when such an alert begins, because no message announces it. Other alerts come
    /// with a status text or a notice, or show in the vehicle's values.
    pub const fn needs_notice(self) -> bool {
        match self {
            Self::Crash | Self::Separation | Self::Traffic => true,
            Self::Process
            | Self::LinkLost
            | Self::Failsafe
            | Self::Gps
            | Self::Ekf
            | Self::Battery
            | Self::WayHome
            | Self::Fence
            | Self::Vibration
            | Self::Prearm
            | Self::Message => false,
        }
    }

    /// The text for an alert of several vehicles.
    pub fn title(self) -> Text {
        match self {
            Self::Crash => text!("alert-kind-crash"),
            Self::Process => text!("alert-process"),
            Self::LinkLost => text!("alert-link-lost"),
            Self::Failsafe => text!("alert-failsafe"),
            Self::Gps => text!("alert-kind-gps"),
            Self::Ekf => text!("alert-kind-ekf"),
            Self::Separation => text!("alert-kind-separation"),
            Self::Traffic => text!("alert-kind-traffic"),
            Self::Battery => text!("alert-kind-battery"),
            Self::WayHome => text!("alert-kind-way-home"),
            Self::Fence => text!("alert-fence"),
            Self::Vibration => text!("alert-kind-vibration"),
            Self::Prearm => text!("alert-prearm"),
            Self::Message => text!("alert-kind-message"),
        }
    }

    /// The kind that a vehicle's STATUSTEXT belongs to. Notices of this program carry their kind.
    pub fn of_status_text(words: &str) -> Self {
        let has = |part: &str| words.contains(part);
        if has("link lost") {
            Self::LinkLost
        } else if has("PreArm") {
            Self::Prearm
        } else if has("Crash") || crash(words).is_some() {
            Self::Crash
        } else if has("ailsafe") {
            Self::Failsafe
        } else if has("EKF") {
            Self::Ekf
        } else if has("GPS") {
            Self::Gps
        } else if has("attery") {
            Self::Battery
        } else if has("ence breach") {
            Self::Fence
        } else if has("ibration") {
            Self::Vibration
        } else {
            Self::Message
        }
    }
}

/// The alert for a status text about a crash, from ArduPilot's crash check or from the simulator;
/// `None` for other texts and for a soft touchdown.
pub fn crash(text: &str) -> Option<Text> {
    if text.contains("Crash: Disarming") {
        return Some(text!("alert-crashed"));
    }
    let figures = text.strip_prefix("SIM Hit ground at ")?;
    let speed_m_s: f32 = figures.split_whitespace().next()?.parse().ok()?;
    (speed_m_s > HARD_LANDING_M_S).then(|| text!("alert-crashed-at", speed = figure(speed_m_s, 0)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_kind_is_read_by_its_name() {
        for name in AlertKind::NAMES {
            let kind = AlertKind::read(name).expect(name);
            assert_eq!(kind.name(), *name);
            let json = serde_json::to_string(&kind).expect("a word");
            assert_eq!(json, format!("{name:?}"));
        }
        let fault = AlertKind::read("batery").expect_err("it is no kind");
        let told = fault.one_line("c", "batery");
        assert!(told.contains("did you mean `battery`"), "{told}");
    }
}
