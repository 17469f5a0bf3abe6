//! Work that is divided among several vehicles: a draft for each of them.

use std::sync::Arc;

use super::{Drawing, change, files};
use crate::app::State;
use crate::commands::{Datum, Ground, PlanTask};
use crate::draft::{Draft, areas, drawn_areas, place};
use crate::geo::{LatLon, Outline};
use crate::language::DraftWork;
use crate::notice::Notice;
use crate::plan::generate::source::keep_out;
use crate::plan::{ListKind, command};
use crate::swarm::{Conductor, Rules, carrying};
use crate::text;
use crate::text::Text;
use crate::vehicle::{Severity, VehicleId};
use crate::vehicle_id::ranges;

impl Drawing {
    /// The areas drawn in the current draft, and the index of the area under the list's cursor; 0
    /// if the cursor is on none of them.
    pub fn drawn(&self) -> (Vec<Outline>, usize) {
        let Some(draft) = self.drafts.current() else {
            return (Vec::new(), 0);
        };
        let fence = &draft.document().fence;
        let row = self.row().filter(|_| self.list == ListKind::Fence);
        let keeps_in = |at: usize| {
            matches!(
                fence[at].command,
                command::FENCE_POLYGON_INCLUSION | command::FENCE_CIRCLE_INCLUSION
            )
        };
        let inside = areas(fence).into_iter().filter(|area| keeps_in(area.start));
        let at = inside
            .enumerate()
            .find(|(_, area)| row.is_some_and(|row| area.contains(&row)));
        let drawn = drawn_areas(draft.document());
        let at = at.map_or(0, |(at, _)| at);
        (drawn, at)
    }
}

/// Makes a plan for each vehicle with a part of the work, and opens these plans as drafts.
///
/// # Errors
/// The work lacks its area, line or place, a vehicle has no position, or no plans can be made for
/// the work.
pub(super) fn divide(
    state: &mut State,
    work: DraftWork,
    vehicles: &[VehicleId],
) -> Result<(), Text> {
    let task = task(state, work)?;
    let mission = state.flown_mission();
    let rules = mission.map_or_else(Rules::default, |mission| mission.swarm_rules);
    let conductor = Conductor::new(rules);
    let drawn = state.rooms.plans.drafts.current();
    let forbidden = drawn.map_or_else(Vec::new, |it| keep_out(&it.document().fence));
    let divided = conductor.plans(&task, vehicles, &state.session.vehicles, &forbidden)?;
    let left = state.rooms.plans.divided.divide(vehicles);
    let spare = divided.idle.iter().map(|(id, _)| *id);
    let idle: Vec<VehicleId> = spare.chain(left).collect();
    // Their earlier plans would lead these vehicles through the parts of others.
    state.rooms.plans.drafts.drop_of(&idle);
    let reasons = divided.idle_words();
    let drafts = divided
        .plans
        .into_iter()
        .map(|(id, document)| Draft::new(files::name_of(id), Arc::new(document), Some(id)));
    let drafts: Vec<Draft> = drafts.collect();
    let busy = ranges(drafts.iter().filter_map(Draft::vehicle));
    files::fill(state, drafts);
    say_divided(state, busy, &idle, reasons);
    Ok(())
}

/// Shows which vehicles have a part (`busy`) and why others have none. Warns if any of the others
/// (`idle`) still carry an earlier plan.
fn say_divided(state: &mut State, busy: String, idle: &[VehicleId], reasons: Vec<Text>) {
    for reason in &reasons {
        let notice = Notice::general(state.now, Severity::Info, reason.clone());
        state.notices.push(notice);
    }
    let old = carrying(idle, &state.session.vehicles);
    if old.is_empty() {
        let done = text!("draft-divided", vehicles = busy);
        let parts = std::iter::once(done).chain(reasons).collect();
        state.say(Severity::Info, Text::joined("; ", parts));
        return;
    }
    let idle = ranges(old);
    let text = text!("draft-divided-idle", vehicles = busy, idle = idle.as_str());
    state.say(Severity::Warning, text);
    let text = text!("outcome-plan-left", vehicles = idle);
    let notice = Notice::general(state.now, Severity::Warning, text);
    state.notices.push(notice);
}

fn task(state: &State, work: DraftWork) -> Result<PlanTask, Text> {
    Ok(match work {
        DraftWork::Sweep {
            area,
            spacing_m,
            up_m,
            course,
        } => {
            let area = area.or_else(|| {
                let (areas, at) = state.rooms.plans.drawn();
                areas.into_iter().nth(at)
            });
            let area = area.ok_or_else(|| text!("draft-no-area"))?;
            PlanTask::Survey {
                ground: Ground::Outline(area),
                spacing_m,
                up_m,
                course,
            }
        }
        DraftWork::Search {
            pattern,
            datum,
            radius_m,
            spacing_m,
            up_m,
        } => {
            let datum = pointed(state, datum)?;
            PlanTask::Search {
                pattern,
                datum,
                radius_m,
                spacing_m,
                up_m,
            }
        }
        DraftWork::Line {
            points,
            spacing_m,
            up_m,
        } => PlanTask::Line {
            points: line(state, points)?,
            spacing_m,
            up_m,
        },
        DraftWork::Orbit {
            centre,
            radius_m,
            turns,
            up_m,
        } => PlanTask::Orbit {
            centre: pointed(state, centre)?,
            radius_m,
            turns,
            up_m,
        },
    })
}

/// The given place, otherwise the place under the map's cursor.
///
/// # Errors
/// No place is given, and the map has no cursor.
fn pointed(state: &State, place: Option<LatLon>) -> Result<Datum, Text> {
    let place = place.or_else(|| change::cursor(state));
    place
        .map(Datum::Global)
        .ok_or_else(|| text!("draft-no-cursor"))
}

/// The given places of a line, otherwise those of the current draft's plan in order.
///
/// # Errors
/// No places are given, and the plan has fewer than two.
fn line(state: &State, places: Vec<LatLon>) -> Result<Vec<LatLon>, Text> {
    if !places.is_empty() {
        return Ok(places);
    }
    let draft = state.rooms.plans.drafts.current();
    let items = draft.into_iter().flat_map(|draft| &draft.document().plan);
    let flown = items.filter(|item| item.is_waypoint() && !item.is_takeoff());
    let points: Vec<LatLon> = flown.filter_map(place).collect();
    if points.len() < 2 {
        return Err(text!("draft-line-short"));
    }
    Ok(points)
}
