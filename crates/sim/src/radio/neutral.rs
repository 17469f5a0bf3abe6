//! Sticks and switches at the moment of arming.

use super::{RadioRules, Sticks};
use crate::kind::VehicleKind;
use crate::parameters::Parameters;

/// Bits of `RC_OPTIONS`: the throttle has to be down, and the other sticks need not be neutral.
const CHECKS_THROTTLE: i64 = 1 << 5;
const SKIPS_OTHERS: i64 = 1 << 6;
/// The bit of `PILOT_THR_BHV` for a throttle that springs to its middle.
const SPRUNG_THROTTLE: i64 = 1;
/// Only functions with this number or a higher one may be assigned to several switches.
const UNIQUE_BELOW: u16 = 256;
const NAMES: [&str; 4] = ["Roll", "Pitch", "Throttle", "Yaw"];
const PITCH: usize = 1;
const THROTTLE: usize = 2;
const YAW: usize = 3;

/// The sticks that have to be neutral.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct NeutralRules {
    /// The channels of roll, pitch, throttle and yaw, from 1; `None` for one that is not checked.
    channels: [Option<usize>; 4],
    /// Whether the throttle of this kind of vehicle rests in its middle.
    centres_throttle: bool,
}

impl NeutralRules {
    pub(super) fn read(all: &Parameters, channels: [usize; 4]) -> Self {
        let options = all.value("RC_OPTIONS") as i64;
        let is_sprung = all.value("PILOT_THR_BHV") as i64 & SPRUNG_THROTTLE != 0;
        let mut checked = channels.map(Some);
        for (stick, channel) in checked.iter_mut().enumerate() {
            let is_skipped = if stick == THROTTLE {
                options & CHECKS_THROTTLE == 0 || is_sprung
            } else {
                options & SKIPS_OTHERS != 0
            };
            if is_skipped {
                *channel = None;
            }
        }
        let is_rover = all.kind() != VehicleKind::Copter;
        if is_rover {
            // It has steering and throttle only.
            checked[PITCH] = None;
            checked[YAW] = None;
        }
        Self {
            channels: checked,
            centres_throttle: is_rover,
        }
    }
}

impl RadioRules {
    /// The reasons not to arm now. For arming by the yaw stick, that stick need not be neutral.
    pub(crate) fn arming_obstacles(&self, sticks: &Sticks, by_yaw_stick: bool) -> Vec<String> {
        let mut reasons = Vec::new();
        if self.has_duplicate_switches() {
            reasons.push("Duplicate Aux Switch Options".to_owned());
        }
        let mode_channel = self.mode_channel;
        let on_mode_channel = self.functions.get(mode_channel.wrapping_sub(1));
        if on_mode_channel.is_some_and(|function| *function != 0) {
            reasons.push(format!("Mode channel and RC{mode_channel}_OPTION conflict"));
        }
        // The throttle is checked last.
        for stick in [0, PITCH, YAW, THROTTLE] {
            let range = &self.sticks[stick];
            let pulse_us = sticks.channels_us[stick];
            let is_neutral = if stick == THROTTLE && !self.neutral.centres_throttle {
                range.pushed(pulse_us) == 0.0
            } else {
                range.off_centre(pulse_us) == 0.0 || (by_yaw_stick && stick == YAW)
            };
            if let (Some(channel), false) = (self.neutral.channels[stick], is_neutral) {
                let name = NAMES[stick];
                reasons.push(format!("{name} (RC{channel}) is not neutral"));
            }
        }
        reasons
    }

    fn has_duplicate_switches(&self) -> bool {
        let unique = |function: u16| (1..UNIQUE_BELOW).contains(&function);
        let functions = self.functions.iter().enumerate();
        functions
            .filter(|(_, function)| unique(**function))
            .any(|(at, function)| self.functions[..at].contains(function))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sticks_have_to_be_neutral_and_switches_different() {
        let mut all = Parameters::new(crate::VehicleKind::Copter, 1);
        let mut sticks = Sticks::RELEASED;
        let reasons = |all: &Parameters, sticks: &Sticks, by_yaw_stick: bool| {
            RadioRules::read(all).arming_obstacles(sticks, by_yaw_stick)
        };
        assert!(reasons(&all, &sticks, false).is_empty());
        sticks.channels_us[..4].copy_from_slice(&[1600, 1500, 1200, 1900]);
        assert_eq!(
            reasons(&all, &sticks, false),
            [
                "Roll (RC1) is not neutral",
                "Yaw (RC4) is not neutral",
                "Throttle (RC3) is not neutral"
            ]
        );
        assert_eq!(reasons(&all, &sticks, true).len(), 2);
        all.set("RC_OPTIONS", 64.0);
        assert!(reasons(&all, &sticks, false).is_empty());
        all.set("RC5_OPTION", 7.0);
        assert_eq!(
            reasons(&all, &sticks, false),
            [
                "Duplicate Aux Switch Options",
                "Mode channel and RC5_OPTION conflict"
            ]
        );
    }
}
