//! Rehearsals that wait until the plans of their vehicles are known.

use std::collections::BTreeMap;
use std::mem;
use std::time::Duration;

use super::report::row;
use super::{PlanRehearsal, RehearsalRequest, prepare};
use crate::ledger::{EntryId, RowState, RowUpdate};
use crate::text;
use crate::vehicle::{Transfer, Vehicle, VehicleId, Vehicles};
use crate::vehicle_id::ranges;

/// How long a rehearsal waits for plans that are being read.
const LONGEST_WAIT: Duration = Duration::from_secs(60);
/// The maximum delay from the end of an upload to a snapshot of the vehicle that shows the new plan.
const SHOWN_WITHIN: Duration = Duration::from_millis(500);

/// Rehearsals in the order in which they were given, and the uploads that they wait for.
#[derive(Debug, Clone, Default)]
pub(in crate::operator) struct RehearsalQueue {
    waiting: Vec<WaitingRehearsal>,
    /// The commands that change plans, and when the end of each was noticed.
    writes: BTreeMap<(VehicleId, EntryId), WriteState>,
}

#[derive(Debug, Clone)]
struct WaitingRehearsal {
    request: RehearsalRequest,
    since: Duration,
}

/// The state of a command that changes the plan of a vehicle.
#[derive(Debug, Clone, Copy, PartialEq)]
enum WriteState {
    Open,
    Ended,
    /// It has ended, and from this time the vehicle's snapshot shows the plan.
    ShownFrom(Duration),
}

/// The changes of rows when a rehearsal begins or waits, and the rehearsal to fly now.
#[derive(Debug, Default)]
pub(in crate::operator) struct Prepared {
    pub(in crate::operator) rows: Vec<RowUpdate>,
    pub(in crate::operator) rehearsal: Option<PlanRehearsal>,
}

impl RehearsalQueue {
    /// Notes a command that changes the plan on board.
    pub(in crate::operator) fn note_write(&mut self, vehicle: VehicleId, entry: EntryId) {
        self.writes.insert((vehicle, entry), WriteState::Open);
    }

    /// Notes the end of a command.
    pub(in crate::operator) fn note_end(&mut self, vehicle: VehicleId, entry: EntryId) {
        if let Some(state) = self.writes.get_mut(&(vehicle, entry)) {
            *state = WriteState::Ended;
        }
    }

    /// Begins a rehearsal at once, or lets it wait for plans that are being sent or read.
    pub(in crate::operator) fn take(
        &mut self,
        request: RehearsalRequest,
        vehicles: &Vehicles,
        now: Duration,
    ) -> Prepared {
        let unknown = self.unknown(&request, vehicles);
        if unknown.is_empty() {
            return prepare(&request, vehicles, now);
        }
        let reason = text!("rehearse-waits", vehicles = ranges(unknown));
        let targets = request.order.targets.iter();
        let rows = targets
            .map(|&id| {
                let reason = Some(reason.clone());
                row(request.entry, id, RowState::Queued, reason, now)
            })
            .collect();
        self.waiting.push(WaitingRehearsal {
            request,
            since: now,
        });
        Prepared {
            rows,
            rehearsal: None,
        }
    }

    /// The rehearsals whose plans are known now, or that have waited long enough.
    pub(in crate::operator) fn step(
        &mut self,
        vehicles: &Vehicles,
        now: Duration,
    ) -> Vec<Prepared> {
        self.writes.retain(|_, state| match state {
            WriteState::Open => true,
            WriteState::Ended => {
                *state = WriteState::ShownFrom(now + SHOWN_WITHIN);
                true
            }
            WriteState::ShownFrom(at) => now < *at,
        });
        let waiting = mem::take(&mut self.waiting);
        let (late, still): (Vec<_>, Vec<_>) = waiting.into_iter().partition(|it| {
            let unknown = self.unknown(&it.request, vehicles);
            let is_sent = |id: &VehicleId| self.is_sent_before(*id, it.request.entry);
            let is_over = now.saturating_sub(it.since) >= LONGEST_WAIT;
            unknown.is_empty() || (is_over && !unknown.iter().any(is_sent))
        });
        self.waiting = still;
        late.iter()
            .map(|it| prepare(&it.request, vehicles, now))
            .collect()
    }

    /// The vehicles whose plans are still being sent or read.
    fn unknown(&self, request: &RehearsalRequest, vehicles: &Vehicles) -> Vec<VehicleId> {
        let targets = request.order.targets.iter().copied();
        let is_unknown = |id: &VehicleId| {
            let is_read = vehicles.get(id).is_none_or(|it| !is_being_read(it));
            self.is_sent_before(*id, request.entry) || !is_read
        };
        targets.filter(is_unknown).collect()
    }

    /// Whether a plan is still being sent to a vehicle by a command that was given before this one.
    fn is_sent_before(&self, vehicle: VehicleId, entry: EntryId) -> bool {
        let earlier = (vehicle, EntryId(0))..(vehicle, entry);
        self.writes.range(earlier).next().is_some()
    }
}

/// Whether the plan of a vehicle on the ground will be known soon.
fn is_being_read(vehicle: &Vehicle) -> bool {
    let is_coming = match vehicle.plans.plan.transfer {
        Transfer::Unasked | Transfer::Coming { .. } => true,
        Transfer::Done | Transfer::Unsupported | Transfer::Failed => false,
    };
    is_coming && !vehicle.airborne() && vehicle.global.is_some()
}
