//! Drafts of plans: lines about them, and their uploads.

use std::sync::Arc;

use super::order;
use super::show::show;
use crate::app::State;
use crate::app::effect::Effects;
use crate::app::room::{Room, plans};
use crate::commands::{Act, Command, Order, PlanDeed, PlanSource};
use crate::draft::{Draft, Refusal};
use crate::language::DraftLine;
use crate::text;
use crate::text::Text;
use crate::vehicle::VehicleId;

/// Carries out a line about drafts.
///
/// # Errors
/// The reason why the line cannot be carried out.
pub fn carry_out(state: &mut State, line: DraftLine) -> Result<Effects, Refusal> {
    match line {
        DraftLine::Upload(vehicles) => {
            let ids = plans::meant(state, vehicles)?;
            let draft = state.rooms.plans.drafts().current().cloned();
            let draft = draft.ok_or_else(|| text!("draft-none"))?;
            Ok(upload(state, &[(draft, ids)])?)
        }
        DraftLine::UploadEach => {
            let drafts = state.rooms.plans.drafts().all().iter();
            let own = drafts.filter_map(|draft| Some((draft.clone(), vec![draft.vehicle()?])));
            let own: Vec<(Draft, Vec<VehicleId>)> = own.collect();
            if own.is_empty() {
                return Err(text!("draft-none-for-vehicles").into());
            }
            Ok(upload(state, &own)?)
        }
        other => {
            if state.display.has_rooms {
                show(state, Room::Plans);
            }
            plans::carry_out(state, other)
        }
    }
}

/// Uploads drafts, each list by an order of its own.
fn upload(state: &mut State, drafts: &[(Draft, Vec<VehicleId>)]) -> Result<Effects, Text> {
    let mut orders = Vec::new();
    for (draft, vehicles) in drafts {
        if vehicles.is_empty() {
            return Err(text!("draft-no-vehicles"));
        }
        for line in plans::uploads(state, draft, vehicles)? {
            let order = order::prepare(state, &line).map_err(|fault| fault.message)?;
            orders.push(with_content(order, draft));
        }
    }
    Ok(order::give_uploads(state, orders))
}

/// An order to upload a file, with the content of a draft instead.
fn with_content(mut order: Order, draft: &Draft) -> Order {
    if let Act::Command(Command::Plan(command)) = &mut order.act {
        let source = PlanSource::document(Arc::clone(draft.document()));
        command.deed = PlanDeed::Upload { source };
    }
    order
}
