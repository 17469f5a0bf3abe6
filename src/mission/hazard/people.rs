//! People who need help: their positions, the time limits for help, and the effect of kits.

use std::time::Duration;

use super::placing::revealed;
use super::{Field, Load, LoadEffect, Object, ObjectClass, TruthPiece};
use crate::mission::Point;
use crate::mission::report::distance_m;
use crate::mission::weather::Weather;
use crate::mission::zone::Shape;
use crate::text;

const KIT_WITHIN_M: f64 = 8.0;
/// The greatest distance from its place at which a node counts as placed.
const NODE_WITHIN_M: f64 = 6.0;

/// The objects of a hazard with people: the people, the animals among them, and the places for nodes.
#[derive(Debug, Clone, Default)]
pub(super) struct People {
    /// The people first, in the order of the fates; then the other objects.
    pub objects: Vec<Object>,
    fates: Vec<Fate>,
    /// The places for nodes, and whether each has a node.
    nodes: Vec<(Point, bool)>,
    /// The zone where the people are known to be, if any.
    pub zone: Option<Shape>,
    now: Duration,
}

#[derive(Debug, Clone, Copy)]
struct Fate {
    /// The time until which help is useful; `None` without a limit.
    until: Option<Duration>,
    helped: bool,
}

/// The help given to people.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) struct Care {
    pub people: usize,
    /// People whom a kit reached in time.
    pub helped: usize,
    /// People for whom help is too late.
    pub lost: usize,
    pub nodes: usize,
    pub nodes_placed: usize,
}

impl People {
    /// A hazard with places for nodes and no people yet.
    pub fn new(nodes: Vec<Point>) -> Self {
        Self {
            nodes: nodes.into_iter().map(|at| (at, false)).collect(),
            ..Self::default()
        }
    }

    /// Adds a person; all people must be added before other objects.
    pub fn add(&mut self, person: Object, until: Option<Duration>) {
        self.objects.push(person);
        let helped = false;
        self.fates.push(Fate { until, helped });
    }

    fn take_kit(&mut self, at: Point) -> LoadEffect {
        let waiting = self
            .objects
            .iter()
            .zip(&self.fates)
            .enumerate()
            .filter(|(_, (_, fate))| !fate.helped && !fate.is_lost(self.now));
        let distances = waiting.map(|(index, (object, _))| (index, distance_m(object.at, at)));
        let nearest = distances.min_by(|a, b| a.1.total_cmp(&b.1));
        match nearest.filter(|&(_, distance)| distance <= KIT_WITHIN_M) {
            Some((index, distance)) => {
                self.fates[index].helped = true;
                LoadEffect {
                    good: true,
                    object: Some(index),
                    text: text!("people-kit-reached", distance = format!("{distance:.0}")),
                }
            }
            None => LoadEffect {
                good: false,
                object: None,
                text: text!("people-kit-lost", distance = format!("{KIT_WITHIN_M:.0}")),
            },
        }
    }

    fn place_node(&mut self, at: Point) -> LoadEffect {
        let mut open = self.nodes.iter_mut().filter(|(_, placed)| !placed);
        let near = open.find(|(place, _)| distance_m(*place, at) <= NODE_WITHIN_M);
        let good = near.map(|(_, placed)| *placed = true).is_some();
        LoadEffect {
            good,
            object: None,
            text: if good {
                text!("people-node-placed")
            } else {
                text!("people-node-lost", distance = format!("{NODE_WITHIN_M:.0}"))
            },
        }
    }
}

impl Field for People {
    /// Removes people who were not helped in time.
    fn step(&mut self, now: Duration, _: &Weather) {
        self.now = now;
        for (object, fate) in self.objects.iter_mut().zip(&self.fates) {
            object.present = object.class != ObjectClass::Person || !fate.is_lost(now);
        }
    }

    fn objects(&self) -> &[Object] {
        &self.objects
    }

    fn may_lie_at(&self, at: Point) -> bool {
        self.zone.as_ref().is_none_or(|zone| zone.contains(at))
    }

    fn affect(&mut self, load: Load, at: Point) -> Option<LoadEffect> {
        match load {
            Load::Kit if !self.fates.is_empty() => Some(self.take_kit(at)),
            Load::Node if !self.nodes.is_empty() => Some(self.place_node(at)),
            Load::Ball | Load::Spray | Load::Kit | Load::Node => None,
        }
    }

    fn care(&self) -> Option<Care> {
        let fates = self.fates.iter();
        Some(Care {
            people: self.fates.len(),
            helped: fates.clone().filter(|fate| fate.helped).count(),
            lost: fates.filter(|fate| fate.is_lost(self.now)).count(),
            nodes: self.nodes.len(),
            nodes_placed: self.nodes.iter().filter(|(_, placed)| *placed).count(),
        })
    }

    fn truth(&self) -> Vec<TruthPiece> {
        revealed(&self.objects)
    }
}

impl Fate {
    fn is_lost(self, now: Duration) -> bool {
        !self.helped && self.until.is_some_and(|until| now >= until)
    }
}
