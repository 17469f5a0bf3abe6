//! `deliver`: bring kits to people in time, or nodes to their places.

use super::{
    DemandedEquipment, Demands, Equipment, ObjectiveDetails, ObjectiveKind, ObjectiveScene,
    ObjectiveStanding, Tracker,
};
use crate::mission::format::{CountTarget, FileTable, KindOf, word};
use crate::mission::ground_truth::Load;
use crate::mission::hazard::{Care, Field};
use crate::mission::skill::Skill;
use crate::mission::world::World;
use crate::text;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum What {
    Kit,
    Node,
}

impl What {
    const WORDS: [(&str, Self); 2] = [(Load::Kit.id(), Self::Kit), (Load::Node.id(), Self::Node)];

    fn equipment(self) -> Equipment {
        match self {
            Self::Kit => Equipment::AnyOf(&[Load::Kit]),
            Self::Node => Equipment::AnyOf(&[Load::Node]),
        }
    }
}

#[derive(Debug, Clone)]
struct Deliver {
    hazard: usize,
    what: What,
    target: CountTarget,
}

pub(super) const KIND: KindOf<Box<dyn ObjectiveKind>> = KindOf {
    name: "deliver",
    about: "met when enough people have received a kit in time, or enough nodes are in their places",
    read,
};

fn read(table: &mut FileTable<'_>) -> Option<Box<dyn ObjectiveKind>> {
    let hazard = table.need_hazard("hazard", "hazard with the people or the places");
    let what = table.need("load", word(&What::WORDS), "load to deliver");
    let target = table.need_count(0, 1000, "pieces");
    Some(Box::new(Deliver {
        hazard: hazard?,
        what: what?,
        target: target?,
    }))
}

impl ObjectiveKind for Deliver {
    fn skill(&self, vehicles: usize) -> Option<Skill> {
        Some(if vehicles > 1 { Skill::K10 } else { Skill::K3 })
    }

    fn demands(&self) -> Demands<'_> {
        Demands {
            equipment: Some(DemandedEquipment {
                key: "load",
                equipment: self.what.equipment(),
            }),
            ..Demands::default()
        }
    }

    fn start(&self, _: &World) -> Box<dyn Tracker> {
        Box::new(self.clone())
    }
}

impl Tracker for Deliver {
    fn standing(&self, scene: &ObjectiveScene<'_>) -> ObjectiveStanding {
        self.judged(self.care(scene))
    }

    fn is_out_of_reach(&self, scene: &ObjectiveScene<'_>) -> bool {
        self.is_hopeless(self.care(scene))
    }

    fn details(&self, scene: &ObjectiveScene<'_>) -> ObjectiveDetails {
        let Delivered { done, lost } = self.delivered(self.care(scene));
        ObjectiveDetails {
            product: None,
            result: match self.what {
                What::Kit => text!("deliver-kits", done = done, lost = lost),
                What::Node => text!("deliver-nodes", done = done),
            },
            outlook: None,
            target: match self.what {
                What::Kit => text!("deliver-kits-target", target = self.target.met_at),
                What::Node => text!("deliver-nodes-target", target = self.target.met_at),
            },
            advice: match self.what {
                What::Kit => text!("deliver-kits-advice", lost = lost),
                What::Node => text!("deliver-nodes-advice"),
            },
        }
    }
}

/// What was brought, and how many people were lost meanwhile.
struct Delivered {
    done: usize,
    lost: usize,
}

impl Deliver {
    fn care(&self, scene: &ObjectiveScene<'_>) -> Care {
        let field = scene.world.field(self.hazard);
        field.and_then(Field::care).unwrap_or_default()
    }

    fn delivered(&self, care: Care) -> Delivered {
        match self.what {
            What::Kit => Delivered {
                done: care.helped,
                lost: care.lost,
            },
            What::Node => Delivered {
                done: care.nodes_placed,
                lost: 0,
            },
        }
    }

    /// Whether too few people are left for the target.
    fn is_hopeless(&self, care: Care) -> bool {
        self.what == What::Kit && care.people.saturating_sub(care.lost) < self.target.met_at
    }

    fn judged(&self, care: Care) -> ObjectiveStanding {
        let done = self.delivered(care).done;
        let met = done >= self.target.met_at;
        // No person is left who can still be helped.
        let hopeless = self.what == What::Kit && care.helped + care.lost >= care.people;
        ObjectiveStanding {
            fraction: self.target.credit(done),
            measure: done as f64,
            met,
            settled: met || hopeless,
            landing: false,
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
            target: CountTarget {
                met_at: 4,
                partial_from: 0,
            },
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
