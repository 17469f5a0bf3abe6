//! The ground: areas, survey cells, homes, and the paths of the vehicles.

use std::collections::BTreeSet;

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;

use super::canvas::{Canvas, Stroke};
use super::labels::{self, Label, LabelKind, MapCell};
use super::{finds, traffic, ways};
use crate::app::State;
use crate::app::room::map::{Sketch, SketchKind, sketches};
use crate::commands::PEAK_PLACE;
use crate::config::Symbols;
use crate::geo::{DOTS_ACROSS, Extent, GridSize, LatLon, Outline, Viewport};
use crate::mission::{MoverKind, NEXT_PLACE};
use crate::ui::look::{Badge, Look};
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::vehicle::VehicleId;

/// The cells of a survey.
const CELL: Stroke = Stroke::dotted(Role::Muted);
/// The wire of a power line.
pub const WIRE: Stroke = Stroke::solid(Role::Warning);
/// The ruler, from its start to the cursor.
pub const RULER: Stroke = Stroke::dotted(Role::Key);

/// The stroke of a kind of line.
pub const fn stroke(kind: SketchKind) -> Stroke {
    match kind {
        SketchKind::Task => Stroke::dotted(Role::Info),
        SketchKind::Fence => Stroke::dashed(Role::Fence),
        SketchKind::KeepOut => Stroke::solid(Role::Danger),
        SketchKind::NoFly | SketchKind::Meeting => Stroke::dense(Role::Danger),
        SketchKind::Jamming => Stroke::dash_dot(Role::Accent),
        SketchKind::People => Stroke::dotted(Role::Warning),
        SketchKind::Radio => Stroke::dotted(Role::Accent),
        SketchKind::Wire => WIRE,
        SketchKind::Plan => Stroke::dense(Role::Info),
        SketchKind::Leg => Stroke::broken(Role::Accent),
        SketchKind::Rally => Stroke::dotted(Role::Title),
        SketchKind::Course => Stroke::sparse(Role::Accent),
    }
}

/// The stroke of a sketch: plans have the colours of their vehicles.
pub fn stroke_of(sketch: &Sketch) -> Stroke {
    let usual = stroke(sketch.kind);
    sketch.vehicle.map_or(usual, |vehicle| {
        usual.with_role(Badge::of_vehicle(vehicle).role)
    })
}

/// The sign before an area's name, so that its kind is visible without colours.
pub const fn sign(kind: SketchKind) -> &'static str {
    match kind {
        SketchKind::NoFly => "x ",
        SketchKind::Jamming => "~ ",
        SketchKind::People => "& ",
        SketchKind::Radio => "% ",
        SketchKind::Meeting => "!",
        SketchKind::Task
        | SketchKind::Fence
        | SketchKind::KeepOut
        | SketchKind::Wire
        | SketchKind::Plan
        | SketchKind::Leg
        | SketchKind::Rally
        | SketchKind::Course => "",
    }
}

/// The kind of the label of an area, a line or a place; the `x` of a no-fly area counts as a
/// letter.
pub const fn label_kind(kind: SketchKind) -> LabelKind {
    match kind {
        SketchKind::Jamming | SketchKind::People | SketchKind::Radio | SketchKind::Meeting => {
            LabelKind::Signed
        }
        SketchKind::NoFly
        | SketchKind::Task
        | SketchKind::Fence
        | SketchKind::KeepOut
        | SketchKind::Wire
        | SketchKind::Plan
        | SketchKind::Leg
        | SketchKind::Rally
        | SketchKind::Course => LabelKind::Word,
    }
}

/// The sign in the middle of an area to stay out of: without colours, its border looks like a trail.
pub const KEEP_OUT: &str = "x";

/// The sign of an area to stay out of, in the middle of its corners, if that is in view.
pub fn keep_out_sign(corners: &[LatLon], view: &Viewport) -> Option<Label> {
    let middle = Extent::around(corners.iter().copied())?.centre();
    Some(Label {
        cell: view.cell(middle)?,
        kind: LabelKind::Word,
        text: KEEP_OUT.to_owned(),
        role: stroke(SketchKind::KeepOut).role,
    })
}

/// Draws all lines; returns the labels, which are to be drawn beside the vehicles.
pub fn draw(
    state: &State,
    look: &Look,
    view: &Viewport,
    area: Rect,
    buffer: &mut Buffer,
) -> Vec<Label> {
    let mut canvas = Canvas::new(GridSize::new(view.columns, view.rows), look.symbols);
    let mut labels = Vec::new();
    draw_cells(state, view, &mut canvas, &mut labels);
    let sketches = sketches(state);
    let mut meetings = Vec::new();
    let (legs, others): (Vec<_>, Vec<_>) =
        (sketches.iter()).partition(|sketch| sketch.kind == SketchKind::Leg);
    let are_signed = are_signed(&sketches, look);
    for sketch in others {
        let is_meeting = sketch.kind == SketchKind::Meeting;
        let names = if is_meeting {
            &mut meetings
        } else {
            &mut labels
        };
        draw_sketch(sketch, are_signed, view, &mut canvas, names);
    }
    labels.extend(labels::spread(meetings, area.height));
    let ghosts = ways::draw_ghost(state, view, &mut canvas);
    ways::draw_trails(state, look, view, &mut canvas, &mut labels);
    ways::draw_targets(state, view, &mut canvas, &mut labels);
    // A leg covers trails and the targets of other vehicles.
    for sketch in legs {
        draw_sketch(sketch, are_signed, view, &mut canvas, &mut labels);
    }
    draw_homes(state, look, view, &mut labels);
    draw_movers(state, view, &mut canvas, &mut labels);
    traffic::draw(state, look, view, &mut canvas, &mut labels);
    labels.extend(finds::labels(state, look, view));
    // A ghost takes precedence over the name of a place.
    labels.extend(ghosts);
    let map = state.rooms().map();
    if let Some(mark) = map.mark() {
        canvas.line(view.dot(mark), view.dot(map.pointed(view)), RULER);
    }
    canvas.draw(Panel::new(look, area), buffer);
    labels
}

/// The cells of the vehicles' signs, sorted by row and column, without duplicates.
pub fn vehicle_cells(state: &State, view: &Viewport) -> Vec<MapCell> {
    let vehicles = state.session().vehicles().values();
    let mut cells: Vec<MapCell> = vehicles
        .filter_map(|vehicle| view.cell(vehicle.global?.at_point))
        .collect();
    cells.sort_unstable();
    cells.dedup();
    cells
}

/// Draws the cells of surveys: their names until they are sampled, then their values.
fn draw_cells(state: &State, view: &Viewport, canvas: &mut Canvas, labels: &mut Vec<Label>) {
    let cells = state
        .session()
        .mission()
        .into_iter()
        .flat_map(|it| &it.cells);
    for cell in cells {
        outline(
            &Outline::square(cell.centre, cell.side_m).corners(),
            view,
            canvas,
            CELL,
        );
        let text = match cell.value {
            Some(value) if cell.sampled => format!("{value:.1}"),
            _ => cell.name.clone(),
        };
        let role = if cell.sampled { Role::Ok } else { Role::Muted };
        let room = cell.side_m / view.metres_per_dot() / f64::from(DOTS_ACROSS);
        let width = text.chars().count() as u16;
        if let Some((column, row)) = view.cell(cell.centre)
            && f64::from(width) < room
        {
            let cell = (column.saturating_sub(width / 2), row);
            labels.push(Label {
                cell,
                kind: LabelKind::Word,
                text,
                role,
            });
        }
    }
}

/// Whether labels of plans need the signs of their vehicles, because the plans do not differ in
/// colour.
fn are_signed(sketches: &[Sketch], look: &Look) -> bool {
    let vehicles: BTreeSet<VehicleId> = sketches.iter().filter_map(|it| it.vehicle).collect();
    vehicles.len() > 1 && !ways::tells_by_colour(look)
}

fn draw_sketch(
    sketch: &Sketch,
    is_signed: bool,
    view: &Viewport,
    canvas: &mut Canvas,
    labels: &mut Vec<Label>,
) {
    let stroke = stroke_of(sketch);
    let points = &sketch.points;
    if sketch.closed {
        outline(points, view, canvas, stroke);
        let is_keep_out = sketch.kind == SketchKind::KeepOut;
        labels.extend(keep_out_sign(points, view).filter(|_| is_keep_out));
    } else {
        for pair in points.windows(2) {
            canvas.line(view.dot(pair[0]), view.dot(pair[1]), stroke);
        }
    }
    // The name is at the northernmost of the western corners.
    let corner = points.iter().filter_map(|&point| view.cell(point));
    if let Some((column, row)) = corner.min_by_key(|&(column, row)| (row, column)) {
        let vehicle = sketch.vehicle.filter(|_| is_signed && points.len() == 1);
        let own = vehicle.map(|id| format!("{}:", Badge::of_vehicle(id).sign));
        let kind = own
            .as_ref()
            .map_or(label_kind(sketch.kind), |_| LabelKind::Signed);
        let sign = own.unwrap_or_else(|| sign(sketch.kind).to_owned());
        labels.push(Label {
            cell: (column + u16::from(points.len() > 1), row),
            kind,
            text: format!("{sign}{}", sketch.label),
            role: stroke.role,
        });
    }
}

/// Whether a view shows a part of a sketch.
pub fn is_seen(sketch: &Sketch, view: &Viewport) -> bool {
    if sketch
        .points
        .iter()
        .any(|&point| view.cell(point).is_some())
    {
        return true;
    }
    let mut canvas = Canvas::new(GridSize::new(view.columns, view.rows), Symbols::Braille);
    draw_sketch(sketch, false, view, &mut canvas, &mut Vec::new());
    !canvas.is_blank()
}

/// Draws a closed line.
pub fn outline(corners: &[LatLon], view: &Viewport, canvas: &mut Canvas, stroke: Stroke) {
    let next = corners.iter().cycle().skip(1);
    for (&from, &to) in corners.iter().zip(next) {
        canvas.line(view.dot(from), view.dot(to), stroke);
    }
}

/// Adds the labels of homes and named places; only the first one in a cell.
fn draw_homes(state: &State, look: &Look, view: &Viewport, labels: &mut Vec<Label>) {
    let session = state.session();
    let mut homes: Vec<(u16, u16)> = session
        .vehicles()
        .values()
        .filter_map(|vehicle| view.cell(vehicle.home?.at_point))
        .collect();
    homes.sort_unstable();
    homes.dedup();
    // Cells and contacts have been drawn already.
    let mission = session.mission().into_iter();
    let cells = mission.clone().flat_map(|it| &it.cells);
    let contacts = mission.flat_map(|it| &it.contacts);
    let cells = cells.map(|cell| cell.name.as_str());
    let drawn: BTreeSet<&str> = cells
        .chain(contacts.map(|contact| contact.name.as_str()))
        .collect();
    let next = next_place(state);
    let named = named_places(state).filter(|(name, _)| !drawn.contains(name));
    // Later ones take precedence if there is no room for all.
    let (coming, others): (Vec<_>, Vec<_>) = named.partition(|(_, place)| Some(*place) == next);
    for (name, place) in others.into_iter().chain(coming) {
        let cell = view.cell(place).filter(|cell| !homes.contains(cell));
        let (sign, role) = if Some(place) == next {
            (next_sign(look.symbols), Role::Key)
        } else {
            ("+", Role::Info)
        };
        labels.extend(cell.map(|cell| Label {
            cell,
            kind: LabelKind::Place,
            text: format!("{sign}{name}"),
            role,
        }));
    }
    labels.extend(homes.into_iter().map(|cell| Label {
        cell,
        kind: LabelKind::Word,
        text: "H".to_owned(),
        role: Role::Title,
    }));
}

/// The named places, each place with one name: the next one of a mission has a name of its own, and the highest reading
/// of all vehicles is that of one of them.
pub fn named_places(state: &State) -> impl Iterator<Item = (&str, LatLon)> {
    let places = state.session().places();
    let peak = places.get(PEAK_PLACE).copied();
    let named = places.iter().map(|(name, place)| (name.as_str(), *place));
    named.filter(move |&(name, place)| {
        name != NEXT_PLACE && (name == PEAK_PLACE || Some(place) != peak)
    })
}

/// The next place to go to, if the mission has one.
pub fn next_place(state: &State) -> Option<LatLon> {
    let mission = state.session().mission()?;
    mission.places.get(NEXT_PLACE).copied()
}

/// The sign before the name of the next place.
pub const fn next_sign(symbols: Symbols) -> &'static str {
    match symbols {
        Symbols::Braille | Symbols::Block => "»",
        Symbols::Ascii => ">>",
    }
}

/// Draws people, aircraft and other operators' drones, with the distance to keep from them.
fn draw_movers(state: &State, view: &Viewport, canvas: &mut Canvas, labels: &mut Vec<Label>) {
    let movers = state
        .session()
        .mission()
        .into_iter()
        .flat_map(|it| &it.movers);
    for mover in movers {
        let (letter, role) = match mover.kind {
            MoverKind::Person => ('P', Role::Warning),
            MoverKind::Aircraft => ('A', Role::Danger),
            MoverKind::Intruder => ('U', Role::Danger),
        };
        let around = Outline::Circle {
            centre: mover.at,
            radius_m: mover.keep_out_m,
        };
        outline(&around.corners(), view, canvas, Stroke::dotted(role));
        if mover.kind == MoverKind::Aircraft {
            // Its label is that of the traffic.
            continue;
        }
        labels.extend(view.cell(mover.at).map(|cell| Label {
            cell,
            kind: LabelKind::Word,
            text: format!("{letter}:{}", mover.name),
            role,
        }));
    }
}
