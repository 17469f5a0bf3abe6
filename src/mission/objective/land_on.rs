//! `land_on`: vehicles land at a place and are disarmed there.

use std::slice;

use super::{
    DOWN_FOR, DemandedPlaces, Demands, ObjectiveDetails, ObjectiveKind, ObjectiveScene,
    ObjectiveStanding, Tracker,
};
use crate::geo::maths;
use crate::mission::Point;
use crate::mission::craft::Craft;
use crate::mission::format::{FileTable, KindOf, NamedPlace, text, whole};
use crate::mission::skill::Skill;
use crate::mission::world::World;
use crate::text;

#[derive(Debug, Clone)]
struct LandOn {
    place: NamedPlace,
    radius_m: f64,
    count: usize,
}

pub(super) const KIND: KindOf<Box<dyn ObjectiveKind>> = KindOf {
    name: "land_on",
    about: "met when enough vehicles have landed at the place and are disarmed",
    read,
};

fn read(table: &mut FileTable<'_>) -> Option<Box<dyn ObjectiveKind>> {
    let place = table.need("place", text("id of a place"), "place to land at");
    let radius_m = table.need_radius();
    let count = table.or("count", whole(1, 250, ""), 1, "number of vehicles required");
    let fleet = table.draft().pads.len();
    if fleet > 0 && count as usize > fleet {
        let fault = text!("fault-count-fleet", fleet = fleet);
        table.fault_of("count", fault);
    }
    Some(Box::new(LandOn {
        place: table.draft().named_place(&place?)?,
        radius_m: radius_m?,
        count: count as usize,
    }))
}

impl ObjectiveKind for LandOn {
    fn skill(&self, _: usize) -> Option<Skill> {
        Some(Skill::K3)
    }

    fn demands(&self) -> Demands<'_> {
        Demands {
            places: Some(DemandedPlaces {
                key: "place",
                all: slice::from_ref(&self.place),
            }),
            ..Demands::default()
        }
    }

    fn start(&self, _: &World) -> Box<dyn Tracker> {
        Box::new(self.clone())
    }
}

impl LandOn {
    fn down(&self, vehicles: &[Craft]) -> usize {
        vehicles.iter().filter(|craft| self.is_there(craft)).count()
    }

    fn is_there(&self, craft: &Craft) -> bool {
        let [east_m, north_m] = self.place.at;
        let away_m = |at: Point| maths::hypot(at[0] - east_m, at[1] - north_m);
        craft.is_down() && craft.at.is_some_and(|at| away_m(at) <= self.radius_m)
    }
}

impl Tracker for LandOn {
    fn standing(&self, scene: &ObjectiveScene<'_>) -> ObjectiveStanding {
        let (vehicles, down) = (scene.vehicles, self.down(scene.vehicles));
        let stopped = |craft: &Craft| craft.lost || craft.down_for >= DOWN_FOR;
        let met = down >= self.count;
        ObjectiveStanding {
            fraction: (down as f64 / self.count.max(1) as f64).min(1.0),
            measure: down as f64,
            met,
            settled: met || (!vehicles.is_empty() && vehicles.iter().all(stopped)),
            landing: true,
        }
    }

    fn details(&self, scene: &ObjectiveScene<'_>) -> ObjectiveDetails {
        let down = self.down(scene.vehicles);
        let radius = format!("{:.0}", self.radius_m);
        ObjectiveDetails {
            product: None,
            result: text!("mission-landed-of", down = down, count = self.count),
            outlook: None,
            target: text!("mission-land-within", radius = radius.as_str()),
            advice: text!(
                "mission-land-advice",
                place = &self.place.name,
                radius = radius
            ),
        }
    }
}
