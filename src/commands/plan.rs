//! Commands about the lists that a vehicle carries: its plan, its fence and its rally points.

use std::sync::Arc;

use crate::plan::{Document, ListKind};
use crate::text;
use crate::text::Text;
use crate::vehicle::{Transfer, Vehicle};

/// A command about a list of a vehicle.
#[derive(Debug, Clone, PartialEq)]
pub struct PlanCommand {
    pub kind: ListKind,
    pub deed: PlanDeed,
}

/// Where a list comes from.
#[derive(Debug, Clone, PartialEq)]
pub enum PlanSource {
    /// A file with this name.
    File(String),
    /// What is being drawn in the console.
    Draft(Arc<Document>),
}

/// What is done with a list.
#[derive(Debug, Clone, PartialEq)]
pub enum PlanDeed {
    /// Replace it by that of a source.
    Upload { source: PlanSource },
    /// Write it into a new file.
    Download { file: String },
    /// Remove all items of the list on board.
    Clear,
    /// Read the list on board again.
    Show,
}

impl PlanCommand {
    /// Whether it changes the fence or the rally points.
    pub fn changes_limits(&self) -> bool {
        let is_limit = match self.kind {
            ListKind::Fence | ListKind::Rally => true,
            ListKind::Plan => false,
        };
        let writes = match self.deed {
            PlanDeed::Upload { .. } | PlanDeed::Put(_) | PlanDeed::Clear => true,
            PlanDeed::Download { .. } | PlanDeed::Show => false,
        };
        is_limit && writes
    }

    /// Why it needs a confirmation for this vehicle now; `None` if it does not.
    pub fn hazard(&self, vehicle: &Vehicle) -> Option<Text> {
        match self.deed {
            PlanDeed::Download { .. } | PlanDeed::Show => None,
            PlanDeed::Clear if vehicle.armed() && !flies_plan(vehicle) => {
                Some(text!("hazard-plan-armed"))
            }
            PlanDeed::Upload { .. } | PlanDeed::Put(_) | PlanDeed::Clear => {
                replacing_hazard(self.kind, vehicle)
            }
        }
    }

    /// Why a new plan needs a confirmation for this vehicle now; `None` if it does not.
    pub fn replacing_hazard(vehicle: &Vehicle) -> Option<Text> {
        replacing_hazard(ListKind::Plan, vehicle)
    }
}

fn replacing_hazard(kind: ListKind, vehicle: &Vehicle) -> Option<Text> {
    let plans = &vehicle.plans;
    let transfer = match kind {
        ListKind::Plan => plans.plan.transfer,
        ListKind::Fence => plans.fence.transfer,
        ListKind::Rally => plans.rally.transfer,
    };
    if flies_plan(vehicle) {
        return Some(text!("hazard-plan-auto"));
    }
    (transfer != Transfer::Done).then(|| text!("hazard-plan-unread"))
}

/// Whether the vehicle flies its plan.
pub fn flies_plan(vehicle: &Vehicle) -> bool {
    vehicle.armed() && vehicle.mode().is_some_and(|mode| mode.is("AUTO"))
}
