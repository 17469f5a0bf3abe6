//! The events of one flight as they occur, and their consequences.

use std::collections::BTreeMap;
use std::time::Duration;

use rand::SeedableRng as _;
use rand_chacha::ChaCha8Rng;

use super::Action;
use super::airspace::Airspace;
use super::alert::{Alerts, OpenAlert};
use super::demand::{Demand, Demands};
use super::expression::{self, Expression};
use super::fault::Breakdowns;
use super::gusts::Gusts;
use super::mover::Mover;
use super::scope::{Scope, Sight};
use super::standard::Standard;
use super::weather::{Change, Drift};
use crate::mission::craft::Breach;
use crate::mission::weather::Weather;
use crate::mission::zone::Zone;
use crate::mission::{Mission, TICK, is_due};
use crate::scoring::{AlertFact, AlertLevel};
use crate::text::Text;
use crate::vehicle::VehicleId;

mod needs;
mod schedule;

use schedule::Schedule;

/// The random stream of events; sensors and hazards use others.
const STREAM: u64 = 1 << 40;
/// The random stream of the zones' positions.
const PLACES_STREAM: u64 = STREAM - 1;

/// The result of a step.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum EngineNews {
    Said(Text),
    Alert {
        level: AlertLevel,
        text: Text,
        /// The vehicle that the alert is about, if any.
        vehicle: Option<VehicleId>,
        /// The alert's index among the [facts](Engine::alert_facts) if it must be answered.
        fact: Option<usize>,
    },
    /// The alert with this index among the facts was answered.
    Answered(usize),
    Broken(VehicleId, Breach),
    /// An inject with this name has been carried out, and its faults have hit these vehicles.
    Injected(String, Vec<VehicleId>),
    Failed(Text),
}

/// The threats of one flight.
#[derive(Debug, Clone)]
pub(crate) struct Engine {
    /// The mission's zones at the positions drawn from the seed.
    zones: Vec<Zone>,
    /// Which zones are active now, in file order.
    active: Vec<bool>,
    schedule: Schedule,
    drifts: Vec<Drift>,
    gusts: Gusts,
    movers: Vec<Mover>,
    breakdowns: Breakdowns,
    alerts: Alerts,
    airspace: Airspace,
    /// Each vehicle's link margin in dB; empty if the mission does not model the radio.
    margins_db: BTreeMap<VehicleId, f64>,
    gnss: needs::Gnss,
    demands: Demands,
    /// Standard injects that are due.
    injected: Vec<Standard>,
    seed: u64,
    random: ChaCha8Rng,
}

impl Engine {
    /// The threats of a flight; the seed determines all random values.
    pub fn new(mission: &Mission, seed: u64) -> Self {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        random.set_stream(STREAM);
        let schedule = Schedule::new(mission, &mut random);
        let mut places = ChaCha8Rng::seed_from_u64(seed);
        places.set_stream(PLACES_STREAM);
        let zones = mission.site.zones.iter();
        Self {
            zones: zones.map(|zone| zone.moved(&mut places)).collect(),
            active: mission.site.zones.iter().map(|zone| zone.active).collect(),
            schedule,
            drifts: Vec::new(),
            gusts: Gusts::new(seed),
            movers: Vec::new(),
            breakdowns: Breakdowns::default(),
            alerts: Alerts::default(),
            airspace: Airspace::default(),
            margins_db: BTreeMap::new(),
            gnss: needs::Gnss::default(),
            demands: Demands::default(),
            injected: Vec::new(),
            seed,
            random,
        }
    }

    /// Advances events and weather by one [`TICK`].
    pub fn step(
        &mut self,
        mission: &Mission,
        weather: &mut Weather,
        sight: &Sight<'_>,
    ) -> Vec<EngineNews> {
        let mut news = Vec::new();
        self.movers.retain_mut(|mover| mover.step(sight.now));
        self.breakdowns.mend(sight.now);
        let drifts = std::mem::take(&mut self.drifts).into_iter();
        self.drifts = drifts
            .filter_map(|drift| drift.step(weather, sight.now))
            .collect();
        if is_due(sight.now, expression::EVERY) {
            self.measure_links(mission, sight);
            self.ask(mission, weather, sight, &mut news);
        }
        self.act_as_due(mission, weather, sight, &mut news);
        let mut airspace = std::mem::take(&mut self.airspace);
        let breaches = airspace.step(&self.scope(weather, sight), mission.min_separation_m());
        self.airspace = airspace;
        news.extend(
            breaches
                .into_iter()
                .map(|(id, breach)| EngineNews::Broken(id, breach)),
        );
        if is_due(sight.now, expression::EVERY) || sight.now <= TICK {
            self.gusts.step(weather, expression::EVERY);
            self.demand(mission, weather, sight);
        }
        news
    }

    fn measure_links(&mut self, mission: &Mission, sight: &Sight<'_>) {
        let radio = mission.site.radio.as_ref();
        self.margins_db = radio.map_or_else(BTreeMap::new, |radio| {
            let own = |seat: usize| mission.seats.fits.get(seat)?.radio;
            radio.margins_db(self.zones_now(), sight.crafts, own)
        });
    }

    /// Carries out the events that happen now, and the standard injects.
    fn act_as_due(
        &mut self,
        mission: &Mission,
        weather: &Weather,
        sight: &Sight<'_>,
        news: &mut Vec<EngineNews>,
    ) {
        for (index, event) in mission.events.iter().enumerate() {
            let random = &mut self.random;
            let is_inject = self.schedule.is_wanted(index);
            if self.schedule.happens(index, mission, sight.now, random) {
                let mut hit = Vec::new();
                for action in &event.actions {
                    hit.extend(self.act(action, weather, sight, news));
                }
                if is_inject {
                    news.push(EngineNews::Injected(event.id.clone(), hit));
                }
            }
        }
        for standard in std::mem::take(&mut self.injected) {
            let mut hit = Vec::new();
            for action in standard.actions(mission) {
                hit.extend(self.act(&action, weather, sight, news));
            }
            news.push(EngineNews::Injected(standard.name().to_owned(), hit));
        }
    }

    /// Evaluates all conditions: those of events, and those of unanswered alerts.
    fn ask(
        &mut self,
        mission: &Mission,
        weather: &Weather,
        sight: &Sight<'_>,
        news: &mut Vec<EngineNews>,
    ) {
        let scope = self.scope(weather, sight);
        let holding = self.schedule.holding(mission, &scope, STREAM + 1);
        let answered: Vec<bool> = self
            .alerts
            .conditions()
            .map(|ok| ok.holds(&scope))
            .collect();
        self.schedule.note(&holding, sight.now);
        let answered = self.alerts.answer(&answered, sight.now);
        news.extend(answered.into_iter().map(EngineNews::Answered));
    }

    /// Carries out an action; returns the vehicles that a fault has hit by that.
    fn act(
        &mut self,
        action: &Action,
        weather: &Weather,
        sight: &Sight<'_>,
        news: &mut Vec<EngineNews>,
    ) -> Vec<VehicleId> {
        match action {
            Action::Fault(fault) => return self.breakdowns.add(fault, sight, &mut self.random),
            Action::Say(text) => news.push(EngineNews::Said(text.clone())),
            Action::Alert {
                level,
                text,
                ok,
                within,
                about,
            } => {
                let vehicle = about.and_then(|seat| Some(sight.crafts.get(seat)?.id));
                let fact = || AlertFact {
                    text: text.clone(),
                    level: *level,
                    at: sight.now,
                    limit: *within,
                    answered_after: None,
                };
                let raise = |ok: &Expression| self.alerts.raise(fact(), ok.clone(), vehicle);
                let raised = ok.as_ref().map(raise);
                news.push(EngineNews::Alert {
                    level: *level,
                    text: text.clone(),
                    vehicle,
                    fact: raised,
                });
            }
            Action::Weather(change) => self.change_weather(*change, weather, sight.now),
            Action::Zone(zone, on) => self.active[*zone] = *on,
            Action::Spawn(spawn) => {
                let mover = Mover::new(spawn, sight.now, &mut self.random);
                self.movers.push(mover);
            }
            Action::Fail(text) => news.push(EngineNews::Failed(text.clone())),
            Action::Event(other) => self.schedule.put(*other, sight.now + TICK),
        }
        Vec::new()
    }

    /// Begins a change; it continues from the value that an older one of the same element has reached.
    fn change_weather(&mut self, change: Change, weather: &Weather, now: Duration) {
        let same = |drift: &Drift| drift.element() == change.element;
        let replaced = self
            .drifts
            .iter()
            .position(same)
            .map(|index| self.drifts.remove(index));
        let drift = Drift::new(change, weather, now, replaced.as_ref());
        self.drifts.push(drift);
    }

    /// The state that conditions can read now.
    pub fn scope<'a>(&'a self, weather: &Weather, sight: &Sight<'a>) -> Scope<'a> {
        Scope {
            sight: *sight,
            zones: &self.zones,
            active: &self.active,
            movers: &self.movers,
            alerts: self.alerts.levels(),
            fired: self.schedule.fired(),
            margins_db: &self.margins_db,
            wind_m_s: weather.wind.speed_m_s,
            chance: (self.seed, STREAM),
        }
    }

    /// Triggers an event of the mission for an instructor, by its index in the file.
    pub fn inject_event(&mut self, index: usize, now: Duration) {
        self.schedule.want(index, now);
    }

    /// Triggers one of the [`Standard`] threats for an instructor.
    pub fn inject_standard(&mut self, standard: Standard) {
        self.injected.push(standard);
    }

    /// The reading of a vehicle's sensor under its faults, instead of the true value.
    pub fn shown(&self, vehicle: VehicleId, sensor: usize, shown: f64, now: Duration) -> f64 {
        self.breakdowns.shown(vehicle, sensor, shown, now)
    }

    /// Which zones are active now, in file order.
    pub fn active(&self) -> &[bool] {
        &self.active
    }

    /// The active zones at their positions.
    pub fn zones_now(&self) -> impl Iterator<Item = &Zone> {
        let zones = self.zones.iter().zip(&self.active);
        zones.filter(|(_, active)| **active).map(|(zone, _)| zone)
    }

    /// The people, aircraft and drones that are under way.
    pub fn movers(&self) -> &[Mover] {
        &self.movers
    }

    /// All alerts that had to be answered.
    pub fn alert_facts(&self) -> &[AlertFact] {
        self.alerts.facts()
    }

    /// The vehicle of each unanswered alert, if it is about one.
    pub fn alert_subjects(&self) -> impl Iterator<Item = Option<VehicleId>> {
        self.alerts.subjects()
    }

    pub fn waiting(&self, now: Duration) -> Vec<OpenAlert> {
        self.alerts.waiting(now)
    }

    /// Each vehicle's link margin in dB; empty if the mission does not model the radio.
    pub fn margins_db(&self) -> &BTreeMap<VehicleId, f64> {
        &self.margins_db
    }

    /// The changes to make to simulators and links since the last call.
    pub fn take_demands(&mut self) -> Vec<Demand> {
        self.demands.take()
    }
}
