//! `recover`: every vehicle back on a pad, disarmed, with enough battery left.

use serde::Deserialize;
use toml::Spanned;

use super::{DOWN_FOR, Kind, Scene, Standing, Tracker};
use crate::mission::craft::Craft;
use crate::mission::file::{Draft, Faults, Section};
use crate::mission::flight::World;

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct RecoverFile {
    radius: Spanned<f64>,
    battery_pct: Spanned<f64>,
}

#[derive(Debug, Clone)]
struct Recover {
    radius_m: f64,
    battery_percent: f64,
}

/// Reads a `[[objectives]]` of kind `recover`.
pub(crate) fn read(section: Section<'_>, _: &Draft, faults: &mut Faults) -> Option<Box<dyn Kind>> {
    let file: RecoverFile = faults.read(section)?;
    Some(Box::new(Recover {
        radius_m: faults.number(&file.radius, 0.5..=1000.0, "radius"),
        battery_percent: faults.number(&file.battery_pct, 0.0..=100.0, "battery_pct"),
    }))
}

impl Kind for Recover {
    fn start(&self, _: &World) -> Box<dyn Tracker> {
        Box::new(self.clone())
    }
}

impl Recover {
    /// A vehicle that does not report its battery is not blamed for it.
    fn is_home(&self, craft: &Craft) -> bool {
        craft.is_down()
            && craft
                .pad_distance_m
                .is_some_and(|distance| distance <= self.radius_m)
            && craft
                .battery_percent
                .is_none_or(|percent| percent >= self.battery_percent)
    }
}

impl Tracker for Recover {
    fn standing(&self, scene: &Scene<'_>) -> Standing {
        let home = scene
            .vehicles
            .iter()
            .filter(|craft| self.is_home(craft))
            .count();
        let count = scene.vehicles.len();
        let met = count > 0 && home == count;
        let stopped = |craft: &Craft| craft.lost || craft.down_for >= DOWN_FOR;
        Standing {
            fraction: home as f64 / count.max(1) as f64,
            measure: home as f64,
            met,
            settled: count > 0 && scene.vehicles.iter().all(stopped),
            landing: true,
            quality: None,
            result: result(scene.vehicles, home),
            target: format!("{:.0} m, {:.0} %", self.radius_m, self.battery_percent),
            advice: format!(
                "Fly, then land within {:.0} m of a pad with {:.0} % battery and wait for the disarm: rtl does both.",
                self.radius_m, self.battery_percent
            ),
        }
    }
}

fn result(vehicles: &[Craft], home: usize) -> String {
    match vehicles {
        [craft] if craft.lost => "vehicle lost".to_owned(),
        [craft] if !craft.flown => "not flown".to_owned(),
        [craft] if !craft.is_down() => "in the air".to_owned(),
        [craft] => {
            let distance = craft
                .pad_distance_m
                .map_or("?".to_owned(), |m| format!("{m:.1} m"));
            let battery = craft
                .battery_percent
                .map_or("?".to_owned(), |p| format!("{p:.0} %"));
            format!("{distance}, {battery}")
        }
        _ => format!("{home}/{} home", vehicles.len()),
    }
}
