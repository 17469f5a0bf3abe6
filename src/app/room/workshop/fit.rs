//! How well the design on the bench meets a mission's needs, computed when either changes.

use super::{Pane, mission};
use crate::app::State;
use crate::app::room::Room;
use crate::mission::FitLine;
use crate::text::Text;
use crate::vehicle::VehicleId;
use crate::workshop::Design;

/// A design compared with a mission.
#[derive(Debug, Clone, PartialEq)]
pub struct Fit {
    /// The compared needs by seat; seats with the same needs share an entry.
    pub groups: Vec<(Vec<VehicleId>, Vec<Stand>)>,
    mission: String,
    design: Design,
    changed: Option<Design>,
}

#[derive(Debug, Clone, PartialEq)]
pub struct Stand {
    /// The comparison, including the part under the cursor if there is one.
    pub line: FitLine,
    /// The value without the part under the cursor, if it differs.
    pub before: Option<Text>,
}

/// Updates the comparison with the mission's needs.
pub fn weigh(state: &mut State) {
    if state.room != Room::Workshop {
        return;
    }
    let room = &state.rooms.workshop;
    let design = room.bench.design();
    let candidate = room.bench.candidate().filter(|_| room.pane == Pane::Parts);
    let tried = candidate.map(|candidate| design.with(candidate.part));
    let changed = tried.filter(|tried| tried != design);
    let mission = mission(state);
    let is_known = |fit: &Fit| {
        mission.is_some_and(|mission| mission.id == fit.mission)
            && fit.design == *design
            && fit.changed == changed
    };
    if room.fit.as_ref().is_some_and(is_known) {
        return;
    }
    let fit = mission.map(|mission| Fit {
        groups: mission
            .needs
            .iter()
            .map(|need| {
                let before = need.fit(design);
                let after = changed.as_ref().map(|changed| need.fit(changed));
                (need.seats.clone(), stands(before, after))
            })
            .collect(),
        mission: mission.id.clone(),
        design: design.clone(),
        changed: changed.clone(),
    });
    state.rooms.workshop.fit = fit;
}

fn stands(before: Vec<FitLine>, after: Option<Vec<FitLine>>) -> Vec<Stand> {
    let Some(after) = after else {
        let alone = |line| Stand { line, before: None };
        return before.into_iter().map(alone).collect();
    };
    let known = |line: FitLine| {
        let same_line = before.iter().find(|it| it.what == line.what);
        let was = same_line
            .map(|it| it.has.clone())
            .filter(|has| *has != line.has);
        Stand { line, before: was }
    };
    after.into_iter().map(known).collect()
}
