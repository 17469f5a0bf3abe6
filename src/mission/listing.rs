//! What can be told of a mission before it is flown.

use std::collections::BTreeMap;
use std::time::Duration;

use super::objective::Scene;
use super::world::World;
use super::{Hint, Mission};
use crate::scoring::{Component, Medals};
use crate::text::Text;

/// A mission on offer: its brief, its objectives and its rules.
#[derive(Debug, Clone, PartialEq)]
pub struct Listing {
    /// Its name for files and results.
    pub id: String,
    /// Its name for people.
    pub title: Text,
    /// What the trainee is told.
    pub brief: Text,
    /// The id of the mission that it is a short exercise for.
    pub drill_of: Option<String>,
    /// Difficulty, 0 (first steps) to 3.
    pub tier: u8,
    /// How many vehicles fly it.
    pub vehicles: usize,
    /// Mission time allowed.
    pub time_limit: Duration,
    /// Mission time that gets all points.
    pub par_time: Duration,
    /// Energy that gets all points, in Wh.
    pub par_energy_wh: f64,
    /// Highest height above the pads, in metres.
    pub max_height_m: f64,
    /// Battery to land with, in percent.
    pub land_reserve_percent: f64,
    /// Mean wind in m/s.
    pub wind_m_s: f64,
    /// Where the wind comes from, in degrees.
    pub wind_from_deg: f64,
    /// The sensors that every vehicle carries.
    pub sensors: Vec<Text>,
    /// What has to be reached.
    pub objectives: Vec<ObjectiveListing>,
    /// Advice by phase of the flight.
    pub hints: Vec<Hint>,
    /// The components of the score that have a weight, with it.
    pub weights: Vec<(Text, f64)>,
    /// Points needed for medals.
    pub medals: Medals,
    /// Whether it may be paused.
    pub pausable: bool,
    /// What gold needs besides points.
    pub gold_requires: Vec<Text>,
}

/// An objective of a mission on offer.
#[derive(Debug, Clone, PartialEq)]
pub struct ObjectiveListing {
    /// Its title.
    pub title: Text,
    /// What is asked for, in words.
    pub target: Text,
    /// Its share of the objectives' points.
    pub value: f64,
    /// Whether the mission fails without it.
    pub mandatory: bool,
}

impl Mission {
    /// What can be told of it before it is flown.
    pub fn listing(&self) -> Listing {
        let sensor = |sensor: &&super::sensor::Sensor| Text::new(sensor.name, Vec::new());
        let weight = |component: Component| {
            let weight = self.scoring.weights.of(component);
            (weight > 0.0).then(|| (component.title(), weight))
        };
        Listing {
            id: self.id.clone(),
            title: self.title.clone(),
            brief: self.brief.clone(),
            drill_of: self.drill_of.clone(),
            tier: self.tier,
            vehicles: self.vehicles,
            time_limit: self.time_limit,
            par_time: self.scoring.par_time,
            par_energy_wh: self.scoring.par_energy_wh,
            max_height_m: self.max_height_m,
            land_reserve_percent: self.land_reserve_percent,
            wind_m_s: self.weather.wind.speed_m_s,
            wind_from_deg: self.weather.wind.from_deg,
            sensors: self.sensors.iter().map(sensor).collect(),
            objectives: self.listed_objectives(),
            hints: self.hints.clone(),
            weights: Component::ALL.into_iter().filter_map(weight).collect(),
            medals: self.scoring.medals,
            pausable: true,
            gold_requires: self
                .scoring
                .gold_requires
                .iter()
                .map(crate::scoring::Gate::text)
                .collect(),
        }
    }

    /// What is asked for does not depend on how it goes: it is read off a flight that has not begun.
    fn listed_objectives(&self) -> Vec<ObjectiveListing> {
        let world = World::new(self, 0);
        let nobody = Scene {
            now: Duration::ZERO,
            over: false,
            vehicles: &[],
            surveys: &[],
            world: &world,
            marks: &[],
            margins_db: &BTreeMap::new(),
            releases: &[],
        };
        let listed = |objective: &super::objective::Objective| ObjectiveListing {
            title: objective.title.clone(),
            target: objective.kind.start(&world).standing(&nobody).target,
            value: objective.value,
            mandatory: objective.mandatory,
        };
        self.objectives.iter().map(listed).collect()
    }
}
