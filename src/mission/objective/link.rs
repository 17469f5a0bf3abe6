//! Objective kind `link`: vehicles at work have to be heard well enough.

use std::time::Duration;

use serde::Deserialize;
use toml::Spanned;

use super::{Kind, Scene, Standing, Tracker, partial_credit};
use crate::mission::TICK;
use crate::mission::file::{Better, Draft, Faults, Section};
use crate::mission::world::World;
use crate::mission::zone::Shape;
use crate::text;
use crate::text::Text;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct LinkFile {
    zone: Spanned<String>,
    margin: Spanned<f64>,
    time: Spanned<f64>,
    target: Spanned<f64>,
    partial_from: Spanned<f64>,
}

/// A link that has to be kept while vehicles work in a zone.
#[derive(Debug, Clone)]
struct Link {
    shape: Shape,
    margin_db: f64,
    /// Vehicle seconds in the zone that are asked for.
    needed: Duration,
    /// The share of them that has to be well heard.
    target: f64,
    partial_from: f64,
}

/// Reads the kind's own keys.
pub(in crate::mission) fn read(
    section: Section<'_>,
    draft: &Draft,
    faults: &mut Faults,
) -> Option<Box<dyn Kind>> {
    let file: LinkFile = faults.read(section)?;
    let needed_s = faults.number(&file.time, 1.0..=86_400.0, "time");
    let written = (&file.target, &file.partial_from);
    let (target, partial_from) = faults.target(written, 0.01..=1.0, Better::Higher);
    Some(Box::new(Link {
        margin_db: faults.number(&file.margin, -20.0..=60.0, "margin"),
        shape: draft.task_zone(&file.zone, faults)?.shape.clone(),
        needed: Duration::try_from_secs_f64(needed_s).ok()?,
        target,
        partial_from,
    }))
}

impl Kind for Link {
    fn start(&self, _: &World) -> Box<dyn Tracker> {
        Box::new(Watched {
            link: self.clone(),
            inside: Duration::ZERO,
            heard: Duration::ZERO,
        })
    }
}

#[derive(Debug)]
struct Watched {
    link: Link,
    /// Time of all vehicles in the zone together, and that of those who were heard well.
    inside: Duration,
    heard: Duration,
}

impl Tracker for Watched {
    fn step(&mut self, scene: &Scene<'_>) {
        for craft in scene
            .vehicles
            .iter()
            .filter(|craft| craft.airborne && !craft.lost)
        {
            if craft
                .truly_at()
                .is_some_and(|at| self.link.shape.contains(at))
            {
                self.inside += TICK;
                let margin_db = scene.margins_db.get(&craft.id);
                if margin_db.is_none_or(|margin_db| *margin_db >= self.link.margin_db) {
                    self.heard += TICK;
                }
            }
        }
    }

    fn standing(&self, _: &Scene<'_>) -> Standing {
        let link = &self.link;
        let share = if self.inside.is_zero() {
            0.0
        } else {
            self.heard.as_secs_f64() / self.inside.as_secs_f64()
        };
        let worked = (self.inside.as_secs_f64() / link.needed.as_secs_f64()).min(1.0);
        let met = worked >= 1.0 && share >= link.target;
        let missing = link.needed.saturating_sub(self.inside).as_secs_f64().ceil();
        Standing {
            fraction: worked * partial_credit(share, link.partial_from, link.target),
            measure: share,
            met,
            settled: met,
            landing: false,
            quality: None,
            result: if self.inside.is_zero() {
                text!("link-none")
            } else {
                text!(
                    "link-kept",
                    percent = format!("{:.0}", share * 100.0),
                    seconds = format!("{:.0}", self.inside.as_secs_f64())
                )
            },
            outlook: (missing > 0.0).then(|| text!("link-more", seconds = format!("{missing:.0}"))),
            quality_advice: Text::default(),
            target: text!(
                "link-target",
                margin = format!("{:.0}", link.margin_db),
                percent = format!("{:.0}", link.target * 100.0)
            ),
            advice: text!("link-advice"),
        }
    }
}
