//! Whether a mission can be passed without doing anything.

use super::Examined;
use crate::mission::objective::ObjectiveScene;
use crate::mission::world::World;

/// Reports objectives that are met before the first flight.
pub(super) fn check(examined: &mut Examined<'_>) {
    let mission = examined.mission;
    let world = World::new(mission, 0);
    let untouched = ObjectiveScene::empty(&world);
    let tables = examined.tables("objectives");
    let mut all = true;
    for (objective, written) in mission.objectives.iter().zip(tables) {
        let standing = objective.kind.start(&world).standing(&untouched);
        if standing.met && standing.settled {
            let fault = "this is met before any vehicle has flown";
            examined.add(written.span.clone(), fault);
            return;
        }
        all &= standing.met || !objective.mandatory;
    }
    if let Some(first) = tables.first().filter(|_| all) {
        let fault = "idle vehicles pass the mission: no mandatory objective requires a flight";
        examined.add(first.span.clone(), fault);
    }
}
