//! The vehicles' equipment, and the areas of the mission.

use super::MissionPage;
use crate::mission::{AreaKind, FitListing};
use crate::text;
use crate::text::Text;
use crate::vehicle_id::ranges;

/// Kinds of areas, each with its message from the map's legend.
const AREAS: [(AreaKind, &str); 6] = [
    (AreaKind::Task, "map-legend-task"),
    (AreaKind::Geofence, "map-legend-fence"),
    (AreaKind::NoFly, "map-legend-no-fly"),
    (AreaKind::Jamming, "map-legend-jamming"),
    (AreaKind::People, "map-legend-people"),
    (AreaKind::Radio, "map-legend-radio"),
];

impl MissionPage<'_> {
    /// Sensors and loads, by vehicle where they differ.
    pub(super) fn fits(&self) -> Vec<(Text, Text)> {
        let fits = self.mission.fits.as_slice();
        let row = |fit: &FitListing| {
            let whose = if fits.len() > 1 {
                text!(
                    "mission-rule-carries",
                    count = fit.vehicles.len(),
                    vehicles = ranges(fit.vehicles.clone())
                )
            } else {
                text!("mission-rule-sensors")
            };
            let carried_loads = fit.loads.iter();
            let loads = carried_loads
                .map(|(name, count)| text!("mission-rule-load", name = name, count = *count));
            let flail = fit.flail.then(|| text!("s_flail"));
            let carried = fit.sensors.iter().cloned().chain(loads).chain(flail);
            let carried: Vec<Text> = carried.collect();
            if carried.is_empty() {
                return (whose, text!("mission-rule-carries-nothing"));
            }
            (whose, Text::joined(", ", carried))
        };
        let all = fits.iter().map(row);
        match fits {
            [only] if only.sensors.is_empty() && only.loads.is_empty() && !only.flail => Vec::new(),
            _ => all.collect(),
        }
    }

    /// The areas known from the start, by kind.
    pub(super) fn zones(&self) -> Option<(Text, Text)> {
        let areas = &self.mission.areas;
        let kind = |(kind, words): &(AreaKind, &'static str)| {
            let of_kind = areas.iter().filter(|area| area.kind == *kind);
            let names: Vec<&str> = of_kind.map(|area| area.name.as_str()).collect();
            let meaning = Text::new(*words, Vec::new());
            (!names.is_empty()).then(|| {
                text!(
                    "mission-rule-area",
                    meaning = meaning,
                    names = names.join(", ")
                )
            })
        };
        let kinds: Vec<Text> = AREAS.iter().filter_map(kind).collect();
        (!kinds.is_empty()).then(|| (text!("mission-rule-areas"), Text::joined("; ", kinds)))
    }
}
