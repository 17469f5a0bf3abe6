//! The areas and power lines of a mission that the trainee knows.

use std::collections::BTreeMap;

use super::Mission;
use super::zone::{Shape, Zone, ZoneKind};
use crate::geo::{LatLon, Outline, maths};
use crate::plan::is_inside;

/// An area of a mission, with its meaning.
#[derive(Debug, Clone, PartialEq)]
pub struct Area {
    /// Its id in the mission file, as the brief names it.
    pub name: String,
    /// Its meaning for vehicles inside.
    pub kind: AreaKind,
    pub outline: Outline,
    /// The height above home that vehicles must not exceed in a fence, in metres, if it has one.
    pub ceiling_m: Option<f64>,
}

impl Area {
    /// Whether a place lies inside.
    pub fn contains(&self, place: LatLon) -> bool {
        let metres = |corner: LatLon| {
            let (north_m, east_m) = place.offset_to(corner);
            [north_m, east_m]
        };
        match &self.outline {
            Outline::Polygon(corners) => {
                let corners: Vec<[f64; 2]> = corners.iter().map(|it| metres(*it)).collect();
                is_inside([0.0, 0.0], &corners)
            }
            Outline::Circle { centre, radius_m } => {
                let [north_m, east_m] = metres(*centre);
                maths::hypot(north_m, east_m) <= *radius_m
            }
        }
    }

    /// Whether a place lies inside, or about a metre outside: the places on board a vehicle are rounded.
    pub fn contains_nearly(&self, place: LatLon) -> bool {
        const NEAR_M: [f64; 3] = [0.0, -1.0, 1.0];
        let mut steps = NEAR_M
            .into_iter()
            .flat_map(|north_m| NEAR_M.map(|east_m| (north_m, east_m)));
        steps.any(|(north_m, east_m)| self.contains(place.moved(north_m, east_m)))
    }
}

/// The meaning of an area.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AreaKind {
    /// The task takes place in the area.
    Task,
    /// Vehicles must stay inside.
    Geofence,
    /// Vehicles must stay outside.
    NoFly,
    /// Satellite navigation fails or misleads in the area.
    Jamming,
    /// People are on the ground in the area.
    People,
    /// Radio is weak in the area, or behind it.
    Radio,
}

/// A power line as the trainee knows it, without its defects.
#[derive(Debug, Clone, PartialEq)]
pub struct KnownWire {
    /// The pylons in order; the wire hangs between neighbours.
    pub pylons: Vec<LatLon>,
}

impl From<ZoneKind> for AreaKind {
    fn from(kind: ZoneKind) -> Self {
        match kind {
            ZoneKind::Task => Self::Task,
            ZoneKind::Geofence { .. } => Self::Geofence,
            ZoneKind::NoFly { .. } => Self::NoFly,
            ZoneKind::GnssJam { .. } | ZoneKind::GnssGlitch { .. } => Self::Jamming,
            ZoneKind::People { .. } => Self::People,
            ZoneKind::RadioJam { .. } | ZoneKind::CommShadow(_) => Self::Radio,
        }
    }
}

impl Mission {
    /// The areas known from the start. They do not include hazards, which the trainee has to find.
    pub fn areas(&self) -> Vec<Area> {
        let known = self.site.zones.iter().filter(|zone| zone.active);
        known.map(|zone| self.area(zone)).collect()
    }

    /// The power lines, which are visible from the start.
    pub fn wires(&self) -> Vec<KnownWire> {
        let lines = self.site.hazards.iter().map(|hazard| hazard.pylons());
        let wires = lines.filter(|pylons| !pylons.is_empty()).map(|pylons| {
            let places = pylons.iter().map(|&at| self.site.origin.place(at));
            KnownWire {
                pylons: places.collect(),
            }
        });
        wires.collect()
    }

    /// A zone as the trainee knows it.
    pub(super) fn area(&self, zone: &Zone) -> Area {
        Area {
            name: zone.id.clone(),
            kind: zone.kind.into(),
            ceiling_m: zone.kind.fence_ceiling_m(),
            outline: match &zone.shape {
                Shape::Polygon(corners) => {
                    let places = corners.iter().map(|&corner| self.site.origin.place(corner));
                    Outline::Polygon(places.collect())
                }
                Shape::Circle { center, radius_m } => Outline::Circle {
                    centre: self.site.origin.place(*center),
                    radius_m: *radius_m,
                },
            },
        }
    }

    /// The outlines of the areas known from the start, by name, for typed commands.
    pub fn named_areas(&self) -> BTreeMap<String, Outline> {
        let areas = self.areas().into_iter();
        areas.map(|area| (area.name, area.outline)).collect()
    }
}
