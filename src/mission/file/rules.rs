//! `[rules]`: the limits of a flight.

use std::time::Duration;

use toml::Spanned;

use crate::mission::FlightRules;
use crate::mission::format::{FileTable, flag, list, number, text};
use crate::vehicle::USUAL_RESERVE_PERCENT;

const USUAL_MAX_HEIGHT_M: f64 = 120.0;
const USUAL_SPEEDUP: f64 = 8.0;

/// The rules if the file does not have the section. The time limit is in another section of the file.
pub(super) fn usual() -> FlightRules {
    FlightRules {
        time_limit: Duration::ZERO,
        max_height_m: USUAL_MAX_HEIGHT_M,
        land_reserve_percent: USUAL_RESERVE_PERCENT,
        separation_m: None,
        pausable: true,
        most_speedup: USUAL_SPEEDUP,
        open_parameters: Vec::new(),
    }
}

pub(super) fn rules(table: &mut FileTable<'_>) -> Option<FlightRules> {
    let usual = usual();
    let height = number(1.0, 10_000.0, "m");
    let charge = number(0.0, 100.0, "%");
    Some(FlightRules {
        time_limit: usual.time_limit,
        max_height_m: table.or("max_agl", height, usual.max_height_m, "maximum height above the pads"),
        land_reserve_percent: table.or(
            "land_reserve_pct",
            charge,
            usual.land_reserve_percent,
            "minimum charge at landing",
        ),
        separation_m: table.may(
            "min_separation",
            number(0.0, 1000.0, "m"),
            "minimum distance between vehicles in the air (default 2 m); if set, surveys, formations and similar verbs also keep it (at least 2 m) instead of 5 m",
        ),
        pausable: table.or("pause", flag(), usual.pausable, "whether pausing is allowed"),
        most_speedup: table.or(
            "speedup",
            number(1.0, 100.0, ""),
            usual.most_speedup,
            "maximum speed-up in flight; 1 allows none",
        ),
        open_parameters: table
            .may(
                "parameters",
                list(text("name of a parameter"), 1, 64),
                "parameters that may be set in a flight that counts; all others are refused there",
            )
            .unwrap_or_default()
            .into_iter()
            .map(Spanned::into_inner)
            .collect(),
    })
}
