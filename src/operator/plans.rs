//! Tasks that are divided into a plan for each vehicle.

use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::Duration;

use super::{Dispatch, Operator, OperatorScene, refused};
use crate::commands::{Command, Order, PlanCommand, PlanDeed, PlanSource, PlanTask};
use crate::ledger::EntryId;
use crate::notice::Notice;
use crate::plan::ListKind;
use crate::plan::generate::Idle;
use crate::preflight::idle_words;
use crate::session::VehicleCommand;
use crate::swarm::carrying;
use crate::text;
use crate::text::Text;
use crate::vehicle::{Severity, VehicleId};
use crate::vehicle_id::ranges;

impl Operator {
    /// Gives each target the plan of its part in a task.
    pub(super) fn put_plans(
        &mut self,
        entry: EntryId,
        order: &Order,
        task: &PlanTask,
        scene: &OperatorScene<'_>,
    ) -> Vec<Dispatch> {
        let plans = match self
            .conductor
            .plans(task, &order.targets, scene.vehicles, &[])
        {
            Ok(plans) => plans,
            Err(reason) => return refused(entry, order, &reason, scene.now),
        };
        let said = [plans.cover_words(), plans.share_words()];
        let idle = plans.idle;
        let uploads = plans.plans.into_iter().map(|(vehicle, document)| {
            let source = PlanSource::document(Arc::new(document));
            (vehicle, plan_command(PlanDeed::Upload { source }))
        });
        let mut commands: BTreeMap<VehicleId, Command> = uploads.collect();
        let flight = scene.flight.as_deref();
        let mut refusals = commands.values().filter_map(|it| flight?.refusal(it));
        if let Some(reason) = refusals.next() {
            return refused(entry, order, &reason, scene.now);
        }
        let left = self.divided.divide(&order.targets);
        let left = left_over(&carrying(&left, scene.vehicles));
        let remarks: Vec<Text> = said.into_iter().flatten().chain(left.clone()).collect();
        if let Some(first) = commands.values_mut().next().filter(|_| !remarks.is_empty()) {
            remark(first, &Text::joined("; ", remarks));
        }
        let mut work = Vec::new();
        for &vehicle in &order.targets {
            let part = commands.remove(&vehicle);
            let is_idle = part.is_none();
            // An old plan could lead the vehicle through the parts of other vehicles.
            let command = part.unwrap_or_else(|| plan_command(PlanDeed::Clear));
            let command = VehicleCommand::new(entry, order.verb, command);
            work.push(Dispatch::Command(vehicle, command));
            if is_idle {
                self.divided.forget(vehicle);
                work.push(without_part(vehicle, &idle, scene.now));
            }
        }
        let notice = left.map(|text| Notice::general(scene.now, Severity::Warning, text));
        work.extend(notice.map(Dispatch::Notice));
        work
    }
}

fn plan_command(deed: PlanDeed) -> Command {
    Command::Plan(PlanCommand {
        kind: ListKind::Plan,
        deed,
    })
}

/// A warning about vehicles that still carry the plans of an earlier task, with the command that
/// removes them.
fn left_over(vehicles: &[VehicleId]) -> Option<Text> {
    let left = ranges(vehicles.iter().copied());
    (!vehicles.is_empty()).then(|| text!("outcome-plan-left", vehicles = left))
}

fn remark(command: &mut Command, text: &Text) {
    if let Command::Plan(command) = command
        && let PlanDeed::Upload { source } = &mut command.deed
        && let PlanSource::Document { remark, .. } = source
    {
        *remark = Some(text.clone());
    }
}

/// The notice that a vehicle takes no part in the task, and why.
fn without_part(vehicle: VehicleId, idle: &[(VehicleId, Idle)], now: Duration) -> Dispatch {
    let own = idle.iter().find(|(id, _)| *id == vehicle);
    let why = own.map_or(Idle::Spare, |(_, why)| *why);
    let text = text!("outcome-plan-idle", reason = idle_words(why));
    Dispatch::Notice(Notice::about(vehicle, now, Severity::Notice, text))
}
