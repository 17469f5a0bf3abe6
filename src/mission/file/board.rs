//! `[board]`: the plans and the fence that the vehicles carry at the start.

use crate::mission::board::{BoardSetup, PlanFault, Route};
use crate::mission::format::{
    FileTable, NameKind, flag, list, named, number, point, table as table_of, whole,
};
use crate::text;

/// The number of places of a plan: with fewer, a fault could not be in the middle.
const PLACES: std::ops::RangeInclusive<usize> = 4..=200;

pub(super) fn board(table: &mut FileTable<'_>) -> Option<BoardSetup> {
    let has_fence = table.or(
        "fence",
        flag(),
        false,
        "`true`: the geofences are loaded into the vehicles and switched on; a vehicle that breaks one returns",
    );
    let routes_form = list(table_of(route), 0, usize::MAX);
    let routes = table.may(
        "plans",
        routes_form,
        "the plan on board each vehicle, one table per pad: takeoff, the places, return",
    );
    let faulty = table.or(
        "faulty",
        whole(0, 250, "plans"),
        0,
        "number of plans with a fault; the seed chooses them",
    );
    let faults_form = list(
        named(
            NameKind::Fault,
            || PlanFault::ALL.map(|(name, _)| name).to_vec(),
            |name| PlanFault::ALL.into_iter().find(|(known, _)| *known == name),
        ),
        0,
        PlanFault::ALL.len(),
    );
    let faults = table.may(
        "faults",
        faults_form,
        "faults that the seed distributes, each once: `sea_level` (a height above sea level), `outside` (a place far \
         beyond the fence), `endless` (a jump without end), `stay` (a hold that drains the battery), `copied` (the \
         plan of another vehicle), `gap` (two places left out), `no_return` (no item that brings the vehicle back)",
    );
    let setup = BoardSetup {
        has_fence,
        routes: routes.unwrap_or_default(),
        faulty: faulty as usize,
        faults: faults
            .unwrap_or_default()
            .into_iter()
            .map(|(_, fault)| fault)
            .collect(),
    };
    check(table, &setup);
    Some(setup)
}

/// Checks that there are enough plans for the pads and for the faults.
fn check(table: &mut FileTable<'_>, setup: &BoardSetup) {
    let pads = table.draft().pads.len();
    if !setup.routes.is_empty() && setup.routes.len() != pads {
        let fault = text!(
            "fault-each-pad",
            name = "plans",
            count = setup.routes.len(),
            pads = pads
        );
        table.fault_of("plans", fault);
    }
    if setup.faulty > setup.faults.len().min(setup.routes.len()) {
        table.fault_of("faulty", text!("fault-faulty-plans"));
    }
    if setup.faults.contains(&PlanFault::Copied) && setup.routes.len() == 1 {
        table.fault_of("faults", text!("fault-copied"));
    }
}

fn route(table: &mut FileTable<'_>) -> Option<Route> {
    let up_m = table.need("up", number(2.0, 1000.0, "m"), "height above home");
    let places = list(point(), *PLACES.start(), *PLACES.end());
    let points = table.need("places", places, "the places to fly to, in order");
    Some(Route {
        up_m: up_m?,
        points: points?,
    })
}
