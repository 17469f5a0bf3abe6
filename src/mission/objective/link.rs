//! `link`: vehicles at work must keep a good link.

use std::time::Duration;

use super::{
    DemandedTime, Demands, ObjectiveDetails, ObjectiveKind, ObjectiveScene, ObjectiveStanding,
    Tracker,
};
use crate::mission::TICK;
use crate::mission::format::{
    BetterMeasure, FileTable, KindOf, LONGEST_S, ObjectiveTarget, number, seconds,
};
use crate::mission::skill::Skill;
use crate::mission::world::World;
use crate::mission::zone::Zone;
use crate::text;

#[derive(Debug, Clone)]
struct LinkObjective {
    zone: Zone,
    margin_db: f64,
    /// Vehicles above this height do not count.
    max_height_m: Option<f64>,
    /// The total time that vehicles must spend in the zone.
    needed: Duration,
    /// The share of that time with a good link.
    target: ObjectiveTarget,
}

pub(super) const KIND: KindOf<Box<dyn ObjectiveKind>> = KindOf {
    name: "link",
    about: "met when vehicles have spent `time` in the zone, and have had the link `margin` for the share `target` of it",
    read,
};

fn read(table: &mut FileTable<'_>) -> Option<Box<dyn ObjectiveKind>> {
    let zone = table.need_task_zone();
    let margin_db = table.need("margin", number(-20.0, 60.0, "dB"), "minimum link margin");
    let max_height_m = table.may(
        "max_height",
        number(1.0, 1000.0, "m"),
        "maximum height of vehicles that count (default all count)",
    );
    let time = seconds(1.0, LONGEST_S);
    let needed = table.need("time", time, "time in the zone, all vehicles together");
    let target = table.need_target([0.01, 1.0], BetterMeasure::Higher);
    Some(Box::new(LinkObjective {
        margin_db: margin_db?,
        max_height_m,
        zone: zone?,
        needed: needed?,
        target: target?,
    }))
}

impl ObjectiveKind for LinkObjective {
    fn skill(&self, _: usize) -> Option<Skill> {
        Some(Skill::K5)
    }

    fn demands(&self) -> Demands<'_> {
        Demands {
            zone: Some(&self.zone),
            times: vec![DemandedTime {
                key: "time",
                time: self.needed,
            }],
            ..Demands::default()
        }
    }

    fn start(&self, _: &World) -> Box<dyn Tracker> {
        Box::new(LinkTracker {
            link: self.clone(),
            inside: Duration::ZERO,
            heard: Duration::ZERO,
        })
    }
}

#[derive(Debug, Clone)]
struct LinkTracker {
    link: LinkObjective,
    /// The total time of all vehicles in the zone, and the part of it with a good link.
    inside: Duration,
    heard: Duration,
}

impl LinkTracker {
    /// The share of the time in the zone during which the link was good.
    fn share(&self) -> f64 {
        if self.inside.is_zero() {
            0.0
        } else {
            self.heard.as_secs_f64() / self.inside.as_secs_f64()
        }
    }
}

impl Tracker for LinkTracker {
    fn step(&mut self, scene: &ObjectiveScene<'_>) {
        for craft in scene
            .vehicles
            .iter()
            .filter(|craft| craft.under_way && !craft.lost)
        {
            let most_m = self.link.max_height_m.unwrap_or(f64::INFINITY);
            let at = craft.truly_at().filter(|_| craft.height_m <= most_m);
            if at.is_some_and(|at| self.link.zone.shape.contains(at)) {
                self.inside += TICK;
                let margin_db = scene.margins_db.get(&craft.id);
                if margin_db.is_none_or(|margin_db| *margin_db >= self.link.margin_db) {
                    self.heard += TICK;
                }
            }
        }
    }

    fn standing(&self, _: &ObjectiveScene<'_>) -> ObjectiveStanding {
        let (link, share) = (&self.link, self.share());
        let worked = (self.inside.as_secs_f64() / link.needed.as_secs_f64()).min(1.0);
        let met = worked >= 1.0 && share >= link.target.met_at;
        ObjectiveStanding {
            fraction: worked * link.target.credit(share),
            measure: share,
            met,
            settled: met,
            landing: false,
        }
    }

    fn details(&self, _: &ObjectiveScene<'_>) -> ObjectiveDetails {
        let link = &self.link;
        let missing = link.needed.saturating_sub(self.inside).as_secs_f64().ceil();
        ObjectiveDetails {
            product: None,
            result: if self.inside.is_zero() {
                text!("link-none")
            } else {
                text!(
                    "link-kept",
                    percent = format!("{:.0}", self.share() * 100.0),
                    seconds = format!("{:.0}", self.inside.as_secs_f64())
                )
            },
            outlook: (missing > 0.0).then(|| text!("link-more", seconds = format!("{missing:.0}"))),
            target: text!(
                "link-target",
                margin = format!("{:.0}", link.margin_db),
                percent = format!("{:.0}", link.target.met_at * 100.0)
            ),
            advice: text!("link-advice"),
        }
    }
}
