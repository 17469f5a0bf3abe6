//! `recover`: every vehicle back on a pad, disarmed, with enough battery left.

use serde::Deserialize;
use toml::Spanned;

use super::{DOWN_FOR, Kind, Scene, Standing, Tracker};
use crate::mission::craft::Craft;
use crate::mission::file::{Draft, Faults, Section};
use crate::mission::flight::World;

/// The battery is named before the distance when it is less than this many percent above what is needed.
const RUNNING_SHORT: f64 = 10.0;

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
            outlook: self.outlook(scene.vehicles),
            quality_advice: String::new(),
            advice: self.advice(scene.vehicles),
        }
    }
}

impl Recover {
    fn is_short(&self, craft: &Craft) -> Option<f64> {
        let percent = craft.battery_percent;
        percent.filter(|&percent| percent < self.battery_percent)
    }

    fn is_off(&self, craft: &Craft) -> Option<f64> {
        let distance_m = craft.pad_distance_m;
        distance_m.filter(|&distance_m| distance_m > self.radius_m)
    }

    /// What one vehicle needs next, while it flies: the battery when that grows short, else the way home. Short,
    /// since it stands beside the title.
    fn outlook(&self, vehicles: &[Craft]) -> Option<String> {
        let [craft] = vehicles else { return None };
        if craft.lost || !craft.flown || craft.is_down() {
            return None;
        }
        let least = self.battery_percent;
        let away = self
            .is_off(craft)
            .map(|distance_m| format!("{distance_m:.0} m from the pad"));
        let battery = |percent: f64| format!("needs {least:.0} %, has {:.0} %", percent.floor());
        match (away, craft.battery_percent) {
            (_, Some(percent)) if percent < least + RUNNING_SHORT => Some(battery(percent)),
            (Some(away), _) => Some(away),
            (None, percent) => percent.map(battery),
        }
    }

    /// What the first vehicle that is not home did wrong: only that is worth a word.
    fn advice(&self, vehicles: &[Craft]) -> String {
        let (radius_m, least) = (self.radius_m, self.battery_percent);
        let astray = vehicles.iter().find(|craft| !self.is_home(craft));
        let Some(craft) = astray.filter(|craft| craft.flown && !craft.lost) else {
            return format!(
                "Fly, then land within {radius_m:.0} m of a pad with {least:.0} % battery and wait for the disarm: \
                 rtl lands there."
            );
        };
        let mut advice = Vec::new();
        if let Some(percent) = self.is_short(craft) {
            let percent = percent.floor();
            advice.push(format!(
                "come home before {least:.0} %: you had {percent:.0} %"
            ));
        }
        if let Some(distance_m) = self.is_off(craft) {
            advice.push(format!(
                "land within {radius_m:.0} m of a pad: you were {distance_m:.1} m away, rtl lands there"
            ));
        }
        if !craft.is_down() {
            advice.push("land and disarm before the time is up: rtl does both".to_owned());
        }
        let advice = advice.join("; ");
        let mut letters = advice.chars();
        let first = letters.next().map(|letter| letter.to_ascii_uppercase());
        first.into_iter().chain(letters).chain(['.']).collect()
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
