//! How the design on the bench stands to what the mission needs, computed when either changes.

use super::{Pane, mission};
use crate::app::State;
use crate::app::room::Room;
use crate::mission::FitLine;
use crate::text::Text;
use crate::vehicle::VehicleId;
use crate::workshop::Design;

/// A design beside a mission.
#[derive(Debug, Clone, PartialEq)]
pub struct Fit {
    /// What some seats need, and what they get; seats that need the same are together.
    pub groups: Vec<(Vec<VehicleId>, Vec<Stand>)>,
    mission: String,
    design: Design,
    changed: Option<Design>,
}

/// One thing that is needed.
#[derive(Debug, Clone, PartialEq)]
pub struct Stand {
    /// How the design stands to it: with the part that is being looked at, where one is.
    pub line: FitLine,
    /// What it has without that part, where this is something else.
    pub before: Option<Text>,
}

/// Keeps what is shown of the mission's needs up to date.
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
