//! `clear`: clear mines with a ground robot that carries a flail.

use super::{Demands, ObjectiveDetails, ObjectiveKind, ObjectiveScene, ObjectiveStanding, Tracker};
use crate::mission::craft::Craft;
use crate::mission::format::{CountTarget, FileTable, KindOf};
use crate::mission::hazard::Field;
use crate::mission::skill::Skill;
use crate::mission::world::World;
use crate::text;

#[derive(Debug, Clone)]
struct Clear {
    hazard: usize,
    target: CountTarget,
}

pub(super) const KIND: KindOf<Box<dyn ObjectiveKind>> = KindOf {
    name: "clear",
    about: "met when ground robots with a flail have cleared enough mines",
    read,
};

fn read(table: &mut FileTable<'_>) -> Option<Box<dyn ObjectiveKind>> {
    let hazard = table.need_hazard("hazard", "minefield to clear");
    let target = table.need_count(1, 2000, "mines");
    Some(Box::new(Clear {
        hazard: hazard?,
        target: target?,
    }))
}

impl ObjectiveKind for Clear {
    fn skill(&self, vehicles: usize) -> Option<Skill> {
        Some(if vehicles > 1 { Skill::K10 } else { Skill::K3 })
    }

    fn demands(&self) -> Demands<'_> {
        Demands::default()
    }

    fn start(&self, _: &World) -> Box<dyn Tracker> {
        Box::new(self.clone())
    }
}

impl Clear {
    fn cleared(&self, scene: &ObjectiveScene<'_>) -> usize {
        let field = scene.world.field(self.hazard);
        field.map_or(0, Field::cleared)
    }

    /// Whether robots with a flail took part, and all of them are lost.
    fn has_no_robot_left(scene: &ObjectiveScene<'_>) -> bool {
        let mut robots = scene.vehicles.iter().filter(|craft| craft.has_flail);
        let first = robots.next();
        first.is_some_and(|craft| craft.lost) && robots.all(|craft: &Craft| craft.lost)
    }
}

impl Tracker for Clear {
    fn standing(&self, scene: &ObjectiveScene<'_>) -> ObjectiveStanding {
        let cleared = self.cleared(scene);
        let met = cleared >= self.target.met_at;
        ObjectiveStanding {
            fraction: self.target.credit(cleared),
            measure: cleared as f64,
            met,
            settled: met || Self::has_no_robot_left(scene),
            landing: false,
        }
    }

    fn is_out_of_reach(&self, scene: &ObjectiveScene<'_>) -> bool {
        self.cleared(scene) < self.target.met_at && Self::has_no_robot_left(scene)
    }

    fn details(&self, scene: &ObjectiveScene<'_>) -> ObjectiveDetails {
        ObjectiveDetails {
            product: None,
            result: text!("clear-result", count = self.cleared(scene)),
            outlook: None,
            target: text!("clear-target", count = self.target.met_at),
            advice: text!("clear-advice"),
        }
    }
}
