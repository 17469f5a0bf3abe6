//! Whether somebody has to do something.

use super::Examined;
use crate::mission::objective::ObjectiveScene;
use crate::mission::world::World;

/// Objectives that are met before anybody has flown.
pub(super) fn check(examined: &mut Examined<'_>) {
    let mission = examined.mission;
    let world = World::new(mission, 0);
    let nobody = ObjectiveScene::empty(&world);
    let entries = examined.entries("objectives");
    let mut all = true;
    for (objective, entry) in mission.objectives.iter().zip(&entries) {
        let standing = objective.kind.start(&world).standing(&nobody);
        if standing.met && standing.settled {
            let fault = "this is met before anybody has flown";
            examined.add(entry.span(), fault);
            return;
        }
        all &= standing.met || !objective.mandatory;
    }
    if let Some(first) = entries.first().filter(|_| all) {
        let fault =
            "the mission is passed by doing nothing: no mandatory objective has to be worked for";
        examined.add(first.span(), fault);
    }
}
