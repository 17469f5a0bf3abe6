//! What a new vehicle lacks before it lets itself be armed, as parameters.

use std::collections::BTreeMap;

use super::Kind;

/// The parameters that every vehicle of a kind is started with: a frame, and calibrations that are not all zero.
pub(super) fn of(kind: Kind) -> BTreeMap<String, f64> {
    let mut all = BTreeMap::new();
    let mut set = |name: String, value: f64| {
        all.insert(name, value);
    };
    if kind == Kind::Copter {
        set("FRAME_CLASS".to_owned(), 1.0);
        set("FRAME_TYPE".to_owned(), 0.0);
    }
    set("BATT_MONITOR".to_owned(), 4.0);
    for compass in ["", "2", "3"] {
        for (axis, offset) in [("X", 5.0), ("Y", 13.0), ("Z", -18.0)] {
            set(format!("COMPASS_OFS{compass}_{axis}"), offset);
        }
    }
    for sensor in ["", "2"] {
        for axis in ["X", "Y", "Z"] {
            set(format!("INS_ACC{sensor}OFFS_{axis}"), 0.001);
            set(format!("INS_ACC{sensor}SCAL_{axis}"), 1.001);
        }
    }
    for channel in 1..=8 {
        for (end, pulse_us) in [("MIN", 1000.0), ("MAX", 2000.0), ("TRIM", 1500.0)] {
            set(format!("RC{channel}_{end}"), pulse_us);
        }
    }
    all
}
