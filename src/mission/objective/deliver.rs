//! `deliver`: bring kits to people while they are of use, or nodes to their places.

use serde::Deserialize;
use toml::Spanned;

use super::{Kind, Scene, Standing, Tracker, partial_credit};
use crate::mission::file::{Draft, Faults, Section};
use crate::mission::hazard::Care;
use crate::mission::world::World;
use crate::text;
use crate::text::Text;

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct DeliverFile {
    hazard: Spanned<String>,
    load: What,
    target: Spanned<u32>,
    #[serde(default)]
    partial_from: u32,
}

/// What is delivered.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
enum What {
    Kit,
    Node,
}

#[derive(Debug, Clone)]
struct Deliver {
    hazard: usize,
    what: What,
    target: usize,
    partial_from: u32,
}

/// Reads a `[[objectives]]` of kind `deliver`.
pub(crate) fn read(
    section: Section<'_>,
    draft: &Draft,
    faults: &mut Faults,
) -> Option<Box<dyn Kind>> {
    let file: DeliverFile = faults.read(section)?;
    let target = *file.target.get_ref();
    if target <= file.partial_from {
        faults.add(file.target.span(), "`target` must be above `partial_from`");
    }
    Some(Box::new(Deliver {
        hazard: draft.hazard(&file.hazard, faults)?,
        what: file.load,
        target: target as usize,
        partial_from: file.partial_from,
    }))
}

impl Kind for Deliver {
    fn start(&self, _: &World) -> Box<dyn Tracker> {
        Box::new(self.clone())
    }
}

impl Tracker for Deliver {
    fn standing(&self, scene: &Scene<'_>) -> Standing {
        let field = scene.world.field(self.hazard);
        self.judged(
            field
                .and_then(super::super::hazard::Field::care)
                .unwrap_or_default(),
        )
    }
}

impl Deliver {
    fn judged(&self, care: Care) -> Standing {
        let (done, lost) = match self.what {
            What::Kit => (care.helped, care.lost),
            What::Node => (care.nodes_placed, 0),
        };
        let met = done >= self.target;
        // Nobody is left who could be reached.
        let hopeless = self.what == What::Kit && care.helped + care.lost >= care.people;
        let target = self.target as f64;
        Standing {
            fraction: partial_credit(done as f64, f64::from(self.partial_from), target),
            measure: done as f64,
            met,
            settled: met || hopeless,
            landing: false,
            quality: None,
            result: match self.what {
                What::Kit => text!("deliver-kits", done = done, lost = lost),
                What::Node => text!("deliver-nodes", done = done),
            },
            outlook: None,
            quality_advice: Text::default(),
            target: match self.what {
                What::Kit => text!("deliver-kits-target", target = self.target),
                What::Node => text!("deliver-nodes-target", target = self.target),
            },
            advice: match self.what {
                What::Kit => text!("deliver-kits-advice", lost = lost),
                What::Node => text!("deliver-nodes-advice"),
            },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn kits_in_time_and_nodes_in_place_count() {
        let deliver = |what| Deliver {
            hazard: 0,
            what,
            target: 4,
            partial_from: 0,
        };
        let care = Care {
            people: 5,
            helped: 3,
            lost: 1,
            nodes: 4,
            nodes_placed: 4,
        };
        let kits = deliver(What::Kit).judged(care);
        assert!(!kits.met && !kits.settled);
        assert!((kits.fraction - 0.75).abs() < 1e-12);
        assert!(deliver(What::Node).judged(care).met);
        let late = Care { lost: 2, ..care };
        assert!(deliver(What::Kit).judged(late).settled, "nobody is left");
    }
}
