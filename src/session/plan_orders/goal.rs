//! The list that an order sends, or why it cannot be sent.

use super::list::PlanOrderGoal;
use super::{Desk, PlanOnFile, PlanShelf, judging};
use crate::commands::{PlanCommand, PlanDeed, PlanSource};
use crate::plan::{Document, ListKind};
use crate::text;
use crate::text::Text;
use crate::vehicle::Vehicle;

/// The list that an order is to put on board a vehicle.
///
/// # Errors
/// Why the order cannot be carried out.
pub(super) fn goal(
    command: &PlanCommand,
    shelf: Option<&dyn PlanShelf>,
    desk: &Desk<'_>,
) -> Result<PlanOrderGoal, Text> {
    let vehicle = &*desk.vehicle;
    let is_ardupilot = vehicle.heartbeat.is_some_and(|it| it.is_ardupilot());
    if command.deed.writes() && !is_ardupilot {
        return Err(text!("refused-plan-autopilot"));
    }
    match &command.deed {
        PlanDeed::Download { .. } if shelf.is_none() => Err(text!("refused-plan-no-files")),
        PlanDeed::Download { .. } | PlanDeed::Show => Ok(PlanOrderGoal::default()),
        PlanDeed::Clear if command.kind == ListKind::Plan && vehicle.flies_plan() => {
            Err(text!("refused-plan-clear-auto"))
        }
        PlanDeed::Clear => Ok(PlanOrderGoal {
            items: Some(Vec::new()),
            ..PlanOrderGoal::default()
        }),
        PlanDeed::Upload { source } => {
            let content = match source {
                PlanSource::Document { document, remark } => PlanOnFile {
                    document: Document::clone(document),
                    notes: remark.iter().map(|it| (command.kind, it.clone())).collect(),
                },
                PlanSource::File(file) => {
                    let shelf = shelf.ok_or_else(|| text!("refused-plan-no-files"))?;
                    shelf.read(&named(file, vehicle))?
                }
            };
            judging::checked(content, command.kind, desk)
        }
    }
}

/// A file's name for a vehicle: `{id}` stands for the vehicle's number.
pub(super) fn named(file: &str, vehicle: &Vehicle) -> String {
    file.replace("{id}", &vehicle.id.to_string())
}
