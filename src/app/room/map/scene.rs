//! Areas and paths on the ground, as plain outlines for the map.

use std::sync::Arc;

use crate::app::State;
use crate::geo::{LatLon, Outline};
use crate::mission::{AreaKind, KnownWire};
use crate::swarm::Path;
use crate::vehicle::{FencePlan, FenceShape, Plan, Vehicle, VehicleId};

/// A line on the map, or a single point.
#[derive(Debug, Clone, PartialEq)]
pub struct Sketch {
    pub kind: SketchKind,
    /// The line's label; may be empty.
    pub label: String,
    pub points: Vec<LatLon>,
    /// Whether the last point is joined to the first.
    pub closed: bool,
    /// The vehicle whose plan contains the line.
    pub vehicle: Option<VehicleId>,
}

/// The symbol of a power line's pylon.
pub const PYLON: &str = "T";
/// The symbol of a vehicle that has paused in its plan.
pub const PAUSED: &str = "||";

/// The meaning of a line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SketchKind {
    /// The area of a task.
    Task,
    /// A border that vehicles inside must not cross.
    Fence,
    /// A border that vehicles outside must not cross.
    KeepOut,
    /// An area where flight is forbidden.
    NoFly,
    /// An area where satellite navigation fails.
    Jamming,
    /// An area with people below.
    People,
    /// An area with weak radio reception.
    Radio,
    /// The wire of a power line, or one of its pylons.
    Wire,
    /// A vehicle's plan for AUTO.
    Plan,
    /// The leg of a plan that the vehicle is flying.
    Leg,
    /// A rally point, where RTL may end.
    Rally,
    /// A vehicle's path in a joint manoeuvre.
    Course,
    /// Where two vehicles come too close to each other in a rehearsal.
    Meeting,
}

impl SketchKind {
    /// The meaning of a mission area's border.
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
            vehicle: None,
        }
    }

    fn point(kind: SketchKind, label: String, place: LatLon) -> Self {
        Self {
            kind,
            label,
            points: vec![place],
            closed: false,
            vehicle: None,
        }
    }

    fn of_plan(self, vehicle: &Vehicle) -> Self {
        Self {
            vehicle: Some(vehicle.id),
            ..self
        }
    }
}

/// All outlines, the most important last: the mission's areas and power lines, then the paths of a
/// manoeuvre, then the plans, fences and rally points of the commanded vehicles. A fence shared by
/// several is drawn once.
pub fn sketches(state: &State) -> Vec<Sketch> {
    let known = state.session.task.areas.iter();
    let areas = known.map(|area| {
        let kind = SketchKind::of_area(area.kind);
        Sketch::area(kind, &area.name, &area.outline)
    });
    let mut sketches: Vec<Sketch> = areas.collect();
    sketches.extend(wires(state).flat_map(strung));
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
    sketches.extend(state.session.rehearsed.meetings().iter().map(|meeting| {
        let [a, b] = meeting.vehicles;
        Sketch::point(SketchKind::Meeting, format!("{a}/{b}"), meeting.at_point)
    }));
    sketches
}

/// The power lines of the mission.
pub fn wires(state: &State) -> impl Iterator<Item = &KnownWire> {
    let mission = state.session.task.listing.iter();
    mission.flat_map(|mission| &mission.wires)
}

/// The wire of a power line and its pylons.
fn strung(wire: &KnownWire) -> impl Iterator<Item = Sketch> {
    let between = Sketch {
        kind: SketchKind::Wire,
        label: String::new(),
        points: wire.pylons.clone(),
        closed: false,
        vehicle: None,
    };
    let pylons = wire.pylons.iter();
    let pylons = pylons.map(|&at| Sketch::point(SketchKind::Wire, PYLON.to_owned(), at));
    std::iter::once(between).chain(pylons)
}

/// A vehicle's path in a manoeuvre, or its place in a formation while the vehicle is away from that
/// place.
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
            vehicle: None,
        }),
    }
}

/// The positions of plans, rally points and manoeuvres on the map.
pub fn planned(state: &State) -> impl Iterator<Item = LatLon> {
    let flown = [SketchKind::Plan, SketchKind::Rally];
    let all_sketches = shown(state).flat_map(on_board);
    let sketches = all_sketches.filter(move |sketch| flown.contains(&sketch.kind));
    let drawn = state.session.paths.iter();
    let paths = drawn.flat_map(|path| path.points.iter().copied());
    sketches.flat_map(|sketch| sketch.points).chain(paths)
}

/// The place of a vehicle in a formation is not drawn if the vehicle is closer to it than this, in metres.
const IN_PLACE_M: f64 = 3.0;
/// The maximum number of vehicles whose plans are shown.
const MOST_SHOWN: usize = 16;

/// The vehicle under the cursor and the selected ones.
fn shown(state: &State) -> impl Iterator<Item = &Vehicle> {
    let session = &state.session;
    let cursor = session.choice.cursor.into_iter();
    let selected = session.choice.selection.iter().copied();
    let others = selected.filter(|id| Some(*id) != session.choice.cursor);
    let ids = cursor.chain(others).take(MOST_SHOWN);
    ids.filter_map(|id| session.vehicles.get(&id).map(Arc::as_ref))
}

/// Whether the map shows the current leg of a vehicle's plan.
pub fn shows_leg(state: &State, vehicle: &Vehicle) -> bool {
    let is_shown = shown(state).any(|it| it.id == vehicle.id);
    is_shown && vehicle.plan_leg().is_some_and(|leg| leg.to.is_some())
}

/// The plan, the fence and the rally points of a vehicle.
fn on_board(vehicle: &Vehicle) -> Vec<Sketch> {
    let plans = &vehicle.plans;
    let mut sketches = Vec::new();
    if let Some(fence) = &plans.fence.content {
        sketches.extend(fenced(fence));
    }
    if let Some(plan) = &plans.plan.content
        && plan.path().next().is_some()
    {
        sketches.push(Sketch {
            kind: SketchKind::Plan,
            label: String::new(),
            points: way(vehicle, plan),
            closed: false,
            vehicle: Some(vehicle.id),
        });
        let current = vehicle.plan_leg().filter(|leg| leg.to.is_some());
        let is_current = |number: usize| current.is_some_and(|leg| usize::from(leg.item) == number);
        let others = plan.path().filter(|(number, _)| !is_current(*number));
        sketches.extend(others.map(|(number, place)| {
            Sketch::point(SketchKind::Plan, format!("w{number}"), place).of_plan(vehicle)
        }));
    }
    sketches.extend(flown(vehicle).into_iter().flatten());
    if let Some(rally) = &plans.rally.content {
        let points = rally.points.iter().enumerate();
        sketches.extend(points.map(|(at, point)| {
            Sketch::point(SketchKind::Rally, format!("R{}", at + 1), point.at_point)
        }));
    }
    sketches
}

/// The path of a vehicle's plan; it starts at home if the plan takes off in place.
fn way(vehicle: &Vehicle, plan: &Plan) -> Vec<LatLon> {
    let home = vehicle.home.filter(|_| plan.takes_off_in_place());
    let path = plan.path().map(|(_, place)| place);
    home.map(|home| home.at_point)
        .into_iter()
        .chain(path)
        .collect()
}

/// The leg that a vehicle is flying, and its end, labelled with the numbers of the item and of the
/// last item.
fn flown(vehicle: &Vehicle) -> Option<[Sketch; 2]> {
    let leg = vehicle.plan_leg()?;
    let (here, to) = (vehicle.global?.at_point, leg.to?);
    let way = Sketch {
        kind: SketchKind::Leg,
        label: String::new(),
        points: vec![here, to],
        closed: false,
        vehicle: Some(vehicle.id),
    };
    let mut label = format!("w{}/{}", leg.item, leg.last);
    if vehicle.has_paused() {
        label.extend([" ", PAUSED]);
    }
    let end = Sketch::point(SketchKind::Leg, label, to).of_plan(vehicle);
    Some([way, end])
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
