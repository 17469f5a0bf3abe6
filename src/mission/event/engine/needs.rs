//! The current threats as settings of each vehicle's simulator and link.

use std::collections::{BTreeMap, BTreeSet};

use super::{Engine, Sight};
use crate::geo::maths;
use crate::mission::Mission;
use crate::mission::craft::Craft;
use crate::mission::event::demand::Wishes;
use crate::mission::event::fault::{Broken, FaultKind};
use crate::mission::weather::Weather;
use crate::mission::zone::{Zone, ZoneKind};
use crate::session::RadioFault;
use crate::vehicle::VehicleId;

/// A vehicle under a zone's effect must move this far away from the zone before the effect ends.
const HYSTERESIS_M: f64 = 5.0;

/// The zones that affect each vehicle, by the zone's index in the file.
#[derive(Debug, Clone, Default)]
pub(super) struct Gnss(BTreeMap<VehicleId, BTreeSet<usize>>);

impl Gnss {
    /// Whether a zone affects a vehicle, with hysteresis.
    fn holds(&mut self, craft: &Craft, index: usize, zone: &Zone, leave_m: f64) -> bool {
        let held = self.0.entry(craft.id).or_default();
        let near_m = craft.truly_at().map(|at| zone.shape.distance_m(at));
        let limit_m = if held.contains(&index) { leave_m } else { 0.0 };
        let is_in = near_m.is_some_and(|near_m| near_m <= limit_m);
        if is_in {
            held.insert(index);
        } else {
            held.remove(&index);
        }
        is_in
    }
}

impl Engine {
    /// Demands the state that simulators and links should have now.
    pub(super) fn demand(&mut self, mission: &Mission, weather: &Weather, sight: &Sight<'_>) {
        for craft in sight.crafts {
            let mut wishes = Wishes::default();
            wishes.wind(self.gusts.wind(weather));
            self.navigation(mission, craft, &mut wishes);
            for broken in self.breakdowns.of(craft.id) {
                wishes.broken(broken, mission.site.origin.at);
            }
            self.demands.wish(craft.id, wishes);
            let fault = self.radio(mission, craft.id);
            self.demands.radio(craft.id, fault);
        }
    }

    /// Applies the effect of zones on a vehicle's satellite navigation.
    fn navigation(&mut self, mission: &Mission, craft: &Craft, wishes: &mut Wishes) {
        let zones = self.zones.iter().zip(&self.active).enumerate();
        for (index, (zone, _)) in zones.filter(|(_, (_, active))| **active) {
            match zone.kind {
                ZoneKind::GnssJam { edge_m } => {
                    if self.gnss.holds(craft, index, zone, HYSTERESIS_M) {
                        wishes.jam();
                    } else if let Some(at) = craft.truly_at() {
                        let distance_m = zone.shape.distance_m(at);
                        if distance_m < edge_m {
                            wishes.lose_satellites(1.0 - distance_m / edge_m);
                        }
                    }
                }
                ZoneKind::GnssGlitch { offset_m } => {
                    // The vehicle's reported position is off by the size of the deception.
                    let leave_m = HYSTERESIS_M + maths::hypot(offset_m[0], offset_m[1]);
                    if self.gnss.holds(craft, index, zone, leave_m) {
                        wishes.mislead(offset_m, mission.site.origin.at);
                    }
                }
                ZoneKind::Task
                | ZoneKind::Geofence { .. }
                | ZoneKind::NoFly { .. }
                | ZoneKind::People { .. }
                | ZoneKind::RadioJam { .. }
                | ZoneKind::CommShadow(_) => {}
            }
        }
    }

    /// The effect of distance, obstacles and faults on a vehicle's link.
    fn radio(&self, mission: &Mission, vehicle: VehicleId) -> RadioFault {
        let margin_db = self.margins_db.get(&vehicle).copied();
        let mut fault = match (&mission.site.radio, margin_db) {
            (Some(_), Some(margin_db)) => crate::mission::radio::Radio::fault(margin_db),
            _ => RadioFault::default(),
        };
        let of_link = |broken: &&Broken| broken.kind == FaultKind::Link;
        for broken in self.breakdowns.of(vehicle).filter(of_link) {
            fault.loss = 1.0 - (1.0 - fault.loss) * (1.0 - broken.to);
        }
        fault.seed = self.seed;
        fault
    }
}
