//! Writes the plan of each vehicle from its work.

use glam::DVec2;

use super::tour::length_m;
use super::{Circle, GenerateError, Manner, Part, Scene, Work};
use crate::effort::{Effort, Pace};
use crate::legs::circles_m;
use crate::{Document, Home, Item, command, frame};

/// The default of `CIRCLE_RATE`, in degrees per second.
const CIRCLE_RATE_DEG_S: f64 = 20.0;

/// The paths from home to the work and back, over the ground.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Trip {
    pub(super) out: Vec<DVec2>,
    pub(super) back: Vec<DVec2>,
}

impl Trip {
    /// The paths from home to a vehicle's work and back; `None` if the fence leaves no path.
    pub(super) fn of(scene: &Scene, work: &Work) -> Option<Self> {
        let home = scene.homes[work.vehicle];
        let (first, last) = (*work.points.first()?, *work.points.last()?);
        let way = |from: DVec2, to: DVec2| {
            let bends = scene.field.way(from, to)?;
            let ends = [from].into_iter().chain(bends).chain([to]);
            Some(ends.collect())
        };
        Some(Self {
            out: way(home, first)?,
            back: way(last, home)?,
        })
    }
}

/// The time and energy of a vehicle's flight; `None` if the fence leaves no path.
pub(super) fn effort(scene: &Scene, work: &Work) -> Option<Effort> {
    let trip = Trip::of(scene, work)?;
    let pace = &scene.pace;
    let layer_m = work.layer_m;
    let change_m = layer_m - work.height_m;
    let parts = [
        pace.rise(layer_m),
        pace.path(&trip.out),
        pace.rise(-change_m),
        pace.path(&work.points),
        work.circle
            .map_or(Effort::default(), |circle| turns(circle, pace)),
        pace.rise(change_m),
        pace.path(&trip.back),
        pace.landing(layer_m),
    ];
    Some(parts.into_iter().sum())
}

/// The effort of circles at the vehicle's own rate, or as fast as half the acceleration allows
/// (`AC_Circle`).
fn turns(circle: Circle, pace: &Pace) -> Effort {
    let way_m = std::f64::consts::TAU * circle.radius_m * f64::from(circle.turns);
    let fastest = (0.5 * pace.accel_m_s2 * circle.radius_m).sqrt();
    let by_rate = CIRCLE_RATE_DEG_S.to_radians() * circle.radius_m;
    let speed_m_s = by_rate.min(fastest).min(pace.speed_m_s).max(0.1);
    Effort::level(way_m / speed_m_s, speed_m_s)
}

/// Writes the plan of each vehicle that has work, and adds the effort of its flight.
pub(super) fn compose(
    scene: &Scene,
    team: &[Home],
    manner: &Manner,
    works: &[Work],
) -> Result<Vec<Part>, GenerateError> {
    let part = |work: &Work| {
        let fault = GenerateError::NoWay(work.vehicle);
        let trip = Trip::of(scene, work).ok_or(fault)?;
        let effort = effort(scene, work).ok_or(fault)?;
        let home = team[work.vehicle];
        let writer = Writer {
            scene,
            lift_m: f64::from(team[0].z) - f64::from(home.z),
            items: Vec::new(),
        };
        let rim_m = work.circle.map_or(0.0, |circle| {
            circles_m(f64::from(circle.turns), circle.radius_m)
        });
        Ok(Part {
            vehicle: work.vehicle,
            document: Document {
                home: Some(home),
                plan: writer.plan(work, &trip, manner.speed_m_s),
                fence: manner.fence.clone(),
                ..Document::default()
            },
            length_m: length_m(&trip.out) + length_m(&work.points) + rim_m + length_m(&trip.back),
            effort,
            layer_m: work.layer_m,
        })
    };
    let parts: Result<Vec<Part>, GenerateError> = works.iter().map(part).collect();
    let mut parts = parts?;
    parts.sort_by_key(|part| part.vehicle);
    Ok(parts)
}

struct Writer<'a> {
    scene: &'a Scene,
    /// How far the first vehicle's home is above this one's, in metres.
    lift_m: f64,
    items: Vec<Item>,
}

impl Writer<'_> {
    fn plan(mut self, work: &Work, trip: &Trip, speed_m_s: Option<f64>) -> Vec<Item> {
        let layer_m = work.layer_m;
        let home = self.scene.homes[work.vehicle];
        self.add(command::TAKEOFF, home, layer_m);
        if let Some(speed_m_s) = speed_m_s {
            self.items.push(Item {
                command: command::DO_CHANGE_SPEED,
                frame: frame::ABOVE_HOME,
                auto_continue: true,
                // Type 1: the speed over ground; the throttle stays as it is.
                params: [1.0, speed_m_s as f32, -1.0, 0.0],
                ..Item::default()
            });
        }
        for point in trip.out.iter().skip(1) {
            self.add(command::WAYPOINT, *point, layer_m);
        }
        let crosses_higher = layer_m > work.height_m;
        for point in work.points.iter().skip(usize::from(!crosses_higher)) {
            self.add(command::WAYPOINT, *point, work.height_m);
        }
        if let Some(circle) = work.circle {
            self.add(command::LOITER_TURNS, circle.centre, work.height_m);
            if let Some(item) = self.items.last_mut() {
                item.params = [f32::from(circle.turns), 0.0, circle.radius_m as f32, 0.0];
            }
        }
        for point in trip.back.iter().skip(usize::from(!crosses_higher)) {
            self.add(command::WAYPOINT, *point, layer_m);
        }
        self.add(command::LAND, home, 0.0);
        if let Some(land) = self.items.last_mut() {
            land.z = 0.0;
        }
        self.items
    }

    fn add(&mut self, command: u16, at: DVec2, height_m: f64) {
        let (x, y) = self.scene.origin.moved(at.x, at.y).to_e7();
        self.items.push(Item {
            command,
            frame: frame::ABOVE_HOME,
            auto_continue: true,
            params: [0.0; 4],
            x,
            y,
            z: (height_m + self.lift_m) as f32,
        });
    }
}
