//! Commands about the lists that a vehicle carries: its plan, its fence and its rally points.

use crate::plan::ListKind;
use crate::text;
use crate::text::Text;
use crate::vehicle::{Transfer, Vehicle};

/// A command about a list of a vehicle.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PlanCommand {
    pub kind: ListKind,
    pub deed: PlanDeed,
}

/// An action on a list of the vehicle.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum PlanDeed {
    /// Replace the list by that of a file.
    Upload { file: String },
    /// Write the list on board to a new file.
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
            PlanDeed::Upload { .. } | PlanDeed::Clear => true,
            PlanDeed::Download { .. } | PlanDeed::Show => false,
        };
        is_limit && writes
    }

    /// Why it needs a confirmation for this vehicle now; `None` if it does not.
    pub fn hazard(&self, vehicle: &Vehicle) -> Option<Text> {
        let plans = &vehicle.plans;
        let transfer = match self.kind {
            ListKind::Plan => plans.plan.transfer,
            ListKind::Fence => plans.fence.transfer,
            ListKind::Rally => plans.rally.transfer,
        };
        match self.deed {
            PlanDeed::Download { .. } | PlanDeed::Show => None,
            PlanDeed::Upload { .. } | PlanDeed::Clear if flies_plan(vehicle) => {
                Some(text!("hazard-plan-auto"))
            }
            PlanDeed::Clear if vehicle.armed() => Some(text!("hazard-plan-armed")),
            PlanDeed::Upload { .. } | PlanDeed::Clear => {
                (transfer != Transfer::Done).then(|| text!("hazard-plan-unread"))
            }
        }
    }
}

/// Whether the vehicle flies its plan.
pub fn flies_plan(vehicle: &Vehicle) -> bool {
    vehicle.armed() && vehicle.mode().is_some_and(|mode| mode.is("AUTO"))
}
