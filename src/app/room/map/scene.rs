//! Areas and ways on the ground, as plain outlines for the map.

use std::sync::Arc;

use crate::app::State;
use crate::geo::{LatLon, Outline};
use crate::mission::AreaKind;
use crate::swarm::Path;
use crate::vehicle::{FencePlan, FenceShape, Vehicle};

/// A line on the map, or a single point.
#[derive(Debug, Clone, PartialEq)]
pub struct Sketch {
    pub kind: SketchKind,
    /// What it is called; may be empty.
    pub label: String,
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
    /// A border that must not be crossed from outside.
    KeepOut,
    /// An area that must not be flown in.
    NoFly,
    /// An area where satellite navigation fails.
    Jamming,
    /// An area with people below.
    People,
    /// An area where radio is weak.
    Radio,
    /// What a vehicle flies in AUTO.
    Plan,
    /// A place where RTL may end.
    Rally,
    /// What a vehicle is going to fly as its part of what several do together.
    Course,
}

impl SketchKind {
    /// What the border of a mission's area means.
    pub fn of_area(kind: AreaKind) -> Self {
        match kind {
            AreaKind::Task => Self::Task,
            AreaKind::Geofence => Self::Fence,
            AreaKind::NoFly => Self::NoFly,
            AreaKind::Jamming => Self::Jamming,
            AreaKind::People => Self::People,
            AreaKind::Radio => Self::Radio,
        }
    }
}

impl Sketch {
    fn area(kind: SketchKind, label: &str, outline: &Outline) -> Self {
        Self {
            kind,
            label: label.to_owned(),
            points: outline.corners(),
            closed: true,
        }
    }

    fn point(kind: SketchKind, label: String, place: LatLon) -> Self {
        Self {
            kind,
            label,
            points: vec![place],
            closed: false,
        }
    }
}

/// Everything that lies on the ground, the most important last: the mission's areas, then what the vehicles that
/// commands go to have on board. A fence that several of them share is there once.
pub fn sketches(state: &State) -> Vec<Sketch> {
    let known = state.session.areas.iter();
    let areas = known.map(|area| {
        let kind = SketchKind::of_area(area.kind);
        Sketch::area(kind, &area.name, &area.outline)
    });
    let mut sketches: Vec<Sketch> = areas.collect();
    sketches.extend(
        state
            .session
            .paths
            .iter()
            .filter_map(|path| course(state, path)),
    );
    for sketch in shown(state).flat_map(on_board) {
        let is_border = matches!(sketch.kind, SketchKind::Fence | SketchKind::KeepOut);
        if !is_border || !sketches.contains(&sketch) {
            sketches.push(sketch);
        }
    }
    sketches
}

/// The way of a vehicle, or the place that it is to keep while it is not there.
fn course(state: &State, path: &Path) -> Option<Sketch> {
    let vehicle = state.session.vehicles.get(&path.vehicle);
    let here = vehicle.and_then(|vehicle| vehicle.global);
    match path.points.as_slice() {
        [] => None,
        [place] => {
            let is_away = here.is_none_or(|it| it.at_point.distance_m(*place) > IN_PLACE_M);
            let label = format!("p{}", path.vehicle);
            is_away.then(|| Sketch::point(SketchKind::Course, label, *place))
        }
        points => Some(Sketch {
            kind: SketchKind::Course,
            label: String::new(),
            points: points.to_vec(),
            closed: false,
        }),
    }
}

/// The places of plans and rally points that are on the map, and of what is flown together.
pub fn planned(state: &State) -> impl Iterator<Item = LatLon> {
    let flown = [SketchKind::Plan, SketchKind::Rally];
    let all_sketches = shown(state).flat_map(on_board);
    let sketches = all_sketches.filter(move |sketch| flown.contains(&sketch.kind));
    let drawn = state.session.paths.iter();
    let paths = drawn.flat_map(|path| path.points.iter().copied());
    sketches.flat_map(|sketch| sketch.points).chain(paths)
}

/// Nearer to its place than this a vehicle covers it.
const IN_PLACE_M: f64 = 3.0;
/// Plans are shown of so many vehicles at most.
const MOST_SHOWN: usize = 16;

/// The vehicle under the cursor and the selected ones.
fn shown(state: &State) -> impl Iterator<Item = &Vehicle> {
    let session = &state.session;
    let cursor = session.cursor.into_iter();
    let selected = session.selection.iter().copied();
    let others = selected.filter(|id| Some(*id) != session.cursor);
    let ids = cursor.chain(others).take(MOST_SHOWN);
    ids.filter_map(|id| session.vehicles.get(&id).map(Arc::as_ref))
}

/// The plan, the fence and the rally points of a vehicle.
fn on_board(vehicle: &Vehicle) -> Vec<Sketch> {
    let plans = &vehicle.plans;
    let mut sketches = Vec::new();
    if let Some(fence) = &plans.fence.content {
        sketches.extend(fenced(fence));
    }
    if let Some(plan) = &plans.plan.content {
        sketches.push(Sketch {
            kind: SketchKind::Plan,
            label: String::new(),
            points: plan.path().map(|(_, place)| place).collect(),
            closed: false,
        });
        sketches.extend(
            plan.path().map(|(item, place)| {
                Sketch::point(SketchKind::Plan, format!("w{}", item.seq), place)
            }),
        );
    }
    if let Some(rally) = &plans.rally.content {
        let points = rally.points.iter().enumerate();
        sketches.extend(points.map(|(at, point)| {
            Sketch::point(SketchKind::Rally, format!("R{}", at + 1), point.at_point)
        }));
    }
    sketches
}

fn fenced(fence: &FencePlan) -> impl Iterator<Item = Sketch> {
    fence.areas.iter().map(|area| {
        let kind = if area.inclusion {
            SketchKind::Fence
        } else {
            SketchKind::KeepOut
        };
        let outline = match &area.shape {
            FenceShape::Polygon(corners) => Outline::Polygon(corners.clone()),
            FenceShape::Circle { center, radius_m } => Outline::Circle {
                centre: *center,
                radius_m: f64::from(*radius_m),
            },
        };
        Sketch::area(kind, "", &outline)
    })
}
