//! What lies on the ground: areas and ways, as plain outlines for the map.

use crate::app::state::State;
use crate::geo::{LatLon, Outline};
use crate::mission::AreaKind;

/// A line on the map.
#[derive(Debug, Clone, PartialEq)]
pub struct Sketch {
    /// What it means.
    pub kind: SketchKind,
    /// What it is called; may be empty.
    pub label: String,
    /// Its points.
    pub points: Vec<LatLon>,
    /// Whether the last point is joined to the first.
    pub closed: bool,
}

/// What a line means.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SketchKind {
    /// An area with something to do in it.
    Task,
    /// A border that must not be crossed from inside.
    Fence,
}

impl Sketch {
    /// The edge of an area.
    pub fn area(kind: SketchKind, label: &str, outline: &Outline) -> Self {
        Self {
            kind,
            label: label.to_owned(),
            points: outline.corners(),
            closed: true,
        }
    }
}

/// Everything that lies on the ground, the most important last.
pub fn sketches(state: &State) -> Vec<Sketch> {
    let areas = state.session.areas.iter();
    areas
        .map(|area| {
            let kind = match area.kind {
                AreaKind::Task => SketchKind::Task,
                AreaKind::Geofence => SketchKind::Fence,
            };
            Sketch::area(kind, &area.name, &area.outline)
        })
        .collect()
}
