//! Commands about the lists that a vehicle carries: its plan, its fence and its rally points.

use std::sync::Arc;

use super::{Setup, command_name};
use crate::plan::{Document, Item, ListKind, command};
use crate::text;
use crate::text::Text;
use crate::vehicle::Vehicle;

/// A command about a list of a vehicle.
#[derive(Debug, Clone, PartialEq)]
pub struct PlanCommand {
    pub kind: ListKind,
    pub deed: PlanDeed,
}

/// The source of a list.
#[derive(Debug, Clone, PartialEq)]
pub enum PlanSource {
    /// A file with this name.
    File(String),
    /// A draft, or a plan that the console has made.
    Document {
        document: Arc<Document>,
        /// A remark for the ledger row of the upload, in addition to the outcome.
        remark: Option<Text>,
    },
}

impl PlanSource {
    /// A document without a remark.
    pub fn document(document: Arc<Document>) -> Self {
        Self::Document {
            document,
            remark: None,
        }
    }
}

/// An operation on a list.
#[derive(Debug, Clone, PartialEq)]
pub enum PlanDeed {
    /// Replace the list on board with that of a source.
    Upload { source: PlanSource },
    /// Write the list on board to a new file.
    Download { file: String },
    /// Remove all items of the list on board.
    Clear,
    /// Read the list on board again.
    Show,
}

impl PlanDeed {
    /// Whether the operation changes the list on board.
    pub const fn writes(&self) -> bool {
        match self {
            Self::Upload { .. } | Self::Clear => true,
            Self::Download { .. } | Self::Show => false,
        }
    }
}

impl PlanCommand {
    /// The change that the command makes to the vehicle's setup, as far as it is known without
    /// reading a file.
    pub fn setup(&self) -> Option<Setup<'_>> {
        if self.changes_limits() {
            return Some(Setup::Limits);
        }
        match &self.deed {
            PlanDeed::Upload {
                source: PlanSource::Document { document, .. },
            } => protected_item(document).map(Setup::PlanItem),
            PlanDeed::Upload {
                source: PlanSource::File(_),
            }
            | PlanDeed::Clear
            | PlanDeed::Download { .. }
            | PlanDeed::Show => None,
        }
    }

    /// Whether the command changes the fence or the rally points.
    fn changes_limits(&self) -> bool {
        let is_limit = match self.kind {
            ListKind::Fence | ListKind::Rally => true,
            ListKind::Plan => false,
        };
        is_limit && self.deed.writes()
    }

    /// Whether the command changes the plan on board.
    pub fn changes_plan(&self) -> bool {
        self.kind == ListKind::Plan && self.deed.writes()
    }

    /// Why the command needs a confirmation for this vehicle now; `None` if it needs none.
    pub fn hazard(&self, vehicle: &Vehicle) -> Option<Text> {
        match self.deed {
            PlanDeed::Download { .. } | PlanDeed::Show => None,
            // The command is refused at once, so it needs no confirmation.
            PlanDeed::Clear if self.kind == ListKind::Plan && vehicle.flies_plan() => None,
            PlanDeed::Clear => vehicle.armed().then(|| text!("hazard-plan-armed")),
            PlanDeed::Upload { .. } => Self::replacing_hazard(vehicle),
        }
    }

    /// Why replacing the plan needs a confirmation for this vehicle now; `None` if it needs none.
    pub fn replacing_hazard(vehicle: &Vehicle) -> Option<Text> {
        vehicle.flies_plan().then(|| text!("hazard-plan-auto"))
    }
}

/// An item of a plan that changes home or the fence when it is flown.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ProtectedItem {
    /// The item's number in the plan, from 1.
    pub number: usize,
    /// The number of the item's `MAV_CMD`.
    pub command: u16,
}

impl ProtectedItem {
    /// The reason to refuse the item in a flight that counts.
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vehicle::{Heartbeat, Mode, SystemStatus, VehicleClass};
    use std::time::Duration;

    fn in_mode(number: u8) -> Vehicle {
        let mut vehicle = Vehicle::new(1, 1);
        vehicle.heartbeat = Some(Heartbeat {
            mav_type: 2,
            autopilot: 3,
            class: VehicleClass::Copter,
            mode: Mode::copter(number),
            armed: true,
            status: SystemStatus::Active,
            at: Duration::ZERO,
        });
        vehicle
    }

    /// A command that is refused anyway needs no confirmation; an upload needs one if the list on
    /// board is unknown.
    #[test]
    fn only_what_is_sent_needs_a_confirmation() {
        let command = |deed| PlanCommand {
            kind: ListKind::Plan,
            deed,
        };
        let file = PlanSource::File("a".to_owned());
        let upload = command(PlanDeed::Upload { source: file });
        let clear = command(PlanDeed::Clear);
        let (auto, guided) = (in_mode(3), in_mode(4));
        assert!(auto.flies_plan() && !guided.flies_plan());
        assert_eq!(clear.hazard(&auto), None, "it is refused");
        assert!(clear.hazard(&guided).is_some());
        assert!(upload.hazard(&auto).is_some());
        assert_eq!(upload.hazard(&guided), None);
        assert_eq!(
            upload.hazard(&Vehicle::new(1, 1)),
            None,
            "nothing is read yet"
        );
    }

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
