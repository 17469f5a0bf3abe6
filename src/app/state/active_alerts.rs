//! The active alerts: when they began, and whether they are acknowledged.

use std::collections::{BTreeMap, BTreeSet};
use std::time::Duration;

use super::alert::{Alert, alerts, mission_fence, process_ended, separation, traffic};
use super::bell::{Bell, BellCall, Due};
use super::mission_fence::FenceBreach;
use super::separation::CloseVehicle;
use super::traffic::TrafficConflict;
use crate::alert::AlertKind;
use crate::vehicle::{Severity, Vehicle, VehicleId};

/// An alert that returns within this time counts as the same one.
const FLICKER: Duration = Duration::from_secs(10);

/// An alert of one vehicle.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Standing {
    pub alert: Alert,
    /// When the alert began or last became worse, on the program's clock.
    pub since: Duration,
    /// Whether the alert is acknowledged.
    pub acknowledged: bool,
    /// When the condition ended; `None` while it lasts.
    ended: Option<Duration>,
}

/// The most urgent kind of unacknowledged alert, with all its vehicles.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Pressing<'a> {
    /// The most serious alert of this kind; the oldest if there are several.
    pub first: &'a Standing,
    /// The vehicles that have the same kind of alert, sorted.
    pub vehicles: Vec<VehicleId>,
    /// Whether all alerts have the same text.
    pub alike: bool,
    /// The number of unacknowledged alerts of other kinds.
    pub others: usize,
}

/// All alerts of a session.
#[derive(Debug, Clone, Default)]
pub struct ActiveAlerts {
    standing: BTreeMap<VehicleId, Vec<Standing>>,
    bell: Bell,
    /// Vehicles whose processes have ended.
    pub(in crate::app) down: BTreeSet<VehicleId>,
    muted: Vec<AlertKind>,
    /// The closest other vehicle, for each vehicle that is too close to others.
    close: BTreeMap<VehicleId, CloseVehicle>,
    /// How vehicles break a fence of the mission.
    breaches: BTreeMap<VehicleId, FenceBreach>,
    /// The most threatening other aircraft, for each vehicle that aircraft come too close to.
    traffic: BTreeMap<VehicleId, TrafficConflict>,
    /// Vehicles that do not belong to the session: their alerts are kept, but neither ring nor count.
    pub(in crate::app) strangers: BTreeSet<VehicleId>,
    /// The number of reboots of each vehicle with alerts, when it was last observed.
    reboots: BTreeMap<VehicleId, u32>,
    /// Alerts that have begun and need a notice.
    begun: Vec<(VehicleId, Alert)>,
}

impl ActiveAlerts {
    /// Sets the muted kinds.
    pub fn mute(&mut self, kinds: &[AlertKind]) {
        self.muted = kinds.to_vec();
    }

    /// Replaces the set of vehicles that are too close to each other.
    pub fn note_close(&mut self, close: BTreeMap<VehicleId, CloseVehicle>) {
        self.close = close;
    }

    /// The alert that another vehicle is too close to this one; `None` if none is.
    pub fn separation(&self, vehicle: VehicleId) -> Option<Alert> {
        self.close.get(&vehicle).map(separation)
    }

    /// Replaces the set of vehicles that break a fence of the mission.
    pub fn note_breaches(&mut self, breaches: BTreeMap<VehicleId, FenceBreach>) {
        self.breaches = breaches;
    }

    /// Replaces the set of aircraft that come too close to vehicles.
    pub fn note_traffic(&mut self, traffic: BTreeMap<VehicleId, TrafficConflict>) {
        self.traffic = traffic;
    }

    /// The alert that another aircraft comes too close to this vehicle.
    pub fn traffic(&self, vehicle: VehicleId) -> Option<Alert> {
        self.traffic.get(&vehicle).map(traffic)
    }

    /// Updates a vehicle's alerts: new or worse ones ring, ended ones disappear. The vehicle must
    /// land with at least `reserve_percent` of its battery. Returns whether anything changed.
    pub fn observe(&mut self, vehicle: &Vehicle, reserve_percent: f64, now: Duration) -> bool {
        let is_down = self.down.contains(&vehicle.id);
        // A lost link is a consequence of the ended process.
        let process = is_down.then(process_ended);
        let others = alerts(vehicle, reserve_percent, now)
            .filter(|one| !is_down || one.kind != AlertKind::LinkLost);
        let close = self.separation(vehicle.id);
        let breach = self.breaches.get(&vehicle.id).map(mission_fence);
        let near = close
            .into_iter()
            .chain(self.traffic(vehicle.id))
            .chain(breach);
        let mut present = process.into_iter().chain(near).chain(others).peekable();
        if present.peek().is_none() && !self.standing.contains_key(&vehicle.id) {
            return false;
        }
        let known = self.standing.remove(&vehicle.id).unwrap_or_default();
        let before = known.clone();
        let mut known = known;
        let reboots = self.reboots.insert(vehicle.id, vehicle.link.reboots);
        if reboots.is_some_and(|before| vehicle.link.reboots > before) {
            // The checks begin anew.
            known.retain(|old| old.alert.kind != AlertKind::Prearm);
        }
        let mut standing: Vec<Standing> = Vec::new();
        for alert in present {
            let at = known.iter().position(|old| old.alert.kind == alert.kind);
            let old = at.map(|at| known.swap_remove(at));
            self.ring(vehicle.id, old.as_ref(), &alert, now);
            standing.push(renewed(old, alert, began(vehicle, now)));
        }
        standing.extend(known.into_iter().filter_map(|old| fading(old, now)));
        standing.sort_by_key(|one| one.alert.kind);
        let changed = standing != before;
        if !standing.is_empty() {
            self.standing.insert(vehicle.id, standing);
        }
        changed
    }

    /// Drops a vehicle's alerts.
    pub fn forget(&mut self, vehicle: VehicleId) {
        self.standing.remove(&vehicle);
        self.reboots.remove(&vehicle);
        self.strangers.remove(&vehicle);
        self.down.remove(&vehicle);
        self.close.remove(&vehicle);
        self.traffic.remove(&vehicle);
        self.breaches.remove(&vehicle);
    }

    /// Rings for a serious text, unless its kind is muted or the vehicle already has an alert of
    /// that kind.
    pub fn hear(&mut self, now: Duration, call: BellCall) {
        let stands = |id| self.of(id).any(|one| one.alert.kind == call.kind);
        if self.is_muted(call.kind) || call.vehicle.is_some_and(stands) {
            return;
        }
        self.bell.call(now, call);
    }

    /// The alerts that have begun since the last call and need a notice.
    pub fn take_begun(&mut self) -> Vec<(VehicleId, Alert)> {
        std::mem::take(&mut self.begun)
    }

    /// Returns the signals that are due and marks them as given.
    pub fn due(&mut self, now: Duration) -> Due {
        self.bell.due(now)
    }

    /// A vehicle's alerts, one per kind.
    pub fn of(&self, vehicle: VehicleId) -> impl Iterator<Item = &Standing> {
        let all = self.standing.get(&vehicle).into_iter().flatten();
        all.filter(|one| one.ended.is_none())
    }

    /// The alert for a vehicle's row, if it has any: the worst of those that are neither
    /// acknowledged nor muted, otherwise the worst of all.
    pub fn worst(&self, vehicle: VehicleId) -> Option<&Standing> {
        self.of(vehicle)
            .min_by_key(|one| (self.is_calm(one), one.alert.severity))
    }

    /// Whether an alert needs no more attention: it is acknowledged, or its kind is muted.
    pub fn is_calm(&self, one: &Standing) -> bool {
        one.acknowledged || self.is_muted(one.alert.kind)
    }

    /// Whether a kind is muted.
    pub fn is_muted(&self, kind: AlertKind) -> bool {
        self.muted.contains(&kind)
    }

    /// The worst unacknowledged alert, and the vehicles with the same kind; `None` without one.
    /// Minor or muted alerts and failed pre-arm checks do not count.
    pub fn pressing(&self) -> Option<Pressing<'_>> {
        let open = || self.open();
        let (_, first) = open().min_by_key(|(_, one)| (one.alert.severity, one.since))?;
        let kind = first.alert.kind;
        let same = || open().filter(|(_, one)| one.alert.kind == kind);
        Some(Pressing {
            first,
            vehicles: same().map(|(id, _)| id).collect(),
            alike: same().all(|(_, one)| one.alert.text == first.alert.text),
            others: open().filter(|(_, one)| one.alert.kind != kind).count(),
        })
    }

    /// Acknowledges the alerts that `which` selects; returns their number.
    pub fn acknowledge(&mut self, which: impl Fn(VehicleId, AlertKind) -> bool) -> usize {
        let mut count = 0;
        for (&id, standing) in &mut self.standing {
            for one in standing {
                if one.ended.is_none() && !one.acknowledged && which(id, one.alert.kind) {
                    one.acknowledged = true;
                    count += 1;
                }
            }
        }
        count
    }

    /// The serious alerts of the session's vehicles that are neither acknowledged nor muted, except failed pre-arm checks.
    pub fn open(&self) -> impl Iterator<Item = (VehicleId, &Standing)> {
        let vehicles = self.standing.iter();
        let own = vehicles.filter(|(id, _)| !self.strangers.contains(id));
        let standing = own.flat_map(|(&id, all)| all.iter().map(move |one| (id, one)));
        standing.filter(|(_, one)| {
            let minor = one.alert.severity > Severity::Warning;
            let stands = one.ended.is_none();
            stands && !minor && one.alert.kind != AlertKind::Prearm && !self.is_calm(one)
        })
    }

    fn ring(&mut self, id: VehicleId, old: Option<&Standing>, alert: &Alert, now: Duration) {
        let worse = old.is_some_and(|old| alert.severity < old.alert.severity);
        let is_stranger = self.strangers.contains(&id);
        if (old.is_some() && !worse) || self.is_muted(alert.kind) || is_stranger {
            return;
        }
        let call = BellCall {
            kind: alert.kind,
            severity: alert.severity,
            vehicle: Some(id),
            text: alert.text.clone(),
            worse,
        };
        self.bell.call(now, call);
        if alert.kind.needs_notice() && !self.is_told_of_other(id, alert.kind) {
            self.begun.push((id, alert.clone()));
        }
    }

    /// Whether another vehicle's alert already reports the same condition: of two vehicles that are
    /// each other's closest, only the one with the lower number gets a notice.
    fn is_told_of_other(&self, id: VehicleId, kind: AlertKind) -> bool {
        let closest = |id| self.close.get(&id).map(|close| close.vehicle);
        let other = closest(id).filter(|_| kind == AlertKind::Separation);
        other.is_some_and(|other| other < id && closest(other) == Some(id))
    }
}

/// The alert updated to its current condition; if it has become worse, it counts as new.
fn renewed(old: Option<Standing>, alert: Alert, since: impl Fn(AlertKind) -> Duration) -> Standing {
    match old {
        Some(old) if alert.severity >= old.alert.severity => Standing {
            alert,
            ended: None,
            ..old
        },
        _ => Standing {
            since: since(alert.kind),
            alert,
            acknowledged: false,
            ended: None,
        },
    }
}

/// An ended alert, kept while its condition may still return; `None` after [`FLICKER`].
fn fading(old: Standing, now: Duration) -> Option<Standing> {
    let ended = old.ended.unwrap_or(now);
    (now.saturating_sub(ended) < FLICKER).then_some(Standing {
        ended: Some(ended),
        ..old
    })
}

/// When a condition began: a lost link counts from the last message received.
fn began(vehicle: &Vehicle, now: Duration) -> impl Fn(AlertKind) -> Duration {
    let last_heard = vehicle.link.last_heard;
    move |kind| {
        if kind == AlertKind::LinkLost {
            last_heard.unwrap_or(now)
        } else {
            now
        }
    }
}

#[cfg(test)]
mod tests;
