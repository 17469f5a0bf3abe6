//! `protect`: a zone must not burn. `contain`: less must burn than if nobody did anything.

use serde::Deserialize;
use toml::Spanned;

use super::{Kind, Scene, Standing, Tracker, partial_credit};
use crate::mission::file::{Better, Draft, Faults, Section};
use crate::mission::hazard::Fire;
use crate::mission::world::World;
use crate::mission::zone::Shape;
use crate::text;
use crate::text::Text;

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct ProtectFile {
    of: Spanned<String>,
    zone: Spanned<String>,
}

#[derive(Debug, Clone)]
struct Protect {
    /// The hazard's place in the file.
    hazard: usize,
    zone: Shape,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct ContainFile {
    of: Spanned<String>,
    target: Spanned<f64>,
    partial_from: Spanned<f64>,
}

#[derive(Debug, Clone)]
struct Contain {
    hazard: usize,
    target: f64,
    partial_from: f64,
}

/// Reads a `[[objectives]]` of kind `protect`.
pub(crate) fn read(
    section: Section<'_>,
    draft: &Draft,
    faults: &mut Faults,
) -> Option<Box<dyn Kind>> {
    let file: ProtectFile = faults.read(section)?;
    let zone = draft.task_zone(&file.zone, faults)?.shape.clone();
    Some(Box::new(Protect {
        hazard: draft.hazard(&file.of, faults)?,
        zone,
    }))
}

/// Reads a `[[objectives]]` of kind `contain`.
pub(crate) fn read_contain(
    section: Section<'_>,
    draft: &Draft,
    faults: &mut Faults,
) -> Option<Box<dyn Kind>> {
    let file: ContainFile = faults.read(section)?;
    let written = (&file.target, &file.partial_from);
    let (target, partial_from) = faults.target(written, 0.0..=1.0, Better::Lower);
    Some(Box::new(Contain {
        hazard: draft.hazard(&file.of, faults)?,
        target,
        partial_from,
    }))
}

impl Kind for Protect {
    fn start(&self, _: &World) -> Box<dyn Tracker> {
        Box::new(self.clone())
    }
}

impl Kind for Contain {
    fn start(&self, _: &World) -> Box<dyn Tracker> {
        Box::new(self.clone())
    }
}

fn fire<'a>(scene: &'a Scene<'_>, hazard: usize) -> Option<&'a Fire> {
    scene.world.field(hazard)?.fire()
}

impl Tracker for Protect {
    fn standing(&self, scene: &Scene<'_>) -> Standing {
        let fire = fire(scene, self.hazard);
        let (mut lost, mut all) = (0_usize, 0_usize);
        if let Some(grid) = fire.map(Fire::grid) {
            for index in (0..grid.len()).filter(|&index| self.zone.contains(grid.centre(index))) {
                all += 1;
                lost += usize::from(grid.has_burnt(index));
            }
        }
        let saved = lost == 0;
        let out = fire.is_none_or(Fire::is_out);
        // Until somebody has flown, nobody has saved anything.
        let begun = scene.vehicles.iter().any(|craft| craft.flown);
        Standing {
            fraction: if saved && begun {
                1.0
            } else if begun {
                // What is left of it counts for little.
                0.5 * (1.0 - lost as f64 / all.max(1) as f64)
            } else {
                0.0
            },
            measure: lost as f64,
            met: saved && begun,
            settled: out || !saved,
            landing: false,
            quality: None,
            result: match (saved, out) {
                (true, true) => text!("protect-safe"),
                (true, false) => text!("protect-still"),
                (false, _) => text!("protect-burnt", lost = lost, all = all),
            },
            outlook: None,
            quality_advice: Text::default(),
            target: text!("protect-target"),
            advice: text!("protect-advice"),
        }
    }
}

impl Tracker for Contain {
    fn standing(&self, scene: &Scene<'_>) -> Standing {
        let fire = fire(scene, self.hazard);
        let (burnt, untouched) = fire.map_or((0, 0), |fire| {
            (fire.grid().burnt(), fire.untouched().burnt())
        });
        let share = burnt as f64 / untouched.max(1) as f64;
        let good = scene.releases.iter().filter(|release| release.good).count();
        let all = scene.releases.len();
        let met = share <= self.target;
        Standing {
            fraction: partial_credit(share, self.partial_from, self.target),
            measure: share,
            met,
            settled: fire.is_none_or(Fire::is_out),
            landing: false,
            quality: Some((
                good as f64 / all.max(1) as f64,
                text!("contain-hits", good = good, all = all),
            )),
            result: text!("contain-share", percent = format!("{:.0}", share * 100.0)),
            outlook: None,
            quality_advice: text!("contain-quality"),
            target: text!(
                "contain-target",
                percent = format!("{:.0}", self.target * 100.0)
            ),
            advice: text!("contain-advice"),
        }
    }
}
