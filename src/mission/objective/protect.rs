//! `protect`: a zone must not burn. `contain`: less must burn than without intervention.

use super::{
    DemandedEquipment, Demands, Equipment, ObjectiveDetails, ObjectiveKind, ObjectiveScene,
    ObjectiveStanding, Tracker,
};
use crate::mission::format::{BetterMeasure, FileTable, KindOf, ObjectiveTarget};
use crate::mission::ground_truth::Load;
use crate::mission::hazard::Fire;
use crate::mission::skill::Skill;
use crate::mission::world::World;
use crate::mission::zone::Shape;
use crate::scoring::Product;
use crate::text;

#[derive(Debug, Clone)]
struct Protect {
    /// The hazard's index in the file.
    hazard: usize,
    zone: Shape,
}

#[derive(Debug, Clone)]
struct Contain {
    hazard: usize,
    target: ObjectiveTarget,
}

pub(super) const PROTECT: KindOf<Box<dyn ObjectiveKind>> = KindOf {
    name: "protect",
    about: "met when nothing in the zone has burnt",
    read: read_protect,
};

fn read_protect(table: &mut FileTable<'_>) -> Option<Box<dyn ObjectiveKind>> {
    let hazard = table.need_hazard("of", "a fire");
    let zone = table.need_task_zone();
    Some(Box::new(Protect {
        hazard: hazard?,
        zone: zone?.shape,
    }))
}

pub(super) const CONTAIN: KindOf<Box<dyn ObjectiveKind>> = KindOf {
    name: "contain",
    about: "met when the burnt area is at most the share `target` of what would burn without intervention",
    read: read_contain,
};

fn read_contain(table: &mut FileTable<'_>) -> Option<Box<dyn ObjectiveKind>> {
    let hazard = table.need_hazard("of", "a fire");
    let target = table.need_target([0.0, 1.0], BetterMeasure::Lower);
    Some(Box::new(Contain {
        hazard: hazard?,
        target: target?,
    }))
}

impl ObjectiveKind for Protect {
    fn skill(&self, vehicles: usize) -> Option<Skill> {
        (vehicles > 1).then_some(Skill::K10)
    }

    fn start(&self, _: &World) -> Box<dyn Tracker> {
        Box::new(self.clone())
    }
}

impl ObjectiveKind for Contain {
    fn skill(&self, vehicles: usize) -> Option<Skill> {
        (vehicles > 1).then_some(Skill::K10)
    }

    fn demands(&self) -> Demands<'_> {
        Demands {
            equipment: Some(DemandedEquipment {
                key: "kind",
                equipment: Equipment::AnyOf(&[Load::Ball, Load::Spray]),
            }),
            ..Demands::default()
        }
    }

    fn start(&self, _: &World) -> Box<dyn Tracker> {
        Box::new(self.clone())
    }
}

fn fire<'a>(scene: &'a ObjectiveScene<'_>, hazard: usize) -> Option<&'a Fire> {
    scene.world.field(hazard)?.fire()
}

/// What a fire has done to a zone.
struct ZoneDamage {
    /// The number of burnt cells, of all cells of the zone.
    lost: usize,
    all: usize,
    /// Whether the fire is out.
    is_final: bool,
}

impl Protect {
    fn damage(&self, scene: &ObjectiveScene<'_>) -> ZoneDamage {
        let fire = fire(scene, self.hazard);
        let mut damage = ZoneDamage {
            lost: 0,
            all: 0,
            is_final: fire.is_none_or(Fire::is_out),
        };
        if let Some(grid) = fire.map(Fire::grid) {
            for index in (0..grid.len()).filter(|&index| self.zone.contains(grid.centre(index))) {
                damage.all += 1;
                damage.lost += usize::from(grid.has_burnt(index));
            }
        }
        damage
    }
}

impl Contain {
    /// The burnt area, as a share of what would have burnt without water.
    fn share(&self, scene: &ObjectiveScene<'_>) -> f64 {
        let (burnt, untouched) = fire(scene, self.hazard).map_or((0, 0), |fire| {
            (fire.grid().burnt(), fire.untouched().burnt())
        });
        burnt as f64 / untouched.max(1) as f64
    }
}

impl Tracker for Protect {
    fn standing(&self, scene: &ObjectiveScene<'_>) -> ObjectiveStanding {
        let damage = self.damage(scene);
        let saved = damage.lost == 0;
        // Without a flight, nothing has been saved.
        let begun = scene.vehicles.iter().any(|craft| craft.flown);
        ObjectiveStanding {
            fraction: if saved && begun {
                1.0
            } else if begun {
                // The unburnt part of a partly burnt zone counts for half.
                0.5 * (1.0 - damage.lost as f64 / damage.all.max(1) as f64)
            } else {
                0.0
            },
            measure: damage.lost as f64,
            met: saved && begun,
            settled: damage.is_final || !saved,
            landing: false,
        }
    }

    fn is_out_of_reach(&self, scene: &ObjectiveScene<'_>) -> bool {
        self.damage(scene).lost > 0
    }

    fn details(&self, scene: &ObjectiveScene<'_>) -> ObjectiveDetails {
        let ZoneDamage {
            lost,
            all,
            is_final,
        } = self.damage(scene);
        ObjectiveDetails {
            product: None,
            result: match (lost, is_final) {
                (0, true) => text!("protect-safe"),
                (0, false) => text!("protect-still"),
                (_, _) => text!("protect-burnt", lost = lost, all = all),
            },
            outlook: None,
            target: text!("protect-target"),
            advice: text!("protect-advice"),
        }
    }
}

impl Tracker for Contain {
    fn standing(&self, scene: &ObjectiveScene<'_>) -> ObjectiveStanding {
        let share = self.share(scene);
        ObjectiveStanding {
            fraction: self.target.credit(share),
            measure: share,
            met: share <= self.target.met_at,
            settled: fire(scene, self.hazard).is_none_or(Fire::is_out),
            landing: false,
        }
    }

    fn details(&self, scene: &ObjectiveScene<'_>) -> ObjectiveDetails {
        let share = self.share(scene);
        let good = scene.releases.iter().filter(|release| release.good).count();
        let all = scene.releases.len();
        ObjectiveDetails {
            product: Some(Product {
                quality: good as f64 / all.max(1) as f64,
                words: text!("contain-hits", good = good, all = all),
                advice: text!("contain-quality"),
                is_measured: false,
            }),
            result: text!("contain-share", percent = format!("{:.0}", share * 100.0)),
            outlook: None,
            target: text!(
                "contain-target",
                percent = format!("{:.0}", self.target.met_at * 100.0)
            ),
            advice: text!("contain-advice"),
        }
    }
}
