//! A mission as it is listed before it is flown.

use std::collections::BTreeMap;
use std::time::Duration;

use super::objective::{GateRoute, ObjectiveScene};
use super::world::World;
use super::{Area, Hint, KnownWire, Mission, Need, Outlay, Requires, Rewards};
use crate::crew::Post;
use crate::geo::LatLon;
use crate::scoring::{Component, GateSubject, Medals, MissionFile};
use crate::swarm::Rules;
use crate::text;
use crate::text::Text;
use crate::vehicle::VehicleId;
use crate::workshop::DesignKind;

/// A mission on offer: its brief, its objectives and its rules.
#[derive(Debug, Clone, PartialEq)]
pub struct Listing {
    /// The id that files and results use.
    pub id: String,
    /// Its revision; results are comparable only within one revision.
    pub rev: u32,
    /// How its text compares with that of the course; flights of a mission with a different text
    /// are practice.
    pub file: MissionFile,
    /// The title that is shown.
    pub title: Text,
    pub brief: Text,
    /// The id of the mission that it is a drill for, if it is a drill.
    pub drill_of: Option<String>,
    /// Difficulty, 0 (first steps) to 3.
    pub tier: u8,
    /// The number of vehicles.
    pub vehicles: usize,
    /// The kind of design that each seat takes.
    pub seats: Vec<DesignKind>,
    pub time_limit: Duration,
    /// The maximum mission time for full points.
    pub par_time: Duration,
    /// The maximum energy for full points, in Wh.
    pub par_energy_wh: f64,
    /// The greatest height allowed above the pads, in metres.
    pub max_height_m: f64,
    /// The battery required at landing, in percent.
    pub land_reserve_percent: f64,
    /// Mean wind in m/s.
    pub wind_m_s: f64,
    /// The direction the wind comes from, in degrees.
    pub wind_from_deg: f64,
    /// The needs that built drones must meet; seats with the same needs share an entry.
    pub needs: Vec<Need>,
    /// The vehicles' equipment; vehicles with the same equipment share an entry.
    pub fits: Vec<FitListing>,
    /// The areas that are known from the start.
    pub areas: Vec<Area>,
    /// The power lines, which are visible from the start.
    pub wires: Vec<KnownWire>,
    /// The places named from the start, and the pads.
    pub places: BTreeMap<String, LatLon>,
    pub objectives: Vec<ObjectiveListing>,
    /// Advice by phase of the flight.
    pub hints: Vec<Hint>,
    /// The components of the score with a weight above zero.
    pub weights: Vec<(Text, f64)>,
    /// Points needed for medals.
    pub medals: Medals,
    /// Whether pausing is allowed.
    pub pausable: bool,
    /// The maximum speed-up in flight.
    pub most_speedup: f64,
    /// The requirements for the mission to be offered.
    pub requires: Requires,
    /// Credits, experience and unlocks for passing the mission.
    pub rewards: Rewards,
    /// The limit on the fleet's price, and the drones that the mission lends.
    pub outlay: Outlay,
    /// Conditions for gold besides the points.
    pub gold_requires: Vec<Text>,
    /// The rules for surveys and other manoeuvres.
    pub swarm_rules: Rules,
    /// The places of a crew that flies the mission; empty if it is meant for one person.
    pub crew: Vec<Post>,
}

impl Listing {
    /// Speed and direction of the mission's wind.
    pub fn wind(&self) -> Text {
        if self.wind_m_s > 0.0 {
            text!(
                "mission-rule-wind-is",
                speed = format!("{:.1}", self.wind_m_s),
                direction = format!("{:.0}", self.wind_from_deg)
            )
        } else {
            text!("mission-rule-calm")
        }
    }
}

/// The equipment that some of the vehicles share.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FitListing {
    /// The vehicles that carry this equipment.
    pub vehicles: Vec<VehicleId>,
    pub sensors: Vec<Text>,
    /// Their loads with the count of each, or the seconds for spray.
    pub loads: Vec<(Text, u32)>,
    /// Whether they carry a flail against mines.
    pub flail: bool,
}

/// An objective of a mission on offer.
#[derive(Debug, Clone, PartialEq)]
pub struct ObjectiveListing {
    pub title: Text,
    /// The target as text.
    pub target: Text,
    /// Its share of the objectives' points.
    pub value: f64,
    /// Whether the mission fails without the objective.
    pub mandatory: bool,
}

impl Mission {
    /// The information shown before the mission is flown, listed as a mission of the course.
    pub fn listing(&self) -> Listing {
        let weight = |component: Component| {
            let weight = self.scoring.weights.of(component);
            (weight > 0.0).then(|| (component.title(), weight))
        };
        Listing {
            id: self.id.clone(),
            rev: self.rev,
            file: MissionFile::Course,
            title: self.title.clone(),
            brief: self.summary.brief.clone(),
            drill_of: self.summary.drill_of.clone(),
            tier: self.summary.tier,
            vehicles: self.seats.count,
            seats: self.seat_kinds(),
            time_limit: self.rules.time_limit,
            par_time: self.scoring.par_time,
            par_energy_wh: self.scoring.par_energy_wh,
            max_height_m: self.rules.max_height_m,
            land_reserve_percent: self.rules.land_reserve_percent,
            wind_m_s: self.site.weather.wind.speed_m_s,
            wind_from_deg: self.site.weather.wind.from_deg,
            needs: self.needs(),
            fits: self.listed_fits(),
            areas: self.areas(),
            wires: self.wires(),
            places: self.sites(),
            objectives: self.listed_objectives(),
            hints: self.advice.hints.clone(),
            weights: Component::ALL.into_iter().filter_map(weight).collect(),
            medals: self.scoring.medals,
            pausable: self.rules.pausable,
            most_speedup: self.rules.most_speedup,
            requires: self.career.requires.clone(),
            rewards: self.career.rewards.clone(),
            outlay: self.seats.outlay.clone(),
            gold_requires: self.listed_gates(),
            swarm_rules: self.swarm_rules(),
            crew: self.seats.crew.clone(),
        }
    }

    /// The mission's places, and its gates before the seed moves them.
    fn sites(&self) -> BTreeMap<String, LatLon> {
        let demands = self.objectives.iter().map(|it| it.kind.demands());
        let gates = demands.filter_map(|it| it.route).flat_map(|route| {
            let numbered = route.gates().iter().enumerate();
            numbered.map(|(index, &[east_m, north_m, _])| {
                let at = self.site.origin.place([east_m, north_m]);
                (GateRoute::name(index), at)
            })
        });
        let mut sites: BTreeMap<String, LatLon> = gates.collect();
        sites.extend(self.places());
        sites
    }

    /// The equipment of the vehicles, which are numbered by their pads, from 1.
    fn listed_fits(&self) -> Vec<FitListing> {
        let mut listed: Vec<FitListing> = Vec::new();
        for (vehicle, fit) in (1..).zip(&self.seats.fits) {
            let sensors = fit.sensors.iter();
            let loads = fit.loads.iter();
            let new = FitListing {
                vehicles: vec![vehicle],
                sensors: sensors.map(|it| Text::new(it.name, Vec::new())).collect(),
                loads: loads.map(|(load, count)| (load.name(), *count)).collect(),
                flail: fit.flail,
            };
            let alike = |it: &&mut FitListing| {
                (&it.sensors, &it.loads, it.flail) == (&new.sensors, &new.loads, new.flail)
            };
            match listed.iter_mut().find(alike) {
                Some(known) => known.vehicles.push(vehicle),
                None => listed.push(new),
            }
        }
        listed
    }

    /// The conditions of gold in words, with the titles of the objectives.
    fn listed_gates(&self) -> Vec<Text> {
        let subject = |id: &str| {
            let named = self.objectives.iter().find(|it| it.id == id);
            named.map(|objective| GateSubject {
                title: objective.title.clone(),
                unit: objective.kind.measure_unit(),
            })
        };
        let gates = self.scoring.gold_requires.iter();
        gates.map(|gate| gate.text(subject)).collect()
    }

    /// The objectives. Their targets do not depend on the flight, so they are taken from a flight
    /// that has not begun.
    fn listed_objectives(&self) -> Vec<ObjectiveListing> {
        let world = World::new(self, 0);
        let untouched = ObjectiveScene::empty(&world);
        let listed = |objective: &super::objective::Objective| ObjectiveListing {
            title: objective.title.clone(),
            target: objective.kind.start(&world).details(&untouched).target,
            value: objective.value,
            mandatory: objective.mandatory,
        };
        self.objectives.iter().map(listed).collect()
    }
}
