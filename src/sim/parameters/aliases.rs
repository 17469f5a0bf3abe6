//! Names that newer firmware has for parameters of the table. They answer to their name and are not listed.

/// Whether the newer parameter means the opposite.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Sense {
    Same,
    Opposite,
}

use Sense::{Opposite, Same};

/// `ArduPilot` 4.7's name, the name in the table, and how the values go together.
const ALIASES: &[(&str, &str, Sense)] = &[
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

/// A newer name with the parameter that it stands for; upper and lower case are the same.
pub(super) fn find(name: &str) -> Option<(&'static str, &'static str, Sense)> {
    ALIASES
        .iter()
        .copied()
        .find(|(alias, _, _)| alias.eq_ignore_ascii_case(name))
}

impl Sense {
    /// The value of one parameter as the other's.
    pub(super) fn convert(self, value: f32) -> f32 {
        match self {
            Same => value,
            Opposite => f32::from(value == 0.0),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::Parameters;
    use super::*;

    #[test]
    fn every_newer_name_sets_and_reads_an_old_parameter() {
        for (alias, old, sense) in ALIASES {
            let mut all = Parameters::new(1);
            for value in [0.0, 1.0] {
                let set = all.set(&alias.to_lowercase(), value).expect("known");
                assert_eq!((set.name, set.value.to_bits()), (*alias, value.to_bits()));
                let stored = all.named(old).expect("in the table").value;
                assert_eq!(stored.to_bits(), sense.convert(value).to_bits(), "{alias}");
                assert!(
                    (0..all.count()).all(|index| all.at(index).expect("listed").name != *alias)
                );
            }
        }
    }
}
