//! The next step with a draft and its vehicles.

use crate::app::State;
use crate::app::action::{Action, PlansAction};
use crate::draft::Draft;
use crate::language::verb;
use crate::ledger::RowState;
use crate::plan::ContentHash;
use crate::plan::check::{Finding, Severity};
use crate::text;
use crate::text::Text;
use crate::vehicle::{Vehicle, VehicleId};
use crate::vehicle_id::ranges;
use crate::verb::CountsAs;

/// How far a vehicle has progressed with a draft's plan. Later stages matter more to the user.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum PlanStage {
    /// The vehicle does not carry the plan.
    Elsewhere,
    /// The vehicle has flown the plan and is on the ground, disarmed.
    Flown,
    /// The vehicle carries the plan and is disarmed.
    OnBoard,
    /// The vehicle carries the plan and is on the ground, armed.
    Armed,
    /// The vehicle carries the plan and is in the air, but is not flying a plan.
    Aloft,
    /// The vehicle has paused in the plan.
    Paused,
    /// The vehicle is flying its plan.
    Flying,
}

/// The latest stage reached by any vehicle, and the vehicles in that stage.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NextStep {
    pub stage: PlanStage,
    vehicles: Vec<VehicleId>,
    /// The number of vehicles concerned, in any stage.
    count: usize,
    /// Whether a vehicle would refuse the draft.
    is_faulty: bool,
    /// Whether the last rehearsal of the unchanged drafts failed.
    has_failed: bool,
}

/// The next step with the current draft: for its vehicle, otherwise for those that got the last upload, otherwise for
/// the addressed ones. `findings` are the faults of the draft. `None` without a plan or a vehicle.
pub fn next_step(state: &State, findings: &[Finding]) -> Option<NextStep> {
    let draft = state.rooms.plans.drafts.current()?;
    if draft.document().plan.is_empty() {
        return None;
    }
    let vehicles = concerned(state, draft);
    let staged = vehicles.iter().filter_map(|id| {
        let vehicle = state.session.vehicles.get(id)?;
        Some((stage(state, draft, vehicle), *id))
    });
    let staged: Vec<(PlanStage, VehicleId)> = staged.collect();
    let stage = staged.iter().map(|(stage, _)| *stage).max()?;
    let own = staged.iter().filter(|(own, _)| *own == stage);
    let mut severities = findings.iter().map(Finding::severity);
    Some(NextStep {
        stage,
        vehicles: own.map(|(_, id)| *id).collect(),
        count: staged.len(),
        is_faulty: severities.any(|it| it == Severity::Error),
        has_failed: state.rooms.plans.tried().is_some_and(|it| !it.is_sound),
    })
}

fn concerned(state: &State, draft: &Draft) -> Vec<VehicleId> {
    if let Some(vehicle) = draft.vehicle() {
        return vec![vehicle];
    }
    let ledger = state.session().ledger();
    let entries = state.rooms.plans.uploads.iter();
    let entries = entries.filter_map(|entry| ledger.entry(*entry));
    let mut uploaded: Vec<VehicleId> = entries
        .flat_map(|entry| entry.rows.iter().map(|row| row.vehicle))
        .collect();
    uploaded.sort_unstable();
    uploaded.dedup();
    if uploaded.is_empty() {
        state.addressed()
    } else {
        uploaded
    }
}

fn stage(state: &State, draft: &Draft, vehicle: &Vehicle) -> PlanStage {
    let carried = vehicle.plans.plan.content.as_ref();
    let mark = ContentHash::of(&draft.document().plan);
    let carries = carried.is_some_and(|plan| ContentHash::of(plan.flown()) == mark);
    // A rover that is armed and does not fly its plan stands ready for it.
    let drives_plan = vehicle.is_on_surface() && vehicle.flies_plan();
    if vehicle.armed() && vehicle.airborne() || drives_plan {
        return if vehicle.has_paused() {
            PlanStage::Paused
        } else if vehicle.flies_plan() {
            PlanStage::Flying
        } else if carries {
            PlanStage::Aloft
        } else {
            PlanStage::Elsewhere
        };
    }
    match (carries, vehicle.armed()) {
        (false, _) => PlanStage::Elsewhere,
        (true, true) => PlanStage::Armed,
        (true, false) if has_flown(state, vehicle.id) => PlanStage::Flown,
        (true, false) => PlanStage::OnBoard,
    }
}

/// Whether a vehicle has begun the plan that it carries.
fn has_flown(state: &State, vehicle: VehicleId) -> bool {
    let begins = ["plan start", "plan resume"].map(verb);
    let ledger = state.session().ledger();
    for entry in ledger.entries().rev() {
        let mut rows = entry.rows.iter();
        let is_done = rows.any(|row| row.vehicle == vehicle && matches!(row.state, RowState::Done));
        if is_done && entry.verb.counts_as == CountsAs::PlanChange {
            return false;
        }
        if is_done && begins.contains(&Some(entry.verb)) {
            return true;
        }
    }
    false
}

impl NextStep {
    /// The step as text, with the vehicles if it concerns only some of them.
    pub fn text(&self, state: &State) -> Text {
        let upload = state.key(Action::Plans(PlansAction::UploadDraft));
        let text = match self.stage {
            PlanStage::Elsewhere if self.is_faulty => text!("plans-next-mend"),
            PlanStage::Elsewhere | PlanStage::OnBoard | PlanStage::Armed if self.has_failed => {
                after_failure(state)
            }
            PlanStage::Elsewhere => text!("plans-next-upload", key = upload),
            PlanStage::OnBoard => text!("plans-next-arm"),
            PlanStage::Armed => text!("plans-next-start"),
            PlanStage::Aloft => text!("plans-next-aloft"),
            PlanStage::Flying => text!("plans-next-flying"),
            PlanStage::Paused => text!("plans-next-paused"),
            PlanStage::Flown => text!("plans-next-flown", key = upload),
        };
        if self.vehicles.len() == self.count {
            return text;
        }
        let vehicles = ranges(self.vehicles.iter().copied());
        Text::joined(": ", vec![vehicles.into(), text])
    }
}

/// The next step after a failed rehearsal: look at its figures, unless they are shown, and change
/// the drafts.
fn after_failure(state: &State) -> Text {
    let key = |action| state.key(Action::Plans(action));
    let again = key(PlansAction::TryDrafts);
    let room = &state.rooms.plans;
    if room.flight().is_none() || room.figures().is_some() {
        return text!("plans-next-change", again = again);
    }
    let figures = key(PlansAction::ShowFigures);
    text!("plans-next-figures", figures = figures, again = again)
}
