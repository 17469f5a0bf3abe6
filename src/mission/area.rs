//! The areas of a mission that the trainee is told of.

use std::collections::BTreeMap;

use super::Mission;
use super::zone::{Shape, ZoneKind};
use crate::geo::Outline;

/// An area with a meaning.
#[derive(Debug, Clone, PartialEq)]
pub struct Area {
    /// Its id in the mission's file, which the brief calls it by.
    pub name: String,
    /// What it means.
    pub kind: AreaKind,
    /// Where it is.
    pub outline: Outline,
}

/// What an area means.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AreaKind {
    /// There is something to do in it.
    Task,
    /// It must not be left.
    Geofence,
}

impl Mission {
    /// The areas that are known from the start; hazards are not among them: they have to be found.
    pub fn areas(&self) -> Vec<Area> {
        let area = |zone: &super::zone::Zone| Area {
            name: zone.id.clone(),
            kind: match zone.kind {
                ZoneKind::Task => AreaKind::Task,
                ZoneKind::Geofence { .. } => AreaKind::Geofence,
            },
            outline: match &zone.shape {
                Shape::Polygon(corners) => {
                    let places = corners.iter().map(|&corner| self.origin.place(corner));
                    Outline::Polygon(places.collect())
                }
                Shape::Circle { center, radius_m } => Outline::Circle {
                    centre: self.origin.place(*center),
                    radius_m: *radius_m,
                },
            },
        };
        self.zones.iter().map(area).collect()
    }

    /// The same by name, for the words of a line.
    pub fn named_areas(&self) -> BTreeMap<String, Outline> {
        let areas = self.areas().into_iter();
        areas.map(|area| (area.name, area.outline)).collect()
    }
}
