//! Commands about the lists that a vehicle carries: its plan, its fence and its rally points.

use std::sync::Arc;

use super::{Setup, command_name};
use crate::plan::{Document, Item, ListKind, command};
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
    /// This document: a draft, or a plan that the console has made.
    Document(Arc<Document>),
}

/// What to do with a list.
#[derive(Debug, Clone, PartialEq)]
pub enum PlanDeed {
    /// Replace it with the one of a source.
    Upload { source: PlanSource },
    /// Write it into a new file.
    Download { file: String },
    /// Remove all items of the list on board.
    Clear,
    /// Read the list on board again.
    Show,
}

impl PlanCommand {
    /// The change that it makes to the vehicle's setup, as far as it is known without reading a file.
    pub fn setup(&self) -> Option<Setup<'_>> {
        if self.changes_limits() {
            return Some(Setup::Limits);
        }
        match &self.deed {
            PlanDeed::Upload {
                source: PlanSource::Document(document),
            } => protected_item(document).map(Setup::PlanItem),
            PlanDeed::Upload {
                source: PlanSource::File(_),
            }
            | PlanDeed::Clear
            | PlanDeed::Download { .. }
            | PlanDeed::Show => None,
        }
    }

    /// Whether it changes the fence or the rally points.
    fn changes_limits(&self) -> bool {
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
        match self.deed {
            PlanDeed::Download { .. } | PlanDeed::Show => None,
            PlanDeed::Clear if vehicle.armed() && !vehicle.flies_plan() => {
                Some(text!("hazard-plan-armed"))
            }
            PlanDeed::Upload { .. } | PlanDeed::Clear => replacing_hazard(self.kind, vehicle),
        }
    }

    /// Why a new plan needs a confirmation for this vehicle now; `None` if it does not.
    pub fn replacing_hazard(vehicle: &Vehicle) -> Option<Text> {
        replacing_hazard(ListKind::Plan, vehicle)
    }
}

/// An item of a plan that changes home or the fence when it is flown.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ProtectedItem {
    /// The item's number in the plan, from 1.
    pub number: usize,
    /// The number of its `MAV_CMD`.
    pub command: u16,
}

impl ProtectedItem {
    /// The reason to refuse it in a flight that counts.
    pub fn refusal(self) -> Text {
        text!(
            "refused-protected-item",
            item = self.number,
            command = command_name(self.command).unwrap_or_default()
        )
    }
}

/// The function of a remote control's switch for the fence. Source: ArduPilot's `RC_Channel::AUX_FUNC::FENCE`.
const FENCE_SWITCH: f32 = 11.0;

/// The first item of a plan that changes home or the fence when it is flown.
pub fn protected_item(document: &Document) -> Option<ProtectedItem> {
    let items = document.plan.iter().enumerate();
    let protected = |(at, item): (usize, &Item)| {
        let is_protected = match item.command {
            command::DO_SET_HOME | command::DO_FENCE_ENABLE => true,
            // Functions are whole numbers.
            command::DO_AUX_FUNCTION => (item.params[0] - FENCE_SWITCH).abs() < 0.5,
            _ => false,
        };
        is_protected.then_some(ProtectedItem {
            number: at + 1,
            command: item.command,
        })
    };
    items.into_iter().find_map(protected)
}

fn replacing_hazard(kind: ListKind, vehicle: &Vehicle) -> Option<Text> {
    let plans = &vehicle.plans;
    let transfer = match kind {
        ListKind::Plan => plans.plan.transfer,
        ListKind::Fence => plans.fence.transfer,
        ListKind::Rally => plans.rally.transfer,
    };
    if vehicle.flies_plan() {
        return Some(text!("hazard-plan-auto"));
    }
    (transfer != Transfer::Done).then(|| text!("hazard-plan-unread"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn items_that_change_home_or_the_fence_are_found() {
        let item = |command, first| Item {
            command,
            params: [first, 0.0, 0.0, 0.0],
            ..Item::default()
        };
        let first = |second| {
            protected_item(&Document {
                plan: vec![item(command::WAYPOINT, 0.0), second],
                ..Document::default()
            })
        };
        for (second, name) in [
            (item(command::DO_SET_HOME, 1.0), "DO_SET_HOME"),
            (item(command::DO_FENCE_ENABLE, 0.0), "DO_FENCE_ENABLE"),
            (item(command::DO_AUX_FUNCTION, 11.0), "DO_AUX_FUNCTION"),
        ] {
            let reason = first(second).map(ProtectedItem::refusal);
            let words = reason.expect(name).to_string();
            assert!(words.contains("item 2") && words.contains(name), "{words}");
        }
        for (command, first_parameter) in [(16, 0.0), (178, 1.0), (218, 9.0), (20, 0.0)] {
            assert_eq!(first(item(command, first_parameter)), None, "{command}");
        }
    }
}
