//! Parameters of the simulation that have different names in `ArduPilot` 4.6 and 4.7.

/// How the values of a renamed parameter correspond.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AliasSense {
    /// Both firmware versions use the same values.
    Same,
    /// The values are inverted: 0 in one firmware is 1 in the other.
    Opposite,
}

use AliasSense::{Opposite, Same};

/// The names in `ArduPilot` 4.7 and 4.6, and how the values correspond.
const ALIASES: &[(&str, &str, AliasSense)] = &[
    ("SIM_ACC1_FAIL", "SIM_ACCEL1_FAIL", Same),
    ("SIM_ACC2_FAIL", "SIM_ACCEL2_FAIL", Same),
    ("SIM_ACC3_FAIL", "SIM_ACCEL3_FAIL", Same),
    ("SIM_GPS1_ACC", "SIM_GPS_ACC", Same),
    ("SIM_GPS1_ALT_OFS", "SIM_GPS_ALT_OFS", Same),
    ("SIM_GPS1_BYTELOS", "SIM_GPS_BYTELOSS", Same),
    ("SIM_GPS1_DRFTALT", "SIM_GPS_DRIFTALT", Same),
    ("SIM_GPS1_ENABLE", "SIM_GPS_DISABLE", Opposite),
    ("SIM_GPS1_GLTCH_X", "SIM_GPS_GLITCH_X", Same),
    ("SIM_GPS1_GLTCH_Y", "SIM_GPS_GLITCH_Y", Same),
    ("SIM_GPS1_GLTCH_Z", "SIM_GPS_GLITCH_Z", Same),
    ("SIM_GPS1_HDG", "SIM_GPS_HDG", Same),
    ("SIM_GPS1_HZ", "SIM_GPS_HZ", Same),
    ("SIM_GPS1_JAM", "SIM_GPS_JAM", Same),
    ("SIM_GPS1_LAG_MS", "SIM_GPS_LAG_MS", Same),
    ("SIM_GPS1_LCKTIME", "SIM_GPS_LOCKTIME", Same),
    ("SIM_GPS1_NOISE", "SIM_GPS_NOISE", Same),
    ("SIM_GPS1_NUMSATS", "SIM_GPS_NUMSATS", Same),
    ("SIM_GPS1_POS_X", "SIM_GPS_POS_X", Same),
    ("SIM_GPS1_POS_Y", "SIM_GPS_POS_Y", Same),
    ("SIM_GPS1_POS_Z", "SIM_GPS_POS_Z", Same),
    ("SIM_GPS1_TYPE", "SIM_GPS_TYPE", Same),
    ("SIM_GPS1_VERR_X", "SIM_GPS_VERR_X", Same),
    ("SIM_GPS1_VERR_Y", "SIM_GPS_VERR_Y", Same),
    ("SIM_GPS1_VERR_Z", "SIM_GPS_VERR_Z", Same),
    ("SIM_GPS2_ENABLE", "SIM_GPS2_DISABLE", Opposite),
];

/// The names of a parameter in 4.7 and 4.6, and how the values correspond; `None` if the name is not one of 4.7.
/// Case does not matter.
pub(crate) fn older(name: &str) -> Option<(&'static str, &'static str, AliasSense)> {
    let mut all = ALIASES.iter().copied();
    all.find(|(newer, _, _)| newer.eq_ignore_ascii_case(name))
}

/// A parameter's name in the other firmware, and the conversion of values; `None` if both firmwares
/// use the same name. Case does not matter.
pub fn other_name(name: &str) -> Option<(&'static str, AliasSense)> {
    ALIASES.iter().find_map(|&(newer, older, sense)| {
        if newer.eq_ignore_ascii_case(name) {
            Some((older, sense))
        } else if older.eq_ignore_ascii_case(name) {
            Some((newer, sense))
        } else {
            None
        }
    })
}

impl AliasSense {
    /// Converts a value of one firmware to the other's.
    pub fn convert(self, value: f32) -> f32 {
        match self {
            Same => value,
            Opposite => f32::from(value == 0.0),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_lead_to_each_other_and_fit_the_wire() {
        for &(newer, older_name, sense) in ALIASES {
            assert_eq!(other_name(&newer.to_lowercase()), Some((older_name, sense)));
            assert_eq!(other_name(older_name), Some((newer, sense)));
            assert_eq!(older(newer), Some((newer, older_name, sense)));
            assert_eq!(older(older_name), None);
            assert!(
                newer.len() <= 16 && older_name.len() <= 16,
                "{newer} {older_name}"
            );
        }
        assert_eq!(other_name("WPNAV_SPEED"), None);
    }

    #[test]
    fn what_means_the_opposite_is_turned_round_and_back() {
        let turned = [0.0, 1.0, 2.0].map(|value| Opposite.convert(value).to_bits());
        assert_eq!(turned, [1.0_f32, 0.0, 0.0].map(f32::to_bits));
    }
}
