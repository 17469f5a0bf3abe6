//! `gates`: fly through points in order. `visit`: stay at named places, in any order, for long enough.

use std::collections::BTreeSet;

use super::{
    DemandedPlaces, DemandedTime, Demands, ObjectiveDetails, ObjectiveKind, ObjectiveScene,
    ObjectiveStanding, Tracker, partial_credit,
};
use crate::geo::maths;
use crate::mission::craft::Craft;
use crate::mission::format::{FileTable, KindOf, NamedPlace, heights, list, number, text};
use crate::mission::objective::route::GateRoute;
use crate::mission::skill::Skill;
use crate::mission::world::World;
use crate::mission::{Point, TICK};
use crate::text;

const MOST_PLACES: usize = 100;
const ANY_HEIGHT: [f64; 2] = [f64::NEG_INFINITY, f64::INFINITY];

#[derive(Debug, Clone)]
struct Visit {
    places: Vec<NamedPlace>,
    radius_m: f64,
    /// The heights that count; `None` for any.
    heights_m: Option<[f64; 2]>,
    dwell_s: f64,
}

#[derive(Debug, Clone)]
struct Gates {
    id: String,
    route: GateRoute,
}

#[derive(Debug, Clone)]
struct Stop {
    name: String,
    at: Point,
    /// The heights that count for a place; for gates, the distance is in three dimensions.
    heights_m: [f64; 2],
    up_m: Option<f64>,
    radius_m: f64,
}

impl Stop {
    fn is_reached_by(&self, craft: &Craft) -> bool {
        let Some([east_m, north_m]) = craft.at.filter(|_| craft.under_way && !craft.lost) else {
            return false;
        };
        let level_m = maths::hypot(east_m - self.at[0], north_m - self.at[1]);
        let [low, high] = self.heights_m;
        let away_m = self
            .up_m
            .map_or(level_m, |up_m| maths::hypot(level_m, craft.height_m - up_m));
        away_m <= self.radius_m && (low..=high).contains(&craft.height_m)
    }
}

pub(super) const GATES: KindOf<Box<dyn ObjectiveKind>> = KindOf {
    name: "gates",
    about: "met when a vehicle has flown through all gates in order; only one objective of a mission may have gates",
    read: read_gates,
};

fn read_gates(table: &mut FileTable<'_>) -> Option<Box<dyn ObjectiveKind>> {
    let route = GateRoute::need(table);
    Some(Box::new(Gates {
        id: table.own_id(),
        route: route?,
    }))
}

pub(super) const VISIT: KindOf<Box<dyn ObjectiveKind>> = KindOf {
    name: "visit",
    about: "met when a vehicle has been at each of the places, in any order",
    read: read_visit,
};

fn read_visit(table: &mut FileTable<'_>) -> Option<Box<dyn ObjectiveKind>> {
    let places_form = list(text("id of a place"), 1, MOST_PLACES);
    let places = table.need("places", places_form, "places, each only once");
    let radius_m = table.need_radius();
    let dwell_s = table.or(
        "dwell",
        number(0.0, 600.0, "s"),
        0.0,
        "time to stay at each place",
    );
    let heights_m = table.may("heights", heights(), "heights that count (default any)");
    let (places, radius_m) = (places?, radius_m?);
    let mut named = BTreeSet::new();
    let mut found = Vec::new();
    for name in &places {
        if !named.insert(name.get_ref()) {
            table
                .draft()
                .faults
                .add(name.span(), text!("fault-place-twice"));
        }
        found.extend(table.draft().named_place(name));
    }
    Some(Box::new(Visit {
        places: found,
        radius_m,
        heights_m,
        dwell_s,
    }))
}

impl ObjectiveKind for Gates {
    fn skill(&self, _: usize) -> Option<Skill> {
        Some(Skill::K3)
    }

    fn demands(&self) -> Demands<'_> {
        Demands {
            route: Some(&self.route),
            ..Demands::default()
        }
    }

    fn start(&self, world: &World) -> Box<dyn Tracker> {
        let gates = self.route.drawn(world, &self.id);
        let stop = |(index, [east, north, up]): (usize, [f64; 3])| Stop {
            name: GateRoute::name(index),
            at: [east, north],
            heights_m: ANY_HEIGHT,
            up_m: Some(up),
            radius_m: self.route.radius_m,
        };
        let stops = gates.into_iter().enumerate().map(stop).collect();
        Box::new(Stops::new(stops, true, 0.0))
    }

    fn place_names(&self) -> Vec<String> {
        self.route.names()
    }
}

impl ObjectiveKind for Visit {
    fn skill(&self, _: usize) -> Option<Skill> {
        Some(Skill::K3)
    }

    fn demands(&self) -> Demands<'_> {
        let dwell = DemandedTime::seconds("dwell", self.dwell_s);
        let places = u32::try_from(self.places.len()).unwrap_or(u32::MAX);
        Demands {
            places: Some(DemandedPlaces {
                key: "places",
                all: &self.places,
            }),
            heights_m: self.heights_m,
            times: vec![dwell],
            staying: dwell.time.saturating_mul(places),
            ..Demands::default()
        }
    }

    fn start(&self, _: &World) -> Box<dyn Tracker> {
        let stop = |place: &NamedPlace| Stop {
            name: place.name.clone(),
            at: place.at,
            heights_m: self.heights_m.unwrap_or(ANY_HEIGHT),
            up_m: None,
            radius_m: self.radius_m,
        };
        let stops = self.places.iter().map(stop).collect();
        Box::new(Stops::new(stops, false, self.dwell_s))
    }
}

#[derive(Debug, Clone)]
struct Stops {
    places: Vec<Stop>,
    /// How long a vehicle has stayed at each stop, in seconds.
    stayed_s: Vec<f64>,
    passed: Vec<bool>,
    ordered: bool,
    dwell_s: f64,
}

impl Stops {
    fn new(stops: Vec<Stop>, ordered: bool, dwell_s: f64) -> Self {
        Self {
            stayed_s: vec![0.0; stops.len()],
            passed: vec![false; stops.len()],
            places: stops,
            ordered,
            dwell_s,
        }
    }

    fn next(&self) -> Option<usize> {
        self.passed.iter().position(|passed| !passed)
    }

    fn passed(&self) -> usize {
        self.passed.iter().filter(|passed| **passed).count()
    }
}

impl Tracker for Stops {
    fn step(&mut self, scene: &ObjectiveScene<'_>) {
        let next = self.next();
        for (index, stop) in self.places.iter().enumerate() {
            if self.passed[index] || (self.ordered && next != Some(index)) {
                continue;
            }
            if scene.vehicles.iter().any(|craft| stop.is_reached_by(craft)) {
                self.stayed_s[index] += TICK.as_secs_f64();
                self.passed[index] = self.stayed_s[index] >= self.dwell_s - 1e-9;
            } else {
                self.stayed_s[index] = 0.0;
            }
        }
    }

    fn standing(&self, _: &ObjectiveScene<'_>) -> ObjectiveStanding {
        let (passed, count) = (self.passed(), self.places.len());
        ObjectiveStanding {
            fraction: partial_credit(passed as f64, 0.0, count as f64),
            measure: passed as f64,
            met: passed == count,
            settled: passed == count,
            landing: false,
        }
    }

    fn details(&self, _: &ObjectiveScene<'_>) -> ObjectiveDetails {
        let (passed, count) = (self.passed(), self.places.len());
        let next = self.next().map(|next| &self.places[next]);
        let name = next.map_or("", |stop| stop.name.as_str());
        let radius = format!("{:.0}", next.map_or(0.0, |stop| stop.radius_m));
        if self.ordered {
            return ObjectiveDetails {
                product: None,
                result: text!("mission-gates-of", passed = passed, count = count),
                outlook: None,
                target: text!("mission-gates", count = count),
                advice: text!("mission-gates-advice", gate = name, radius = radius),
            };
        }
        ObjectiveDetails {
            product: None,
            result: text!("mission-visit-of", passed = passed, count = count),
            outlook: None,
            target: text!("mission-visit", count = count),
            advice: text!(
                "mission-visit-advice",
                place = name,
                radius = radius,
                dwell = format!("{:.0}", self.dwell_s)
            ),
        }
    }

    fn places(&self) -> Vec<(String, Point)> {
        let gates = self.places.iter().filter(|stop| stop.up_m.is_some());
        let next = self
            .next()
            .map(|next| &self.places[next])
            .filter(|_| self.ordered);
        gates
            .map(|stop| (stop.name.clone(), stop.at))
            .chain(next.map(|stop| (super::NEXT_PLACE.to_owned(), stop.at)))
            .collect()
    }
}
