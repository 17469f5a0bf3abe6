//! `recover`: every vehicle back on a pad, disarmed, with enough battery left.

use super::{
    DOWN_FOR, ObjectiveDetails, ObjectiveKind, ObjectiveScene, ObjectiveStanding, Tracker, Trying,
};
use crate::mission::craft::{Craft, RUNNING_SHORT};
use crate::mission::format::{FileTable, KindOf, number};
use crate::mission::skill::Skill;
use crate::mission::world::World;
use crate::text;
use crate::text::Text;

#[derive(Debug, Clone)]
struct Recover {
    radius_m: f64,
    battery_percent: f64,
}

pub(super) const KIND: KindOf<Box<dyn ObjectiveKind>> = KindOf {
    name: "recover",
    about: "met when all vehicles are on the pads, disarmed, with enough charge left; nearly every mission has this objective",
    read,
};

fn read(table: &mut FileTable<'_>) -> Option<Box<dyn ObjectiveKind>> {
    let radius = number(0.5, 1000.0, "m");
    let radius_m = table.need("radius", radius, "maximum distance from a pad");
    let charge = number(0.0, 100.0, "%");
    let battery_percent = table.need("battery_pct", charge, "minimum charge after landing");
    Some(Box::new(Recover {
        radius_m: radius_m?,
        battery_percent: battery_percent?,
    }))
}

impl ObjectiveKind for Recover {
    fn skill(&self, vehicles: usize) -> Option<Skill> {
        Some(if vehicles > 1 { Skill::K10 } else { Skill::K3 })
    }

    fn trying(&self) -> Trying {
        Trying::Always
    }

    fn start(&self, _: &World) -> Box<dyn Tracker> {
        Box::new(self.clone())
    }
}

impl Recover {
    /// Whether a vehicle is disarmed on a pad with enough battery left. One without battery reports
    /// passes the battery check.
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
    fn standing(&self, scene: &ObjectiveScene<'_>) -> ObjectiveStanding {
        let (home, count) = (self.home(scene.vehicles), scene.vehicles.len());
        let stopped = |craft: &Craft| craft.lost || craft.down_for >= DOWN_FOR;
        ObjectiveStanding {
            fraction: home as f64 / count.max(1) as f64,
            measure: home as f64,
            met: count > 0 && home == count,
            settled: count > 0 && scene.vehicles.iter().all(stopped),
            landing: true,
        }
    }

    fn is_out_of_reach(&self, scene: &ObjectiveScene<'_>) -> bool {
        let mut vehicles = scene.vehicles.iter();
        vehicles.any(|craft| craft.lost && !self.is_home(craft))
    }

    fn details(&self, scene: &ObjectiveScene<'_>) -> ObjectiveDetails {
        ObjectiveDetails {
            product: None,
            result: result(scene.vehicles, self.home(scene.vehicles)),
            target: text!(
                "mission-recover-target",
                radius = format!("{:.0}", self.radius_m),
                percent = format!("{:.0}", self.battery_percent)
            ),
            outlook: self.outlook(scene.vehicles),
            advice: self.advice(scene.vehicles),
        }
    }
}

impl Recover {
    fn home(&self, vehicles: &[Craft]) -> usize {
        vehicles.iter().filter(|craft| self.is_home(craft)).count()
    }

    fn is_short(&self, craft: &Craft) -> Option<f64> {
        let percent = craft.battery_percent;
        percent.filter(|&percent| percent < self.battery_percent)
    }

    fn is_off(&self, craft: &Craft) -> Option<f64> {
        let distance_m = craft.pad_distance_m;
        distance_m.filter(|&distance_m| distance_m > self.radius_m)
    }

    /// The most urgent need of a mission's only vehicle while it flies: the battery when it runs
    /// low, otherwise the distance home; `None` with several vehicles. Short, since it is shown
    /// beside the title.
    fn outlook(&self, vehicles: &[Craft]) -> Option<Text> {
        let [craft] = vehicles else { return None };
        if craft.lost || !craft.flown || craft.is_down() {
            return None;
        }
        let least = self.battery_percent;
        let away = self.is_off(craft).map(|distance_m| {
            text!(
                "mission-recover-away",
                distance = format!("{distance_m:.0}")
            )
        });
        let battery = |percent: f64| {
            text!(
                "mission-recover-charge",
                needed = format!("{least:.0}"),
                percent = format!("{:.0}", percent.floor())
            )
        };
        match (away, craft.battery_percent) {
            (_, Some(percent)) if percent < least + RUNNING_SHORT => Some(battery(percent)),
            (Some(away), _) => Some(away),
            (None, _) => Some(text!("mission-recover-landing")),
        }
    }

    /// Advice about the first vehicle that is not home.
    fn advice(&self, vehicles: &[Craft]) -> Text {
        let radius = format!("{:.0}", self.radius_m);
        let least = format!("{:.0}", self.battery_percent);
        let astray = vehicles.iter().find(|craft| !self.is_home(craft));
        let Some(craft) = astray.filter(|craft| craft.flown && !craft.lost) else {
            return text!("mission-recover-fly", radius = radius, percent = least);
        };
        let mut advice = Vec::new();
        // Only the first piece of advice begins with a capital letter.
        let place = |advice: &[Text]| if advice.is_empty() { "first" } else { "later" };
        if let Some(percent) = self.is_short(craft) {
            advice.push(text!(
                "mission-recover-earlier",
                place = place(&advice),
                least = least,
                percent = format!("{:.0}", percent.floor())
            ));
        }
        if let Some(distance_m) = self.is_off(craft) {
            advice.push(text!(
                "mission-recover-closer",
                place = place(&advice),
                radius = radius,
                distance = format!("{distance_m:.1}")
            ));
        }
        if !craft.is_down() {
            advice.push(text!("mission-recover-disarm", place = place(&advice)));
        }
        Text::joined("", vec![Text::joined("; ", advice), ".".into()])
    }
}

fn result(vehicles: &[Craft], home: usize) -> Text {
    match vehicles {
        [craft] if craft.lost => text!("mission-recover-lost"),
        _ if vehicles.iter().all(|craft| !craft.flown) => text!("mission-recover-not-flown"),
        [craft] if !craft.is_down() => text!("mission-recover-in-air"),
        [craft] => {
            let unknown = || Text::from("?");
            let distance = craft.pad_distance_m.map_or_else(unknown, |distance_m| {
                text!(
                    "mission-recover-metres",
                    distance = format!("{distance_m:.1}")
                )
            });
            let battery = craft
                .battery_percent
                .map_or_else(unknown, |percent| format!("{percent:.0} %").into());
            Text::joined(", ", vec![distance, battery])
        }
        _ => text!("mission-recover-home", home = home, count = vehicles.len()),
    }
}
