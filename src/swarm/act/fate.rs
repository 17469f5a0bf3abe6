//! Members that drop out, and the continuation without them.

use std::sync::Arc;
use std::time::Duration;

use super::places::{share_lanes, take_places};
use super::{ActiveManoeuvre, Phase, StepOutcome, Work, WorldView};
use crate::ledger::{RowEnding, RowState, RowUpdate};
use crate::notice::Notice;
use crate::swarm::lanes::Lane;
use crate::text;
use crate::text::Text;
use crate::vehicle::{Severity, Vehicle, VehicleId};
use crate::verb::CrewDuty;

/// The silence after which a member is dropped.
const LOST_FOR: Duration = Duration::from_secs(10);

impl ActiveManoeuvre {
    /// Drops members that no longer take part.
    pub(super) fn drop_unfit(&mut self, view: &WorldView<'_>, outcome: &mut StepOutcome) {
        let ids: Vec<VehicleId> = self.members.iter().map(|member| member.id).collect();
        for id in ids.into_iter().rev() {
            // When one member drops out, the others may get new places, or all give up.
            let Some(member) = self.members.iter_mut().find(|member| member.id == id) else {
                continue;
            };
            let vehicle = view.vehicles.get(&id);
            let lost_since = &mut member.standing.lost_since;
            if vehicle.is_some_and(|vehicle| !vehicle.link.lost) {
                *lost_since = None;
            }
            let silent = match vehicle {
                Some(vehicle) if !vehicle.link.lost => Duration::ZERO,
                _ => view.now.saturating_sub(*lost_since.get_or_insert(view.now)),
            };
            if let Some(ending) = unfit(vehicle.map(Arc::as_ref), silent) {
                let verb = self.verb.name;
                let text = text!("swarm-falls-out", verb = verb, reason = &ending.text);
                outcome
                    .notices
                    .push(Notice::about(id, view.now, Severity::Warning, text));
                self.lose(&[id], ending.state, &ending.text, view, outcome);
            }
        }
    }

    /// Removes members; the others take over the remaining work, or close up. Members of a formation that the leader's
    /// pilot does not fly leave it too: closing up would move them.
    pub fn lose(
        &mut self,
        ids: &[VehicleId],
        state: RowState,
        reason: &Text,
        view: &WorldView<'_>,
        outcome: &mut StepOutcome,
    ) {
        self.end_rows(ids, state, reason, view, outcome);
        let leader = self.leader();
        let lanes = self.lanes_left();
        self.members.retain(|member| !ids.contains(&member.id));
        self.part(leader, view, outcome);
        self.close_up(leader, &lanes, view, outcome);
    }

    /// Before an order to its leader moves a formation, removes the members that the leader's pilot does not fly; the
    /// others close up.
    pub fn leave_behind(&mut self, view: &WorldView<'_>, outcome: &mut StepOutcome) {
        let leader = self.leader();
        if self.part(leader, view, outcome) {
            self.close_up(leader, &[], view, outcome);
        }
    }

    /// Removes the members of a formation that another person flies than its leader, and returns whether there are any.
    /// They stay where they are: nothing that moves the formation may move them.
    fn part(
        &mut self,
        leader: Option<VehicleId>,
        view: &WorldView<'_>,
        outcome: &mut StepOutcome,
    ) -> bool {
        let Some(leader) = leader else {
            return false;
        };
        let pilot = view.pilots.of(leader);
        let strange = self.members.iter().filter_map(|member| {
            let reason = view.pilots.refusal(member.id, pilot, CrewDuty::Flying)?;
            Some((member.id, reason))
        });
        let strange: Vec<(VehicleId, Text)> = strange.collect();
        for (id, reason) in &strange {
            outcome.steering.retain(|(other, _)| other != id);
            outcome.steering.extend(self.stops(&[*id], view.vehicles));
            self.end_rows(&[*id], RowState::Overtaken, reason, view, outcome);
            let text = text!("swarm-falls-out", verb = self.verb.name, reason = reason);
            let notice = Notice::about(*id, view.now, Severity::Warning, text);
            outcome.notices.push(notice);
        }
        let stays = |id: VehicleId| strange.iter().all(|(other, _)| *other != id);
        self.members.retain(|member| stays(member.id));
        !strange.is_empty()
    }

    /// Plans the work anew for the members that remain, or gives up.
    fn close_up(
        &mut self,
        leader: Option<VehicleId>,
        lanes: &[Lane],
        view: &WorldView<'_>,
        outcome: &mut StepOutcome,
    ) {
        if !self.members.is_empty() && !self.rearrange(leader, lanes, view, outcome) {
            self.give_up(view, outcome);
        }
    }

    /// Ends the rows of members that leave.
    fn end_rows(
        &mut self,
        ids: &[VehicleId],
        state: RowState,
        reason: &Text,
        view: &WorldView<'_>,
        outcome: &mut StepOutcome,
    ) {
        for member in self.members.iter().filter(|it| ids.contains(&it.id)) {
            outcome.rows.push(RowUpdate {
                entry: self.entry,
                vehicle: member.id,
                state,
                tries: 1,
                at: view.now,
                explanation: Some(reason.clone()),
            });
        }
        if let Some(moving) = &mut self.moving {
            for &vehicle in moving.who.iter().filter(|id| ids.contains(id)) {
                outcome.rows.push(RowUpdate {
                    entry: moving.entry,
                    vehicle,
                    state,
                    tries: 1,
                    at: view.now,
                    explanation: Some(reason.clone()),
                });
            }
            moving.who.retain(|id| !ids.contains(id));
        }
    }

    /// Plans the work anew for the remaining members; returns `false` if there is no safe path.
    fn rearrange(
        &mut self,
        leader: Option<VehicleId>,
        lanes: &[Lane],
        view: &WorldView<'_>,
        outcome: &mut StepOutcome,
    ) -> bool {
        match &mut self.work {
            Work::Courses { lanes: true } if !lanes.is_empty() => share_lanes(self, lanes, view),
            Work::Courses { .. } => true,
            Work::Formation(march) => {
                if leader != self.members.first().map(|member| member.id) {
                    // The next member leads, from its position.
                    let first = self
                        .members
                        .first()
                        .and_then(|it| view.vehicles.get(&it.id));
                    let at = first.and_then(|first| self.site.point(first));
                    march.anchor = at.unwrap_or(march.anchor);
                    march.goal = None;
                    // Without its leader, the destination is unknown.
                    self.end_move(RowState::Superseded, None, view.now, &mut outcome.rows);
                }
                take_places(self, view)
            }
            Work::Follow(tail) => {
                tail.places.clear();
                true
            }
            Work::Chain(chain) => {
                let count = self.members.len() as f64 + 1.0;
                chain.shares = (1..=self.members.len())
                    .map(|at| at as f64 / count)
                    .collect();
                true
            }
        }
    }

    /// Gives up because there is no safe path: all members stay where they are.
    fn give_up(&mut self, view: &WorldView<'_>, outcome: &mut StepOutcome) {
        let reason = text!("swarm-no-way");
        let ids: Vec<VehicleId> = self.members.iter().map(|member| member.id).collect();
        outcome.steering.extend(self.stops(&ids, view.vehicles));
        for &vehicle in &ids {
            outcome.rows.push(RowUpdate {
                entry: self.entry,
                vehicle,
                state: RowState::NoEffect,
                tries: 1,
                at: view.now,
                explanation: Some(reason.clone()),
            });
        }
        self.end_move(
            RowState::NoEffect,
            Some(&reason),
            view.now,
            &mut outcome.rows,
        );
        self.members.clear();
        self.phase = Phase::Work;
    }
}

/// Why a vehicle no longer takes part; `None` if it still does.
fn unfit(vehicle: Option<&Vehicle>, silent: Duration) -> Option<RowEnding> {
    let Some(vehicle) = vehicle.filter(|vehicle| !vehicle.link.lost) else {
        return (silent >= LOST_FOR)
            .then(|| RowEnding::new(RowState::NoEffect, text!("swarm-lost")));
    };
    let mode = vehicle.mode()?;
    if !mode.is("GUIDED") {
        let reason = text!("outcome-overtaken", mode = vehicle.name_of(mode));
        return Some(RowEnding::new(RowState::Overtaken, reason));
    }
    let flies = vehicle.armed() && vehicle.airborne();
    (!flies).then(|| RowEnding::new(RowState::NoEffect, text!("swarm-does-not-fly")))
}
